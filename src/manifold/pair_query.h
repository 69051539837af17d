#pragma once

#include "geometry/bounds.h"
#include "manifold/capabilities.h"
#include "manifold/dispatch.h"
#include "query/mesh_overlap.h"
#include "query/overlap.h"
#include "query/v_clip.h"

/// Queries other than the manifold: overlap, touching, distance, depth, of shapes or their bounds.
namespace contactscope {

/// Whether shapes that only touch overlap.
enum class QueryComparison {
  Exclusive,  // they do not
  Inclusive,  // they do
  Proper,     // nor do triangles of two meshes that overlap within one plane
};

constexpr const char* to_string(QueryComparison comparison) {
  constexpr const char* kNames[] = {"exclusive", "inclusive", "proper"};
  return kNames[static_cast<int>(comparison)];
}

/// How the distance of two hulls is found.
enum class DistanceMethod { Gjk, VClip };

constexpr const char* to_string(DistanceMethod method) {
  return method == DistanceMethod::Gjk ? "gjk" : "v_clip";
}

/// A query and how its answer is compared. Lengths in metres.
struct Question {
  QueryKind kind = QueryKind::Manifold;
  /// Aabb, Obb or BoundingSphere: query these bounds; empty: query the shapes themselves.
  std::optional<QueryMethod> bounds{};
  QueryComparison comparison = QueryComparison::Inclusive;
  double tolerance =
      0;  // for inclusive Overlap and for Touching: separations up to this count as zero
  ObbTest<double> test{};                                  // for oriented boxes
  PenetrationMethod penetration = PenetrationMethod::Sat;  // for convex shapes, one of them a hull
  DistanceMethod distance = DistanceMethod::Gjk;           // for two hulls

  bool inclusive() const { return comparison == QueryComparison::Inclusive; }
  friend bool operator==(const Question&, const Question&) = default;
};

/// Why two shapes of these kinds cannot answer a query, with the remedy and without a full stop;
/// empty if they can. For a manifold: why collide() cannot do it.
std::optional<std::string> refusal(const Question& question, ShapeKind one, ShapeKind other);

template <class S> struct Answer {
  bool overlap = false;            // they share a point, under the query's comparison
  std::optional<bool> touching{};  // for Touching: the surfaces meet and no more than that
  /// Metres between the shapes, negative: depth. For bounds the largest separation along an axis,
  /// except for Distance. Empty where the method measures none: GJK gives no depth for two hulls.
  std::optional<S> gap{};
  QueryMethod method = QueryMethod::Gjk;     // the method that answered
  std::optional<MeshOverlapCounts> trees{};  // for two meshes, except of their bounds
};

/// Bounds of one shape in its own frame, computed at first use.
template <class S> class OwnBounds {
 public:
  const std::optional<Obb<S>>& obb(const Shape<S>& shape) {
    if (!obb_) obb_ = obb_of(shape);
    return *obb_;
  }
  const std::optional<BoundingSphere<S>>& sphere(const Shape<S>& shape) {
    if (!sphere_) sphere_ = bounding_sphere_of(shape);
    return *sphere_;
  }

 private:
  std::optional<std::optional<Obb<S>>> obb_;
  std::optional<std::optional<BoundingSphere<S>>> sphere_;
};

/// A shape placed in the world, with cached bounds of its own; reset them when it deforms.
template <class S> struct QueriedShape {
  const Shape<S>& shape;
  const Pose<S>& pose;
  OwnBounds<S>& bounds;
};

/// Where the last query of a pair ended.
struct QueryMemory {
  MeshFront front;                             // of two meshes, see mesh_overlap()
  GjkSimplex<double> simplex;                  // of two cores, see gjk()
  std::optional<ComparedFeatures> features{};  // of two hulls, see v_clip()
};

/// Answers a query that refusal() accepts and whose kind is not Manifold.
///
/// Convex shapes: GJK of the cores less the radii, or V-Clip of two separated hulls; where the cores overlap and the depth matters,
/// the query's penetration method. Convex shape and plane: the farthest point along the plane's
/// normal. Convex shape and mesh: contacts of the mesh's triangles, which are a surface, so a shape
/// wholly inside a closed mesh does not touch it. Two meshes: triangles that share a point; if
/// there are none and both meshes are watertight, one inside the other.
///
/// Separations within rounding count as touching. Rounding is the change of the separation when
/// each number that places the closest points changes by two roundings in the shapes' scalar; see
/// rounding_along() in queried_pair.h. Everything is computed in double. So an inclusive query never
/// reports overlapping shapes as separated, and an exclusive one never reports separated shapes as
/// overlapping. Two meshes are compared exactly, see mesh_overlap.h; for bounds see overlap.h.
///
/// `b_first`, `record` and `stages` are as in collide(): the record is in the order of the
/// arguments and does not change the answer. `memory`: where the last call for this pair ended and
/// this one starts; null: trees are traversed from their roots, and GJK starts with one point.
template <class S>
Answer<S> query_pair(const QueriedShape<S>& a, const QueriedShape<S>& b, const Question& question,
                     bool b_first = false, trace::Pair* record = nullptr,
                     const trace::Stages& stages = kUsualStages, QueryMemory* memory = nullptr);

/// Records the state of a pair, the answer and, if known, the separation. Works without a Recorder.
/// Without a separation the record keeps its own.
template <class S> void record_answer(const Answer<S>& answer, trace::Pair& record);

}  // namespace contactscope
