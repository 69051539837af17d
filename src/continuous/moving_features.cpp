#include "continuous/moving_features.h"

#include "continuous/moving_polygon.h"

namespace contactscope {
namespace {

/// Proved contact: the origin is in the polygon at some time before `end`, at or near u, v.
struct ContactRoot {
  double end;  // fraction of the step
  double u, v;
};

/// The equation of contact and its derivatives by time, u and v.
class ContactEquation {
 public:
  template <int kCorners> explicit ContactEquation(const MovingPolygon<kCorners>& polygon) {
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

/// Proves that two features meet: that d[0] + u (d[1] - d[0]) + v (d[last] - d[0]) = 0 has a
/// solution at a time of the step and a place on the features near those given. Returns nullopt if
/// the proof fails, as it does for contacts at a border and grazing contacts.
///
/// Newton's method finds the root. Krawczyk's operator then maps a box about it into itself, so the
/// box contains a root of the exact equation (Krawczyk 1969; Moore 1977, "A Test for Existence of
/// Solutions to Nonlinear Systems"). Rounding is bounded by multiples of 2^-53 of the terms.
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

/// Error bound of a product of an axis and a corner, relative to the size: seven roundings of the
/// product, five of the corner and of the axis, ten of the time, for an axis of length up to 2.
constexpr double kProductRounding = 0x1p-47;

/// The first time > 0 at which c + b t + a t^2 falls to 0 from c > 0; `most` if that is later.
double first_fall(double c, double b, double a, double most) {
  const double at_most = c + most * (b + most * a);
  if (at_most > 0 && (a <= 0 || b >= 0 || b + 2 * a * most <= 0)) return most;
  const double discriminant = b * b - 4 * a * c;
  if (discriminant < 0) return most;
  const double root = std::sqrt(discriminant);
  // The form without cancellation.
  const double time = b < 0 ? 2 * c / (root - b) : (a < 0 ? (root + b) / (-2 * a) : most);
  return std::min(time, most);
}

/// Finds the first time at which the origin is in the polygon.
///
/// Along a fixed axis every corner moves linearly. An axis that separates the origin from the
/// polygon at one time is therefore valid, exactly, until the first of at most four lines reaches
/// zero. Along an axis that turns at a constant rate the lines are parabolas, and the axis can
/// follow the edge or plane that carries the nearest point. Steps: 1. take the nearest point as the
/// axis; 2. find how long it separates, fixed and turning; 3. repeat from there. This converges
/// like Newton's method on the distance, from the safe side, without boxes of places on the
/// features. 4. When the distance is within rounding, prove the root.
///
/// A step is conservative advancement (Mirtich 1996) with an exact bound on the motion.
template <int kCorners> class FeatureSearch {
 public:
  FeatureSearch(const MovingPolygon<kCorners>& polygon, double until)
      : polygon_(polygon), size_(polygon.size()), until_(until) {
    rounding_ = kProductRounding * size_;
    near_ = rounding_ + 3 * rounding_;
    for (int i = 0; i < kCorners; ++i) at(offset_, i) = at(polygon.end, i) - at(polygon.start, i);
  }

  FeatureImpact first() {
    // A polygon of size 0 is the origin itself.
    constexpr double kMin = 1e-45, kMax = 1e45;
    impact_.begin = 0;
    if (size_ == 0) return ended(FeatureStatus::Overlapping);
    if (!(size_ > kMin && size_ < kMax)) return ended(FeatureStatus::Near);
    for (impact_.steps = 1; impact_.steps <= kMaxFeatureSteps; ++impact_.steps) {
      ring_ = polygon_.at_time(impact_.begin);
      const NearestOfPolygon nearest = nearest_of_polygon(ring_);
      impact_.distance = nearest.distance;
      impact_.u = nearest.u;
      impact_.v = nearest.v;
      if (nearest.distance <= near_) return met(nearest.point);
      const double until = safe_until(nearest);
      if (until >= std::min(until_, 1.0)) {
        impact_.begin = 1;
        return ended(FeatureStatus::Separated);
      }
      if (!(until > impact_.begin)) break;
      impact_.begin = until;
    }
    return ended(FeatureStatus::Near);
  }

 private:
  /// Below it half of the nearest point's digits cancel, and another axis may be better.
  static constexpr double kDoubtful = 1e-7;
  using Ring = typename MovingPolygon<kCorners>::Ring;

  double safe_until(const NearestOfPolygon& nearest) {
    safe_ = 0;
    extend({nearest.point});
    if (safe_ < 1 - impact_.begin) {
      if (nearest.is_inside) {
        extend(in_plane(nearest.point));
      } else if (nearest.first != nearest.second) {
        extend(on_edge(nearest.point, nearest.first, nearest.second));
      }
    }
    if (safe_ < 1 - impact_.begin && (safe_ == 0 || nearest.distance < kDoubtful * size_)) {
      const Vec3d normal = normal_of(ring_);
      extend(in_plane(normal.dot(ring_[0]) < 0 ? Vec3d(-normal) : normal));
      for (int i = 0; i < kCorners; ++i) {
        const int next = (i + 1) % kCorners;
        double fraction;
        extend(on_edge(foot_on_edge(at(ring_, i), at(ring_, next), false, fraction), i, next));
        extend({at(ring_, i)});
      }
    }
    return safe_ >= 1 - impact_.begin ? 1 : impact_.begin + safe_;
  }

  TurningAxis on_edge(const Vec3d& direction, int from, int to) const {
    return axis_of_edge(direction, at(ring_, to) - at(ring_, from),
                        at(offset_, to) - at(offset_, from));
  }
  TurningAxis in_plane(const Vec3d& direction) const {
    constexpr int kLast = kCorners - 1;
    return axis_of_plane(direction, ring_[1] - ring_[0], ring_[kLast] - ring_[0],
                         offset_[1] - offset_[0], offset_[kLast] - offset_[0]);
  }

  /// Raises `safe_` to the time for which all corners are surely in front of the origin along the axis.
  void extend(const TurningAxis& turning) {
    const double length = turning.direction.norm();
    if (!(length > 0)) return;
    const Vec3d axis = turning.direction / length;
    Vec3d turn = turning.turn / length;
    turn -= turn.dot(axis) * axis;
    // The axis lengthens by at most this times the time squared, to less than twice its length.
    const double longer = 0.5 * turn.squaredNorm();
    double until = 1 - impact_.begin;
    if (longer * until * until > 0.5) until = std::sqrt(0.5 / longer);
    if (!(until > safe_)) return;
    for (int i = 0; i < kCorners; ++i) {
      const Vec3d& corner = at(ring_, i);
      const Vec3d& offset = at(offset_, i);
      const double now = axis.dot(corner) - rounding_;
      if (!(now > 0)) return;
      until = first_fall(now, axis.dot(offset) + turn.dot(corner), turn.dot(offset), until);
      if (until <= safe_) return;
    }
    safe_ = until;
    axis_ = axis;
  }

  FeatureImpact met(const Vec3d& nearest) {
    if (impact_.steps == 1) {
      if (impact_.distance > 0) axis_ = nearest / impact_.distance;
      const Vec3d normal = normal_of(ring_);
      if (impact_.distance <= rounding_ && normal.squaredNorm() > 0) axis_ = normal.normalized();
      return ended(FeatureStatus::Overlapping);
    }
    const auto root = prove_contact(polygon_, impact_.begin, impact_.u, impact_.v);
    // Newton's method may have found a root elsewhere, which is not this contact.
    if (!root || root->end < impact_.begin) return ended(FeatureStatus::Near);
    impact_.end = root->end;
    impact_.u = root->u;
    impact_.v = root->v;
    return ended(FeatureStatus::Hit);
  }

  FeatureImpact ended(FeatureStatus status) {
    impact_.status = status;
    if (status == FeatureStatus::Overlapping) impact_.end = 0;
    impact_.normal = -axis_;
    impact_.steps = std::min(impact_.steps, kMaxFeatureSteps);
    return impact_;
  }

  const MovingPolygon<kCorners>& polygon_;
  double size_, until_;
  double rounding_, near_;       // metres along a unit axis: surely separated beyond; a hit within
  Ring offset_, ring_;           // of the corners: motion in the step; current place
  double safe_ = 0;              // separated for this much of the step from now on
  Vec3d axis_ = Vec3d::UnitX();  // the last separating axis, from the second to the first
  FeatureImpact impact_;
};

template <int kCorners>
FeatureImpact first_impact(const MovingPolygon<kCorners>& polygon, double until) {
  if (polygon.is_separated_along_coordinates()) return {};
  return FeatureSearch<kCorners>(polygon, until).first();
}

/// Sets corner `i` of a moving polygon. The difference of two floats is taken in double.
template <class S, int kCorners>
void set_corner(MovingPolygon<kCorners>& polygon, int i, const MovingCorner<S>& of_first,
                const MovingCorner<S>& of_second) {
  at(polygon.start, i) =
      of_first.start.template cast<double>() - of_second.start.template cast<double>();
  at(polygon.end, i) = of_first.end.template cast<double>() - of_second.end.template cast<double>();
}

}  // namespace

template <class S>
FeatureImpact impact_of_vertex_face(const MovingCorner<S>& vertex, const MovingFace<S>& face,
                                    double until) {
  MovingPolygon<3> polygon;
  for (int i = 0; i < 3; ++i) set_corner(polygon, i, vertex, at(face, i));
  return first_impact(polygon, until);
}

template <class S>
FeatureImpact impact_of_edges(const MovingEdge<S>& a, const MovingEdge<S>& b, double until) {
  MovingPolygon<4> polygon;
  set_corner(polygon, 0, a[0], b[0]);
  set_corner(polygon, 1, a[1], b[0]);
  set_corner(polygon, 2, a[1], b[1]);
  set_corner(polygon, 3, a[0], b[1]);
  return first_impact(polygon, until);
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(impact_of_vertex_face, impact_of_edges);

}  // namespace contactscope
