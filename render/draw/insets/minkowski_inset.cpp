#include "draw/insets/inset.h"
#include "draw/scene/clip_story.h"
#include "draw/scene/pairs.h"
#include "draw/scene/points.h"
#include "draw/scene/solid.h"

/// The Minkowski difference B - A, and in it the simplex or polytope of an algorithm: van den
/// Bergen 2003, chapter 4; Gregorius 2015, "Incremental Manifold".
namespace contactscope::draw {
namespace {

constexpr Color kDifference = rgb(0xE4E4E8);
constexpr Swatch kSimplexSwatch{LegendGroup::Differences, 1,
                                [](auto& pen) { pen.area(kClipPolygon, 0.16f, 2); }};
// For two points; a single one is a support point.
constexpr Swatch kSimplexLineSwatch{LegendGroup::Differences, 1,
                                    [](auto& pen) { pen.level_line(0, 22, 2.5, kClipPolygon); }};
constexpr Swatch kPolytopeSwatch{LegendGroup::Differences, 2,
                                 [](auto& pen) { pen.area(kPolytope, 0.06f, 1.2); }};
constexpr Swatch kLevelFaceSwatch{LegendGroup::Differences, 4,
                                  [](auto& pen) { pen.area(kSidePlane, 0.4f, 2); }};
constexpr Swatch kSeenFaceSwatch{LegendGroup::Differences, 4,
                                 [](auto& pen) { pen.area(kPolytope, 0.2f, 1.2); }};
constexpr Swatch kNearestFaceSwatch{LegendGroup::Differences, 3,
                                    [](auto& pen) { pen.area(kPolytope, 0.35f, 2.5); }};

constexpr double kSliver = 0.12;  // height of a thin triangle over its longest side, at most
constexpr Swatch kSliverSwatch{LegendGroup::Differences, 5,
                               [](auto& pen) { pen.area(kContact, 0.5f, 2); }};

constexpr Swatch kSearchSwatch{LegendGroup::Differences, 5,
                               [](auto& pen) { pen.open_arrow(1.8, kText); }};
constexpr Swatch kFarthestSwatch{LegendGroup::Differences, 6,
                                 [](auto& pen) { pen.dashes(1.5, kText); }};

constexpr std::size_t kManyFaces = 120;
constexpr double kSupportShare =
    0.3;  // of the difference's size, half the length of the line through a support point
constexpr double kMinSearch = 48;    // pixels, for the arrow of the search direction
constexpr double kNumberAside = 46;  // pixels from a short arrow to its number
constexpr double kFlatHeight = 70, kFlatAside = 80;  // pixels, of a flat simplex drawn again

bool has_difference(const trace::Pair& pair) {
  return pair.minkowski || pair.gjk || pair.penetration;
}

/// Overlap of the cores, which the difference is made of.
bool holds_origin(const trace::Pair& pair) {
  return pair.gjk ? pair.gjk->status == "overlap" : pair.state == "touching";
}

std::vector<Vec3d> differences(const std::vector<trace::SimplexVertex>& vertices) {
  return mapped(vertices, difference);
}

Color step_color(const SimplexStep& step) {
  return step.of == SimplexStep::Of::Epa ? kPolytope : kClipPolygon;
}

/// Draws into a sketch of the difference. Points within `smallest` (metres) count as on the origin.
struct DifferencePen {
  const Camera& camera;
  float scale;  // canvas pixels for one pixel at 720 lines
  double smallest;
  double size;  // of the difference, metres
  LengthUnit unit;
  bool shows_search;
  Sketch& sketch;

  void vertex(const SimplexStep& step, std::size_t i, const Vec3d& aside = Vec3d::Zero()) const {
    const Vec3d at = difference(step.vertices[i]) + aside;
    sketch.mark(MarkKind::Dot, at, step_color(step));
    sketch.label(at, std::to_string(step.numbers[i]), step_color(step), 15, 10).badge =
        Badge::Support;
  }

  /// Arrow from the origin to a point, with its length; the number is aside if longer than the
  /// arrow.
  void distance(const Vec3d& to, double metres, const std::string& name) const {
    if (to.norm() <= smallest) return;
    // A halo would cover the origin.
    sketch.arrows.push_back(
        {.to = to, .double_headed = true, .width = 3, .color = kAxis, .halo = false});
    Label& label = sketch.label(0.5 * to, name + spell_length(metres, 0, unit), kAxisText, 16, 14);
    const std::optional<float> seen = seen_distance(camera, Vec3d::Zero(), to);
    label.leader = seen && *seen < text_width(label.text, scale * label.size, Weight::Bold);
    if (label.leader) {  // opposite to the origin's name
      label.clearance = kNumberAside;
      label.direction = camera.right();
    }
  }

  /// The next support point: searched from `from` along the unit direction `search`. The plane through
  /// it, perpendicular to that direction, has the whole difference on one side: a dashed line if it is
  /// seen edge-on, else a part of it.
  void next(const SimplexStep& step, const Vec3d& from, const Vec3d& search) const {
    if (!step.next) return;
    const Vec3d at = difference(*step.next);
    sketch.mark(MarkKind::Hollow, at, step_color(step));
    sketch.label(at, "next point", step_color(step), 16, 12);
    if (!shows_search) return;
    const Vec3d along = search.cross(camera.to_eye(at)).normalized();
    const double least = kMinSearch * static_cast<double>(scale) / camera.pixels_per_metre(from);
    const Vec3d end = from + std::max(least, (at - from).dot(search)) * search;
    // A halo would cover the origin.
    sketch.arrows.push_back(
        {.from = from, .to = end, .width = 1.8f, .color = kText, .halo = false, .open = true});
    sketch.explain(kSearchSwatch, "search for the next point");
    // Long enough for the point and the foot of the arrow.
    const double reach = kSupportShare * size, shift = (from - at).dot(along);
    const Vec3d first = at + (std::min(shift, 0.0) - reach) * along,
                last = at + (std::max(shift, 0.0) + reach) * along;
    constexpr double kEdgeOn = 0.02;
    if (std::abs(search.dot(camera.to_eye(at))) < kEdgeOn) {
      sketch.line(first, last, {1.5f, kText, true});
    } else {
      const Vec3d across = reach * search.cross(along);
      sketch.face({first - across, last - across, last + across, first + across},
                  with_alpha(kText, 0.05f), {1.2f, kText, true, LineStyle::Hidden::Same});
    }
    sketch.explain(kFarthestSwatch, "no point lies beyond");
  }

  /// The triangle and the next point once more, aside. The height over the triangle is enlarged.
  void flat_tetrahedron(const SimplexStep& step, const std::vector<Vec3d>& points,
                        const Vec3d& search, double height) const {
    const double metres = static_cast<double>(scale) / camera.pixels_per_metre(points[0]);
    const double factor = round_down(kFlatHeight * metres / height);
    const Vec3d aside = kFlatAside * metres * search;
    const Vec3d foot = difference(*step.next) + aside - height * search;
    const Vec3d top = foot + factor * height * search;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3d from = points[i] + aside, to = points[(i + 1) % 3] + aside;
      sketch.surfaces.push_back({{from, to, top}, with_alpha(kClipPolygon, 0.16f)});
      sketch.line(from, to, {2.5f, kClipPolygon});
      sketch.line(from, top, {2.0f, kClipPolygon, true});
      sketch.line(points[i], from, {1.0f, with_alpha(kText, 0.4f)});
      vertex(step, i, aside);
    }
    sketch.line(foot - aside, foot, {1.0f, with_alpha(kText, 0.4f)});
    sketch.mark(MarkKind::Hollow, top, kClipPolygon);
    sketch.measure(foot, top, 2, 9, kText).halo = false;
    sketch.label(
        top,
        "same simplex, height " + spell_length(height) + " × " + spell_count(std::llround(factor)),
        kText, 17, 14, search);
  }

  /// Draws all edges and triangles of a simplex.
  void simplex(const SimplexStep& step) const {
    const std::size_t count = step.vertices.size();
    const Color color = step_color(step);
    const std::vector<Vec3d> points = differences(step.vertices);
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = i + 1; j < count; ++j) {
        sketch.lines.push_back({points[i], points[j], {2.0f, color}, true});
        for (std::size_t k = j + 1; k < count; ++k)
          sketch.surfaces.push_back({{points[i], points[j], points[k]}, with_alpha(color, 0.16f)});
      }
    }
    for (std::size_t i = 0; i < count; ++i) vertex(step, i);
    if (count == 0) return;
    const bool mpr = step.of == SimplexStep::Of::Mpr;
    if (mpr || count > 2)
      sketch.explain(kSimplexSwatch, mpr ? "portal and inner point" : "simplex");
    else if (count == 2)
      sketch.explain(kSimplexLineSwatch, "simplex");
    if (mpr) return;
    const Vec3d nearest = nearest_to_origin(points);
    const Vec3d search = -nearest.normalized();
    const double gain = step.next ? search.dot(difference(*step.next) - nearest) : 0;
    if (!shows_search && count == 3 && gain > smallest && gain < 1e-3 * size)
      flat_tetrahedron(step, points, search, gain);
    if (nearest.norm() > smallest) next(step, Vec3d::Zero(), search);
    distance(nearest, nearest.norm(), step.last() ? "gap " : "");
    if (nearest.norm() > smallest) sketch.explain(kAxisSwatch, "nearest point, its distance");
  }

  void polytope(const SimplexStep& step) const {
    const trace::Polytope& polytope = *step.polytope;
    const std::vector<Vec3d> points = differences(polytope.vertices);
    const auto triangle_of = [&](const std::array<int, 3>& face) {
      return mapped(face, [&](int vertex) { return at(points, vertex); });
    };
    std::set<std::pair<int, int>> edges, of_level, of_seen;
    std::set<int> corners;  // of faces: other vertices are inside by now
    for (const std::array<int, 3>& face : polytope.faces) {
      const std::vector<Vec3d> corner = triangle_of(face);
      const Vec3d normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
      const double height = step.next ? normal.dot(difference(*step.next) - corner[0]) : -size;
      const bool level = !shows_search && std::abs(height) <= smallest;
      // Where faces in one plane are the subject, the nearest face alone has the polytope's colour.
      const bool seen = shows_search && !level && height > -smallest;
      const float fill = seen ? 0.2f : shows_search ? 0.06f : 0;
      sketch.surfaces.push_back(
          {corner, level ? with_alpha(kSidePlane, 0.4f) : with_alpha(kPolytope, fill)});
      if (seen) sketch.explain(kSeenFaceSwatch, "seen by the next point: replaced");
      if (level) sketch.explain(kLevelFaceSwatch, "in one plane with the next point: replaced too");
      for (std::size_t i = 0; i < 3; ++i) {
        const std::pair<int, int> edge = std::minmax(face[i], face[(i + 1) % 3]);
        edges.insert(edge);
        if (level || height > smallest) (level ? of_level : of_seen).insert(edge);
      }
      corners.insert(face.begin(), face.end());
    }
    for (const auto& [from, to] : edges)
      sketch.line(at(points, from), at(points, to), {1.5f, with_alpha(kPolytope, 0.75f)});
    for (const auto& [from, to] : of_level) {  // new faces, if only the others were replaced
      const Vec3d first = at(points, from), along = at(points, to) - first;
      const Vec3d tip = step.next ? difference(*step.next) : first;
      const double height = along.normalized().cross(tip - first).norm();
      if (!of_seen.contains({from, to}) || height > kSliver * along.norm()) continue;
      sketch.face({first, first + along, tip}, with_alpha(kContact, 0.5f), {2, kContact});
      const auto angle_at = [&](const Vec3d& corner, const Vec3d& side) {
        return std::atan2(side.cross(tip - corner).norm(), side.dot(tip - corner));
      };
      const double least = std::min(angle_at(first, along), angle_at(first + along, -along));
      sketch.label(tip + (2 * first + along - 2 * tip) / 3,
                   printed("sliver: %.0f°", least * 180 / std::numbers::pi), kContact, 16, 6);
      sketch.explain(kSliverSwatch, "sliver that would stay without cleanup");
    }
    for (const int corner : corners) sketch.mark(MarkKind::Core, at(points, corner), kPolytope);
    sketch.explain(kPolytopeSwatch, "polytope",
                   corners.empty() ? std::optional<Vec3d>() : at(points, *corners.begin()));
    if (polytope.nearest < 0) return;
    const std::array<int, 3>& face = at(polytope.faces, polytope.nearest);
    const std::vector<Vec3d> triangle = triangle_of(face);
    sketch.surfaces.push_back({triangle, with_alpha(kPolytope, 0.35f)});
    for (std::size_t i = 0; i < 3; ++i)
      sketch.lines.push_back({triangle[i], triangle[(i + 1) % 3], {3.0f, kPolytope}, true});
    for (const int corner : face) vertex(step, static_cast<std::size_t>(corner));
    sketch.explain(kNearestFaceSwatch, "face nearest to the origin", mean_of(triangle));
    const Vec3d normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).normalized();
    next(step, polytope.distance * normal, normal);
    distance(polytope.distance * normal, polytope.distance, step.last() ? "overlap " : "");
    sketch.explain(kAxisSwatch, "distance of its plane");
  }

  /// Without recorded steps, shows the distance of the origin from the difference's border along
  /// the normal of the nearest face: the gap outside, the depth inside.
  void border_distance(const trace::Minkowski& difference, bool held) const {
    std::optional<Vec3d> nearest;
    for (const std::vector<int>& face : difference.faces) {
      const auto corner = [&](std::size_t i) { return at(difference.vertices, face[i]); };
      for (std::size_t i = 2; i < face.size(); ++i) {
        const Vec3d place = nearest_to_origin({corner(0), corner(i - 1), corner(i)});
        if (!nearest || place.norm() < nearest->norm()) nearest = place;
      }
    }
    if (!nearest) return;
    distance(*nearest, nearest->norm(), held ? "overlap " : "gap ");
    if (nearest->norm() > smallest)
      sketch.explain(kAxisSwatch, "the origin's distance from the border");
  }
};

std::string note_of(const trace::Pair& pair, const std::optional<SimplexStep>& step) {
  if (!step) return pair.state == "touching" ? "holds the origin" : "the origin is outside";
  const bool gjk = step->of == SimplexStep::Of::Gjk, epa = step->of == SimplexStep::Of::Epa;
  const std::string name = gjk ? "GJK" : epa ? "EPA" : "MPR";
  if (step->last()) return name + ": " + (gjk ? pair.gjk->status : pair.penetration->status);
  return name + (epa ? ", expansion " : ", step ") + std::to_string(step->step) + " of " +
         std::to_string(step->steps);
}

}  // namespace

std::vector<Vec3d> minkowski_extent(const std::vector<trace::Frame>& frames) {
  std::vector<Vec3d> points = {Vec3d::Zero()};
  for (const trace::Frame& frame : frames) {
    const trace::Pair* pair = first_pair(frame, has_difference);
    if (pair == nullptr) continue;
    if (pair->minkowski) append(points, pair->minkowski->vertices);
    if (pair->gjk)
      for (const trace::Simplex& simplex : pair->gjk->steps) append(points, differences(simplex));
    if (pair->penetration) {
      for (const trace::Polytope& polytope : pair->penetration->polytopes)
        append(points, differences(polytope.vertices));
    }
  }
  return points;
}

InsetPicture sketch_minkowski(const Inset& inset, const Scene& scene) {
  InsetPicture picture;
  const bool is_alone = scene.view.layers.empty(), has_two_steps = is_alone && !scene.view.inset;
  picture.heading = std::string(inset.later     ? "After: "
                                : has_two_steps ? "Before: "
                                                : "") +
                    "Minkowski difference B − A";
  const trace::Pair* pair = first_pair(scene.frame, has_difference);
  Sketch& sketch = picture.sketch;
  double size = 0;
  if (pair != nullptr && pair->minkowski) {
    trace::Shape solid;
    solid.vertices = pair->minkowski->vertices;
    solid.faces = pair->minkowski->faces;
    ShapeMesh mesh = make_mesh(solid);
    // Many small facets are not the approximation of a curved surface here.
    if (solid.faces.size() <= kManyFaces)
      for (ShapeMesh::Edge& edge : mesh.edges) edge.smooth = false;
    const PlacedShape placed{&mesh, {}, solid.vertices};
    draw_solid(inset.camera, placed, kDifference, sketch);
    sketch.center = mean_of(solid.vertices);
    for (const Vec3d& v : solid.vertices) size = std::max(size, (v - sketch.center).norm());
  }
  const bool held = pair != nullptr && holds_origin(*pair);
  sketch.mark(held ? MarkKind::HeldOrigin : MarkKind::Origin, Vec3d::Zero(), kNormal);
  sketch.label(Vec3d::Zero(), "origin", kNormal, 15, 12, Vec3d(-inset.camera.right()));
  if (pair == nullptr) return picture;
  const std::optional<SimplexStep> step = simplex_step(scene.view, scene.frame, *pair, inset.later);
  picture.note = note_of(*pair, step);
  // Rounding errors in float have this size.
  const DifferencePen pen{inset.camera,
                          static_cast<float>(scene.scales.pixel),
                          1e-6 * size,
                          size,
                          scene.scales.length,
                          !is_alone,
                          sketch};
  if (step && step->polytope != nullptr)
    pen.polytope(*step);
  else if (step)
    pen.simplex(*step);
  else if (pair->minkowski)
    pen.border_distance(*pair->minkowski, held);
  return picture;
}

}  // namespace contactscope::draw
