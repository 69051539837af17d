#include "geometry/bounds.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

#include "core/convex_polygon.h"

namespace contactscope {
namespace {

/// The smallest number of the scalar type that is not below `value`.
template <class S> S rounded_up(long double value) {
  const S nearest = static_cast<S>(value);
  return static_cast<long double>(nearest) < value
             ? std::nextafter(nearest, std::numeric_limits<S>::infinity())
             : nearest;
}

struct Ball {
  Vec3d center = Vec3d::Zero();
  double squared = -1;  // squared radius
};

using Support = StaticVector<Vec3d, 5>;

/// Smallest ball through all of 1 to 4 points, with its centre in their affine span. None if the
/// points are dependent: a subset then gives the same ball.
std::optional<Ball> ball_through(const Support& points) {
  const Vec3d origin = points[0];
  const int count = static_cast<int>(points.size()) - 1;
  if (count == 0) return Ball{origin, 0};
  Eigen::MatrixXd offsets(3, count);
  for (int i = 0; i < count; ++i) offsets.col(i) = points[static_cast<std::size_t>(i) + 1] - origin;
  const Eigen::MatrixXd gram = 2 * offsets.transpose() * offsets;
  const Eigen::VectorXd squares = 0.5 * gram.diagonal();
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(gram);
  if (solver.rank() < count) return std::nullopt;
  const Vec3d out = offsets * solver.solve(squares);
  return Ball{origin + out, out.squaredNorm()};
}

/// Squared lengths within this ratio count as equal.
constexpr double kSame = 1 + 1e-13;

bool holds_all(const Ball& ball, const Support& points) {
  for (const Vec3d& point : points)
    if ((point - ball.center).squaredNorm() > kSame * ball.squared) return false;
  return true;
}

/// Smallest ball of at most five points, the last on its surface; `support`: those on its surface.
std::optional<Ball> smallest_of_few(Support& support) {
  std::optional<Ball> smallest;
  Support kept;
  const std::size_t others = support.size() - 1;
  for (unsigned chosen = 0; chosen < 1U << others; ++chosen) {
    Support through;
    for (std::size_t i = 0; i < others; ++i)
      if ((chosen >> i & 1U) != 0) through.push_back(support[i]);
    if (through.size() > 3) continue;
    through.push_back(support[others]);
    const std::optional<Ball> ball = ball_through(through);
    if (!ball || (smallest && !(ball->squared < smallest->squared))) continue;
    if (!holds_all(*ball, support)) continue;
    smallest = ball;
    kept = through;
  }
  if (smallest) support = kept;
  return smallest;
}

/// Each step grows the ball, so no support set repeats. No known input takes nearly as many steps.
constexpr int kMaxPivots = 200;

Ball smallest_ball(const std::vector<Vec3d>& points) {
  Support support;
  support.push_back(points.front());
  Ball ball{points.front(), 0};
  for (int pivot = 0; pivot < kMaxPivots; ++pivot) {
    double farthest = 0;
    const Vec3d* outside = nullptr;
    for (const Vec3d& point : points) {
      const double squared = (point - ball.center).squaredNorm();
      if (squared <= farthest) continue;
      farthest = squared;
      outside = &point;
    }
    if (outside == nullptr || farthest <= kSame * ball.squared) break;
    support.push_back(*outside);
    const std::optional<Ball> next = smallest_of_few(support);
    if (!next || !(next->squared > ball.squared)) break;  // rounding allows no further progress
    ball = *next;
  }
  return ball;
}

using Extended = Vec3<long double>;

/// A box must have a surface this much smaller to replace an earlier one.
constexpr double kBetter = 1 - 1e-9;
/// Limit for edge pairs, whose number grows with the square.
constexpr int kMaxPairedEdges = 64;

/// Box along axes that are orthonormal up to rounding. The box has the same axes.
template <class S> Obb<S> box_along(const Mat3<S>& axes, std::span<const Vec3<S>> points) {
  const Mat3<long double> columns = axes.template cast<long double>();
  const Mat3<long double> to_axes = columns.inverse();
  Aabb<long double> extents;
  for (const Vec3<S>& point : points) {
    const Extended local = to_axes * point.template cast<long double>();
    extents.include(local);
  }
  const Extended middle = columns * extents.center();
  Obb<S> box{middle.cast<S>(), axes, Vec3<S>::Zero()};
  // The rounded centre is off the middle. Measured from there, far positions cost no digits.
  Extended reach = Extended::Zero();
  for (const Vec3<S>& point : points) {
    const Extended offset =
        point.template cast<long double>() - box.center.template cast<long double>();
    reach = reach.cwiseMax(Extended(to_axes * offset).cwiseAbs());
  }
  for (int k = 0; k < 3; ++k) box.half_extents[k] = rounded_up<S>(reach[k]);
  return box;
}

double half_surface(const Vec3d& extents) {
  return extents.x() * extents.y() + extents.y() * extents.z() + extents.z() * extents.x();
}

/// Selects the smallest box among candidate axes.
class SmallestBox {
 public:
  explicit SmallestBox(std::span<const Vec3d> points) : points_(points) {}

  /// `axes` has orthonormal columns.
  void offer(const Mat3<double>& axes) {
    Aabb<double> extents;
    for (const Vec3d& point : points_) {
      const Vec3d local = axes.transpose() * point;
      extents.include(local);
    }
    keep(half_surface(extents.extent()), axes);
  }

  /// Offers boxes with an axis along `normal` (length > 0) and one along each side of the outline.
  void offer_about(const Vec3d& normal) {
    const PlaneFrame<double> plane(points_[0], normal.normalized());
    const Vec3d across = plane.u.cross(plane.v);
    const std::vector<Vec2d> seen = mapped(points_, [&](const Vec3d& p) { return plane.seen(p); });
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Vec3d& point : points_) {
      low = std::min(low, across.dot(point));
      high = std::max(high, across.dot(point));
    }
    const std::vector<Vec2d> outline = convex_polygon(seen);
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vec2d side = outline[(i + 1) % outline.size()] - outline[i];
      if (!(side.norm() > 0)) continue;
      const Vec2d along = side.normalized(), up(-along.y(), along.x());
      Vec2d lower = Vec2d::Constant(std::numeric_limits<double>::infinity()), upper = -lower;
      for (const Vec2d& corner : outline) {
        const Vec2d local(along.dot(corner), up.dot(corner));
        lower = lower.cwiseMin(local);
        upper = upper.cwiseMax(local);
      }
      const Vec2d extent = upper - lower;
      Mat3<double> axes;
      axes.col(0) = along.x() * plane.u + along.y() * plane.v;
      axes.col(1) = up.x() * plane.u + up.y() * plane.v;
      axes.col(2) = across;
      keep(half_surface({extent.x(), extent.y(), high - low}), axes);
    }
  }

  /// Normalized to full precision, because a chain of products is not exactly orthonormal.
  Mat3<double> axes() const {
    if (axes_.isIdentity(0)) return axes_;
    return Quatd(axes_).normalized().toRotationMatrix();
  }

 private:
  void keep(double surface, const Mat3<double>& axes) {
    if (!(surface < kBetter * surface_)) return;
    surface_ = surface;
    axes_ = axes;
  }

  std::span<const Vec3d> points_;
  Mat3<double> axes_ = Mat3<double>::Identity();
  double surface_ = std::numeric_limits<double>::infinity();
};

/// Principal axes: eigenvectors of the surface's second moments about its centre, uniform density.
class Principal {
 public:
  void add(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const double area = Vec3d((b - a).cross(c - a)).norm();
    const Vec3d sum = a + b + c;
    area_ += area;
    first_ += area / 3 * sum;
    second_ += area / 12 *
               (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  Mat3<double> axes() const {
    if (!(area_ > 0)) return Mat3<double>::Identity();
    const Vec3d middle = first_ / area_;
    const Mat3<double> moments = second_ / area_ - middle * middle.transpose();
    Mat3<double> axes = Eigen::SelfAdjointEigenSolver<Mat3<double>>(moments).eigenvectors();
    if (axes.determinant() < 0) axes.col(0) = -axes.col(0);
    return axes;
  }

 private:
  double area_ = 0;
  Vec3d first_ = Vec3d::Zero();
  Mat3<double> second_ = Mat3<double>::Zero();
};

/// Vertices relative to the first one, in double, so that far from the origin no digits are lost.
template <class S> std::vector<Vec3d> near_origin(const std::vector<Vec3<S>>& vertices) {
  return mapped(vertices, [&](const Vec3<S>& vertex) -> Vec3d {
    return vertex.template cast<double>() - vertices.front().template cast<double>();
  });
}

template <class S>
Obb<S> box_of_vertices(const SmallestBox& smallest, const std::vector<Vec3<S>>& vertices) {
  return box_along<S>(smallest.axes().template cast<S>(), vertices);
}

template <class S> Obb<S> obb_of_kind(const Hull<S>& hull) {
  const std::vector<Vec3d> points = near_origin(hull.vertices);
  SmallestBox smallest(points);
  smallest.offer(Mat3<double>::Identity());
  Principal principal;
  for (int face = 0; face < hull.face_count(); ++face) {
    const std::vector<int> corners = face_vertices(hull, face);
    for (std::size_t k = 2; k < corners.size(); ++k)
      principal.add(at(points, corners[0]), at(points, corners[k - 1]), at(points, corners[k]));
  }
  smallest.offer(principal.axes());
  for (const Plane<S>& plane : hull.planes)
    smallest.offer_about(plane.normal.template cast<double>());
  if (hull.edge_count() > kMaxPairedEdges) return box_of_vertices(smallest, hull.vertices);
  const auto direction = [&](int edge) -> Vec3d {
    const Vec3<S> along = hull.target(2 * edge) - hull.origin(2 * edge);
    return along.template cast<double>().normalized();
  };
  for (int one = 0; one < hull.edge_count(); ++one) {
    for (int other = 0; other < one; ++other) {
      const Vec3d normal = direction(one).cross(direction(other));
      if (normal.norm() > 1e-3) smallest.offer_about(normal);
    }
  }
  return box_of_vertices(smallest, hull.vertices);
}

template <class S> Obb<S> obb_of_kind(const Mesh<S>& mesh) {
  const std::vector<Vec3d> points = near_origin(mesh.vertices);
  SmallestBox smallest(points);
  smallest.offer(Mat3<double>::Identity());
  Principal principal;
  for (const std::array<int, 3>& corners : mesh.triangles)
    principal.add(at(points, corners[0]), at(points, corners[1]), at(points, corners[2]));
  smallest.offer(principal.axes());
  return box_of_vertices(smallest, mesh.vertices);
}

template <class S> Obb<S> obb_of_kind(const Sphere<S>& sphere) {
  return {Vec3<S>::Zero(), Mat3<S>::Identity(), Vec3<S>::Constant(sphere.radius)};
}

template <class S> Obb<S> obb_of_kind(const Capsule<S>& capsule) {
  const Vec3d along = (capsule.points[1] - capsule.points[0]).template cast<double>();
  Mat3<double> axes = Mat3<double>::Identity();
  const bool along_axis = (along.array() != 0).count() < 2;
  if (!along_axis) {
    axes.col(0) = along.normalized();
    axes.col(1) = any_perpendicular<double>(axes.col(0));
    axes.col(2) = axes.col(0).cross(axes.col(1));
  }
  Obb<S> box = box_along<S>(axes.template cast<S>(), capsule.points);
  // Rounding may make the axes longer or tilt them: add this margin to the radius.
  const Extended radius = Extended::Constant(capsule.radius);
  const long double more = along_axis ? 1 : 1 + 8 * std::numeric_limits<S>::epsilon();
  for (int k = 0; k < 3; ++k)
    box.half_extents[k] = rounded_up<S>((long double)(box.half_extents[k]) + more * radius[k]);
  return box;
}

template <class S>
Aabb<S> aabb_of_points(std::span<const Vec3<S>> points, const Pose<S>& pose, S radius) {
  Aabb<S> box;
  for (const Vec3<S>& point : points) box.include(pose.transform(point));
  for (int k = 0; k < 3 && radius > 0; ++k) {
    box.lower[k] = -rounded_up<S>((long double)(radius)-box.lower[k]);
    box.upper[k] = rounded_up<S>((long double)(radius) + box.upper[k]);
  }
  return box;
}

template <class S> std::span<const Vec3<S>> points_of(const Hull<S>& hull) { return hull.vertices; }
template <class S> std::span<const Vec3<S>> points_of(const Mesh<S>& mesh) { return mesh.vertices; }
template <class S> std::span<const Vec3<S>> points_of(const Capsule<S>& capsule) {
  return capsule.points;
}
template <class S> std::span<const Vec3<S>> points_of(const Sphere<S>&) {
  static const Vec3<S> middle = Vec3<S>::Zero();
  return {&middle, 1};
}

template <class S, class Kind> S radius_of(const Kind& kind) {
  if constexpr (requires { kind.vertices; }) {
    return 0;
  } else {
    return kind.radius;
  }
}

/// Applies `make` to any bounded shape; nullopt for planes.
template <class Bound, class S, class Make>
std::optional<Bound> bound_of(const Shape<S>& shape, const Make& make) {
  return std::visit(
      [&]<class Kind>(const Kind& kind) -> std::optional<Bound> {
        if constexpr (std::is_same_v<Kind, HalfSpace<S>>) {
          return std::nullopt;
        } else if constexpr (std::is_same_v<Kind, Field<S>>) {
          return bound_of<Bound>(kind.source->shape, make);
        } else {
          return make(kind);
        }
      },
      shape);
}

}  // namespace

template <class S> BoundingSphere<S> sphere_around(std::span<const Vec3<S>> points) {
  if (points.empty()) return {};
  // Relative to the first point and scaled to size 1, so neither distance nor size costs digits.
  const Vec3d origin = points.front().template cast<double>();
  std::vector<Vec3d> local;
  double size = 0;
  for (const Vec3<S>& point : points) {
    local.push_back(point.template cast<double>() - origin);
    size = std::max(size, local.back().template lpNorm<Eigen::Infinity>());
  }
  if (!(size > 0)) return {points.front(), 0};
  for (Vec3d& point : local) point /= size;
  const Vec3d center = origin + size * smallest_ball(local).center;
  BoundingSphere<S> sphere{center.cast<S>(), 0};
  // This radius contains all points, whatever error the search has left.
  long double squared = 0;
  for (const Vec3<S>& point : points) {
    const Vec3<long double> offset =
        point.template cast<long double>() - sphere.center.template cast<long double>();
    squared = std::max(squared, offset.squaredNorm());
  }
  sphere.radius = rounded_up<S>(std::sqrt(squared));
  return sphere;
}

template <class S> std::optional<Aabb<S>> aabb_of(const Shape<S>& shape, const Pose<S>& pose) {
  return bound_of<Aabb<S>>(shape, [&]<class Kind>(const Kind& kind) {
    return aabb_of_points<S>(points_of(kind), pose, radius_of<S>(kind));
  });
}

template <class S> std::optional<Obb<S>> obb_of(const Shape<S>& shape) {
  return bound_of<Obb<S>>(shape, [](const auto& kind) { return obb_of_kind(kind); });
}

template <class S> std::optional<BoundingSphere<S>> bounding_sphere_of(const Shape<S>& shape) {
  return bound_of<BoundingSphere<S>>(shape, []<class Kind>(const Kind& kind) {
    BoundingSphere<S> sphere = sphere_around<S>(points_of(kind));
    sphere.radius = rounded_up<S>((long double)(sphere.radius) + radius_of<S>(kind));
    return sphere;
  });
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(sphere_around, aabb_of, bounding_sphere_of);
CONTACTSCOPE_FLOAT_AND_DOUBLE(obb_of);

}  // namespace contactscope
