#include <gtest/gtest.h>

#include <cmath>

#include "manifold/placed_shapes.h"
#include "support/builders.h"

/// Small shapes on large ones get as many points as on shapes of their own size.
namespace contactscope {
namespace {

using test::about;
using test::kDegree;
using test::PlacedShapes;

template <class S> class LargeAndSmall : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(LargeAndSmall, Scalars);

struct Small {
  const char* name;
  Shape<double> shape;
  std::vector<Vec3d> lowest;  // contact places relative to its centre
};

std::vector<Small> small_shapes(double size) {
  const double down = -size;
  std::vector<Vec3d> corners;
  for (const double x : {-size, size})
    for (const double z : {-size, size}) corners.emplace_back(x, down, z);
  return {{"sphere", test::ball(size), {{0, down, 0}}},
          {"capsule", test::lying_capsule(size, size), {{-size, down, 0}, {size, down, 0}}},
          {"box", test::cube(size), corners}};
}

/// On the x-z plane, with the origin inside.
Shape<double> large_box(double reach) { return make_box(Vec3d(reach, 0.25, reach)); }
Shape<double> large_triangle(double reach) {
  return build_mesh({{-reach, 0, -reach}, {reach, 0, -reach}, {0, 0, reach}}, {{{0, 2, 1}}});
}

/// Expects a point at each lowest place of the small shape, and no others.
template <class S>
void expect_points_at(const Small& small, const PlacedShapes& pair, double size, double reach) {
  const Manifold<S> manifold = test::manifold_of<S>(pair);
  ASSERT_EQ(manifold.points.size(), small.lowest.size())
      << small.name << " of " << size << " on " << reach;
  for (const Vec3d& lowest : small.lowest) {
    const Vec3d place = pair.pose_a.transform(lowest);
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < manifold.points.size(); ++i)
      nearest = std::min(nearest, (test::position_of(manifold, i) - place).norm());
    // The depth is half a hundredth of the size; poses are rounded about a metre from the origin.
    EXPECT_LT(nearest, 0.011 * size + 4e-7) << small.name << " of " << size << " on " << reach;
  }
  for (const ContactPoint<S>& point : manifold.points)
    EXPECT_NEAR(point.separation, -0.01 * size, 4e-7) << small.name << size << ' ' << reach;
}

TYPED_TEST(LargeAndSmall, AsManyPointsOnAFloorOfAnySize) {
  using S = TypeParam;
  test::Random random(31);
  for (const double size : {0.01, 0.1, 1.0}) {
    for (double reach = 10; reach < 2e6; reach *= 3) {
      for (const Small& small : small_shapes(size)) {
        const PlacedShapes on_box{small.shape,
                                  {Quatd::Identity(), {0.31, 0.99 * size, 0.2}},
                                  large_box(reach),
                                  {Quatd::Identity(), {0, -0.25, 0}}};
        expect_points_at<S>(small, on_box, size, reach);
        if (reach * std::numeric_limits<S>::epsilon() > 1e-4 * size)
          expect_points_at<S>(small, test::moved(on_box, random.pose(1)), size, reach);
        // A triangle stays in float: the sides of a huge one are rounded by a capsule's length.
        if (reach * std::numeric_limits<S>::epsilon() > 3 * size) continue;
        PlacedShapes on_triangle = on_box;
        on_triangle.b = large_triangle(reach);
        on_triangle.pose_b = {};
        expect_points_at<S>(small, on_triangle, size, reach);
      }
    }
  }
}

// Turned by 20 degrees, two of the crate's corners overhang on each side of the beam: six points.
TYPED_TEST(LargeAndSmall, ABeamOfAnyLengthCutsOffWhatHangsOverItsSides) {
  using S = TypeParam;
  test::Random random(32);
  for (double reach = 10; reach < 2e6; reach *= 3) {
    for (const bool moved : {false, true}) {
      PlacedShapes pair{test::cube(0.5),
                        {about(Vec3d::UnitY(), 20 * kDegree), {0.31, 0.49, 0}},
                        make_box(Vec3d(reach, 0.5, 0.5)),
                        {Quatd::Identity(), {0, -0.5, 0}}};
      if (moved) pair = test::moved(pair, random.pose(1));
      const Manifold<S> manifold = test::manifold_of<S>(pair);
      ASSERT_EQ(manifold.points.size(), 6u) << reach;
      for (std::size_t i = 0; i < 6; ++i) {
        const Vec3d on_beam = pair.pose_b.inverse_transform(test::position_of(manifold, i));
        // Below a reach of 4000, float rounding of the beam's far corners counts.
        const double rounding = reach < 4000 ? 4 * std::numeric_limits<S>::epsilon() * reach : 0;
        EXPECT_LT(std::abs(on_beam.z()), 0.5 + 2e-6 + rounding) << reach;
        EXPECT_NEAR(manifold.points[i].separation, -0.01, 2e-6) << reach;
      }
    }
  }
}

// The same contact, recorded or not, in either order, reduced or not.
TYPED_TEST(LargeAndSmall, RecordMatchesTheResult) {
  using S = TypeParam;
  const PlacedShapes pair{test::cube(0.01),
                          {Quatd::Identity(), {0.31, 0.0099, 0.2}},
                          large_box(1e5),
                          {Quatd::Identity(), {0, -0.25, 0}}};
  for (const char* reducer : {"area", "none"}) {
    CollideOptions options;
    options.reducer = find_reducer(reducer);
    options.reduction.max_points = 3;
    const Manifold<S> manifold = test::manifold_of<S>(pair, options);
    EXPECT_EQ(manifold.points.size(), options.reducer == nullptr ? 4u : 3u);
    const trace::Pair record = test::record_of<S>(pair, options, {.sat = true, .clip = true});
    ASSERT_EQ(record.manifolds.size(), 1u);
    EXPECT_EQ(record.state, "touching");
    EXPECT_EQ(record.separation, static_cast<double>(test::deepest_of(manifold)));
    EXPECT_TRUE(record.sat.has_value() && record.clip.has_value());
    ASSERT_EQ(record.manifolds[0].points.size(), manifold.points.size());
    for (std::size_t i = 0; i < manifold.points.size(); ++i) {
      EXPECT_EQ(record.manifolds[0].points[i].position, test::position_of(manifold, i));
    }
    Manifold<S> back = test::manifold_of<S>({pair.b, pair.pose_b, pair.a, pair.pose_a}, options);
    EXPECT_EQ(back.points.size(), manifold.points.size());
  }
}

}  // namespace
}  // namespace contactscope
