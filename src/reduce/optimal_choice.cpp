#include "reduce/optimal_choice.h"

#include <bit>

#include "core/at.h"

namespace contactscope {
namespace {

/// The point at a place of a ring.
template <class S>
int point_at(const Patch<S>& patch, const CornerRing<S>& ring, int place) {
  return patch.point(at(ring.corners, place));
}

template <class S>
void append(KeptIndices& kept, const Patch<S>& patch, const CornerRing<S>& ring, int begin) {
  const int size = count_of(ring.corners);
  const int step = patch.is_mirrored() ? size - 1 : 1;
  for (int i = 0; i < size; ++i) {
    kept.push_back(point_at(patch, ring, (begin + i * step) % size));
  }
}

/// Position of the deepest in a ring, the earliest point of equals.
template <class S>
int deepest_of(ContactPoints<S> points, const Patch<S>& patch, const CornerRing<S>& ring) {
  int best = 0;
  for (int i = 1; i < count_of(ring.corners); ++i) {
    const int point = point_at(patch, ring, i);
    const int best_point = point_at(patch, ring, best);
    const S depth = at(points, point).separation;
    const S most = at(points, best_point).separation;
    if (depth < most || (depth == most && point < best_point)) best = i;
  }
  return best;
}

/// The points of a ring of four, in order from the deepest, as by append() and deepest_of(), but
/// without a branch that nothing could foresee.
template <class S>
KeptIndices kept_four(ContactPoints<S> points, const Patch<S>& patch, const CornerRing<S>& ring) {
  using lanes::Pack;
  constexpr int kLanes = lanes::kWidth<S>;
  const int four[4] = {point_at(patch, ring, 0), point_at(patch, ring, 1), point_at(patch, ring, 2),
                       point_at(patch, ring, 3)};
  Pack<S> depths[4 / kLanes];
  for (int i = 0; i < 4; i += kLanes) {
    depths[i / kLanes] =
        lanes::each<S>([&](int lane) { return patch.separation(at(ring.corners, i + lane)); });
  }
  Pack<S> deepest = depths[0];
  for (const Pack<S>& depth : depths) deepest = lanes::smaller(deepest, depth);
  deepest = lanes::smallest<S>(deepest);
  std::uint32_t equal = 0;
  for (int i = 0; i < 4; i += kLanes) {
    equal |= lanes::bits<S>(depths[i / kLanes] == deepest) << i;
  }
  int begin = std::countr_zero(equal);
  if ((equal & (equal - 1)) != 0) begin = deepest_of(points, patch, ring);

  const int step = 1 - 2 * static_cast<int>(patch.is_mirrored());
  KeptIndices kept;
  for (int i = 0; i < 4; ++i) kept.push_back(four[(begin + i * step) & 3]);
  return kept;
}

template <class S>
int corner_at(const Patch<S>& patch, const PlanePoint<S>& place) {
  for (int i = 0; i < patch.count(); ++i) {
    if (patch.x()[i] == place.x && patch.y()[i] == place.y) return i;
  }
  return -1;
}

/// The two extremes of points on one line, but those that are the given place themselves.
template <class S>
CornerRing<S> extremes_beside(const Patch<S>& patch, const PlanePoint<S>& place) {
  CornerRing<S> beside;
  for (const int corner : farthest_pair(patch).corners) {
    if (!patch.coincide(patch.corner(corner), place)) beside.corners.push_back(corner);
  }
  return beside;
}

template <class S>
CornerRing<S> farthest_beside(const Patch<S>& patch, const PlanePoint<S>& place) {
  CornerRing<S> beside;
  const int farthest = farthest_from(patch, place);
  if (!patch.coincide(patch.corner(farthest), place)) beside.corners.push_back(farthest);
  return beside;
}

}  // namespace

template <class S>
CornerRing<S> largest_ring(const Patch<S>& patch, int most) {
  return most == 2 || patch.is_flat() ? farthest_pair(patch) : best_ring(patch, most);
}

template <class S>
KeptIndices kept_points(ContactPoints<S> points, const Patch<S>& patch, const CornerRing<S>& ring) {
  if (ring.corners.size() == 4) return kept_four(points, patch, ring);
  KeptIndices kept;
  append(kept, patch, ring, deepest_of(points, patch, ring));
  return kept;
}

template <class S>
ChoiceWith<S> largest_with(ContactPoints<S> points, Patch<S>& patch, int point, int most) {
  if (most == 1) return {{}, false};
  const PlanePoint<S> place = patch.project(at(points, point).position);
  if (most == 2) return {farthest_beside(patch, place), false};
  if (patch.is_flat()) return {extremes_beside(patch, place), false};
  const int corner = corner_at(patch, place);
  if (corner < 0) return {best_ring_around(patch, place, most - 1), false};
  patch.rename(corner, point, at(points, point).separation);
  return {best_ring_through(patch, corner, most), true};
}

template <class S>
KeptIndices kept_points(ContactPoints<S> points, const Patch<S>& patch, const ChoiceWith<S>& choice,
                        int point) {
  KeptIndices kept;
  const CornerRing<S>& ring = choice.ring;
  if (!choice.is_in_ring) kept.push_back(point);
  if (ring.corners.empty()) return kept;
  int begin = 0;
  if (choice.is_in_ring) {
    while (patch.point(at(ring.corners, begin)) != point) ++begin;
  } else {
    begin = deepest_of(points, patch, ring);
  }
  append(kept, patch, ring, begin);
  return kept;
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                          \
  template CornerRing<S> largest_ring(const Patch<S>&, int);                                 \
  template KeptIndices kept_points(ContactPoints<S>, const Patch<S>&, const CornerRing<S>&); \
  template ChoiceWith<S> largest_with(ContactPoints<S>, Patch<S>&, int, int);                \
  template KeptIndices kept_points(ContactPoints<S>, const Patch<S>&, const ChoiceWith<S>&, int);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
