#pragma once

#include <optional>
#include <string>
#include <type_traits>

#include "geometry/bounds.h"
#include "manifold/capabilities.h"
#include "manifold/dispatch.h"
#include "query/mesh_overlap.h"
#include "query/overlap.h"

/// What two shapes are asked instead of their manifold: whether they overlap, whether they touch, how
/// far apart they are, how deep they are in each other; of the shapes themselves or of their bounds.
namespace contactscope {

/// What is asked, and how the answer is compared. Lengths in metres.
struct Question {
  QueryKind kind = QueryKind::Manifold;
  /// Aabb, Obb or BoundingSphere: it is asked of the bounds; empty: of the shapes themselves.
  std::optional<QueryMethod> bounds{};
  bool inclusive = true;  // what touches overlaps
  double tolerance =
      0;  // of Overlap, inclusive, and of Touching: a gap of up to this counts as none
  ObbTest<double> test{};                                  // of oriented boxes
  PenetrationMethod penetration = PenetrationMethod::Sat;  // of convex shapes, one of them a hull

  friend bool operator==(const Question&, const Question&) = default;
};

/// Why a question cannot be asked of two shapes of these kinds, with the remedy and without a full
/// stop; nothing where it can. Of a manifold it is what collide() cannot do.
std::optional<std::string> refusal(const Question& question, ShapeKind one, ShapeKind other);

template <class S>
struct Answer {
  bool overlap = false;            // they share a point, as the question compares it
  std::optional<bool> touching{};  // of Touching: no more than that
  /// Metres between them, negative: how deep. Of bounds the largest gap along an axis, unless the
  /// distance was asked. Empty where the method does not say: GJK does not know how deep two hulls
  /// are in each other.
  std::optional<S> gap{};
  QueryMethod method = QueryMethod::Gjk;     // that answered
  std::optional<MeshOverlapCounts> trees{};  // of two meshes that were asked themselves
};

/// Bounds of one shape in its own frame, made when they are first asked for.
template <class S>
class OwnBounds {
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

/// A shape placed in the world, with what is kept of it. `bounds` belong to this shape alone, and are
/// to be made anew when it is deformed.
template <class S>
struct AskedShape {
  const Shape<S>& shape;
  const Pose<S>& pose;
  OwnBounds<S>& bounds;
};

/// Answers a question that refusal() lets pass, and which is not for the manifold.
///
/// Of convex shapes: GJK of the cores less the radii; where the cores overlap and the depth matters,
/// the penetration method of the question. Of a convex shape and a plane: the farthest point along
/// the plane's normal. Of a convex shape and a mesh: contacts of its triangles, a surface; what is
/// wholly inside a closed mesh does not touch it. Of two meshes: triangles that share a point, or,
/// where there are none and both are watertight, one inside the other.
///
/// What lies within rounding of touching counts as touching: by how much the gap changes where each number
/// that places the closest points changes by two roundings, in the scalar of the shapes, see
/// rounding_along() in asked_pair.h. All is computed in double. So, inclusive, no shapes that overlap are
/// called apart, and exclusive, none that are apart are called overlapping. Two meshes are compared
/// exactly, see mesh_overlap.h; bounds have bounds of their own, see overlap.h.
///
/// `b_first`, `record` and `stages` are those of collide(): the record is in the order of the
/// arguments, and changes no bit of the answer. `front` is of two meshes, see mesh_overlap(): where the
/// last call for this pair ended; nullptr: their trees are gone through from the roots.
template <class S>
Answer<S> ask(const AskedShape<S>& a, const AskedShape<S>& b, const Question& question,
              bool b_first = false, trace::Pair* record = nullptr,
              const trace::Stages& stages = kUsualStages, MeshFront* front = nullptr);

/// What a pair came to, also of one that nobody watched: its state, the answer, and the gap where it
/// is known. Without it the record's separation stays.
template <class S>
void record_answer(const Answer<S>& answer, trace::Pair& record);

}  // namespace contactscope
