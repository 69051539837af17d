#pragma once

#include <span>

#include "dynamics/impulse_store.h"
#include "dynamics/solver_settings.h"
#include "manifold/dispatch.h"

namespace contactscope {

/// What the contact pipeline found of one pair of bodies.
template <class S>
struct PairContacts {
  int a = 0, b = 0;                         // bodies; normals point from a to b
  const Manifolds<S>* manifolds = nullptr;  // nullptr: none
  S friction = 0;                           // Coulomb's coefficient of the pair
  S restitution = 0;                        // of the pair
};

/// Constraints from contacts: arms, tangents, effective masses, and where warm starting is on what
/// `kept` (one a pair) holds of the step before. Pairs without a dynamic body, and points of which
/// the geometry made no numbers, are left out. In the order of pairs, manifolds, points.
template <class S>
std::vector<ContactConstraint<S>> prepare_contacts(std::span<const SolverBody<S>> bodies,
                                                   std::span<const PairContacts<S>> pairs,
                                                   std::span<const PairImpulses<S>> kept,
                                                   const SolverSettings& settings);

/// Separations where the bodies are now: what it was, and how far the anchors have come apart along
/// the normal since.
template <class S>
void update_separations(std::span<const SolverBody<S>> bodies,
                        std::vector<ContactConstraint<S>>& contacts);

/// Of one point.
template <class S>
S separation_now(const SolverBody<S>& a, const SolverBody<S>& b, const ConstraintPoint<S>& point,
                 const Vec3<S>& normal);

}  // namespace contactscope
