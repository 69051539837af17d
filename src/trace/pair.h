#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "trace/clip.h"
#include "trace/contact.h"
#include "trace/decision.h"
#include "trace/field_slice.h"
#include "trace/impact.h"
#include "trace/minkowski.h"
#include "trace/query.h"
#include "trace/sat.h"
#include "trace/shape.h"
#include "trace/stage.h"

namespace contactscope::trace {

inline constexpr std::array<int, 2> kNoEdge = {{-1, -1}};

/// What one point was worth at one step of a reducer, seen against the normal.
struct Measure {
  int point = -1;                     // index into the points
  std::array<int, 2> edge = kNoEdge;  // that it was measured against, where it was one
  double value = 0;                   // metres, or square metres with a sign for areas

  static constexpr auto fields() {
    return field::list(field::exact("point", &Measure::point).into("points"),
                       field::exact("edge", &Measure::edge).into("points").where_set(),
                       field::area("value", &Measure::value));
  }
};

/// How one kept point was chosen.
struct Choice {
  /// "support", "deepest", "farthest", "triangle", "outside", "distance".
  std::string rule;
  Vec3d direction = Vec3d::Zero();  // unit, of "support"
  std::vector<Measure> measures;    // of every candidate what decided; of the chosen one all

  /// Whether its measures are against an edge.
  bool is_against_edges() const {
    return rule == "triangle" || rule == "outside" || rule == "distance";
  }

  static constexpr auto fields() {
    return field::list(field::exact("rule", &Choice::rule),
                       field::direction("direction", &Choice::direction).where_set(),
                       field::facts("measures", &Choice::measures).entries("measure"));
  }
};

struct Reduction {
  std::string method;
  std::vector<Point> points;    // all, before
  std::vector<int> kept;        // indices into points, in the order of choice
  double area = 0;              // square metres, of the convex hull of the kept points in the plane
  double best_area = 0;         // largest that as many points can span
  std::vector<int> best;        // the points that span it; empty where nobody looked
  std::vector<Choice> choices;  // for each kept point, where the method has such steps

  static constexpr auto fields() {
    return field::list(field::exact("method", &Reduction::method),
                       field::facts("points", &Reduction::points).entries("reduction point"),
                       field::exact("kept", &Reduction::kept).into("points"),
                       field::area("area", &Reduction::area),
                       field::area("best_area", &Reduction::best_area),
                       field::exact("best", &Reduction::best).into("points").where_set(),
                       field::facts("choices", &Reduction::choices).where_set().entries("choice"));
  }
};

// Stages that go by earlier frames, or tell what comes of a manifold in later ones.

/// Temporal coherence: what was kept of an earlier frame was tried before the full test.
struct Cache {
  bool hit = false;             // it gave the result, and the full test did not run
  std::string kind;             // "separating_axis", or "features": those that touched
  std::string axis;             // "face_a", "face_b", "edge_edge"; that was tried
  std::optional<Vec3d> normal;  // unit, from a to b; of a hit
  /// Metres, of features: no point of one shape, seen from the other, has moved farther since the
  /// full test that found them.
  std::optional<double> moved;

  static constexpr auto fields() {
    return field::list(
        field::exact("hit", &Cache::hit).says("").called("miss", "hit"),
        field::exact("kind", &Cache::kind), field::axis("axis", &Cache::axis).optional(),
        field::direction_to_b("normal", &Cache::normal), field::length("moved", &Cache::moved));
  }
};

/// A point of an incremental manifold, and what became of it in this frame.
struct PersistentPoint {
  Point point;         // with the places of both shapes that met when it was found
  std::string state;   // "new", "persisted", "broken"
  std::string reason;  // of "broken": "apart", "slid", "other features", "replaced", "reduced"
  int age = 0;         // frames since it was found

  Vec3d on_a() const { return point.on_a.value_or(point.position); }
  Vec3d on_b() const { return point.on_b.value_or(point.position); }

  static constexpr auto fields() {
    using P = PersistentPoint;
    return field::list(field::merged(&P::point), field::exact("state", &P::state),
                       field::exact("reason", &P::reason).where_set(),
                       field::exact("age", &P::age));
  }
};

struct Incremental {
  std::string confirm;  // "distance", "ids": how old points are confirmed
  std::string query;    // "gjk": the cores were apart; else the method that measured their overlap
  double margin_a = 0;  // metres about the core of a
  double margin_b = 0;
  std::vector<PersistentPoint> points;  // those of the manifold, then the broken ones

  static constexpr auto fields() {
    using I = Incremental;
    return field::list(
        field::exact("confirm", &I::confirm), field::exact("query", &I::query),
        field::length("margin_a", &I::margin_a).swaps(&I::margin_b).says("margin of a"),
        field::length("margin_b", &I::margin_b).says("margin of b"),
        field::facts("points", &I::points).entries("persistent point"));
  }
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

  static constexpr auto fields() {
    using S = Stability;
    return field::list(field::exact("shape", &S::shape),
                       field::position("center_of_mass", &S::center_of_mass).says("centre of mass"),
                       field::position("projection", &S::projection),
                       field::position("support", &S::support), field::length("margin", &S::margin),
                       field::exact("verdict", &S::verdict).reported_first(),
                       field::position("axis", &S::axis));
  }
};

/// Axis-aligned box in the frame of a shape, metres.
struct Box {
  Vec3d lower = Vec3d::Zero();
  Vec3d upper = Vec3d::Zero();

  static constexpr auto fields() {
    return field::list(field::position("lower", &Box::lower).says("lower corner of the box"),
                       field::position("upper", &Box::upper).says("upper corner of the box"));
  }
  friend bool operator==(const Box&, const Box&) = default;
};

/// A box of a mesh's tree that the query looked at.
struct TreeVisit {
  Box box;
  int depth = 0;  // 0 at the root
  bool leaf = false;
  bool overlaps = false;  // with the box of the query; only then what is below was looked at

  static constexpr auto fields() {
    return field::list(
        field::fact("box", &TreeVisit::box), field::exact("depth", &TreeVisit::depth),
        field::exact("leaf", &TreeVisit::leaf), field::exact("overlaps", &TreeVisit::overlaps));
  }
  friend bool operator==(const TreeVisit&, const TreeVisit&) = default;
};

/// How the triangles of a mesh were collected. Boxes in the mesh's own frame.
struct Tree {
  std::string shape;  // the mesh
  Box box;            // of the other shape, grown by the margin
  std::vector<TreeVisit> visits;
  std::vector<int> candidates;  // triangles whose boxes the query's touches

  static constexpr auto fields() {
    return field::list(field::exact("shape", &Tree::shape).says("of"),
                       field::fact("box", &Tree::box),
                       field::facts("visits", &Tree::visits).entries("tree box", "boxes"),
                       field::exact("candidates", &Tree::candidates));
  }
};

/// The geometry had no normal of its own.
struct Degenerate {
  std::string geometry;  // "coincident centres", ...
  std::string answer;    // "fallback": a normal was chosen; "skip": no contact was made

  static constexpr auto fields() {
    return field::list(field::exact("geometry", &Degenerate::geometry),
                       field::exact("answer", &Degenerate::answer));
  }
  friend bool operator==(const Degenerate&, const Degenerate&) = default;
};

/// Which optional stages to record: what no picture shows need not be written down. The arcs of the
/// Gauss map, the Minkowski difference, the cells of a broad phase, the node pairs of two trees and the
/// slices through distance fields are large and say nothing that the shapes do not: they are only
/// recorded where a view asks for them.
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
  bool query = true;   // bounds, axes and triangles that cross; the answer is always told
  bool cells = false;  // of a broad phase
  bool node_pairs = false;
  bool fields = false;       // slices through distance fields, and where they were asked
  bool decisions = false;    // by which margins the pipeline chose
  bool flip = false;         // what change of pose would change the points: a search
  int flip_directions = 16;  // of that search
  int flip_seed = 1;

  static constexpr Stages none() {
    return {false, false, false, false, false, false, false, false,
            false, false, false, false, false, false, false};
  }
};

/// What the pipeline decided of two shapes in one frame. A stage that did not run, or that nobody
/// asked for, is empty. A new stage is a struct with fields(), a member here and a row in the list;
/// all else but what fills it follows.
struct Pair {
  std::string a;
  std::string b;
  std::string label;      // set when a scenario runs one pair with several settings
  std::string kind;       // "hull-hull", "sphere-plane", ..., a first
  std::string state;      // "touching" or "separated"
  double separation = 0;  // deepest point when touching, best axis when separated
  std::vector<Manifold> manifolds;
  Stage<Sat> sat;
  Stage<Clip> clip;
  Stage<Reduction> reduction;
  Stage<Degenerate> degenerate{};
  Stage<Tree> tree{};
  Stage<Gjk> gjk{};
  Stage<Cache> cache{};  // empty too where there was nothing to try
  Stage<Penetration> penetration{};
  Stage<Minkowski> minkowski{};
  Stage<Incremental> incremental{};
  Stage<Stability> stability{};
  std::optional<bool> overlap{};  // where the pair was asked for something else than its manifold
  Stage<Query> query{};           // likewise; such a pair has no manifolds
  std::vector<Intersection> intersections{};  // of two meshes
  Stage<Impact> impact{};                     // where the pair is asked when it meets
  Stage<FieldProbes> field_probes{};          // with a distance field, where a view shows it
  std::vector<Decision> decisions{};          // in the order in which they were taken
  Stage<Flip> flip{};

  /// A trace may leave the separation out; see complete().
  static void mark_missing(Pair& pair) {
    pair.separation = std::numeric_limits<double>::quiet_NaN();
  }

  static constexpr auto fields() {
    return field::list(
        field::exact("a", &Pair::a).swaps(&Pair::b).names(), field::exact("b", &Pair::b).names(),
        field::exact("label", &Pair::label).where_set().names(),
        field::exact("kind", &Pair::kind).optional().mirror(Mirrored::KindTurned),
        field::exact("state", &Pair::state).optional().says(""),
        // It mostly repeats what a point says.
        field::length("separation", &Pair::separation)
            .otherwise_by(&Pair::mark_missing)
            .reported_last(),
        field::facts("manifolds", &Pair::manifolds).entries("manifold"),  //
        field::fact("sat", &Pair::sat).called("sat"),                     //
        field::fact("clip", &Pair::clip).called("clip"),
        field::fact("reduction", &Pair::reduction).called("reduction"),
        field::fact("gjk", &Pair::gjk).called("gjk"),     //
        field::fact("tree", &Pair::tree).called("tree"),  //
        field::fact("degenerate", &Pair::degenerate).called("degenerate"),
        field::fact("cache", &Pair::cache).called("cache"),
        field::fact("penetration", &Pair::penetration).called("penetration"),
        field::fact("minkowski", &Pair::minkowski).called("minkowski"),
        field::fact("incremental", &Pair::incremental).called("incremental"),
        field::fact("stability", &Pair::stability).called("stability"),
        field::exact("overlap", &Pair::overlap), field::fact("query", &Pair::query).called("query"),
        field::facts("intersections", &Pair::intersections).where_set().entries("intersection"),
        field::fact("impact", &Pair::impact).called("impact"),
        field::fact("field_probes", &Pair::field_probes).called("field probes"),
        field::facts("decisions", &Pair::decisions).where_set().entries("decision"),
        field::fact("flip", &Pair::flip).called("flip"));
  }
};

/// The same facts told of the same two shapes in the other order: a and b trade places, with
/// everything that is of one of them; what points from a to b is negated, ids and names of axes are
/// of the other shape. Twice is the identity.
void mirror(Pair& pair);

}  // namespace contactscope::trace
