#pragma once

#include "core/vec3.h"

namespace contactscope {

/// Geometric predicates with exact signs, after Shewchuk 1997, "Adaptive Precision Floating-Point
/// Arithmetic and Fast Robust Geometric Predicates": each evaluates its determinant in double with
/// a rounding bound (section 4.3, filter A), and exactly if that does not settle the sign.
///
/// Deviations: between the two we try 128-bit integers, exact and ten times faster, if all
/// coordinates of a call share a grid of at most 41 bits, as floats of similar size and points on a
/// plane do. Shewchuk's stages B and C are left out.
///
/// Valid for coordinates that are 0 or of magnitude 1e-75 to 1e100, so that no product overflows or
/// loses bits, and for every finite float, subnormals included.
namespace predicates {

/// Relative rounding error of a sum or product of doubles is at most half of this.
inline constexpr double kUnit = 0x1p-52;

/// Error bounds of Shewchuk's filters: (3 + 16 u) u and (7 + 56 u) u with u = kUnit / 2, times the
/// permanent: the determinant with the absolute value of every product. Rounded up to powers of
/// two, which also covers the rounding of the bound itself.
inline constexpr double kOrient2dError = 2 * kUnit;
inline constexpr double kOrient3dError = 4 * kUnit;

/// The determinants, correct up to a few roundings and in sign. Hundreds of nanoseconds at worst.
double exact_orient2d(const Vec3d& a, const Vec3d& b, const Vec3d& c, int axis);
double exact_orient3d(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d);

inline int sign_of(double value) { return (value > 0) - (value < 0); }

/// Result of a filter.
struct Filtered {
  double value;  // as rounded
  double error;  // |value - exact| is at most this
  bool certain() const { return std::abs(value) > error; }
};

/// The plane of a triangle with the terms of its filter, to be used for many points.
struct Plane {
  Plane(const Vec3d& a, const Vec3d& b, const Vec3d& c) : origin(a) {
    const double ux = b.x() - a.x(), uy = b.y() - a.y(), uz = b.z() - a.z();
    const double vx = c.x() - a.x(), vy = c.y() - a.y(), vz = c.z() - a.z();
    const double yz = uy * vz, zy = uz * vy;
    const double zx = uz * vx, xz = ux * vz;
    const double xy = ux * vy, yx = uy * vx;
    normal = {yz - zy, zx - xz, xy - yx};
    most = {std::abs(yz) + std::abs(zy), std::abs(zx) + std::abs(xz), std::abs(xy) + std::abs(yx)};
  }

  Filtered filtered(const Vec3d& point) const {
    const double x = point.x() - origin.x(), y = point.y() - origin.y(), z = point.z() - origin.z();
    const double value = x * normal.x() + y * normal.y() + z * normal.z();
    const double permanent =
        std::abs(x) * most.x() + std::abs(y) * most.y() + std::abs(z) * most.z();
    return {value, kOrient3dError * permanent};
  }

  Vec3d origin;
  Vec3d normal;  // (b - a) x (c - a), rounded
  Vec3d most;    // the same with the absolute value of every product
};

}  // namespace predicates

/// Side of the plane through a, b, c on which d lies: 1 if a, b, c run counter-clockwise seen from
/// d, -1 on the other side, 0 in the plane or if a, b, c are collinear. It is the sign of
/// (b - a) x (c - a) . (d - a).
inline int orient3d(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
  const predicates::Filtered filtered = predicates::Plane(a, b, c).filtered(d);
  if (filtered.certain()) return predicates::sign_of(filtered.value);
  return predicates::sign_of(predicates::exact_orient3d(a, b, c, d));
}

/// Orientation of a, b, c seen along coordinate axis `axis` from its positive end: 1
/// counter-clockwise, -1 clockwise, 0 collinear. The sign of component `axis` of (b - a) x (c - a).
/// Axis 2 gives the usual predicate in the x-y plane.
inline int orient2d(const Vec3d& a, const Vec3d& b, const Vec3d& c, int axis) {
  const int x = axis == 2 ? 0 : axis + 1, y = axis == 0 ? 2 : axis == 1 ? 0 : 1;
  const double left = (b[x] - a[x]) * (c[y] - a[y]);
  const double right = (b[y] - a[y]) * (c[x] - a[x]);
  const double value = left - right;
  const double error = predicates::kOrient2dError * (std::abs(left) + std::abs(right));
  if (std::abs(value) > error) return predicates::sign_of(value);
  return predicates::sign_of(predicates::exact_orient2d(a, b, c, axis));
}

/// The determinant behind orient3d (cubic metres) with a relative error of at most 2^-32, so that
/// ratios of distances from a plane are reliable; 0 only if it is exactly 0.
inline double orient3d_value(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
  const predicates::Filtered filtered = predicates::Plane(a, b, c).filtered(d);
  if (std::abs(filtered.value) > 0x1p33 * filtered.error) return filtered.value;
  return predicates::exact_orient3d(a, b, c, d);
}

/// Area vector of a triangle: length twice the area, pointing to the side from which the corners
/// run counter-clockwise. The error is a few roundings of its own length, however thin the triangle
/// is. It is the cross product of the two shorter sides, because the difference of two long sides
/// loses a short one to rounding. For needles it is computed exactly.
inline Vec3d doubled_area(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  constexpr double kNeedle = 1e-3;  // sine of the angle between the two shorter sides
  const Vec3d ab = b - a, bc = c - b, ca = a - c;
  const double most = std::max({ab.squaredNorm(), bc.squaredNorm(), ca.squaredNorm()});
  // The two shorter sides, in the order of the corners.
  const Vec3d& one = ab.squaredNorm() == most ? bc : bc.squaredNorm() == most ? ca : ab;
  const Vec3d& other = ab.squaredNorm() == most ? ca : bc.squaredNorm() == most ? ab : bc;
  const Vec3d area = one.cross(other);
  if (area.squaredNorm() > kNeedle * kNeedle * one.squaredNorm() * other.squaredNorm()) return area;
  using predicates::exact_orient2d;
  return {exact_orient2d(a, b, c, 0), exact_orient2d(a, b, c, 1), exact_orient2d(a, b, c, 2)};
}

/// Newell's area vector of a polygon, of length twice the area. All corners contribute, so three
/// that are nearly on a line do not decide alone. `point(i)` returns one of the `count` corners.
template <class Point> Vec3d doubled_area(int count, const Point& point) {
  Vec3d area = Vec3d::Zero();
  for (int i = 2; i < count; ++i) area += doubled_area(point(0), point(i - 1), point(i));
  return area;
}

}  // namespace contactscope
