#pragma once

#include <random>
#include <string>

#include "core/pose.h"
#include "geometry/shape.h"

namespace contactscope {

/// Shapes that stand below and on top in the study of the numbers' limits.
enum class Below { Sphere, Capsule, Box, Plane, Mesh };
enum class OnTop { Sphere, Capsule, Box };

/// A pair of the collision table.
struct PairKind {
  OnTop top;
  Below below;
};

/// "capsule on box"
std::string to_string(const PairKind& kind);

struct Stacking {
  double size = 1;  // metres: about the diameter of the upper shape
  double overlap =
      0.01;              // the way from a kiss (0) to coincident centres (1; of plane and mesh: the
                         // centre in the surface), as a fraction of it
  double tilt = 0;       // radians, of the upper shape about z
  double aspect = 1;     // length of the lower shape along x over its width
  bool crossed = false;  // edges of boxes, or axes of capsules, cross: the lower along x, the upper
  double angle = 0;      // at this angle, radians
};

/// Two shapes whose overlap is known but for rounding in double.
struct StackedPair {
  Shape<double> below, on_top;
  Pose<double> pose_below, pose_on_top;
  double size = 1;  // of the stacking
};

/// One case: the lower shape's surface passes through the origin and looks up along y, there; the upper
/// one's lowest point is beneath by the overlap. Not everything is at the same place in all cases:
/// the upper shape is shifted at random within the middle of the lower one, less the nearer they are to
/// coincidence; boxes and capsules that are neither tilted nor crossed are turned about y in even
/// cases, so that face meets face, and anyhow in odd ones, so that a corner or an end does.
///
/// Spheres of diameter `size`, capsules of 0.6 size across and 1.6 size long, cubes of `size`, a mesh of two
/// triangles, 8 size square for aspect 1; what touches it touches one of them.
StackedPair stacked_pair(const PairKind& kind, const Stacking& stacking, int index,
                         std::mt19937_64& engine);

/// The pair at another place of the world.
StackedPair moved(const StackedPair& pair, const Pose<double>& by);

}  // namespace contactscope
