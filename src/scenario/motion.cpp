#include <algorithm>

#include "scenario/scenario.h"

namespace contactscope {
namespace {

/// Between keyframes positions are linear and rotations slerp (Shoemake 1985, "Animating Rotation
/// with Quaternion Curves") along the shortest path, at constant angular velocity.
Pose<double> along_keyframes(const std::vector<Keyframe>& keyframes, double time) {
  const auto later = std::ranges::upper_bound(keyframes, time, {}, &Keyframe::time);
  if (later == keyframes.begin()) return keyframes.front().pose;
  const Keyframe& from = *std::prev(later);
  // At a keyframe's time return its exact pose, without rounding of the interpolation.
  if (later == keyframes.end() || time == from.time) return from.pose;
  const double t = (time - from.time) / (later->time - from.time);
  Pose<double> pose{from.pose.rotation.slerp(t, later->pose.rotation),
                    (1 - t) * from.pose.position + t * later->pose.position};
  pose.rotation.normalize();
  return pose;
}

}  // namespace

/// With constant angular velocity w the rotation is exp(w t) R0. It is exact at every time, so no
/// rounding accumulates over frames.
Pose<double> pose_at(const ScenarioShape& shape, double time) {
  const Motion& motion = shape.motion;
  if (!motion.keyframes.empty()) return along_keyframes(motion.keyframes, time);
  Pose<double> pose = shape.pose;
  pose.position += time * motion.velocity;
  const double speed = motion.angular_velocity.stableNorm();  // rad/s
  if (speed > 0) {
    const Vec3d axis = motion.angular_velocity / speed;
    pose.rotation = Quatd(Eigen::AngleAxisd(speed * time, axis)) * shape.pose.rotation;
    pose.rotation.normalize();
  }
  return pose;
}

Pose<double> collider_pose_at(const ScenarioShape& shape, double time) {
  const Pose<double> pose = pose_at(shape, time);
  return shape.is_moved() ? compose(pose, {Quatd::Identity(), shape.collider_origin}) : pose;
}

Pose<double> recorded_pose(const ScenarioShape& shape, double time, const Pose<double>& collider) {
  if (!shape.is_moved()) return collider;
  if (!shape.body) return pose_at(shape, time);
  Pose<double> pose = collider;
  pose.rotation.normalize();
  return compose(pose, {Quatd::Identity(), Vec3d(-shape.collider_origin)});
}

std::optional<std::string> impact_refusal(const ScenarioShape& a, const ScenarioShape& b,
                                          ImpactMethod method) {
  if (a.is_mesh() && b.is_mesh() && (a.deforms() || b.deforms())) {
    if (method == ImpactMethod::TimeOfImpact) return std::nullopt;
    return "only one method handles meshes that deform; set continuous = \"time_of_impact\"";
  }
  for (const ScenarioShape* shape : {&a, &b})
    if (shape->deforms())
      return "'" + shape->name +
             "' deforms between frames, and only pairs of two meshes support that; remove "
             "'continuous', or its motion.deform";
  const auto reason = impact_refusal(kind_of(*a.geometry), kind_of(*b.geometry));
  if (reason) return *reason + "; remove 'continuous'";
  return std::nullopt;
}

}  // namespace contactscope
