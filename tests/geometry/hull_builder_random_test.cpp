#include <gtest/gtest.h>

#include <cstddef>
#include <functional>
#include <ostream>
#include <string>

#include "geometry/hull_builder.h"
#include "geometry/hull_checks.h"
#include "geometry/point_sets.h"
#include "geometry/qhull_oracle.h"

namespace contactscope::test {
namespace {

// How many tolerances a point may be above a plane; the builder promises "a small multiple".
constexpr double kSlack = 10;

// Directions spread over the sphere.
Points directions() {
  Generator random(7);
  return on_sphere(random, 200);
}

/// Checks the properties of every hull, and compares volume and area with libqhull. A sharp rim may
/// be cut back by `lateral` metres.
void expect_hull_as_qhull(const Points& points, double lateral) {
  const Hull<double> hull = build_hull(points);
  const double slack = kSlack * hull_tolerance(points);
  ASSERT_TRUE(is_sound(hull));
  ASSERT_TRUE(is_convex(hull, slack));
  const QhullAnswer qhull = run_qhull(points);
  const Measures measures = measure(hull);
  EXPECT_NEAR(measures.volume, qhull.volume, qhull.area * slack);
  EXPECT_NEAR(measures.area, qhull.area, 1e-4 * qhull.area + 8 * (slack + lateral));
  EXPECT_LE(support_error(hull, points, directions()), 2 * slack + lateral);
  for (const Plane<double>& plane : hull.planes) {
    for (const Vec3d& point : points) ASSERT_LE(plane.distance(point), slack);
  }
}

struct PointSet {
  std::string name;
  std::function<Points(Generator&)> make;
  double lateral = 0;
};

void PrintTo(const PointSet& set, std::ostream* out) { *out << set.name; }

class HullOfRandomPoints : public ::testing::TestWithParam<PointSet> {};

TEST_P(HullOfRandomPoints, SlowAgreesWithQhull) {
  Generator random(1);
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE("set " + std::to_string(i));
    expect_hull_as_qhull(without_repeats(GetParam().make(random)), GetParam().lateral);
    if (HasFatalFailure()) return;
  }
}

int a_few_to(Generator& random, int most) {
  return 4 + static_cast<int>(random() % static_cast<unsigned>(most - 3));
}

Points turned(Generator& random, const Points& points) {
  return transformed(points, random_rotation(random), 1, Vec3d::Zero());
}

Points with_noise(Generator& random, const Points& points, double size) {
  const Points noise = in_box(random, static_cast<int>(points.size()), Vec3d::Constant(size));
  Points noisy = points;
  for (std::size_t i = 0; i < noisy.size(); ++i) noisy[i] += noise[i];
  return noisy;
}

Points grid(Generator& random) { return box_grid(1 + static_cast<int>(random() % 6)); }

Points flattened(Points points, double height) {
  for (Vec3d& point : points) point.y() *= height;
  return points;
}

INSTANTIATE_TEST_SUITE_P(
    PointSets, HullOfRandomPoints,
    ::testing::Values(
        PointSet{"four_to_ten_in_a_ball", [](Generator& r) { return in_ball(r, a_few_to(r, 10)); }},
        PointSet{"in_a_ball", [](Generator& r) { return in_ball(r, a_few_to(r, 400)); }},
        PointSet{"on_a_sphere", [](Generator& r) { return on_sphere(r, a_few_to(r, 300)); }},
        PointSet{"gaussian", [](Generator& r) { return gaussian(r, a_few_to(r, 600)); }},
        PointSet{"in_a_box",
                 [](Generator& r) {
                   return in_box(r, a_few_to(r, 500), {1, 0.1, 0.5});
                 }},
        PointSet{"grid", [](Generator& r) { return grid(r); }},
        PointSet{"grid_turned", [](Generator& r) { return turned(r, grid(r)); }},
        PointSet{"grid_turned_in_float",
                 [](Generator& r) { return rounded_to_float(turned(r, grid(r))); }},
        PointSet{"grid_turned_in_two_decimals",
                 [](Generator& r) { return rounded_to_decimals(turned(r, grid(r)), 2); }},
        PointSet{"grid_turned_in_five_decimals",
                 [](Generator& r) { return rounded_to_decimals(turned(r, grid(r)), 5); }},
        PointSet{"grid_with_noise_of_the_tolerance",
                 [](Generator& r) { return with_noise(r, grid(r), 1e-6); }},
        PointSet{"grid_with_noise_above_the_tolerance",
                 [](Generator& r) { return with_noise(r, grid(r), 5e-6); }},
        PointSet{"grid_far_away_in_float",
                 [](Generator& r) {
                   return rounded_to_float(
                       transformed(grid(r), random_rotation(r), 1, Vec3d(100, -50, 30)));
                 }},
        PointSet{"ball_very_far_away",
                 [](Generator& r) {
                   return transformed(in_ball(r, 100), random_rotation(r), 1,
                                      Vec3d(1e6, -2e6, 3e6));
                 }},
        PointSet{"slab_of_aspect_1e4",
                 [](Generator& r) {
                   return turned(r, in_box(r, a_few_to(r, 400), {1, 1e-4, 1}));
                 }},
        PointSet{"needle_of_aspect_1e4",
                 [](Generator& r) {
                   return turned(r, in_box(r, a_few_to(r, 400), {1, 1e-4, 1e-4}));
                 }},
        PointSet{"lens_of_aspect_1e5",
                 [](Generator& r) { return turned(r, flattened(on_sphere(r, 300), 1e-5)); }, 0.003},
        PointSet{"prism_turned_in_float",
                 [](Generator& r) {
                   return rounded_to_float(turned(r, prism(3 + static_cast<int>(r() % 100))));
                 }},
        PointSet{"globe_turned_in_four_decimals",
                 [](Generator& r) { return rounded_to_decimals(turned(r, globe(12, 24)), 4); }}),
    [](const auto& parameter) { return parameter.param.name; });

TEST(BuildHull, PointsInGeneralPositionHaveTheVerticesOfQhull) {
  Generator random(2);
  for (int i = 0; i < 60; ++i) {
    const Points points = i % 3 == 0   ? in_ball(random, 200)
                          : i % 3 == 1 ? gaussian(random, 200)
                                       : in_box(random, 200, Vec3d(1, 2, 3));
    Points expected;
    for (const int vertex : run_qhull(points).vertices) {
      expected.push_back(points[static_cast<std::size_t>(vertex)]);
    }
    EXPECT_EQ(build_hull(points).vertices, expected) << "set " << i;
  }
}

TEST(BuildHull, ScaleDoesNotChangeTheTopology) {
  Generator random(3);
  const Points points = in_ball(random, 80);
  const std::vector<int> sizes = face_sizes(build_hull(points));
  for (const double scale : {1e-30, 1e-4, 1e-2, 1e2, 1e4, 1e30}) {
    const Points scaled = transformed(points, Mat3<double>::Identity(), scale, Vec3d::Zero());
    const Hull<double> hull = build_hull(scaled);
    EXPECT_TRUE(is_sound(hull)) << scale;
    EXPECT_TRUE(is_convex(hull, kSlack * hull_tolerance(scaled))) << scale;
    EXPECT_EQ(face_sizes(hull), sizes) << scale;
  }
}

TEST(BuildHull, APowerOfTwoInScaleIsExact) {
  Generator random(4);
  const Points points = rounded_to_float(turned(random, globe(8, 12)));
  const double scale = 0x1p-13;
  const Hull<double> one = build_hull(points);
  const Hull<double> small =
      build_hull(transformed(points, Mat3<double>::Identity(), scale, Vec3d::Zero()));
  ASSERT_EQ(small.face_count(), one.face_count());
  EXPECT_EQ(small.centroid, Vec3d(scale * one.centroid));
  for (std::size_t i = 0; i < one.planes.size(); ++i) {
    EXPECT_EQ(small.planes[i].normal, one.planes[i].normal);
    EXPECT_EQ(small.planes[i].offset, scale * one.planes[i].offset);
  }
}

TEST(BuildHull, TheOrderOfThePointsDoesNotMatterInGeneralPosition) {
  Generator random(5);
  const Points points = in_ball(random, 100);
  Points reversed(points.rbegin(), points.rend());
  EXPECT_EQ(face_sizes(build_hull(points)), face_sizes(build_hull(reversed)));
  EXPECT_NEAR(measure(build_hull(points)).volume, measure(build_hull(reversed)).volume, 1e-12);
}

TEST(BuildHull, SlowAHundredThousandPointsOnASphereAreConvex) {
  Generator random(6);
  const Points points = on_sphere(random, 100000);
  const Hull<double> hull = build_hull(points);
  EXPECT_TRUE(is_sound(hull));
  const QhullAnswer qhull = run_qhull(points);
  const Measures measures = measure(hull);
  EXPECT_NEAR(measures.volume, qhull.volume, 1e-5 * qhull.volume);
  EXPECT_NEAR(measures.area, qhull.area, 1e-5 * qhull.area);
  EXPECT_LE(support_error(hull, points, directions()), kSlack * hull_tolerance(points));
}

}  // namespace
}  // namespace contactscope::test
