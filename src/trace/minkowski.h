#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/vec3.h"
#include "trace/field.h"

/// Stages that work on the Minkowski difference b - a of two convex cores.
namespace contactscope::trace {

/// A point of the Minkowski difference b - a, given by the two points that are subtracted.
struct SimplexVertex {
  Vec3d a = Vec3d::Zero();
  Vec3d b = Vec3d::Zero();

  static constexpr auto fields() {
    return field::list(
        field::position("a", &SimplexVertex::a).swaps(&SimplexVertex::b).says("vertex"),
        field::position("b", &SimplexVertex::b).says("vertex"));
  }
  friend bool operator==(const SimplexVertex&, const SimplexVertex&) = default;
};
using Simplex = std::vector<SimplexVertex>;  // one to four vertices

/// Closest points by GJK; for round shapes, of their cores.
struct Gjk {
  std::string status;  // "separated", "touching", "overlap", "out of iterations"
  int iterations = 0;
  double distance = 0;  // between the cores, metres
  Vec3d point_a = Vec3d::Zero();
  Vec3d point_b = Vec3d::Zero();
  std::vector<Simplex> steps;  // the simplex after each iteration

  static constexpr auto fields() {
    return field::list(
        field::exact("status", &Gjk::status), field::exact("iterations", &Gjk::iterations),
        field::length("distance", &Gjk::distance),
        field::position("point_a", &Gjk::point_a).swaps(&Gjk::point_b).says("point on a"),
        field::position("point_b", &Gjk::point_b).says("point on b"),
        field::facts("steps", &Gjk::steps).entries("gjk step", "steps"));
  }
};

/// The polytope of EPA in the Minkowski difference b - a before an expansion.
struct Polytope {
  std::vector<SimplexVertex> vertices;
  std::vector<std::array<int, 3>> faces;  // vertices, counter-clockwise seen from outside
  int nearest = -1;     // face nearest to the origin, expanded next; -1 for a flat start
  double distance = 0;  // metres, from the origin to its plane

  static constexpr auto fields() {
    return field::list(
        field::position("vertices", &Polytope::vertices).says(""),
        field::exact("faces", &Polytope::faces).into("vertices").rewound().says("face"),
        field::exact("nearest", &Polytope::nearest)
            .into("faces", "faces of the polytope")
            .or_none()
            .says("nearest face"),
        field::length("distance", &Polytope::distance));
  }
  friend bool operator==(const Polytope&, const Polytope&) = default;
};

struct SampledDirection {
  Vec3d normal = Vec3d::Zero();  // unit, from a to b
  double separation = 0;         // metres along it, negative = overlap

  static constexpr auto fields() {
    return field::list(field::direction_to_b("normal", &SampledDirection::normal),
                       field::length("separation", &SampledDirection::separation));
  }
  friend bool operator==(const SampledDirection&, const SampledDirection&) = default;
};

/// Penetration of two convex cores by an algorithm other than the separating axis test.
struct Penetration {
  std::string method;    // "epa", "mpr", "sampling"
  std::string status;    // "converged", ...: how the method ended
  std::string fallback;  // the method that gave the result instead; empty if this one did
  int iterations = 0;
  double depth = 0;               // metres, between the cores along the normal
  Vec3d normal = Vec3d::Zero();   // unit, from a to b
  Vec3d point_a = Vec3d::Zero();  // deepest points
  Vec3d point_b = Vec3d::Zero();
  std::vector<Polytope> polytopes;           // for "epa", one per iteration
  std::vector<Simplex> portals;              // for "mpr", likewise: inner point, then portal
  std::vector<SampledDirection> directions;  // for "sampling", in order

  static constexpr auto fields() {
    using P = Penetration;
    return field::list(
        field::exact("method", &P::method), field::exact("status", &P::status),
        field::exact("fallback", &P::fallback).where_set(),
        field::exact("iterations", &P::iterations), field::length("depth", &P::depth),
        field::direction_to_b("normal", &P::normal),
        field::position("point_a", &P::point_a).swaps(&P::point_b).says("point on a"),
        field::position("point_b", &P::point_b).says("point on b"),
        field::facts("polytopes", &P::polytopes).where_set().entries("polytope"),
        field::facts("portals", &P::portals).where_set().entries("portal"),
        field::facts("directions", &P::directions).where_set().entries("direction"));
  }
};

/// The Minkowski difference b - a of two convex cores, along the world's axes: the cores overlap if
/// it contains the origin.
struct Minkowski {
  std::vector<Vec3d> vertices;
  std::vector<std::vector<int>> faces;  // counter-clockwise seen from outside

  static constexpr auto fields() {
    return field::list(
        field::position("vertices", &Minkowski::vertices).negated().says(""),
        field::exact("faces", &Minkowski::faces).into("vertices").rewound().says("face"));
  }
  friend bool operator==(const Minkowski&, const Minkowski&) = default;
};

}  // namespace contactscope::trace
