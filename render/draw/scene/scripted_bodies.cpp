#include "draw/scene/scripted_bodies.h"

#include <algorithm>

namespace contactscope::draw {

std::vector<trace::Body> scripted_bodies(const ShapeMeshes& meshes,
                                         std::span<const trace::Placement> now,
                                         std::span<const trace::Placement> later, double seconds) {
  std::vector<trace::Body> bodies;
  for (const auto& [name, pose] : now) {
    const std::optional<std::size_t> place = meshes.find(name);
    const auto then = std::ranges::find(later, name, &trace::Placement::first);
    if (!place || then == later.end() || seconds == 0) continue;
    const Vec3d& middle = meshes[*place].shape->center_of_mass;
    trace::Body body{.name = name, .center_of_mass = pose.transform(middle)};
    const Eigen::AngleAxisd turn(then->second.rotation * pose.rotation.conjugate());
    body.velocity = (then->second.transform(middle) - body.center_of_mass) / seconds;
    body.angular_velocity = turn.angle() / seconds * turn.axis();
    if (!body.velocity.isZero(0) || turn.angle() != 0) bodies.push_back(std::move(body));
  }
  return bodies;
}

}  // namespace contactscope::draw
