#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "core/pose.h"
#include "geometry/shape.h"

namespace contactscope {

// limit_cases.cpp

/// Shapes of the study of the numbers' limits; planes and meshes are only below.
enum class Stacked { Sphere, Capsule, Box, Plane, Mesh };

/// A pair of the collision table.
struct PairKind {
  Stacked top, below;
};

/// "capsule on box"
std::string to_string(const PairKind& kind);

struct Stacking {
  double size = 1;  // metres: about the diameter of the upper shape
  /// The way from a kiss (0) to coincident centres (1; of plane and mesh: the centre in the surface).
  double overlap = 0.01;
  double tilt = 0;    // radians, of the upper shape about z
  double aspect = 1;  // length of the lower shape along x over its width
  double angle = 0;   // radians, at which edges of boxes, or axes of capsules, cross: the lower one
                      // along x; 0: they do not cross
  double distance = 5;  // sizes from the world's origin
};

/// Two shapes whose overlap is known but for rounding in double.
struct StackedPair {
  Shape<double> below, on_top;
  Pose<double> pose_below, pose_on_top;
  double size = 1;        // of the stacking
  double separation = 0;  // metres, by the oracle: before the pair is moved and rounded
  Pose<double> motion;    // to the pair's place in the world
};

/// One case: the lower shape's surface passes through the origin and looks up along y, there; the upper
/// one's lowest point is beneath by the overlap. Not everything is at the same place in all cases:
/// the upper shape is shifted at random within the middle of the lower one, less the nearer they are to
/// coincidence; boxes and capsules that are neither tilted nor crossed are turned about y in even
/// cases, so that face meets face, and anyhow in odd ones, so that a corner or an end does. In the
/// world both are turned at random.
///
/// Spheres of diameter `size`, capsules of 0.6 size across and 1.6 size long, cubes of `size`, a mesh of two
/// triangles, 8 size square for aspect 1; what touches it touches one of them.
StackedPair stacked_pair(const PairKind& kind, const Stacking& stacking, int index,
                         std::mt19937_64& engine);

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
/// must find the same within what it may prefer.
template <class S>
PairVerdict judge_pair(const StackedPair& pair);

/// A pair at its place in the world as S holds it, ready to be collided many times.
template <class S>
struct RoundedPair {
  Shape<S> a, b;
  Pose<S> pose_a, pose_b;

  explicit RoundedPair(const StackedPair& pair);
  /// Deepest separation of the contact; +infinity without one.
  double collide_once() const;
};

// limits_study.cpp

/// One way to drive a contact to where numbers run out.
struct LimitSweep {
  std::string name;          // "tilt"
  std::string parameter;     // "tilt (rad)": what its values are
  double Stacking::*drives;  // what it changes
  double low = 1, high = 1;
  std::vector<PairKind> kinds;  // that it has a meaning for

  /// Two a decade from low to high, both included.
  std::vector<double> values() const;
};

/// tilt, scale, distance from the origin, aspect ratio, angle between edges, kiss to coincidence.
const std::vector<LimitSweep>& limit_sweeps();

/// A case of a sweep at a value, the same for the same seed. In even cases of "angle" the overlap is
/// a tenth of what the angle lifts the ends, so that the edges make the contact.
StackedPair limit_case(const LimitSweep& sweep, double value, const PairKind& kind, int index,
                       std::uint64_t seed);

}  // namespace contactscope
