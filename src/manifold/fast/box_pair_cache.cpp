#include "manifold/fast/box_face_contact.h"
#include "manifold/fast/fast_pairs.h"

namespace contactscope {
namespace {

using namespace boxes;

/// How far any point of one box has moved, seen from the other, if both have turned by `turn`. Each
/// box's centre is the origin of its own frame.
template <class S>
[[gnu::always_inline]] inline S moved_since(const PairCache<S>& cache, const BoxPair<S>& pair,
                                            S turn) {
  const auto norm = [](const Three<S>& v) __attribute__((always_inline)) {
    return std::sqrt(dot<S>(v, v));
  };
  const Three<S> back = -pair.offset;
  const Three<S> center_a = dot_sum<S>(Three<S>(pair.rows.of[0] * spread<0>(back)),
                                       Three<S>(pair.rows.of[1] * spread<1>(back)),
                                       Three<S>(pair.rows.of[2] * spread<2>(back)));
  const S of_b = norm(pair.offset - three(cache.center_b)) + turn * pair.b.radius;
  const S of_a = norm(center_a - three(cache.center_a)) + turn * pair.a.radius;
  return std::max(of_a, of_b);
}

/// Metres: separation along a face of the box that does not own the kept face, or less by the
/// rounding of either sum, so that a hit here is one of the general path. Neither this nor
/// along_edges() is inlined, which would slow down the rest.
template <class S> [[gnu::noinline]] S along_face(const BoxPair<S>& pair, Owner kept, int face) {
  const int axis = face / 2;
  const S sign = face % 2 == 0 ? S(1) : S(-1);
  const Three<S> half_a = three(pair.a.half_extents);
  const Three<S> half_b = three(pair.b.half_extents);
  const S rounding = tie_tolerance(pair.scale);
  if (kept == Owner::B) {
    const S reach = dot<S>(absolute<S>(pair.rows.of[axis]), half_b);
    return sign * pair.position[axis] - reach - half_a[axis] - rounding;
  }
  const Three<S>& normal = pair.columns.of[axis];
  const S reach = dot<S>(absolute<S>(normal), half_a);
  return -sign * dot<S>(normal, pair.offset) - half_b[axis] - reach - rounding;
}

/// Metres, less by rounding as above: separation along the cross product of an edge of A and one of
/// B, out of the faces of A's; -infinity if it is unreliable, or without edges.
template <class S>
[[gnu::noinline]] S along_edges(const BoxPair<S>& pair, const std::pair<int, int>& edges) {
  if (edges.first < 0) return -std::numeric_limits<S>::infinity();
  const int edge = 2 * edges.first;
  const auto axis_of = [](int half_edge) {
    return (kBox.origin(half_edge) ^ kBox.origin(half_edge + 1)) >> 1;
  };
  const auto column = [&](int j) {
    return Vec3<S>(pair.rotation(0, j), pair.rotation(1, j), pair.rotation(2, j));
  };
  Vec3<S> normal = Vec3<S>::Unit(axis_of(edge)).cross(column(axis_of(2 * edges.second)));
  const S sine = normal.norm();
  if (!(sine >= S(2) * kNoisySine<S>)) return -std::numeric_limits<S>::infinity();
  S out = 0;
  for (const int face : {kBox.face(edge), kBox.face(edge + 1)})
    out += face % 2 == 0 ? normal[face / 2] : -normal[face / 2];
  normal *= (out < S(0) ? S(-1) : S(1)) / sine;
  S separation = normal.dot(pair.position) - normal.cwiseAbs().dot(pair.a.half_extents);
  for (int j = 0; j < 3; ++j)
    separation -= std::abs(normal.dot(column(j))) * pair.b.half_extents[j];
  return separation - tie_tolerance(pair.scale);
}

/// Whether the cache gives the contact; it has no points if the kept axis separates.
template <class S>
[[gnu::always_inline]] inline bool from_cache(const BoxPair<S>& pair, const Quat<S>& rotation,
                                              const PairCache<S>& cache,
                                              const CollideOptions& options,
                                              BoxContact<S>& contact) {
  const S margin = static_cast<S>(options.margin);
  const Owner owner = cache.axis == AxisKind::FaceA ? Owner::A : Owner::B;
  const Columns<S> directions = owner == Owner::A ? pair.columns : pair.directions_of_b();
  RectanglePair<S> rectangles;
  const S slack = S(16) * std::numeric_limits<S>::epsilon() * pair.scale;
  const FacePair<S> faces = face_pair(pair, owner, cache.first, directions, slack, rectangles);
  if (!faces.separation.is_alone) return false;
  const S separation = faces.separation.least;
  if (separation > margin) return true;  // still, or now, a separating axis
  if (cache.kind != CachedKind::Features) return false;

  const S turn = turn_since(cache, rotation);
  const S moved = moved_since(cache, pair, turn);
  const S far_bound = cache.far + moved + depth_rounding(pair.scale);
  if (!preferred(separation, far_bound, margin, pair.min_radius)) return false;
  S deepest;
  if (!face_contact(faces, owner, cache.first, rectangles, pair.scale, margin, contact, deepest))
    return false;
  const S near_bound = deepest < S(0) ? deepest * (cache.near_cosine - turn) : deepest;
  const S bound = std::max(far_bound, near_bound);
  return contact.count > 0 && preferred(separation, bound, margin, pair.min_radius) &&
         is_still_deep(
             cache, deepest, separation, moved, pair.scale,
             [&] { return along_face(pair, owner, faces.incident); },
             [&] {
               const std::span points(contact.points, static_cast<std::size_t>(contact.count));
               return along_edges(pair, edges_at_deepest(points));
             });
}

}  // namespace

template <class S>
[[gnu::flatten]] bool collide_boxes_from_cache(const Hull<S>& a, const Pose<S>& pose_a,
                                               const Hull<S>& b, const Pose<S>& pose_b,
                                               const CollideOptions& options,
                                               const PairCache<S>& cache,
                                               std::vector<Manifold<S>>& manifolds) {
  const bool on_face = cache.axis == AxisKind::FaceA || cache.axis == AxisKind::FaceB;
  if (cache.kind == CachedKind::Empty || !on_face || cache.radius_a != a.radius ||
      cache.radius_b != b.radius || static_cast<unsigned>(cache.first) >= 6U ||
      options.preference != Preference::Relative)
    return false;
  const Pose<S> b_in_a = relative_pose(pose_a, pose_b);
  // Not a rotation, or not finite.
  if (!(std::abs(b_in_a.rotation.squaredNorm() - S(1)) <= S(8) * std::numeric_limits<S>::epsilon()))
    return false;
  const BoxPair<S> pair(a, b, b_in_a);
  BoxContact<S> contact;
  contact.scale = pair.scale;
  if (!from_cache(pair, b_in_a.rotation, cache, options, contact)) return false;
  if (contact.count > 0) finish(pose_a, options, contact, manifolds.emplace_back());
  return true;
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(collide_boxes_from_cache);

}  // namespace contactscope
