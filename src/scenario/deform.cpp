
#include "scenario/scenario.h"

namespace contactscope {
namespace {

/// Only the fractional turns count, so that a sine far along a wave keeps its digits.
double phase_of(double turns) { return 2 * std::numbers::pi * (turns - std::floor(turns)); }

std::vector<Vec3d> deformed(const TravellingWave& wave, const std::vector<Vec3d>& at_rest,
                            double time) {
  return mapped(at_rest, [&](const Vec3d& x) -> Vec3d {
    const double turns = (wave.axis.dot(x) - wave.speed * time) / wave.wavelength;
    return x + wave.amplitude * std::sin(phase_of(turns)) * wave.direction;
  });
}

/// Rodrigues' formula.
std::vector<Vec3d> deformed(const Twist& twist, const std::vector<Vec3d>& at_rest, double time) {
  return mapped(at_rest, [&](const Vec3d& x) -> Vec3d {
    const double along = twist.axis.dot(x);
    const Vec3d foot = along * twist.axis;
    const double angle = twist.rate * time * along;
    return foot + std::cos(angle) * (x - foot) + std::sin(angle) * twist.axis.cross(x);
  });
}

std::vector<Vec3d> deformed(const std::vector<VertexKeyframe>& keyframes,
                            const std::vector<Vec3d>& at_rest, double time) {
  const auto later = std::ranges::upper_bound(keyframes, time, {}, &VertexKeyframe::time);
  if (later == keyframes.begin()) return keyframes.front().vertices;
  const VertexKeyframe& from = *std::prev(later);
  assert(from.vertices.size() == at_rest.size());
  // At a keyframe's time return its exact vertices, without rounding of the interpolation.
  if (later == keyframes.end() || time == from.time) return from.vertices;
  const double share = (time - from.time) / (later->time - from.time);
  std::vector<Vec3d> vertices;
  vertices.reserve(at_rest.size());
  for (int i = 0; i < count_of(at_rest); ++i)
    vertices.emplace_back((1 - share) * at(from.vertices, i) + share * at(later->vertices, i));
  return vertices;
}

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

std::vector<Vec3d> deformed_vertices(const Deformation& deformation,
                                     const std::vector<Vec3d>& at_rest, double time) {
  return std::visit([&](const auto& how) { return deformed(how, at_rest, time); }, deformation);
}

/// With constant angular velocity w the rotation is exp(w t) R0: no rounding accumulates.
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
