#include "manifold/dispatch.h"

#include <algorithm>
#include <array>
#include <type_traits>

#include "manifold/collide_capsule_capsule.h"
#include "manifold/collide_capsule_hull.h"
#include "manifold/collide_capsule_mesh.h"
#include "manifold/collide_capsule_plane.h"
#include "manifold/collide_hull_hull.h"
#include "manifold/collide_hull_mesh.h"
#include "manifold/collide_hull_plane.h"
#include "manifold/collide_sphere_capsule.h"
#include "manifold/collide_sphere_hull.h"
#include "manifold/collide_sphere_mesh.h"
#include "manifold/collide_sphere_plane.h"
#include "manifold/collide_sphere_sphere.h"
#include "manifold/contact_sink.h"
#include "manifold/in_double.h"
#include "manifold/recorder.h"
#ifndef CONTACTSCOPE_WITHOUT_RECORDER
#include "manifold/trace_recorder.h"
#endif

namespace contactscope {
namespace {

/// Two shapes placed in the world.
template <class S>
struct PlacedPair {
  const Shape<S>& a;
  const Pose<S>& pose_a;
  const Shape<S>& b;
  const Pose<S>& pose_b;
  PairCache<S>* cache;  // nullptr: nothing is kept
};

template <class S, class Recorder>
using Entry = void (*)(const PlacedPair<S>&, const CollideOptions<S>&, Manifolds<S>&, Recorder&);

template <class S, class Recorder, class A, class B>
using CollideConvex = S (*)(const A&, const B&, const Pose<S>&, const CollideOptions<S>&,
                            Contact<S>&, Recorder&);

/// One manifold at most, from what `collide` does with the pose of b in a.
template <class S, class Recorder, class Collide>
void one_manifold(const PlacedPair<S>& pair, const CollideOptions<S>& options,
                  Manifolds<S>& manifolds, Recorder& recorder, const Collide& collide) {
  Contact<S> contact;
  recorder.separation(collide(relative_pose(pair.pose_a, pair.pose_b), contact));
  ContactSink<S, Recorder> sink(ToWorld<S>(pair.pose_a), options, manifolds, recorder);
  sink.add(contact);
}

/// Two convex shapes of which nothing is kept between calls.
template <class S, class Recorder, class A, class B, CollideConvex<S, Recorder, A, B> kCollide>
void convex(const PlacedPair<S>& pair, const CollideOptions<S>& options, Manifolds<S>& manifolds,
            Recorder& recorder) {
  const A& a = *std::get_if<A>(&pair.a);
  const B& b = *std::get_if<B>(&pair.b);
  one_manifold(pair, options, manifolds, recorder, [&](const Pose<S>& b_in_a, Contact<S>& contact) {
    return kCollide(a, b, b_in_a, options, contact, recorder);
  });
}

template <class S, class Recorder>
void hulls(const PlacedPair<S>& pair, const CollideOptions<S>& options, Manifolds<S>& manifolds,
           Recorder& recorder) {
  const Hull<S>& a = *std::get_if<Hull<S>>(&pair.a);
  const Hull<S>& b = *std::get_if<Hull<S>>(&pair.b);
  one_manifold(pair, options, manifolds, recorder, [&](const Pose<S>& b_in_a, Contact<S>& contact) {
    recorder.minkowski(a, b, b_in_a);
    return pair.cache == nullptr
               ? collide_hull_hull(a, b, b_in_a, options, contact, recorder)
               : collide_hull_hull(a, b, b_in_a, options, *pair.cache, contact, recorder);
  });
}

template <class S, class Recorder, class A>
using CollideMesh = S (*)(const A&, const Mesh<S>&, const Pose<S>&, const CollideOptions<S>&,
                          ContactSink<S, Recorder>&, Recorder&);

/// A convex shape and a mesh: one manifold a triangle.
template <class S, class Recorder, class A, CollideMesh<S, Recorder, A> kCollide>
void with_mesh(const PlacedPair<S>& pair, const CollideOptions<S>& options, Manifolds<S>& manifolds,
               Recorder& recorder) {
  // Ids count within a triangle, so those that were kept before say nothing without the triangle:
  // every manifold is reduced as if it were new.
  CollideOptions<S> of_triangle = options;
  of_triangle.reduction.previous = {};
  of_triangle.penetration = PenetrationMethod::Sat;
  ContactSink<S, Recorder> sink(ToWorld<S>(pair.pose_a), of_triangle, manifolds, recorder);
  const S separation =
      kCollide(*std::get_if<A>(&pair.a), *std::get_if<Mesh<S>>(&pair.b),
               relative_pose(pair.pose_a, pair.pose_b), of_triangle, sink, recorder);
  if (manifolds.empty()) recorder.separation(separation);
}

/// The upper half of the table; nullptr where there is nothing to do.
template <class S, class R>
Entry<S, R> entry(ShapeKind a, ShapeKind b) {
  using Sp = Sphere<S>;
  using Ca = Capsule<S>;
  using Hu = Hull<S>;
  using Pl = HalfSpace<S>;
  static constexpr Entry<S, R> kTable[kShapeKinds][kShapeKinds] = {
      {convex<S, R, Sp, Sp, collide_sphere_sphere<S, R>>,
       convex<S, R, Sp, Ca, collide_sphere_capsule<S, R>>,
       convex<S, R, Sp, Hu, collide_sphere_hull<S, R>>,
       convex<S, R, Sp, Pl, collide_sphere_plane<S, R>>,
       with_mesh<S, R, Sp, collide_sphere_mesh<S, R>>},
      {nullptr, convex<S, R, Ca, Ca, collide_capsule_capsule<S, R>>,
       convex<S, R, Ca, Hu, collide_capsule_hull<S, R>>,
       convex<S, R, Ca, Pl, collide_capsule_plane<S, R>>,
       with_mesh<S, R, Ca, collide_capsule_mesh<S, R>>},
      {nullptr, nullptr, hulls<S, R>, convex<S, R, Hu, Pl, collide_hull_plane<S, R>>,
       with_mesh<S, R, Hu, collide_hull_mesh<S, R>>},
      {nullptr, nullptr, nullptr, nullptr, nullptr},
      {nullptr, nullptr, nullptr, nullptr, nullptr},
  };
  return kTable[static_cast<int>(a)][static_cast<int>(b)];
}

/// Works on the pair in the order of the table.
template <class S, class Recorder>
void collide_in_order(const PlacedPair<S>& pair, const CollideOptions<S>& options,
                      Manifolds<S>& manifolds, Recorder& recorder) {
  manifolds.clear();
  const auto collide_pair = entry<S, Recorder>(kind_of(pair.a), kind_of(pair.b));
  if (collide_pair != nullptr) collide_pair(pair, options, manifolds, recorder);
}

/// The same for a pair that belongs_in_double.
template <class Recorder>
void collide_in_double(const PlacedPair<float>& pair, const CollideOptions<float>& options,
                       Manifolds<float>& manifolds, Recorder& recorder) {
  const Shape<double> a = in_double(pair.a);
  const Shape<double> b = in_double(pair.b);
  Manifolds<double> found;
  collide_in_order<double>({a, in_double(pair.pose_a), b, in_double(pair.pose_b), nullptr},
                           in_double(options), found, recorder);
  manifolds.clear();
  for (const Manifold<double>& manifold : found) manifolds.push_back(in_float(manifold));
}

/// What distinguishes a sphere or a capsule from another of the same radius: the ends of its axis, then
/// its rotation and position.
template <class S>
std::array<S, 13> told_apart_by(const Shape<S>& shape, const Pose<S>& pose) {
  const auto* capsule = std::get_if<Capsule<S>>(&shape);
  const Vec3<S> from = capsule == nullptr ? Vec3<S>(Vec3<S>::Zero()) : capsule->points[0];
  const Vec3<S> to = capsule == nullptr ? Vec3<S>(Vec3<S>::Zero()) : capsule->points[1];
  const Quat<S>& turn = pose.rotation;
  const Vec3<S>& at = pose.position;
  return {from.x(), from.y(), from.z(), to.x(), to.y(), to.z(), turn.w(),
          turn.x(), turn.y(), turn.z(), at.x(), at.y(), at.z()};
}

template <class S>
S radius_of(const Shape<S>& shape) {
  const auto* sphere = std::get_if<Sphere<S>>(&shape);
  return sphere != nullptr ? sphere->radius : std::get_if<Capsule<S>>(&shape)->radius;
}

/// Two spheres, or two capsules, are worked on in an order of their own: the larger radius first.
template <class S>
bool against_the_table(const Shape<S>& a, const Pose<S>& pose_a, const Shape<S>& b,
                       const Pose<S>& pose_b) {
  const ShapeKind kind = kind_of(a);
  if (kind != kind_of(b)) return kind > kind_of(b);
  if (kind != ShapeKind::Sphere && kind != ShapeKind::Capsule) return false;
  const S radius_a = radius_of(a);
  const S radius_b = radius_of(b);
  if (radius_a != radius_b) return radius_a < radius_b;
  return told_apart_by(a, pose_a) < told_apart_by(b, pose_b);
}

}  // namespace

bool can_cache(ShapeKind one, ShapeKind other) {
  return one == ShapeKind::Hull && other == ShapeKind::Hull;
}

bool can_collide(ShapeKind one, ShapeKind other) {
  return entry<double, NoRecorder<double>>(std::min(one, other), std::max(one, other)) != nullptr;
}

template <class S>
void mirror(Manifold<S>& manifold) {
  manifold.normal = -manifold.normal;
  manifold.axis = mirrored(manifold.axis);
  for (ContactPoint<S>& point : manifold.points) point.id = point.id.flipped();
}

template <class S>
void collide(const Shape<S>& a, const Pose<S>& pose_a, const Shape<S>& b, const Pose<S>& pose_b,
             const CollideOptions<S>& options, Manifolds<S>& manifolds, PairCache<S>* cache) {
  const bool swap = against_the_table(a, pose_a, b, pose_b);
  const PlacedPair<S> pair = swap ? PlacedPair<S>{b, pose_b, a, pose_a, cache}
                                  : PlacedPair<S>{a, pose_a, b, pose_b, cache};
  if (belongs_in_double(a, b, options.reducer)) [[unlikely]] {
    if constexpr (std::is_same_v<S, float>) {
      NoRecorder<double> recorder;
      collide_in_double(pair, options, manifolds, recorder);
    }
  } else {
    NoRecorder<S> recorder;
    collide_in_order(pair, options, manifolds, recorder);
  }
  if (!swap) return;
  for (Manifold<S>& manifold : manifolds) mirror(manifold);
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                       \
  template void mirror(Manifold<S>&);                                                     \
  template void collide(const Shape<S>&, const Pose<S>&, const Shape<S>&, const Pose<S>&, \
                        const CollideOptions<S>&, Manifolds<S>&, PairCache<S>*);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

#ifndef CONTACTSCOPE_WITHOUT_RECORDER

template <class S>
void collide(const Shape<S>& a, const Pose<S>& pose_a, const Shape<S>& b, const Pose<S>& pose_b,
             const CollideOptions<S>& options, Manifolds<S>& manifolds, const Recording& recording,
             trace::Pair& record, PairCache<S>* cache) {
  const bool swap = against_the_table(a, pose_a, b, pose_b);
  const PlacedPair<S> pair = swap ? PlacedPair<S>{b, pose_b, a, pose_a, cache}
                                  : PlacedPair<S>{a, pose_a, b, pose_b, cache};
  const bool told_mirrored = recording.mirrored != swap;
  record.kind = told_mirrored ? pair_kind(pair.b, pair.a) : pair_kind(pair.a, pair.b);
  trace::Stages stages = recording.stages;
  // Each triangle has these of its own, and a record has room for one of each.
  if (kind_of(pair.b) == ShapeKind::Mesh) {
    stages.sat = stages.clip = stages.reduction = stages.gjk = false;
  }
  TraceRecorder<S> recorder(ToWorld<S>(pair.pose_a), recording.reducer_name, stages, told_mirrored,
                            record);
  if (belongs_in_double(a, b, options.reducer)) {
    if constexpr (std::is_same_v<S, float>) {
      TraceRecorder<double> wide(ToWorld<double>(in_double(pair.pose_a)), recording.reducer_name,
                                 stages, told_mirrored, record);
      collide_in_double(pair, options, manifolds, wide);
      record.manifolds.clear();  // told as they are returned
      for (const Manifold<S>& manifold : manifolds) recorder.manifold(manifold);
    }
  } else {
    collide_in_order(pair, options, manifolds, recorder);
  }
  if (!swap) return;
  for (Manifold<S>& manifold : manifolds) mirror(manifold);
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                              \
  template void collide(const Shape<S>&, const Pose<S>&, const Shape<S>&, const Pose<S>&,        \
                        const CollideOptions<S>&, Manifolds<S>&, const Recording&, trace::Pair&, \
                        PairCache<S>*);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

#endif

}  // namespace contactscope
