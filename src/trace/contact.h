#pragma once

#include "core/vec3.h"
#include "trace/field.h"

namespace contactscope::trace {

/// Impulse of one contact point over a whole step, on b; a gets the opposite.
struct Impulse {
  double normal = 0;               // newton seconds along the normal, never negative
  Vec3d friction = Vec3d::Zero();  // newton seconds, world, perpendicular to the normal
  double warm_start = 0;           // newton seconds along the normal, from the previous step

  static constexpr auto fields() {
    return field::list(
        field::impulse<&Impulse::normal>.says("impulse"),
        field::impulse<&Impulse::friction>.optional().negated().says("friction impulse"),
        field::impulse<&Impulse::warm_start>.optional().says("warm start"));
  }
  friend bool operator==(const Impulse&, const Impulse&) = default;
};

/// Velocity of b relative to a at the contact point: metres per second, world.
struct RelativeVelocity {
  Vec3d before = Vec3d::Zero();  // start of the step, without its gravity
  Vec3d after = Vec3d::Zero();   // end of the step, at the points of both bodies that touched

  static constexpr auto fields() {
    return field::list(
        field::velocity<&RelativeVelocity::before>.negated().says("relative velocity"),
        field::velocity<&RelativeVelocity::after>.negated().says(
            "relative velocity after the step"));
  }
  friend bool operator==(const RelativeVelocity&, const RelativeVelocity&) = default;
};

/// A contact point: separation in metres along the normal, negative = overlap.
struct Point {
  Vec3d position = Vec3d::Zero();
  double separation = 0;
  std::string id;  // "a:e3 b:e7"
  std::optional<Impulse> impulse{};
  std::optional<RelativeVelocity> relative_velocity{};  // set if there is an impulse
  // The point on each surface, world, if the engine reports it.
  std::optional<Vec3d> on_a{}, on_b{};
  bool active = true;  // false: a speculative point that the solver ignored

  static constexpr auto fields() {
    return field::list(field::position<&Point::position>.says(""),
                       field::length<&Point::separation>,
                       field::exact<&Point::id>.optional().mirror(Mirrored::IdFlipped).finds(),
                       field::fact<&Point::impulse>, field::fact<&Point::relative_velocity>,
                       field::position<&Point::on_a>.swaps(&Point::on_b).says("place on a"),
                       field::position<&Point::on_b>.says("place on b"),
                       field::exact<&Point::active>.where_set().called("idle", "active"));
  }
};

struct Manifold {
  Vec3d normal = Vec3d::Zero();  // unit, from a to b
  std::string axis;             // "face_a", "face_b", "edge_edge", "closest_points"; empty: unknown
  std::optional<int> triangle;  // mesh triangle that the manifold is on
  std::vector<Point> points;
  std::string type{};  // "point-face", ...: the touching features, the simpler one first

  static constexpr auto fields() {
    return field::list(field::direction_to_b<&Manifold::normal>,
                       field::axis<&Manifold::axis>.optional(),
                       field::exact<&Manifold::type>.where_set(),
                       field::exact<&Manifold::triangle>.or_null().finds(),
                       field::facts<&Manifold::points>.entries("point"));
  }
};

}  // namespace contactscope::trace
