#pragma once

#include <span>

#include "dynamics/constraint.h"
#include "dynamics/solver_settings.h"

namespace contactscope {

/// Position projection: Gregorius 2015, "Recap: Solving Contact (4)": "run a full solver sweep over
/// the contacts again, but now solving the position error directly". Velocities are untouched, so
/// that nothing that is pushed out flies on.
///
/// One sweep; a nonlinear Gauss-Seidel step (Catto 2006, "Nonlinear position correction"): each point
/// moves and turns its two bodies until its overlap is the slop, then the next looks at where they
/// are now. What a point has pushed so far is summed and held at zero: a later point that lifts the
/// body too lets the earlier one take back its share. Without that the corners of a box would each
/// lift it, one after the other, higher than any needs.
template <class S>
void project_positions(std::span<SolverBody<S>> bodies, std::vector<ContactConstraint<S>>& contacts,
                       const SolverSettings& settings);

}  // namespace contactscope
