#include "draw/scene/core_outline.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "core/plane.h"
#include "draw/scene/scene.h"
#include "draw/scene/view_fit.h"

namespace contactscope::draw {
namespace {

constexpr int kOutlineSteps = 180;
constexpr int kBisections = 40;

struct CoreCorner {
  Vec3d at;
  std::size_t side;  // the face beyond the edge that begins here
};
using CoreFace = std::vector<CoreCorner>;

// Half-space clipping of a convex polygon (Sutherland and Hodgman 1974).
CoreFace clipped_by(const CoreFace& polygon, const Plane<double>& plane, std::size_t side) {
  CoreFace inside;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const CoreCorner& from = polygon[i];
    const Vec3d& to = polygon[(i + 1) % polygon.size()].at;
    const double d0 = plane.distance(from.at), d1 = plane.distance(to);
    if (d0 <= 0) inside.push_back({from.at, d1 > 0 && d0 == 0 ? side : from.side});
    if ((d0 < 0 && d1 > 0) || (d0 > 0 && d1 <= 0)) {
      inside.push_back({from.at + d0 / (d0 - d1) * (to - from.at), d0 < 0 ? side : from.side});
    }
  }
  return inside;
}

const Vec3d& farthest_corner(const std::vector<Vec3d>& corners, const Vec3d& direction) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    if (direction.dot(corners[i]) > direction.dot(corners[best])) best = i;
  }
  return corners[best];
}

}  // namespace

// A core's face is the face moved inwards, within all other planes moved inwards.
CoreSolid core_solid(const PlacedShape& shape, double margin) {
  const trace::Shape& solid = *shape.mesh->shape;
  std::vector<Plane<double>> planes;
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    const Vec3d normal = shape.normal(static_cast<int>(f));
    planes.push_back({normal, normal.dot(shape.polygon(static_cast<int>(f))[0]) - margin});
  }
  CoreSolid core;
  for (std::size_t f = 0; f < planes.size(); ++f) {
    CoreFace face;
    for (const Vec3d& corner : shape.polygon(static_cast<int>(f))) {
      face.push_back({corner - margin * planes[f].normal, f});
    }
    for (std::size_t other = 0; other < planes.size() && !face.empty(); ++other) {
      if (other != f) face = clipped_by(face, planes[other], other);
    }
    for (std::size_t i = 0; face.size() > 2 && i < face.size(); ++i) {
      core.corners.push_back(face[i].at);
      if (face[i].side < f) continue;  // told with the other face
      core.edges.push_back({face[i].at, face[(i + 1) % face.size()].at, f, face[i].side});
    }
  }
  return core;
}

// A surface point is p + radius n, p being the corner that is farthest along the normal n. A view
// ray touches it where n is at right angles to the ray: for an eye e, where the support function
// h(n) + radius equals n . e. In every half-plane about the line of sight there is one such normal,
// found by bisection; all rays of an orthographic camera are parallel, and n is across them.
std::vector<Vec3d> rounded_outline(const std::vector<Vec3d>& corners, double radius,
                                   const Camera& camera) {
  if (corners.empty()) return {};
  const Vec3d middle = center_of(corners);
  const Vec3d sight = camera.to_eye(middle);
  const auto beyond_eye = [&](const Vec3d& normal) {
    return normal.dot(farthest_corner(corners, normal) - camera.eye()) + radius;
  };
  if (camera.is_perspective() && beyond_eye(sight) >= 0) return {};
  const Vec3d u = any_perpendicular(sight);
  const Vec3d v = sight.cross(u);
  std::vector<Vec3d> outline;
  for (int i = 0; i < kOutlineSteps; ++i) {
    const double turn = 2 * std::numbers::pi * i / kOutlineSteps;
    const Vec3d across = std::cos(turn) * u + std::sin(turn) * v;
    double low = -0.5 * std::numbers::pi, high = 0.5 * std::numbers::pi;
    const auto normal_at = [&](double tilt) -> Vec3d {
      return std::cos(tilt) * across + std::sin(tilt) * sight;
    };
    double tilt = 0;
    for (int k = 0; camera.is_perspective() && k < kBisections; ++k) {
      tilt = 0.5 * (low + high);
      (beyond_eye(normal_at(tilt)) > 0 ? low : high) = tilt;
    }
    const Vec3d normal = normal_at(tilt);
    outline.push_back(farthest_corner(corners, normal) + radius * normal);
  }
  return outline;
}

}  // namespace contactscope::draw
