#pragma once

#include <string>
#include <vector>

#include "dynamics/solver.h"

namespace contactscope {

/// The method of `study solver` that may gain energy, as a counterexample.
inline constexpr const char* kAllPushKept = "Baumgarte, all of its push kept";

/// A scene whose energy a solver must not increase.
struct EnergyScene {
  std::string name;
  World<double> world;
  std::vector<Shape<double>> shapes;
  int frames = 120;  // of 1/60 s
  // Joules to remove the initial overlaps: each body is lifted until it lies on what is below, or
  // 0. Position correction may do this work, but no more.
  double lift = 0;
};

/// Twenty scenes: drops, deep starts, stacks, mass ratios, bullets. Floors are at height 0, so
/// energies are relative to the lowest positions of bodies.
std::vector<EnergyScene> energy_scenes();

/// Runs `scene` in double with `settings`. Returns the largest energy, kinetic and potential, of
/// any frame over the initial energy plus lift, minus 1; negative if energy was never gained. In
/// semi-implicit Euler velocities lag half a sub-step behind positions, so they are advanced by
/// gravity; else a rising ball would have more energy than a falling one.
double energy_gained(EnergyScene scene, const SolverSettings& settings);

}  // namespace contactscope
