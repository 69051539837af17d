#include "draw/scene/camera.h"

#include "draw/scene/points.h"

namespace contactscope::draw {
namespace {

// Near plane, as a fraction of the distance from eye to target. It is close enough that the
// picture's border crops a floor under the camera before this plane does.
constexpr double kNearFraction = 0.02;

// Pixels outside the picture beyond which rounding of a cut at another border does not matter.
constexpr double kSideGap = 1;

Point2 mix2(const Point2& a, const Point2& b, double t) {
  return pixel(a.x + t * (b.x - a.x), a.y + t * (b.y - a.y));
}

/// Distances to the left, right, upper and lower border of a rectangle; negative outside.
std::array<double, 4> distances(const Rect& r, const Point2& p) {
  return {p.x - r.x, r.right() - p.x, p.y - r.y, r.bottom() - p.y};
}

}  // namespace

Camera::Camera(const Vec3d& eye, const Vec3d& target, const Vec3d& up, const Rect& viewport,
               bool perspective, double scale)
    : eye_(eye), viewport_(viewport), perspective_(perspective), scale_(scale) {
  const Vec3d forward = (target - eye).normalized();
  Vec3d right = forward.cross(up);
  if (right.norm() <= 1e-6 * up.norm()) {
    // Straight down or up: x stays to the right, as on a map.
    const bool z_up = std::abs(up.z()) > std::abs(up.y());
    right = forward.cross(z_up ? Vec3d::UnitY() : Vec3d(-Vec3d::UnitZ()));
  }
  right.normalize();
  axes_.col(0) = right;
  axes_.col(1) = right.cross(forward);
  axes_.col(2) = forward;
  near_ = kNearFraction * (target - eye).norm();
}

Camera Camera::perspective(const Vec3d& eye, const Vec3d& target, const Vec3d& up,
                           double fov_radians, const Rect& viewport) {
  return {eye, target, up, viewport, true, 0.5 * viewport.height / std::tan(0.5 * fov_radians)};
}

Camera Camera::orthographic(const Vec3d& eye, const Vec3d& target, const Vec3d& up, double height,
                            const Rect& viewport) {
  return {eye, target, up, viewport, false, viewport.height / height};
}

Vec3d Camera::to_eye(const Vec3d& point) const {
  return perspective_ ? Vec3d((eye_ - point).normalized()) : Vec3d(-axes_.col(2));
}

bool Camera::faces(const Vec3d& point, const Vec3d& normal) const {
  return normal.dot(to_eye(point)) > 0;
}

Vec3d key_light(const Camera& camera) {
  return (camera.up() * 1.0 - camera.right() * 0.55 + camera.right().cross(camera.up()) * 0.65)
      .normalized();
}

Vec3d Camera::to_camera(const Vec3d& point) const {
  const Vec3d offset = point - eye_;  // Eigen's product with a transposed matrix is slow
  return {axes_.col(0).dot(offset), axes_.col(1).dot(offset), axes_.col(2).dot(offset)};
}

Point2 Camera::to_pixels(const Vec3d& p) const {
  const double scale = perspective_ ? scale_ / p.z() : scale_;
  return pixel(viewport_.x + 0.5 * viewport_.width + scale * p.x(),
               viewport_.y + 0.5 * viewport_.height - scale * p.y());
}

std::optional<Point2> Camera::project(const Vec3d& point) const {
  const Vec3d p = to_camera(point);
  if (p.z() < near_) return std::nullopt;
  return to_pixels(p);
}

bool Camera::sees(const Vec3d& point) const {
  const std::optional<Point2> at = project(point);
  return at && viewport_.contains(*at);
}

double Camera::pixels_per_metre(const Vec3d& point) const {
  return perspective_ ? scale_ / std::max(to_camera(point).z(), near_) : scale_;
}

std::vector<Vec2d> projected(const Camera& camera, std::span<const Vec3d> points) {
  std::vector<Vec2d> seen;
  for (const Vec3d& p : points)
    if (const std::optional<Point2> at = camera.project(p)) seen.push_back(flat(*at));
  return seen;
}

std::optional<float> seen_distance(const Camera& camera, const Vec3d& a, const Vec3d& b) {
  const std::optional<Point2> from = camera.project(a), to = camera.project(b);
  return from && to ? std::optional(distance(*from, *to)) : std::nullopt;
}

// A point at (x, y, z) in the camera's axes is seen at x / (distance - z). Each point requires
// distance >= z + |x| / (share * tangent of the half angle).
ViewFit fit_view(const std::vector<Vec3d>& points, const Vec3d& towards_eye, const Vec3d& world_up,
                 const std::optional<Vec3d>& target, double half_height, double aspect,
                 double share) {
  const Vec3d across = world_up.cross(towards_eye);
  const Vec3d right =
      across.norm() > 1e-6 ? Vec3d(across.normalized()) : any_perpendicular(towards_eye);
  const Vec3d up = towards_eye.cross(right);
  ViewFit result{target.value_or(center_of(points)), 0};
  for (int round = 0; round < 4; ++round) {
    double distance = 0;
    for (const Vec3d& p : points) {
      const Vec3d q = p - result.target;
      const double side = std::max(std::abs(q.dot(up)) / half_height,
                                   std::abs(q.dot(right)) / (half_height * aspect));
      distance = std::max(distance, q.dot(towards_eye) + side / share);
    }
    result.distance = distance;
    if (target || distance <= 0) return result;
    Eigen::AlignedBox2d seen;
    for (const Vec3d& p : points) {
      const Vec3d q = p - result.target;
      const double depth = std::max(distance - q.dot(towards_eye), 1e-6 * distance);
      seen.extend(Eigen::Vector2d(q.dot(right) / depth, q.dot(up) / depth));
    }
    const Eigen::Vector2d both = seen.min() + seen.max();
    result.target += 0.5 * distance * (both.x() * right + both.y() * up);
  }
  return result;
}

std::vector<Point2> project_polygon(const Camera& camera, const std::vector<Vec3d>& polygon) {
  // Nearly all triangles of a mesh are fully inside or fully outside the picture and need no cut.
  std::vector<Point2> whole;
  whole.reserve(polygon.size());
  std::array<double, 4> most{-kSideGap, -kSideGap, -kSideGap, -kSideGap};  // inside of each border
  bool inside = true;
  for (const Vec3d& p : polygon) {
    const std::optional<Point2> seen = camera.project(p);
    if (!seen) break;
    inside = inside && camera.viewport().contains(*seen);
    const std::array<double, 4> distance = distances(camera.viewport(), *seen);
    for (std::size_t i = 0; i < most.size(); ++i) most[i] = std::max(most[i], distance[i]);
    whole.push_back(*seen);
  }
  if (whole.size() == polygon.size()) {
    if (inside && whole.size() >= 3) return whole;
    if (inside || std::ranges::any_of(most, [](double d) { return d <= -kSideGap; })) return {};
  }
  const std::vector<Vec3d> in_front = clipped(
      mapped(polygon, [&](const Vec3d& p) { return camera.to_camera(p); }),
      [&](const Vec3d& p) { return p.z() - camera.near_distance(); },
      [](const Vec3d& a, const Vec3d& b, double at_a, double at_b) {
        return Vec3d(a + at_a / (at_a - at_b) * (b - a));
      });
  std::vector<Point2> pixels = clip_polygon(
      camera.viewport(), mapped(in_front, [&](const Vec3d& p) { return camera.to_pixels(p); }));
  if (pixels.size() < 3) pixels.clear();
  return pixels;
}

std::vector<Point2> clip_polygon(const Rect& rect, std::vector<Point2> polygon) {
  for (std::size_t border = 0; border < 4; ++border) {
    polygon = clipped(
        polygon, [&](const Point2& p) { return distances(rect, p)[border]; },
        [](const Point2& a, const Point2& b, double at_a, double at_b) {
          return mix2(a, b, at_a / (at_a - at_b));
        });
  }
  return polygon;
}

std::optional<Segment2> clip_segment(const Rect& rect, const Point2& from, const Point2& to) {
  // Most of many segments are off the rectangle.
  if (std::max(from.x, to.x) < rect.x || std::min(from.x, to.x) > rect.right() ||
      std::max(from.y, to.y) < rect.y || std::min(from.y, to.y) > rect.bottom())
    return std::nullopt;
  if (rect.contains(from) && rect.contains(to)) return Segment2{from, to};
  double first = 0, last = 1;
  const std::array<double, 4> at_from = distances(rect, from), at_to = distances(rect, to);
  for (std::size_t border = 0; border < 4; ++border) {
    const double d0 = at_from[border], d1 = at_to[border];
    if (d0 < 0) first = std::max(first, d0 / (d0 - d1));
    if (d1 < 0) last = std::min(last, d0 / (d0 - d1));
  }
  if (first >= last) return std::nullopt;
  return Segment2{mix2(from, to, first), mix2(from, to, last)};
}

std::optional<Segment2> project_segment(const Camera& camera, const Vec3d& from, const Vec3d& to) {
  Vec3d a = camera.to_camera(from);
  Vec3d b = camera.to_camera(to);
  const double near = camera.near_distance();
  if (a.z() < near && b.z() < near) return std::nullopt;
  const auto at_near = [&](const Vec3d& p, const Vec3d& q) {
    return Vec3d(p + (near - p.z()) / (q.z() - p.z()) * (q - p));
  };
  if (a.z() < near) a = at_near(a, b);
  if (b.z() < near) b = at_near(b, a);
  return clip_segment(camera.viewport(), camera.to_pixels(a), camera.to_pixels(b));
}

}  // namespace contactscope::draw
