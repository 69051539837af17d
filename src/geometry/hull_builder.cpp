#include "geometry/hull_builder.h"

#include "core/convex_polygon.h"
#include "geometry/quickhull.h"
#include "geometry/shape.h"

namespace contactscope {
namespace {

// Points come from float meshes, from text with six or seven digits, or from rotations rounded to
// float. Rounding to float moves a coordinate by at most FLT_EPSILON / 2 of its size, and a point
// off its plane by at most FLT_EPSILON / 2 of |x| + |y| + |z|. A plane through three such points is
// off by up to three times that at the centroid of the next face, plus that face's own error: twice
// FLT_EPSILON in total, and one more as reserve. This is the tolerance of "Implementing Quickhull",
// 3 (max|x| + max|y| + max|z|) epsilon, with the epsilon of the data, not of the arithmetic. Sizes
// are relative to the points' centre, so that moving a shape does not change it. The second term
// covers the error of the arithmetic far from the origin.
constexpr double kArithmeticEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kTolerancePerEpsilon = 3;

// Factors of the tolerance, tried in order: merging can fail if the points are about as thin as
// that. The finest merges only what rounding makes coplanar, which works for exact points.
constexpr std::array<double, 5> kAttempts = {1, 1.0 / 8, 1.0 / 64, 1.0 / 4096, 1.0 / 262144};

// For double coordinates: rotating and moving them has lost a few bits.
constexpr double kFinestEpsilon = 16 * kArithmeticEpsilon;

Vec3d half_extents_of(const Aabb<double>& box) {
  // Halve before subtracting: the extent of large coordinates may overflow.
  return 0.5 * box.upper - 0.5 * box.lower;
}

std::string spell(const Vec3d& point) {
  std::ostringstream text;
  text << "(" << point.x() << ", " << point.y() << ", " << point.z() << ")";
  return text.str();
}

/// Indices of the points without later duplicates, in order.
std::vector<int> distinct_points(std::span<const Vec3d> points, bool weld) {
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](int i) {
    const Vec3d& point = at(points, i);
    return std::tuple(point.x(), point.y(), point.z(), i);
  });
  std::vector<int> distinct;
  for (const int i : order) {
    if (distinct.empty() || at(points, distinct.back()) != at(points, i)) {
      distinct.push_back(i);
    } else if (!weld) {
      throw ShapeError("points " + std::to_string(distinct.back()) + " and " + std::to_string(i) +
                       " (counted from 0) are both " + spell(at(points, i)) +
                       "; a hull's points are all different: remove one, or correct it");
    }
  }
  std::ranges::sort(distinct);
  return distinct;
}

void require_finite(std::span<const Vec3d> points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].allFinite()) continue;
    throw ShapeError("point " + std::to_string(i) + " (counted from 0) is " + spell(points[i]) +
                     "; every coordinate must be a finite number");
  }
}

[[noreturn]] void refuse(quickhull::Status status, std::size_t count, double tolerance) {
  using quickhull::Status;
  if (status == Status::Unresolved)
    throw ShapeError("no convex hull was found whose faces fit the " + std::to_string(count) +
                     " points; they are too thin or too noisy: give fewer or more exact points");
  std::ostringstream message;
  message << "all " << count << " points lie within " << tolerance << " m of one ";
  if (status == Status::Coincident)
    message << "place; a hull needs four points that span a volume";
  else if (status == Status::Collinear)
    message << "line; a hull needs a point off that line and one off their plane";
  else
    message << "plane; a hull needs a point off that plane";
  throw ShapeError(message.str());
}

/// True if all corners between two positions of the outline lie on the line between these two.
bool straight(const std::vector<Vec2d>& outline, std::size_t from, std::size_t to,
              double tolerance) {
  const Vec2d& start = outline[from];
  const Vec2d& end = outline[to % outline.size()];
  const double room = tolerance * (end - start).norm();
  for (std::size_t i = from + 1; i < to; ++i)
    if (std::abs(turn(start, end, outline[i])) > room) return false;
  return true;
}

/// Convex polygon of points that lie within `tolerance` (metres) of one plane but not of one line:
/// indices of its corners, counter-clockwise seen from one side. Corners within the tolerance of a
/// line are dropped. `points` surround the origin and differ. Steps: 1. the plane through distant
/// points; 2. the convex outline of the points seen along its normal, from the leftmost corner on;
/// 3. from each kept corner, skip to the last one for which all corners between are on a line.
std::vector<int> flat_outline(std::span<const Vec3d> points, double tolerance) {
  const auto corner = quickhull::initial_simplex(points, tolerance).points;
  const Vec3d& origin = at(points, corner[0]);
  const Vec3d x = (at(points, corner[1]) - origin).normalized();
  const Vec3d third = at(points, corner[2]) - origin;
  const Vec3d y = (third - third.dot(x) * x).normalized();
  const std::vector<Vec2d> flat = mapped(points, [&](const Vec3d& point) {
    const Vec3d arm = point - origin;
    return Vec2d(arm.dot(x), arm.dot(y));
  });
  const std::vector<int> corners = convex_outline(flat);
  const std::vector<Vec2d> outline = mapped(corners, [&](int i) { return at(flat, i); });
  std::vector<int> kept;
  for (std::size_t from = 0; from < outline.size();) {
    kept.push_back(corners[from]);
    std::size_t to = from + 1;
    while (to < outline.size() && straight(outline, from, to + 1, tolerance)) ++to;
    from = to;
  }
  return kept;
}

/// Hull from faces over all input points, in their order without unused ones. Faces start at their
/// lowest vertex and are sorted, so that the order does not depend on the course of quickhull.
Hull<double> compact(std::span<const Vec3d> points, std::vector<std::vector<int>> faces) {
  std::vector<int> number(points.size(), -1);
  for (const std::vector<int>& face : faces)
    for (const int point : face) at(number, point) = 0;
  std::vector<Vec3d> vertices;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (number[i] < 0) continue;
    number[i] = count_of(vertices);
    vertices.push_back(points[i]);
  }
  for (std::vector<int>& face : faces) {
    for (int& point : face) point = at(number, point);
    std::rotate(face.begin(), std::ranges::min_element(face), face.end());
  }
  std::ranges::sort(faces);
  return hull_from_polygons(std::move(vertices), faces);
}

/// Points centred and scaled to size 1 for quickhull. The factor is a power of two, so that scaling
/// is exact and the result is the same at every scale.
struct UnitPoints {
  explicit UnitPoints(std::span<const Vec3d> points) {
    const Aabb<double> box = box_around(points);
    const Vec3d center = box.center();
    exponent = std::ilogb(half_extents_of(box).maxCoeff());
    local = mapped(points, [&](const Vec3d& point) -> Vec3d {
      return (point - center).unaryExpr([&](double x) { return std::ldexp(x, -exponent); });
    });
  }

  std::vector<Vec3d> local;
  int exponent;
};

/// True if every edge is parallel to its faces, even after its ends move by `rounding`.
bool has_true_edges(const quickhull::Result& result, double rounding) {
  return result.steepest_edge <= quickhull::kSteepest &&
         rounding <= quickhull::kSteepest * result.shortest_edge;
}

/// The points rounded to float relative to the origin they will have (see moved_origin).
std::vector<Vec3d> rounded_to_float(std::vector<Vec3d> points) {
  const Vec3d origin = middle_where_far(box_around(points), 0);
  for (Vec3d& point : points) {
    for (int axis = 0; axis < 3; ++axis) {
      // Volatile forces a store, as in middle_where_far().
      const volatile float rounded = static_cast<float>(point[axis] - origin[axis]);
      point[axis] = origin[axis] + static_cast<double>(rounded);
    }
  }
  return points;
}

/// Largest displacement of a point by rounded_to_float().
double rounding_to_float(std::span<const Vec3d> points) {
  const Aabb<double> box = box_around(points);
  const Vec3d origin = middle_where_far(box, 0);
  const Vec3d lower = box.lower - origin, upper = box.upper - origin;
  return 0.5 * std::numeric_limits<float>::epsilon() *
         lower.cwiseAbs().cwiseMax(upper.cwiseAbs()).sum();
}

/// Hull by quickhull::run_with_near_points; none if that fails.
std::optional<Hull<double>> hull_with_near_points(std::vector<Vec3d> points, double tolerance,
                                                  bool for_float) {
  if (for_float) {
    points = rounded_to_float(std::move(points));
    points = mapped(distinct_points(points, true), [&](int i) { return at(points, i); });
  }
  const auto [local, exponent] = UnitPoints(points);
  quickhull::Result result =
      quickhull::run_with_near_points(local, std::ldexp(tolerance, -exponent));
  if (result.status != quickhull::Status::Done) return std::nullopt;
  return compact(points, std::move(result.faces));
}

/// Number of digits in the shortest decimal text that reads back as this number.
int digits_of(double number) {
  char text[32];
  char* const end =
      std::to_chars(text, text + sizeof text, std::abs(number), std::chars_format::scientific).ptr;
  char* const mantissa_end = std::find(text, end, 'e');
  return static_cast<int>(mantissa_end - text - std::count(text, mantissa_end, '.'));
}

}  // namespace

double epsilon_of_digits(std::span<const Vec3d> points) {
  int digits = 0;
  bool are_floats = true;
  for (const Vec3d& point : points) {
    for (const double x : point) {
      are_floats = are_floats && std::equal_to<double>()(static_cast<float>(x), x);
      digits = std::max(digits, digits_of(x));
    }
  }
  constexpr double kFloat = std::numeric_limits<float>::epsilon();
  if (are_floats || digits <= std::numeric_limits<float>::max_digits10) return kFloat;
  return std::max(kFinestEpsilon, std::pow(10.0, 1 - digits));
}

double hull_tolerance(std::span<const Vec3d> points, double epsilon) {
  const Aabb<double> box = box_around(points);
  const Vec3d magnitude = box.lower.cwiseAbs().cwiseMax(box.upper.cwiseAbs());
  return kTolerancePerEpsilon *
         (epsilon * half_extents_of(box).sum() + kArithmeticEpsilon * magnitude.sum());
}

Hull<double> build_hull(std::span<const Vec3d> points, const HullOptions& options) {
  const std::size_t least = options.allow_flat ? 3 : 4;
  const std::string number = options.allow_flat ? "three" : "four";
  if (points.size() < least)
    throw ShapeError("a hull needs at least " + number + " points, got " +
                     std::to_string(points.size()));
  require_finite(points);
  const std::vector<int> distinct = distinct_points(points, options.weld_duplicates);
  if (distinct.size() < least)
    throw ShapeError("only " + std::to_string(distinct.size()) + " of the " +
                     std::to_string(points.size()) +
                     " points are different; a hull needs at least " + number);
  const std::vector<Vec3d> kept = mapped(distinct, [&](int i) { return at(points, i); });

  const auto [local, exponent] = UnitPoints(kept);
  const double tolerance = hull_tolerance(kept, options.epsilon);
  std::vector<double> attempts(kAttempts.begin(), kAttempts.end());
  // Before giving up, merge finer coordinates as coarsely as float coordinates.
  for (double factor = 8; factor * options.epsilon <= HullOptions().epsilon; factor *= 8)
    attempts.push_back(factor);
  for (const double factor : attempts) {
    const double scaled = std::ldexp(factor * tolerance, -exponent);
    quickhull::Result result = quickhull::run(local, scaled);
    if (result.status == quickhull::Status::Done) {
      const double off = options.for_float ? rounding_to_float(kept) : 0;
      if (!has_true_edges(result, std::ldexp(off, -exponent)))
        if (auto hull = hull_with_near_points(kept, tolerance, options.for_float)) return *hull;
      return compact(kept, std::move(result.faces));
    }
    if (result.status == quickhull::Status::Coplanar && options.allow_flat) {
      const std::vector<int> front = flat_outline(local, scaled);
      return compact(kept, {front, {front.rbegin(), front.rend()}});
    }
    if (result.status != quickhull::Status::Unresolved)
      refuse(result.status, kept.size(), factor * tolerance);
  }
  refuse(quickhull::Status::Unresolved, kept.size(), tolerance);
}

}  // namespace contactscope
