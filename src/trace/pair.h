#pragma once

#include "trace/clip.h"
#include "trace/contact.h"
#include "trace/decision.h"
#include "trace/field_slice.h"
#include "trace/impact.h"
#include "trace/minkowski.h"
#include "trace/query.h"
#include "trace/sat.h"

namespace contactscope::trace {

inline constexpr std::array<int, 2> kNoEdge = {{-1, -1}};

/// The score of one point in one step of a reducer, seen against the normal.
struct Measure {
  int point = -1;                     // index into the points
  std::array<int, 2> edge = kNoEdge;  // measured against, if any
  double value = 0;                   // metres; square metres, with a sign, for areas

  static constexpr auto fields() {
    return field::list(field::exact<&Measure::point>.into("points"),
                       field::exact<&Measure::edge>.into("points").where_set(),
                       field::area<&Measure::value>);
  }
};

struct Choice {
  /// "support", "deepest", "farthest", "triangle", "outside", "distance".
  std::string rule;
  Vec3d direction = Vec3d::Zero();  // unit, for "support"
  std::vector<Measure> measures;    // deciding value for each candidate; all for the chosen one

  bool is_against_edges() const {
    return rule == "triangle" || rule == "outside" || rule == "distance";
  }

  static constexpr auto fields() {
    return field::list(field::exact<&Choice::rule>,
                       field::direction<&Choice::direction>.where_set(),
                       field::facts<&Choice::measures>.entries("measure"));
  }
};

struct Reduction {
  std::string method;
  std::vector<Point> points;    // before the reduction
  std::vector<int> kept;        // indices into points, in order of choice
  double area = 0;              // square metres, of the convex hull of the kept points in the plane
  double best_area = 0;         // largest area of as many points
  std::vector<int> best;        // the points with that area; empty: not computed
  std::vector<Choice> choices;  // for each kept point, if the method has such steps

  static constexpr auto fields() {
    return field::list(field::exact<&Reduction::method>,
                       field::facts<&Reduction::points>.entries("reduction point"),
                       field::exact<&Reduction::kept>.into("points"), field::area<&Reduction::area>,
                       field::area<&Reduction::best_area>,
                       field::exact<&Reduction::best>.into("points").where_set(),
                       field::facts<&Reduction::choices>.where_set().entries("choice"));
  }
};

/// The contacts of a mesh's triangles that became one manifold.
struct MergedManifold {
  std::vector<int> triangles;  // ascending
  int points = 0;              // of all triangles; the reduction counts shared points once

  static constexpr auto fields() {
    using M = MergedManifold;
    return field::list(field::exact<&M::triangles>, field::exact<&M::points>);
  }
};

/// How the contacts of a mesh's triangles became manifolds of the pair.
struct Merge {
  std::vector<MergedManifold> manifolds;  // in the order of Pair::manifolds

  static constexpr auto fields() {
    return field::list(field::facts<&Merge::manifolds>.entries("merged manifold"));
  }
};

// Stages that depend on earlier frames, or that predict the stability of a manifold.

/// Temporal coherence: the result of an earlier frame was tried before the full test.
struct Cache {
  bool hit = false;             // it gave the result without the full test
  std::string kind;             // "separating_axis", or "features" for the touching features
  std::string axis;             // the one tried: "face_a", "face_b", "edge_edge"
  std::optional<Vec3d> normal;  // unit, from a to b; for a hit
  /// Metres, for features: largest relative movement of a point of one shape, seen from the other,
  /// since the full test that found them.
  std::optional<double> moved;

  static constexpr auto fields() {
    return field::list(field::exact<&Cache::hit>.says("").called("miss", "hit"),
                       field::exact<&Cache::kind>, field::axis<&Cache::axis>.optional(),
                       field::direction_to_b<&Cache::normal>, field::length<&Cache::moved>);
  }
};

/// A point of an incremental manifold and its state in this frame.
struct PersistentPoint {
  Point point;         // on_a and on_b are the points of both shapes that touched when it was found
  std::string state;   // "new", "persisted", "broken"
  std::string reason;  // for "broken": "slid", "replaced", ..., as BrokenPoint::reason
  int age = 0;         // frames since it was found

  Vec3d on_a() const { return point.on_a.value_or(point.position); }
  Vec3d on_b() const { return point.on_b.value_or(point.position); }

  static constexpr auto fields() {
    using P = PersistentPoint;
    return field::list(field::merged(&P::point), field::exact<&P::state>,
                       field::exact<&P::reason>.where_set(), field::exact<&P::age>);
  }
};

struct Incremental {
  std::string confirm;  // "distance", "ids": how old points are confirmed
  std::string query;    // "gjk": separated cores; else the method that measured their overlap
  double margin_a = 0;  // metres around the core of a
  double margin_b = 0;
  std::optional<double> rejects_within;  // metres of an old point, unless new points replace it
  std::vector<PersistentPoint> points;   // points of the manifold, then the broken ones

  static constexpr auto fields() {
    using I = Incremental;
    return field::list(field::exact<&I::confirm>, field::exact<&I::query>,
                       field::length<&I::margin_a>.swaps(&I::margin_b).says("margin of a"),
                       field::length<&I::margin_b>.says("margin of b"),
                       field::length<&I::rejects_within>,
                       field::facts<&I::points>.entries("persistent point"));
  }
};

/// Whether a body can rest on a manifold: whether its centre of mass, projected along the normal,
/// is inside the contact points (Gregorius 2015, "Incremental Manifold Stability").
struct Stability {
  std::string shape;  // the shape whose centre of mass is tested
  Vec3d center_of_mass = Vec3d::Zero();
  Vec3d projection = Vec3d::Zero();  // into the contact plane
  Polygon support;                   // corners of the convex hull of the points in that plane
  double margin = 0;    // metres from the projection to the support's border, negative outside
  std::string verdict;  // "stable", "turns about a point", "turns about a line", "no contact"
  std::optional<std::array<Vec3d, 2>> axis;  // two points on it, for "turns about a line"

  static constexpr auto fields() {
    using S = Stability;
    return field::list(
        field::exact<&S::shape>, field::position<&S::center_of_mass>.says("centre of mass"),
        field::position<&S::projection>, field::position<&S::support>, field::length<&S::margin>,
        field::exact<&S::verdict>.reported_first(), field::position<&S::axis>);
  }
};

/// Axis-aligned box in the frame of a shape, metres.
struct Box {
  Vec3d lower = Vec3d::Zero();
  Vec3d upper = Vec3d::Zero();

  static constexpr auto fields() {
    return field::list(field::position<&Box::lower>.says("lower corner of the box"),
                       field::position<&Box::upper>.says("upper corner of the box"));
  }
  friend bool operator==(const Box&, const Box&) = default;
};

/// A box of a mesh's tree that the query tested.
struct TreeVisit {
  Box box;
  int depth = 0;  // 0 at the root
  bool leaf = false;
  bool overlaps = false;  // with the query's box; the query then continues below

  static constexpr auto fields() {
    return field::list(field::fact<&TreeVisit::box>, field::exact<&TreeVisit::depth>,
                       field::exact<&TreeVisit::leaf>, field::exact<&TreeVisit::overlaps>);
  }
  friend bool operator==(const TreeVisit&, const TreeVisit&) = default;
};

/// How the triangles of a mesh were collected. Boxes are in the mesh's frame.
struct Tree {
  std::string shape;  // the mesh
  Box box;            // of the other shape, expanded by the margin
  std::vector<TreeVisit> visits;
  std::vector<int> candidates;  // triangles whose boxes touch the query's

  static constexpr auto fields() {
    return field::list(field::exact<&Tree::shape>.says("of"), field::fact<&Tree::box>,
                       field::facts<&Tree::visits>.entries("tree box", "boxes"),
                       field::exact<&Tree::candidates>);
  }
};

/// The geometry has no normal of its own.
struct Degenerate {
  std::string geometry;  // "coincident centres", ...
  std::string answer;    // "fallback": a normal was chosen; "skip": no contact was created

  static constexpr auto fields() {
    return field::list(field::exact<&Degenerate::geometry>, field::exact<&Degenerate::answer>);
  }
  friend bool operator==(const Degenerate&, const Degenerate&) = default;
};

/// A contact with an edge or a face that the surface does not have, because a shape next to it
/// continues it there. A contact with a face of the surface took its place, if there is one.
struct Voided {
  std::string shape;             // whose edge or face it was
  std::string reason;            // "covered face" or "continued edge"
  Vec3d normal = Vec3d::Zero();  // unit, from a to b
  std::vector<Point> points;

  static constexpr auto fields() {
    return field::list(field::exact<&Voided::shape>.says("of"), field::exact<&Voided::reason>,
                       field::direction_to_b<&Voided::normal>,
                       field::facts<&Voided::points>.entries("point"));
  }
};

/// Optional stages to record; stages that no picture shows can be left out. Gauss map arcs, the
/// Minkowski difference, broad phase cells, node pairs of two trees and distance field slices are
/// large and follow from the shapes, so they are only recorded if a view needs them.
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
  bool query = true;   // bounds, axes and crossing triangles; the answer is always recorded
  bool cells = false;  // of a broad phase
  bool node_pairs = false;
  bool fields = false;       // slices through distance fields, and the queried points
  bool decisions = false;    // the margins by which the pipeline chose
  bool flip = false;         // which change of pose would change the points: a search
  int flip_directions = 16;  // of that search
  int flip_seed = 1;

  static constexpr Stages none() {
    return {false, false, false, false, false, false, false, false,
            false, false, false, false, false, false, false};
  }
};

/// Decisions of the pipeline about two shapes in one frame. Stages that did not run, or were not
/// recorded, are empty. A new stage is a struct with fields(), a member here and a row in the list;
/// only the code that fills it is extra.
struct Pair {
  std::string a;
  std::string b;
  std::string label;      // set when a scenario runs one pair with several settings
  std::string kind;       // "hull-hull", "sphere-plane", ...; a first
  std::string state;      // "touching" or "separated"
  double separation = 0;  // deepest point if touching, best axis if separated
  std::vector<Manifold> manifolds;
  Stage<Sat> sat;
  Stage<Clip> clip;
  Stage<Reduction> reduction;
  std::optional<int> triangle{};  // of a mesh: the one with the stages sat and clip
  Stage<Degenerate> degenerate{};
  Stage<Tree> tree{};
  Stage<Voided> voided{};
  Stage<Merge> merge{};  // the reduction is that of the first manifold
  Stage<Gjk> gjk{};
  Stage<Cache> cache{};  // also empty if there was nothing to try
  Stage<Penetration> penetration{};
  Stage<Minkowski> minkowski{};
  Stage<Incremental> incremental{};
  Stage<Stability> stability{};
  std::optional<bool> overlap{};  // if the pair was queried for something else than its manifold
  Stage<Query> query{};           // likewise; such a pair has no manifolds
  std::vector<Intersection> intersections{};  // of two meshes
  Stage<Impact> impact{};                     // if the pair was queried for a time of impact
  Stage<FieldProbes> field_probes{};          // with a distance field, if a view shows it
  std::vector<Decision> decisions{};          // in the order in which they were made
  Stage<Flip> flip{};

  /// A trace may omit the separation; see complete().
  static void mark_missing(Pair& pair) {
    pair.separation = std::numeric_limits<double>::quiet_NaN();
  }

  static constexpr auto fields() {
    return field::list(
        field::exact<&Pair::a>.swaps(&Pair::b).names(), field::exact<&Pair::b>.names(),
        field::exact<&Pair::label>.where_set().names(),
        field::exact<&Pair::kind>.optional().mirror(Mirrored::KindTurned),
        field::exact<&Pair::state>.optional().says(""),
        // Reported last because it mostly repeats a point's separation.
        field::length<&Pair::separation>.otherwise_by(&Pair::mark_missing).reported_last(),
        field::facts<&Pair::manifolds>.entries("manifold"),  //
        field::exact<&Pair::triangle>,                       //
        field::fact<&Pair::sat>.called("sat"),               //
        field::fact<&Pair::clip>.called("clip"), field::fact<&Pair::reduction>.called("reduction"),
        field::fact<&Pair::gjk>.called("gjk"),    //
        field::fact<&Pair::tree>.called("tree"),  //
        field::fact<&Pair::merge>.called("merge"),
        field::fact<&Pair::voided>.called("voided contact"),
        field::fact<&Pair::degenerate>.called("degenerate"),
        field::fact<&Pair::cache>.called("cache"),
        field::fact<&Pair::penetration>.called("penetration"),
        field::fact<&Pair::minkowski>.called("minkowski"),
        field::fact<&Pair::incremental>.called("incremental"),
        field::fact<&Pair::stability>.called("stability"), field::exact<&Pair::overlap>,
        field::fact<&Pair::query>.called("query"),
        field::facts<&Pair::intersections>.where_set().entries("intersection"),
        field::fact<&Pair::impact>.called("impact"),
        field::fact<&Pair::field_probes>.called("field probes"),
        field::facts<&Pair::decisions>.where_set().entries("decision"),
        field::fact<&Pair::flip>.called("flip"));
  }
};

/// Swaps a and b: the same facts for the same two shapes in the other order. Data of the two shapes
/// is swapped, directions from a to b are negated, ids and axis names are those of the other shape.
/// Mirroring twice is the identity.
void mirror(Pair& pair);

}  // namespace contactscope::trace
