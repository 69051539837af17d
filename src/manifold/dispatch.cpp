#include "manifold/dispatch.h"

#include "manifold/collide_pairs.h"
#include "manifold/fast/fast_pairs.h"
#include "manifold/in_double.h"
#include "manifold/merge_triangles.h"
#include "manifold/round_contact.h"

namespace contactscope {
namespace {

template <class S>
using Entry = void (*)(const PlacedPair<S>&, const CollideOptions&, Manifolds<S>&, Recorder<S>*);

/// At most one manifold, made by `collide` with the pose of b in a.
template <class S, class Collide>
void one_manifold(const PlacedPair<S>& pair, const CollideOptions& options, Manifolds<S>& manifolds,
                  Recorder<S>* recorder, const Collide& collide) {
  Contact<S> contact;
  const S separation = collide(relative_pose(pair.pose_a, pair.pose_b), contact);
  if (recorder) [[unlikely]]
    recorder->separation(separation);
  if (contact.points.empty()) return;
  ContactSink<S> sink{ToWorld<S>(pair.pose_a), options, manifolds, recorder};
  sink.add(contact);
}

/// Two convex shapes without a cache.
template <class S, class A, class B, CollideConvex<S, A, B>* kCollide>
void convex(const PlacedPair<S>& pair, const CollideOptions& options, Manifolds<S>& manifolds,
            Recorder<S>* recorder) {
  const A& a = *std::get_if<A>(&pair.a);
  const B& b = *std::get_if<B>(&pair.b);
  if constexpr (std::is_same_v<A, Sphere<S>> && !std::is_same_v<B, Hull<S>>) {
    if (options.degenerate == Degenerate::Up) [[unlikely]] {
      CollideOptions in_a = options;
      in_a.up = pair.pose_a.rotation.template cast<double>().conjugate() * options.up;
      const auto collide = [&](const Pose<S>& b_in_a, Contact<S>& contact) {
        return kCollide(a, b, b_in_a, in_a, contact, recorder);
      };
      return one_manifold(pair, in_a, manifolds, recorder, collide);
    }
  }
  one_manifold(pair, options, manifolds, recorder, [&](const Pose<S>& b_in_a, Contact<S>& contact) {
    const S separation = kCollide(a, b, b_in_a, options, contact, recorder);
    if constexpr (std::is_same_v<B, Hull<S>>)
      if (!b.seams.empty()) [[unlikely]]
        respect_seams(a, b, b_in_a, Owner::B, options, contact, recorder);
    return separation;
  });
}

template <class S>
void hulls(const PlacedPair<S>& pair, const CollideOptions& options, Manifolds<S>& manifolds,
           Recorder<S>* recorder) {
  const Hull<S>&a = *std::get_if<Hull<S>>(&pair.a), &b = *std::get_if<Hull<S>>(&pair.b);
  if (recorder == nullptr && a.is_box() && b.is_box() && a.seams.empty() == b.seams.empty() &&
      options.penetration == PenetrationMethod::Sat) {
    const bool done = pair.cache == nullptr
                          ? collide_box_box(a, pair.pose_a, b, pair.pose_b, options, manifolds)
                          : collide_boxes_from_cache(a, pair.pose_a, b, pair.pose_b, options,
                                                     *pair.cache, manifolds);
    if (done) return;
  } else if (pair.cache == nullptr) {
    // With a cache most of a hull is not read.
    for (const Hull<S>* hull : {&b, &a}) prefetch_lanes(*hull);
    for (const Hull<S>* hull : {&a, &b}) prefetch_topology(*hull);
  }
  one_manifold(pair, options, manifolds, recorder, [&](const Pose<S>& b_in_a, Contact<S>& contact) {
    if (recorder) [[unlikely]]
      recorder->minkowski(a, b, b_in_a);
    const S separation = collide_hull_hull(a, b, b_in_a, options, pair.cache, contact, recorder);
    // Two hulls with seams may be parts of one surface.
    if (a.seams.empty() != b.seams.empty()) [[unlikely]]
      respect_seams(a, b, b_in_a, a.seams.empty() ? Owner::B : Owner::A, options, contact,
                    recorder);
    return separation;
  });
}

template <class S, class A, CollideWithMesh<S, A>* kCollide>
void with_mesh(const PlacedPair<S>& pair, const CollideOptions& options, Manifolds<S>& manifolds,
               Recorder<S>* recorder) {
  CollideOptions of_triangle = options;
  of_triangle.penetration = PenetrationMethod::Sat;
  const Mesh<S>& mesh = *std::get_if<Mesh<S>>(&pair.b);
  ContactSink<S> sink{ToWorld<S>(pair.pose_a), of_triangle, manifolds, recorder};
  const auto collide_all = [&] {
    const S separation =
        kCollide(*std::get_if<A>(&pair.a), mesh, relative_pose(pair.pose_a, pair.pose_b),
                 of_triangle, sink, recorder);
    if (recorder) [[unlikely]]
      recorder->separation(separation);
  };
  if (options.mesh_manifolds == MeshManifolds::Triangle) {
    // Ids are local to a triangle, so previous ids mean nothing without the triangle.
    of_triangle.reduction.previous = {};
    return collide_all();
  }
  TriangleContacts<S> merged(pair.a, mesh);
  sink.merged = &merged;
  collide_all();
  merged.merge(sink.to_world, of_triangle, manifolds, recorder);
}

template <class S>
void with_field(const PlacedPair<S>& pair, const CollideOptions& options, Manifolds<S>& manifolds,
                Recorder<S>* recorder) {
  // As for a mesh there may be several manifolds, which have no ids of their own.
  CollideOptions of_part = options;
  of_part.reduction.previous = {};
  ContactSink<S> sink{ToWorld<S>(pair.pose_a), of_part, manifolds, recorder};
  const S separation =
      collide_with_field<S>(pair.a, *std::get_if<Field<S>>(&pair.b),
                            relative_pose(pair.pose_a, pair.pose_b), of_part, sink);
  if (recorder) [[unlikely]]
    recorder->separation(separation);
}

/// The upper half of the table; null if the pair makes no contacts.
template <class S> Entry<S> entry(ShapeKind a, ShapeKind b) {
  using Sp = Sphere<S>;
  using Ca = Capsule<S>;
  using Hu = Hull<S>;
  using Pl = HalfSpace<S>;
  static constexpr Entry<S> kTable[kShapeKinds][kShapeKinds] = {
      {convex<S, Sp, Sp, collide_sphere_sphere<S>>, convex<S, Sp, Ca, collide_sphere_capsule<S>>,
       convex<S, Sp, Hu, collide_sphere_hull<S>>, convex<S, Sp, Pl, collide_sphere_plane<S>>,
       with_mesh<S, Sp, collide_sphere_mesh<S>>, with_field<S>},
      {nullptr, convex<S, Ca, Ca, collide_capsule_capsule<S>>,
       convex<S, Ca, Hu, collide_capsule_hull<S>>, convex<S, Ca, Pl, collide_capsule_plane<S>>,
       with_mesh<S, Ca, collide_capsule_mesh<S>>, with_field<S>},
      {nullptr, nullptr, hulls<S>, convex<S, Hu, Pl, collide_hull_plane<S>>,
       with_mesh<S, Hu, collide_hull_mesh<S>>, with_field<S>},
      {nullptr, nullptr, nullptr, nullptr, nullptr, with_field<S>},
      {nullptr, nullptr, nullptr, nullptr, nullptr, with_field<S>},
      {nullptr, nullptr, nullptr, nullptr, nullptr, with_field<S>},
  };
  return kTable[static_cast<int>(a)][static_cast<int>(b)];
}

/// Not inlined: pairs without a record need none of its registers.
template <class S>
[[gnu::noinline]] void collide_with_record(const PlacedPair<S>& pair, const CollideOptions& options,
                                           Manifolds<S>& manifolds, trace::Pair& record,
                                           trace::Stages stages, Entry<S> collide_pair) {
  // Each triangle and each part of a field has its own, but a record has room for one of each.
  if (kind_of(pair.b) >= ShapeKind::Mesh) {
    const bool is_mesh = kind_of(pair.b) == ShapeKind::Mesh;
    stages.gjk = stages.decisions = false;
    stages.sat = stages.sat && is_mesh;
    stages.clip = stages.clip && is_mesh;
    stages.reduction = stages.reduction && is_mesh && options.mesh_manifolds == MeshManifolds::Pair;
  }
  Recorder<S> recorder(ToWorld<S>(pair.pose_a), stages, record);
  collide_pair(pair, options, manifolds, &recorder);
}

template <class S>
void collide_in_order(const PlacedPair<S>& pair, const CollideOptions& options,
                      Manifolds<S>& manifolds, trace::Pair* record, const trace::Stages& stages) {
  manifolds.clear();
  const Entry<S> collide_pair = entry<S>(kind_of(pair.a), kind_of(pair.b));
  if (collide_pair == nullptr) return;
  if (record == nullptr) return collide_pair(pair, options, manifolds, nullptr);
  collide_with_record(pair, options, manifolds, *record, stages, collide_pair);
}

/// Rounds every number once.
Manifold<float> in_float(const Manifold<double>& manifold) {
  Manifold<float> result;
  result.normal = manifold.normal.cast<float>();
  result.axis = manifold.axis;
  result.type = manifold.type;
  result.triangle = manifold.triangle;
  for (const ContactPoint<double>& point : manifold.points)
    result.points.push_back(
        {point.position.cast<float>(), static_cast<float>(point.separation), point.id});
  return result;
}

/// As collide_in_order.
void collide_in_double(const PlacedPair<float>& pair, const CollideOptions& options,
                       Manifolds<float>& manifolds, trace::Pair* record,
                       const trace::Stages& stages) {
  const Shape<double> a = in_double(pair.a), b = in_double(pair.b);
  Manifolds<double> found;
  collide_in_order<double>({a, in_double(pair.pose_a), b, in_double(pair.pose_b)}, options, found,
                           record, stages);
  manifolds = mapped(found, in_float);
}

/// For two spheres or two capsules. Not inlined, to keep registers free for the other kinds.
template <class S>
[[gnu::noinline]] bool round_against_order(const Shape<S>& a, const Pose<S>& pose_a,
                                           const Shape<S>& b, const Pose<S>& pose_b, bool b_first) {
  if (const auto* sphere = std::get_if<Sphere<S>>(&a))
    return against_order(*sphere, pose_a, *std::get_if<Sphere<S>>(&b), pose_b, b_first);
  return against_order(*std::get_if<Capsule<S>>(&a), pose_a, *std::get_if<Capsule<S>>(&b), pose_b,
                       b_first);
}

template <class S>
bool against_the_table(const Shape<S>& a, const Pose<S>& pose_a, const Shape<S>& b,
                       const Pose<S>& pose_b, bool b_first) {
  const ShapeKind kind = kind_of(a);
  if (kind != kind_of(b)) return kind > kind_of(b);
  if (kind != ShapeKind::Sphere && kind != ShapeKind::Capsule) return b_first;
  return round_against_order(a, pose_a, b, pose_b, b_first);
}

/// The poses are read last before any arithmetic, and are rarely in the nearest cache.
template <class S>
[[gnu::always_inline]] inline void prefetch_pair(const Pose<S>& a, const Pose<S>& b,
                                                 const PairCache<S>* cache) {
  __builtin_prefetch(&a);
  __builtin_prefetch(&b);
  __builtin_prefetch(reinterpret_cast<const char*>(&b) + sizeof b - 1);
  if (cache != nullptr) __builtin_prefetch(cache);
}

}  // namespace

bool can_cache(ShapeKind one, ShapeKind other) {
  return one == ShapeKind::Hull && other == ShapeKind::Hull;
}

bool can_collide(ShapeKind one, ShapeKind other) {
  return entry<double>(std::min(one, other), std::max(one, other)) != nullptr;
}

template <class S>
void collide(const Shape<S>& a, const Pose<S>& pose_a, const Shape<S>& b, const Pose<S>& pose_b,
             const CollideOptions& options, Manifolds<S>& manifolds,
             std::type_identity_t<PairCache<S>>* cache, trace::Pair* record,
             const trace::Stages& stages) {
  prefetch_pair(pose_a, pose_b, cache);
  if (kind_of(a) == ShapeKind::Capsule && kind_of(b) == ShapeKind::Capsule && record == nullptr &&
      collide_two_capsules(*std::get_if<Capsule<S>>(&a), pose_a, *std::get_if<Capsule<S>>(&b),
                           pose_b, options, manifolds))
    return;
  const bool swapped = against_the_table(a, pose_a, b, pose_b, options.b_first);
  const auto work = [&](const PlacedPair<S>& pair, const CollideOptions& in_order) {
    if constexpr (std::is_same_v<S, float>)
      if (belongs_in_double(a, b)) [[unlikely]]
        return collide_in_double(pair, in_order, manifolds, record, stages);
    collide_in_order(pair, in_order, manifolds, record, stages);
  };
  work_in_order<S>({a, pose_a, b, pose_b, cache}, swapped, options, manifolds, record, work);
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(collide);

}  // namespace contactscope
