#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "study/stacked_pair.h"
#include "study/study.h"

namespace contactscope {

/// One way to drive a contact to where numbers run out.
struct StabilitySweep {
  std::string name;       // "tilt"
  std::string parameter;  // "tilt (rad)": what its values are
  double low = 1, high = 1;
  std::vector<PairKind> kinds;  // that it has a meaning for

  /// Two a decade from low to high, both included.
  std::vector<double> values() const;
};

/// tilt, scale, distance from the origin, aspect ratio, angle between edges, kiss to coincidence.
const std::vector<StabilitySweep>& stability_sweeps();

/// A case of a sweep at a value: how the shapes stand, and where in the world.
struct StabilityCase {
  StackedPair pair;
  Pose<double> motion;
};

/// The same for the same seed. Overlap a hundredth of the way to coincidence, 5 sizes from the
/// origin, but for what the sweep changes; in even cases of "angle" a tenth of what the angle lifts
/// the ends, so that the edges make the contact.
StabilityCase stability_case(const StabilitySweep& sweep, double value, const PairKind& kind,
                             int index, std::uint64_t seed);

/// A generator for one case at two values > 0: neighbours share nothing.
std::mt19937_64 case_engine(std::uint64_t seed, int index, double one, double other);

/// Turned at random, that far from the origin, metres.
Pose<double> world_motion(double distance, std::mt19937_64& engine);

/// Where the pipeline's numbers run out, in float and in double. Every contact is judged against the
/// separation oracle twice: of the shapes and poses as the scalar holds them (what the pipeline
/// loses: "float", "double"), and of the geometry before it was moved to its place in the world and
/// rounded (what is left of it: "float, unrounded" ..). Faults are counted as failures: numbers that
/// are not finite, missing and phantom contacts, depth or normal off by more than 64 roundings, and
/// overlaps that drown in less than that (pair_verdict.h); of the unrounded ones contacts that are lost,
/// or off by half their depth.
///
/// "sweeps": curves of the largest error over all kinds of pairs, over the size of the shapes.
/// "pairs": maps of pair kind by scale, distance and overlap, in ulps of the pair's coordinates.
/// "tilt_scale", "distance_overlap", "aspect_angle": maps of two parameters, likewise.
std::vector<trace::Study> study_stability(const StudyOptions& options,
                                          const StudyProgress& progress);

}  // namespace contactscope
