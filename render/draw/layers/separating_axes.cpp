#include "draw/layers/layer.h"
#include "draw/scene/pairs.h"

/// Gregorius 2015, "Hull vs Hull: The Separating Axis Test": layer sat_axes shows the best axis of
/// each query, layer contact_axis the chosen axis and the edges that define it, layer orientation why
/// the axis of two edges points out of A.
namespace contactscope::draw {
namespace {

constexpr double kWhiskerGap = 44;  // pixels
constexpr double kMinOfAxis = 14;   // pixels: at less, dots hide the gap

constexpr Swatch kClosestPointsSwatch{LegendGroup::Axes, 3,
                                      [](auto& pen) { pen.dot(0, 4.0, kAxisText); }};

/// Result of a query: the best axis of one shape's faces, or of the edges. The separation runs
/// along the normal from a plane to the support point.
struct Query {
  const char* name;
  Vec3d support, normal;
  double separation = 0;
  bool chosen = false;
};

std::string words(const Scene& scene, const trace::Pair& pair, bool all) {
  if (pair.state == "separated") {
    return all && !pair.sat->edge ? "separating axis and gap; it ended the test"
                                  : "separating axis and gap";
  }
  return (all ? "best axis of a query, its overlap" : "chosen axis, its overlap") +
         spell_factor(scene.scales.overlap);
}

/// The contact's whisker with the length of this separation, if there is one.
std::optional<OnBoth> whisker_of(const Scene& scene, const trace::Pair& pair, double separation) {
  constexpr double kEqually = 1e-6;  // of the overlap
  for (const PairPoint& at : all_points(pair)) {
    if (std::abs(at.point->separation - separation) < -kEqually * separation &&
        has_whisker(scene, pair, at))
      return whisker_at(scene, pair, at);
  }
  return std::nullopt;
}

// From the support point to the plane, in the length of the separation. Next to that line if the
// contact's whisker and normal are on it, as in technical drawings.
void draw_separation(const Scene& scene, const trace::Pair& pair, const Query& query, bool all,
                     Sketch& sketch) {
  const auto& [name, from, normal, metres, chosen] = query;
  const std::string measured =
      std::string(name) + ": " + spell_separation(metres, scene.noise(pair), scene.scales.length);
  if (const auto whisker =
          chosen && !all && metres < 0 ? whisker_of(scene, pair, metres) : std::nullopt) {
    // One sign per overlap.
    sketch.label(0.5 * (whisker->on_a + whisker->on_b), measured, kContact, 18, 17,
                 Vec3d(-scene.camera.right()));
    return;
  }
  const Vec3d to = from - (metres > 0 ? 1.0 : scene.scales.overlap) * metres * normal;
  Vec3d aside = Vec3d::Zero();
  if (chosen && metres < 0 && !all && scene.shows(Layer::Contacts)) {
    aside = scene.camera.to_eye(from).cross(normal);
    if (aside.dot(scene.camera.right()) < 0) aside = -aside;
    if (!aside.isZero()) aside.normalize();
    aside *= kWhiskerGap * scene.scales.pixel / scene.camera.pixels_per_metre(from);
  }
  for (const Vec3d& end : {from, to})
    if (!aside.isZero()) sketch.line(end, end + 1.15 * aside, {1.2f, kAxis});
  const Vec3d begin = from + aside, end = to + aside;
  draw_measure(scene, metres > 0 ? Measured::Gap : Measured::Overlap, begin, end,
               chosen ? 3.5f : 2.0f, words(scene, pair, all), sketch);
  const std::string note = all && chosen && metres <= 0 ? ", chosen" : "";
  sketch.label(0.5 * (begin + end), measured + note, kAxisText, chosen ? 18.0f : 15.0f, 17).bold =
      chosen;
}

void draw_axes(const Scene& scene, const trace::Pair& pair, bool all, Sketch& sketch) {
  if (!pair.sat) return;
  const trace::Sat& sat = *pair.sat;
  for (const bool of_a : {true, false}) {
    const auto& axis = of_a ? sat.face_a : sat.face_b;
    const PlacedShape* shape = scene.find(of_a ? pair.a : pair.b);
    const bool chosen = sat.chosen == (of_a ? "face_a" : "face_b");
    if (!axis || shape == nullptr || !(all || chosen)) continue;
    sketch.face(shape->polygon(axis->face), with_alpha(kAxis, chosen ? 0.30f : 0.14f),
                {chosen ? 2.5f : 1.5f, kAxis});
    // The normal of a face of B opposes its axis.
    const Vec3d normal = of_a ? axis->normal : Vec3d(-axis->normal);
    draw_separation(
        scene, pair,
        {of_a ? "face of A" : "face of B", axis->support, normal, axis->separation, chosen}, all,
        sketch);
  }
  const bool chosen = sat.chosen == "edge_edge";
  if (!sat.edge || !(all || chosen)) return;
  const trace::EdgeAxis& edge = *sat.edge;
  for (const auto& [name, index] : {std::pair{&pair.a, edge.a}, {&pair.b, edge.b}}) {
    if (const auto ends = scene.edge(*name, index))
      sketch.line((*ends)[0], (*ends)[1], {chosen ? 5.0f : 3.5f, kAxis});
  }
  // With a Gauss map, draw_deciding_edges() names them.
  if (chosen && !all && sat.edge_pairs.empty())
    sketch.explain(kDecidingEdgesSwatch, "edges that cross");
  const std::optional<float> pixels = seen_distance(scene.camera, edge.point_a, edge.point_b);
  if (chosen && pixels && *pixels >= kMinOfAxis * scene.scales.pixel) {
    for (const Vec3d& point : {edge.point_a, edge.point_b})
      sketch.mark(MarkKind::Node, point, kAxisText);
    // The heads of a gap's arrow cover the points.
    if (edge.separation < 0)
      sketch.explain(kClosestPointsSwatch, "closest points of the edges", edge.point_a);
  }
  draw_separation(scene, pair, {"edges", edge.point_b, edge.normal, edge.separation, chosen}, all,
                  sketch);
}

/// The two edges of an edge contact. With a separating axis test they are the test's edges, if the
/// Gauss map is recorded, which names them. Otherwise the edges in the point's id.
std::vector<PairFeature> deciding_edges(const trace::Pair& pair) {
  if (pair.sat) {
    if (pair.sat->chosen != "edge_edge" || !pair.sat->edge || pair.sat->edge_pairs.empty())
      return {};
    return {{true, pair.sat->edge->a}, {false, pair.sat->edge->b}};
  }
  if (pair.manifolds.empty() || pair.manifolds.front().axis != "edge_edge") return {};
  if (pair.manifolds.front().points.empty()) return {};
  return edges_in(pair.manifolds.front().points.front().id);
}

void draw_deciding_edges(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const std::vector<PairFeature> edges = deciding_edges(pair);
  if (edges.size() != 2 || edges[0].of_a == edges[1].of_a) return;
  sketch.explain(kDecidingEdgesSwatch, "edges that make the axis");
  for (const auto& [of_a, edge, kind] : edges) {
    const auto ends = scene.edge(of_a ? pair.a : pair.b, edge);
    if (!ends) continue;
    const auto& [from, to] = *ends;
    if (!pair.sat) sketch.line(from, to, {5.0f, kAxis});  // otherwise drawn with the axis
    // At the end nearer to the eye, away from the other edge.
    const bool first = scene.camera.to_camera(from).z() < scene.camera.to_camera(to).z();
    const Vec3d& near = first ? from : to;
    sketch.label(near, of_a ? "edge of A" : "edge of B", kAxisText, 16, 9,
                 Vec3d(near - 0.5 * (from + to)));
  }
}

constexpr Swatch kFromCenterSwatch{LegendGroup::Axes, 8,
                                   [](auto& pen) { pen.arrow(2, 8, kShapeEdge); }};
constexpr Swatch kInwardSwatch{LegendGroup::Forces, 5,
                               [](auto& pen) { pen.open_arrow(2, kDropped); }};

/// Gregorius 2015, "Hull vs Hull: Normal Orientation": of both directions of the edges' axis, the
/// normal is the one along o - c, from A's centre to a vertex of its edge.
void draw_orientation(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const PlacedShape* const a = scene.find(pair.a);
  if (!pair.sat || !pair.sat->edge || a == nullptr) return;
  const trace::EdgeAxis& edge = *pair.sat->edge;
  for (const auto& [name, index] : {std::pair{&pair.a, edge.a}, {&pair.b, edge.b}})
    if (const auto ends = scene.edge(*name, index))
      sketch.line((*ends)[0], (*ends)[1], {5.0f, kAxis});
  const auto ends = scene.edge(pair.a, edge.a);
  if (!ends) return;
  constexpr float kLength = 95, kReversed = 60;  // pixels
  const Vec3d c = a->pose.transform(a->traced().center_of_mass), &o = (*ends)[0];
  sketch.arrow_to_scale(c, o - c, 2.5f, 10, kShapeEdge);
  sketch.arrow(o, edge.normal, kLength, 3.5f, 12, kNormal);
  sketch.arrow(o, Vec3d(-edge.normal), kReversed, 2.0f, 9, kDropped).open = true;
  sketch.mark(MarkKind::Node, c, kShapeEdge);
  sketch.mark(MarkKind::Node, o, kAxisText);
  sketch.label(c, "c", kText, 20, 8);
  sketch.label(o, "o", kText, 20, 8, Vec3d((*ends)[0] - (*ends)[1]));
  const double along = edge.normal.dot(o - c);
  sketch.label(0.5 * (o + c), "n · (o − c) = " + spell_length(along, 0, scene.scales.length), kText,
               18, 12);
  sketch.explain(kDecidingEdgesSwatch, "edges that make the axis");
  sketch.explain(kFromCenterSwatch, "o − c, from A's centre to its edge");
  sketch.explain(kNormalSwatch, "normal n, along it");
  sketch.explain(kInwardSwatch, "the opposite direction, into A");
}

// The most informative axis of an overlap test, as an arrow between the bounds; for a cross
// product also the two edges. It is the axis that separates, or a cross product so short that
// rounding determines its direction, or the one with the largest gap (Gottschalk, Lin and Manocha
// 1996, "OBBTree"; the survey's "Oriented Bounding Box").

constexpr float kArrow = 90;     // pixels
constexpr double kShort = 0.01;  // sine of the angle between two edges; a smaller one is labelled

constexpr Swatch kSeparatingSwatch{LegendGroup::Axes, 5,
                                   [](auto& pen) { pen.arrow(3.5, 9, kAxis); }};
constexpr Swatch kTestedSwatch{LegendGroup::Axes, 6,
                               [](auto& pen) { pen.arrow(2, 9, kShapeEdge); }};
constexpr Swatch kSkippedSwatch{LegendGroup::Axes, 7,
                                [](auto& pen) { pen.open_arrow(1.5, kDropped); }};

bool is_short(const trace::TestedAxis& axis) {
  return axis.is_of_edges() && axis.length < kShort && !axis.direction.isZero(0);
}

/// The separating axis; otherwise the short cross product with the largest gap; otherwise the
/// largest gap of all axes that were not skipped. Null if there is none.
const trace::TestedAxis* worth_a_look(const trace::Query& query) {
  const auto largest = [&](auto&& counts) {
    const trace::TestedAxis* found = nullptr;
    for (const trace::TestedAxis& axis : query.axes)
      if (!axis.direction.isZero(0) && counts(axis) &&
          (found == nullptr ||
           trace::separates_more(axis, *found, std::numeric_limits<float>::epsilon())))
        found = &axis;
    return found;
  };
  const trace::TestedAxis* axis = largest([](const auto& one) { return one.separates; });
  if (axis == nullptr) axis = largest(is_short);
  return axis ? axis : largest([](const auto& one) { return !one.skipped; });
}

/// The extent point of a volume that is nearest to the other's centre.
Vec3d end_towards(const trace::Volume& volume, const trace::Volume& other) {
  const std::vector<Vec3d> ends = extent_points(volume);
  return *std::ranges::min_element(
      ends, {}, [&](const Vec3d& end) { return (end - other.center).squaredNorm(); });
}

void draw_edge(const trace::Volume& box, int k, const Vec3d& end, Sketch& sketch) {
  if (!box.half_extents || k < 0 || k > 2) return;
  const Vec3d offset = box.rotation.value_or(Quatd::Identity()) * Vec3d::Unit(k);
  const double side = offset.dot(end - box.center) > 0 ? -2 : 2;
  sketch.line(end, end + side * (*box.half_extents)[k] * offset, {4, kAxis});
}

void draw_tested_axes(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (!pair.query || !pair.query->bounds_a || !pair.query->bounds_b) return;
  const trace::Query& query = *pair.query;
  const Vec3d end_a = end_towards(*query.bounds_a, *query.bounds_b);
  const Vec3d end_b = end_towards(*query.bounds_b, *query.bounds_a);
  const Vec3d middle = 0.5 * (end_a + end_b);
  if (!scene.camera.sees(middle)) return;  // the legend omits it too
  if (const trace::TestedAxis* axis = worth_a_look(query)) {
    if (axis->is_of_edges()) {
      draw_edge(*query.bounds_a, axis->a, end_a, sketch);
      draw_edge(*query.bounds_b, axis->b, end_b, sketch);
      sketch.explain(kDecidingEdgesSwatch, "edges that make the axis", end_a);
    }
    const Color color = axis->separates ? kAxis : axis->skipped ? kDropped : kShapeEdge;
    const float width = axis->separates ? 3.5f : axis->skipped ? 1.5f : 2;
    sketch.arrow(middle, axis->direction, kArrow, width, 11, color).open = axis->skipped;
    const std::string text =
        spell_axis(query, *axis) +
        (is_short(*axis) ? ", length " + spell_number(axis->length, 2) : std::string());
    const double metres = kArrow * scene.scales.pixel / scene.camera.pixels_per_metre(middle);
    sketch.label(middle + metres * axis->direction, text, axis->separates ? kAxisText : kQuietText,
                 16, 8, axis->direction);
    sketch.explain(axis->separates ? kSeparatingSwatch
                   : axis->skipped ? kSkippedSwatch
                                   : kTestedSwatch,
                   axis->separates   ? is_short(*axis) ? "cross product of two edges, separates"
                                                       : "axis that separates"
                   : axis->skipped   ? "cross product of two edges, skipped"
                   : is_short(*axis) ? "cross product of two edges"
                                     : "axis without a gap");
  }
}

}  // namespace

const LayerDrawing kSatAxesLayer{
    .needs = {&Stages::sat},
    .search = [](const Scene& scene, const trace::Pair& pair,
                 Sketch& sketch) { draw_axes(scene, pair, true, sketch); },
};

const LayerDrawing kContactAxisLayer{
    .needs = {&Stages::sat},
    .search =
        [](const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
          draw_axes(scene, pair, false, sketch);
          draw_deciding_edges(scene, pair, sketch);
        },
};

const LayerDrawing kOrientationLayer{.needs = {&Stages::sat}, .search = draw_orientation};
const LayerDrawing kTestedAxesLayer{.needs = {&Stages::query}, .search = draw_tested_axes};

}  // namespace contactscope::draw
