#include "peers/peer.h"

#include <algorithm>

#include "geometry/primitives.h"

namespace contactscope::peers {

PeerShape shape_of(const Hull<double>& hull) {
  if (hull.vertex_count() != 8 || hull.face_count() != 6) return hull;
  const Vec3d half = hull.vertices[7];
  if (half.minCoeff() <= 0 || make_box(half).vertices != hull.vertices) return hull;
  return Box{half};
}

PeerShape shape_of(const Shape<double>& shape) {
  if (const auto* sphere = std::get_if<Sphere<double>>(&shape)) return *sphere;
  if (const auto* capsule = std::get_if<Capsule<double>>(&shape)) return *capsule;
  if (const auto* hull = std::get_if<Hull<double>>(&shape)) return shape_of(*hull);
  if (const auto* half_space = std::get_if<HalfSpace<double>>(&shape)) return *half_space;
  return std::make_shared<const Mesh<double>>(std::get<Mesh<double>>(shape));
}

Pose<double> capsule_frame(const Capsule<double>& capsule, const Vec3d& axis) {
  const Vec3d along = capsule.points[1] - capsule.points[0];
  return {Quatd::FromTwoVectors(axis, along), 0.5 * (capsule.points[0] + capsule.points[1])};
}

double capsule_length(const Capsule<double>& capsule) {
  return (capsule.points[1] - capsule.points[0]).norm();
}

const PeerPoint* PeerContact::deepest() const {
  const auto found = std::min_element(points.begin(), points.end(),
                                      [](const PeerPoint& left, const PeerPoint& right) {
                                        return left.separation < right.separation;
                                      });
  return found == points.end() ? nullptr : &*found;
}

bool PeerContact::touching() const { return !points.empty() && deepest()->separation <= 0; }

std::vector<std::unique_ptr<Peer>> make_peers() {
  std::vector<std::unique_ptr<Peer>> result;
  result.push_back(make_bullet());
  result.push_back(make_ode());
  result.push_back(make_fcl());
  return result;
}

}  // namespace contactscope::peers
