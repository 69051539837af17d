#pragma once

#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/pose.h"
#include "trace/pair.h"

/// The facts that each stage of the pipeline decided: world space, metres, double. Float results
/// are held exactly. No algorithms here; an optional stage that did not run, or that nobody asked
/// for, is empty. Each struct lists its fields (field.h); README.md gives the JSON that follows.
namespace contactscope::trace {

/// A body moved by the solver, before the step that starts in this frame.
struct Body {
  std::string name;
  double mass = 0;                         // kilograms
  Vec3d center_of_mass = Vec3d::Zero();    // world
  Vec3d velocity = Vec3d::Zero();          // metres a second, of the centre of mass
  Vec3d angular_velocity = Vec3d::Zero();  // radians a second
  double kinetic_energy = 0;               // joules
  double potential_energy = 0;             // joules, against gravity; 0 at the origin
  std::optional<bool> asleep{};            // where bodies may sleep: the step leaves it where it is
  /// Where somebody else is to step it: three rows, about the centre of mass, the shape's axes, kg m^2.
  std::vector<Vec3d> inertia{};

  static constexpr auto fields() {
    return field::list(
        field::name(&Body::name), field::ratio("mass", &Body::mass),
        field::position("center_of_mass", &Body::center_of_mass).says("centre of mass"),
        field::velocity("velocity", &Body::velocity),
        field::spin("angular_velocity", &Body::angular_velocity),
        field::energy("kinetic_energy", &Body::kinetic_energy).optional(),
        field::energy("potential_energy", &Body::potential_energy).optional(),
        field::exact("asleep", &Body::asleep), field::exact("inertia", &Body::inertia).where_set());
  }
  friend bool operator==(const Body&, const Body&) = default;
};

/// Two bodies that were stopped within the step where they first meet, and went on from there.
struct Stop {
  std::string a, b;              // shapes
  double time = 0;               // fraction of the step
  Vec3d normal = Vec3d::Zero();  // unit, from a to b
  Vec3d point = Vec3d::Zero();   // where they meet, world
  bool for_good = false;         // they stay there until the next frame

  static constexpr auto fields() {
    return field::list(field::exact("a", &Stop::a), field::exact("b", &Stop::b),
                       field::ratio("time", &Stop::time), field::direction("normal", &Stop::normal),
                       field::position("point", &Stop::point).says("stop"),
                       field::exact("for_good", &Stop::for_good).where_set());
  }
  friend bool operator==(const Stop&, const Stop&) = default;
};

/// The step of the solver that starts in this frame; impulses stand with the contact points.
struct Solver {
  std::string position_correction;  // "baumgarte", "projection", "soft"
  int iterations = 0;
  int substeps = 0;
  bool warm_start = false;
  double slop = 0;                // metres of overlap that are let be, as settled by the bodies
  double speculative_margin = 0;  // metres, likewise
  // Where bodies may sleep:
  std::optional<double> sleep_after{};  // seconds for which an island rests before it does
  std::optional<double> sleep_speed{};  // metres a second: what is no faster rests
  std::vector<Body> bodies;
  std::vector<Stop> stops{};  // between this frame and the next, in the order of their times

  static constexpr auto fields() {
    return field::list(
        field::exact("position_correction", &Solver::position_correction).optional(),
        field::exact("iterations", &Solver::iterations).optional(),
        field::exact("substeps", &Solver::substeps).optional().says("sub-steps"),
        field::exact("warm_start", &Solver::warm_start).optional().called("off", "on"),
        field::exact("slop", &Solver::slop).optional(),
        field::exact("speculative_margin", &Solver::speculative_margin).optional(),
        field::exact("sleep_after", &Solver::sleep_after),
        field::exact("sleep_speed", &Solver::sleep_speed),
        field::facts("bodies", &Solver::bodies).entries("body", "bodies").says("body"),
        field::facts("stops", &Solver::stops).where_set().entries("stop"));
  }
  friend bool operator==(const Solver&, const Solver&) = default;
};

/// A shape's box in the broad phase, under the shape's name.
struct Bounds {
  std::string name;
  Box box;             // world, metres; with the margin that contacts are looked for within
  bool large = false;  // too large for any cell: compared with all others

  static constexpr auto fields() {
    return field::list(field::name(&Bounds::name), field::merged(&Bounds::box),
                       field::exact("large", &Bounds::large).where_set());
  }
  friend bool operator==(const Bounds&, const Bounds&) = default;
};

/// A part of space or of a tree into which a broad phase sorts boxes, and what the frame cost there.
struct Cell {
  Box box;          // world, metres
  int depth = 0;    // 0 at the root of a tree, and where there are no levels
  int members = 0;  // boxes in it
  int tests = 0;    // of two boxes, of which one is in it, or is the box of the node itself

  static constexpr auto fields() {
    return field::list(field::merged(&Cell::box), field::exact("depth", &Cell::depth).where_set(),
                       field::exact("members", &Cell::members),
                       field::exact("tests", &Cell::tests));
  }
  friend bool operator==(const Cell&, const Cell&) = default;
};

/// On an axis the lower end of one shape's box and the upper end of another's changed places.
struct EndSwap {
  std::string axis;     // "x", "y", "z"
  double place = 0;     // metres along it
  std::string lower;    // the shape whose lower end it is
  std::string upper;    // the other one
  bool meets = false;   // along the axis both overlap now; else they no longer do
  bool counts = false;  // a pair began, or ended, by it

  static constexpr auto fields() {
    using E = EndSwap;
    return field::list(field::exact("axis", &E::axis), field::exact("place", &E::place),
                       field::exact("lower", &E::lower), field::exact("upper", &E::upper),
                       field::exact("meets", &E::meets), field::exact("counts", &E::counts));
  }
  friend bool operator==(const EndSwap&, const EndSwap&) = default;
};

/// A mesh that changes its form: what it is in this frame, under the name of its shape.
struct Deformed {
  std::string name;
  std::vector<Vec3d> vertices;  // the shape's own frame, in the order of the header's
  std::string tree;  // of boxes: "built" at the start, "refitted" or "rebuilt" in this frame
  /// How many boxes a small query that meets the root is expected to test, by their surfaces, and
  /// that of the tree when it was built last.
  double cost = 0;
  double cost_when_built = 0;
  std::vector<Box> boxes{};  // of the tree, some levels below its root

  static constexpr auto fields() {
    using D = Deformed;
    return field::list(field::name(&D::name), field::position("vertices", &D::vertices).says(""),
                       field::exact("tree", &D::tree).optional(),
                       field::ratio("cost", &D::cost).optional().says("cost of the tree"),
                       field::ratio("cost_when_built", &D::cost_when_built)
                           .optional()
                           .says("cost of the tree when built"),
                       field::facts("boxes", &D::boxes).optional().entries("tree box", "boxes"));
  }
  friend bool operator==(const Deformed&, const Deformed&) = default;
};

/// How the frame's pairs were chosen from all: those whose boxes overlap.
struct BroadPhase {
  std::string method;          // "tree", as `contactscope list broad_phases` names it
  int pairs = 0;               // whose boxes overlap, and which make contacts
  int comparisons = 0;         // of two boxes, in this frame
  int visits = 0;              // of nodes, cells or columns
  int swaps = 0;               // of neighbouring endpoints
  std::vector<Bounds> bounds;  // of each shape, but for those without end
  // Where somebody looks at them:
  std::vector<Cell> cells;         // those with something in them
  std::vector<EndSwap> end_swaps;  // of sweep and prune
  std::string swept;               // of columns: "x", "y" or "z", along which they are swept

  static constexpr auto fields() {
    using B = BroadPhase;
    return field::list(field::exact("method", &B::method), field::exact("pairs", &B::pairs),
                       field::exact("comparisons", &B::comparisons).optional(),
                       field::exact("visits", &B::visits).optional(),
                       field::exact("swaps", &B::swaps).optional(),
                       field::facts("bounds", &B::bounds).entries("box", "boxes").says("box"),
                       field::facts("cells", &B::cells).where_set().entries("cell"),
                       field::facts("end_swaps", &B::end_swaps).where_set().entries("end swap"),
                       field::exact("swept", &B::swept).where_set());
  }
  friend bool operator==(const BroadPhase&, const BroadPhase&) = default;
};

/// Columns for plots: sums over a frame. Of the points that the solver took, of all where there is
/// no solver.
struct Totals {
  double penetration = 0;       // metres, of the deepest point, 0 without an overlap
  double normal_impulse = 0;    // newton seconds, sum over the points
  int points = 0;               // of all manifolds
  int ids = 0;                  // different names among them; each pair has its own
  double kinetic_energy = 0;    // joules, of all bodies
  double potential_energy = 0;  // joules

  static constexpr auto fields() {
    return field::list(field::length("penetration", &Totals::penetration),
                       field::impulse("normal_impulse", &Totals::normal_impulse),
                       field::exact("points", &Totals::points), field::exact("ids", &Totals::ids),
                       field::energy("kinetic_energy", &Totals::kinetic_energy),
                       field::energy("potential_energy", &Totals::potential_energy));
  }
  friend bool operator==(const Totals&, const Totals&) = default;
};

/// Where a shape is, under its name.
using Placement = std::pair<std::string, Pose<double>>;

template <>
struct ListOf<Pose<double>> {
  static constexpr auto fields() {
    return field::list(field::position("position", &Pose<double>::position).says(""),
                       field::rotation("quat_wxyz", &Pose<double>::rotation).says(""));
  }
};
template <>
struct ListOf<Placement> {
  static constexpr auto fields() {
    return field::list(field::name(&Placement::first), field::merged(&Placement::second));
  }
};

struct Frame {
  int frame = 0;
  double time = 0;               // seconds
  std::vector<Placement> poses;  // in the order of the shapes
  std::vector<Pair> pairs;
  std::vector<Deformed> deformed{};         // shapes that no longer are as in the header
  std::vector<FieldSlice> field_slices{};   // of distance fields, where a view shows them
  std::optional<BroadPhase> broad_phase{};  // where one chose the pairs
  std::optional<Solver> solver{};
  std::optional<Totals> totals{};  // where there is a solver, or a view shows plots
  std::vector<Shape> shapes{};     // that were in no frame before
  int line = 0;                    // of the file that it was read from, from 1; else 0

  static constexpr auto fields() {
    // The time is a product of two numbers of the file, which every processor rounds alike.
    return field::list(field::exact("frame", &Frame::frame).names(),
                       field::exact("time", &Frame::time),
                       field::facts("poses", &Frame::poses).entries("pose"),
                       field::facts("pairs", &Frame::pairs).entries("pair"),
                       field::facts("deformed", &Frame::deformed)
                           .where_set()
                           .entries("deformed mesh", "deformed meshes"),
                       field::facts("field_slices", &Frame::field_slices)
                           .where_set()
                           .entries("slice through a field", "slices through fields"),
                       field::fact("broad_phase", &Frame::broad_phase).called("broad phase"),
                       field::fact("solver", &Frame::solver).called("solver"),
                       field::fact("totals", &Frame::totals).called("totals"),
                       field::facts("shapes", &Frame::shapes).where_set().entries("new shape"));
  }
};

/// Turns impulses that are told in another way into newton seconds on b.
void convert_impulses(const ImpulseConvention& from, Frame& frame);

/// Of what else the frame holds.
Totals totals_of(const Frame& frame);

/// As pairs call a shape: whatever has faces and is convex is a "hull".
std::string kind_of(const Shape& shape);
using Kinds = std::unordered_map<std::string, std::string>;  // by the shape's name

/// What a trace may leave out of a pair, from the rest of it: its `kind`, `state` ("touching" where it has
/// points), and the `separation` of the deepest point, 0 of none.
void complete(const Kinds& kinds, Frame& frame);

}  // namespace contactscope::trace
