#include "reduce/grow.h"
#include "reduce/optimal_ring.h"

namespace contactscope {
namespace {

using steps::Added;

/// Treatment of a first point between the extremes of points on one line.
enum class OnALine {
  ExchangeFirst,  // for the other extreme: two points
  KeepFirst,      // together with both extremes
};

/// All of "Contact Point Reduction" after the first point. One point if all coincide.
template <Added added, class S>
KeptIndices grow_from(const Candidates<S>& points, int first, OnALine on_a_line,
                      const ReduceOptions& options) {
  Choices* const choices = options.choices;
  KeptIndices kept;
  kept.push_back(first);
  const int second = points.farthest_from(first);
  if (options.max_points == 1 || second == first) return kept;
  kept.push_back(second);
  if (choices != nullptr) [[unlikely]]
    choices->farthest(first);
  if (steps::grow<added>(points, kept, options)) return kept;
  const int other = points.farthest_from(second);
  if (on_a_line == OnALine::ExchangeFirst) {
    kept[0] = other;
    if (choices != nullptr) [[unlikely]] {
      choices->made.resize(1);
      choices->farthest(other);
    }
  } else if (options.max_points > 2 && points[other] != points[first]) {
    kept.push_back(other);
    if (choices != nullptr) [[unlikely]]
      choices->triangle(first, second);
  }
  return kept;
}

/// The reducer of Gregorius 2015, "Contact Point Reduction: 1st Point" to "4th Point (5)": a
/// support point in a fixed direction, the farthest point from it, the point that makes the largest
/// triangle, then the point that adds the most area outside. Further points are chosen like the
/// fourth. Keeps fewer than max_points if the rest would add no area: two extremes of points on one
/// line, one of coincident ones. Ignores separations. Deviation: if all points are on one line the
/// first is exchanged for the other extreme, because the support point may be between them.
///
/// `Added::Distance` is the counter-example of "4th Point (5)" and "(6)": the fourth and later
/// points are the farthest outside an edge, however short the edge. "Maximize area, not distance!"
/// The distance from an edge is the signed area over its length.
template <Added added>
constexpr auto reduce_from_support = []<class S>(const Candidates<S>& points,
                                                 const ReduceOptions& options) {
  if (added == Added::Area && options.choices == nullptr && options.max_points == 4 &&
      points.count() <= 8) {
    KeptIndices kept;
    if (area_of_eight(points, kept)) return kept;
  }
  if (options.choices != nullptr) [[unlikely]]
    options.choices->support(steps::fixed_direction(options.choices->points.normal).normalized());
  const int support = points.farthest_along(steps::fixed_direction(points.normal));
  return grow_from<added>(points, support, OnALine::ExchangeFirst, options);
};

/// `area` starting with the deepest point. Gregorius 2015, "Contact Point Reduction: 1st Point":
/// with continuous collision "we want to start with the deepest point and guarantee it is in our
/// reduced contact set". Of points on one line it keeps the deepest and the two extremes.
/// Deviation: of several points equally deep within rounding, the one with the largest area starts;
/// ties go to the previous frame's choice, then to the lowest id.
constexpr auto reduce_by_area_from_deepest = []<class S>(const Candidates<S>& points,
                                                         const ReduceOptions& options) {
  int first = points.deepest();
  const S deep = points.separation(first) + points.depth_tie(options);
  const auto is_deep = [&](int i) { return points.separation(i) <= deep; };
  KeptIndices ties;
  for (const int i : points.kept_before(options))
    if (is_deep(i)) ties.push_back(i);
  for (int i = -1; (i = points.next_by_id(i, is_deep)) >= 0;) steps::add_once(ties, i);
  if (ties.size() > 1) {
    const Patch<S> patch(points);
    const bool by_length = options.max_points <= 2 || patch.is_flat;
    const auto size_from = [&](int tie) {
      const KeptIndices kept = grow_from<Added::Area>(points, at(ties, tie), OnALine::KeepFirst,
                                                      {.max_points = options.max_points});
      return measure(points, kept, by_length);
    };
    first =
        at(ties, std::max(0, steps::highest(count_of(ties), size_from, S(-1), S(1), patch.tie)));
    if (options.choices != nullptr && !by_length) [[unlikely]] {
      std::vector<double> areas;
      for (int i = 0; i < count_of(ties); ++i)
        areas.push_back(0.5 * static_cast<double>(size_from(i)));
      options.choices->equally_deep({ties.begin(), ties.end()}, areas);
    }
  }
  if (options.choices != nullptr && options.choices->made.empty()) [[unlikely]]
    options.choices->deepest();
  return grow_from<Added::Area>(points, first, OnALine::KeepFirst, options);
};

/// Both directions along two axes of the plane.
template <class S> std::array<Vec3<S>, 4> directions_in_plane(const Vec3<S>& normal) {
  const Vec3<S> u = any_perpendicular(normal);
  const Vec3<S> v = normal.cross(u);
  return {-u, u, -v, v};
}

/// The alternative of Gregorius 2015, "Contact Point Reduction: AABB (1)" to "(3)": the extreme
/// points along two axes in the contact plane. The axes follow the world's: a diamond on its corner
/// loses two of four points when its long diagonal is at 45 degrees to them. Steps: an orthonormal
/// basis (u, v) of the plane from the world axis least aligned with the normal; lowest and highest
/// along u, then along v, each once.
constexpr auto reduce_to_extremes = []<class S>(const Candidates<S>& points,
                                                const ReduceOptions& options) {
  const std::array<Vec3<S>, 4> directions = directions_in_plane(points.normal);
  KeptIndices kept;
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const int extreme = points.farthest_along(directions[k]);
    if (steps::contains(kept, extreme)) continue;
    kept.push_back(extreme);
    if (options.choices != nullptr && count_of(kept) <= options.max_points) [[unlikely]]
      options.choices->support(directions_in_plane(options.choices->points.normal)[k]);
  }
  return steps::first_of(kept, options);
};

}  // namespace

std::vector<ReducerInfo> area_reducers() {
  return {listed("area",
                 "a support point, the farthest, the largest triangle, the most area outside it",
                 reduce_from_support<Added::Area>),
          listed("area_deepest", "as area, but the deepest first", reduce_by_area_from_deepest),
          listed("distance", "as area, but the fourth is farthest from an edge",
                 reduce_from_support<Added::Distance>)};
}

std::vector<ReducerInfo> extremes_reducers() {
  return {listed("extremes", "extremes along two axes of the plane", reduce_to_extremes)};
}

}  // namespace contactscope
