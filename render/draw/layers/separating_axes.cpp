#include <cstdlib>

#include "draw/layers/layer.h"
#include "draw/scene/arrows.h"
#include "draw/scene/quantity.h"
#include "draw/scene/swatches.h"

/// Gregorius 2015, "Hull vs Hull: The Separating Axis Test": layer sat_axes shows the best axis of
/// each query, layer contact_axis the one that was chosen, and the edges that it is made by.
namespace contactscope::draw {
namespace {

constexpr double kBesideWhisker = 44;  // pixels

constexpr Swatch kClosestPointsSwatch{LegendGroup::Axes, 3,
                                      [](auto& pen) { pen.dot(0, 4.0, kAxisText); }};

/// What a query of the test found: the best axis of the faces of one shape, or of the edges. The
/// separation runs along the normal from a plane to the support point; the normal of a face of B
/// opposes its axis.
struct Query {
  const char* name;
  Vec3d support, normal;
  double separation = 0;
  bool chosen = false;
  const trace::FaceAxis* face = nullptr;  // none of edges
  bool of_a = false;                      // the face
};

std::vector<Query> queries_of(const Scene& scene, const trace::Pair& pair, bool all) {
  std::vector<Query> queries;
  if (!pair.sat) return queries;
  const trace::Sat& sat = *pair.sat;
  for (const bool of_a : {true, false}) {
    const auto& axis = of_a ? sat.face_a : sat.face_b;
    const bool chosen = sat.chosen == (of_a ? "face_a" : "face_b");
    if (!axis || !(all || chosen) || scene.find(of_a ? pair.a : pair.b) == nullptr) continue;
    queries.push_back({of_a ? "face of A" : "face of B", axis->support,
                       of_a ? axis->normal : Vec3d(-axis->normal), axis->separation, chosen, &*axis,
                       of_a});
  }
  const bool chosen = sat.chosen == "edge_edge";
  if (sat.edge && (all || chosen))
    queries.push_back({"edges", sat.edge->point_b, sat.edge->normal, sat.edge->separation, chosen});
  return queries;
}

std::string words(const Scene& scene, const trace::Pair& pair, bool all) {
  if (pair.state == "separated") {
    return all && !pair.sat->edge ? "separating axis and gap; it ended the test"
                                  : "separating axis and gap";
  }
  return (all ? "best axis of a query, its overlap" : "chosen axis, its overlap") +
         spell_factor(scene.depth_factor);
}

// From the support point towards the plane it is measured from, as long as the separation. Beside
// that line where the contact's own whisker and normal are on it, as drawings put measures.
void draw_separation(const Scene& scene, const trace::Pair& pair, const Query& query, bool all,
                     Sketch& sketch) {
  const auto& [name, from, normal, metres, chosen, face, of_a] = query;
  const Vec3d to = from - (metres > 0 ? 1.0 : scene.depth_factor) * metres * normal;
  Vec3d aside = Vec3d::Zero();
  if (chosen && metres < 0 && !all && scene.shows(Layer::Contacts)) {
    aside = scene.camera.to_eye(from).cross(normal);
    if (aside.dot(scene.camera.right()) < 0) aside = -aside;
    if (!aside.isZero()) aside.normalize();
    aside *= kBesideWhisker * scene.scales.pixel / scene.camera.pixels_per_metre(from);
  }
  if (!aside.isZero()) {
    for (const Vec3d& end : {from, to}) sketch.line(end, end + 1.15 * aside, {1.2f, kAxis});
  }
  const Vec3d begin = from + aside, end = to + aside;
  draw_measure(scene, begin, end, chosen ? 3.5f : 2.0f, words(scene, pair, all), sketch);
  const std::string note = !chosen ? "" : metres > 0 ? ", the gap" : ", chosen";
  sketch
      .label(0.5 * (begin + end), std::string(name) + ": " + spell_length(metres) + note, kAxisText,
             chosen ? 18.0f : 15.0f, 17)
      .bold = chosen;
}

void draw_axes(const Scene& scene, const trace::Pair& pair, bool all, Sketch& sketch) {
  for (const Query& query : queries_of(scene, pair, all)) {
    if (query.face != nullptr) {
      const PlacedShape& shape = *scene.find(query.of_a ? pair.a : pair.b);
      sketch.face(shape.polygon(query.face->face), with_alpha(kAxis, query.chosen ? 0.30f : 0.14f),
                  {query.chosen ? 2.5f : 1.5f, kAxis});
    } else {
      const trace::EdgeAxis& edge = *pair.sat->edge;
      for (const auto& [name, index] : {std::pair{&pair.a, edge.a}, {&pair.b, edge.b}}) {
        if (const auto ends = scene.edge(*name, index))
          sketch.line((*ends)[0], (*ends)[1], {query.chosen ? 5.0f : 3.5f, kAxis});
      }
      if (query.chosen) {
        sketch.mark(MarkKind::Node, edge.point_a, kAxisText);
        sketch.mark(MarkKind::Node, edge.point_b, kAxisText);
        sketch.explain(kClosestPointsSwatch, "closest points of the edges");
      }
    }
    draw_separation(scene, pair, query, all, sketch);
  }
}

/// The edge that "a:e3 b:e7" names of a shape; `owner` is "a:e" or "b:e".
std::optional<int> edge_in_id(const std::string& id, const std::string& owner) {
  const std::size_t at = id.find(owner);
  if (at == std::string::npos) return std::nullopt;
  const char* digits = id.c_str() + at + owner.size();
  char* end = nullptr;
  const long index = std::strtol(digits, &end, 10);
  return end == digits ? std::nullopt : std::optional<int>(static_cast<int>(index));
}

/// The two edges of an edge contact.
struct DecidingEdges {
  int a, b;
  bool drawn;  // by the axis of the test
};

/// Those of the separating axis test as far as the Gauss map is recorded, on which they bear
/// numbers; without that test those in the id of the point.
std::optional<DecidingEdges> deciding_edges(const trace::Pair& pair) {
  if (pair.sat) {
    if (pair.sat->chosen != "edge_edge" || !pair.sat->edge || pair.sat->edge_pairs.empty())
      return std::nullopt;
    return DecidingEdges{pair.sat->edge->a, pair.sat->edge->b, true};
  }
  if (pair.manifolds.empty() || pair.manifolds.front().axis != "edge_edge") return std::nullopt;
  if (pair.manifolds.front().points.empty()) return std::nullopt;
  const std::string& id = pair.manifolds.front().points.front().id;
  const std::optional<int> of_a = edge_in_id(id, "a:e"), of_b = edge_in_id(id, "b:e");
  if (!of_a || !of_b) return std::nullopt;
  return DecidingEdges{*of_a, *of_b, false};
}

void draw_deciding_edges(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const std::optional<DecidingEdges> edges = deciding_edges(pair);
  if (!edges) return;
  sketch.explain(kDecidingEdgesSwatch, "edges that make the axis");
  for (const auto& [name, edge] : {std::pair{&pair.a, edges->a}, {&pair.b, edges->b}}) {
    const auto ends = scene.edge(*name, edge);
    if (!ends) continue;
    const auto& [from, to] = *ends;
    if (!edges->drawn) sketch.line(from, to, {5.0f, kAxis});
    // At the end that is nearer to the eye, where the other edge is not.
    const bool first = scene.camera.to_camera(from).z() < scene.camera.to_camera(to).z();
    const Vec3d& near = first ? from : to;
    sketch.label(near, "edge " + std::to_string(edge), kAxisText, 16, 9,
                 Vec3d(near - 0.5 * (from + to)));
  }
}

}  // namespace

const LayerDrawing kSatAxesLayer{
    .needs = {&trace::Stages::sat},
    .search = [](const Scene& scene, const trace::Pair& pair,
                 Sketch& sketch) { draw_axes(scene, pair, true, sketch); },
};

const LayerDrawing kContactAxisLayer{
    .needs = {&trace::Stages::sat},
    .search =
        [](const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
          draw_axes(scene, pair, false, sketch);
          draw_deciding_edges(scene, pair, sketch);
        },
};

}  // namespace contactscope::draw
