#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "continuous/impact_with_mesh.h"
#include "geometry/mesh.h"
#include "support/brute_force_distance.h"
#include "support/cases.h"
#include "support/exact_triangles.h"
#include "support/random_geometry.h"

/// Triangles without area, at any time of the step, meet others as segments and points.
namespace contactscope {
namespace {

using test::Extended;
using test::Random;
using Corners = Triangle<double>;

constexpr int kLooks = 32;

/// Multiples of kLooks: corners are integers at kLooks evenly spaced times of the step.
Vec3d integers(Random& random, double reach) {
  return kLooks * Vec3d(random.vector(-reach, reach).array().round());
}

/// Three corners exactly on a line or in one place.
Corners flat_corners(Random& random, double between) {
  const Vec3d from = integers(random, 4);
  const Vec3d step = random.chance(0.3) ? Vec3d(Vec3d::Zero()) : integers(random, 2);
  return {from, from + between * step, from + 2 * step};
}

/// A triangle's corners at time 0 and at time 1.
struct MovingTriangle {
  Corners start, end;

  Corners at_time(double time) const {
    Corners corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = start[i] + time * (end[i] - start[i]);
    return corners;
  }
};

MovingTriangle random_triangle(Random& random, bool flat) {
  const auto any = [&]() -> Corners {
    return {integers(random, 4), integers(random, 4), integers(random, 4)};
  };
  const double between = random.index(3);
  MovingTriangle moving;
  moving.start = flat && random.chance(0.8) ? flat_corners(random, between) : any();
  if (random.chance(0.3)) {  // it moves without deforming
    const Vec3d offset = integers(random, 6);
    for (std::size_t i = 0; i < 3; ++i) moving.end[i] = moving.start[i] + offset;
  } else {
    moving.end = flat && random.chance(0.8) ? flat_corners(random, between) : any();
  }
  return moving;
}

test::Features features_of(const Corners& corners) {
  return test::features_of_triangle(
      {corners[0].cast<Extended>(), corners[1].cast<Extended>(), corners[2].cast<Extended>()});
}

template <class S>
MeshImpact impact_of(const MovingTriangle& a, const MovingTriangle& b, double unit) {
  struct Scaled {
    Scaled(const MovingTriangle& moving, double by) {
      for (std::size_t i = 0; i < 3; ++i) {
        start.emplace_back(by * moving.start[i]);
        end.emplace_back((by * moving.end[i]).template cast<S>());
      }
      mesh = mesh_cast<S>(build_mesh_with_flat_triangles(start, {{0, 1, 2}}));
    }
    std::vector<Vec3d> start;
    std::vector<Vec3<S>> end;
    Mesh<S> mesh;
  };
  const Scaled of_a(a, unit), of_b(b, unit);
  return impact_of_meshes<S>({of_a.mesh, of_a.end}, {of_b.mesh, of_b.end});
}

template <class S> void are_never_met_late(int cases) {
  Random random(91);
  int hits = 0, overlapping = 0, separated = 0;
  for (int i = 0; i < cases; ++i) {
    const MovingTriangle a = random_triangle(random, true),
                         b = random_triangle(random, random.chance(0.4));
    const MeshImpact found = impact_of<S>(a, b, std::ldexp(1.0, random.index(28) - 17));
    int first = 0;  // first look with a shared point
    const auto overlaps = [&](double time) {
      return test::exact_triangle_overlap(a.at_time(time), b.at_time(time)).kind !=
             TriangleOverlapKind::None;
    };
    while (first <= kLooks && !overlaps(1.0 * first / kLooks)) ++first;
    ASSERT_EQ(found.impact.status == FeatureStatus::Overlapping, first == 0) << i;
    if (first == 0) {
      ++overlapping;
      continue;
    }
    if (found.impact.status == FeatureStatus::Separated) {
      ASSERT_EQ(first, kLooks + 1) << i;
      ++separated;
      continue;
    }
    ++hits;
    ASSERT_LE(found.impact.begin, 1.0 * first / kLooks) << i;
    const double distance =
        static_cast<double>(test::brute_force_distance(features_of(a.at_time(found.impact.begin)),
                                                       features_of(b.at_time(found.impact.begin)))
                                .distance);
    ASSERT_LT(distance, 4e-11) << i;
  }
  EXPECT_GT(hits, cases / 10);
  EXPECT_GT(separated, cases / 10);
  EXPECT_GT(overlapping, cases / 50);
}

TEST(FlatTrianglesImpact, SlowTheyAreNeverMetLateByExactRationals) {
  are_never_met_late<double>(test::cases(1500));
  are_never_met_late<float>(test::cases(1500));
}

// Its lower end meets the wall at half of the step, and its middle corner is always on it.
TEST(FlatTrianglesImpact, ANeedleFallsOnAWall) {
  const MovingTriangle wall{{Vec3d(0, 0, 0), Vec3d(1, 0, 0), Vec3d(0, 0, 1)},
                            {Vec3d(0, 0, 0), Vec3d(1, 0, 0), Vec3d(0, 0, 1)}};
  const MovingTriangle needle{{Vec3d(0.2, 1, 0.2), Vec3d(0.2, 1.5, 0.2), Vec3d(0.2, 1.25, 0.2)},
                              {Vec3d(0.2, -1, 0.2), Vec3d(0.2, -0.5, 0.2), Vec3d(0.2, -0.75, 0.2)}};
  for (const double unit : {0x1p-13, 1.0, 0x1p13}) {
    const MeshImpact found = impact_of<double>(needle, wall, unit);
    EXPECT_EQ(found.impact.status, FeatureStatus::Hit);
    EXPECT_NEAR(found.impact.begin, 0.5, 1e-13);
    EXPECT_LE(found.impact.begin, 0.5);
    EXPECT_EQ(found.feature_a, 0);
    EXPECT_FALSE(found.is_edges);
  }
}

}  // namespace
}  // namespace contactscope
