#pragma once

#include "core/pose.h"

namespace contactscope {

/// How a box lands on a floor.
enum class Landing { Drop, Tilt, Slide };

/// A box thrown onto a floor, metres. `parameter`: drop height of a level box, tilt angle in
/// radians of one that lands on an edge, or speed in metres per second of one that slides.
struct LandingCase {
  Landing landing = Landing::Drop;
  double parameter = 0;
  Vec3d half_extents = Vec3d(0.5, 0.5, 0.5);
  double yaw = 0;  // radians
};

/// Result of a landing.
struct LandingOutcome {
  int frames_to_stable = 0;  // from the first contact, inclusive; 0: never
  /// Largest rotation in degrees that symmetry excludes: any for drops, about the normal for tilts,
  /// about the normal or the direction for slides.
  double rotation = 0;
  /// Path of the contact points' mean in the box, over the largest half extent of its bottom.
  double wander = 0;
  std::vector<Pose<float>> poses;  // of the box, one per frame
};

enum class LandingMethod { OneShot, ByDistance, ByIds };

/// Runs one case for `frames` of 1/60 s, in float: gravity, friction 0.6, ten iterations,
/// Baumgarte, warm starting, and the slop of solver_stack.h, without which every method would push
/// contacts out and lose them. No speculative margin: frames count from the first touch.
LandingOutcome land(const LandingCase& landing, LandingMethod method, int frames);

}  // namespace contactscope
