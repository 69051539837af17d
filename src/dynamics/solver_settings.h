#pragma once

#include "core/vec3.h"

namespace contactscope {

/// How an overlap that is there already is worked off.
enum class PositionCorrection {
  Baumgarte,   // a share of it as a velocity (Gregorius 2015, "Recap: Solving Contact (4)")
  Projection,  // a sweep over the positions after the velocities (the same slide)
  Soft,        // a damped spring in sub-steps, then relaxed (Catto 2024, "Solver2D", soft step)
};

/// "baumgarte", "projection", "soft", as scenarios and traces spell it.
constexpr const char* to_string(PositionCorrection correction) {
  constexpr const char* kNames[] = {"baumgarte", "projection", "soft"};
  return kNames[static_cast<int>(correction)];
}

struct WorldSettings {
  Vec3d gravity{0, -9.81, 0};  // metres a second, a second
  double friction = 0.6;       // Coulomb's coefficient
  double restitution = 0;      // share of the approaching velocity that is given back
};

struct SolverSettings {
  int iterations = 10;  // sweeps over all points for each sub-step
  int substeps = 1;     // of each frame
  PositionCorrection position_correction = PositionCorrection::Baumgarte;
  bool warm_start = true;
  double baumgarte = 0.1;         // share of the overlap that a (sub-)step works off
  double slop = 0;                // metres of overlap that are let be
  double hertz = 30;              // of soft contacts
  double damping_ratio = 10;      // of soft contacts
  double speculative_margin = 0;  // metres: points that far apart keep bodies from passing
};

}  // namespace contactscope
