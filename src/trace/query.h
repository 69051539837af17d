#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/pose.h"
#include "trace/field.h"

/// A query of a pair other than for its manifold, and how it was answered.
namespace contactscope::trace {

/// A bound as it was compared, in the world: a box with its own axes, or a ball.
struct Volume {
  Vec3d center = Vec3d::Zero();
  std::optional<Vec3d> half_extents{};  // metres, along the box's axes
  std::optional<Quatd> rotation{};      // unit, from the axes of an oriented box to the world
  std::optional<double> radius{};       // metres, for a ball

  static constexpr auto fields() {
    return field::list(field::position("center", &Volume::center).says("middle"),
                       field::length("half_extents", &Volume::half_extents),
                       field::rotation("quat_wxyz", &Volume::rotation).says("rotation"),
                       field::length("radius", &Volume::radius));
  }
  friend bool operator==(const Volume&, const Volume&) = default;
};

/// Both bounds projected onto one axis. Intervals in metres along the direction, relative to the
/// midpoint between both centres; lower end first.
struct TestedAxis {
  std::string kind;                 // "face_a", "face_b", "edges", "closest"
  int a = -1;                       // axis of the box of a, 0 to 2, for "face_a" and "edges"
  int b = -1;                       // axis of the box of b, for "face_b" and "edges"
  Vec3d direction = Vec3d::Zero();  // unit, from a to b; zero if the cross product vanishes
  double length = 1;                // of the cross product: sine of the angle between both edges
  std::array<double, 2> interval_a{};
  std::array<double, 2> interval_b{};
  double gap = 0;          // metres between the intervals, negative if they overlap
  bool skipped = false;    // the cross product is too short
  bool separates = false;  // verdict of the test

  static constexpr auto fields() {
    using A = TestedAxis;
    return field::list(field::axis("kind", &A::kind),
                       field::exact("a", &A::a).swaps(&A::b).where_set().says("axis of a"),
                       field::exact("b", &A::b).where_set().says("axis of b"),
                       field::direction_to_b("direction", &A::direction).where_set(),
                       field::ratio("length", &A::length).optional(),
                       field::length("interval_a", &A::interval_a)
                           .negated()
                           .swaps(&A::interval_b)
                           .says("interval of a"),
                       field::length("interval_b", &A::interval_b).negated().says("interval of b"),
                       field::length("gap", &A::gap),
                       field::exact("skipped", &A::skipped).where_set(),
                       field::exact("separates", &A::separates).where_set());
  }
  friend bool operator==(const TestedAxis&, const TestedAxis&) = default;
};

/// Result for the shapes themselves when their bounds were queried: whether they share a point, and
/// their distance if it is known.
struct WithinBounds {
  bool overlap = false;
  std::optional<double> gap{};  // metres, as in Query

  static constexpr auto fields() {
    return field::list(field::exact("overlap", &WithinBounds::overlap),
                       field::length("gap", &WithinBounds::gap));
  }
  friend bool operator==(const WithinBounds&, const WithinBounds&) = default;
};

/// Position of two meshes relative to each other if none of their triangles share a point.
struct Containment {
  /// "inside" the other; "outside"; "open": it has holes, so nothing is inside it; "unknown": not
  /// tested because one of them is open.
  std::string a;
  std::string b;

  static constexpr auto fields() {
    return field::list(field::exact("a", &Containment::a).swaps(&Containment::b).says("a is"),
                       field::exact("b", &Containment::b).says("b is"));
  }
  friend bool operator==(const Containment&, const Containment&) = default;
};

/// Cost of traversing the trees of two meshes together.
struct TreeCounts {
  int node_pairs = 0;      // boxes of nodes that were compared
  int leaf_pairs = 0;      // leaves whose boxes overlap
  int triangle_pairs = 0;  // triangles that were compared

  static constexpr auto fields() {
    return field::list(field::exact("node_pairs", &TreeCounts::node_pairs),
                       field::exact("leaf_pairs", &TreeCounts::leaf_pairs),
                       field::exact("triangle_pairs", &TreeCounts::triangle_pairs));
  }
  friend bool operator==(const TreeCounts&, const TreeCounts&) = default;
};

/// Two compared nodes of the trees of two meshes. Each is the number of triangles before it, in the
/// order of its tree, and the number below it.
struct NodePair {
  int before_a = 0;
  int count_a = 0;
  int before_b = 0;
  int count_b = 0;
  bool overlaps = false;  // only then the traversal continues below
  bool leaves = false;    // both are leaves; their triangles are compared if the boxes overlap

  static constexpr auto fields() {
    using N = NodePair;
    return field::list(field::exact("before_a", &N::before_a).swaps(&N::before_b),
                       field::exact("count_a", &N::count_a).swaps(&N::count_b),
                       field::exact("before_b", &N::before_b), field::exact("count_b", &N::count_b),
                       field::exact("overlaps", &N::overlaps), field::exact("leaves", &N::leaves));
  }
  friend bool operator==(const NodePair&, const NodePair&) = default;
};

/// Two triangles of two meshes that share a point.
struct Intersection {
  int a = -1;                                     // triangle of a
  int b = -1;                                     // triangle of b
  std::string kind;                               // "proper", "coplanar", "touching"
  std::optional<std::array<Vec3d, 2>> segment{};  // ends of the shared segment; not for "coplanar"
  bool a_degenerate = false;                      // it has no area
  bool b_degenerate = false;

  static constexpr auto fields() {
    using I = Intersection;
    return field::list(
        field::exact("a", &I::a).swaps(&I::b).names(), field::exact("b", &I::b).names(),
        field::exact("kind", &I::kind), field::position("segment", &I::segment),
        field::exact("a_degenerate", &I::a_degenerate)
            .where_set()
            .swaps(&I::b_degenerate)
            .says("a without area"),
        field::exact("b_degenerate", &I::b_degenerate).where_set().says("b without area"));
  }
  friend bool operator==(const Intersection&, const Intersection&) = default;
};

struct Query {
  std::string requested;   // "overlap", "touching", "distance", "penetration"
  std::string bounds;      // queried bounds: "aabb", "obb", "sphere"; empty: the shapes themselves
  std::string comparison;  // "inclusive", "exclusive"
  double tolerance = 0;    // metres
  std::string test;        // for oriented boxes: "faces", "fifteen", "guarded"
  double skip_up_to = 0;   // for "fifteen": sine of the angle between two edges
  std::string method;      // method that answered, named as in the capability map
  std::optional<bool> touching{};  // the answer to "touching"
  /// Metres between the two, negative: penetration. For bounds the largest gap of an axis, unless
  /// the distance was queried. Missing if the method does not compute it.
  std::optional<double> gap{};
  std::optional<Vec3d> normal{};   // unit, from a to b
  std::optional<Vec3d> point_a{};  // closest, or deepest, points
  std::optional<Vec3d> point_b{};
  std::optional<Volume> bounds_a{};
  std::optional<Volume> bounds_b{};
  std::vector<TestedAxis> axes{};
  std::optional<WithinBounds> shapes{};
  std::optional<Containment> containment{};
  std::optional<TreeCounts> trees{};
  std::vector<NodePair> node_pairs{};  // in the order of comparison

  static constexpr auto fields() {
    using Q = Query;
    return field::list(
        field::exact("asked", &Q::requested), field::exact("bounds", &Q::bounds).where_set(),
        field::exact("comparison", &Q::comparison).optional(),
        field::exact("tolerance", &Q::tolerance).where_set(),
        field::exact("test", &Q::test).where_set(),
        field::exact("skip_up_to", &Q::skip_up_to).where_set(),
        field::exact("method", &Q::method).optional(),
        field::exact("touching", &Q::touching).says("touching"), field::length("gap", &Q::gap),
        field::direction_to_b("normal", &Q::normal),
        field::position("point_a", &Q::point_a).swaps(&Q::point_b).says("point on a"),
        field::position("point_b", &Q::point_b).says("point on b"),
        field::fact("bounds_a", &Q::bounds_a).swaps(&Q::bounds_b).called("bounds of a"),
        field::fact("bounds_b", &Q::bounds_b).called("bounds of b"),
        field::facts("axes", &Q::axes).where_set().entries("tested axis", "tested axes"),
        field::fact("shapes", &Q::shapes).called("shapes within the bounds"),
        field::fact("containment", &Q::containment).called("containment"),
        field::fact("trees", &Q::trees).called("trees"),
        field::facts("node_pairs", &Q::node_pairs).where_set().entries("node pair", "node pairs"));
  }
};

}  // namespace contactscope::trace
