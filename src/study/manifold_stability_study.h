#pragma once

#include <vector>

#include "core/pose.h"

namespace contactscope {

/// How a box comes to rest on a floor.
enum class Landing { Drop, Tilt, Slide };

/// A box on a floor, thrown by the study; all lengths in metres. `parameter`: of a drop the height
/// that a level box falls from, of a tilt the angle in radians by which it lands on an edge, of a
/// slide the speed in metres a second of a level box.
struct LandingCase {
  Landing landing = Landing::Drop;
  double parameter = 0;
  Vec3d half_extents = Vec3d(0.5, 0.5, 0.5);
  double yaw = 0;  // radians
};

/// What became of it.
struct LandingOutcome {
  int frames_to_stable = 0;  // from the first with contact, which counts; 0: never
  /// Degrees that the motion cannot have by symmetry, at most: of drops any, of tilts about the
  /// normal, of slides about the normal or the way.
  double rotation = 0;
  /// How far the middle of the contact points has moved in the box, summed over the frames and
  /// over the largest half extent of the box's bottom.
  double wander = 0;
  std::vector<Pose<float>> poses;  // of the box, a frame
};

enum class LandingMethod { OneShot, ByDistance, ByIds };

/// Runs one case for `frames` of a 60th of a second, in float: gravity, friction 0.6, ten
/// iterations, Baumgarte, warm starting, and the slop of solver_stack.h: without one, contacts would
/// be pushed out and lost whatever made them. No speculative margin: frames count from the touch.
LandingOutcome land(const LandingCase& landing, LandingMethod method, int frames);

}  // namespace contactscope
