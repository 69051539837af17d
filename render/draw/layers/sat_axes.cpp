#include "draw/scene/palette.h"
#include "draw/scene/quantity.h"
#include "draw/scene/scene.h"

namespace contactscope::draw {
namespace {

constexpr double kAside = 44;  // pixels

std::string legend_text(const Scene& scene, const trace::Pair& pair, bool all_queries) {
  if (pair.state == "separated") {
    return all_queries && !pair.sat->edge ? "separating axis and gap; it ended the test"
                                          : "separating axis and gap";
  }
  return std::string(all_queries ? "best axis of a query, " : "chosen axis, ") +
         (scene.depth_factor == 1 ? "its overlap"
                                  : "its overlap × " + spell_number(scene.depth_factor));
}

// From the support point towards the plane it is measured from, as long as the separation. Beside
// that line where the contact's own whisker and normal are on it, as drawings put measures.
void draw_separation(const Scene& scene, const trace::Pair& pair, const Vec3d& support,
                     const Vec3d& normal, double separation, const std::string& name,
                     bool all_queries, bool chosen, Sketch& sketch) {
  const double factor = separation > 0 ? 1.0 : scene.depth_factor;
  Vec3d from = support, to = support - factor * separation * normal;
  if (chosen && separation < 0 && !all_queries && scene.shows(Layer::Contacts)) {
    Vec3d aside = scene.camera.to_eye(support).cross(normal);
    if (aside.dot(scene.camera.right()) < 0) aside = -aside;
    if (!aside.isZero()) aside.normalize();
    aside *= kAside * scene.scales.pixel / scene.camera.pixels_per_metre(support);
    for (const Vec3d& end : {from, to}) {
      sketch.lines.push_back({end, end + 1.15 * aside, {1.2f, kAxis}});
    }
    from += aside;
    to += aside;
  }
  draw_measure(scene, from, to, chosen ? 3.5f : 2.0f, legend_text(scene, pair, all_queries),
               sketch);
  sketch.labels.push_back({.at = 0.5 * (from + to),
                           .text = name + ": " + spell_length(separation) +
                                   (!chosen          ? ""
                                    : separation > 0 ? ", the gap"
                                                     : ", chosen"),
                           .color = kAxisText,
                           .size = chosen ? 18.0f : 15.0f,
                           .bold = chosen,
                           .clearance = 17,
                           .direction = std::nullopt});
}

void draw_face_axis(const Scene& scene, const trace::Pair& pair, const trace::FaceAxis& axis,
                    bool of_a, bool all_queries, Sketch& sketch) {
  const PlacedShape* shape = scene.find(of_a ? pair.a : pair.b);
  if (shape == nullptr) return;
  const bool chosen = pair.sat->chosen == (of_a ? "face_a" : "face_b");
  const std::vector<Vec3d> polygon = shape->polygon(axis.face);
  sketch.surfaces.push_back({polygon, with_alpha(kAxis, chosen ? 0.30f : 0.14f)});
  sketch.outline(polygon, {chosen ? 2.5f : 1.5f, kAxis});
  // The separation is measured along the face's outward normal, which for B opposes the axis.
  const Vec3d outward = of_a ? axis.normal : Vec3d(-axis.normal);
  draw_separation(scene, pair, axis.support, outward, axis.separation,
                  of_a ? "face of A" : "face of B", all_queries, chosen, sketch);
}

}  // namespace

// Gregorius 2015, "Hull vs Hull: The Separating Axis Test": the best axis of each query.
void draw_sat_axes(const Scene& scene, const trace::Pair& pair, bool all_queries, Sketch& sketch) {
  if (!pair.sat) return;
  const trace::Sat& sat = *pair.sat;
  const auto wanted = [&](const char* axis) { return all_queries || sat.chosen == axis; };
  if (sat.face_a && wanted("face_a"))
    draw_face_axis(scene, pair, *sat.face_a, true, all_queries, sketch);
  if (sat.face_b && wanted("face_b"))
    draw_face_axis(scene, pair, *sat.face_b, false, all_queries, sketch);
  if (sat.edge && wanted("edge_edge")) {
    const bool chosen = sat.chosen == "edge_edge";
    const auto highlight = [&](const std::string& name, int edge) {
      const PlacedShape* shape = scene.find(name);
      if (shape == nullptr || edge < 0) return;
      const std::array<int, 2>& ends = shape->mesh->shape->edges[static_cast<std::size_t>(edge)];
      sketch.lines.push_back({shape->vertices[static_cast<std::size_t>(ends[0])],
                              shape->vertices[static_cast<std::size_t>(ends[1])],
                              {chosen ? 5.0f : 3.5f, kAxis}});
    };
    highlight(pair.a, sat.edge->a);
    highlight(pair.b, sat.edge->b);
    if (chosen) {
      for (const Vec3d& point : {sat.edge->point_a, sat.edge->point_b}) {
        sketch.marks.push_back({MarkKind::Node, point, kAxisText});
      }
      sketch.explain(LegendKind::ClosestPoints, "closest points of the edges");
    }
    draw_separation(scene, pair, sat.edge->point_b, sat.edge->normal, sat.edge->separation, "edges",
                    all_queries, chosen, sketch);
  }
}

}  // namespace contactscope::draw
