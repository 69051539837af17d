#pragma once

#include "core/vec3.h"
#include "trace/field.h"

/// Stages that work on the Minkowski difference b - a of two convex cores.
namespace contactscope::trace {

/// A point of the Minkowski difference b - a, given by the two points that are subtracted.
struct SimplexVertex {
  Vec3d a = Vec3d::Zero();
  Vec3d b = Vec3d::Zero();

  static constexpr auto fields() {
    return field::list(field::position<&SimplexVertex::a>.swaps(&SimplexVertex::b).says("vertex"),
                       field::position<&SimplexVertex::b>.says("vertex"));
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
    return field::list(field::exact<&Gjk::status>, field::exact<&Gjk::iterations>,
                       field::length<&Gjk::distance>,
                       field::position<&Gjk::point_a>.swaps(&Gjk::point_b).says("point on a"),
                       field::position<&Gjk::point_b>.says("point on b"),
                       field::facts<&Gjk::steps>.entries("gjk step", "steps"));
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
        field::position<&Polytope::vertices>.says(""),
        field::exact<&Polytope::faces>.into("vertices").rewound().says("face"),
        field::exact<&Polytope::nearest>.into("faces", "faces of the polytope").or_none().says("nearest face"),
        field::length<&Polytope::distance>);
  }
  friend bool operator==(const Polytope&, const Polytope&) = default;
};

struct SampledDirection {
  Vec3d normal = Vec3d::Zero();  // unit, from a to b
  double separation = 0;         // metres along it, negative = overlap

  static constexpr auto fields() {
    return field::list(field::direction_to_b<&SampledDirection::normal>,
                       field::length<&SampledDirection::separation>);
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
    return field::list(field::exact<&P::method>, field::exact<&P::status>,
                       field::exact<&P::fallback>.where_set(), field::exact<&P::iterations>,
                       field::length<&P::depth>, field::direction_to_b<&P::normal>,
                       field::position<&P::point_a>.swaps(&P::point_b).says("point on a"),
                       field::position<&P::point_b>.says("point on b"),
                       field::facts<&P::polytopes>.where_set().entries("polytope"),
                       field::facts<&P::portals>.where_set().entries("portal"),
                       field::facts<&P::directions>.where_set().entries("direction"));
  }
};

/// The Minkowski difference b - a of two convex cores, along the world's axes: the cores overlap if
/// it contains the origin.
struct Minkowski {
  std::vector<Vec3d> vertices;
  std::vector<std::vector<int>> faces;  // counter-clockwise seen from outside

  static constexpr auto fields() {
    return field::list(field::position<&Minkowski::vertices>.negated().says(""),
                       field::exact<&Minkowski::faces>.into("vertices").rewound().says("face"));
  }
  friend bool operator==(const Minkowski&, const Minkowski&) = default;
};

}  // namespace contactscope::trace
