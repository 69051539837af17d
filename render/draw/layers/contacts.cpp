#include "draw/layers/layer.h"
#include "draw/scene/pairs.h"
#include "draw/scene/points.h"
#include "draw/scene/solid.h"

/// Gregorius 2015, "Contact Points" and "Contact Manifolds"; the gap of separated shapes.
namespace contactscope::draw {
namespace {

constexpr double kPointGap = 20;    // pixels from the point, clear of its arrows
constexpr double kNumberGap = 13;   // pixels from the point to a number
constexpr double kMinDepth = 2;     // pixels: smaller overlaps look like a touch
constexpr double kMinShare = 0.05;  // share of the largest visible overlap; more gets a number
constexpr double kEqually = 1e-2;   // share of the overlap

constexpr Swatch kOneShotSwatch{LegendGroup::Points, 4, [](auto& pen) {
                                  pen.whisker(2.5, kContact);
                                  draw_square(pen.middle(), pen.px(4.2), kContact, pen.drawing());
                                }};
template <bool kWhisker>
constexpr Swatch kSeparatedSwatch{LegendGroup::Points, 10, [](auto& pen) {
                                    if (kWhisker) pen.whisker(1.5, kContact);
                                    pen.dot(0, 4.8, kWhite);
                                    pen.dot(0, 4.8, with_alpha(kContact, 0.3f));
                                    pen.dot(3.7, 4.8, kContact);
                                  }};
constexpr Swatch kOnePlaceSwatch{
    LegendGroup::Points, 12,
    [](auto& pen) { pen.text("×2", pen.at(1, 5.5), Align::Left, kContact, Weight::Bold, 15); }};
constexpr Swatch kLineOfCentersSwatch{LegendGroup::Axes, 4,
                                      [](auto& pen) { pen.dashes(1.2, kShapeEdge); }};

/// Middle of the visible part of a face with these corners; its own middle if nothing is visible.
Vec3d seen_middle(const std::vector<Vec3d>& corners, const Camera& camera) {
  constexpr int kSteps = 10;
  const Vec3d middle = mean_of(corners);
  if (camera.sees(middle)) return middle;
  std::vector<Vec3d> seen;
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t j = i + 1; j < corners.size(); ++j)
      for (int step = 0; step <= kSteps; ++step) {
        const Vec3d p = corners[i] + double(step) / kSteps * (corners[j] - corners[i]);
        if (camera.sees(p)) seen.push_back(p);
      }
  return seen.empty() ? middle : mean_of(seen);
}

// Middle of the vertices that are farthest along `direction`.
std::optional<Vec3d> farthest(const PlacedShape& shape, const Vec3d& direction,
                              const Camera& camera) {
  if (shape.vertices.empty()) return std::nullopt;
  double most = -1e300;
  for (const Vec3d& v : shape.vertices) most = std::max(most, direction.dot(v));
  std::vector<Vec3d> front = shape.vertices;
  std::erase_if(
      front, [&](const Vec3d& v) { return most - direction.dot(v) > 1e-5 * shape.mesh->radius; });
  return seen_middle(front, camera) + shape.traced().radius * direction;
}

// Nearest points of the shapes from the trace, or points along the separating axis.
std::optional<OnBoth> gap_of(const trace::Pair& pair, const PlacedShape& a, const PlacedShape& b,
                             const Camera& camera) {
  // Along a known normal the gap is the pair's separation, from the shape whose vertex was used.
  const auto along = [&](const Vec3d& normal, bool from_b) -> std::optional<OnBoth> {
    const std::optional<Vec3d> found =
        from_b ? farthest(a, normal, camera) : farthest(b, Vec3d(-normal), camera);
    if (!found) return std::nullopt;
    const Vec3d gap = pair.separation * normal;
    return from_b ? OnBoth{*found, *found + gap} : OnBoth{*found - gap, *found};
  };
  if (pair.gjk && pair.gjk->status == "separated" && pair.gjk->distance > 0) {
    const Vec3d normal = (pair.gjk->point_b - pair.gjk->point_a) / pair.gjk->distance;
    const double margin_a = pair.incremental ? pair.incremental->margin_a : 0;
    const double margin_b = pair.incremental ? pair.incremental->margin_b : 0;
    const double round_a = a.traced().radius, round_b = b.traced().radius;
    return OnBoth{pair.gjk->point_a + (round_a > 0 ? round_a : margin_a) * normal,
                  pair.gjk->point_b - (round_b > 0 ? round_b : margin_b) * normal};
  }
  for (const bool of_a : {true, false}) {
    const PlacedShape& plane = of_a ? a : b;
    if (!plane.traced().half_space) continue;
    const Vec3d outward = plane.pose.rotate(plane.traced().half_space->normal);
    return along(of_a ? outward : Vec3d(-outward), !of_a);
  }
  if (is_ball(a) && is_ball(b)) {
    const Vec3d offset = b.vertices[0] - a.vertices[0];
    if (offset.isZero()) return std::nullopt;
    return along(offset.normalized(), true);
  }
  if (pair.sat) {
    const trace::Sat& sat = *pair.sat;
    if (sat.chosen == "face_a" && sat.face_a) return along(sat.face_a->normal, false);
    if (sat.chosen == "face_b" && sat.face_b) return along(sat.face_b->normal, true);
    if (sat.chosen == "edge_edge" && sat.edge)
      return OnBoth{sat.edge->point_b - sat.edge->separation * sat.edge->normal, sat.edge->point_b};
  }
  if (pair.cache && pair.cache->hit && pair.cache->normal && pair.cache->axis != "edge_edge")
    return along(*pair.cache->normal, pair.cache->axis == "face_b");
  return std::nullopt;
}

void draw_points(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const std::string factor = spell_factor(scene.scales.overlap);
  // If some normals differ from the rest, the points of the rest are less prominent.
  const std::optional<Vec3d> usual =
      scene.shows(Layer::Normals) ? usual_normal(scene.frame) : std::nullopt;
  const bool any_whisker = std::ranges::any_of(
      kept_points(pair), [&](const PairPoint& kept) { return has_whisker(scene, pair, kept); });
  const bool all_ringed = scene.shows(Layer::Reduced) && pair.manifolds.size() == 1 &&
                          pair.reduction &&
                          pair.reduction->kept.size() < pair.reduction->points.size();
  for (const PairPoint& kept : kept_points(pair)) {
    if (usual && is_like(*usual, kept.manifold->normal)) {
      sketch.mark(MarkKind::Speck, kept.point->position, kDropped);
      continue;
    }
    // From the surface of A to that of B. For a point that does not touch yet, the gap, thinner.
    const auto [from, to] = whisker_at(scene, pair, kept);
    const bool separated = stands_off(*kept.point, scene.scales);
    // Points with an age are drawn by layer Persistent, with the displacement between anchors. Next
    // to them a filled dot would mean a new point, so points of one-shot manifolds are squares.
    const bool square = !separated && scene.shows(Layer::Persistent);
    const float width = separated ? 1.5f : 2.5f;
    // Layer Ahead draws an arrow of the same length next to it.
    const bool measured = separated && scene.shows(Layer::Ahead);
    if (!measured) sketch.bordered_line(from, to, {width, kContact}, 2 * width);
    sketch.mark(separated ? MarkKind::Separation
                : square  ? MarkKind::Square
                          : MarkKind::Dot,
                kept.point->position, kContact);
    if (measured)
      sketch.explain(kSeparatedSwatch<false>, "point within the margin, not touching");
    else if (separated)
      sketch.explain(kSeparatedSwatch<true>, "point within the margin, not touching: line = gap" +
                                                 spell_factor(scene.scales.gap));
    else if (square)
      sketch.explain(kOneShotSwatch, "one-shot point, whisker = overlap" + factor);
    else if (!any_whisker && all_ringed)
      continue;  // layer Reduced explains a dot in a ring
    else if (!any_whisker)
      sketch.explain(kPlainPointSwatch, "contact point");
    else
      sketch.explain(kContactSwatch, "contact point, whisker = overlap" + factor);
  }
}

// Neighbouring triangles of a mesh repeat a shared corner, and points of a sliver are close
// together. Writes the number of coincident points.
void count_shared(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  constexpr double kOneDot = 4;  // pixels
  std::vector<std::pair<PairPoint, int>> places;
  for (const PairPoint& kept : kept_points(pair)) {
    const auto same = std::ranges::find_if(places, [&](const auto& place) {
      const std::optional<float> separated =
          seen_distance(scene.camera, place.first.point->position, kept.point->position);
      return separated && *separated < kOneDot * scene.scales.pixel;
    });
    if (same == places.end())
      places.emplace_back(kept, 1);
    else
      ++same->second;
  }
  // If a box on a floor is seen from the side, all points coincide in equal numbers.
  const auto is_shared = [](const auto& place) { return place.second > 1; };
  if (pair.manifolds.size() <= kFewManifolds && std::ranges::all_of(places, is_shared)) return;
  for (const auto& [kept, count] : places) {
    if (count < 2) continue;
    sketch.label(kept.point->position, "×" + std::to_string(count), kContact, 15, 9);
    if (scene.camera.sees(kept.point->position))
      sketch.explain(kOnePlaceSwatch, "points in one place", kept.point->position);
  }
}

/// Distance to the right until both shapes are passed, pixels at 720 lines, if the text fits there.
std::optional<double> distance_past(const Scene& scene, const PlacedShape& a, const PlacedShape& b,
                                    const Vec3d& from, float width) {
  const std::optional<Point2> begin = scene.camera.project(from);
  if (!begin) return std::nullopt;
  float right = begin->x;
  for (const PlacedShape* shape : {&a, &b})
    for (const Vec3d& p : extent_points(*shape))
      if (const std::optional<Point2> seen = scene.camera.project(p))
        right = std::max(right, seen->x);
  const double clearance = (right - begin->x) / scene.scales.pixel + kNumberGap;
  if (begin->x + clearance * scene.scales.pixel + width > scene.camera.viewport().right())
    return std::nullopt;
  return clearance;
}

// Reports skipped contacts, because an overlap without points would look like a mistake. Labels the
// round shape, next to both shapes if there is room, so that the geometry stays visible.
void report_skipped(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const PlacedShape *a = scene.find(pair.a), *b = scene.find(pair.b);
  if (!pair.degenerate || pair.degenerate->answer != "skip" || a == nullptr || b == nullptr) return;
  const PlacedShape& shape = b->traced().radius > 0 ? *b : *a;
  const Vec3d middle = shape.pose.transform(shape.traced().center_of_mass);
  const std::string words = "no normal: contact skipped";
  constexpr float kSize = 20;
  const auto past = distance_past(
      scene, *a, *b, middle,
      text_width(words, static_cast<float>(scene.scales.pixel) * kSize, FontWeight::Bold));
  Label& label = sketch.label(middle, words, kText, kSize, past.value_or(60),
                              past ? scene.camera.right() : Vec3d(-scene.camera.up()));
  label.leader = true;
}

void draw_contacts(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (scene.crowded()) return;  // see draw_crowd()
  if (pair.query) return;       // no contacts; see layer Answer
  report_skipped(scene, pair, sketch);
  if (!pair.incremental || !scene.shows(Layer::Persistent)) draw_points(scene, pair, sketch);
  constexpr std::size_t kFewPoints = 16;  // with more, counts would crowd the picture
  if (all_points(pair).size() <= kFewPoints && !scene.shows(Layer::Reduced) &&
      !scene.shows(Layer::Ids))
    count_shared(scene, pair, sketch);
  // In a heap or a stage of the pipeline, gaps are not the subject.
  constexpr std::size_t kFewPairs = 16;
  if (scene.frame.pairs.size() > kFewPairs || scene.view.layout == ViewLayout::Stages) return;
  const bool measured_elsewhere =
      scene.shows(Layer::SatAxes) || scene.shows(Layer::ContactAxis) || scene.shows(Layer::Simplex);
  const PlacedShape* a = scene.find(pair.a);
  const PlacedShape* b = scene.find(pair.b);
  if (measured_elsewhere || a == nullptr || b == nullptr) return;
  // Gregorius 2015, "Sphere vs Sphere": everything follows from the line between the centres.
  if (is_ball(*a) && is_ball(*b) && !scene.shows(Layer::Core) &&
      !a->vertices[0].isApprox(b->vertices[0], 1e-6)) {
    sketch.line(a->vertices[0], b->vertices[0], {1.2f, with_alpha(kShapeEdge, 0.8f), true});
    sketch.explain(kLineOfCentersSwatch, "line between the centres",
                   Vec3d(0.8 * a->vertices[0] + 0.2 * b->vertices[0]));
  }
  if (pair.state != "separated" || !(pair.separation > 0)) return;
  const auto gap = gap_of(pair, *a, *b, scene.camera);
  if (!gap) return;
  const bool is_round = a->traced().radius > 0 || b->traced().radius > 0;
  if (scene.shows(Layer::Core) && pair.incremental) return;  // its sum shows the gap
  if (scene.shows(Layer::Core) && is_round)                  // and contains the number
    draw_measure(scene, Measured::Gap, gap->on_a, gap->on_b, 3, "", sketch);
  else
    draw_gap(scene, gap->on_a, gap->on_b, pair.separation, scene.noise(pair), 16,
             scene.camera.right(), sketch);
}

/// Deepest point; of equally deep ones the leftmost. Nothing without an overlap.
std::optional<PairPoint> deepest_of(const Scene& scene, const trace::Pair& pair) {
  const Vec3d left = -scene.camera.right();
  std::optional<PairPoint> deepest;
  for (const PairPoint& candidate : all_points(pair)) {
    const trace::Point& point = *candidate.point;
    const double more = deepest ? deepest->point->separation - point.separation : 1;
    const double equal = -kEqually * point.separation;
    const bool outer = deepest && left.dot(point.position - deepest->point->position) > 0;
    if (more < -equal || (more <= equal && !outer)) continue;
    deepest = candidate;
  }
  return deepest && deepest->point->separation < 0 ? deepest : std::nullopt;
}

/// Labels the smallest gap of points within the margin, if its line is drawn.
void draw_least_gap(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const std::optional<PairPoint> nearest = deepest_contact(pair);
  if (!nearest || !scene.shows(Layer::Contacts)) return;
  if (!stands_off(*nearest->point, scene.scales)) return;
  const OnBoth line = whisker_at(scene, pair, *nearest);
  sketch.label(
      0.5 * (line.on_a + line.on_b),
      "gap " + spell_length(nearest->point->separation, scene.noise(pair), scene.scales.length),
      kContact, 17, kNumberGap, Vec3d(-scene.camera.right()));
}

Vec3d leftmost_of(const trace::Pair& pair, const Vec3d& left) {
  const std::vector<PairPoint> points = all_points(pair);
  const auto how_far = [&](const PairPoint& at) { return left.dot(at.point->position); };
  return std::ranges::max_element(points, {}, how_far)->point->position;
}

/// Labels the pair's overlap at its deepest point.
void draw_overlap(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  // Layer Core writes it, in its sum of margins.
  if (scene.shows(Layer::Core) && pair.incremental && pair.gjk && pair.gjk->distance > 0 &&
      pair.incremental->margin_a + pair.incremental->margin_b > 0)
    return;
  const std::optional<PairPoint> deepest = deepest_of(scene, pair);
  if (!deepest) return draw_least_gap(scene, pair, sketch);
  const Vec3d left = -scene.camera.right();
  const trace::Point& point = *deepest->point;
  const double pixels = scene.camera.pixels_per_metre(point.position);
  const double least = kMinDepth * scene.scales.pixel / (scene.scales.overlap * pixels);  // metres
  if (-point.separation < least) {
    double largest = 0;  // in the frame
    for (const trace::Pair& other : scene.frame.pairs)
      largest = std::max(largest, overlap_of(other));
    if (largest < least || -point.separation < kMinShare * largest) return;
  }
  const OnBoth whisker = whisker_at(scene, pair, *deepest);
  // Equally deep points differ in the last digit. Use the number of the title and the charts.
  const std::string words =
      spell_separation(-overlap_of(pair), scene.noise(pair), scene.scales.length);
  // One sign per overlap: with visible whiskers only the number is written next to them.
  const bool any_whisker = std::ranges::any_of(scene.frame.pairs, [&](const trace::Pair& other) {
    const std::optional<PairPoint> at = deepest_of(scene, other);
    return at && has_whisker(scene, other, *at);
  });
  if (any_whisker) {
    sketch.label(0.5 * (whisker.on_a + whisker.on_b), words, kContact, 17, kNumberGap, left);
    return;
  }
  const Vec3d aside = kPointGap * scene.scales.pixel / pixels * left;
  // To the left of all of the pair's points, so that the bodies stay visible.
  const Vec3d shift = leftmost_of(pair, left) - point.position + aside;
  const Vec3d from = whisker.on_a + shift, to = whisker.on_b + shift;
  const std::string factor = spell_factor(scene.scales.overlap);
  draw_measure(scene, Measured::Overlap, from, to, 2.5f,
               factor.empty() ? "" : "bar = overlap" + factor, sketch);
  sketch.label(0.5 * (from + to), words, kAxisText, 17, 14, left);
}

// With more crosses than this the polygon would be hidden.
constexpr std::size_t kCrowd = 24, kMaxNamedManifolds = 6;

constexpr Swatch kManifoldSwatch{LegendGroup::Points, 13,
                                 [](auto& pen) { pen.area(kContact, kKeptFill, 2); }};

// Gregorius 2015, "Mesh Contact": each triangle's manifold is outlined and named.
void draw_manifolds(const trace::Pair& pair, Sketch& sketch) {
  int number = 0;
  for (const trace::Manifold& manifold : pair.manifolds) {
    trace::Reduction all;
    all.points = manifold.points;
    all.kept.resize(all.points.size());
    std::iota(all.kept.begin(), all.kept.end(), 0);
    const std::vector<Vec3d> corners = kept_polygon(all, manifold.normal);
    ++number;
    if (corners.size() < 3) continue;
    sketch.face(corners, with_alpha(kContact, kKeptFill), {2.0f, kContact});
    sketch.label(mean_of(corners), "manifold " + std::to_string(number), kContact, 17, 0);
    sketch.explain(kManifoldSwatch, "area of a triangle's manifold");
  }
}

// Gregorius 2015, "Contact Point Reduction": for a pair with one manifold that was reduced.
void draw_reduced(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const auto has_triangle = [](const trace::Manifold& each) { return each.triangle.has_value(); };
  const std::size_t count = pair.manifolds.size();
  if (count > 1 && count <= kMaxNamedManifolds && std::ranges::all_of(pair.manifolds, has_triangle))
    draw_manifolds(pair, sketch);
  if (pair.manifolds.size() != 1 || pair.manifolds.front().points.empty() || !pair.reduction)
    return;
  const std::vector<trace::Point>& points = pair.reduction->points;
  const std::vector<int>& kept = pair.reduction->kept;
  if (kept.size() >= points.size()) return;
  const std::vector<Vec3d> corners = kept_polygon(*pair.reduction, pair.manifolds.front().normal);
  const bool spans = corners.size() > 2;
  if (spans) sketch.face(corners, with_alpha(kContact, kKeptFill), {2.0f, kContact});
  const bool crowded = points.size() - kept.size() > kCrowd;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3d& at = points[i].position;
    const auto choice = std::ranges::find(kept, static_cast<int>(i));
    if (choice == kept.end()) {
      sketch.mark(crowded ? MarkKind::SmallCross : MarkKind::Cross, at, kDropped);
    } else {
      if (!scene.shows(Layer::Contacts)) sketch.mark(MarkKind::Dot, at, kContact);
      sketch.mark(MarkKind::Ring, at, kContact);
      sketch.label(at, std::to_string(choice - kept.begin() + 1), kContact, 17, 12).badge =
          Badge::Choice;
    }
  }
  sketch.explain(kReducedSwatch, "reduced away");
  if (!kept.empty())
    sketch.explain(spans ? kSpannedSwatch : kKeptSwatch,
                   spans ? kSpannedWords : "kept, in order of choice");
}

}  // namespace

const LayerDrawing kContactsLayer{
    .needs = {&Stages::sat, &Stages::gjk, &Stages::reduction},
    .beneath =
        [](const Scene& scene, Sketch& sketch) {
          if (!scene.shows(Layer::ReferenceFace) && !scene.crowded())
            draw_touched_triangles(scene, sketch);
        },
    .result = draw_contacts,
    .above =
        [](const Scene& scene, Sketch& sketch) {
          // There the points only make lines between the pairs dashed.
          if (scene.crowded() && !scene.shows(Layer::CandidatePairs)) draw_crowd(scene, sketch);
        },
};

const LayerDrawing kOverlapLayer{.result = draw_overlap};

const LayerDrawing kReducedLayer{.needs = {&Stages::reduction}, .result = draw_reduced};

}  // namespace contactscope::draw
