#pragma once

#include "manifold/incremental_patch.h"
#include "manifold/round_contact.h"

/// One frame of an incremental manifold in A's frame, before reduction. Internal to incremental.h.
namespace contactscope {

/// The corners of a feature in A's frame; none for a half-space's face.
template <class S>
std::vector<Vec3<S>> feature_corners(const ShapeCore<S>& core, const CoreFeature& feature,
                                     const Pose<S>& core_in_a) {
  const auto vertices = [&]() -> std::vector<int> {
    if (core.kind == ShapeKind::Plane) return {};
    if (feature.kind == FeatureKind::Vertex) return {feature.index};
    if (core.kind != ShapeKind::Hull) return {0, 1};
    if (feature.kind == FeatureKind::Face) return face_vertices(core.hull, feature.index);
    const int edge = 2 * feature.index;
    return {at(core.hull.half_edges, edge).origin, at(core.hull.half_edges, edge + 1).origin};
  };
  return mapped(vertices(), [&](int i) { return core_in_a.transform(core.vertex(i)); });
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

/// The foot of a point on a face; empty beyond its border. A face without corners has no border.
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

/// Ericson, "Real-Time Collision Detection", 5.1.8, by the cross product of the directions. Empty
/// if the closest points of the lines are beyond an end, or the edges are parallel.
template <class S>
std::optional<std::pair<Vec3<S>, Vec3<S>>> feet_of_edges(const std::vector<Vec3<S>>& one,
                                                         const std::vector<Vec3<S>>& other,
                                                         S slack) {
  const Vec3<S> u = one[1] - one[0], v = other[1] - other[0];
  const Vec3<S> between = other[0] - one[0];
  const Vec3<S> c = u.cross(v);
  const S squared = c.squaredNorm();
  const S sine = kParallelSine<S>;
  if (!(squared > sine * sine * u.squaredNorm() * v.squaredNorm())) return std::nullopt;
  const Vec3<S> perpendicular_v = between.cross(v), perpendicular_u = between.cross(u);
  const S s = perpendicular_v.dot(c) / squared;
  const S t = perpendicular_u.dot(c) / squared;
  const auto within = [&](S parameter, S length) {
    return parameter * length >= -slack && (parameter - S(1)) * length <= slack;
  };
  if (!within(s, u.norm()) || !within(t, v.norm())) return std::nullopt;
  return std::pair<Vec3<S>, Vec3<S>>(one[0] + s * u, other[0] + t * v);
}

/// The foot of a point on a feature with these corners.
template <class S>
std::optional<Vec3<S>> foot_on(const ShapeCore<S>& core, const CoreFeature& feature,
                               const Pose<S>& core_in_a, const std::vector<Vec3<S>>& corners,
                               const Vec3<S>& point, S slack) {
  if (feature.kind == FeatureKind::Vertex) return corners[0];
  if (feature.kind == FeatureKind::Edge) return foot_on_edge(point, corners, slack);
  return foot_on_face(point, face_plane(core, feature, core_in_a), corners, slack);
}

/// The current closest points of two features, in A's frame. Empty if the features do not face each
/// other: the points are beyond the border of one of them, or not unique. `scale` as in CoreQuery.
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

/// A point's state in this frame: A's frame, metres.
template <class S> struct StandingPoint {
  PersistentContact<S> kept;
  Vec3<S> on_a, on_b;
  S separation = 0;
  bool is_new = false;
  Vec3<S> position() const { return S(0.5) * (on_a + on_b); }
};

/// A point that was removed from the manifold.
template <class S> struct BrokenPoint {
  StandingPoint<S> point;
  const char* reason;  // "apart", "slid", "other features", "replaced", "too close", "reduced"
};

/// Has room for the persisted points and one new one.
template <class S> struct IncrementalStep {
  StaticVector<StandingPoint<S>, kMaxPersistentPoints + 1> points;
  StaticVector<BrokenPoint<S>, kMaxPersistentPoints + 1> broken;
};

/// Distances across the normal that differ by less than this fraction of the patch count as equal.
/// Then the first by features is taken, whatever the rounding.
template <class S> constexpr S kAsFar = S(1e-3);

/// Sets a point from two points on the cores, offset along the normal to the surfaces.
template <class S>
void put_on(const CoreContact<S>& cores, const PersistentManifold<S>& persistent,
            const Pose<S>& b_in_a, const Vec3<S>& normal, StandingPoint<S>& point) {
  point.kept.on_a = point.on_a = cores.on_a + persistent.core_a->margin * normal;
  point.on_b = cores.on_b - persistent.core_b->margin * normal;
  point.kept.on_b = b_in_a.inverse_transform(point.on_b);
}

/// The candidate farthest from the existing points; without any, farthest from the middle of the
/// candidates.
template <class S>
const CoreContact<S>& farthest_place(const CorePatch<S>& patch, const CoreQuery<S>& query,
                                     const IncrementalStep<S>& step) {
  Vec3<S> middle = Vec3<S>::Zero();
  for (const CoreContact<S>& place : patch) middle += place.on_a / static_cast<S>(patch.size());
  S reach = 0;
  for (const CoreContact<S>& place : patch)
    reach = std::max(reach, Vec3<S>(place.on_a - middle).norm());

  std::size_t best = 0;
  S farthest = -1;
  for (std::size_t i = 0; i < patch.size(); ++i) {
    S distance = rejected(Vec3<S>(patch[i].on_a - middle), query.normal).norm();
    if (!step.points.empty()) distance = std::numeric_limits<S>::infinity();
    for (const StandingPoint<S>& point : step.points) {
      const Vec3<S> middle_of_place = S(0.5) * (patch[i].on_a + patch[i].on_b);
      const Vec3<S> displacement = middle_of_place - point.position();
      distance = std::min(distance, rejected(displacement, query.normal).norm());
    }
    if (distance > farthest + kAsFar<S> * reach) {
      farthest = distance;
      best = i;
    }
  }
  return patch[best];
}

/// The old point that a new one replaces; -1: none. In this order: the same features; the nearest
/// within the breaking distance; the same id, although other features meet there now.
template <class S>
int replaced_by(const StandingPoint<S>& fresh, const IncrementalStep<S>& step, S breaking) {
  int nearest = -1, namesake = -1;
  S least = breaking;
  for (std::size_t i = 0; i < step.points.size(); ++i) {
    const StandingPoint<S>& old = step.points[i];
    if (old.kept.found == fresh.kept.found) return static_cast<int>(i);
    if (old.kept.id == fresh.kept.id) namesake = static_cast<int>(i);
    const S distance = Vec3<S>(old.position() - fresh.position()).norm();
    if (distance < least) {
      least = distance;
      nearest = static_cast<int>(i);
    }
  }
  return nearest >= 0 ? nearest : namesake;
}

/// Step 2: confirms the points of `persistent`.
template <class S>
void confirm_points(const PersistentManifold<S>& persistent, const Pose<S>& b_in_a,
                    const CoreQuery<S>& query, const IncrementalSettings& settings, S margin,
                    IncrementalStep<S>& step) {
  const S breaking = static_cast<S>(settings.breaking_distance);
  const bool by_ids = settings.confirm == Confirm::Ids;
  for (const PersistentContact<S>& kept : persistent.points) {
    StandingPoint<S> point;
    point.kept = kept;
    ++point.kept.age;
    point.on_a = kept.on_a;
    point.on_b = b_in_a.transform(kept.on_b);
    bool faces = true;
    if (by_ids) {  // finds the features that made the point again: it slides with them
      const auto cores = closest_on_features(*persistent.core_a, kept.of_a, *persistent.core_b,
                                             kept.of_b, b_in_a, query.scale);
      faces = cores.has_value();
      if (faces) put_on(*cores, persistent, b_in_a, query.normal, point);
    }
    const Vec3<S> displacement = point.on_b - point.on_a;
    point.separation = query.normal.dot(displacement);
    const bool slid = rejected(displacement, query.normal).norm() > breaking;
    if (!faces || (by_ids && slid))
      step.broken.push_back({point, "other features"});
    else if (point.separation > std::max(breaking, margin))
      step.broken.push_back({point, "apart"});
    else if (slid)
      step.broken.push_back({point, "slid"});
    else
      step.points.push_back(point);
  }
}

/// Step 3: adds the newest point, replaces an old one, or rejects the new one.
template <class S>
void add_point(const PersistentManifold<S>& persistent, const Pose<S>& b_in_a,
               const CoreQuery<S>& query, const IncrementalSettings& settings,
               IncrementalStep<S>& step) {
  const ShapeCore<S>&a = *persistent.core_a, &b = *persistent.core_b;
  const CorePatch<S> patch = closest_patch(a, b, b_in_a, query);
  const CoreContact<S>& place = farthest_place(patch, query, step);
  StandingPoint<S> fresh;
  fresh.is_new = true;
  fresh.kept.of_a = place.feature_a;
  fresh.kept.of_b = place.feature_b;
  fresh.kept.found =
      FeatureId::of(a.ref(Owner::A, place.feature_a), b.ref(Owner::B, place.feature_b));
  fresh.kept.id = fresh.kept.found;
  put_on(place, persistent, b_in_a, query.normal, fresh);
  fresh.separation = query.distance - (a.margin + b.margin);

  const int old = replaced_by(fresh, step, static_cast<S>(settings.breaking_distance));
  if (old < 0) {
    step.points.push_back(fresh);
    return;
  }
  StandingPoint<S>& replaced = step.points[static_cast<std::size_t>(old)];
  const bool is_same = replaced.kept.found == fresh.kept.found || replaced.kept.id == fresh.kept.id;
  if (settings.too_close == TooClose::Reject && !is_same) {
    step.broken.push_back({fresh, "too close"});
    return;
  }
  step.broken.push_back({replaced, "replaced"});
  fresh.is_new = false;
  fresh.kept.id = replaced.kept.id;
  fresh.kept.age = replaced.kept.age;
  replaced = fresh;
}

}  // namespace contactscope
