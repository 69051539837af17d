#include <algorithm>
#include <cmath>

#include "lint/tally.h"
#include "trace/find.h"

namespace contactscope::lint {
namespace {

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
                "along the normal it is " + metres(friction.dot(manifold.normal)) +
                    " N s, the normal impulse is " + metres(normal));
          });
        const Vec3d across = friction - friction.dot(manifold.normal) * manifold.normal;
        ++beyond_.of;
        if (across.norm() > kMaxFriction * normal)
          beyond_.wrong(frames, pair.a, pair.b, [&] {
            return std::pair("friction of " + metres(across.norm()) + " N s",
                             "the normal impulse is " + metres(normal) + " N s");
          });
        if (across.norm() > kSome * normal)
          see_sliding(solids, frames, pair, manifold, *deepest, across);
      }
    }
  }

  void report(std::vector<Finding>& findings) override {
    along_.report("friction has a part along the normal",
                  "subtract it: friction - (friction . normal) normal; maybe friction holds the "
                  "whole impulse",
                  kFewest, 0.2, findings);
    beyond_.report("friction is many times the normal impulse",
                   "both are impulses over the step, in newton seconds: check their units", kFewest,
                   0.2, findings);
    forward_.report(
        "friction accelerates the sliding",
        "negate it: friction acts on b, as the normal impulse does, against the velocity "
        "of b relative to a",
        kFewestSliding, 0.8, findings);
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

  Tally along_{"friction_along_normal"}, beyond_{"friction_beyond_normal"},
      forward_{"friction_on_a"};
};

}  // namespace

std::unique_ptr<Watch> watch_friction() { return std::make_unique<FrictionWatch>(); }

}  // namespace contactscope::lint
