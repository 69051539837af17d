#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "study/stacked_pair.h"

namespace contactscope {

/// One way to drive a contact to where numbers run out.
struct LimitSweep {
  std::string name;       // "tilt"
  std::string parameter;  // "tilt (rad)": what its values are
  double low = 1, high = 1;
  std::vector<PairKind> kinds;  // that it has a meaning for

  /// Two a decade from low to high, both included.
  std::vector<double> values() const;
};

/// tilt, scale, distance from the origin, aspect ratio, angle between edges, kiss to coincidence.
const std::vector<LimitSweep>& limit_sweeps();

/// A case of a sweep at a value: how the shapes stand, and where in the world.
struct LimitCase {
  StackedPair pair;
  Pose<double> motion;
};

/// The same for the same seed. Overlap a hundredth of the way to coincidence, 5 sizes from the
/// origin, but for what the sweep changes; in even cases of "angle" a tenth of what the angle lifts
/// the ends, so that the edges make the contact.
LimitCase limit_case(const LimitSweep& sweep, double value, const PairKind& kind, int index,
                     std::uint64_t seed);

/// A generator for one case at two values > 0: neighbours share nothing.
std::mt19937_64 case_engine(std::uint64_t seed, int index, double one, double other);

/// Turned at random, that far from the origin, metres.
Pose<double> world_motion(double distance, std::mt19937_64& engine);

}  // namespace contactscope
