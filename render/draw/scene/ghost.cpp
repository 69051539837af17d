#include "draw/scene/solid.h"

namespace contactscope::draw {

PlacedShape moved(PlacedShape shape, const Vec3d& pivot, const Vec3d& offset, const Vec3d& turn) {
  const double angle = turn.norm();
  Quatd by = Quatd::Identity();
  if (angle > 0) by = Quatd(Eigen::AngleAxisd(angle, turn / angle));
  const auto place = [&](const Vec3d& point) -> Vec3d {
    return pivot + offset + by * (point - pivot);
  };
  shape.pose.rotation = (by * shape.pose.rotation).normalized();
  shape.pose.position = place(shape.pose.position);
  for (Vec3d& vertex : shape.vertices) vertex = place(vertex);
  return shape;
}

void draw_ghost(const Camera& camera, const PlacedShape& shape, const LineStyle& style,
                Sketch& sketch, const std::optional<Color>& fill) {
  const double radius = shape.traced().radius;
  if (radius > 0) {
    const std::vector<Vec3d> outline = RoundBody{shape.vertices, radius}.outline(camera);
    if (!outline.empty()) sketch.curves.push_back({outline, style, true});
    return;
  }
  const auto front = [&](int face) {
    return face >= 0 && camera.faces(shape.polygon(face).front(), shape.normal(face));
  };
  if (fill) {
    const Vec3d light = key_light(camera);
    for (int f = 0; f < count_of(shape.traced().faces); ++f)
      if (front(f))
        sketch.surfaces.push_back({shape.polygon(f), toned(*fill, shape.normal(f).dot(light)),
                                   kFlatSurface, Surface::Kind::Body});
  }
  for (const ShapeMesh::Edge& edge : shape.mesh->edges) {
    if (front(edge.left) != front(edge.right))
      sketch.line(shape.vertex(edge.from), shape.vertex(edge.to), style);
  }
}

void draw_path(const Scene& scene, const Vec3d& from, const Vec3d& to, double before,
               const LineStyle& style, Sketch& sketch) {
  constexpr double kHead = 12, kMin = 30;  // pixels; a shorter line has no head
  const double length = (to - from).norm();
  if (!(length > 0)) return;
  const Vec3d end = to - std::min(1.0, before / length) * (to - from);
  const std::optional<float> seen = seen_distance(scene.camera, from, end);
  if (!seen || *seen < kMin * scene.scales.pixel) return sketch.line(from, end, style);
  const Vec3d neck = end - kHead * scene.scales.pixel / *seen * (end - from);
  sketch.line(from, neck, style);
  sketch.arrow_head(neck, end, style.width, kHead, style.color);
}

double border_of_ball(const PlacedShape& shape) {
  return shape.traced().type == "sphere" ? shape.traced().radius : 0;
}

}  // namespace contactscope::draw
