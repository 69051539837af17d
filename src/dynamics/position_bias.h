#pragma once

#include <algorithm>
#include <numbers>

#include "dynamics/solver_settings.h"

/// The velocity that a contact point is driven to, by how far it is apart or overlaps.
namespace contactscope {

/// The relative velocity along the normal is driven to -(velocity), with `mass_scale` of the mass
/// and forgetting `impulse_scale` of the impulse so far: impulse = -mass mass_scale (v + velocity) -
/// impulse_scale impulse.
template <class S>
struct PositionBias {
  S velocity = 0;  // metres a second
  S mass_scale = 1;
  S impulse_scale = 0;
};

/// Points that are apart: they may close, but not by more than what there is between them, in `h`
/// seconds (Catto 2013, "Continuous Collision", speculative contacts).
template <class S>
PositionBias<S> speculative(S separation, S h) {
  return {separation / h, S(1), S(0)};
}

/// Gregorius 2015, "Recap: Solving Contact (4)": v_rel = -0.1 / dt * d. Overlap up to the slop is let
/// be, else contacts would come and go.
///
/// Warm starting makes the push late, and a late spring pumps. Of one slow motion of a stack let p be
/// the overlap, y its change in a frame, and e' = g e - (1 - g)(y + b p) what the impulses lack after
/// the sweeps of a frame, which leave the share g of an error: y' = y + e', p' = p + y'. The
/// characteristic polynomial (z^2 - 2 g z + g)(z - 1) + (1 - g) b z^2 has its roots within the unit
/// circle while 1 - g > b / (1 + b) (Jury): 9 % for 0.1.
///
/// The slowest motion is a sway of the whole stack, and each box more slows it down. Measured on equal
/// cubes that begin touching, at default settings: four come to rest (1e-13 J after ten seconds), six
/// sway for twenty seconds, ten fall within twenty. With four sub-steps eight come to rest; ten sway
/// for ever with a hundred sweeps, and come to rest with three hundred.
template <class S>
PositionBias<S> baumgarte(S separation, const SolverSettings& settings, S h) {
  const S overlap = std::min(separation + static_cast<S>(settings.slop.value_or(0)), S(0));
  return {static_cast<S>(settings.baumgarte) / h * overlap, S(1), S(0)};
}

/// Catto 2024, "Solver2D", soft step: a damped spring of `hertz` and `damping_ratio`, which the step
/// can resolve: at most a quarter of the sub-steps' rate. Against a body of infinite mass twice as
/// stiff (ibid.), so that stacks sink less into their ground than into each other. The velocity with
/// which overlaps are pushed out has no upper limit here: it is taken back when the contact relaxes.
template <class S>
PositionBias<S> soft(S separation, const SolverSettings& settings, bool against_static, S h) {
  const S hertz = std::min(static_cast<S>(settings.hertz), S(0.25) / h) * (against_static ? 2 : 1);
  const S omega = S(2) * std::numbers::pi_v<S> * hertz;
  const S a1 = S(2) * static_cast<S>(settings.damping_ratio) + h * omega;
  const S a2 = h * omega * a1;
  const S a3 = S(1) / (S(1) + a2);
  const S overlap = std::min(separation + static_cast<S>(settings.slop.value_or(0)), S(0));
  return {omega / a1 * overlap, a2 * a3, a3};
}

/// Of a point at `separation` in a sub-step of `h` seconds. Off, overlap is let be. `settings` are
/// settled().
template <class S>
PositionBias<S> position_bias(S separation, bool on, bool against_static,
                              const SolverSettings& settings, S h) {
  if (separation > 0) return speculative(separation, h);
  if (!on || settings.position_correction == PositionCorrection::Projection) return {};
  if (settings.position_correction == PositionCorrection::Baumgarte)
    return baumgarte(separation, settings, h);
  return soft(separation, settings, against_static, h);
}

}  // namespace contactscope
