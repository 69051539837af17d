#include "geometry/hull_builder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

#include "geometry/flat_outline.h"
#include "geometry/hull_from_polygons.h"
#include "geometry/quickhull.h"
#include "geometry/triangulate_faces.h"

namespace contactscope {
namespace {

// Points come from float meshes, from text with six or seven digits, from float-rounded rotations.
// Rounding to float moves a coordinate by at most FLT_EPSILON / 2 of its size, hence a point off
// its plane by FLT_EPSILON / 2 of |x| + |y| + |z|. A plane through three such points is off by up
// to three times that at the centroid of the face next to it, whose own error comes on top: twice
// FLT_EPSILON in all, and one more as reserve. This is the tolerance of "Implementing Quickhull",
// 3 (max|x| + max|y| + max|z|) epsilon, with the epsilon of the data instead of that of the
// arithmetic. Sizes are those of the points about their own middle, so that moving a shape does not
// change it; what the arithmetic itself loses far from the origin is the second term.
constexpr double kDataEpsilon = std::numeric_limits<float>::epsilon();
constexpr double kArithmeticEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kTolerancePerEpsilon = 3;

// Merging can fail where the points are about as thick as the tolerance. A finer one merges less,
// and in the end nothing but what the arithmetic makes coplanar, which always works on exact
// points.
constexpr std::array<double, 5> kAttempts = {1, 1.0 / 8, 1.0 / 64, 1.0 / 4096, 1.0 / 262144};

struct Bounds {
  Vec3d center;
  Vec3d half_extents;
  Vec3d magnitude;  // largest absolute coordinates
};

Bounds bounds_of(std::span<const Vec3d> points) {
  Vec3d low = points[0];
  Vec3d high = points[0];
  for (const Vec3d& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  // Halved before adding: the sum of two large coordinates may overflow.
  return {0.5 * low + 0.5 * high, 0.5 * high - 0.5 * low, low.cwiseAbs().cwiseMax(high.cwiseAbs())};
}

double tolerance_for(const Bounds& bounds) {
  return kTolerancePerEpsilon *
         (kDataEpsilon * bounds.half_extents.sum() + kArithmeticEpsilon * bounds.magnitude.sum());
}

std::string spell(const Vec3d& point) {
  std::ostringstream text;
  text << "(" << point.x() << ", " << point.y() << ", " << point.z() << ")";
  return text.str();
}

bool lexicographically_less(const Vec3d& a, const Vec3d& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

/// Indices of the points without those that repeat an earlier one, in order.
std::vector<int> distinct_points(std::span<const Vec3d> points, bool weld) {
  const auto at = [&](int i) -> const Vec3d& { return points[static_cast<std::size_t>(i)]; };
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int i, int j) {
    if (at(i) == at(j)) return i < j;
    return lexicographically_less(at(i), at(j));
  });
  std::vector<int> distinct;
  for (const int i : order) {
    if (distinct.empty() || at(distinct.back()) != at(i)) {
      distinct.push_back(i);
    } else if (!weld) {
      throw HullError(HullProblem::Duplicate,
                      "points " + std::to_string(distinct.back()) + " and " + std::to_string(i) +
                          " (counted from 0) are both " + spell(at(i)) +
                          "; a hull's points are all different: remove one, or correct it");
    }
  }
  std::sort(distinct.begin(), distinct.end());
  return distinct;
}

void require_finite(std::span<const Vec3d> points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].allFinite()) continue;
    throw HullError(HullProblem::NotFinite, "point " + std::to_string(i) + " (counted from 0) is " +
                                                spell(points[i]) +
                                                "; every coordinate must be a finite number");
  }
}

[[noreturn]] void refuse(quickhull::Status status, std::size_t count, double tolerance) {
  std::ostringstream all;
  all << "all " << count << " points lie within " << tolerance << " m of one ";
  switch (status) {
    case quickhull::Status::Coincident:
      throw HullError(HullProblem::Coincident,
                      all.str() + "place; a hull needs four points that span a volume");
    case quickhull::Status::Collinear:
      throw HullError(
          HullProblem::Collinear,
          all.str() + "line; a hull needs a point off that line and one off their plane");
    case quickhull::Status::Coplanar:
      throw HullError(HullProblem::Coplanar,
                      all.str() + "plane; a hull needs a point off that plane");
    default:
      throw HullError(
          HullProblem::Unresolved,
          "no convex hull was found whose faces fit the " + std::to_string(count) +
              " points; they are too thin or too noisy: give fewer or more exact points");
  }
}

/// Hull from faces over all input points: the points that no face uses are left out, the others
/// keep their order. Each face starts at its lowest vertex and the faces are sorted, so that the
/// order says nothing about how quickhull went.
Hull<double> compact(std::span<const Vec3d> points, std::vector<std::vector<int>> faces) {
  std::vector<int> number(points.size(), -1);
  for (const std::vector<int>& face : faces) {
    for (const int point : face) number[static_cast<std::size_t>(point)] = 0;
  }
  std::vector<Vec3d> vertices;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (number[i] < 0) continue;
    number[i] = static_cast<int>(vertices.size());
    vertices.push_back(points[i]);
  }
  for (std::vector<int>& face : faces) {
    for (int& point : face) point = number[static_cast<std::size_t>(point)];
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
  }
  std::sort(faces.begin(), faces.end());
  return hull_from_polygons(std::move(vertices), faces);
}

}  // namespace

double hull_tolerance(std::span<const Vec3d> points) {
  return tolerance_for(bounds_of(points));
}

Hull<double> build_hull(std::span<const Vec3d> points, const HullOptions& options) {
  const std::size_t least = options.allow_flat ? 3 : 4;
  const std::string number = options.allow_flat ? "three" : "four";
  if (points.size() < least) {
    throw HullError(HullProblem::TooFewPoints, "a hull needs at least " + number + " points, got " +
                                                   std::to_string(points.size()));
  }
  require_finite(points);
  const std::vector<int> distinct = distinct_points(points, options.weld_duplicates);
  if (distinct.size() < least) {
    throw HullError(HullProblem::TooFewDistinct,
                    "only " + std::to_string(distinct.size()) + " of the " +
                        std::to_string(points.size()) +
                        " points are different; a hull needs at least " + number);
  }
  std::vector<Vec3d> kept;
  kept.reserve(distinct.size());
  for (const int i : distinct) kept.push_back(points[static_cast<std::size_t>(i)]);

  // Quickhull runs about the middle and at size 1; the factor is a power of two, so that it costs
  // nothing and the outcome is the same at every scale.
  const Bounds bounds = bounds_of(kept);
  const int exponent = std::ilogb(bounds.half_extents.maxCoeff());
  std::vector<Vec3d> local;
  local.reserve(kept.size());
  for (const Vec3d& point : kept) {
    const Vec3d offset = point - bounds.center;
    local.emplace_back(std::ldexp(offset.x(), -exponent), std::ldexp(offset.y(), -exponent),
                       std::ldexp(offset.z(), -exponent));
  }
  const double tolerance = tolerance_for(bounds);
  for (const double factor : kAttempts) {
    quickhull::Result result = quickhull::run(local, std::ldexp(factor * tolerance, -exponent));
    if (result.status == quickhull::Status::Done) {
      Hull<double> hull = compact(kept, std::move(result.faces));
      return options.merge_coplanar ? hull : triangulate_faces(hull);
    }
    if (result.status == quickhull::Status::Coplanar && options.allow_flat) {
      const std::vector<int> front = flat_outline(local, std::ldexp(factor * tolerance, -exponent));
      return compact(kept, {front, {front.rbegin(), front.rend()}});
    }
    if (result.status != quickhull::Status::Unresolved) {
      refuse(result.status, kept.size(), factor * tolerance);
    }
  }
  refuse(quickhull::Status::Unresolved, kept.size(), tolerance);
}

}  // namespace contactscope
