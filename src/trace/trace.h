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

/// A contact point: separation in metres along the normal, negative = overlap.
struct Point {
  Vec3d position = Vec3d::Zero();
  double separation = 0;
  std::string id;  // "a:e3 b:e7"
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

struct Sat {
  std::optional<FaceAxis> face_a;
  std::optional<FaceAxis> face_b;
  std::optional<EdgeAxis> edge;
  std::string chosen;  // "face_a", "face_b", "edge_edge"; what separates, or what makes the contact
  std::string preference;  // "relative" or "none"
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

/// Which optional stages to record: what no picture shows need not be written down.
struct Stages {
  bool sat = true;
  bool clip = true;
  bool reduction = true;
  bool tree = true;
  bool gjk = true;
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
};

struct Frame {
  int frame = 0;
  double time = 0;                                          // seconds
  std::vector<std::pair<std::string, Pose<double>>> poses;  // in the order of the shapes
  std::vector<Pair> pairs;
};

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
