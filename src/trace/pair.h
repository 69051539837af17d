#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trace/clip.h"
#include "trace/contact.h"
#include "trace/lasting.h"
#include "trace/minkowski.h"
#include "trace/reduction.h"
#include "trace/sat.h"

namespace contactscope::trace {

/// Axis-aligned box in the frame of a shape, metres.
struct Box {
  Vec3d lower = Vec3d::Zero();
  Vec3d upper = Vec3d::Zero();

  static constexpr auto fields() {
    return std::tuple(field::position("lower", &Box::lower).says("lower corner of the box"),
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
    return std::tuple(field::fact("box", &TreeVisit::box), field::exact("depth", &TreeVisit::depth),
                      field::exact("leaf", &TreeVisit::leaf),
                      field::exact("overlaps", &TreeVisit::overlaps));
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
    return std::tuple(field::exact("shape", &Tree::shape).says("of"),
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
    return std::tuple(field::exact("geometry", &Degenerate::geometry),
                      field::exact("answer", &Degenerate::answer));
  }
  friend bool operator==(const Degenerate&, const Degenerate&) = default;
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

  static constexpr auto fields() {
    return std::tuple(field::exact("a", &Pair::a).swaps(&Pair::b).names(),
                      field::exact("b", &Pair::b).names(),
                      field::exact("label", &Pair::label).where_set().names(),
                      field::exact("kind", &Pair::kind).mirror(Mirrored::KindTurned),
                      field::exact("state", &Pair::state).says(""),
                      // It mostly repeats what a point says.
                      field::length("separation", &Pair::separation).told_last(),
                      field::facts("manifolds", &Pair::manifolds).entries("manifold"),  //
                      field::fact("sat", &Pair::sat).apart("sat"),                      //
                      field::fact("clip", &Pair::clip).apart("clip"),
                      field::fact("reduction", &Pair::reduction).apart("reduction"),
                      field::fact("gjk", &Pair::gjk).apart("gjk"),     //
                      field::fact("tree", &Pair::tree).apart("tree"),  //
                      field::fact("degenerate", &Pair::degenerate).apart("degenerate"),
                      field::fact("cache", &Pair::cache).apart("cache"),
                      field::fact("penetration", &Pair::penetration).apart("penetration"),
                      field::fact("minkowski", &Pair::minkowski).apart("minkowski"),
                      field::fact("incremental", &Pair::incremental).apart("incremental"),
                      field::fact("stability", &Pair::stability).apart("stability"));
  }
};

}  // namespace contactscope::trace
