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

/// One sweep over points that were hit faster than bodies at rest are, and pushed back: they leave
/// with their share of the velocity that they would have met with where they are now.
///
/// A step meets late, deep inside, or by a speculative point early; and then it lifts what overlaps.
/// With the share of the approaching velocity itself the bodies would keep that lift as height: each
/// bounce of an elastic ball would end higher. So let u close a contact, c be the acceleration that
/// closes it and l the way that the step has opened it by: sqrt(u^2 - 2 c l) is what free motion
/// would leave of u there. Semi-implicit Euler moves along a parabola whose velocity at the ends of
/// a sub-step is c h / 2 beside the one that it holds, and that much is taken off before and added
/// after: an elastic bounce keeps the energy of a ball, whatever worked its overlap off.
///
/// `gravity` in metres a second, a second, `h` the sub-step in seconds; separations are up to date.
template <class S>
void apply_restitution(std::span<SolverBody<S>> bodies, std::vector<ContactConstraint<S>>& contacts,
                       const Vec3<S>& gravity, S h);

}  // namespace contactscope
