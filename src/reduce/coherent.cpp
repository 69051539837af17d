#include "reduce/coherent.h"

#include <algorithm>
#include <cmath>

#include "reduce/coherent_ring.h"
#include "reduce/optimal_choice.h"
#include "reduce/steps.h"

/// Hysteresis as between the axes of the separating axis test (Catto 2007, "Feature Flip-Flop"),
/// for the choice of points. No engine that we know of does this; coherent.h has what it promises.
///
/// Steps: find the points of the ids of the frame before (find_previous); find the largest choice
/// that is deep enough, the reference (find_reference); keep the old points if they are all there,
/// large and deep enough; if not, choose anew with half of the freedom, as many old points as can
/// be (most_coherent).
namespace contactscope {
namespace {

template <class S>
using Points = std::span<const ContactPoint<S>>;

template <class S>
S separation(Points<S> points, int i) {
  return points[static_cast<std::size_t>(i)].separation;
}

/// The points that bear the ids of the frame before, in their order. The second of equal ids is the
/// second point that bears it.
template <class S>
KeptIndices find_previous(Points<S> points, std::span<const FeatureId> previous) {
  KeptIndices found;
  for (const FeatureId& id : previous) {
    for (int i = 0; i < static_cast<int>(points.size()); ++i) {
      if (points[static_cast<std::size_t>(i)].id == id && !steps::contains(found, i)) {
        found.push_back(i);
        break;
      }
    }
  }
  return found;
}

/// Doubled area, or squared distance of the extremes: what a choice is measured by.
template <class S>
S measure(Points<S> points, const Vec3<S>& normal, const KeptIndices& kept, bool by_length) {
  StaticVector<ContactPoint<S>, kMaxManifoldPoints> chosen;
  for (const int i : kept) chosen.push_back(points[static_cast<std::size_t>(i)]);
  const Patch<S> patch({chosen.data(), chosen.size()}, normal);
  if (!by_length) return patch.doubled_area();
  const CornerRing<S> pair = farthest_pair(patch);
  return squared_distance(patch.corner(pair.corners[0]), patch.corner(pair.corners.back()));
}

/// Which points are deep enough.
template <class S>
struct Depth {
  S limit;  // of the separation

  bool admits(Points<S> points, int i) const { return separation(points, i) <= limit; }
  bool admits(Points<S> points, const KeptIndices& kept) const {
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
void improve_with(Points<S> points, const Vec3<S>& normal, Patch<S>& patch, int i, int most,
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
Reference<S> find_reference(Points<S> points, const Vec3<S>& normal, Patch<S>& patch, int most) {
  const int deepest = steps::deepest_point(points);
  Reference<S> reference;
  reference.deepest = separation(points, deepest);
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
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    if (i == deepest || !reference.within(S(0.5)).admits(points, i)) continue;
    improve_with(points, normal, patch, i, most, reference);
  }
  return reference;
}

/// The ring that keeps the most old points, of corners alone or with the point beside the ring that
/// the reference has.
template <class S>
KeptIndices most_coherent(Points<S> points, const Patch<S>& patch, const Reference<S>& reference,
                          const KeptIndices& old, int most) {
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
    const Vec3<S>& position = points[static_cast<std::size_t>(reference.beside)].position;
    wish = {is_old, is_deep, patch.project(position), least, most - 1};
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

}  // namespace

template <class S>
KeptIndices reduce_coherently(std::span<const ContactPoint<S>> points, const Vec3<S>& normal,
                              const ReduceOptions& options) {
  const int most = options.max_points;
  const KeptIndices old = find_previous(points, options.previous);
  Patch<S> patch(points, normal);
  const Reference<S> reference = find_reference(points, normal, patch, most);

  const bool all_there =
      !old.empty() && old.size() == options.previous.size() && static_cast<int>(old.size()) <= most;
  const S part = S(1 - kCoherentTolerance);
  const S enough = (reference.by_length ? part * part : part) * reference.size;
  if (all_there && reference.within(S(1)).admits(points, old) &&
      measure(points, normal, old, reference.by_length) >= enough) {
    return old;
  }
  if (old.empty() || reference.by_length || most > kMostCoherentCorners) return reference.kept;
  return most_coherent(points, patch, reference, old, most);
}

template KeptIndices reduce_coherently(std::span<const ContactPoint<float>>, const Vec3<float>&,
                                       const ReduceOptions&);
template KeptIndices reduce_coherently(std::span<const ContactPoint<double>>, const Vec3<double>&,
                                       const ReduceOptions&);

}  // namespace contactscope
