#include "query/gjk.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "geometry/primitives.h"
#include "support/builders.h"
#include "support/random_geometry.h"

namespace contactscope {
namespace {

using test::at;

template <class S> Hull<S> box(double x, double y, double z) {
  return hull_cast<S>(make_box(Vec3d(x, y, z)));
}

template <class S>
GjkResult<S> distance(const Hull<S>& a, const Hull<S>& b, const Pose<double>& b_in_a) {
  return gjk(support_set(a), support_set(b), b_in_a.cast<S>());
}

template <class S> GjkResult<S> distance_to_point(const Hull<S>& a, const Vec3d& point) {
  const Vec3<S> centre = Vec3<S>::Zero();
  return gjk(support_set(a), support_set(centre), at(point.x(), point.y(), point.z()).cast<S>());
}

/// Number of distinct points of one shape in a simplex.
template <class S> std::size_t distinct(const GjkSimplex<S>& simplex, int GjkVertex<S>::*index) {
  std::set<int> points;
  for (const GjkVertex<S>& vertex : simplex.vertices) points.insert(vertex.*index);
  return points.size();
}

template <class S> class Gjk : public testing::Test {
 protected:
  static constexpr double kUlp = static_cast<double>(std::numeric_limits<S>::epsilon());

  static void expect_near(const Vec3<S>& found, const Vec3d& expected, double tolerance) {
    EXPECT_LE((found.template cast<double>() - expected).norm(), tolerance)
        << "found " << found.transpose() << ", expected " << expected.transpose();
  }
};

using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Gjk, Scalars);

TYPED_TEST(Gjk, PointsAreAsFarAsTheyAre) {
  using S = TypeParam;
  const Vec3<S> a(1, 2, 3), b(0, 0, 0);
  const GjkResult<S> result = gjk(support_set(a), support_set(b), at(1, 5, 7).cast<S>());
  EXPECT_EQ(result.status, GjkStatus::Separated);
  EXPECT_EQ(result.distance, S(5));
  EXPECT_EQ(result.on_a, a);
  EXPECT_EQ(result.on_b, Vec3<S>(1, 5, 7));
  this->expect_near(result.normal, {0, 0.6, 0.8}, 2 * this->kUlp);
}

TYPED_TEST(Gjk, EqualPointsTouch) {
  using S = TypeParam;
  const Vec3<S> point(1, 2, 3);
  const GjkResult<S> result = gjk(support_set(point), support_set(point), Pose<S>{});
  EXPECT_EQ(result.status, GjkStatus::Touching);
  EXPECT_EQ(result.distance, S(0));
  const Vec3<S> origin = Vec3<S>::Zero();
  EXPECT_EQ(gjk(support_set(origin), support_set(origin), Pose<S>{}).status, GjkStatus::Touching);
}

TYPED_TEST(Gjk, PointAboveFaceEdgeAndCornerHasTheFeature) {
  using S = TypeParam;
  const Hull<S> cube = box<S>(1, 1, 1);
  const GjkResult<S> face = distance_to_point(cube, {0.25, 0.5, 3});
  EXPECT_EQ(face.status, GjkStatus::Separated);
  EXPECT_EQ(face.distance, S(2));
  EXPECT_EQ(face.normal, Vec3<S>(0, 0, 1));
  EXPECT_EQ(distinct(face.simplex, &GjkVertex<S>::index_a), 3u);
  EXPECT_EQ(distinct(face.simplex, &GjkVertex<S>::index_b), 1u);
  this->expect_near(face.on_a, {0.25, 0.5, 1}, 4 * this->kUlp);

  const GjkResult<S> edge = distance_to_point(cube, {0.25, 4, 5});
  EXPECT_EQ(distinct(edge.simplex, &GjkVertex<S>::index_a), 2u);
  EXPECT_EQ(edge.distance, S(5));
  this->expect_near(edge.normal, {0, 0.6, 0.8}, 4 * this->kUlp);
  this->expect_near(edge.on_a, {0.25, 1, 1}, 4 * this->kUlp);

  const GjkResult<S> corner = distance_to_point(cube, {2, 3, 3});
  EXPECT_EQ(distinct(corner.simplex, &GjkVertex<S>::index_a), 1u);
  EXPECT_EQ(corner.simplex.vertices[0].index_a, 7);
  EXPECT_EQ(corner.distance, S(3));
  EXPECT_EQ(corner.on_a, Vec3<S>(1, 1, 1));
}

TYPED_TEST(Gjk, PointInsideACubeOverlapsWithACommonPoint) {
  using S = TypeParam;
  const Hull<S> cube = box<S>(1, 1, 1);
  test::Random random(4);
  for (int i = 0; i < 200; ++i) {
    const Vec3d point(random.uniform(-0.99, 0.99), random.uniform(-0.99, 0.99),
                      random.uniform(-0.99, 0.99));
    const GjkResult<S> result = distance_to_point(cube, point);
    EXPECT_EQ(result.status, GjkStatus::Overlap) << point.transpose();
    EXPECT_EQ(result.distance, S(0));
    EXPECT_EQ(result.simplex.vertices.size(), 4u);
    this->expect_near(result.on_a, point, 8 * this->kUlp);
    this->expect_near(result.on_b, point, 8 * this->kUlp);
  }
}

TYPED_TEST(Gjk, PointInTheMiddleOfACubeIsNotSeparated) {
  using S = TypeParam;
  // On diagonals and faces of many simplices: either status means that the point is inside.
  const GjkResult<S> result = distance_to_point(box<S>(1, 1, 1), {0, 0, 0});
  EXPECT_TRUE(result.status == GjkStatus::Overlap || result.status == GjkStatus::Touching);
  EXPECT_LE(result.distance, S(4 * this->kUlp));
}

TYPED_TEST(Gjk, CubesFaceToFaceKeepTheirGapAtEveryScale) {
  using S = TypeParam;
  for (double size = 1e-18; size < 2e17; size *= 100) {
    for (double gap = 1e-1; gap > 1e3 * this->kUlp; gap *= 0.1) {
      const Hull<S> cube = box<S>(size, size, size);
      const GjkResult<S> result =
          distance(cube, cube, at(0.3 * size, (2 + gap) * size, -0.2 * size));
      EXPECT_EQ(result.status, GjkStatus::Separated) << size << " " << gap;
      EXPECT_NEAR(static_cast<double>(result.distance), gap * size, 8 * this->kUlp * size);
      EXPECT_EQ(result.normal, Vec3<S>(0, 1, 0)) << size << " " << gap;
    }
  }
}

TYPED_TEST(Gjk, CubesThatTouchAreTouching) {
  using S = TypeParam;
  const Hull<S> cube = box<S>(0.5, 0.5, 0.5);
  EXPECT_EQ(distance(cube, cube, at(0.25, 1, 0.125)).status, GjkStatus::Touching) << "faces";
  EXPECT_EQ(distance(cube, cube, at(0.25, 1, 1)).status, GjkStatus::Touching) << "edges";
  EXPECT_EQ(distance(cube, cube, at(1, 1, 1)).status, GjkStatus::Touching) << "corners";
}

TYPED_TEST(Gjk, CubesThatOverlapAreNeverSeparated) {
  using S = TypeParam;
  const Hull<S> cube = box<S>(0.5, 0.5, 0.5);
  test::Random random(5);
  for (int i = 0; i < 500; ++i) {
    // From a small fraction of the side in common to coincidence, level or turned.
    const double shift = 1 - random.decade(-5, 0);
    Pose<double> pose = at(0, shift, 0);
    if (i % 2 == 0) pose.rotation = test::about(Vec3d::UnitY(), random.decade(-9, 0));
    const GjkResult<S> result = distance(cube, cube, pose);
    EXPECT_TRUE(result.status == GjkStatus::Overlap || result.status == GjkStatus::Touching)
        << shift << " " << to_string(result.status);
  }
}

TYPED_TEST(Gjk, NearlyParallelFacesKeepGapAndNormal) {
  using S = TypeParam;
  const Hull<S> table = box<S>(0.5, 0.5, 0.5);
  const Hull<S> cube = box<S>(0.25, 0.25, 0.25);
  for (double tilt = 1e-12; tilt < 0.2; tilt *= 10) {
    Pose<double> pose{test::about(Vec3d(1, 0, 0.3), tilt), {0.1, 0, 0.2}};
    // The lowest corner of the cube is 1 mm above the table.
    double lowest = 0;
    for (const Vec3<S>& vertex : cube.vertices) {
      lowest = std::min(lowest, pose.rotate(vertex.template cast<double>()).y());
    }
    pose.position.y() = 0.5 - lowest + 1e-3;
    const GjkResult<S> result = distance(table, cube, pose);
    EXPECT_EQ(result.status, GjkStatus::Separated);
    EXPECT_NEAR(static_cast<double>(result.distance), 1e-3, 8 * this->kUlp) << tilt;
    // Faces that are parallel up to rounding have two normals.
    this->expect_near(result.normal, {0, 1, 0}, 20 * this->kUlp);
  }
}

TYPED_TEST(Gjk, DistantAndOfDifferentSize) {
  using S = TypeParam;
  const Hull<S> large = box<S>(1e4, 1e4, 1e4);
  const Hull<S> small = box<S>(1e-4, 1e-4, 1e-4);
  const GjkResult<S> near_by = distance(large, small, at(5e3, 1e4 + 1, 0));
  EXPECT_EQ(near_by.status, GjkStatus::Separated);
  EXPECT_NEAR(static_cast<double>(near_by.distance), 1 - 1e-4, 4 * this->kUlp * 2e4);
  EXPECT_EQ(near_by.normal, Vec3<S>(0, 1, 0));
  const GjkResult<S> far_off = distance(small, small, at(0, 0, 1e6));
  EXPECT_NEAR(static_cast<double>(far_off.distance), 1e6 - 2e-4, 4 * this->kUlp * 1e6);
  EXPECT_EQ(distance(large, small, at(3e3, 2e3, 1e3)).status, GjkStatus::Overlap);
}

TYPED_TEST(Gjk, DuplicateCollinearAndCoplanarPointsAreFine) {
  using S = TypeParam;
  // A square of 25 points, each of them twice.
  std::vector<Vec3<S>> square;
  for (int copy = 0; copy < 2; ++copy) {
    for (int i = 0; i < 25; ++i) square.emplace_back(S(i % 5 - 2), S(0), S(i / 5 - 2));
  }
  std::vector<Vec3<S>> line;
  for (int i = 0; i < 10; ++i) line.emplace_back(S(i % 5), S(0), S(0));
  const SupportSet<S> square_set{square.data(), static_cast<int>(square.size()), nullptr};
  const SupportSet<S> line_set{line.data(), static_cast<int>(line.size()), nullptr};

  const GjkResult<S> above = gjk(square_set, line_set, at(-1, 0.5, 0.25).cast<S>());
  EXPECT_EQ(above.status, GjkStatus::Separated);
  EXPECT_EQ(above.distance, S(0.5));
  const GjkResult<S> shifted = gjk(square_set, line_set, at(5, 0, 0).cast<S>());
  EXPECT_EQ(shifted.distance, S(3));
  const GjkResult<S> within = gjk(square_set, line_set, at(-1, 0, 0.25).cast<S>());
  EXPECT_EQ(within.status, GjkStatus::Touching);
  const GjkResult<S> same = gjk(square_set, square_set, Pose<S>{});
  EXPECT_EQ(same.status, GjkStatus::Touching);
}

TYPED_TEST(Gjk, SegmentsCrossingAndPassing) {
  using S = TypeParam;
  const Vec3<S> ends[2] = {Vec3<S>(-1, 0, 0), Vec3<S>(1, 0, 0)};
  Pose<S> pose;
  pose.rotation = test::about(Vec3d::UnitY(), 1.0).cast<S>();
  EXPECT_EQ(gjk(support_set(ends), support_set(ends), pose).status, GjkStatus::Touching);
  pose.position = Vec3<S>(S(0.25), 2, 0);
  const GjkResult<S> above = gjk(support_set(ends), support_set(ends), pose);
  EXPECT_EQ(above.status, GjkStatus::Separated);
  EXPECT_NEAR(static_cast<double>(above.distance), 2, 4 * this->kUlp);
  this->expect_near(above.normal, {0, 1, 0}, 4 * this->kUlp);
  EXPECT_EQ(distinct(above.simplex, &GjkVertex<S>::index_a), 2u);
  EXPECT_EQ(distinct(above.simplex, &GjkVertex<S>::index_b), 2u);
}

TYPED_TEST(Gjk, SegmentOfLengthZeroIsAPoint) {
  using S = TypeParam;
  const Vec3<S> ends[2] = {Vec3<S>(0, 3, 0), Vec3<S>(0, 3, 0)};
  const GjkResult<S> result = gjk(support_set(box<S>(1, 1, 1)), support_set(ends), Pose<S>{});
  EXPECT_EQ(result.status, GjkStatus::Separated);
  EXPECT_EQ(result.distance, S(2));
}

/// Above a face the normal is the triangle's, exact even at a separation of a hundred roundings.
TYPED_TEST(Gjk, NormalOfASmallGapIsThatOfTheFace) {
  using S = TypeParam;
  test::Random random(7);
  for (int i = 0; i < 200; ++i) {
    const Hull<double> exact = test::random_hull(random, 20, 1, 1);
    const auto face = static_cast<std::size_t>(random.index(exact.face_count()));
    const std::vector<int> corners = face_vertices(exact, static_cast<int>(face));
    Vec3d middle = Vec3d::Zero();
    for (const int corner : corners) {
      middle +=
          exact.vertices[static_cast<std::size_t>(corner)] / static_cast<double>(corners.size());
    }
    const Vec3d normal = exact.planes[face].normal;
    const GjkResult<S> result =
        distance_to_point(hull_cast<S>(exact), middle + 100 * this->kUlp * normal);
    ASSERT_EQ(result.status, GjkStatus::Separated);
    // The normals of small triangles on the sphere are less exact.
    this->expect_near(result.normal, normal, 1000 * this->kUlp);
  }
}

TYPED_TEST(Gjk, SimplexOfOtherShapesIsNoWarmStart) {
  using S = TypeParam;
  const Hull<S> cube = box<S>(1, 1, 1);
  GjkSimplex<S> foreign;
  foreign.weights = {};
  foreign.vertices.push_back({12, 0, Vec3<S>::Zero(), Vec3<S>::Zero()});
  const Pose<S> pose = at(0, 3, 0).cast<S>();
  const GjkResult<S> result = gjk(support_set(cube), support_set(cube), pose, &foreign);
  EXPECT_EQ(result.distance, S(1));
}

TYPED_TEST(Gjk, LastSimplexEndsTheSameQueryAtOnce) {
  using S = TypeParam;
  const Hull<S> cube = box<S>(1, 1, 1);
  const Pose<S> pose = Pose<double>{test::about({1, 2, 3}, 1), {1, 4, 0.5}}.cast<S>();
  const GjkResult<S> cold = gjk(support_set(cube), support_set(cube), pose);
  const GjkResult<S> warm = gjk(support_set(cube), support_set(cube), pose, &cold.simplex);
  EXPECT_GT(cold.iterations, 1);
  EXPECT_EQ(warm.iterations, 1);
  EXPECT_NEAR(static_cast<double>(warm.distance), static_cast<double>(cold.distance),
              4 * this->kUlp);
}

}  // namespace
}  // namespace contactscope
