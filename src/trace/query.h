#pragma once

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
    return field::list(field::position<&Volume::center>.says("middle"),
                       field::length<&Volume::half_extents>,
                       field::rotation<&Volume::rotation>.keyed("quat_wxyz").says("rotation"),
                       field::length<&Volume::radius>);
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

  bool is_of_edges() const { return kind == "edges"; }

  static constexpr auto fields() {
    using A = TestedAxis;
    return field::list(
        field::axis<&A::kind>, field::exact<&A::a>.swaps(&A::b).where_set().says("axis of a"),
        field::exact<&A::b>.where_set().says("axis of b"),
        field::direction_to_b<&A::direction>.where_set(), field::ratio<&A::length>.optional(),
        field::length<&A::interval_a>.negated().swaps(&A::interval_b).says("interval of a"),
        field::length<&A::interval_b>.negated().says("interval of b"), field::length<&A::gap>,
        field::exact<&A::skipped>.where_set(), field::exact<&A::separates>.where_set());
  }
  friend bool operator==(const TestedAxis&, const TestedAxis&) = default;
};

/// Whether the gap of the bounds is larger along `axis` than along `than`. Along a cross product of
/// edges it must be larger by 16 `epsilon` of both reaches: that can be the normal of a face again.
template <class Axis> bool separates_more(const Axis& axis, const Axis& than, double epsilon) {
  const bool may_be_the_same = axis.is_of_edges() && !than.is_of_edges();
  const double reach = axis.interval_b[1] - axis.interval_a[0];
  return axis.gap > than.gap + (may_be_the_same ? 16 * epsilon * reach : 0);
}

/// Result for the shapes themselves when their bounds were queried: whether they share a point, and
/// their distance if it is known.
struct WithinBounds {
  bool overlap = false;
  std::optional<double> gap{};  // metres, as in Query

  static constexpr auto fields() {
    return field::list(field::exact<&WithinBounds::overlap>, field::length<&WithinBounds::gap>);
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
    return field::list(field::exact<&Containment::a>.swaps(&Containment::b).says("a is"),
                       field::exact<&Containment::b>.says("b is"));
  }
  friend bool operator==(const Containment&, const Containment&) = default;
};

/// Cost of traversing the trees of two meshes together.
struct TreeCounts {
  int node_pairs = 0;      // boxes of nodes that were compared
  int leaf_pairs = 0;      // leaves whose boxes overlap
  int triangle_pairs = 0;  // triangles that were compared

  static constexpr auto fields() {
    return field::list(field::exact<&TreeCounts::node_pairs>, field::exact<&TreeCounts::leaf_pairs>,
                       field::exact<&TreeCounts::triangle_pairs>);
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
    return field::list(field::exact<&N::before_a>.swaps(&N::before_b),
                       field::exact<&N::count_a>.swaps(&N::count_b), field::exact<&N::before_b>,
                       field::exact<&N::count_b>, field::exact<&N::overlaps>,
                       field::exact<&N::leaves>);
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
        field::exact<&I::a>.swaps(&I::b).names(), field::exact<&I::b>.names(),
        field::exact<&I::kind>, field::position<&I::segment>,
        field::exact<&I::a_degenerate>.where_set().swaps(&I::b_degenerate).says("a without area"),
        field::exact<&I::b_degenerate>.where_set().says("b without area"));
  }
  friend bool operator==(const Intersection&, const Intersection&) = default;
};

/// Two features of hulls that V-Clip compared.
struct WalkStep {
  std::string features;  // "a:v0 b:e3"
  double distance = 0;   // metres between them

  static constexpr auto fields() {
    return field::list(field::exact<&WalkStep::features>.mirror(Mirrored::IdFlipped),
                       field::length<&WalkStep::distance>);
  }
  friend bool operator==(const WalkStep&, const WalkStep&) = default;
};

struct Query {
  std::string requested;   // "overlap", "touching", "distance", "penetration"
  std::string bounds;      // queried bounds: "aabb", "obb", "sphere"; empty: the shapes themselves
  std::string comparison;  // "inclusive", "exclusive", "proper"
  double tolerance = 0;    // metres
  std::string test;        // for oriented boxes: "faces", "fifteen", "guarded"
  double skip_up_to = 0;   // for "fifteen": sine of the angle between two edges
  std::string method;      // method that answered, named as in the capability map
  std::optional<bool> touching{};  // the answer to "touching"
  /// Metres between the two, negative: penetration. For bounds the largest gap of an axis, unless
  /// the distance was queried. Missing if the method does not compute it.
  std::optional<double> gap{};
  std::vector<WalkStep> walk{};    // of V-Clip, in order; the last features are closest
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
        field::exact<&Q::requested>.keyed("asked"), field::exact<&Q::bounds>.where_set(),
        field::exact<&Q::comparison>.optional(), field::exact<&Q::tolerance>.where_set(),
        field::exact<&Q::test>.where_set(), field::exact<&Q::skip_up_to>.where_set(),
        field::exact<&Q::method>.optional(), field::exact<&Q::touching>.says("touching"),
        field::length<&Q::gap>,
        field::facts<&Q::walk>.where_set().entries("step of V-Clip", "steps"),
        field::direction_to_b<&Q::normal>,
        field::position<&Q::point_a>.swaps(&Q::point_b).says("point on a"),
        field::position<&Q::point_b>.says("point on b"),
        field::fact<&Q::bounds_a>.swaps(&Q::bounds_b).called("bounds of a"),
        field::fact<&Q::bounds_b>.called("bounds of b"),
        field::facts<&Q::axes>.where_set().entries("tested axis", "tested axes"),
        field::fact<&Q::shapes>.called("shapes within the bounds"),
        field::fact<&Q::containment>.called("containment"), field::fact<&Q::trees>.called("trees"),
        field::facts<&Q::node_pairs>.where_set().entries("node pair", "node pairs"));
  }
};

}  // namespace contactscope::trace
