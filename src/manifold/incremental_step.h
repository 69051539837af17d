#pragma once

#include <algorithm>
#include <limits>

#include "manifold/incremental.h"
#include "manifold/incremental_features.h"
#include "manifold/incremental_patch.h"
#include "manifold/round_contact.h"

/// One frame of an incremental manifold in A's frame, before it is reduced. Inside of incremental.h.
namespace contactscope {

/// A point where it is in this frame: A's frame, metres.
template <class S>
struct StandingPoint {
  PersistentContact<S> kept;
  Vec3<S> on_a, on_b;
  S separation = 0;
  bool is_new = false;

  Vec3<S> position() const { return S(0.5) * (on_a + on_b); }
};

/// A point that is no longer in the manifold.
template <class S>
struct BrokenPoint {
  StandingPoint<S> point;
  const char* reason;  // "apart", "slid", "other features", "replaced", "reduced"
};

/// Room for what is kept and one new point.
template <class S>
struct IncrementalStep {
  StaticVector<StandingPoint<S>, kMaxPersistentPoints + 1> points;
  StaticVector<BrokenPoint<S>, kMaxPersistentPoints + 1> broken;
};

/// Distances across the normal that differ by less than this part of the patch count as equal: the
/// first place by its features is taken, whatever rounding says.
template <class S>
constexpr S kAsFar = S(1e-3);

/// Inflates two places on the cores along the normal to the surfaces.
template <class S>
void inflate(const PersistentManifold<S>& persistent, const Vec3<S>& normal,
             const CoreContact<S>& cores, StandingPoint<S>& point) {
  point.on_a = cores.on_a + persistent.core_a->margin * normal;
  point.on_b = cores.on_b - persistent.core_b->margin * normal;
}

template <class S>
void keep_places(const Pose<S>& b_in_a, StandingPoint<S>& point) {
  point.kept.on_a = point.on_a;
  point.kept.on_b = b_in_a.inverse_transform(point.on_b);
}

/// By ids: the features that made the point are looked up again, so that it slides with them.
template <class S>
bool follow_features(const PersistentManifold<S>& persistent, const Pose<S>& b_in_a,
                     const CoreQuery<S>& query, StandingPoint<S>& point) {
  const auto cores = closest_on_features(*persistent.core_a, point.kept.of_a, *persistent.core_b,
                                         point.kept.of_b, b_in_a, query.scale);
  if (!cores) return false;
  inflate(persistent, query.normal, *cores, point);
  keep_places(b_in_a, point);
  return true;
}

/// Of places that are equally close the one farthest from the points that are there; from the
/// middle of all where there are none.
template <class S>
const CoreContact<S>& farthest_place(const CorePatch<S>& patch, const CoreQuery<S>& query,
                                     const IncrementalStep<S>& step) {
  Vec3<S> middle = Vec3<S>::Zero();
  for (const CoreContact<S>& place : patch) middle += place.on_a / static_cast<S>(patch.size());
  const auto middle_of_place = [](const CoreContact<S>& place) -> Vec3<S> {
    return S(0.5) * (place.on_a + place.on_b);
  };
  S reach = 0;
  for (const CoreContact<S>& place : patch)
    reach = std::max(reach, Vec3<S>(place.on_a - middle).norm());

  std::size_t best = 0;
  S farthest = -1;
  for (std::size_t i = 0; i < patch.size(); ++i) {
    S distance = rejected(Vec3<S>(patch[i].on_a - middle), query.normal).norm();
    if (!step.points.empty()) distance = std::numeric_limits<S>::infinity();
    for (const StandingPoint<S>& point : step.points) {
      const Vec3<S> way = middle_of_place(patch[i]) - point.position();
      distance = std::min(distance, rejected(way, query.normal).norm());
    }
    if (distance > farthest + kAsFar<S> * reach) {
      farthest = distance;
      best = i;
    }
  }
  return patch[best];
}

/// The old point whose place a new one takes; -1: none. The same features first; then what is near,
/// the nearest; then what has the new point's name, though other features meet there now.
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

/// Step 2: what is left of `persistent`.
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
    const bool faces = !by_ids || follow_features(persistent, b_in_a, query, point);
    const Vec3<S> way = point.on_b - point.on_a;
    point.separation = query.normal.dot(way);
    const bool slid = rejected(way, query.normal).norm() > breaking;
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

/// Step 3: adds the newest point, or puts it in the place of an old one.
template <class S>
void add_point(const PersistentManifold<S>& persistent, const Pose<S>& b_in_a,
               const CoreQuery<S>& query, const IncrementalSettings& settings,
               IncrementalStep<S>& step) {
  const ShapeCore<S>& a = *persistent.core_a;
  const ShapeCore<S>& b = *persistent.core_b;
  const CorePatch<S> patch = closest_patch(a, b, b_in_a, query);
  const CoreContact<S>& place = farthest_place(patch, query, step);
  StandingPoint<S> fresh;
  fresh.is_new = true;
  fresh.kept.of_a = place.feature_a;
  fresh.kept.of_b = place.feature_b;
  fresh.kept.found =
      FeatureId::of(a.ref(Owner::A, place.feature_a), b.ref(Owner::B, place.feature_b));
  fresh.kept.id = fresh.kept.found;
  inflate(persistent, query.normal, place, fresh);
  keep_places(b_in_a, fresh);
  fresh.separation = query.distance - (a.margin + b.margin);

  const int old = replaced_by(fresh, step, static_cast<S>(settings.breaking_distance));
  if (old < 0) {
    step.points.push_back(fresh);
    return;
  }
  StandingPoint<S>& replaced = step.points[static_cast<std::size_t>(old)];
  step.broken.push_back({replaced, "replaced"});
  fresh.is_new = false;
  fresh.kept.id = replaced.kept.id;
  fresh.kept.age = replaced.kept.age;
  replaced = fresh;
}

}  // namespace contactscope
