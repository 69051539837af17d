#include "continuous/contact_root.h"

namespace contactscope {
namespace {

/// The equation of contact and its derivatives by time, u and v.
class ContactEquation {
 public:
  template <int kCorners>
  explicit ContactEquation(const MovingPolygon<kCorners>& polygon) {
    const auto& [from, to] = polygon;
    constexpr int kLast = MovingPolygon<kCorners>::kLast;
    corner_ = from[0];
    side_u_ = from[1] - from[0];
    side_v_ = from[kLast] - from[0];
    corner_motion_ = to[0] - from[0];
    u_motion_ = (to[1] - to[0]) - side_u_;
    v_motion_ = (to[kLast] - to[0]) - side_v_;
    // Each term above is less than four times the size, and its error is at most four roundings of
    // that. A value or a derivative has nine of them.
    rounding_ = 0x1p-45 * polygon.size();
  }

  /// `x` is time, u, v, in the order of the derivative's columns.
  Vec3d value(const Vec3d& x) const {
    return (corner_ + x[0] * corner_motion_) + x[1] * (side_u_ + x[0] * u_motion_) +
           x[2] * (side_v_ + x[0] * v_motion_);
  }
  Mat3<double> derivative(const Vec3d& x) const {
    Mat3<double> result;
    result.col(0) = corner_motion_ + x[1] * u_motion_ + x[2] * v_motion_;
    result.col(1) = side_u_ + x[0] * u_motion_;
    result.col(2) = side_v_ + x[0] * v_motion_;
    return result;
  }
  /// Largest deviation of the derivative from its value in the middle of a box of half widths `r`.
  Mat3<double> change(const Vec3d& r) const {
    Mat3<double> result;
    result.col(0) = r[1] * u_motion_.cwiseAbs() + r[2] * v_motion_.cwiseAbs();
    result.col(1) = r[0] * u_motion_.cwiseAbs();
    result.col(2) = r[0] * v_motion_.cwiseAbs();
    return result;
  }
  /// Error bound of each coordinate of a value and each entry of a derivative.
  double rounding() const { return rounding_; }

 private:
  Vec3d corner_, side_u_, side_v_;             // at time 0
  Vec3d corner_motion_, u_motion_, v_motion_;  // in the step
  double rounding_;
};

}  // namespace

template <int kCorners>
std::optional<ContactRoot> prove_contact(const MovingPolygon<kCorners>& polygon, double time,
                                         double u, double v) {
  constexpr int kNewtonSteps = 3;
  constexpr double kUp = 1 + 0x1p-40;  // covers the rounding of the map's bounds below
  const ContactEquation equation(polygon);
  Vec3d x(time, u, v);
  Mat3<double> inverse;
  for (int i = 0; i <= kNewtonSteps; ++i) {
    bool has_inverse = false;
    double determinant;
    equation.derivative(x).computeInverseAndDetWithCheck(inverse, determinant, has_inverse, 0);
    if (!has_inverse || !inverse.allFinite()) return std::nullopt;
    if (i < kNewtonSteps) x -= inverse * equation.value(x);
  }
  const Mat3<double> most_inverse = inverse.cwiseAbs();
  const Vec3d rounding = Vec3d::Constant(equation.rounding());
  // Distance by which the map moves the middle; the box has twice that size.
  const Vec3d shift = (inverse * equation.value(x)).cwiseAbs() + 2 * (most_inverse * rounding);
  const Vec3d half = 2 * shift;
  // Derivative of the map: identity minus the inverse times the derivative anywhere in the box.
  const Mat3<double> middle = equation.derivative(x);
  const Mat3<double> unity = Mat3<double>::Identity();
  const Mat3<double> slope =
      (unity - inverse * middle).cwiseAbs() +
      most_inverse * (equation.change(half).array() + 2 * equation.rounding()).matrix() +
      0x1p-50 * (most_inverse * middle.cwiseAbs());
  const Vec3d reach = kUp * (shift + slope * half);
  if (!(reach.array() < half.array()).all()) return std::nullopt;
  const Vec3d least = x - kUp * half, most = x + kUp * half;
  if (!(least.array() > 0).all() || !(most.array() < 1).all()) return std::nullopt;
  if (kCorners == 3 && !(most[1] + most[2] < 1 - 0x1p-50)) return std::nullopt;
  return ContactRoot{most[0], x[1], x[2]};
}

template std::optional<ContactRoot> prove_contact(const MovingPolygon<3>&, double, double, double);
template std::optional<ContactRoot> prove_contact(const MovingPolygon<4>&, double, double, double);

}  // namespace contactscope
