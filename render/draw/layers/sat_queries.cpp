#include "draw/layers/layer.h"
#include "draw/scene/pairs.h"
#include "draw/scene/points.h"
#include "draw/scene/solid.h"

/// Gregorius 2015, "Hull vs Hull: The Separating Axis Test": the three queries next to each other,
/// each with its own copy of the shapes; "Capsule vs Hull: Deep Penetration": the two of a hull and
/// the segment of a capsule, which has no faces. For each the best axis: the plane of the face, extended,
/// and the parallel plane through the support point, or the plane of two edges; and the separation.
/// With a parallel projection all columns show the same view of the shapes.
namespace contactscope::draw {
namespace {

constexpr std::array<const char*, 3> kQueryNames = {"faces of A", "faces of B", "pairs of edges"};
constexpr double kPlaneReach =
    0.95;  // half size of an extended plane, as a share of the shapes' size
constexpr double kEdgePlaneReach = 0.6;  // half size for edges: this plane is oblique, hides more
constexpr double kBeyondFoot = 0.12;     // extension beyond the end of the separation
constexpr double kQueryName = 22;        // pixels
constexpr float kShapeName = 18;         // pixels

constexpr Swatch kBestPlaneSwatch{LegendGroup::Axes, 5,
                                  [](auto& pen) { pen.area(kAxis, 0.25f, 1.5); }};
constexpr Swatch kParallelPlaneSwatch{LegendGroup::Axes, 7,
                                      [](auto& pen) { pen.dashes(1.5, kAxis); }};
constexpr Swatch kSupportVertexSwatch{LegendGroup::Axes, 6,
                                      [](auto& pen) { pen.dot(0, 5.0, kAxisText); }};

/// Result of one query: separation times normal is the offset from the plane to the support point.
struct BestAxis {
  Vec3d support = Vec3d::Zero();
  Vec3d normal = Vec3d::Zero();  // unit, outward from the plane
  double separation = 0;         // metres
  std::vector<Vec3d> face{};     // the face of the plane; empty for edges
  std::vector<std::array<Vec3d, 2>> edges{};
};

std::array<std::optional<BestAxis>, 3> best_axes(const Scene& scene, const trace::Pair& pair) {
  std::array<std::optional<BestAxis>, 3> found;
  for (const bool of_a : {true, false}) {
    const auto& axis = of_a ? pair.sat->face_a : pair.sat->face_b;
    const PlacedShape* shape = scene.find(of_a ? pair.a : pair.b);
    if (!axis || shape == nullptr) continue;
    const Vec3d normal = of_a ? axis->normal : Vec3d(-axis->normal);
    found[of_a ? 0 : 1] = BestAxis{.support = axis->support,
                                   .normal = normal,
                                   .separation = axis->separation,
                                   .face = shape->polygon(axis->face)};
  }
  if (pair.sat->edge) {
    const trace::EdgeAxis& edge = *pair.sat->edge;
    BestAxis& best = found[2].emplace();
    best = {.support = edge.point_b, .normal = edge.normal, .separation = edge.separation};
    for (const auto& [name, index] : {std::pair{&pair.a, edge.a}, {&pair.b, edge.b}})
      if (const auto ends = scene.edge(*name, index)) best.edges.push_back(*ends);
  }
  return found;
}

/// Square about `middle`, enlarged to include all points of its plane within `margin` of `foot`.
trace::Polygon plane_under(const Vec3d& middle, const Vec3d& normal, const Vec3d& along,
                           double half, const Vec3d& foot, double margin) {
  const Vec3d u = (along - along.dot(normal) * normal).normalized(), v = normal.cross(u);
  const Vec3d displacement = foot - middle;
  const double x = u.dot(displacement), y = v.dot(displacement);
  const double left = std::max(half, margin - x), right = std::max(half, margin + x);
  const double down = std::max(half, margin - y), up = std::max(half, margin + y);
  return {middle - left * u - down * v, middle + right * u - down * v, middle + right * u + up * v,
          middle - left * u + up * v};
}

/// Draws a query's best axis, moved by the offset of its column.
void draw_best(const BestAxis& best, bool chosen, double size, const Vec3d& offset,
               Sketch& sketch) {
  // The plane of two edges is centred on A's edge, to show where it belongs. A parallel plane
  // through B's edge would only hide the edge.
  const bool of_edges = best.face.empty();
  const Vec3d along =
      of_edges ? Vec3d(best.edges[0][1] - best.edges[0][0]) : Vec3d(best.face[1] - best.face[0]);
  const Vec3d middle = offset + (of_edges ? mean_of(best.edges[0]) : mean_of(best.face));
  const Vec3d foot = offset + best.support - best.separation * best.normal;
  const float strength = chosen ? 1.0f : 0.6f;
  const double reach =
      of_edges ? std::max(kEdgePlaneReach * size, 0.5 * along.norm()) : kPlaneReach * size;
  sketch.face(plane_under(middle, best.normal, along, reach, foot, kBeyondFoot * size),
              with_alpha(kAxis, 0.22f * strength), {1.5f, with_alpha(kAxis, strength)});
  if (!of_edges) {
    const Vec3d support = offset + best.support;
    sketch.outline(plane_under(support, best.normal, along, 0.4 * reach, support, 0),
                   {1.5f, with_alpha(kAxis, strength), true});
    std::vector<Vec3d> face = best.face;
    for (Vec3d& corner : face) corner += offset;
    sketch.face(face, with_alpha(kAxis, chosen ? 0.45f : 0.3f), {chosen ? 3.5f : 2.0f, kAxis});
    sketch.explain(kParallelPlaneSwatch, "parallel plane through the support point");
  }
  for (const auto& [from, to] : best.edges)
    sketch.line(from + offset, to + offset, {chosen ? 6.0f : 4.0f, kAxis});
  sketch.measure(foot, offset + best.support, chosen ? 4.0f : 2.5f, 11, kAxisText);
  sketch.mark(MarkKind::Dot, offset + best.support, kAxisText);
  sketch.explain(kBestPlaneSwatch, "plane of the best face or edges, extended");
  sketch.explain(kSupportVertexSwatch, "support point of the other shape");
}

void draw_sat_queries(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const PlacedShape *a = scene.find(pair.a), *b = scene.find(pair.b);
  if (!pair.sat || a == nullptr || b == nullptr) return;
  const std::array<std::optional<BestAxis>, 3> found = best_axes(scene, pair);
  constexpr std::array<std::string_view, 3> kChosen = {"face_a", "face_b", "edge_edge"};
  const double size = std::min(a->mesh->radius, b->mesh->radius);
  std::vector<Vec3d> both = a->vertices;
  append(both, b->vertices);
  const Vec3d middle = center_of(both);
  const Camera& camera = scene.camera;
  const double pixels = camera.pixels_per_metre(middle);
  const Rect& view = camera.viewport();
  const std::optional<Point2> at = camera.project(middle);
  if (!at) return;
  const double top = (at->y - view.y) / pixels - 0.7 * kQueryName * scene.scales.pixel / pixels;
  const auto is_round = [](const PlacedShape* shape) { return shape->traced().radius > 0; };
  const double columns = is_round(a) || is_round(b) ? 2 : 3;
  double left = view.x;
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (k < 2 && is_round(k == 0 ? a : b)) continue;
    const Vec3d offset = (left + 0.5 * view.width / columns - at->x) / pixels * camera.right();
    left += view.width / columns;
    for (const PlacedShape* shape : {a, b})
      (is_round(shape) ? draw_round : draw_solid)(
          camera, moved(*shape, Vec3d::Zero(), offset, Vec3d::Zero()),
          shape->is_a ? kShapeA : kShapeB, sketch);
    for (const PlacedShape* shape : {a, b})
      sketch.label(center_of(shape->vertices) + offset, shape->is_a ? "A" : "B", kText, kShapeName,
                   0);
    const bool chosen = pair.sat->chosen == kChosen[k];
    if (found[k] && (!found[k]->face.empty() || !found[k]->edges.empty()))
      draw_best(*found[k], chosen, size, offset, sketch);
    const Vec3d above = middle + offset + top * camera.up();
    sketch.label(above, k == 2 && columns < 3 ? "segment × edges" : kQueryNames[k], kText,
                 kQueryName, 0, Vec3d(-camera.up()));
    std::string words = "not tested";
    if (found[k]) {
      const bool separated = found[k]->separation > 0;
      words = spell_separation(found[k]->separation, scene.noise(pair), scene.scales.length);
      if (chosen) words += separated ? ": ends the test" : ": the least, chosen";
    }
    const double row = 1.45 * kQueryName * scene.scales.pixel / pixels;
    sketch
        .label(above - row * camera.up(), words, chosen ? kAxisText : kQuietText, kQueryName - 3, 0,
               Vec3d(-camera.up()))
        .bold = chosen;
  }
}

}  // namespace

const LayerDrawing kSatQueriesLayer{.needs = {&Stages::sat}, .search = draw_sat_queries};

}  // namespace contactscope::draw
