#include <algorithm>
#include <cmath>

#include "reduce/coherent_ring.h"
#include "reduce/optimal_choice.h"
#include "reduce/steps.h"

namespace contactscope {
namespace {

/// Of the reference area, a choice may lose this much before another is made.
constexpr double kCoherentTolerance = 0.05;
/// How much shallower than the deepest point the deepest kept one may be, of the square root of the
/// largest area (of the length of points on a line), or if that is more, of the deepest
/// separation. As the preference between the axes of the separating axis test.
constexpr double kCoherentDepthOfLength = 0.002;
constexpr double kCoherentDepthOfSeparation = 0.05;

/// The points that bear the ids of the frame before, in their order. The second of equal ids is the
/// second point that bears it.
template <class S>
KeptIndices find_previous(ContactPoints<S> points, std::span<const FeatureId> previous) {
  KeptIndices found;
  for (const FeatureId& id : previous) {
    for (int i = 0; i < count_of(points); ++i) {
      if (at(points, i).id == id && !steps::contains(found, i)) {
        found.push_back(i);
        break;
      }
    }
  }
  return found;
}

/// Doubled area, or squared distance of the extremes: what a choice is measured by.
template <class S>
S measure(ContactPoints<S> points, const Vec3<S>& normal, const KeptIndices& kept, bool by_length) {
  StaticVector<ContactPoint<S>, kMaxManifoldPoints> chosen;
  for (const int i : kept) chosen.push_back(at(points, i));
  const Patch<S> patch({chosen.data(), chosen.size()}, normal);
  if (!by_length) return patch.doubled_area();
  const CornerRing<S> pair = farthest_pair(patch);
  return squared_distance(patch.corner(pair.corners[0]), patch.corner(pair.corners.back()));
}

/// Which points are deep enough.
template <class S>
struct Depth {
  S limit;  // of the separation

  bool admits(ContactPoints<S> points, int i) const { return at(points, i).separation <= limit; }
  bool admits(ContactPoints<S> points, const KeptIndices& kept) const {
    return std::any_of(kept.begin(), kept.end(), [&](int i) { return admits(points, i); });
  }
};

/// The choice that others are measured against.
template <class S>
struct Reference {
  KeptIndices kept;
  int beside = -1;  // the deep point in it that is no corner of the ring, if there is one
  S size;           // measure()
  bool by_length;
  S deepest;  // separation
  S slack;    // of the separation

  Depth<S> within(S part) const { return {deepest + part * slack}; }
};

/// Puts the largest choice that contains point `i` into `reference` if it is larger.
template <class S>
void improve_with(ContactPoints<S> points, const Vec3<S>& normal, Patch<S>& patch, int i, int most,
                  Reference<S>& reference) {
  const ChoiceWith<S> choice = largest_with(points, patch, i, most);
  const KeptIndices kept = kept_points(points, patch, choice, i);
  const S size =
      reference.by_length ? measure(points, normal, kept, true) : choice.ring.doubled_area;
  if (size <= reference.size) return;
  reference.size = size;
  reference.kept = kept;
  reference.beside = choice.is_in_ring ? -1 : i;
}

template <class S>
Reference<S> find_reference(ContactPoints<S> points, const Vec3<S>& normal, Patch<S>& patch,
                            int most) {
  const int deepest = steps::deepest_point(points);
  Reference<S> reference;
  reference.deepest = at(points, deepest).separation;
  reference.by_length = most <= 2 || patch.is_flat();
  const CornerRing<S> largest = largest_ring(patch, std::max(most, 2));
  reference.kept = kept_points(points, patch, largest);
  reference.size =
      reference.by_length ? measure(points, normal, reference.kept, true) : largest.doubled_area;
  const S length = std::sqrt(reference.by_length ? reference.size : S(0.5) * reference.size);
  reference.slack = std::max(S(kCoherentDepthOfLength) * length,
                             S(kCoherentDepthOfSeparation) * std::abs(reference.deepest));
  if (most >= 2 && reference.within(S(0.5)).admits(points, reference.kept)) return reference;

  reference.size = S(-1);
  improve_with(points, normal, patch, deepest, most, reference);
  for (int i = 0; i < count_of(points); ++i) {
    if (i == deepest || !reference.within(S(0.5)).admits(points, i)) continue;
    improve_with(points, normal, patch, i, most, reference);
  }
  return reference;
}

/// The ring that keeps the most old points, of corners alone or with the point beside the ring that
/// the reference has.
template <class S>
KeptIndices most_coherent(ContactPoints<S> points, const Patch<S>& patch,
                          const Reference<S>& reference, const KeptIndices& old, int most) {
  const Depth<S> depth = reference.within(S(0.5));
  bool is_old[kMaxManifoldPoints];
  bool is_deep[kMaxManifoldPoints];
  for (int i = 0; i < patch.count(); ++i) {
    is_old[i] = steps::contains(old, patch.point(i));
    is_deep[i] = depth.admits(points, patch.point(i));
  }
  const S least = S(1 - 0.5 * kCoherentTolerance) * reference.size;
  CoherentWish<S> wish = {is_old, is_deep, std::nullopt, least, most};
  CoherentRing<S> best = most_coherent_ring(patch, wish);
  KeptIndices chosen;
  if (reference.beside >= 0) {
    const Vec3<S>& beside = steps::position(points, reference.beside);
    wish = {is_old, is_deep, patch.project(beside), least, most - 1};
    CoherentRing<S> around = most_coherent_ring(patch, wish);
    if (!around.ring.corners.empty()) {
      around.old += static_cast<int>(steps::contains(old, reference.beside));
    }
    if (around.old > best.old) {
      best = around;
      chosen.push_back(reference.beside);
    }
  }
  if (best.ring.corners.empty()) return reference.kept;
  for (const int corner : best.ring.corners) chosen.push_back(patch.point(corner));

  KeptIndices kept;
  for (const int i : old) {
    if (steps::contains(chosen, i)) kept.push_back(i);
  }
  for (const int i : chosen) steps::add_once(kept, i);
  return kept;
}

/// A reducer that keeps the points of the frame before, by their ids, while they are good enough:
/// an id that changes costs the solver its impulse. Two things are bounded in every frame, whatever
/// went before:
/// - Depth: one of the kept is no more than a slack (the constants above) shallower than the
///   deepest.
/// - Area: the hull of the kept, seen along the normal, is no less than 95% of the reference. That
///   is the largest area of at most max_points points with one among them that is within half of
///   the slack: as reduce_to_optimal has wherever the patch is nearly level or its best points
///   include a deep one, else never less than 1 - 2 / max_points of it (without the corner that
///   costs least there is room for a deep point), and never less than reduce_to_optimal_deepest. So
///   of reduce_to_optimal never less than 0.95 (1 - 2 / max_points): 47.5% for four points.
/// For one or two points, and for points on one line, the distance of the extremes takes the place
/// of area.
///
/// Depth comes first, because a corner that sinks while no point is there to hold it is worse than
/// one that is held with a shorter lever.
///
/// Hysteresis: what was kept stays, in its order, while all of its ids are there and it fulfils
/// both. A new choice must fulfil both by half of the tolerance and half of the slack, so noise
/// that moves neither by that much changes nothing. Of such choices of corners of the patch the one
/// with the most kept ids is made, and of those the one of largest area: first the old points in
/// their order, then the new ones round the patch. With more than eight points, or on a line, or
/// when no id is there again, it is the reference itself, in the order of the optimal reducers.
///
/// Equal ids are told apart by their order among the points.
///
/// Hysteresis as between the axes of the separating axis test (Catto 2007, "Feature Flip-Flop"), for
/// the choice of points. No engine that we know of does this. Steps: find the points of the ids of
/// the frame before (find_previous); find the largest choice that is deep enough, the reference
/// (find_reference); keep the old points if they are all there, large and deep enough; if not,
/// choose anew with half of the freedom, as many old points as can be (most_coherent).
template <class S>
KeptIndices reduce_coherently(ContactPoints<S> points, const Vec3<S>& normal,
                              const ReduceOptions& options) {
  const int most = options.max_points;
  const KeptIndices old = find_previous(points, options.previous);
  Patch<S> patch(points, normal);
  const Reference<S> reference = find_reference(points, normal, patch, most);

  const bool all_there =
      !old.empty() && old.size() == options.previous.size() && count_of(old) <= most;
  const S part = S(1 - kCoherentTolerance);
  const S enough = (reference.by_length ? part * part : part) * reference.size;
  if (all_there && reference.within(S(1)).admits(points, old) &&
      measure(points, normal, old, reference.by_length) >= enough) {
    return old;
  }
  if (old.empty() || reference.by_length || most > kMostCoherentCorners) return reference.kept;
  return most_coherent(points, patch, reference, old, most);
}

}  // namespace

ReducerInfo coherent_reducer() {
  return {"coherent", "those of the last frame while deep and large enough, else nearly optimal",
          &reduce_coherently<float>, &reduce_coherently<double>, true};
}

}  // namespace contactscope
