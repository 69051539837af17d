#pragma once

#include <span>

#include "dynamics/constraint.h"
#include "dynamics/solver_settings.h"

namespace contactscope {

/// Position projection: Gregorius 2015, "Recap: Solving Contact (4)": "run a full solver sweep over
/// the contacts again, but now solving the position error directly". Velocities are untouched, so
/// that nothing that is pushed out flies on.
///
/// One sweep; a nonlinear Gauss-Seidel step (Catto 2006, "Nonlinear position correction"), manifold
/// by manifold. Steps of each:
///   1. where its points are now, and their effective masses there;
///   2. pushes that leave each point an overlap of the slop, by sweeps over the points with what they
///      do to each other taken as linear. What a point has pushed so far is summed and held at zero,
///      so that a later point that lifts the body too lets an earlier one take back its share;
///   3. the bodies are moved and turned once, by what all points come to, and by no more than a tenth
///      of a radian.
/// Catto moves the bodies point by point, and never by more than 20 cm. But turns do not commute: of a
/// box deep in a floor each corner turns it, and though the turns add up to none, going through them
/// leaves it turned about the vertical. With one turn for a manifold, what is symmetric stays so, and
/// a limit of the turn has no length in it.
template <class S>
void project_positions(std::span<SolverBody<S>> bodies, std::vector<ContactConstraint<S>>& contacts,
                       const SolverSettings& settings);

}  // namespace contactscope
