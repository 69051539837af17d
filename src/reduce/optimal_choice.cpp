#include "reduce/optimal_choice.h"

namespace contactscope {
namespace {

template <class S>
void append(KeptIndices& kept, const Patch<S>& patch, const CornerRing<S>& ring, int begin) {
  const int size = static_cast<int>(ring.corners.size());
  const int step = patch.is_mirrored() ? size - 1 : 1;
  int at = begin;
  for (int i = 0; i < size; ++i) {
    kept.push_back(patch.point(ring.corners[static_cast<std::size_t>(at)]));
    at += step;
    at -= at >= size ? size : 0;
  }
}

/// Position of the deepest in a ring, the earliest point of equals.
template <class S>
int deepest_of(std::span<const ContactPoint<S>> points, const Patch<S>& patch,
               const CornerRing<S>& ring) {
  int best = 0;
  int best_point = patch.point(ring.corners[0]);
  for (int i = 1; i < static_cast<int>(ring.corners.size()); ++i) {
    const int point = patch.point(ring.corners[static_cast<std::size_t>(i)]);
    const S depth = points[static_cast<std::size_t>(point)].separation;
    const S most = points[static_cast<std::size_t>(best_point)].separation;
    // Without a branch that nothing could foresee.
    const bool is_better = (depth < most) | ((depth == most) & (point < best_point));
    best = is_better ? i : best;
    best_point = is_better ? point : best_point;
  }
  return best;
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
KeptIndices kept_points(std::span<const ContactPoint<S>> points, const Patch<S>& patch,
                        const CornerRing<S>& ring) {
  KeptIndices kept;
  append(kept, patch, ring, deepest_of(points, patch, ring));
  return kept;
}

template <class S>
ChoiceWith<S> largest_with(std::span<const ContactPoint<S>> points, Patch<S>& patch, int point,
                           int most) {
  if (most == 1) return {{}, false};
  const PlanePoint<S> place = patch.project(points[static_cast<std::size_t>(point)].position);
  if (most == 2) return {farthest_beside(patch, place), false};
  if (patch.is_flat()) return {extremes_beside(patch, place), false};
  const int corner = corner_at(patch, place);
  if (corner < 0) return {best_ring_around(patch, place, most - 1), false};
  patch.rename(corner, point);
  return {best_ring_through(patch, corner, most), true};
}

template <class S>
KeptIndices kept_points(std::span<const ContactPoint<S>> points, const Patch<S>& patch,
                        const ChoiceWith<S>& choice, int point) {
  KeptIndices kept;
  const CornerRing<S>& ring = choice.ring;
  if (!choice.is_in_ring) kept.push_back(point);
  if (ring.corners.empty()) return kept;
  int begin = 0;
  if (choice.is_in_ring) {
    while (patch.point(ring.corners[static_cast<std::size_t>(begin)]) != point) ++begin;
  } else {
    begin = deepest_of(points, patch, ring);
  }
  append(kept, patch, ring, begin);
  return kept;
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                           \
  template CornerRing<S> largest_ring(const Patch<S>&, int);                                  \
  template KeptIndices kept_points(std::span<const ContactPoint<S>>, const Patch<S>&,         \
                                   const CornerRing<S>&);                                     \
  template ChoiceWith<S> largest_with(std::span<const ContactPoint<S>>, Patch<S>&, int, int); \
  template KeptIndices kept_points(std::span<const ContactPoint<S>>, const Patch<S>&,         \
                                   const ChoiceWith<S>&, int);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
