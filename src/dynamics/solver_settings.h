#pragma once

#include "core/vec3.h"

namespace contactscope {

/// Method that reduces existing overlaps.
enum class PositionCorrection {
  Baumgarte,   // a share of it as a velocity (Gregorius 2015, "Recap: Solving Contact (4)");
               // bodies keep at most the push speed
  Projection,  // a sweep over the positions after the velocities (the same slide)
  Soft,        // a damped spring in sub-steps, then relaxed (Catto 2024, "Solver2D", soft step)
};

/// "baumgarte", "projection", "soft", as written in scenarios and traces.
constexpr const char* to_string(PositionCorrection correction) {
  constexpr const char* kNames[] = {"baumgarte", "projection", "soft"};
  return kNames[static_cast<int>(correction)];
}

struct WorldSettings {
  Vec3d gravity{0, -9.81, 0};  // metres per second squared
  double friction = 0.6;       // Coulomb's coefficient
  double restitution = 0;      // share of the closing velocity that is returned
};

struct SolverSettings {
  int iterations = 10;  // sweeps over all points per sub-step
  int substeps = 1;     // per frame
  PositionCorrection position_correction = PositionCorrection::Baumgarte;
  bool warm_start = true;
  double baumgarte = 0.1;  // share of the overlap that a (sub-)step removes
  // Velocity that Baumgarte's push may add to bodies, metres per second. The rest of its share
  // moves the bodies without momentum (Catto 2006, "Split Impulses").
  double push_speed = 0;
  double hertz = 30;          // of soft contacts
  double damping_ratio = 10;  // of soft contacts
  // Metres of overlap that are ignored. A point that is pushed out completely is lost in the next
  // frame, together with the impulse that held it: the body drops back, and wanders.
  std::optional<double> slop{};
  // Metres: separated points within it are kept, so that bodies neither rock nor pass each other.
  std::optional<double> speculative_margin{};
  // Seconds for which an island rests before it sleeps; nullopt: never. Box2D uses half a second.
  std::optional<double> sleep_after{};
  // Metres per second: slower bodies rest; see mean_speed() in sleep.h.
  std::optional<double> sleep_speed{};
};

/// Fills missing lengths: 1/200 of `size` for the slop, four times that for the speculative margin,
/// ten times that per second for resting bodies. 5 mm, 2 cm and 5 cm per second for a metre, as in
/// Box2D. `size`: shortest_edge() (body.h) of the smallest body.
constexpr SolverSettings settled(SolverSettings settings, double size) {
  constexpr double kSlop = 0.005, kSpeculativeMargin = 0.02, kSleepSpeed = 0.05;
  if (!settings.slop) settings.slop = kSlop * size;
  if (!settings.speculative_margin) settings.speculative_margin = kSpeculativeMargin * size;
  if (!settings.sleep_speed) settings.sleep_speed = kSleepSpeed * size;
  return settings;
}

}  // namespace contactscope
