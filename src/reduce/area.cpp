#include "reduce/area.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace contactscope {
namespace {

template <class S>
using Points = std::span<const ContactPoint<S>>;

template <class S>
const Vec3<S>& at(Points<S> points, int i) {
  return points[static_cast<std::size_t>(i)].position;
}

/// The fixed direction of the first step, laid into the contact plane. It leans on no coordinate
/// axis, because boxes and floors do, and two corners of an aligned box would be equally far along
/// an axis: rounding would then choose between them anew in every frame.
template <class S>
Vec3<S> fixed_direction(const Vec3<S>& normal) {
  const Vec3<S> one(S(0.76), S(0.31), S(0.57));
  const Vec3<S> two(S(-0.57), S(0.76), S(0.31));
  // The steeper one would have a short projection, and swing with the smallest change of normal.
  const Vec3<S>& chosen = std::abs(normal.dot(one)) <= S(0.9) ? one : two;
  return chosen - normal.dot(chosen) * normal;
}

template <class S>
int support_point(Points<S> points, const Vec3<S>& direction) {
  int best = 0;
  S most = -std::numeric_limits<S>::infinity();
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    // Relative to the first point, so that a place far from the origin costs no digits.
    const S along = direction.dot(Vec3<S>(at(points, i) - at(points, 0)));
    if (along > most) {
      most = along;
      best = i;
    }
  }
  return best;
}

template <class S>
int farthest_from(Points<S> points, int from) {
  int best = from;
  S most = S(0);
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    const S distance = (at(points, i) - at(points, from)).squaredNorm();
    if (distance > most) {
      most = distance;
      best = i;
    }
  }
  return best;
}

/// Twice the signed area of the triangle q, a, b; counter-clockwise seen against `normal` is
/// positive. The talk's 0.5 (QA x QB) . n without the factor.
template <class S>
S doubled_area(const Vec3<S>& q, const Vec3<S>& a, const Vec3<S>& b, const Vec3<S>& normal) {
  const Vec3<S> qa = a - q;
  const Vec3<S> qb = b - q;
  return qa.cross(qb).dot(normal);
}

/// The polygon kept so far, counter-clockwise, as indices into the points.
using Ring = StaticVector<int, kMaxManifoldPoints>;

void insert(Ring& ring, std::size_t position, int index) {
  ring.push_back(index);
  std::rotate(ring.begin() + position, ring.end() - 1, ring.end());
}

/// The point outside the ring that adds the largest area, and the edge that it goes behind.
struct Addition {
  int index = -1;  // -1: no point is outside
  std::size_t after = 0;
};

template <class S>
Addition largest_addition(Points<S> points, const Vec3<S>& normal, const Ring& ring, S negligible) {
  Addition best;
  S most_negative = -negligible;
  for (int q = 0; q < static_cast<int>(points.size()); ++q) {
    if (std::find(ring.begin(), ring.end(), q) != ring.end()) continue;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const int a = ring[k];
      const int b = ring[(k + 1) % ring.size()];
      const S area = doubled_area(at(points, q), at(points, a), at(points, b), normal);
      if (area < most_negative) {
        most_negative = area;
        best = {q, k};
      }
    }
  }
  return best;
}

}  // namespace

/// Gregorius 2015, "Contact Point Reduction: 1st Point" to "4th Point (5)". Deviations: the third
/// point maximises the absolute area, so that winding does not hide half of the points, and fixes
/// the winding of the triangle; areas within rounding of zero count as zero; when all points lie on
/// one line the first is exchanged for the other extreme, because the support point may lie
/// between.
template <class S>
KeptIndices reduce_by_area(std::span<const ContactPoint<S>> points, const Vec3<S>& normal,
                           const ReduceOptions& options) {
  KeptIndices kept;
  const int count = static_cast<int>(points.size());
  const int max_points = options.max_points;
  const int first = support_point(points, fixed_direction(normal));
  kept.push_back(first);
  if (max_points == 1) return kept;

  const int second = farthest_from(points, first);
  if (second == first) return kept;  // all coincide
  kept.push_back(second);

  // A coordinate carries an error of half an ulp of its own size, so a difference of two of them
  // does too however small it is itself, and an area that error times the length of the edge.
  const S length = (at(points, second) - at(points, first)).norm();
  const S coordinate = at(points, first).cwiseAbs().maxCoeff() + length;
  const S negligible = S(8) * std::numeric_limits<S>::epsilon() * coordinate * length;

  int third = -1;
  S largest = negligible;
  S winding = S(0);
  for (int q = 0; q < count; ++q) {
    const S area = doubled_area(at(points, q), at(points, first), at(points, second), normal);
    if (std::abs(area) > largest) {
      largest = std::abs(area);
      winding = area;
      third = q;
    }
  }
  if (third < 0) {  // all on one line
    kept[0] = farthest_from(points, second);
    return kept;
  }
  if (max_points == 2) return kept;
  kept.push_back(third);

  Ring ring;
  ring.push_back(third);
  ring.push_back(winding > S(0) ? first : second);
  ring.push_back(winding > S(0) ? second : first);
  while (static_cast<int>(kept.size()) < max_points) {
    const Addition next = largest_addition(points, normal, ring, negligible);
    if (next.index < 0) break;
    kept.push_back(next.index);
    insert(ring, next.after + 1, next.index);
  }
  return kept;
}

template KeptIndices reduce_by_area(std::span<const ContactPoint<float>>, const Vec3<float>&,
                                    const ReduceOptions&);
template KeptIndices reduce_by_area(std::span<const ContactPoint<double>>, const Vec3<double>&,
                                    const ReduceOptions&);

}  // namespace contactscope
