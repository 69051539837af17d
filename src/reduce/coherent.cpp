#include "reduce/optimal_ring.h"

namespace contactscope {
namespace {

/// Fraction of the reference area that a choice may lose before it is replaced.
constexpr double kCoherentTolerance = 0.05;
/// How much shallower than the deepest point the deepest kept one may be: this fraction of the
/// square root of the largest area (of the length of points on a line) or, if more, of the deepest
/// separation. Like the preference between the axes of the separating axis test.
constexpr double kCoherentDepthOfLength = 0.002;
constexpr double kCoherentDepthOfSeparation = 0.05;

constexpr int kMaxCoherentCorners = 8;

/// The choice that others are compared with.
template <class S> struct Reference {
  KeptIndices kept;
  int inner = -1;  // its deep point that is not a corner of the ring, if any
  S size;          // measure()
  bool by_length;
  S deepest;  // separation
  S slack;    // allowed increase of the separation

  /// Whether one of the points is deep enough within this part of the slack.
  bool admits(S part, S separation) const { return separation <= deepest + part * slack; }
  bool admits(S part, const Candidates<S>& points, const KeptIndices& kept_points) const {
    return std::ranges::any_of(kept_points,
                               [&](int i) { return admits(part, points.separation(i)); });
  }
};

template <class S>
Reference<S> find_reference(const Candidates<S>& points, Patch<S>& patch,
                            const ReduceOptions& options) {
  const int most = options.max_points;
  const S tie = points.depth_tie(options);
  const int deepest = points.deepest();
  Reference<S> reference;
  reference.deepest = points.separation(deepest);
  reference.by_length = most <= 2 || patch.is_flat;
  const CornerRing<S> largest = largest_ring(points, patch, std::max(most, 2));
  reference.kept = points_of(patch, largest, tie);
  reference.size =
      reference.by_length ? measure(points, reference.kept, true) : largest.doubled_area;
  const S length = std::sqrt(reference.by_length ? reference.size : S(0.5) * reference.size);
  reference.slack = std::max(S(kCoherentDepthOfLength) * length,
                             S(kCoherentDepthOfSeparation) * std::abs(reference.deepest));
  if (most >= 2 && reference.admits(S(0.5), points, reference.kept)) return reference;

  reference.kept.clear();
  const auto improve_with = [&](int i) {
    KeptIndices kept;
    const ChoiceWith<S> choice = largest_with(points, patch, i, most, tie, kept);
    const S size = reference.by_length ? measure(points, kept, true) : choice.doubled_area;
    if (!reference.kept.empty() && size <= reference.size + patch.tie) return;
    reference.size = size;
    reference.kept = kept;
    reference.inner = choice.is_in_ring ? -1 : i;
  };
  improve_with(deepest);
  for (int i = 0; i < points.count(); ++i)
    if (i != deepest && reference.admits(S(0.5), points.separation(i))) improve_with(i);
  return reference;
}

/// Requirements for a ring of corners.
template <class S> struct CoherentWish {
  StaticVector<bool, kMaxManifoldPoints> is_old, is_deep;  // by corner
  // A deep point inside the patch, kept in addition to the ring; else a corner must be deep.
  std::optional<Vec2<S>> inner;
  S least_doubled_area;
  int most;  // corners, 2 to kMaxCoherentCorners
};

template <class S> struct CoherentRing {
  int old = 0;
  CornerRing<S> ring;  // empty if no ring with an old corner meets the requirements
};

/// The best chain from the first corner to another, by numbers of corners, old ones and deep ones.
template <class S> struct Chain {
  S doubled_area = -std::numeric_limits<S>::infinity();
  int before = -1;  // the chain without the last corner
};

/// Over all rings that begin at corner `first`, for one round.
template <class S>
void improve_from(const Patch<S>& patch, const CoherentWish<S>& wish, int first,
                  std::vector<Chain<S>>& chains, CoherentRing<S>& best) {
  const int columns = patch.count;
  const auto place = [&](int used, int old, bool is_deep, int end) {
    return ((used * (wish.most + 1) + old) * 2 + static_cast<int>(is_deep)) * columns + end;
  };
  const auto corner = [&](int i) { return (first + i) % columns; };
  const auto is_old = [&](int i) { return static_cast<int>(at(wish.is_old, corner(i))); };
  const auto is_deep = [&](int i) { return wish.inner || at(wish.is_deep, corner(i)); };
  const Vec2<S> centre = wish.inner.value_or(patch.corner(first));

  chains.assign(static_cast<std::size_t>(place(wish.most, 0, false, 0)), {});
  at(chains, place(0, is_old(0), is_deep(0), 0)).doubled_area = S(0);
  for (int from = 0; from + 1 < columns; ++from) {
    for (int to = from + 1; to < columns; ++to) {
      const S triangle = seen(patch, centre, first + from, first + to);
      for (int used = 0; used + 1 < wish.most; ++used) {
        for (int old = 0; old <= used + 1; ++old) {
          for (const bool deep : {false, true}) {
            const int before = place(used, old, deep, from);
            const S area = at(chains, before).doubled_area + triangle;
            Chain<S>& chain =
                at(chains, place(used + 1, old + is_old(to), deep || is_deep(to), to));
            if (area > chain.doubled_area) chain = {area, before};
          }
        }
      }
    }
  }

  int last = -1;
  for (int used = 1; used < wish.most; ++used) {
    for (int old = std::max(1, best.old); old <= used + 1; ++old) {
      for (int end = 1; end < columns; ++end) {
        const int chain = place(used, old, true, end);
        const S area = at(chains, chain).doubled_area + seen(patch, centre, first + end, first);
        const bool is_better = old > best.old ? area >= wish.least_doubled_area
                                              : old == best.old && area > best.ring.doubled_area;
        if (!is_better) continue;
        best.old = old;
        best.ring.doubled_area = area;
        last = chain;
      }
    }
  }
  if (last < 0) return;
  best.ring.corners.clear();
  for (int chain = last; chain >= 0; chain = at(chains, chain).before)
    best.ring.corners.push_back(corner(chain % columns));
  std::reverse(best.ring.corners.begin(), best.ring.corners.end());
}

/// The ring with the most old corners among those that meet the requirements; among equals the
/// largest. The dynamic programming of best_ring() with the number of old corners and the presence
/// of a deep one as state. A ring with an old corner can begin there.
template <class S>
CoherentRing<S> most_coherent_ring(const Patch<S>& patch, const CoherentWish<S>& wish) {
  CoherentRing<S> best;
  std::vector<Chain<S>> chains;
  for (int first = 0; first < patch.count; ++first)
    if (at(wish.is_old, first)) improve_from(patch, wish, first, chains, best);
  return best;
}

/// The ring that keeps the most old points, with or without the reference's additional point.
template <class S>
KeptIndices most_coherent(const Candidates<S>& points, const Patch<S>& patch,
                          const Reference<S>& reference, const KeptIndices& old, int most) {
  CoherentWish<S> wish;
  for (int i = 0; i < patch.count; ++i) {
    wish.is_old.push_back(steps::contains(old, patch.point[i]));
    wish.is_deep.push_back(reference.admits(S(0.5), points.separation(patch.point[i])));
  }
  wish.least_doubled_area = S(1 - 0.5 * kCoherentTolerance) * reference.size;
  wish.most = most;
  CoherentRing<S> best = most_coherent_ring(patch, wish);
  KeptIndices chosen;
  if (reference.inner >= 0) {
    wish.inner = patch.project(points[reference.inner]);
    wish.most = most - 1;
    CoherentRing<S> around = most_coherent_ring(patch, wish);
    if (!around.ring.corners.empty())
      around.old += static_cast<int>(steps::contains(old, reference.inner));
    if (around.old > best.old) {
      best = around;
      chosen.push_back(reference.inner);
    }
  }
  if (best.ring.corners.empty()) return reference.kept;
  for (const int corner : best.ring.corners) chosen.push_back(patch.point[corner]);

  KeptIndices kept;
  for (const int i : old)
    if (steps::contains(chosen, i)) kept.push_back(i);
  for (const int i : chosen) steps::add_once(kept, i);
  return kept;
}

/// A reducer that keeps the points of the previous frame, by their ids, while they are good enough:
/// a changed id costs the solver its impulse. Two bounds hold in every frame, whatever the history:
/// - Depth: one kept point is at most a slack (the constants above) shallower than the deepest.
///   This comes first, because a corner that sinks without a point to hold it is worse than one
///   that is held with a shorter lever.
/// - Area: the hull of the kept points, seen along the normal, is at least 95% of the reference:
///   the largest area of at most max_points points, one of them within half of the slack. That is
///   reduce_to_optimal's area if the patch is nearly level or its best points include a deep one.
///   Otherwise it is at least 1 - 2 / max_points of that area (omitting the cheapest corner leaves
///   room for a deep point), and always at least reduce_to_optimal_deepest's. So the area is at
///   least 0.95 (1 - 2 / max_points) of reduce_to_optimal's: 47.5% for four points.
/// For one or two points, and for points on one line, the distance of the extremes replaces area.
///
/// Hysteresis as between the axes of the separating axis test (Catto 2007, "Feature Flip-Flop"),
/// for points; no engine that we know of does this. Steps: 1. the points with the previous frame's
/// ids; 2. the reference: the largest choice that is deep enough; 3. the old points, in their
/// order, if all exist and are large and deep enough; 4. otherwise a new choice of corners within
/// half of the tolerance and of the slack, so that noise changes nothing: the most kept ids, then
/// the largest area; old points first, then the new ones around the patch. For max_points above
/// eight, on a line, or if no id recurs, it is the reference itself.
constexpr auto reduce_coherently = []<class S>(const Candidates<S>& points,
                                               const ReduceOptions& options) {
  const int most = options.max_points;
  const KeptIndices old = points.kept_before(options);
  Patch<S> patch(points);
  const Reference<S> reference = find_reference(points, patch, options);

  const bool all_there =
      !old.empty() && old.size() == options.previous.size() && count_of(old) <= most;
  const S part = S(1 - kCoherentTolerance);
  const S enough = (reference.by_length ? part * part : part) * reference.size;
  if (all_there && reference.admits(S(1), points, old) &&
      measure(points, old, reference.by_length) >= enough) {
    return old;
  }
  if (old.empty() || reference.by_length || most > kMaxCoherentCorners) return reference.kept;
  return most_coherent(points, patch, reference, old, most);
};

}  // namespace

std::vector<ReducerInfo> coherent_reducers() {
  return {listed("coherent",
                 "those of the last frame while deep and large enough, else nearly optimal",
                 reduce_coherently, true)};
}

}  // namespace contactscope
