#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/vec3.h"
#include "trace/field.h"

namespace contactscope::trace {

/// What the solver gave one contact point over a whole step, on b; a has the opposite.
struct Impulse {
  double normal = 0;               // newton seconds along the normal, never negative
  Vec3d friction = Vec3d::Zero();  // newton seconds, world, across the normal
  double warm_start = 0;           // newton seconds along the normal, kept of the step before

  static constexpr auto fields() {
    return field::list(
        field::impulse("normal", &Impulse::normal).says("impulse"),
        field::impulse("friction", &Impulse::friction)
            .optional()
            .negated()
            .says("friction impulse"),
        field::impulse("warm_start", &Impulse::warm_start).optional().says("warm start"));
  }
  friend bool operator==(const Impulse&, const Impulse&) = default;
};

/// How fast b moves against a where they touch: metres a second, world.
struct RelativeVelocity {
  Vec3d before = Vec3d::Zero();  // when the step begins; its gravity is not in it yet
  Vec3d after = Vec3d::Zero();   // when it ends, at the places of both bodies that met

  static constexpr auto fields() {
    return field::list(
        field::velocity("before", &RelativeVelocity::before).negated().says("relative velocity"),
        field::velocity("after", &RelativeVelocity::after)
            .negated()
            .says("relative velocity after the step"));
  }
  friend bool operator==(const RelativeVelocity&, const RelativeVelocity&) = default;
};

/// A contact point: separation in metres along the normal, negative = overlap.
struct Point {
  Vec3d position = Vec3d::Zero();
  double separation = 0;
  std::string id;  // "a:e3 b:e7"
  std::optional<Impulse> impulse{};
  std::optional<RelativeVelocity> relative_velocity{};  // where there is an impulse
  // Of engines that tell them: the point on the surface of either shape, world.
  std::optional<Vec3d> on_a{}, on_b{};
  bool active = true;  // false: a speculative point that the solver did not act on

  static constexpr auto fields() {
    return field::list(
        field::position("position", &Point::position).says(""),
        field::length("separation", &Point::separation),
        field::exact("id", &Point::id).optional().mirror(Mirrored::IdFlipped).finds(),
        field::fact("impulse", &Point::impulse),
        field::fact("relative_velocity", &Point::relative_velocity),
        field::position("on_a", &Point::on_a).swaps(&Point::on_b).says("place on a"),
        field::position("on_b", &Point::on_b).says("place on b"),
        field::exact("active", &Point::active).where_set().called("idle", "active"));
  }
};

struct Manifold {
  Vec3d normal = Vec3d::Zero();  // unit, from a to b
  std::string axis;  // "face_a", "face_b", "edge_edge", "closest_points"; empty: not told
  std::optional<int> triangle;  // mesh triangle that the manifold belongs to
  std::vector<Point> points;
  std::string type{};  // "point-face", ...: which features touch, the simpler one first

  static constexpr auto fields() {
    return field::list(field::direction_to_b("normal", &Manifold::normal),
                       field::axis("axis", &Manifold::axis).optional(),
                       field::exact("type", &Manifold::type).where_set(),
                       field::exact("triangle", &Manifold::triangle).or_null().finds(),
                       field::facts("points", &Manifold::points).entries("point"));
  }
};

}  // namespace contactscope::trace
