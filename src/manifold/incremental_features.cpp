#include <cmath>
#include <vector>

#include "manifold/incremental_query.h"
#include "query/tolerance.h"

namespace contactscope {
namespace {

/// The corners of a feature in the frame of `core_in_a`'s parent; of a half-space's face none.
template <class S>
std::vector<Vec3<S>> feature_corners(const ShapeCore<S>& core, const CoreFeature& feature,
                                     const Pose<S>& core_in_a) {
  std::vector<Vec3<S>> corners;
  const auto add = [&](int vertex) { corners.push_back(core_in_a.transform(core.vertex(vertex))); };
  if (core.kind == ShapeKind::Plane) return corners;
  if (feature.kind == FeatureKind::Vertex) {
    add(feature.index);
  } else if (core.kind != ShapeKind::Hull) {
    add(0);
    add(1);
  } else if (feature.kind == FeatureKind::Edge) {
    for (const int half_edge : {2 * feature.index, 2 * feature.index + 1})
      add(core.hull.half_edges[static_cast<std::size_t>(half_edge)].origin);
  } else {
    for (const int vertex : face_vertices(core.hull, feature.index)) add(vertex);
  }
  return corners;
}

template <class S>
Plane<S> face_plane(const ShapeCore<S>& core, const CoreFeature& feature,
                    const Pose<S>& core_in_a) {
  const Plane<S>& own = core.kind == ShapeKind::Plane
                            ? core.plane
                            : core.hull.planes[static_cast<std::size_t>(feature.index)];
  const Vec3<S> normal = core_in_a.rotate(own.normal);
  return {normal, own.offset + normal.dot(core_in_a.position)};
}

/// The foot of a point on an edge; empty beyond its ends.
template <class S>
std::optional<Vec3<S>> foot_on_edge(const Vec3<S>& point, const std::vector<Vec3<S>>& edge,
                                    S slack) {
  const Vec3<S> along = edge[1] - edge[0];
  const S length = along.norm();
  if (!(length > S(0))) return edge[0];
  const Vec3<S> offset = point - edge[0];
  const S at = offset.dot(along) / length;
  if (at < -slack || at > length + slack) return std::nullopt;
  return edge[0] + at / length * along;
}

/// The foot of a point on a face; empty beyond its border. A face without corners has none.
template <class S>
std::optional<Vec3<S>> foot_on_face(const Vec3<S>& point, const Plane<S>& plane,
                                    const std::vector<Vec3<S>>& corners, S slack) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3<S> along = corners[(i + 1) % corners.size()] - corners[i];
    const Vec3<S> inward = plane.normal.cross(along);
    const Vec3<S> offset = point - corners[i];
    if (offset.dot(inward) < -slack * inward.norm()) return std::nullopt;
  }
  const S above = plane.normal.dot(point) - plane.offset;
  return point - above * plane.normal;
}

/// Ericson, "Real-Time Collision Detection", 5.1.8, by the cross product of the directions; empty
/// where the closest points of the lines lie beyond an end, or the edges are parallel.
template <class S>
std::optional<CoreContact<S>> feet_of_edges(const std::vector<Vec3<S>>& one,
                                            const std::vector<Vec3<S>>& other, S slack) {
  const Vec3<S> u = one[1] - one[0];
  const Vec3<S> v = other[1] - other[0];
  const Vec3<S> between = other[0] - one[0];
  const Vec3<S> c = u.cross(v);
  const S squared = c.squaredNorm();
  const S sine = kParallelSine<S>;
  if (!(squared > sine * sine * u.squaredNorm() * v.squaredNorm())) return std::nullopt;
  const Vec3<S> beside_v = between.cross(v);
  const Vec3<S> beside_u = between.cross(u);
  const S s = beside_v.dot(c) / squared;
  const S t = beside_u.dot(c) / squared;
  const auto within = [&](S parameter, S length) {
    return parameter * length >= -slack && (parameter - S(1)) * length <= slack;
  };
  if (!within(s, u.norm()) || !within(t, v.norm())) return std::nullopt;
  CoreContact<S> contact;
  contact.on_a = one[0] + s * u;
  contact.on_b = other[0] + t * v;
  return contact;
}

template <class S>
std::optional<CoreContact<S>> contact_of(const std::optional<Vec3<S>>& on_a,
                                         const std::optional<Vec3<S>>& on_b) {
  if (!on_a || !on_b) return std::nullopt;
  CoreContact<S> contact;
  contact.on_a = *on_a;
  contact.on_b = *on_b;
  return contact;
}

}  // namespace

template <class S>
std::optional<CoreContact<S>> closest_on_features(const ShapeCore<S>& a, const CoreFeature& of_a,
                                                  const ShapeCore<S>& b, const CoreFeature& of_b,
                                                  const Pose<S>& b_in_a, S scale) {
  using Found = std::optional<CoreContact<S>>;
  const S slack = S(16) * tie_tolerance(scale);
  const auto corners_a = feature_corners(a, of_a, Pose<S>());
  const auto corners_b = feature_corners(b, of_b, b_in_a);
  const FeatureKind kind_a = of_a.kind, kind_b = of_b.kind;
  constexpr FeatureKind kVertex = FeatureKind::Vertex, kEdge = FeatureKind::Edge;
  const auto find = [&]() -> Found {
    if (kind_a == kVertex && kind_b == kVertex) return contact_of<S>(corners_a[0], corners_b[0]);
    if (kind_a == kVertex && kind_b == kEdge)
      return contact_of<S>(corners_a[0], foot_on_edge(corners_a[0], corners_b, slack));
    if (kind_a == kEdge && kind_b == kVertex)
      return contact_of<S>(foot_on_edge(corners_b[0], corners_a, slack), corners_b[0]);
    if (kind_a == kVertex)
      return contact_of<S>(
          corners_a[0], foot_on_face(corners_a[0], face_plane(b, of_b, b_in_a), corners_b, slack));
    if (kind_b == kVertex)
      return contact_of<S>(
          foot_on_face(corners_b[0], face_plane(a, of_a, Pose<S>()), corners_a, slack),
          corners_b[0]);
    if (kind_a == kEdge && kind_b == kEdge) return feet_of_edges(corners_a, corners_b, slack);
    return std::nullopt;
  };
  Found found = find();
  if (found) {
    found->feature_a = of_a;
    found->feature_b = of_b;
  }
  return found;
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                     \
  template std::optional<CoreContact<S>> closest_on_features(                           \
      const ShapeCore<S>&, const CoreFeature&, const ShapeCore<S>&, const CoreFeature&, \
      const Pose<S>&, S);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
