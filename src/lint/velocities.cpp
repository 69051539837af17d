#include "lint/watch.h"
#include "trace/find.h"

namespace contactscope::lint {
namespace {

/// A wrong meaning of a velocity; right are metres or radians per second in the world.
struct Other {
  const char *cause, *what, *remedy;
  double factor = 1;  // from the record to what is meant
  enum class In { World, Step, Body } in = In::World;

  Vec3d meant(const Vec3d& record, const Quat<double>& rotation, double step) const {
    const Vec3d scaled = factor * record;
    if (in == In::Body) return rotation * scaled;
    return in == In::Step ? Vec3d(scaled / step) : scaled;
  }
};

constexpr const char* kOfTheBody = "rotate them by the rotation of the body: they are in the world";
constexpr double kDegree = std::numbers::pi / 180;
constexpr Other kVelocities[] = {
    {"velocities_negated", "velocities point backward", "negate them", -1},
    {"velocities_of_a_step", "velocities are in metres per step",
     "divide them by the time of a step", 1, Other::In::Step},
    {"velocities_in_centimetres", "velocities are in centimetres per second", "divide them by 100",
     0.01},
    {"velocities_in_millimetres", "velocities are in millimetres per second", "divide them by 1000",
     0.001},
    {"velocities_in_frame_of_body", "velocities are in the frame of the body", kOfTheBody, 1,
     Other::In::Body},
};
constexpr Other kSpins[] = {
    {"spins_negated", "angular velocities turn backward", "negate them", -1},
    {"spins_in_degrees", "angular velocities are in degrees per second",
     "multiply them by pi / 180", kDegree},
    {"spins_of_a_step", "angular velocities are in radians per step",
     "divide them by the time of a step", 1, Other::In::Step},
    {"spins_in_frame_of_body", "angular velocities are in the frame of the body", kOfTheBody, 1,
     Other::In::Body},
};

/// Compares reported velocities with displacements, and finds a common cause of most differences.
template <std::size_t Count> class Readings {
 public:
  Readings(const Other (&others)[Count], const char* name, const char* unit)
      : others_(others), name_(name), unit_(unit) {}

  /// `moved`: velocities by displacement, from the previous frame and to the next.
  void see(const Moments& frames, const std::string& body, const Vec3d& record,
           const std::array<Vec3d, 2>& moved, const Quat<double>& rotation, double step) {
    const auto fits = [&](const Vec3d& velocity) {
      return std::ranges::any_of(moved, [&](const Vec3d& offset) {
        return (velocity - offset).norm() <= kAlike * offset.norm();
      });
    };
    ++wrong_.of;
    if (fits(record)) return;
    wrong_.wrong(frames, body, "", [&] {
      return std::pair(std::string(name_) + " " + spelled(record) + " " + unit_,
                       "to the next frame, the poses give " + spelled(moved[1]));
    });
    for (std::size_t i = 0; i < Count; ++i)
      explained_[i] += fits(others_[i].meant(record, rotation, step));
  }

  /// Contacts stop bodies and solvers push them, so only report what happens almost everywhere.
  void report(std::vector<Finding>& findings) {
    constexpr int kFewest = 5;
    for (std::size_t i = 0; i < Count; ++i)
      if (explained_[i] > 0.7 * wrong_.count && explained_[i] > 0.5 * wrong_.of) {
        wrong_.cause = others_[i].cause;
        return wrong_.report(findings, others_[i].what, others_[i].remedy, kFewest, 0.5);
      }
  }

 private:
  static constexpr double kAlike = 0.25;

  const Other (&others_)[Count];
  const char *name_, *unit_;
  Tally wrong_{"", "poses"};
  std::array<int, Count> explained_{};
};

class VelocitiesWatch final : public Watch {
 public:
  void see(const Solids& solids, const Moments& frames) override {
    if (!frames.now->solver || frames.before == nullptr || frames.after == nullptr) return;
    const double step = frames.after->time - frames.now->time;
    const double last = frames.now->time - frames.before->time;
    if (!(step > 0) || !(last > 0)) return;
    for (const trace::Body& body : frames.now->solver->bodies) {
      const auto before = place(solids, frames.before, body.name, {});
      const auto now = place(solids, frames.now, body.name, {});
      const auto after = place(solids, frames.after, body.name, {});
      if (!before || !now || !after) continue;
      const std::array<Vec3d, 2> measured = {(now->middle() - before->middle()) / last,
                                             (after->middle() - now->middle()) / step};
      constexpr double kMoving = 0.2,
                       kTurning = 0.5;  // metres and radians per second: more than solvers correct
      if (std::ranges::all_of(measured,
                              [](const Vec3d& offset) { return offset.norm() > kMoving; }))
        velocities_.see(frames, body.name, body.velocity, measured, now->pose.rotation, step);
      const std::array<Vec3d, 2> turns = {turn(before->pose, now->pose) / last,
                                          turn(now->pose, after->pose) / step};
      if (std::ranges::all_of(turns, [](const Vec3d& offset) { return offset.norm() > kTurning; }))
        spins_.see(frames, body.name, body.angular_velocity, turns, now->pose.rotation, step);
    }
  }

  void report(std::vector<Finding>& findings) override {
    velocities_.report(findings);
    spins_.report(findings);
  }

 private:
  /// Axis times radians, world.
  static Vec3d turn(const Pose<double>& from, const Pose<double>& to) {
    const Eigen::AngleAxisd by(to.rotation * from.rotation.conjugate());
    constexpr double kHalf = std::numbers::pi;
    return by.axis() * (by.angle() > kHalf ? by.angle() - 2 * kHalf : by.angle());
  }

  Readings<std::size(kVelocities)> velocities_{kVelocities, "velocity", "m/s"};
  Readings<std::size(kSpins)> spins_{kSpins, "angular velocity", "rad/s"};
};

/// Cosine to the normal; larger ones are no rounding of a perpendicular.
constexpr double kAcross = 0.1;
/// Upper limit of friction coefficients: rubber on rubber has 1.2, games use at most 2.
constexpr double kMaxFriction = 4;
/// Relative to the manifold's normal impulse; smaller impulses are noise.
constexpr double kSome = 1e-3;
/// Metres per second; faster sliding continues in the next frame.
constexpr double kSliding = 0.2;

/// Friction is perpendicular to the normal, bounded by the normal impulse, and opposes sliding.
class FrictionWatch final : public Watch {
 public:
  void see(const Solids& solids, const Moments& frames) override {
    for (const trace::Pair& pair : frames.now->pairs) {
      for (const trace::Manifold& manifold : pair.manifolds) {
        double normal = 0, along = 0;
        Vec3d friction = Vec3d::Zero();
        const trace::Point* deepest = nullptr;
        for (const trace::Point& point : manifold.points) {
          if (!point.impulse) continue;
          normal += std::abs(point.impulse->normal);
          friction += point.impulse->friction;
          along += std::abs(point.impulse->friction.dot(manifold.normal));
          if (deepest == nullptr || point.impulse->normal > deepest->impulse->normal)
            deepest = &point;
        }
        if (deepest == nullptr || !(normal > 0)) continue;
        ++along_.of;
        if (along > kAcross * normal)
          along_.wrong(frames, pair.a, pair.b, [&] {
            return std::pair(
                "friction " + spelled(friction) + " N s, normal " + spelled(manifold.normal),
                "along the normal it is " + shown(friction.dot(manifold.normal)) +
                    " N s, the normal impulse is " + shown(normal) + " N s");
          });
        const Vec3d across = friction - friction.dot(manifold.normal) * manifold.normal;
        ++beyond_.of;
        if (across.norm() > kMaxFriction * normal)
          beyond_.wrong(frames, pair.a, pair.b, [&] {
            return std::pair("friction of " + shown(across.norm()) + " N s",
                             "the normal impulse is " + shown(normal) + " N s");
          });
        if (across.norm() > kSome * normal)
          see_sliding(solids, frames, pair, manifold, *deepest, across);
      }
    }
  }

  void report(std::vector<Finding>& findings) override {
    along_.report(findings, "friction has a part along the normal",
                  "subtract it: friction - (friction . normal) normal; maybe friction holds the "
                  "whole impulse",
                  kFewest, 0.2);
    beyond_.report(findings, "friction is many times the normal impulse",
                   "both are impulses over the step, in newton seconds: check their units", kFewest,
                   0.2);
    forward_.report(
        findings, "friction accelerates the sliding",
        "negate it: friction acts on b, as the normal impulse does, against the velocity "
        "of b relative to a",
        kFewestSliding, 0.8);
  }

 private:
  static constexpr int kFewest = 3;
  static constexpr int kFewestSliding = 6;  // a body that rolls is pushed forwards now and then

  void see_sliding(const Solids& solids, const Moments& frames, const trace::Pair& pair,
                   const trace::Manifold& manifold, const trace::Point& point,
                   const Vec3d& friction) {
    if (frames.after == nullptr) return;
    const auto velocity = [&](const trace::Frame* frame, const std::string& shape) {
      const trace::Body* const body = trace::find_body(*frame, solids.body_of(shape));
      if (body == nullptr) return Vec3d(Vec3d::Zero());
      return Vec3d(body->velocity +
                   body->angular_velocity.cross(point.position - body->center_of_mass));
    };
    const auto sliding_in = [&](const trace::Frame* frame) {
      const Vec3d all = velocity(frame, pair.b) - velocity(frame, pair.a);
      return Vec3d(all - all.dot(manifold.normal) * manifold.normal);
    };
    const Vec3d sliding = sliding_in(frames.now);
    // A body that rocks turns round within the step: friction opposes what it does after that.
    const double continued = sliding.dot(sliding_in(frames.after));
    if (sliding.norm() < kSliding || continued < sliding.squaredNorm() / 2) return;
    const double cosine = sliding.dot(friction) / (sliding.norm() * friction.norm());
    constexpr double kClear = 0.7;
    if (std::abs(cosine) < kClear) return;
    ++forward_.of;
    if (cosine > 0)
      forward_.wrong(frames, pair.a, pair.b, [&] {
        return std::pair("friction " + spelled(friction) + " N s",
                         "relative to a, b slides with " + spelled(sliding) + " m/s");
      });
  }

  Tally along_{"friction_along_normal", "manifolds"},
      beyond_{"friction_beyond_normal", "manifolds"}, forward_{"friction_on_a", "manifolds"};
};

}  // namespace

std::unique_ptr<Watch> watch_velocities() { return std::make_unique<VelocitiesWatch>(); }

std::unique_ptr<Watch> watch_friction() { return std::make_unique<FrictionWatch>(); }

}  // namespace contactscope::lint
