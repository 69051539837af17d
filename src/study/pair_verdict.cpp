#include "study/pair_verdict.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "manifold/dispatch.h"
#include "study/separation_oracle.h"

namespace contactscope {
namespace {

// query/tolerance.h, preference_tolerance: a share of the depth, and of the smaller hull's radius.
constexpr double kPreferredDepth = 0.05;
constexpr double kPreferredRadius = 0.002;

/// The deepest point of a contact, and the normal of its manifold.
struct Deepest {
  double separation = std::numeric_limits<double>::infinity();
  Vec3d normal = Vec3d::Zero();
  int triangle = -1;
  bool finite = true;

  bool found() const { return separation < std::numeric_limits<double>::infinity(); }
};

template <class S>
Deepest deepest_of(const Manifolds<S>& manifolds) {
  Deepest deepest;
  for (const Manifold<S>& manifold : manifolds) {
    deepest.finite = deepest.finite && manifold.normal.allFinite();
    for (const ContactPoint<S>& point : manifold.points) {
      deepest.finite =
          deepest.finite && point.position.allFinite() && std::isfinite(point.separation);
      if (static_cast<double>(point.separation) >= deepest.separation) continue;
      deepest.separation = static_cast<double>(point.separation);
      deepest.normal = manifold.normal.template cast<double>();
      deepest.triangle = manifold.triangle;
    }
  }
  return deepest;
}

template <class S>
Deepest collided(const RoundedPair<S>& pair, Preference preference) {
  CollideOptions<S> options;
  options.preference = preference;
  Manifolds<S> manifolds;
  collide(pair.a, pair.pose_a, pair.b, pair.pose_b, options, manifolds);
  return deepest_of(manifolds);
}

ContactFault presence_fault(const Deepest& deepest, double separation, double rounding) {
  if (!deepest.finite) return ContactFault::NotFinite;
  if (!deepest.found() && separation < -rounding) return ContactFault::Missing;
  if (deepest.found() && separation > rounding) return ContactFault::Phantom;
  return ContactFault::None;
}

}  // namespace

const char* to_string(ContactFault fault) {
  constexpr const char* kNames[] = {"none",      "not finite", "missing", "phantom",
                                    "imprecise", "drifting",   "drowned"};
  return kNames[static_cast<int>(fault)];
}

template <class S>
RoundedPair<S>::RoundedPair(const StackedPair& pair, const Pose<double>& motion)
    : a(shape_cast<S>(pair.below)), b(shape_cast<S>(pair.on_top)) {
  const StackedPair there = moved(pair, motion);
  pose_a = there.pose_below.template cast<S>();
  pose_b = there.pose_on_top.template cast<S>();
}

template <class S>
double RoundedPair<S>::collide_once() const {
  return collided(*this, Preference::Relative).separation;
}

double exact_separation(const StackedPair& pair) {
  return SeparationOracle(pair.below, pair.pose_below, pair.on_top, pair.pose_on_top).separation();
}

template <class S>
PairVerdict judge_pair(const StackedPair& pair, const Pose<double>& motion, double exact) {
  const RoundedPair<S> rounded(pair, motion);
  const SeparationOracle oracle(rounded.a, rounded.pose_a, rounded.b, rounded.pose_b);
  const double separation = oracle.separation();
  const double ulp = std::numeric_limits<S>::epsilon() * oracle.scale();
  const double rounding = kPrecisionBound * ulp;

  PairVerdict verdict;
  verdict.depth = std::max(0.0, -exact);
  verdict.scale = oracle.scale();
  const Deepest strict = collided(rounded, Preference::None);
  verdict.fault = presence_fault(strict, separation, rounding);
  if (verdict.fault == ContactFault::None) {
    verdict.error = std::max(0.0, -separation);
    if (strict.found()) {
      const double along = oracle.separation_along(strict.normal, strict.triangle);
      verdict.error = std::max(std::abs(strict.separation - separation),
                               std::abs(separation - along) / oracle.leverage());
    }
    if (!(verdict.error <= rounding)) verdict.fault = ContactFault::Imprecise;
  }
  if (verdict.fault == ContactFault::None) {
    const Deepest preferred = collided(rounded, Preference::Relative);
    verdict.fault = presence_fault(preferred, separation, rounding);
    const double granted =
        rounding + std::max(kPreferredDepth * -separation, kPreferredRadius * pair.size);
    if (verdict.fault == ContactFault::None && preferred.found() &&
        !(std::abs(preferred.separation - separation) <= granted)) {
      verdict.fault = ContactFault::Drifting;
    }
  }
  verdict.overlap = std::max(0.0, -separation);
  if (verdict.fault == ContactFault::None && separation < 0) {
    // A depth is judged for itself: along a shape of kilometres 64 roundings are more than it.
    const double off = strict.found() ? std::abs(strict.separation - separation) : -separation;
    if (!(off < 0.5 * -separation)) verdict.fault = ContactFault::Drowned;
  }
  verdict.ulps = verdict.error / ulp;

  verdict.unrounded_error = strict.found() ? std::abs(strict.separation - exact) : verdict.depth;
  verdict.unrounded_ulps = verdict.unrounded_error / ulp;
  const double bearable = verdict.depth > 0 ? 0.5 * verdict.depth : rounding;
  verdict.lost = !strict.finite || (verdict.depth > 0 && !strict.found()) ||
                 !(verdict.unrounded_error <= bearable);
  return verdict;
}

#define CONTACTSCOPE_INSTANTIATE(S) \
  template struct RoundedPair<S>;   \
  template PairVerdict judge_pair<S>(const StackedPair&, const Pose<double>&, double);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
