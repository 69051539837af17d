#include "draw/scene/solid.h"

#include "draw/scene/points.h"

namespace contactscope::draw {
namespace {

constexpr double kPatchMargin = 0.16;  // share of the shapes' larger extent in the plane
constexpr double kTickSpacing = 15;    // pixels at 720 lines
constexpr double kTickLength = 12;
constexpr LineStyle kSilhouette{2.0f, kShapeEdge, false, LineStyle::Hidden::Faint};
constexpr LineStyle kFeature{1.5f, with_alpha(kShapeEdge, 0.85f), false, LineStyle::Hidden::Faint};
constexpr LineStyle kSmooth{1.0f, with_alpha(kShapeEdge, 0.16f), false, LineStyle::Hidden::Faint};
constexpr LineStyle kTick{1.0f, with_alpha(kShapeEdge, 0.55f), false, LineStyle::Hidden::Faint};

/// Shadow of a convex polyhedron.
ConvexShadow shadow_of(const Camera& camera, const PlacedShape& shape) {
  std::vector<bool> front;
  for (int f = 0; f < count_of(shape.traced().faces); ++f)
    front.push_back(camera.faces(shape.polygon(f).front(), shape.normal(f)));
  ConvexShadow shadow;
  const Vec3d middle = mean_of(shape.vertices), to_eye = camera.right().cross(camera.up());
  const double border = border_of_shadow(camera, middle, shape.mesh->radius);
  Plane<double> behind{to_eye, std::numeric_limits<double>::infinity()};  // the outline
  for (const ShapeMesh::Edge& edge : shape.mesh->edges) {
    if (at(front, edge.left) == (edge.right >= 0 && at(front, edge.right))) continue;
    const Vec3d &p = shape.vertex(edge.from), &q = shape.vertex(edge.to);
    // The plane through the eye and the edge; its normal points away from the body.
    Vec3d side = (q - p).cross(camera.to_eye(p)).normalized();
    if (side.dot(middle - p) > 0) side = -side;
    shadow.bounds.push_back({side, side.dot(p) - border});
    behind.offset = std::min({behind.offset, to_eye.dot(p) - border, to_eye.dot(q) - border});
  }
  shadow.sides = shadow.bounds.size();
  shadow.behind = {behind};
  for (int f = 0; f < count_of(front); ++f) {
    if (!front[static_cast<std::size_t>(f)]) continue;
    const Vec3d normal = shape.normal(f);
    double lowest = std::numeric_limits<double>::infinity();  // faces of a trace need not be flat
    for (const Vec3d& corner : shape.polygon(f)) lowest = std::min(lowest, normal.dot(corner));
    shadow.bounds.push_back({normal, lowest - border});
  }
  shadow.depth = std::numeric_limits<double>::infinity();
  bool in_front = true;  // of the eye
  for (const Vec3d& vertex : shape.vertices) {
    shadow.depth = std::min(shadow.depth, camera.to_camera(vertex).z());
    const std::optional<Point2> seen = camera.project(vertex);
    if (seen) shadow.around.push_back(*seen);
    in_front = in_front && seen;
  }
  if (!in_front) shadow.around.clear();
  return shadow;
}

}  // namespace

std::vector<bool> draw_faces(const Camera& camera, const PlacedShape& shape, const Color& fill,
                             bool both_sides, Sketch& sketch) {
  const Vec3d light = key_light(camera);
  const int faces = count_of(shape.traced().faces);
  std::vector<bool> front;
  front.reserve(static_cast<std::size_t>(faces));
  for (int f = 0; f < faces; ++f) {
    std::vector<Vec3d> polygon = shape.polygon(f);
    const Vec3d normal = shape.normal(f);
    front.push_back(camera.faces(polygon.front(), normal));
    if (!front.back() && !both_sides) continue;
    sketch.occluders.push_back(polygon);
    sketch.surfaces.push_back({std::move(polygon),
                               toned(fill, (front.back() ? 1 : -1) * normal.dot(light)),
                               kFlatSurface, Surface::Kind::Body});
  }
  return front;
}

void draw_solid(const Camera& camera, const PlacedShape& shape, const Color& fill, Sketch& sketch) {
  const std::vector<bool> front = draw_faces(camera, shape, fill, false, sketch);
  for (const ShapeMesh::Edge& edge : shape.mesh->edges) {
    const bool left = at(front, edge.left);
    const bool silhouette = left != (edge.right >= 0 && at(front, edge.right));
    if (edge.smooth && !silhouette && !left) continue;  // hidden facets would only be noise
    sketch.line(shape.vertex(edge.from), shape.vertex(edge.to),
                silhouette    ? kSilhouette
                : edge.smooth ? kSmooth
                              : kFeature);
  }
}

void draw_small_solid(const Camera& camera, const PlacedShape& shape, const Color& fill,
                      Sketch& sketch) {
  const std::size_t occluders = sketch.occluders.size();
  draw_solid(camera, shape, fill, sketch);
  if (sketch.occluders.size() == occluders) return;
  sketch.occluders.resize(occluders);
  sketch.shadows.push_back(shadow_of(camera, shape));
  sketch.shadows.back().opaque = true;
}

void draw_body(const Camera& camera, const RoundBody& body, const Color& fill,
               const LineStyle& outline, Sketch& sketch) {
  const int index = count_of(sketch.bodies);
  for (RoundBody::Facet& facet : body.front(camera))
    sketch.surfaces.push_back(
        {std::move(facet.polygon), toned(fill, facet.lit), index, Surface::Kind::Body});
  const std::vector<Vec3d> around = body.outline(camera);
  if (!around.empty()) {
    sketch.shadows.push_back(body.shadow(camera));
    sketch.shadows.back().body = index;
    sketch.curves.push_back({around, outline, true});
  }
  sketch.bodies.push_back(body);
}

void draw_round(const Camera& camera, const PlacedShape& shape, const Color& fill, Sketch& sketch) {
  constexpr Color kCore = with_alpha(kShapeEdge, 0.6f);
  const RoundBody body{shape.vertices, shape.traced().radius};
  draw_body(camera, body, fill, kSilhouette, sketch);
  if (body.core.size() == 2) sketch.line(body.core[0], body.core[1], {1.0f, kCore, true});
  for (const Vec3d& point : body.core) sketch.mark(MarkKind::Core, point, kCore);
}

void draw_small_round(const Camera& camera, const PlacedShape& shape, const Color& fill,
                      Sketch& sketch) {
  constexpr double kSmall = 40;  // pixels: corners of an outline are not seen
  const double radius = shape.traced().radius;
  const bool small = radius * camera.pixels_per_metre(shape.vertices.front()) < kSmall;
  const std::size_t shadows = sketch.shadows.size();
  draw_body(camera, {shape.vertices, radius, small}, fill, kSilhouette, sketch);
  if (sketch.shadows.size() > shadows) sketch.shadows.back().opaque = true;
}

PatchFit::PatchFit(const trace::HalfSpace& plane, const Pose<double>& pose, const Vec3d& up) {
  const Vec3d normal = pose.rotate(plane.normal);
  const Vec3d across = up.cross(normal);
  // On level ground, u is along the x axis.
  const Vec3d level = across.norm() > 1e-3
                          ? Vec3d(across.normalized())
                          : Vec3d((Vec3d::UnitX() - normal.x() * normal).normalized());
  const Vec3d u = pose.inverse_rotate(level);
  square = {plane.offset * plane.normal, u, plane.normal.cross(u)};
}

void PatchFit::add(const Pose<double>& pose, const std::vector<Vec3d>& points) {
  poses.push_back(pose);
  for (const Vec3d& point : points) {
    const Vec3d p = pose.inverse_transform(point) - square.center;
    found.extend(Eigen::Vector2d(p.dot(square.u), p.dot(square.v)));
  }
}

PlanePatch PatchFit::patch() const {
  PlanePatch patch = square;
  if (found.isEmpty()) return patch;
  const double margin = kPatchMargin * found.sizes().maxCoeff();
  const Eigen::Vector2d middle = found.center(), half = 0.5 * found.sizes();
  patch.center += middle.x() * patch.u + middle.y() * patch.v;
  patch.half_u = half.x() + margin;
  patch.half_v = half.y() + margin;
  return patch;
}

std::vector<Vec3d> patch_corners(const PlanePatch& patch, const Pose<double>& pose) {
  std::vector<Vec3d> corners;
  for (const auto& [u, v] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
    corners.push_back(
        pose.transform(patch.center + u * patch.half_u * patch.u + v * patch.half_v * patch.v));
  return corners;
}

void draw_plane(const Camera& camera, const PlacedShape& shape, const Color& fill, Sketch& sketch) {
  if (!shape.mesh->patch) return;
  const PlanePatch& patch = *shape.mesh->patch;
  const Vec3d normal = shape.pose.rotate(shape.traced().half_space->normal);
  const std::vector<Vec3d> corners = patch_corners(patch, shape.pose);
  const Vec3d center = shape.pose.transform(patch.center);
  const bool outside = camera.faces(center, normal);
  if (outside) {
    sketch.occluders.push_back(corners);
    sketch.surfaces.push_back(
        {corners, toned(fill, normal.dot(key_light(camera))), kFlatSurface, Surface::Kind::Body});
  }
  sketch.outline(corners, kFeature);
  if (!outside) return;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3d& from = corners[i];
    const Vec3d along = corners[(i + 1) % 4] - from;
    const Vec3d outwards = along.cross(normal);
    if (!camera.faces(from + 0.5 * along, outwards)) continue;
    const double length = along.norm();
    const double metres = 1 / camera.pixels_per_metre(from + 0.5 * along);
    const int count = std::clamp(static_cast<int>(length / (kTickSpacing * metres)), 4, 200);
    // Ticks lean to the opposite side of the border.
    const double rise = along.dot(camera.right()) * along.dot(camera.up());
    const Vec3d aside = rise > 0 ? camera.right() : Vec3d(-camera.right());
    const Vec3d tick = kTickLength * metres * (aside - normal);
    for (int k = 1; k <= count; ++k) {
      const Vec3d at = from + along * k / count;
      sketch.line(at, at + tick, kTick);
    }
  }
}

bool in_view(const Camera& camera, const PlacedShape& shape) {
  if (shape.traced().half_space || shape.is_mesh()) return true;
  const auto is_seen = [&](const Vec3d& point) { return camera.sees(point); };
  // Corners first, because the first one is visible if the shape is in the middle of the picture.
  if (std::ranges::any_of(shape.vertices, is_seen)) return true;
  if (std::ranges::any_of(extent_points(shape), is_seen)) return true;
  for (int f = 0; f < count_of(shape.mesh->normals); ++f)
    if (!project_polygon(camera, shape.polygon(f)).empty()) return true;
  return false;
}

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
