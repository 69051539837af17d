#pragma once

#include <limits>

#include "dynamics/solver.h"
#include "geometry/primitives.h"
#include "support/builders.h"

/// Worlds of a few bodies for the tests.
namespace contactscope::test {

inline constexpr double kGravity = 9.81;  // metres per second squared, of every world

/// All pairs of bodies with at least one dynamic body, in order, with the same settings.
template <class S>
std::vector<WorldPair<S>> pair_all(const std::vector<Body<S>>& bodies, S friction, S restitution) {
  std::vector<WorldPair<S>> pairs;
  for (int a = 0; a < count_of(bodies); ++a) {
    for (int b = a + 1; b < count_of(bodies); ++b) {
      if (at(bodies, a).dynamic() || at(bodies, b).dynamic())
        pairs.push_back({a, b, friction, restitution});
    }
  }
  return pairs;
}

template <class S> struct Scene {
  World<S> world;
  std::vector<Shape<S>> shapes;
  SolverSettings settings;
  S dt = S(1) / S(60);
  double friction = 0.6;
  double restitution = 0;

  Body<S>& body(int i) { return world.bodies[static_cast<std::size_t>(i)]; }

  int add(const Shape<double>& shape, const Pose<double>& pose, double mass) {
    shapes.push_back(shape_cast<S>(shape));
    const Pose<S> rounded = pose.cast<S>();
    world.bodies.push_back(mass > 0
                               ? dynamic_body<S>(rounded, with_mass(*mass_properties(shape), mass))
                               : static_body<S>(rounded));
    return static_cast<int>(world.bodies.size()) - 1;
  }
  int add_box(const Vec3d& half_extents, const Pose<double>& pose, double mass) {
    return add(make_box(half_extents), pose, mass);
  }
  int add_sphere(double radius, const Vec3d& center, double mass) {
    return add(Sphere<double>{radius}, {Quatd::Identity(), center}, mass);
  }
  /// The half-space below `height`, turned by `slope` radians about z: downhill is +x for negative.
  int add_plane(double slope = 0, double height = 0) {
    return add(HalfSpace<double>{{about(Vec3d::UnitZ(), slope) * Vec3d::UnitY(), height}}, {}, 0);
  }

  void advance(int steps = 1) {
    if (world.pairs.empty())
      world.pairs = pair_all(world.bodies, static_cast<S>(friction), static_cast<S>(restitution));
    std::vector<Manifolds<S>> contacts;
    for (int i = 0; i < steps; ++i) step(world, shapes, settings, dt, contacts);
  }

  /// Sum of the normal impulses of all points of the pair a-b in the last step, newton seconds.
  double load(int a, int b) const {
    double sum = 0;
    for (std::size_t i = 0; i < world.pairs.size(); ++i) {
      if (world.pairs[i].a != a || world.pairs[i].b != b) continue;
      for (const PointImpulse<S>& impulse : world.impulses[i])
        sum += static_cast<double>(impulse.total_normal);
    }
    return sum;
  }

  /// The smallest separation of all pairs now, metres; +infinity if nothing touches.
  double deepest_overlap() {
    World<S> copy = world;
    std::vector<Manifolds<S>> contacts;
    find_contacts(copy, shapes, settings, contacts);
    double result = std::numeric_limits<double>::infinity();
    for (const Manifolds<S>& manifolds : contacts)
      for (const Manifold<S>& manifold : manifolds)
        for (const ContactPoint<S>& point : manifold.points)
          result = std::min(result, static_cast<double>(point.separation));
    return result;
  }

  double kinetic() const {
    double sum = 0;
    for (const Body<S>& each : world.bodies) sum += kinetic_energy(each);
    return sum;
  }
  double energy() const {
    double sum = kinetic();
    for (const Body<S>& each : world.bodies)
      sum += potential_energy(each, world.gravity.template cast<double>());
    return sum;
  }
};

}  // namespace contactscope::test
