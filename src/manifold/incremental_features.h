#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "manifold/incremental_query.h"
#include "query/tolerance.h"

namespace contactscope {

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
      add(at(core.hull.half_edges, half_edge).origin);
  } else {
    for (const int vertex : face_vertices(core.hull, feature.index)) add(vertex);
  }
  return corners;
}

template <class S>
Plane<S> face_plane(const ShapeCore<S>& core, const CoreFeature& feature,
                    const Pose<S>& core_in_a) {
  const bool is_plane = core.kind == ShapeKind::Plane;
  const Plane<S>& own = is_plane ? core.plane : at(core.hull.planes, feature.index);
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
  return plane.project(point);
}

/// Ericson, "Real-Time Collision Detection", 5.1.8, by the cross product of the directions; empty
/// where the closest points of the lines lie beyond an end, or the edges are parallel.
template <class S>
std::optional<std::pair<Vec3<S>, Vec3<S>>> feet_of_edges(const std::vector<Vec3<S>>& one,
                                                         const std::vector<Vec3<S>>& other,
                                                         S slack) {
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
  return std::pair<Vec3<S>, Vec3<S>>(one[0] + s * u, other[0] + t * v);
}

/// The foot of a point on the feature that has these corners.
template <class S>
std::optional<Vec3<S>> foot_on(const ShapeCore<S>& core, const CoreFeature& feature,
                               const Pose<S>& core_in_a, const std::vector<Vec3<S>>& corners,
                               const Vec3<S>& point, S slack) {
  if (feature.kind == FeatureKind::Vertex) return corners[0];
  if (feature.kind == FeatureKind::Edge) return foot_on_edge(point, corners, slack);
  return foot_on_face(point, face_plane(core, feature, core_in_a), corners, slack);
}

/// Where two features are nearest to each other now, in A's frame; empty where they do not face each
/// other: their nearest points lie beyond the border of one of them, or they share more than a
/// point. `scale` as in CoreQuery.
template <class S>
std::optional<CoreContact<S>> closest_on_features(const ShapeCore<S>& a, const CoreFeature& of_a,
                                                  const ShapeCore<S>& b, const CoreFeature& of_b,
                                                  const Pose<S>& b_in_a, S scale) {
  const S slack = S(16) * tie_tolerance(scale);
  const auto corners_a = feature_corners(a, of_a, Pose<S>());
  const auto corners_b = feature_corners(b, of_b, b_in_a);
  if (of_a.kind == FeatureKind::Vertex) {
    const auto foot = foot_on(b, of_b, b_in_a, corners_b, corners_a[0], slack);
    if (foot) return CoreContact<S>{corners_a[0], *foot, of_a, of_b};
  } else if (of_b.kind == FeatureKind::Vertex) {
    const auto foot = foot_on(a, of_a, Pose<S>(), corners_a, corners_b[0], slack);
    if (foot) return CoreContact<S>{*foot, corners_b[0], of_a, of_b};
  } else if (of_a.kind == FeatureKind::Edge && of_b.kind == FeatureKind::Edge) {
    if (const auto feet = feet_of_edges(corners_a, corners_b, slack))
      return CoreContact<S>{feet->first, feet->second, of_a, of_b};
  }
  return std::nullopt;
}

}  // namespace contactscope
