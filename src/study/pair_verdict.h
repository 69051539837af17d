#pragma once

#include <optional>

#include "study/stacked_pair.h"

namespace contactscope {

/// What can be wrong with a contact, the worst first.
enum class ContactFault {
  None,
  NotFinite,  // a number is infinite or not one
  Missing,    // the shapes overlap by more than rounding, and there is no point
  Phantom,    // they are apart by more than rounding, and there is one
  Imprecise,  // depth or normal are off by more than kPrecisionBound
  Drifting,   // with the preference on, the depth is off by more than the preference grants
  Drowned,    // none of these, but the depth is off by half of itself or there is no contact: the
              // overlap is no larger than the rounding of the coordinates that it is made of
};

/// "missing"
const char* to_string(ContactFault fault);

/// Error of depth and normal that counts as rounding: in units of the scalar's epsilon times the
/// coordinates of the pair (SeparationOracle::scale). Twice what the pipeline grants its own
/// clipping (depth_rounding in query/tolerance.h).
inline constexpr double kPrecisionBound = 64;

/// One contact, judged twice. Lengths in metres.
struct PairVerdict {
  // Against the shapes and poses as the scalar holds them: what the pipeline itself loses.
  ContactFault fault = ContactFault::None;
  // The larger one of the depth's, and of what the depth along the normal falls short of it (over
  // SeparationOracle::leverage); 0 where rightly apart.
  double error = 0;
  double ulps = 0;     // the same over epsilon times the coordinates of the pair
  double overlap = 0;  // of what the scalar holds, >= 0
  // Against the geometry before it was moved and rounded: what is left of it.
  bool lost = false;           // no contact where there was one, or its depth off by half
  double unrounded_error = 0;  // of the depth
  double unrounded_ulps = 0;
  double depth = 0;  // true overlap before rounding, >= 0
  double scale = 0;  // coordinates of the pair, SeparationOracle::scale
};

/// Moves the pair, rounds it to S, collides it without a preference, and once more with one, which
/// must find the same within what it may prefer. `exact` is the separation before.
template <class S>
PairVerdict judge_pair(const StackedPair& pair, const Pose<double>& motion, double exact);

/// Separation of a pair as it stands, by the oracle.
double exact_separation(const StackedPair& pair);

/// A pair as S holds it, ready to be collided many times.
template <class S>
struct RoundedPair {
  Shape<S> a, b;
  Pose<S> pose_a, pose_b;

  RoundedPair(const StackedPair& pair, const Pose<double>& motion);
  /// Deepest separation of the contact; +infinity without one.
  double collide_once() const;
};

}  // namespace contactscope
