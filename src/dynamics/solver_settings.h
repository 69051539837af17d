#pragma once

#include <optional>

#include "core/vec3.h"

namespace contactscope {

/// How an overlap that is there already is worked off.
enum class PositionCorrection {
  Baumgarte,  // a share of it as a velocity (Gregorius 2015, "Recap: Solving Contact (4)"), of which
              // bodies keep no more than the push speed
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
  double baumgarte = 0.1;  // share of the overlap that a (sub-)step works off
  // Metres a second that Baumgarte's push may leave to what it pushes. What its share takes beyond that
  // moves the bodies and is no momentum (Catto 2006, "Split Impulses").
  double push_speed = 0;
  double hertz = 30;          // of soft contacts
  double damping_ratio = 10;  // of soft contacts
  // Metres of overlap that are let be. A point that is pushed out all the way is lost in the next
  // frame, with the impulse that held it: the body drops back, and wanders.
  std::optional<double> slop{};
  // Metres: points that far apart are kept, so that they do not come and go where a body rocks, and
  // keep bodies from passing each other.
  std::optional<double> speculative_margin{};
  // Seconds for which an island must rest before it sleeps; nothing: nobody ever does. Box2D has half a
  // second.
  std::optional<double> sleep_after{};
  // Metres a second: what is no faster rests; see mean_speed() in sleep.h.
  std::optional<double> sleep_speed{};
};

/// With the lengths that were not given: 1/200 of `size` for the slop, four times that for the
/// speculative margin, and ten times as much a second for bodies that rest: 5 mm, 2 cm and 5 cm a second
/// for a metre, as Box2D has them. `size` is that of the smallest body, see shortest_edge() in body.h.
constexpr SolverSettings settled(SolverSettings settings, double size) {
  constexpr double kSlop = 0.005, kSpeculativeMargin = 0.02, kSleepSpeed = 0.05;
  if (!settings.slop) settings.slop = kSlop * size;
  if (!settings.speculative_margin) settings.speculative_margin = kSpeculativeMargin * size;
  if (!settings.sleep_speed) settings.sleep_speed = kSleepSpeed * size;
  return settings;
}

}  // namespace contactscope
