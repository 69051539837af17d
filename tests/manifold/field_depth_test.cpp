#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "field/distance_field.h"
#include "manifold/field_contact.h"
#include "manifold/placed_shapes.h"
#include "support/brute_force_distance.h"
#include "support/builders.h"

/// The deepest point that a field reports: the distance of shapes within the margin, or in overlap
/// the depth of the deepest point of the other surface.
namespace contactscope {
namespace {

using test::deepest_of;
using test::manifolds_of;
using test::PlacedShapes;
using test::Random;

Shape<double> field_of(const Shape<double>& shape, int cells) {
  return field_shape(build_distance_field(shape, {.cells = cells}), shape);
}

/// Height over the faces of a box at the origin; inside, minus the distance from its surface.
double height_over_box(const Vec3d& half, const Vec3d& point) {
  return (point.cwiseAbs() - half).maxCoeff();
}

/// Minimum of that height on a segment. The height is the largest of six linear functions, so its
/// minimum is at an end or where two of them are equal.
double lowest_on_segment(const Vec3d& half, const Vec3d& from, const Vec3d& to) {
  double least = std::min(height_over_box(half, from), height_over_box(half, to));
  const auto height = [&](int face, const Vec3d& at) {
    return (face % 2 == 0 ? 1 : -1) * at[face / 2] - half[face / 2];
  };
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < i; ++j) {
      const double at_from = height(i, from) - height(j, from),
                   at_to = height(i, to) - height(j, to);
      const double part = at_from / (at_from - at_to);
      if (part > 0 && part < 1)
        least = std::min(least, height_over_box(half, (1 - part) * from + part * to));
    }
  }
  return least;
}

/// On a triangle: on its outline, or where three are equal.
double lowest_on_triangle(const Vec3d& half, const std::array<Vec3d, 3>& corners) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k)
    least = std::min(least, lowest_on_segment(half, corners[k], corners[(k + 1) % 3]));
  const Vec3d u = corners[1] - corners[0], v = corners[2] - corners[0];
  const auto normal = [](int face) -> Vec3d {
    return (face % 2 == 0 ? 1 : -1) * Vec3d::Unit(face / 2);
  };
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < i; ++j) {
      for (int k = 0; k < j; ++k) {
        // n.x - h of i equals that of j and that of k, at corner 0 + s u + t v.
        Eigen::Matrix2d matrix;
        Eigen::Vector2d rest;
        for (int row = 0; row < 2; ++row) {
          const int other = row == 0 ? j : k;
          const Vec3d across = normal(i) - normal(other);
          matrix.row(row) << across.dot(u), across.dot(v);
          rest[row] = half[i / 2] - half[other / 2] - across.dot(corners[0]);
        }
        const double determinant = matrix.determinant();
        if (determinant == 0) continue;
        const double s = (rest[0] * matrix(1, 1) - rest[1] * matrix(0, 1)) / determinant;
        const double t = (rest[1] * matrix(0, 0) - rest[0] * matrix(1, 0)) / determinant;
        if (!(s >= 0 && t >= 0 && s + t <= 1)) continue;
        least = std::min(least, height_over_box(half, corners[0] + s * u + t * v));
      }
    }
  }
  return least;
}

/// Separation of shape A, in the frame of the box that the field is made from.
struct Truth {
  double distance = std::numeric_limits<double>::infinity();  // of the cores
  double lowest = std::numeric_limits<double>::infinity();    // lowest height of the surface
  double radius = 0;
  double separation() const { return (distance > 0 ? distance : lowest) - radius; }
};

Truth truth_of(const Hull<double>& hull, const Pose<double>& pose, const Vec3d& half) {
  const test::Features features = test::features_of(hull, pose);
  const test::Features box = test::features_of(make_box(half), {});
  Truth truth;
  truth.distance = static_cast<double>(test::brute_force_distance(features, box).distance);
  for (int face = 0; face < hull.face_count(); ++face) {
    const std::vector<int> around = face_vertices(hull, face);
    const auto corner = [&](std::size_t k) {
      return pose.transform(contactscope::at(hull.vertices, around[k]));
    };
    for (std::size_t k = 2; k < around.size(); ++k)
      truth.lowest =
          std::min(truth.lowest, lowest_on_triangle(half, {corner(0), corner(k - 1), corner(k)}));
  }
  return truth;
}

Truth truth_of(const Capsule<double>& capsule, const Pose<double>& pose, const Vec3d& half) {
  Truth truth;
  truth.radius = capsule.radius;
  truth.distance =
      static_cast<double>(test::brute_force_distance(
                              test::features_of_segment(capsule.points[0], capsule.points[1], pose),
                              test::features_of(make_box(half), {}))
                              .distance);
  truth.lowest =
      lowest_on_segment(half, pose.transform(capsule.points[0]), pose.transform(capsule.points[1]));
  return truth;
}

template <class S> void as_deep_as_the_deepest_point(int fields) {
  Random random(21);
  int near = 0, deep = 0;
  for (int i = 0; i < fields; ++i) {
    const double size = random.decade(-4, 4);
    const Vec3d half = test::rounded<S>(
        size * Vec3d(random.decade(-1.5, 0), random.decade(-1.5, 0), random.decade(-1.5, 0)));
    const Shape<double> field = field_of(make_box(half), 4 + random.index(20));
    const double cell = std::get<Field<double>>(field).cell;
    const test::Features box = test::features_of(make_box(half), {});
    for (int k = 0; k < 20; ++k) {
      Pose<double> pose = random.pose(0);
      pose.rotation = pose.rotation.cast<S>().normalized().template cast<double>();
      Shape<double> shape;
      const auto truth_at = [&]() -> Truth {
        const auto* hull = std::get_if<Hull<double>>(&shape);
        return hull ? truth_of(*hull, pose, half)
                    : truth_of(std::get<Capsule<double>>(shape), pose, half);
      };
      const int kind = random.index(3);
      if (kind == 0)
        shape = make_box(test::rounded<S>(size * random.decade(-1, 0.5) * Vec3d(1, 0.1, 1)));
      else if (kind == 1)
        shape = test::random_hull(random, 10, size * random.decade(-1, 0.5), 5);
      else
        shape = Capsule<double>{{test::rounded<S>(size * random.unit_vector()), Vec3d::Zero()},
                                test::rounded<S>(size * random.decade(-3, -1))};
      // Each step moves in by the remaining distance, so it never passes the wanted separation.
      const double margin = test::rounded<S>(cell * random.uniform(0, 4));
      const Vec3d out = random.unit_vector();
      const double wanted = random.chance(0.5)   ? margin * random.uniform(0, 1)
                            : random.chance(0.5) ? -size * random.decade(-5, -1.5)
                                                 : cell * random.uniform(-1, 0);
      pose.position = 8 * size * out;
      for (int step = 0; step < 8; ++step)
        pose.position -= (truth_at().separation() - wanted) * out;
      pose.position = test::rounded<S>(pose.position);
      const Truth truth = truth_at();
      if (truth.distance == 0 && truth.lowest > 0) continue;  // a hull around the box
      const double separation = truth.separation();
      const double rounding =
          64 * static_cast<double>(std::numeric_limits<S>::epsilon()) * 8 * size;
      CollideOptions options;
      options.margin = margin;
      PlacedShapes pair{shape, pose, field, {}};
      if (k % 2 == 1) {
        std::swap(pair.a, pair.b);
        std::swap(pair.pose_a, pair.pose_b);
      }
      const Manifolds<S> found = manifolds_of<S>(pair, options);
      if (found.empty()) {
        ASSERT_GT(separation, margin - rounding) << i << ", " << k;
        continue;
      }
      const double deepest = deepest_of(found);
      const bool exact = truth.distance > rounding;
      (exact ? near : deep)++;
      ASSERT_GT(deepest, separation - rounding) << i << ", " << k;
      ASSERT_LT(deepest, separation + (exact ? 0 : kFieldTolerance * cell) + rounding)
          << i << ", " << k << ", kind " << kind << ", cells of " << cell << ", margin " << margin;
    }
  }
  EXPECT_GT(near, 5 * fields);
  EXPECT_GT(deep, 5 * fields);
}

TEST(FieldDepth, SlowWithinAMarginAndInOverlapTheDeepestPointIsFound) {
  as_deep_as_the_deepest_point<double>(20);
  as_deep_as_the_deepest_point<float>(20);
}

// The corner is under the middle of a face 2 m wide, between the samples of that face.
TEST(FieldDepth, ACornerBelowAFaceIsAsFarAsItIs) {
  const Shape<double> cube = field_of(test::cube(0.25), 16);
  const double height = 0.25 * std::sqrt(3.0);
  const Quatd corner_up = Quatd::FromTwoVectors(Vec3d(1, 1, 1), Vec3d::UnitY());
  CollideOptions options;
  options.margin = 0.03;
  for (const double gap : {0.02, 0.001, -0.01}) {
    for (const double x : {0.0, 0.031, 0.0625, 0.07, 0.11}) {
      const PlacedShapes pair{make_box(Vec3d(1, 0.5, 1)),
                              test::at(x, 0.5 + gap, 0.7 * x + 0.02),
                              cube,
                              {corner_up, Vec3d(0, -height, 0)}};
      // A face cuts off a triangle at the corner; its middle is as deep as the three faces.
      const double separation = gap > 0 ? gap : gap / std::sqrt(3.0);
      const double tolerance = gap > 0 ? 1e-14 : kFieldTolerance * 0.5 / 16;
      EXPECT_NEAR(deepest_of(manifolds_of(pair, options)), separation, tolerance) << x;
    }
  }
}

TEST(FieldDepth, ASampledSearchThatMissesReportsTheDistanceAndNotTheMargin) {
  const Shape<double> needle = field_of(make_box(Vec3d(0.003, 0.5, 0.003)), 64);
  CollideOptions options;
  options.margin = 0.0102;
  int missed = 0;
  for (int i = 0; i < 20; ++i) {
    const PlacedShapes pair{make_box(Vec3d(1, 0.1, 1)), test::at(0, 0.11, 0), needle,
                            test::at(0.031 * i, -0.5, 0.017 * i)};
    options.field = FieldSearch::Sampled;
    Manifolds<double> manifolds;
    trace::Pair record;
    collide<double>(pair.a, pair.pose_a, pair.b, pair.pose_b, options, manifolds, nullptr, &record);
    options.field = FieldSearch::Conservative;
    EXPECT_NEAR(deepest_of(manifolds_of(pair, options)), 0.01, 1e-14) << i;
    if (!manifolds.empty()) continue;
    ++missed;
    EXPECT_NEAR(record.separation, 0.01, 1e-14) << i;
  }
  EXPECT_GT(missed, 5);
}

}  // namespace
}  // namespace contactscope
