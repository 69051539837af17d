#include "query/gjk.h"

#include "query/penetration_bounds.h"

namespace contactscope {
namespace {

/// Maximum number of steps that do not bring the simplex closer although the support point promised
/// it to first order. More of them are rounding cycles.
constexpr int kMaxGjkStalls = 3;

/// Current simplex: only the points that carry its point closest to the origin.
template <class S> struct Simplex {
  std::array<IndexPair, 4> pairs;
  std::array<Vec3<S>, 4> points;  // in units
  NearestOnSimplex<S> nearest;

  bool has(const IndexPair& pair) const {
    for (int i = 0; i < nearest.count; ++i)
      if (at(pairs, i) == pair) return true;
    return false;
  }
  /// Smallest product of the simplex's points with a direction.
  S least_along(const Vec3<S>& direction) const {
    S least = std::numeric_limits<S>::infinity();
    for (int i = 0; i < nearest.count; ++i) least = std::min(least, direction.dot(at(points, i)));
    return least;
  }
};

template <class S>
Simplex<S> first_simplex(const IndexPair& pair, const MinkowskiDifference<S>& difference) {
  Simplex<S> simplex;
  simplex.pairs[0] = pair;
  simplex.points[0] = difference.point(pair);
  nearest_on_simplex(simplex.points, 1, difference.scale(), simplex.nearest);
  return simplex;
}

/// Adds a point to the simplex and reduces it to the face that carries the point closest to the
/// origin. `simplex` has at most three points; its next slot is overwritten.
template <class S>
void grow(Simplex<S>& simplex, const IndexPair& pair, const Vec3<S>& point, S scale,
          Simplex<S>& grown) {
  at(simplex.pairs, simplex.nearest.count) = pair;
  at(simplex.points, simplex.nearest.count) = point;
  nearest_on_simplex(simplex.points, simplex.nearest.count + 1, scale, grown.nearest);
  for (int i = 0; i < grown.nearest.count; ++i) {
    const int from = at(grown.nearest.kept, i);
    at(grown.pairs, i) = at(simplex.pairs, from);
    at(grown.points, i) = at(simplex.points, from);
  }
}

/// Rebuilds the simplex of an earlier call, with the points at their current positions.
template <class S>
Simplex<S> warm_simplex(const GjkSimplex<S>& earlier, const MinkowskiDifference<S>& difference) {
  Simplex<S> simplex = first_simplex(
      IndexPair{earlier.vertices[0].index_a, earlier.vertices[0].index_b}, difference);
  for (std::size_t i = 1; i < earlier.vertices.size() && simplex.nearest.count < 4; ++i) {
    const IndexPair pair{earlier.vertices[i].index_a, earlier.vertices[i].index_b};
    Simplex<S> next;
    grow(simplex, pair, difference.point(pair), difference.scale(), next);
    if (next.nearest.squared_distance < simplex.nearest.squared_distance) simplex = next;
  }
  return simplex;
}

template <class S>
GjkSimplex<S> to_result(const Simplex<S>& simplex, const MinkowskiDifference<S>& difference) {
  return difference.simplex(simplex.pairs, simplex.nearest.weights, simplex.nearest.count);
}

template <class S>
GjkResult<S> finish(GjkStatus status, int iterations, const Simplex<S>& simplex,
                    const MinkowskiDifference<S>& difference, GjkRun<S>* run) {
  GjkResult<S> result;
  result.status = status;
  result.iterations = iterations;
  result.simplex = to_result(simplex, difference);
  result.on_a = weighted(result.simplex, &GjkVertex<S>::a);
  result.on_b = weighted(result.simplex, &GjkVertex<S>::b);
  if (status != GjkStatus::Overlap)
    result.distance = difference.unit() * std::sqrt(simplex.nearest.squared_distance);
  const S length = simplex.nearest.direction.norm();
  if (length > S(0)) result.normal = simplex.nearest.direction / length;
  if (run != nullptr) [[unlikely]]
    run->result = result;
  return result;
}

/// True if a point, edge or triangle of the difference that contains the origin is inside the
/// difference by more than rounding, not on its boundary. Example: two overlapping prisms seen
/// along their edges, where all support points that GJK finds are in one plane with the origin. The
/// ray from the centre of the difference through the origin then leaves it farther out, and a
/// support plane there is farther from the origin than the boundary.
template <class S>
bool holds_origin_inside(const SupportSet<S>& a, const SupportSet<S>& b, const Pose<S>& b_in_a) {
  const PenetrationResult<S> left = mpr<S>(a, b, b_in_a, {}, nullptr);
  const bool has_volume = has_depth(left.status) && left.status != PenetrationStatus::Flat;
  return has_volume &&
         left.depth > clip_thickness(reach_of(a) + reach_of(b) + b_in_a.position.norm());
}

}  // namespace

/// Gilbert, Johnson and Keerthi, "A Fast Procedure for Computing the Distance Between Complex
/// Objects in Three-Dimensional Space", 1988; termination after van den Bergen, "A Fast and Robust
/// GJK Implementation for Collision Detection of Convex Objects", 1999.
///
/// Deviations. Termination: that test stops when the bounds of the distance agree within rounding.
/// The distance is second order in the closest points, so these would be correct only to the square
/// root of that. The bounds' difference along the search direction is first order, and we stop when
/// it is a rounding of the pair's scale: usually when the support point is already in the simplex,
/// so that the simplex is a face of the difference. Direction: near the origin we search along a
/// triangle's normal, because all digits of its closest point cancel. Simplex: see simplex.cpp.
///
/// Steps: 1. start with one support point, or the earlier simplex; 2. find its point closest to the
/// origin, and the face that carries it; 3. stop if the origin is inside (overlap) or within
/// rounding of that face (overlap if the face is inside the difference, otherwise touching); 4.
/// find the support point of the difference against that direction; 5. stop if it is no farther
/// than the simplex (separated); 6. add it and go to 2.
template <class S>
GjkResult<S> gjk(const SupportSet<S>& a, const SupportSet<S>& b, const Pose<S>& b_in_a,
                 const GjkSimplex<S>* warm_start, GjkRun<S>* run) {
  const MinkowskiDifference<S> difference(a, b, b_in_a);
  const S rounding = tie_tolerance(difference.scale());

  Simplex<S> buffers[2];
  Simplex<S>* simplex = &buffers[0];
  Simplex<S>* next = &buffers[1];
  *simplex =
      difference.has(warm_start)
          ? warm_simplex(*warm_start, difference)
          : first_simplex(difference.support_against(difference.between_middles()), difference);
  const auto ended = [&](GjkStatus status, int iterations) {
    return finish(status, iterations, *simplex, difference, run);
  };
  int stalls = 0;
  for (int iteration = 1; iteration < kMaxGjkIterations; ++iteration) {
    if (run != nullptr) [[unlikely]]
      run->steps.push_back(to_result(*simplex, difference));
    const NearestOnSimplex<S>& nearest = simplex->nearest;
    if (nearest.count == 4) return ended(GjkStatus::Overlap, iteration);
    if (nearest.squared_distance <= rounding * rounding) {
      const bool is_inside = holds_origin_inside(a, b, b_in_a);
      return ended(is_inside ? GjkStatus::Overlap : GjkStatus::Touching, iteration);
    }

    const IndexPair support = difference.support_against(nearest.direction);
    if (simplex->has(support)) return ended(GjkStatus::Separated, iteration);
    const Vec3<S> point = difference.point(support);
    const S gain = simplex->least_along(nearest.direction) - nearest.direction.dot(point);
    const bool is_farther =
        gain > S(0) && gain * gain > rounding * rounding * nearest.direction.squaredNorm();
    if (!is_farther) return ended(GjkStatus::Separated, iteration);

    grow(*simplex, support, point, difference.scale(), *next);
    if (!(next->nearest.squared_distance < nearest.squared_distance)) {
      const S farther = std::sqrt(next->nearest.squared_distance);
      const bool is_worse = farther > std::sqrt(nearest.squared_distance) + rounding;
      if (is_worse || ++stalls > kMaxGjkStalls) return ended(GjkStatus::Separated, iteration);
    }
    std::swap(simplex, next);
  }
  return ended(GjkStatus::OutOfIterations, kMaxGjkIterations);
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(gjk);

}  // namespace contactscope
