#include "support/exact_triangles.h"

#include <cmath>

#include "support/exact_integer.h"

namespace contactscope::test {
namespace {

using Exact3 = std::array<ExactInteger, 3>;

Exact3 minus(const Exact3& a, const Exact3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
ExactInteger inner(const Exact3& a, const Exact3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Exact3 outer(const Exact3& a, const Exact3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
bool is_zero(const Exact3& a) { return a[0].sign() == 0 && a[1].sign() == 0 && a[2].sign() == 0; }

/// The point numerator / denominator, denominator > 0.
struct Rational3 {
  Exact3 numerator;
  ExactInteger denominator = 1;
};

/// normal . x >= normal . origin, or = with `equal`.
struct Bound {
  Exact3 normal;
  ExactInteger offset;
  bool equal;

  ExactInteger value(const Rational3& point) const {
    return inner(normal, point.numerator) - offset * point.denominator;
  }
};
Bound bound(const Exact3& normal, const Exact3& origin, bool equal) {
  return {normal, inner(normal, origin), equal};
}

struct Solid {
  std::array<Exact3, 3> corners;
  Exact3 normal;
  bool flat() const { return is_zero(normal); }
};

/// The planes whose intersection is the closed triangle, even if it is a segment or a point.
std::vector<Bound> bounds_of(const Solid& t) {
  std::vector<Bound> bounds;
  if (!t.flat()) {
    bounds.push_back(bound(t.normal, t.corners[0], true));
    for (std::size_t k = 0; k < 3; ++k) {
      const Exact3 edge = minus(t.corners[(k + 1) % 3], t.corners[k]);
      bounds.push_back(bound(outer(t.normal, edge), t.corners[k], false));
    }
    return bounds;
  }
  // The longest of three collinear edges has the third corner between its ends.
  Exact3 from = t.corners[0], along = minus(t.corners[1], t.corners[0]);
  for (std::size_t k = 1; k < 3; ++k) {
    const Exact3 edge = minus(t.corners[(k + 1) % 3], t.corners[k]);
    if ((inner(edge, edge) - inner(along, along)).sign() > 0) {
      from = t.corners[k];
      along = edge;
    }
  }
  const Exact3 to = minus(from, minus({0, 0, 0}, along));
  for (std::size_t k = 0; k < 3; ++k) {
    Exact3 axis{0, 0, 0};
    axis[k] = 1;
    bounds.push_back(bound(is_zero(along) ? axis : outer(along, axis), from, true));
  }
  bounds.push_back(bound(along, from, false));
  bounds.push_back(bound(minus({0, 0, 0}, along), to, false));
  return bounds;
}

/// Clips a convex polygon, segment or point by a bound.
std::vector<Rational3> clipped(const std::vector<Rational3>& polygon, const Bound& bound) {
  std::vector<Rational3> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Rational3& from = polygon[i];
    const Rational3& to = polygon[(i + 1) % polygon.size()];
    const ExactInteger of_from = bound.value(from), of_to = bound.value(to);
    if (of_from.sign() == 0 || (!bound.equal && of_from.sign() > 0)) kept.push_back(from);
    if (of_from.sign() * of_to.sign() >= 0) continue;
    // from * |of_to| + to * |of_from|; the denominators enter the weights.
    const ExactInteger left = of_to.sign() > 0 ? of_to : -of_to;
    const ExactInteger right = of_from.sign() > 0 ? of_from : -of_from;
    Rational3 point;
    for (std::size_t k = 0; k < 3; ++k)
      point.numerator[k] = from.numerator[k] * left + to.numerator[k] * right;
    point.denominator = from.denominator * left + to.denominator * right;
    kept.push_back(point);
  }
  return kept;
}

/// A point in the relative interior of a convex polygon: the mean of its corners.
Rational3 middle(const std::vector<Rational3>& polygon) {
  Rational3 sum{{0, 0, 0}, 1};
  for (const Rational3& point : polygon) {
    for (std::size_t k = 0; k < 3; ++k)
      sum.numerator[k] =
          sum.numerator[k] * point.denominator + point.numerator[k] * sum.denominator;
    sum.denominator = sum.denominator * point.denominator;
  }
  sum.denominator = sum.denominator * static_cast<std::int64_t>(polygon.size());
  return sum;
}

bool strictly_inside(const Rational3& point, const Solid& t) {
  for (const Bound& bound : bounds_of(t))
    if (!bound.equal && bound.value(point).sign() <= 0) return false;
  return true;
}

}  // namespace

std::array<Vec3d, 2> ExactOverlap::ends() const {
  std::array<Vec3d, 2> farthest{corners.front(), corners.front()};
  for (const Vec3d& a : corners)
    for (const Vec3d& b : corners)
      if ((a - b).norm() > (farthest[0] - farthest[1]).norm()) farthest = {a, b};
  return farthest;
}

ExactOverlap exact_triangle_overlap(const Triangle<double>& a, const Triangle<double>& b) {
  using enum TriangleOverlapKind;
  std::vector<double> numbers;
  for (const Triangle<double>& t : {a, b})
    for (const Vec3d& corner : t) numbers.insert(numbers.end(), corner.begin(), corner.end());
  const int exponent = common_exponent(numbers);
  const auto solid = [&](const Triangle<double>& t) {
    Solid s;
    for (std::size_t k = 0; k < 3; ++k)
      for (int axis = 0; axis < 3; ++axis)
        s.corners[k][static_cast<std::size_t>(axis)] = ExactInteger::of(t[k][axis], exponent);
    s.normal = outer(minus(s.corners[1], s.corners[0]), minus(s.corners[2], s.corners[0]));
    return s;
  };
  const Solid solid_a = solid(a), solid_b = solid(b);
  std::vector<Rational3> shared;
  for (const Exact3& corner : solid_a.corners) shared.push_back({corner, 1});
  for (const Bound& bound : bounds_of(solid_b)) shared = clipped(shared, bound);

  ExactOverlap result;
  if (shared.empty()) return result;
  for (const Rational3& point : shared) {
    Vec3d& corner = result.corners.emplace_back();
    for (int k = 0; k < 3; ++k) {
      corner[k] = std::ldexp(
          ExactInteger::ratio(point.numerator[static_cast<std::size_t>(k)], point.denominator),
          exponent);
    }
  }
  result.kind = Touching;
  if (solid_a.flat() || solid_b.flat()) return result;
  const Rational3 inside = middle(shared);
  if (!strictly_inside(inside, solid_a) || !strictly_inside(inside, solid_b)) return result;
  result.kind = is_zero(outer(solid_a.normal, solid_b.normal)) ? Coplanar : Proper;
  return result;
}

}  // namespace contactscope::test
