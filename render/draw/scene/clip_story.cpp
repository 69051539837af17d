#include "draw/scene/clip_story.h"

#include "draw/scene/pairs.h"
#include "draw/scene/points.h"

namespace contactscope::draw {
namespace {

constexpr double kSameCorner = 1e-6;  // of the face's size; float errors are smaller
constexpr double kHatchPixels = 9;    // line spacing at 720 lines
constexpr double kHatchTurn = 0.7;    // radians from the polygon's first edge

constexpr Swatch kCutAwaySwatch{LegendGroup::Faces, 5, [](auto& pen) { pen.hatched(kDropped); }};
constexpr Swatch kMadeCornerSwatch{LegendGroup::Points, 2,
                                   [](auto& pen) { pen.dot(0, 4.8, kClipPolygon); }};

const trace::Polygon& polygon_before(const trace::Clip& clip, std::size_t step) {
  return step == 0 ? clip.incident.polygon : clip.steps[step - 1].polygon;
}

bool has_corner(const trace::Polygon& polygon, const Vec3d& corner, double tolerance) {
  return std::ranges::any_of(
      polygon, [&](const Vec3d& other) { return (other - corner).norm() <= tolerance; });
}

std::string words_of_step(const trace::Clip& clip, std::size_t steps) {
  const std::string of = " of " + std::to_string(clip.steps.size());
  const std::string plane = "Side plane " + std::to_string(steps) + of;
  const trace::Polygon& before = polygon_before(clip, steps - 1);
  const trace::Polygon& after = clip.steps[steps - 1].polygon;
  const double tolerance = kSameCorner * reach_of(clip.incident.polygon);
  const auto lost = static_cast<std::size_t>(std::ranges::count_if(
      before, [&](const Vec3d& corner) { return !has_corner(after, corner, tolerance); }));
  const auto made = static_cast<std::size_t>(std::ranges::count_if(
      after, [&](const Vec3d& corner) { return !has_corner(before, corner, tolerance); }));
  if (lost == 0 && made == 0) return plane + " cuts nothing";
  return plane + " cuts " + counted(lost, "corner", "corners") + " away and makes " +
         std::to_string(made);
}

std::string words_of_result(const trace::Pair& pair) {
  // Of a mesh only those of the clipped triangle, if its manifold is not merged with others.
  std::size_t kept = 0;
  for (const trace::Manifold& manifold : pair.manifolds)
    if (!manifold.triangle || manifold.triangle == pair.triangle) kept += manifold.points.size();
  const auto above = static_cast<std::size_t>(std::ranges::count_if(
      pair.clip->dropped, [&](const trace::DroppedPoint& point) { return !is_kept(pair, point); }));
  std::string words = counted(kept, "corner is", "corners are") + " at or below the reference face";
  if (above > 0) words += ", " + std::to_string(above) + " above it dropped";
  return words;
}

using Vertices = std::vector<trace::SimplexVertex>;

constexpr double kAlongTheNormal = 0.999;  // cosine: the face that made the contact

/// Hatches a convex polygon in its plane; `pixels` is the line spacing on the screen.
void hatch_in_space(const Camera& camera, const trace::Polygon& polygon, double pixels,
                    const LineStyle& style, Sketch& sketch) {
  if (polygon.size() < 3) return;
  const Vec3d middle = mean_of(polygon);
  const Vec3d normal = newell_normal(polygon).normalized();
  const Vec3d edge = (polygon[1] - polygon[0]).normalized();
  const Vec3d along = std::cos(kHatchTurn) * edge + std::sin(kHatchTurn) * normal.cross(edge);
  const Vec3d across = normal.cross(along);
  const double spacing = pixels / camera.pixels_per_metre(middle);
  double least = 1e300, most = -1e300;
  for (const Vec3d& p : polygon) {
    least = std::min(least, across.dot(p - middle));
    most = std::max(most, across.dot(p - middle));
  }
  for (double at = (std::floor(least / spacing) + 0.5) * spacing; at < most; at += spacing) {
    std::vector<Vec3d> ends;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec3d &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
      const double at_p = across.dot(p - middle) - at, at_q = across.dot(q - middle) - at;
      if ((at_p < 0) != (at_q < 0)) ends.push_back(zero_between(p, q, at_p, at_q));
    }
    if (ends.size() == 2) sketch.line(ends[0], ends[1], style);
  }
}

}  // namespace

bool has_clip_story(const Scene& scene, const trace::Pair& pair) {
  return pair.clip && scene.view.story == Story::ClipSteps;
}

std::size_t clip_steps_to_show(const Scene& scene, const trace::Pair& pair) {
  if (!pair.clip) return 0;
  if (!has_clip_story(scene, pair)) return pair.clip->steps.size();
  return std::min(pair.clip->steps.size(), static_cast<std::size_t>(scene.frame.frame));
}

bool all_planes_have_cut(const Scene& scene, const trace::Pair& pair) {
  return has_clip_story(scene, pair) &&
         static_cast<std::size_t>(scene.frame.frame) > pair.clip->steps.size();
}

std::vector<NumberedCorner> numbered_corners(const trace::Clip& clip, std::size_t steps) {
  const double tolerance = kSameCorner * reach_of(clip.incident.polygon);
  std::vector<NumberedCorner> made;
  for (std::size_t k = 0; k < steps; ++k) {
    for (NumberedCorner& corner : made) corner.is_new = false;
    for (const Vec3d& corner : clip.steps[k].polygon) {
      if (!has_corner(polygon_before(clip, k), corner, tolerance))
        made.push_back({corner, static_cast<int>(made.size()) + 1, true});
    }
  }
  std::erase_if(made, [&](const NumberedCorner& corner) {
    return !has_corner(clip.steps[steps - 1].polygon, corner.position, tolerance);
  });
  return made;
}

trace::Polygon cut_away(const trace::Clip& clip, std::size_t step) {
  const trace::ClipStep& plane = clip.steps[step];
  const double tolerance = kSameCorner * reach_of(clip.incident.polygon);
  trace::Polygon outside = clipped(
      polygon_before(clip, step),
      [&](const Vec3d& p) { return plane.normal.dot(p) - plane.offset; }, zero_between, tolerance);
  // A polygon beneath the plane keeps only corners on the plane, which have no area.
  const bool any = std::ranges::any_of(
      outside, [&](const Vec3d& p) { return plane.normal.dot(p) - plane.offset > tolerance; });
  return any && outside.size() > 2 ? outside : trace::Polygon{};
}

void draw_clip_story(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const trace::Clip& clip = *pair.clip;
  const std::size_t steps = clip_steps_to_show(scene, pair);
  if (steps == 0) {
    sketch.heading = "The two faces before clipping";
    return;
  }
  if (all_planes_have_cut(scene, pair)) {
    sketch.heading = words_of_result(pair);
    return;
  }
  sketch.heading = words_of_step(clip, steps);
  const trace::Polygon gone = cut_away(clip, steps - 1);
  if (!gone.empty()) {
    hatch_in_space(scene.camera, gone, kHatchPixels * scene.scales.pixel,
                   {1.6f, with_alpha(kDropped, 0.9f)}, sketch);
    sketch.outline(gone, {1.6f, kDropped});
    sketch.explain(kCutAwaySwatch, "cut away");
  }
  for (const NumberedCorner& corner : numbered_corners(clip, steps)) {
    sketch.mark(corner.is_new ? MarkKind::Dot : MarkKind::Node, corner.position, kClipPolygon);
    sketch.label(corner.position, std::to_string(corner.number), kClipPolygon,
                 corner.is_new ? 22.0f : 17.0f, corner.is_new ? 11 : 8);
    if (corner.is_new) sketch.explain(kMadeCornerSwatch, "new corner, in the order made");
  }
}

std::optional<SimplexStep> simplex_step(const View& view, const trace::Frame& frame,
                                        const trace::Pair& pair, bool later) {
  using Of = SimplexStep::Of;
  // `lists`: vertices of each step.
  const auto shown = [&](Of of, Story story, const std::vector<Vertices>& lists) {
    // Polytope k is the state after k expansions, simplex k the state after step k + 1.
    const int before = of == Of::Epa ? 1 : 0;
    SimplexStep result;
    result.of = of;
    result.steps = count_of(lists) - before;
    result.step =
        view.story == story ? std::clamp(frame.frame + later, 0, result.steps) : result.steps;
    Vertices known;  // support points in the order of discovery
    for (int k = 0; k < result.step + before; ++k) {
      result.vertices = at(lists, k);
      result.numbers.clear();
      for (const trace::SimplexVertex& vertex : result.vertices) {
        const auto found = std::ranges::find(known, vertex);
        result.numbers.push_back(static_cast<int>(found - known.begin()) + 1);
        if (found == known.end()) known.push_back(vertex);
      }
    }
    if (result.last()) return result;
    const Vertices& next = at(lists, result.step + before);
    const auto is_new = [&](const auto& vertex) { return !std::ranges::count(known, vertex); };
    const auto found = std::ranges::find_if(next, is_new);
    if (found != next.end()) result.next = *found;
    return result;
  };
  if (pair.penetration && view.story != Story::GjkSteps) {
    const std::vector<trace::Polytope>& polytopes = pair.penetration->polytopes;
    if (!polytopes.empty()) {
      SimplexStep step =
          shown(Of::Epa, Story::EpaSteps, mapped(polytopes, &trace::Polytope::vertices));
      step.polytope = &at(polytopes, step.step);
      return step;
    }
    const std::vector<trace::Simplex>& portals = pair.penetration->portals;
    if (!portals.empty()) return shown(Of::Mpr, Story::EpaSteps, portals);
  }
  if (!pair.gjk || pair.gjk->steps.empty()) return std::nullopt;
  return shown(Of::Gjk, Story::GjkSteps, pair.gjk->steps);
}

// The nearest point is in the interior of a vertex, edge, triangle or the whole, and is there the
// origin's projection. All parts that contain their projection are compared. Weights of the corners
// follow from Gram-Schmidt; a flat part is skipped, because its own parts cover it.
Vec3d nearest_to_origin(const std::vector<Vec3d>& points) {
  Vec3d best = points.front();
  const unsigned parts = 1u << points.size();
  for (unsigned part = 1; part < parts; ++part) {
    std::vector<Vec3d> corners;
    for (std::size_t i = 0; i < points.size(); ++i)
      if ((part >> i & 1u) != 0) corners.push_back(points[i]);
    std::vector<Vec3d> across;  // offsets from the first corner, orthogonalised
    bool flat = false;
    for (std::size_t i = 1; i < corners.size(); ++i) {
      const Vec3d offset = corners[i] - corners[0];
      Vec3d rest = offset;
      for (const Vec3d& other : across) rest -= other.dot(rest) / other.squaredNorm() * other;
      flat = flat || rest.norm() <= 1e-12 * offset.norm();
      across.push_back(rest);
    }
    if (flat) continue;
    Vec3d foot = corners[0];
    double first = 1;  // weight of the first corner
    bool inside = true;
    for (std::size_t i = corners.size(); i-- > 1;) {
      const Vec3d offset = corners[i] - corners[0];
      const double weight = -across[i - 1].dot(foot) / across[i - 1].dot(offset);
      foot += weight * offset;
      first -= weight;
      inside = inside && weight >= 0;
    }
    if (inside && first >= 0 && foot.norm() < best.norm()) best = foot;
  }
  return best;
}

bool ClippedSegment::cuts(std::size_t side) const {
  const double border = sides[side].dot(face[side]);
  const double most = std::max(sides[side].dot(axis_from), sides[side].dot(axis_to));
  return most > border + 1e-6 * (axis_to - axis_from).norm();
}

std::optional<FaceOfRound> face_of_round(const Scene& scene, const trace::Pair& pair) {
  if (pair.clip || pair.manifolds.size() != 1) return std::nullopt;
  const trace::Manifold& manifold = pair.manifolds.front();
  // A core on a vertex or edge has coinciding closest points; the normal is of a chosen face.
  const bool chosen = pair.degenerate && manifold.axis == "closest_points";
  const PlacedShape* shape_a = scene.find(pair.a);
  const bool of_a = manifold.axis == "face_a" ||
                    (chosen && shape_a != nullptr && !shape_a->traced().faces.empty());
  if (!of_a && !chosen && manifold.axis != "face_b") return std::nullopt;
  const PlacedShape* hull = scene.find(of_a ? pair.a : pair.b);
  const PlacedShape* round = scene.find(of_a ? pair.b : pair.a);
  if (hull == nullptr || round == nullptr || hull->is_mesh() || hull->traced().faces.empty())
    return std::nullopt;
  if (!(round->traced().radius > 0)) return std::nullopt;
  FaceOfRound result{round, {}, of_a ? manifold.normal : Vec3d(-manifold.normal)};
  double best = kAlongTheNormal;
  for (int f = 0; f < count_of(hull->traced().faces); ++f) {
    const double cosine = hull->normal(f).dot(result.normal);
    if (cosine <= best) continue;
    best = cosine;
    result.polygon = hull->polygon(f);
  }
  if (result.polygon.empty()) return std::nullopt;
  return result;
}

std::optional<ClippedSegment> clipped_segment(const Scene& scene, const trace::Pair& pair) {
  const std::optional<FaceOfRound> found = face_of_round(scene, pair);
  if (!found || found->round->vertices.size() != 2) return std::nullopt;
  ClippedSegment result;
  result.face = found->polygon;
  result.normal = found->normal;

  // Sutherland and Hodgman 1974, for a segment.
  result.axis_from = found->round->vertices[0];
  result.axis_to = found->round->vertices[1];
  const Vec3d offset = result.axis_to - result.axis_from;
  double begin = 0, end = 1;
  for (std::size_t i = 0; i < result.face.size(); ++i) {
    const Vec3d edge = result.face[(i + 1) % result.face.size()] - result.face[i];
    const Vec3d outward = edge.cross(result.normal).normalized();
    result.sides.push_back(outward);
    const double before = outward.dot(result.axis_from - result.face[i]),
                 grows = outward.dot(offset);
    if (std::abs(grows) < 1e-12 * offset.norm()) {
      if (before > 0) return std::nullopt;
      continue;
    }
    const double at = -before / grows;
    if (grows > 0)
      end = std::min(end, at);
    else
      begin = std::max(begin, at);
  }
  if (begin >= end) return std::nullopt;
  result.from = result.axis_from + begin * offset;
  result.to = result.axis_from + end * offset;
  return result;
}

}  // namespace contactscope::draw
