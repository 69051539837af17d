#include "draw/layers/layer.h"
#include "draw/scene/pair_words.h"
#include "draw/scene/pairs.h"
#include "draw/scene/quantity.h"

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
  for (const Vec3d& end : {from, to}) {
    if (!aside.isZero()) sketch.line(end, end + 1.15 * aside, {1.2f, kAxis});
  }
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
std::vector<PairEdge> deciding_edges(const trace::Pair& pair) {
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
  const std::vector<PairEdge> edges = deciding_edges(pair);
  if (edges.size() != 2 || edges[0].of_a == edges[1].of_a) return;
  sketch.explain(kDecidingEdgesSwatch, "edges that make the axis");
  for (const auto& [of_a, edge] : edges) {
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
constexpr Swatch kOutwardSwatch{LegendGroup::Forces, 4,
                                [](auto& pen) { pen.arrow(3, 10, kNormal); }};
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
  sketch.explain(kOutwardSwatch, "normal n, along it");
  sketch.explain(kInwardSwatch, "the opposite direction, into A");
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

}  // namespace contactscope::draw
