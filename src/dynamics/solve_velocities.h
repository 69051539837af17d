#pragma once

#include <span>

#include "dynamics/constraint.h"
#include "dynamics/solver_settings.h"

/// Sequential impulses: each contact point by itself, in turn, over and over. Source: Catto 2006,
/// "Fast and Simple Physics using Sequential Impulses"; Gregorius 2015, "Recap: Solving Contact".
///
/// Friction is Coulomb's cone: a vector in the contact plane, no longer than the coefficient times
/// the normal impulse of the sweep before (Catto clamps two tangents, each by itself: a pyramid, whose
/// friction depends on where the tangents happen to lie).
namespace contactscope {

/// Impulses that the points begin with.
template <class S>
void warm_start(std::span<SolverBody<S>> bodies, const std::vector<ContactConstraint<S>>& contacts);

/// One sweep over all contacts: of each its friction, then its normal impulses, which matter more
/// and so have the last word. `push`: overlaps are worked off as the settings say; false: they are
/// let be (relaxation). `h` is the sub-step in seconds.
template <class S>
void solve_velocities(std::span<SolverBody<S>> bodies, std::vector<ContactConstraint<S>>& contacts,
                      const SolverSettings& settings, bool push, S h);

/// Notes the relative velocities that restitution goes by.
template <class S>
void note_approach(std::span<const SolverBody<S>> bodies,
                   std::vector<ContactConstraint<S>>& contacts);

/// One sweep: points that were hit faster than `threshold` (metres a second) and pushed back leave
/// with their share of that velocity.
template <class S>
void apply_restitution(std::span<SolverBody<S>> bodies, std::vector<ContactConstraint<S>>& contacts,
                       S threshold);

}  // namespace contactscope
