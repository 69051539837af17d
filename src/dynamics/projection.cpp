#include "dynamics/projection.h"

#include <algorithm>

#include "dynamics/prepare.h"

namespace contactscope {
namespace {

// Sweeps over the points of one manifold: its bodies are moved by what these come to. The corners of
// a box leave a hundredth of the difference between each other.
constexpr int kManifoldSweeps = 8;
// Radians that one manifold turns a body by in one sweep. What a turn does to separations is known
// to its first order alone; the square of this is left for the next sweep.
constexpr double kMostTurn = 0.1;

/// A way that a manifold wants its bodies to go, and what it does to a point.
template <class S>
struct Displacement {
  S apart = 0;  // metres along the normal, of both centres
  Vec3<S> turn_a = Vec3<S>::Zero(), turn_b = Vec3<S>::Zero();  // radians, world
};

/// One point where the bodies are now.
template <class S>
struct ProjectedPoint {
  Vec3<S> lever_a, lever_b;    // arm x normal
  Vec3<S> turned_a, turned_b;  // by the inverse inertia
  S separation = 0;
  S inverse_mass = 0;  // 1/kg
  S impulse = 0;       // kg m, beyond what the sweeps before gave

  S separation_after(const Displacement<S>& way) const {
    return separation + way.apart + lever_b.dot(way.turn_b) - lever_a.dot(way.turn_a);
  }
};

template <class S>
ProjectedPoint<S> projected(const SolverBody<S>& a, const SolverBody<S>& b,
                            const ConstraintPoint<S>& point, const Vec3<S>& normal) {
  ProjectedPoint<S> result;
  const Vec3<S> arm_a = a.body.rotation * point.anchor_a, arm_b = b.body.rotation * point.anchor_b;
  result.lever_a = arm_a.cross(normal);
  result.lever_b = arm_b.cross(normal);
  result.turned_a = a.inverse_inertia_world * result.lever_a;
  result.turned_b = b.inverse_inertia_world * result.lever_b;
  result.separation = separation_now(a, b, point, normal);
  result.inverse_mass = (a.body.inverse_mass + b.body.inverse_mass) +
                        (result.lever_a.dot(result.turned_a) + result.lever_b.dot(result.turned_b));
  return result;
}

/// Moves and turns by a share of it.
template <class S>
void displace(SolverBody<S>& moving, const Vec3<S>& way, const Vec3<S>& turn) {
  if (!moving.body.dynamic()) return;
  moving.moved += way;
  Quat<S>& rotation = moving.body.rotation;
  // The body keeps its angular momentum's place in the world, and turns under it by a trifle.
  rotation = Quat<S>(S(1), S(0.5) * turn.x(), S(0.5) * turn.y(), S(0.5) * turn.z()) * rotation;
  rotation.normalize();
  moving.turn_inertia();
}

template <class S>
void project_manifold(SolverBody<S>& a, SolverBody<S>& b, ContactConstraint<S>& contact, S slop,
                      std::vector<ProjectedPoint<S>>& points) {
  points.clear();
  for (const ConstraintPoint<S>& point : contact.points)
    points.push_back(projected(a, b, point, contact.normal));

  Displacement<S> way;
  S sum = 0;
  for (int sweep = 0; sweep < kManifoldSweeps; ++sweep) {
    bool changed = false;
    for (std::size_t i = 0; i < points.size(); ++i) {
      ProjectedPoint<S>& point = points[i];
      const S error = point.separation_after(way) + slop;
      const S least = -contact.points[i].position_impulse;
      const S impulse = std::max(point.impulse - error / point.inverse_mass, least);
      const S change = impulse - point.impulse;
      if (change == 0) continue;
      changed = true;
      point.impulse = impulse;
      sum += change;
      way.apart += change * (a.body.inverse_mass + b.body.inverse_mass);
      way.turn_a -= change * point.turned_a;
      way.turn_b += change * point.turned_b;
    }
    if (!changed) break;
  }
  const S turn = std::max(way.turn_a.norm(), way.turn_b.norm());
  const S share = turn > static_cast<S>(kMostTurn) ? static_cast<S>(kMostTurn) / turn : S(1);
  for (std::size_t i = 0; i < points.size(); ++i)
    contact.points[i].position_impulse += share * points[i].impulse;
  const Vec3<S> impulse = share * sum * contact.normal;
  displace(a, Vec3<S>(-a.body.inverse_mass * impulse), Vec3<S>(share * way.turn_a));
  displace(b, Vec3<S>(b.body.inverse_mass * impulse), Vec3<S>(share * way.turn_b));
}

}  // namespace

template <class S>
void project_positions(std::span<SolverBody<S>> bodies, std::vector<ContactConstraint<S>>& contacts,
                       const SolverSettings& settings) {
  const S slop = static_cast<S>(settings.slop.value_or(0));
  std::vector<ProjectedPoint<S>> points;
  for (ContactConstraint<S>& contact : contacts)
    project_manifold(bodies[static_cast<std::size_t>(contact.a)],
                     bodies[static_cast<std::size_t>(contact.b)], contact, slop, points);
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                             \
  template void project_positions(std::span<SolverBody<S>>, std::vector<ContactConstraint<S>>&, \
                                  const SolverSettings&);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
