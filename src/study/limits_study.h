#pragma once

#include <random>

#include "geometry/shape.h"

namespace contactscope {

// limit_cases.cpp

/// Shapes of the study of numerical limits; planes and meshes are only lower shapes.
enum class Stacked { Sphere, Capsule, Box, Plane, Mesh };

struct PairKind {
  Stacked top, below;
};

/// "capsule on box"
std::string to_string(const PairKind& kind);

struct Stacking {
  double size = 1;  // metres: approximate diameter of the upper shape
  /// 0: touching; 1: coincident centres (plane and mesh: centre in the surface).
  double overlap = 0.01;
  double tilt = 0;      // radians, of the upper shape about z
  double aspect = 1;    // length of the lower shape along x over its width
  double angle = 0;     // radians between crossed box edges or capsule axes, the lower one along x;
                        // 0: not crossed
  double distance = 5;  // from the world's origin, in sizes
};

/// Two shapes with a known overlap, up to rounding in double.
struct StackedPair {
  Shape<double> below, on_top;
  Pose<double> pose_below, pose_on_top;
  double size = 1;        // as in Stacking
  double separation = 0;  // metres, by the oracle, before moving and rounding
  Pose<double> motion;    // to the pair's pose in the world
};

/// One case: the lower shape's surface passes through the origin with its normal along y; the upper
/// one's lowest point is below it by the overlap. Cases vary: the upper shape is shifted at random
/// near the centre of the lower one, less so towards coincidence. Boxes and capsules that are
/// neither tilted nor crossed turn about y in even cases, so that faces meet, and arbitrarily in
/// odd ones, so that a corner or end meets a face. Both have a random rotation in the world.
///
/// Spheres of diameter `size`, capsules of 0.6 size across and 1.6 size long, cubes of `size`, a
/// mesh of two triangles, 8 size square for aspect 1; contacts are on one triangle.
StackedPair stacked_pair(const PairKind& kind, const Stacking& stacking, int index,
                         std::mt19937_64& engine);

/// Errors of a contact, the worst first.
enum class ContactFault {
  None,
  NotFinite,  // a value is infinite or nan
  Missing,    // overlap exceeds rounding, but there is no point
  Phantom,    // separation exceeds rounding, but there is a point
  Imprecise,  // depth or normal is off by more than kPrecisionBound
  Drifting,   // with the preference, the depth is off by more than it allows
  Drowned,    // otherwise right, but the depth is off by half or the contact is missing: the
              // overlap is within the rounding of its coordinates
};

/// Allowed rounding error of depth and normal, in epsilon times SeparationOracle::scale. Twice what
/// the pipeline allows its own clipping (depth_rounding in query/tolerance.h).
inline constexpr double kPrecisionBound = 64;

/// One contact, compared with two references. Lengths in metres.
struct PairVerdict {
  // For the shapes and poses as the scalar stores them: loss in the pipeline.
  ContactFault fault = ContactFault::None;
  // Maximum of the depth's error and the shortfall of the depth along the normal (over
  // SeparationOracle::leverage); 0 if rightly separated.
  double error = 0;
  double ulps = 0;     // error over epsilon times the pair's coordinates
  double overlap = 0;  // of the rounded shapes, >= 0
  // For the geometry before moving and rounding: total loss.
  bool lost = false;           // contact missing, or depth off by half
  double unrounded_error = 0;  // of the depth
  double unrounded_ulps = 0;
  double depth = 0;  // true overlap before rounding, >= 0
  double scale = 0;  // coordinates of the pair, SeparationOracle::scale
};

/// Moves and rounds the pair, and collides it without and with a preference; both must agree.
template <class S> PairVerdict judge_pair(const StackedPair& pair);

/// A pair in the world as stored in S, ready for repeated collision.
template <class S> struct RoundedPair {
  Shape<S> a, b;
  Pose<S> pose_a, pose_b;

  explicit RoundedPair(const StackedPair& pair);
  /// Deepest separation of the contact; +infinity without one.
  double collide_once() const;
};

// limits_study.cpp

/// A parameter that is driven to the limits of the numbers.
struct LimitSweep {
  std::string name;          // "tilt"
  std::string parameter;     // "tilt (rad)": meaning of its values
  double Stacking::*drives;  // the value that changes
  double low = 1, high = 1;
  std::vector<PairKind> kinds;  // that it applies to

  /// Two per decade from low to high, inclusive.
  std::vector<double> values() const;
};

/// tilt, scale, distance from the origin, aspect ratio, angle between edges, kiss to coincidence.
const std::vector<LimitSweep>& limit_sweeps();

/// A case of a sweep at a value; deterministic for a seed. In even cases of "angle" the overlap is
/// a tenth of the height by which the angle lifts the ends, so that the edges make contact.
StackedPair limit_case(const LimitSweep& sweep, double value, const PairKind& kind, int index,
                       std::uint64_t seed);

}  // namespace contactscope
