#pragma once

#include <string>
#include <vector>

#include "dynamics/solver.h"

namespace contactscope {

/// The method of `study solver` that is there to gain energy, and may.
inline constexpr const char* kAllPushKept = "Baumgarte, all of its push kept";

/// A scene whose energy no solver may raise.
struct EnergyScene {
  std::string name;
  World<double> world;
  std::vector<Shape<double>> shapes;
  int frames = 120;  // of a sixtieth of a second
  // Joules that taking out the overlaps at the start adds: each body lifted to where it lies on what is
  // below it, or 0. Position correction does that work, and no more.
  double lift = 0;
};

/// Twenty scenes: drops, deep starts, stacks, mass ratios, bullets. Floors are at height 0, so that
/// energies are those above the lowest places that bodies can reach.
std::vector<EnergyScene> energy_scenes();

/// Runs `scene` in double with `settings`: the most energy, kinetic and of height, of any frame, as a
/// share of what it began with and its lift, less 1. Negative where it never gained any. Semi-implicit
/// Euler holds velocities that are half a sub-step older than the places: energies are of those that
/// gravity makes of them by then, so that a ball that rises has no more than the ball that fell.
double energy_gained(EnergyScene scene, const SolverSettings& settings);

}  // namespace contactscope
