#include "manifold/incremental_query.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "query/hull_feature.h"
#include "query/tolerance.h"

namespace contactscope {
namespace {

/// A normal this far from a face's is another one, whatever rounding may do to it.
template <class S>
constexpr S kLargestSnap = S(0.01);

template <class S>
S scale_of_cores(const ShapeCore<S>& a, const ShapeCore<S>& b, const Pose<S>& b_in_a) {
  return a.reach() + b.reach() + b_in_a.position.norm();
}

/// The smallest feature of a core with all of the simplex's points on it. `of_b`: which side.
template <class S>
CoreFeature simplex_feature(const ShapeCore<S>& core, const GjkSimplex<S>& simplex, bool of_b) {
  GjkSimplex<S> own = simplex;  // with the core's points where feature_of_b looks for them
  if (!of_b)
    for (GjkVertex<S>& vertex : own.vertices) std::swap(vertex.index_a, vertex.index_b);
  const int distinct = own.distinct_b();
  const int first = own.vertices[0].index_b;
  if (core.kind != ShapeKind::Hull)
    return distinct == 1 ? CoreFeature{FeatureKind::Vertex, first}
                         : CoreFeature{FeatureKind::Edge, 0};
  const HullFeature feature = feature_of_b(core.hull, own);
  if (feature.index < 0) return {FeatureKind::Vertex, first};
  return {feature.kind, feature.kind == FeatureKind::Edge ? feature.index / 2 : feature.index};
}

/// The face of a hull whose outward normal is within `sine` of `direction` (unit, own frame).
template <class S>
int core_face_along(const Hull<S>& hull, const Vec3<S>& direction, S sine) {
  int best = -1;
  S least = sine;
  for (int face = 0; face < hull.face_count(); ++face) {
    const Vec3<S>& normal = hull.planes[static_cast<std::size_t>(face)].normal;
    if (!(normal.dot(direction) > S(0))) continue;
    const S off = normal.cross(direction).norm();
    if (off < least) {
      least = off;
      best = face;
    }
  }
  return best;
}

template <class S>
void snap_to_face(const ShapeCore<S>& a, const ShapeCore<S>& b, const Pose<S>& b_in_a,
                  CoreQuery<S>& query) {
  const S rounding = S(4) * tie_tolerance(query.scale);
  const S sine = std::min(kLargestSnap<S>, rounding / std::max(std::abs(query.distance), rounding) +
                                               S(4) * tie_tolerance(S(1)));
  int face = -1;
  if (a.kind == ShapeKind::Hull) face = core_face_along(a.hull, query.normal, sine);
  if (face >= 0) {
    query.normal = a.hull.planes[static_cast<std::size_t>(face)].normal;
    if (query.overlap) query.axis = AxisKind::FaceA;
    return;
  }
  if (b.kind == ShapeKind::Hull)
    face = core_face_along(b.hull, Vec3<S>(-b_in_a.inverse_rotate(query.normal)), sine);
  if (face < 0) return;
  query.normal = -b_in_a.rotate(b.hull.planes[static_cast<std::size_t>(face)].normal);
  if (query.overlap) query.axis = AxisKind::FaceB;
}

template <class S>
CoreQuery<S> query_half_space(const ShapeCore<S>& a, const ShapeCore<S>& b, const Pose<S>& b_in_a) {
  CoreQuery<S> query;
  query.scale = scale_of_cores(a, b, b_in_a);
  query.normal = -b_in_a.rotate(b.plane.normal);
  query.axis = AxisKind::FaceB;
  const int lowest = support_index(a.support(), query.normal);
  const Vec3<S> in_b = b_in_a.inverse_transform(a.vertex(lowest));
  query.distance = b.plane.normal.dot(in_b) - b.plane.offset;
  const Vec3<S>& on_a = a.vertex(lowest);
  query.closest = {on_a,
                   on_a + query.distance * query.normal,
                   {FeatureKind::Vertex, lowest},
                   {FeatureKind::Face, 0}};
  return query;
}

}  // namespace

template <class S>
std::optional<CoreQuery<S>> query_cores(const ShapeCore<S>& a, const ShapeCore<S>& b,
                                        const Pose<S>& b_in_a, PenetrationMethod method,
                                        GjkRun<S>* run, PenetrationSteps<S>* steps) {
  if (!b_in_a.position.allFinite() || !b_in_a.rotation.coeffs().allFinite()) return std::nullopt;
  if (b.kind == ShapeKind::Plane) return query_half_space(a, b, b_in_a);
  const SupportSet<S> set_a = a.support();
  const SupportSet<S> set_b = b.support();
  const GjkResult<S> result = gjk<S>(set_a, set_b, b_in_a, nullptr, run);

  CoreQuery<S> query;
  query.scale = scale_of_cores(a, b, b_in_a);
  query.normal = result.normal;
  query.distance = result.distance;
  query.closest = {result.on_a, result.on_b, simplex_feature(a, result.simplex, false),
                   simplex_feature(b, result.simplex, true)};
  if (result.status == GjkStatus::Touching || result.status == GjkStatus::Overlap) {
    const PenetrationResult<S> deep =
        penetration(method, set_a, set_b, b_in_a, PenetrationOptions<S>(), &result.simplex, steps);
    if (deep.status == PenetrationStatus::NotFinite) return std::nullopt;
    if (has_depth(deep.status)) {
      query.overlap = true;
      query.deep = deep;
      query.axis = AxisKind::EdgeEdge;  // unless it is a face's
      query.normal = deep.normal;
      query.distance = -deep.depth;
      query.closest.on_a = deep.on_a;
      query.closest.on_b = deep.on_b;
    }
  }
  snap_to_face(a, b, b_in_a, query);
  return query;
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                               \
  template std::optional<CoreQuery<S>> query_cores(const ShapeCore<S>&, const ShapeCore<S>&,      \
                                                   const Pose<S>&, PenetrationMethod, GjkRun<S>*, \
                                                   PenetrationSteps<S>*);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
