#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/pose.h"
#include "core/vec3.h"

/// The facts that each stage of the pipeline decided: world space, metres, double. Float results
/// are held exactly. No algorithms here; an optional stage that did not run, or that nobody asked
/// for, is empty. FORMATS.md, "Trace", gives the JSON of each of these.
namespace contactscope::trace {

using Polygon = std::vector<Vec3d>;

/// Half-space of a shape of type "plane": normal . x <= offset.
struct HalfSpace {
  Vec3d normal = Vec3d::UnitY();  // unit
  double offset = 0;              // metres

  friend bool operator==(const HalfSpace&, const HalfSpace&) = default;
};

/// A shape as far as a drawing needs it, in its local frame.
struct Shape {
  std::string name;
  std::string type;  // "box", "hull", "cylinder", "cone", "sphere", "capsule", "mesh", "plane"
  /// Of a sphere its centre, of a capsule the ends of its segment, of a plane none.
  std::vector<Vec3d> vertices;
  std::vector<std::vector<int>> faces;  // vertex indices, counter-clockwise seen from outside
  // Vertex indices. Ids such as "a:e3" count in this list; those of a mesh count within the
  // manifold's triangle: edge k from its corner k to the next.
  std::vector<std::array<int, 2>> edges;
  Vec3d center_of_mass = Vec3d::Zero();
  double radius = 0;  // metres; of a sphere or capsule: everything so near to its vertices and edge
  std::optional<HalfSpace> half_space{};
};

/// What the solver gave one contact point over a whole step, on b; a has the opposite.
struct Impulse {
  double normal = 0;               // newton seconds along the normal, never negative
  Vec3d friction = Vec3d::Zero();  // newton seconds, world, across the normal
  double warm_start = 0;           // newton seconds along the normal, kept of the step before

  friend bool operator==(const Impulse&, const Impulse&) = default;
};

/// How fast b moves against a where they touch: metres a second, world.
struct RelativeVelocity {
  Vec3d before = Vec3d::Zero();  // when the step begins; its gravity is not in it yet
  Vec3d after = Vec3d::Zero();   // when it ends, at the places of both bodies that met

  friend bool operator==(const RelativeVelocity&, const RelativeVelocity&) = default;
};

/// A contact point: separation in metres along the normal, negative = overlap.
struct Point {
  Vec3d position = Vec3d::Zero();
  double separation = 0;
  std::string id;  // "a:e3 b:e7"
  std::optional<Impulse> impulse{};
  std::optional<RelativeVelocity> relative_velocity{};  // where there is an impulse
};

struct Manifold {
  Vec3d normal = Vec3d::Zero();  // unit, from a to b
  std::string axis;              // "face_a", "face_b", "edge_edge", "closest_points"
  std::optional<int> triangle;   // mesh triangle that the manifold belongs to
  std::vector<Point> points;
  std::string type{};  // "point-face", ...: which features touch, the simpler one first
};

/// Best axis of one face query of the separating axis test.
struct FaceAxis {
  int face = -1;
  double separation = 0;
  Vec3d normal = Vec3d::Zero();   // unit, from a to b
  Vec3d support = Vec3d::Zero();  // deepest vertex of the other shape
};

/// Best axis of the edge query.
struct EdgeAxis {
  int a = -1;  // edge of a
  int b = -1;  // edge of b
  double separation = 0;
  Vec3d normal = Vec3d::Zero();   // unit, from a to b
  Vec3d point_a = Vec3d::Zero();  // closest points of the two edges
  Vec3d point_b = Vec3d::Zero();
};

/// Two edges whose arcs on the Gauss map cross: together they make a face of the Minkowski
/// difference.
struct EdgePair {
  int a = -1;  // edge of a
  int b = -1;  // edge of b
  double separation = 0;
  Vec3d normal = Vec3d::Zero();  // unit, from a to b

  friend bool operator==(const EdgePair&, const EdgePair&) = default;
};

struct Sat {
  std::optional<FaceAxis> face_a;
  std::optional<FaceAxis> face_b;
  std::optional<EdgeAxis> edge;
  std::string chosen;  // "face_a", "face_b", "edge_edge"; what separates, or what makes the contact
  std::string preference;              // "relative" or "none"
  std::vector<EdgePair> edge_pairs{};  // all that the edge query measured; of stage gauss_map
};

struct ClipFace {
  std::string shape;
  int face = -1;
  Vec3d normal = Vec3d::Zero();  // outward, unit
  Polygon polygon;
};

/// One side plane and the polygon that is left after it.
struct ClipStep {
  Vec3d normal = Vec3d::Zero();  // outward, unit; points with normal . x > offset are cut away
  double offset = 0;
  Polygon polygon;
};

struct DroppedPoint {
  Vec3d position = Vec3d::Zero();
  std::string reason;  // "above the reference face"
};

struct Clip {
  ClipFace reference;
  ClipFace incident;
  std::vector<ClipStep>
      steps;  // in order; step k is the side plane of the reference polygon's edge k
  std::vector<DroppedPoint> dropped;
};

/// What one point was worth at one step of a reducer, seen against the normal.
struct Measure {
  int point = -1;      // index into the points
  int a = -1, b = -1;  // edge that it was measured against, where it was one
  double value = 0;    // metres, or square metres with a sign for areas
};

/// How one kept point was chosen.
struct Choice {
  /// "support", "deepest", "farthest", "triangle", "outside", "distance".
  std::string rule;
  Vec3d direction = Vec3d::Zero();  // unit, of "support"
  std::vector<Measure> measures;    // of every candidate what decided; of the chosen one all
};

struct Reduction {
  std::string method;
  std::vector<Point> points;    // all, before
  std::vector<int> kept;        // indices into points, in the order of choice
  double area = 0;              // square metres, of the convex hull of the kept points in the plane
  double best_area = 0;         // largest that as many points can span
  std::vector<int> best;        // the points that span it; empty where nobody looked
  std::vector<Choice> choices;  // for each kept point, where the method has such steps
};

/// A point of the Minkowski difference b - a, by the points that it is the difference of.
struct SimplexVertex {
  Vec3d a = Vec3d::Zero();
  Vec3d b = Vec3d::Zero();

  friend bool operator==(const SimplexVertex&, const SimplexVertex&) = default;
};
using Simplex = std::vector<SimplexVertex>;  // one to four

/// Closest points by GJK, between the cores of round shapes.
struct Gjk {
  std::string status;  // "separated", "touching", "overlap", "out of iterations"
  int iterations = 0;
  double distance = 0;  // of the cores, metres
  Vec3d point_a = Vec3d::Zero();
  Vec3d point_b = Vec3d::Zero();
  std::vector<Simplex> steps;  // the simplex after each iteration
};

/// The polytope of EPA in the Minkowski difference b - a before one expansion.
struct Polytope {
  std::vector<SimplexVertex> vertices;
  std::vector<std::array<int, 3>> faces;  // vertices, counter-clockwise seen from outside
  int nearest = -1;                       // face nearest to the origin: the one to expand
  double distance = 0;                    // metres, of its plane from the origin

  friend bool operator==(const Polytope&, const Polytope&) = default;
};

/// A direction that sampling tried.
struct SampledDirection {
  Vec3d normal = Vec3d::Zero();  // unit, from a to b
  double separation = 0;         // metres along it, negative = overlap

  friend bool operator==(const SampledDirection&, const SampledDirection&) = default;
};

/// How deep two convex cores are in each other, by an algorithm other than the separating axis
/// test.
struct Penetration {
  std::string method;    // "epa", "mpr", "sampling"
  std::string status;    // "converged", ...: how the method ended
  std::string fallback;  // the method that gave the result instead; empty when this one did
  int iterations = 0;
  double depth = 0;               // metres, of the cores along the normal
  Vec3d normal = Vec3d::Zero();   // unit, from a to b
  Vec3d point_a = Vec3d::Zero();  // deepest points
  Vec3d point_b = Vec3d::Zero();
  std::vector<Polytope> polytopes;           // of "epa", one an iteration
  std::vector<Simplex> portals;              // of "mpr", one an iteration: inner point, then portal
  std::vector<SampledDirection> directions;  // of "sampling", in order
};

/// The Minkowski difference b - a of two convex cores, in the world's axes: the cores overlap where
/// it holds the origin.
struct Minkowski {
  std::vector<Vec3d> vertices;
  std::vector<std::vector<int>> faces;  // counter-clockwise seen from outside

  friend bool operator==(const Minkowski&, const Minkowski&) = default;
};

/// A point of an incremental manifold, and what became of it in this frame.
struct PersistentPoint {
  Point point;
  Vec3d on_a = Vec3d::Zero();  // the places of both shapes that met when it was found
  Vec3d on_b = Vec3d::Zero();
  std::string state;   // "new", "persisted", "broken"
  std::string reason;  // of "broken": "apart", "slid", "other features", "replaced", "reduced"
  int age = 0;         // frames since it was found
};

struct Incremental {
  std::string confirm;  // "distance", "ids": how old points are confirmed
  std::string query;    // "gjk": the cores were apart; else the method that measured their overlap
  double margin_a = 0;  // metres about the core of a
  double margin_b = 0;
  std::vector<PersistentPoint> points;  // those of the manifold, then the broken ones
};

/// Whether a body can rest on a manifold: whether its centre of mass, moved along the normal,
/// is within the contact points (Gregorius 2015, "Incremental Manifold Stability").
struct Stability {
  std::string shape;  // whose centre of mass
  Vec3d center_of_mass = Vec3d::Zero();
  Vec3d projection = Vec3d::Zero();  // into the contact plane
  Polygon support;                   // corners of the convex hull of the points in that plane
  double margin = 0;    // metres from the projection to the border of the support, negative outside
  std::string verdict;  // "stable", "turns about a point", "turns about a line", "no contact"
  std::optional<std::array<Vec3d, 2>> axis;  // of "turns about a line": two points on it
};

/// Axis-aligned box in the frame of a shape, metres.
struct Box {
  Vec3d lower = Vec3d::Zero();
  Vec3d upper = Vec3d::Zero();

  friend bool operator==(const Box&, const Box&) = default;
};

/// A box of a mesh's tree that the query looked at.
struct TreeVisit {
  Box box;
  int depth = 0;  // 0 at the root
  bool leaf = false;
  bool overlaps = false;  // with the box of the query; only then what is below was looked at

  friend bool operator==(const TreeVisit&, const TreeVisit&) = default;
};

/// How the triangles of a mesh were collected. Boxes in the mesh's own frame.
struct Tree {
  std::string shape;  // the mesh
  Box box;            // of the other shape, grown by the margin
  std::vector<TreeVisit> visits;
  std::vector<int> candidates;  // triangles whose boxes the query's touches
};

/// The geometry had no normal of its own.
struct Degenerate {
  std::string geometry;  // "coincident centres", ...
  std::string answer;    // "fallback": a normal was chosen; "skip": no contact was made

  friend bool operator==(const Degenerate&, const Degenerate&) = default;
};

/// Temporal coherence: what was kept of an earlier frame was tried before the full test.
struct Cache {
  bool hit = false;             // it gave the result, and the full test did not run
  std::string kind;             // "separating_axis", or "features": those that touched
  std::string axis;             // "face_a", "face_b", "edge_edge"; that was tried
  std::optional<Vec3d> normal;  // unit, from a to b; of a hit
  /// Metres, of features: no point of one shape, seen from the other, has moved farther since the
  /// full test that found them.
  std::optional<double> moved;
};

/// Which optional stages to record: what no picture shows need not be written down. The arcs of the
/// Gauss map and the Minkowski difference are large and say nothing that the shapes do not: they are
/// only recorded where a view asks for them.
struct Stages {
  bool sat = true;
  bool clip = true;
  bool reduction = true;
  bool tree = true;
  bool gjk = true;
  bool gauss_map = false;
  bool penetration = true;
  bool minkowski = false;
  bool stability = true;

  static constexpr Stages none() {
    return {false, false, false, false, false, false, false, false, false};
  }
};

struct Pair {
  std::string a;
  std::string b;
  std::string label;      // set when a scenario runs one pair with several settings
  std::string kind;       // "hull-hull", "sphere-plane", ..., a first
  std::string state;      // "touching" or "separated"
  double separation = 0;  // deepest point when touching, best axis when separated
  std::vector<Manifold> manifolds;
  std::optional<Sat> sat;
  std::optional<Clip> clip;
  std::optional<Reduction> reduction;
  std::optional<Degenerate> degenerate{};
  std::optional<Tree> tree{};
  std::optional<Gjk> gjk{};
  std::optional<Cache> cache{};  // empty too where there was nothing to try
  std::optional<Penetration> penetration{};
  std::optional<Minkowski> minkowski{};
  std::optional<Incremental> incremental{};
  std::optional<Stability> stability{};
};

/// A body moved by the solver, before the step that starts in this frame.
struct Body {
  std::string name;
  double mass = 0;                         // kilograms
  Vec3d center_of_mass = Vec3d::Zero();    // world
  Vec3d velocity = Vec3d::Zero();          // metres a second, of the centre of mass
  Vec3d angular_velocity = Vec3d::Zero();  // radians a second
  double kinetic_energy = 0;               // joules
  double potential_energy = 0;             // joules, against gravity; 0 at the origin

  friend bool operator==(const Body&, const Body&) = default;
};

/// The step of the solver that starts in this frame; impulses stand with the contact points.
struct Solver {
  std::string position_correction;  // "baumgarte", "projection", "soft"
  int iterations = 0;
  int substeps = 0;
  bool warm_start = false;
  double slop = 0;                // metres of overlap that are let be, as settled by the bodies
  double speculative_margin = 0;  // metres, likewise
  std::vector<Body> bodies;

  friend bool operator==(const Solver&, const Solver&) = default;
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

  friend bool operator==(const Totals&, const Totals&) = default;
};

struct Frame {
  int frame = 0;
  double time = 0;                                          // seconds
  std::vector<std::pair<std::string, Pose<double>>> poses;  // in the order of the shapes
  std::vector<Pair> pairs;
  std::optional<Solver> solver{};
  std::optional<Totals> totals{};  // where there is a solver, or a view shows plots
};

/// Of what else the frame holds.
Totals totals_of(const Frame& frame);

struct Header {
  std::string scenario;  // "hull/face_contact"
  std::string title;
  std::string source;
  std::string scalar;  // "float" or "double"
  std::string up;      // "y" or "z"
  int frames = 0;      // frames of the scenario, also when fewer were asked for
  std::vector<Shape> shapes;
};

}  // namespace contactscope::trace
