#pragma once

#include <string>

/// Programs of three engines: they step a world, and record it with their adapters.
namespace contactscope::test {

enum class World { Stack, Heap, Chains };

/// Steps a world of so many bodies without a recorder, then records some frames to a file.
/// A stack has boxes, each on the one below. A heap has boxes, spheres, capsules and hulls.
/// Chains, of Bullet alone, have links of boxes that overlap at their joints and do not collide there;
/// each hangs from a fixed point, and starts at an angle.
struct Recording {
  World world = World::Stack;
  int bodies = 5;
  int unrecorded = 60;  // steps
  int frames = 60;
  std::string path{};
};

void record_in_bullet(const Recording& recording);
void record_in_ode(const Recording& recording);
/// If the tests have MuJoCo.
void record_in_mujoco(const Recording& recording);

/// A number from -1 to 1 for the n-th body, along one of the axes: irregular, and always the same.
inline double scattered(int n, int axis) {
  const unsigned mixed = static_cast<unsigned>(n * 3 + axis + 1) * 2654435761u;
  return static_cast<double>(mixed >> 8) / static_cast<double>(1u << 23) - 1;
}

/// Half extents of the n-th body, metres.
inline double half_extent(int n, int axis) { return 0.25 + 0.1 * scattered(n + 1000, axis); }

}  // namespace contactscope::test
