#include <cstdlib>

#include "draw/layers/layer.h"
#include "draw/scene/measure.h"
#include "draw/scene/quantity.h"
#include "draw/scene/swatches.h"

/// Gregorius 2015, "Hull vs Hull: The Separating Axis Test": layer sat_axes shows the best axis of
/// each query, layer contact_axis the one that was chosen, and the edges that it is made by.
namespace contactscope::draw {
namespace {

constexpr double kBesideWhisker = 44;  // pixels

constexpr Swatch kClosestPointsSwatch{LegendGroup::Axes, 3,
                                      [](const SwatchPen& pen) { pen.dot(0, 4.0, kAxisText); }};

/// From the support point towards the plane it is measured from, as long as the separation.
struct Separation {
  Vec3d from, to;
  Vec3d aside = Vec3d::Zero();  // to where it is drawn
  double metres = 0;
  const char* name = "";
  bool chosen = false;
};

/// The best axis of a query on faces, whose separation is measured along the face's outward normal:
/// that of B opposes the axis.
struct FaceQuery {
  const trace::FaceAxis& axis;
  bool of_a;
  bool chosen;
};

std::vector<FaceQuery> face_queries(const trace::Sat& sat, bool all) {
  std::vector<FaceQuery> queries;
  for (const bool of_a : {true, false}) {
    const auto& axis = of_a ? sat.face_a : sat.face_b;
    const bool chosen = sat.chosen == (of_a ? "face_a" : "face_b");
    if (axis && (all || chosen)) queries.push_back({*axis, of_a, chosen});
  }
  return queries;
}

bool shows_edges(const trace::Sat& sat, bool all) {
  return sat.edge && (all || sat.chosen == "edge_edge");
}

// Beside its line where the contact's own whisker and normal are on it, as drawings put measures.
Separation separation_of(const Scene& scene, const Vec3d& support, const Vec3d& normal,
                         double metres, const char* name, bool all, bool chosen) {
  const double factor = metres > 0 ? 1.0 : scene.depth_factor;
  Separation separation{support, support - factor * metres * normal, Vec3d::Zero(), metres, name,
                        chosen};
  if (chosen && metres < 0 && !all && scene.shows(Layer::Contacts)) {
    Vec3d aside = scene.camera.to_eye(support).cross(normal);
    if (aside.dot(scene.camera.right()) < 0) aside = -aside;
    if (!aside.isZero()) aside.normalize();
    separation.aside =
        aside * (kBesideWhisker * scene.scales.pixel / scene.camera.pixels_per_metre(support));
  }
  return separation;
}

Separation separation_of(const Scene& scene, const FaceQuery& query, bool all) {
  const trace::FaceAxis& axis = query.axis;
  return separation_of(scene, axis.support, query.of_a ? axis.normal : Vec3d(-axis.normal),
                       axis.separation, query.of_a ? "face of A" : "face of B", all, query.chosen);
}

Separation separation_of(const Scene& scene, const trace::Sat& sat, bool all) {
  return separation_of(scene, sat.edge->point_b, sat.edge->normal, sat.edge->separation, "edges",
                       all, sat.chosen == "edge_edge");
}

void draw_separation(const Scene& scene, const Separation& separation, Sketch& sketch) {
  const auto& [from, to, aside, metres, name, chosen] = separation;
  if (!aside.isZero()) {
    for (const Vec3d& end : {from, to}) sketch.line(end, end + 1.15 * aside, {1.2f, kAxis});
  }
  const Vec3d begin = from + aside, end = to + aside;
  draw_measure(scene, begin, end, chosen ? 3.5f : 2.0f, sketch);
  const std::string note = !chosen ? "" : metres > 0 ? ", the gap" : ", chosen";
  const std::string text = std::string(name) + ": " + spell_length(metres) + note;
  sketch.label(0.5 * (begin + end), text, kAxisText, chosen ? 18.0f : 15.0f, 17).bold = chosen;
}

void draw_axes(const Scene& scene, const trace::Pair& pair, bool all, Sketch& sketch) {
  if (!pair.sat) return;
  const trace::Sat& sat = *pair.sat;
  for (const FaceQuery& query : face_queries(sat, all)) {
    const PlacedShape* shape = scene.find(query.of_a ? pair.a : pair.b);
    if (shape == nullptr) continue;
    sketch.face(shape->polygon(query.axis.face), with_alpha(kAxis, query.chosen ? 0.30f : 0.14f),
                {query.chosen ? 2.5f : 1.5f, kAxis});
    draw_separation(scene, separation_of(scene, query, all), sketch);
  }
  if (!shows_edges(sat, all)) return;
  const bool chosen = sat.chosen == "edge_edge";
  for (const auto& [name, edge] : {std::pair{&pair.a, sat.edge->a}, {&pair.b, sat.edge->b}}) {
    const PlacedShape* shape = scene.find(*name);
    const auto ends = shape == nullptr ? std::nullopt : shape->edge(edge);
    if (ends) sketch.line((*ends)[0], (*ends)[1], {chosen ? 5.0f : 3.5f, kAxis});
  }
  if (chosen) {
    sketch.mark(MarkKind::Node, sat.edge->point_a, kAxisText);
    sketch.mark(MarkKind::Node, sat.edge->point_b, kAxisText);
  }
  draw_separation(scene, separation_of(scene, sat, all), sketch);
}

std::string words(const Scene& scene, const trace::Pair& pair, bool all) {
  if (pair.state == "separated") {
    return all && !pair.sat->edge ? "separating axis and gap; it ended the test"
                                  : "separating axis and gap";
  }
  return (all ? "best axis of a query, its overlap" : "chosen axis, its overlap") +
         spell_factor(scene.depth_factor);
}

void explain_axes(const Scene& scene, const trace::Pair& pair, bool all, Legend& legend) {
  if (!pair.sat) return;
  const trace::Sat& sat = *pair.sat;
  const auto explain = [&](const Separation& separation) {
    explain_measure(scene, separation.from + separation.aside, separation.to + separation.aside,
                    words(scene, pair, all), legend);
  };
  for (const FaceQuery& query : face_queries(sat, all)) {
    if (scene.find(query.of_a ? pair.a : pair.b) != nullptr)
      explain(separation_of(scene, query, all));
  }
  if (!shows_edges(sat, all)) return;
  if (sat.chosen == "edge_edge")
    legend.explain(kClosestPointsSwatch, "closest points of the edges");
  explain(separation_of(scene, sat, all));
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
  for (const auto& [name, edge] : {std::pair{&pair.a, edges->a}, {&pair.b, edges->b}}) {
    const PlacedShape* shape = scene.find(*name);
    const auto ends = shape == nullptr ? std::nullopt : shape->edge(edge);
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
    .explain = [](const Scene& scene, const trace::Pair& pair,
                  Legend& legend) { explain_axes(scene, pair, true, legend); },
};

const LayerDrawing kContactAxisLayer{
    .needs = {&trace::Stages::sat},
    .search =
        [](const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
          draw_axes(scene, pair, false, sketch);
          draw_deciding_edges(scene, pair, sketch);
        },
    .explain =
        [](const Scene& scene, const trace::Pair& pair, Legend& legend) {
          explain_axes(scene, pair, false, legend);
          if (deciding_edges(pair))
            legend.explain(kDecidingEdgesSwatch, "edges that make the axis");
        },
};

}  // namespace contactscope::draw
