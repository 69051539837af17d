#include "reduce/optimal_ring.h"

namespace contactscope {
namespace {

/// The best chains of corners that begin at one corner: row r, column j holds the largest doubled
/// area of r + 1 corners that end at j. One column per corner of the patch.
template <class S> using Chains = Scratch<S, 5 * 64>;

/// The best ring that begins at corner `first` and uses no corner after `last`, which may be in the
/// second round. Replaces `best` if it is larger by more than rounding. `most` >= 2.
template <class S>
void improve_from(const Patch<S>& patch, const Vec2<S>& centre, int first, int last, int most,
                  Chains<S>& chains, CornerRing<S>& best) {
  constexpr S kNone = -std::numeric_limits<S>::infinity();
  const int columns = last - first + 1;
  const auto row = [&](int r) { return chains.data() + r * patch.count; };
  for (int r = 0; r < most; ++r) std::fill_n(row(r), columns, kNone);
  row(0)[0] = S(0);
  S area[kMaxManifoldPoints];
  for (int i = 0; i + 1 < columns; ++i) {
    for (int j = i + 1; j < columns; ++j) area[j] = seen(patch, centre, first + i, first + j);
    for (int r = 0; r + 1 < most; ++r) {
      const S before = row(r)[i];
      S* next = row(r + 1);
      for (int j = i + 1; j < columns; ++j) next[j] = std::max(next[j], before + area[j]);
    }
  }

  S largest = kNone;
  for (int j = 1; j < columns; ++j) {
    const S closing = seen(patch, centre, first + j, first);
    for (int r = 1; r < most; ++r) largest = std::max(largest, row(r)[j] + closing);
  }
  const S before = best.corners.empty() ? S(0) : best.doubled_area + patch.tie;
  if (!(largest > before)) return;
  best.doubled_area = largest;
  best.corners.clear();
  // Always the first among equals: otherwise rounding would choose, differently each time.
  int used = 0;
  int end = 0;
  while (used == 0) {
    const S closing = seen(patch, centre, first + ++end, first);
    for (int r = 1; r < most && used == 0; ++r)
      if (row(r)[end] + closing >= largest - patch.tie) used = r;
  }
  best.corners.push_back((first + end) % patch.count);
  for (; used > 0; --used) {
    const S along = row(used)[end] - patch.tie;
    int from = 0;
    while (!(row(used - 1)[from] + seen(patch, centre, first + from, first + end) >= along)) ++from;
    end = from;
    best.corners.push_back((first + end) % patch.count);
  }
  std::reverse(best.corners.begin(), best.corners.end());
}

template <class S> CornerRing<S> every_corner(const Patch<S>& patch) {
  CornerRing<S> ring;
  for (int i = 0; i < patch.count; ++i) ring.corners.push_back(i);
  ring.doubled_area = patch.doubled_area;
  return ring;
}

/// The largest polygon of at most `most` >= 2 corners. With a point `inner` of the patch: the
/// corners whose convex hull together with it has the largest area, in doubled_area.
///
/// The area of a polygon is the sum of the triangles that its edges make with one fixed point, and
/// the best polygon has only corners of the convex hull. So this is a longest path around the hull,
/// by dynamic programming for each first corner. The hull of a ring and a point consists of the
/// triangles between the point and the edges of the ring that it sees from within. O(most n^3).
template <class S>
CornerRing<S> best_ring(const Patch<S>& patch, int most, const Vec2<S>* inner = nullptr) {
  if (patch.count <= most) return every_corner(patch);
  CornerRing<S> best;
  Chains<S> chains(most * patch.count);
  for (int first = 0; first < patch.count; ++first) {
    const Vec2<S> centre = inner != nullptr ? *inner : patch.corner(first);
    improve_from(patch, centre, first, patch.count - 1, most, chains, best);
  }
  return best;
}

/// The largest polygon that contains corner `through`. O(most n^2).
template <class S> CornerRing<S> best_ring_through(const Patch<S>& patch, int through, int most) {
  if (patch.count <= most) return every_corner(patch);
  if (most == 4) return best_quadrilateral_through(patch, through);
  CornerRing<S> best;
  Chains<S> chains(most * patch.count);
  improve_from(patch, patch.corner(through), through, through + patch.count - 1, most, chains,
               best);
  return best;
}

/// The points of a ring, counter-clockwise seen against the normal, starting at one position.
template <class S>
void append(KeptIndices& kept, const Patch<S>& patch, const CornerRing<S>& ring, int begin) {
  const int size = count_of(ring.corners);
  const int step = patch.is_mirrored() ? size - 1 : 1;
  for (int i = 0; i < size; ++i)
    kept.push_back(patch.point[at(ring.corners, (begin + i * step) % size)]);
}

/// Position of the deepest point in a ring, up to `depth_tie` the earliest.
template <class S> int deepest_of(const Patch<S>& patch, const CornerRing<S>& ring, S depth_tie) {
  S least = std::numeric_limits<S>::infinity();
  for (const int corner : ring.corners) least = std::min(least, patch.separation[corner]);
  int best = -1;
  for (int i = 0; i < count_of(ring.corners); ++i) {
    const int corner = at(ring.corners, i);
    if (patch.separation[corner] <= least + depth_tie &&
        (best < 0 || patch.point[corner] < patch.point[at(ring.corners, best)]))
      best = i;
  }
  return std::max(best, 0);
}

/// As append() and deepest_of() for a ring of four, without unpredictable branches.
template <class S>
KeptIndices kept_four(const Patch<S>& patch, const CornerRing<S>& ring, S depth_tie) {
  using lanes::Pack;
  constexpr int kLanes = lanes::kWidth<S>;
  const auto point_at = [&](int place) { return patch.point[at(ring.corners, place)]; };
  const int four[4] = {point_at(0), point_at(1), point_at(2), point_at(3)};
  Pack<S> depths[4 / kLanes];
  for (int i = 0; i < 4; i += kLanes)
    depths[i / kLanes] =
        lanes::each<S>([&](int lane) { return patch.separation[at(ring.corners, i + lane)]; });
  Pack<S> deepest = depths[0];
  for (const Pack<S>& depth : depths) deepest = lanes::smaller(deepest, depth);
  deepest = lanes::smallest<S>(deepest);
  std::uint32_t equal = 0;
  for (int i = 0; i < 4; i += kLanes)
    equal |= lanes::bits<S>(depths[i / kLanes] <= deepest + depth_tie) << i;
  int begin = std::countr_zero(equal);
  if ((equal & (equal - 1)) != 0) begin = deepest_of(patch, ring, depth_tie);
  const int step = 1 - 2 * static_cast<int>(patch.is_mirrored());
  KeptIndices kept;
  for (int i = 0; i < 4; ++i) kept.push_back(four[(begin + i * step) & 3]);
  return kept;
}

template <class S> int corner_at(const Patch<S>& patch, const Vec2<S>& place) {
  for (int i = 0; i < patch.count; ++i)
    if (patch.xs[i] == place.x() && patch.ys[i] == place.y()) return i;
  return -1;
}

/// The corners to keep with a place that is not a corner. For points on one line the two extremes.
template <class S>
CornerRing<S> ring_around(const Patch<S>& patch, const Vec2<S>& place, int most) {
  if (most > 2 && !patch.is_flat) return best_ring(patch, most - 1, &place);
  CornerRing<S> corners_kept;
  const auto add = [&](int corner) {
    if (!patch.coincide(patch.corner(corner), place)) corners_kept.corners.push_back(corner);
  };
  if (most == 2) {
    const auto squared_distance = [&](int i) { return (place - patch.corner(i)).squaredNorm(); };
    add(std::max(0, steps::highest(patch.count, squared_distance, S(0), S(1), patch.tie)));
  } else if (most > 2) {
    for (const int corner : farthest_pair(patch).corners) add(corner);
  }
  return corners_kept;
}

}  // namespace

template <class S> CornerRing<S> farthest_pair(const Patch<S>& patch) {
  const auto [first, second] = steps::farthest_two<S>(
      patch.count, [&](int i, int j) { return (patch.corner(j) - patch.corner(i)).squaredNorm(); },
      patch.tie);
  CornerRing<S> ring;
  ring.corners.push_back(first);
  if (!patch.coincide(patch.corner(first), patch.corner(second))) ring.corners.push_back(second);
  return ring;
}

template <class S>
CornerRing<S> largest_ring(const Candidates<S>& points, const Patch<S>& patch, int most) {
  if (most == 2 || patch.is_flat) return farthest_pair(patch);
  if (patch.count <= most) return every_corner(patch);
  const S largest =
      most == 4 ? area_of_best_quadrilateral(patch) : best_ring(patch, most).doubled_area;
  const auto id = [&](int corner) { return points.id(patch.point[corner]); };
  const auto any = [](int) { return true; };
  CornerRing<S> ring;
  for (int corner = -1; (corner = steps::next_by_id(patch.count, id, corner, any)) >= 0;) {
    ring = best_ring_through(patch, corner, most);
    if (ring.doubled_area >= largest - patch.tie) return ring;
  }
  return ring;  // areas are NaN if S overflows
}

template <class S>
KeptIndices points_of(const Patch<S>& patch, const CornerRing<S>& ring, S depth_tie) {
  if (ring.corners.size() == 4) return kept_four(patch, ring, depth_tie);
  KeptIndices kept;
  append(kept, patch, ring, deepest_of(patch, ring, depth_tie));
  return kept;
}

template <class S> S measure(const Candidates<S>& points, const KeptIndices& kept, bool by_length) {
  StaticVector<ContactPoint<S>, kMaxManifoldPoints> chosen;
  for (const int i : kept) chosen.push_back(at(points.points, i));
  const Patch<S> patch({{chosen.data(), chosen.size()}, points.normal});
  if (!by_length) return patch.doubled_area;
  const CornerRing<S> pair = farthest_pair(patch);
  return (patch.corner(pair.corners.back()) - patch.corner(pair.corners[0])).squaredNorm();
}

template <class S>
KeptIndices as_before_if_equal(const Candidates<S>& points, const Patch<S>& patch,
                               const KeptIndices& kept, S deep, const ReduceOptions& options) {
  if (options.previous.empty()) return kept;
  const KeptIndices old = points.kept_before(options);
  const bool by_length = options.max_points == 2 || patch.is_flat;
  const auto is_deep = [&](int i) { return points.separation(i) <= deep; };
  const bool may_stay =
      old.size() == options.previous.size() && count_of(old) <= options.max_points &&
      !std::ranges::is_permutation(old, kept) && std::ranges::any_of(old, is_deep);
  if (!may_stay) return kept;
  const S least = measure(points, kept, by_length) - patch.tie;
  return measure(points, old, by_length) >= least ? old : kept;
}

template <class S>
ChoiceWith<S> largest_with(const Candidates<S>& points, Patch<S>& patch, int point, int most,
                           S depth_tie, KeptIndices& kept) {
  const Vec2<S> place = patch.project(points[point]);
  const int corner = most > 2 && !patch.is_flat ? corner_at(patch, place) : -1;
  if (corner < 0) {
    const CornerRing<S> ring = ring_around(patch, place, most);
    kept.push_back(point);
    append(kept, patch, ring, deepest_of(patch, ring, depth_tie));
    return {ring.doubled_area, false};
  }
  patch.point[corner] = point;
  patch.separation[corner] = points.separation(point);
  const CornerRing<S> ring = best_ring_through(patch, corner, most);
  int begin = 0;
  while (at(ring.corners, begin) != corner) ++begin;
  append(kept, patch, ring, begin);
  return {ring.doubled_area, true};
}

namespace {

/// The max_points points whose convex hull, seen along the normal, has the largest area: exact up
/// to rounding, in O(n^2) for four points. Among choices whose areas differ by less than the
/// rounding of S (in float some 1e-6 of the area) the previous frame's is kept. Otherwise the first
/// by ids wins (largest_ring()), so noise changes nothing. For two points: the farthest pair. For
/// one: a support point in a fixed direction, which is least likely to flip with small changes of
/// the patch. Omits points that would add no area: of a line all but its extremes.
///
/// Counter-clockwise seen against the normal, beginning with the deepest kept point (the earliest
/// among equals). Separations are not used otherwise.
///
/// The talk grows four points one by one (Gregorius 2015, "Contact Point Reduction"); this chooses
/// them at once. Steps: project the points into the plane and take the corners of their convex
/// hull, because no other point is a corner of the best polygon (Patch); find their best ring
/// (largest_ring()); list it from its deepest point.
constexpr auto reduce_to_optimal = []<class S>(const Candidates<S>& points,
                                               const ReduceOptions& options) {
  if (options.max_points == 1) {
    KeptIndices kept;
    kept.push_back(points.farthest_along(steps::fixed_direction(points.normal)));
    return kept;
  }
  const Patch<S> patch(points);
  const CornerRing<S> ring = largest_ring(points, patch, options.max_points);
  return as_before_if_equal(points, patch, points_of(patch, ring, points.depth_tie(options)),
                            std::numeric_limits<S>::infinity(), options);
};

/// The choice of at most max_points points, including the deepest, whose convex hull, seen along
/// the normal, has the largest area: exact up to rounding. Points whose separations differ only by
/// rounding are equally deep (Candidates::depth_tie()), and any of them satisfies this: for a level
/// patch the result is reduce_to_optimal's. Ties in area are broken as there. The deepest point may
/// be inside the hull, even of the kept points. For two points: the deepest and the farthest from
/// it. For points on one line: the two extremes and the deepest, if it is neither.
///
/// The deepest comes first, the earliest among equals; the others follow counter-clockwise seen
/// against the normal, from it, or if it is no corner from the next deepest.
///
/// As reduce_to_optimal() with one given point. Gregorius 2015 also begins with the deepest and
/// then takes the farthest; this chooses the others at once (largest_with()). Several deepest
/// points are each tried if the largest ring contains none of them.
constexpr auto reduce_to_optimal_deepest = []<class S>(const Candidates<S>& points,
                                                       const ReduceOptions& options) {
  const int deepest = points.deepest(), most = options.max_points;
  const S tie = points.depth_tie(options), deep = points.separation(deepest) + tie;
  const auto is_deep = [&](int i) { return points.separation(i) <= deep; };
  Patch<S> patch(points);
  KeptIndices kept;
  int ties = 0;
  for (int i = 0; i < points.count(); ++i) ties += is_deep(i) ? 1 : 0;
  if (ties == 1) {
    largest_with(points, patch, deepest, most, tie, kept);
  } else {
    if (most > 1) kept = points_of(patch, largest_ring(points, patch, most), tie);
    if (kept.empty() || !is_deep(kept[0])) {
      kept.clear();
      S largest = S(0);
      for (int i = -1; (i = points.next_by_id(i, is_deep)) >= 0;) {
        KeptIndices with;
        const S area = largest_with(points, patch, i, most, tie, with).doubled_area;
        if (!kept.empty() && !(area > largest + patch.tie)) continue;
        largest = area;
        kept = with;
      }
    }
  }
  return as_before_if_equal(points, patch, kept, deep, options);
};

}  // namespace

/// Reducers that choose all points at once.
std::vector<ReducerInfo> optimal_reducers() {
  return {listed("optimal", "the largest area", reduce_to_optimal),
          listed("optimal_deepest", "the largest area of those with the deepest",
                 reduce_to_optimal_deepest)};
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(farthest_pair, largest_ring, measure, as_before_if_equal, points_of);
CONTACTSCOPE_FLOAT_AND_DOUBLE(largest_with);

}  // namespace contactscope
