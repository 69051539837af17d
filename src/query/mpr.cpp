#include "query/penetration_bounds.h"

namespace contactscope {
namespace {

/// The inner point, the ray from it through the origin, and the portal: a triangle of points of the
/// difference that the ray passes through, counter-clockwise seen from outside.
template <class S> struct Portal {
  Portal(const SupportSet<S>& a, const SupportSet<S>& b, const Pose<S>& b_in_a,
         BoundedDifference<S>& difference)
      : inner_vertex{-1, -1, middle_of(a), b_in_a.transform(middle_of(b))},
        inner((inner_vertex.b - inner_vertex.a) / difference.unit()) {
    const S length = inner.norm();
    if (length > difference.rounding()) {
      ray = -inner / length;
    } else {
      // Concentric: any ray works. Use the axis direction with the closest support point.
      S least = std::numeric_limits<S>::infinity();
      for (const S sign : {S(1), S(-1)}) {
        for (int axis = 0; axis < 3; ++axis) {
          const Vec3<S> unit = sign * Vec3<S>::Unit(axis);
          const S along = unit.dot(difference.support(unit).point);
          if (along < least) least = along, ray = unit;
        }
      }
    }
  }

  DifferencePoint<S>& operator[](int i) { return at(points, i); }
  /// Relative to the inner point.
  Vec3<S> from_inner(const DifferencePoint<S>& point) const { return point.point - inner; }
  Vec3<S> from_inner(int i) const { return from_inner(at(points, i)); }
  /// Sign: side of the plane through the inner point and two others on which the ray passes.
  S side(const Vec3<S>& one, const Vec3<S>& other) const { return ray.dot(one.cross(other)); }
  S side(int i, int j) const { return side(from_inner(i), from_inner(j)); }

  /// Outward, any length; zero if the portal has no area.
  Vec3<S> normal() const {
    S longest = S(0);
    const Vec3<S> cross =
        triangle_normal(points[0].point, points[1].point, points[2].point, longest);
    return cross.dot(ray) < S(0) ? Vec3<S>(-cross) : cross;
  }
  /// Sets the corners' barycentric weights of the point where the ray passes.
  void weigh(WeightedPairs<S>& weights) const {
    const S sides[3] = {std::max(side(1, 2), S(0)), std::max(side(2, 0), S(0)),
                        std::max(side(0, 1), S(0))};
    const S sum = sides[0] + sides[1] + sides[2];
    if (!(sum > S(0))) return;  // keep the last support point
    weights.count = 0;
    for (std::size_t i = 0; i < 3; ++i) weights.add(points[i].pair, sides[i] / sum);
  }
  bool has(const IndexPair& pair) const {
    return std::ranges::find(points, pair, &DifferencePoint<S>::pair) != points.end();
  }

  GjkVertex<S> inner_vertex;
  Vec3<S> inner;
  Vec3<S> ray = Vec3<S>::UnitX();  // unit
  std::array<DifferencePoint<S>, 3> points;
};

/// Searches the first portal; returns nothing on success. Flat: the last direction is across the
/// difference. Converged: the ray leaves through a vertex. OutOfIterations: no steps left.
template <class S>
std::optional<PenetrationStatus> discover(Portal<S>& portal, BoundedDifference<S>& difference,
                                          int allowed, int& iterations) {
  const S thin = S(2) * difference.rounding();
  const auto measure = [&](const Vec3<S>& outward, int place) {
    ++iterations;
    difference.measure(outward, portal[place]);
    return outward.dot(portal.from_inner(place));
  };
  measure(portal.ray, 0);
  if (difference.is_separated()) return PenetrationStatus::Converged;

  Vec3<S> across = portal.from_inner(0).cross(portal.ray);
  S length = across.norm();
  if (length <= thin) return PenetrationStatus::Converged;
  if (measure(across / length, 1) <= thin) return PenetrationStatus::Flat;
  if (difference.is_separated()) return PenetrationStatus::Converged;

  while (iterations < allowed) {
    if (portal.side(0, 1) < S(0)) std::swap(portal[0], portal[1]);
    across = portal.from_inner(0).cross(portal.from_inner(1));
    length = across.norm();
    if (!(length > S(0))) return PenetrationStatus::Converged;
    if (measure(across / length, 2) <= thin) return PenetrationStatus::Flat;
    if (difference.is_separated()) return PenetrationStatus::Converged;
    if (portal.side(2, 0) < S(0)) {
      portal[1] = portal[2];
    } else if (portal.side(1, 2) < S(0)) {
      portal[0] = portal[2];
    } else {
      return std::nullopt;
    }
  }
  return PenetrationStatus::OutOfIterations;
}

}  // namespace

/// Snethen, "XenoCollide: Complex Collision Made Simple", Game Programming Gems 7, 2008.
///
/// Deviations. Tests use a ray with a direction of its own; the original uses the side of the
/// origin. Both are the same unless the centres coincide. The depth is measured by a support point
/// along the last portal's normal; the original only reports that the shapes touch.
///
/// Steps: 1. compute an inner point of the difference from the centres, and the ray from it through
/// the origin; 2. find support points until the ray passes a triangle of three, the portal; 3. find
/// the support point along the portal's normal; 4. stop if it is not beyond the portal, which is
/// then part of the surface; 5. otherwise it makes three portals with the sides: take the one that
/// the ray passes; go to 3. Stop as separated if the origin is beyond a support plane.
template <class S>
PenetrationResult<S> mpr(const SupportSet<S>& a, const SupportSet<S>& b, const Pose<S>& b_in_a,
                         const PenetrationOptions<S>& options, PenetrationSteps<S>* steps) {
  BoundedDifference<S> difference(a, b, b_in_a);
  if (!difference.is_finite()) return {};
  Portal<S> portal(a, b, b_in_a, difference);
  const S tolerance = difference.tolerance(options);
  const int allowed = allowed_iterations(options, kMaxMprIterations);

  int iterations = 0;
  const std::optional<PenetrationStatus> ended = discover(portal, difference, allowed, iterations);
  PenetrationStatus status = ended.value_or(PenetrationStatus::OutOfIterations);
  while (!ended && iterations < allowed) {
    ++iterations;
    if (steps != nullptr) {
      const auto vertex = [&](int i) { return difference.vertex(portal[i].pair); };
      steps->portals.push_back({portal.inner_vertex, vertex(0), vertex(1), vertex(2)});
    }
    const Vec3<S> normal = portal.normal();
    const S length = normal.norm();
    if (!(length > S(0))) {
      status = PenetrationStatus::Stalled;
      break;
    }
    const Vec3<S> outward = normal / length;
    DifferencePoint<S> support;
    difference.measure(outward, support);
    portal.weigh(difference.weights());
    if (!difference.is_finite() || difference.is_separated()) break;
    if (outward.dot(support.point - portal[0].point) <= tolerance) {
      status = PenetrationStatus::Converged;
      break;
    }
    if (portal.has(support.pair)) {
      status = PenetrationStatus::Stalled;
      break;
    }
    S sides[3];
    for (int i = 0; i < 3; ++i)
      sides[i] = portal.side(portal.from_inner(i), portal.from_inner(support));
    const bool first = sides[0] <= S(0) && sides[1] >= S(0);
    const bool second = !first && sides[1] <= S(0) && sides[2] >= S(0);
    portal[first ? 2 : second ? 0 : 1] = support;
  }
  if (difference.is_separated()) status = PenetrationStatus::Separated;
  return difference.result(status, S(0), iterations);
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(mpr);

}  // namespace contactscope
