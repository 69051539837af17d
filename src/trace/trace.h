#pragma once

#include <unordered_map>

#include "trace/pair.h"

/// The facts that each stage of the pipeline decided: world space, metres, double. Float results
/// are exact. No algorithms here; optional stages that did not run, or were not recorded, are
/// empty. Each struct lists its fields (field.h); README.md gives the JSON.
namespace contactscope::trace {

/// State of a body before the step that starts in this frame.
struct Body {
  std::string name;
  double mass = 0;                         // kilograms
  Vec3d center_of_mass = Vec3d::Zero();    // world
  Vec3d velocity = Vec3d::Zero();          // metres per second, of the centre of mass
  Vec3d angular_velocity = Vec3d::Zero();  // radians per second
  double kinetic_energy = 0;               // joules
  double potential_energy = 0;             // joules, in gravity; 0 at the origin
  std::optional<bool> asleep{};            // if sleeping is enabled: the step does not move it
  /// For other engines: three rows, about the centre of mass, the shape's axes, kg m^2.
  std::vector<Vec3d> inertia{};

  static constexpr auto fields() {
    return field::list(field::name(&Body::name), field::ratio<&Body::mass>,
                       field::position<&Body::center_of_mass>.says("centre of mass"),
                       field::velocity<&Body::velocity>, field::spin<&Body::angular_velocity>,
                       field::energy<&Body::kinetic_energy>.optional(),
                       field::energy<&Body::potential_energy>.optional(),
                       field::exact<&Body::asleep>, field::exact<&Body::inertia>.where_set());
  }
  friend bool operator==(const Body&, const Body&) = default;
};

/// Two bodies that were stopped within the step at their first contact and continued from there.
struct Stop {
  std::string a, b;              // shapes
  double time = 0;               // fraction of the step
  Vec3d normal = Vec3d::Zero();  // unit, from a to b
  Vec3d point = Vec3d::Zero();   // of contact, world
  bool for_good = false;         // they stay there until the next frame

  static constexpr auto fields() {
    return field::list(field::exact<&Stop::a>, field::exact<&Stop::b>, field::ratio<&Stop::time>,
                       field::direction<&Stop::normal>, field::position<&Stop::point>.says("stop"),
                       field::exact<&Stop::for_good>.where_set());
  }
  friend bool operator==(const Stop&, const Stop&) = default;
};

/// The step of the solver that starts in this frame; impulses are stored with the contact points.
struct Solver {
  std::string position_correction;  // "baumgarte", "projection", "soft"
  int iterations = 0;
  int substeps = 0;
  bool warm_start = false;
  double slop = 0;                // metres of allowed overlap, after adjustment to the bodies' size
  double speculative_margin = 0;  // metres, adjusted likewise
  // If sleeping is enabled:
  std::optional<double> sleep_after{};  // seconds that an island must rest before it sleeps
  std::optional<double> sleep_speed{};  // metres per second: slower bodies rest
  std::vector<Body> bodies;
  std::vector<Stop> stops{};  // until the next frame, ordered by time

  static constexpr auto fields() {
    return field::list(field::exact<&Solver::position_correction>.optional(),
                       field::exact<&Solver::iterations>.optional(),
                       field::exact<&Solver::substeps>.optional().says("sub-steps"),
                       field::exact<&Solver::warm_start>.optional().called("off", "on"),
                       field::exact<&Solver::slop>.optional(),
                       field::exact<&Solver::speculative_margin>.optional(),
                       field::exact<&Solver::sleep_after>, field::exact<&Solver::sleep_speed>,
                       field::facts<&Solver::bodies>.entries("body", "bodies").says("body"),
                       field::facts<&Solver::stops>.where_set().entries("stop"));
  }
  friend bool operator==(const Solver&, const Solver&) = default;
};

/// The box of a shape in the broad phase, under the shape's name.
struct Bounds {
  std::string name;
  Box box;             // world, metres; includes the contact margin
  bool large = false;  // too large for any cell: compared with all others

  static constexpr auto fields() {
    return field::list(field::name(&Bounds::name), field::merged(&Bounds::box),
                       field::exact<&Bounds::large>.where_set());
  }
  friend bool operator==(const Bounds&, const Bounds&) = default;
};

/// A region of space, or a node of a tree, of a broad phase, and its cost in this frame.
struct Cell {
  Box box;          // world, metres
  int depth = 0;    // 0 at a tree's root, and without levels
  int members = 0;  // boxes in it
  int tests = 0;    // box pairs with one box in it, or with the node's own box

  static constexpr auto fields() {
    return field::list(field::merged(&Cell::box), field::exact<&Cell::depth>.where_set(),
                       field::exact<&Cell::members>, field::exact<&Cell::tests>);
  }
  friend bool operator==(const Cell&, const Cell&) = default;
};

/// Sweep and prune: a lower end of one box and an upper end of another swapped along an axis.
struct EndSwap {
  std::string axis;     // "x", "y", "z"
  double place = 0;     // metres along it
  std::string lower;    // shape of the lower end
  std::string upper;    // shape of the upper end
  bool meets = false;   // true: they now overlap along the axis; false: no longer
  bool counts = false;  // a pair began or ended by it

  static constexpr auto fields() {
    using E = EndSwap;
    return field::list(field::exact<&E::axis>, field::exact<&E::place>, field::exact<&E::lower>,
                       field::exact<&E::upper>, field::exact<&E::meets>, field::exact<&E::counts>);
  }
  friend bool operator==(const EndSwap&, const EndSwap&) = default;
};

/// State of a deforming mesh in this frame, under the name of its shape.
struct Deformed {
  std::string name;
  std::vector<Vec3d> vertices;  // shape's frame, in the order of the header's
  std::string tree;  // of boxes: "built" at the start, "refitted" or "rebuilt" in this frame
  /// Expected number of box tests for a small query that meets the root, from the surface areas;
  /// now, and when the tree was last built.
  double cost = 0;
  double cost_when_built = 0;
  std::vector<Box> boxes{};  // some levels below the tree's root

  static constexpr auto fields() {
    using D = Deformed;
    return field::list(
        field::name(&D::name), field::position<&D::vertices>.says(""),
        field::exact<&D::tree>.optional(),
        field::ratio<&D::cost>.optional().says("cost of the tree"),
        field::ratio<&D::cost_when_built>.optional().says("cost of the tree when built"),
        field::facts<&D::boxes>.optional().entries("tree box", "boxes"));
  }
  friend bool operator==(const Deformed&, const Deformed&) = default;
};

/// How the frame's pairs were selected: by overlapping boxes.
struct BroadPhase {
  std::string method;          // "tree", as in `contactscope list broad_phases`
  int pairs = 0;               // with overlapping boxes; these get contacts
  int comparisons = 0;         // box against box, in this frame
  int visits = 0;              // of nodes, cells or columns
  int swaps = 0;               // of neighbouring endpoints
  std::vector<Bounds> bounds;  // one per shape, except for infinite ones
  // If a view shows them:
  std::vector<Cell> cells;         // cells that are not empty
  std::vector<EndSwap> end_swaps;  // for sweep and prune
  std::string swept;               // for columns: sweep axis "x", "y" or "z"

  static constexpr auto fields() {
    using B = BroadPhase;
    return field::list(field::exact<&B::method>, field::exact<&B::pairs>,
                       field::exact<&B::comparisons>.optional(),
                       field::exact<&B::visits>.optional(), field::exact<&B::swaps>.optional(),
                       field::facts<&B::bounds>.entries("box", "boxes").says("box"),
                       field::facts<&B::cells>.where_set().entries("cell"),
                       field::facts<&B::end_swaps>.where_set().entries("end swap"),
                       field::exact<&B::swept>.where_set());
  }
  friend bool operator==(const BroadPhase&, const BroadPhase&) = default;
};

/// Columns for plots: sums over a frame, over the points that the solver used, or over all points
/// without a solver.
struct Totals {
  double penetration = 0;       // metres, at the deepest point; 0 without overlap
  double normal_impulse = 0;    // newton seconds, summed over the points
  int points = 0;               // over all manifolds
  int ids = 0;                  // distinct ids; those of different pairs are different
  double kinetic_energy = 0;    // joules, over all bodies
  double potential_energy = 0;  // joules

  static constexpr auto fields() {
    return field::list(field::length<&Totals::penetration>, field::impulse<&Totals::normal_impulse>,
                       field::exact<&Totals::points>, field::exact<&Totals::ids>,
                       field::energy<&Totals::kinetic_energy>,
                       field::energy<&Totals::potential_energy>);
  }
  friend bool operator==(const Totals&, const Totals&) = default;
};

using Placement = std::pair<std::string, Pose<double>>;

template <> struct ListOf<Pose<double>> {
  static constexpr auto fields() {
    return field::list(field::position<&Pose<double>::position>.says(""),
                       field::rotation<&Pose<double>::rotation>.keyed("quat_wxyz").says(""));
  }
};
template <> struct ListOf<Placement> {
  static constexpr auto fields() {
    return field::list(field::name(&Placement::first), field::merged(&Placement::second));
  }
};

struct Frame {
  int frame = 0;
  double time = 0;               // seconds
  std::vector<Placement> poses;  // in the order of the shapes
  std::vector<Pair> pairs;
  std::vector<Deformed> deformed{};         // shapes whose form differs from the header
  std::vector<FieldSlice> field_slices{};   // through distance fields, if a view shows them
  std::optional<BroadPhase> broad_phase{};  // if one selected the pairs
  std::optional<Solver> solver{};
  std::optional<Totals> totals{};  // with a solver, or if a view shows plots
  std::vector<Shape> shapes{};     // shapes that are new in this frame
  int line = 0;                    // line in the trace file, from 1; else 0

  static constexpr auto fields() {
    // The time is a product of two numbers of the file, which every processor rounds alike.
    return field::list(
        field::exact<&Frame::frame>.names(), field::exact<&Frame::time>,
        field::facts<&Frame::poses>.entries("pose"), field::facts<&Frame::pairs>.entries("pair"),
        field::facts<&Frame::deformed>.where_set().entries("deformed mesh", "deformed meshes"),
        field::facts<&Frame::field_slices>.where_set().entries("slice through a field",
                                                               "slices through fields"),
        field::fact<&Frame::broad_phase>.called("broad phase"),
        field::fact<&Frame::solver>.called("solver"), field::fact<&Frame::totals>.called("totals"),
        field::facts<&Frame::shapes>.where_set().entries("new shape"));
  }
};

/// Converts impulses of another convention to newton seconds on b.
void convert_impulses(const ImpulseConvention& from, Frame& frame);

/// Computed from the rest of the frame.
Totals totals_of(const Frame& frame);

/// Kind of a shape in a pair: every other convex shape with faces is a "hull".
std::string kind_of(const Shape& shape);
using Kinds = std::unordered_map<std::string, std::string>;  // by the shape's name

/// Fills what a trace may omit: a pair's `kind`, its `state` ("touching" if it has points), and its
/// `separation`: that of the deepest point, 0 without points.
void complete(const Kinds& kinds, Frame& frame);

}  // namespace contactscope::trace
