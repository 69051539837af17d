#include "manifold/merge_triangles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "core/convex_polygon.h"
#include "geometry/primitives.h"
#include "manifold/placed_shapes.h"
#include "support/builders.h"
#include "support/cases.h"

namespace contactscope {
namespace {

using test::about;
using test::at;
using test::deepest_of;
using test::manifolds_of;
using test::PlacedShapes;

CollideOptions options_for(MeshManifolds manifolds) {
  CollideOptions options;
  options.mesh_manifolds = manifolds;
  options.reducer = find_reducer(kDefaultReducer);
  return options;
}
const CollideOptions kMerged = options_for(MeshManifolds::Pair);
const CollideOptions kByTriangle = options_for(MeshManifolds::Triangle);

template <class S> int points_in(const Manifolds<S>& manifolds) {
  int points = 0;
  for (const Manifold<S>& manifold : manifolds) points += static_cast<int>(manifold.points.size());
  return points;
}

/// Distance of the nearest point in position, normal and separation; lengths in units of `size`.
double distance_to(const Manifolds<double>& manifolds, const Manifold<double>& of,
                   const ContactPoint<double>& point, double size) {
  double least = 1e9;
  for (const Manifold<double>& manifold : manifolds)
    for (const ContactPoint<double>& other : manifold.points)
      least = std::min(least, (manifold.normal - of.normal).norm() +
                                  (other.position - point.position).norm() / size +
                                  std::abs(other.separation - point.separation) / size);
  return least;
}

// A box of 1 m, 2 mm deep in triangles of 10 cm, at all scales: as on a plane.
template <class S> void expect_four_corners(test::Random& random, double size, double rounding) {
  const Mesh<double> floor = make_grid(4 * size, 4 * size, 40, 40, 0);
  const Vec3d half = size * Vec3d(0.5, random.uniform(0.1, 0.6), random.uniform(0.2, 0.7));
  Pose<double> pose{about(Vec3d::UnitY(), random.uniform(0, 7)), random.level(size, 0)};
  pose.position.y() = half.y() - 0.002 * size;
  const Pose<double> by = random.pose(size);
  const PlacedShapes pair = test::moved({make_box(half), pose, floor, {}}, by);
  const Manifolds<S> manifolds = manifolds_of<S>(pair, kMerged);
  ASSERT_EQ(manifolds.size(), 1u) << size;
  ASSERT_EQ(manifolds[0].points.size(), 4u) << size;
  EXPECT_EQ(manifolds[0].triangle, -1);
  EXPECT_LT((test::normal_of(manifolds[0]) + by.rotate(Vec3d::UnitY())).norm(), rounding);
  for (const double x : {-1.0, 1.0})
    for (const double z : {-1.0, 1.0}) {
      Vec3d corner = pose.transform(Vec3d(x * half.x(), -half.y(), z * half.z()));
      corner.y() = 0;
      EXPECT_LT(test::distance_to_nearest(manifolds[0], by.transform(corner)), rounding * size);
    }
  for (const ContactPoint<S>& point : manifolds[0].points)
    EXPECT_NEAR(static_cast<double>(point.separation), -0.002 * size, rounding * size);
}

TEST(MergeTriangles, ABoxOnAFineFloorHasItsFourCorners) {
  test::Random random(370);
  for (const double size : {1e-4, 1e-2, 1.0, 1e2, 1e4})
    for (int i = 0; i < test::cases(20); ++i) {
      expect_four_corners<float>(random, size, 1e-5);
      expect_four_corners<double>(random, size, 1e-13);
    }
}

struct Slider {
  const char* name;
  Shape<double> shape;
  double height;  // of its centre when it rests on the floor
  std::size_t points;
};

std::vector<Slider> merge_sliders() {
  return {{"sphere", test::ball(0.4), 0.4, 1},
          {"box", test::cube(0.4), 0.4, 4},
          {"lying capsule", test::lying_capsule(0.5, 0.2), 0.2, 2},
          {"upright capsule", test::upright_capsule(0.5, 0.2), 0.7, 1},
          {"cylinder", make_cylinder(0.4, 0.3, 12), 0.3, 4}};
}

// 1 m in 60 steps over triangles of 10 cm; the shape turns slowly.
TEST(MergeTriangles, IdsPersistWhileAShapeSlidesOverTheTrianglesOfAFloor) {
  const Mesh<double> floor = make_grid(4, 4, 40, 40, 0);
  for (const Slider& slider : merge_sliders()) {
    int kept = 0, all = 0;
    std::set<std::string> before;
    for (int step = 0; step <= 60; ++step) {
      Pose<double> pose = at(-0.5 + step / 60.0, slider.height - 0.004, 0.013 + 0.003 * step);
      pose.rotation = about(Vec3d::UnitY(), 0.3 + 0.001 * step);
      const Manifolds<double> manifolds = manifolds_of({slider.shape, pose, floor, {}}, kMerged);
      ASSERT_EQ(manifolds.size(), 1u) << slider.name << step;
      ASSERT_EQ(manifolds[0].points.size(), slider.points) << slider.name << step;
      std::set<std::string> now;
      for (const std::string& id : test::ids_of(manifolds[0])) now.insert(id);
      ASSERT_EQ(now.size(), slider.points) << slider.name << step;
      for (const std::string& id : now) kept += before.contains(id) ? 1 : 0;
      if (step > 0) all += static_cast<int>(now.size());
      before = now;
    }
    EXPECT_GE(kept, 0.95 * all) << slider.name;
  }
}

PlacedShapes random_on_terrain(test::Random& random, const Mesh<double>& terrain, double size) {
  const int kind = random.index(4);
  const double large = size * random.uniform(0.1, 0.5), small = size * random.uniform(0.05, 0.2);
  const Shape<double> shape = kind == 0   ? test::ball(large)
                              : kind == 1 ? test::lying_capsule(large, small)
                              : kind == 2 ? Shape<double>(test::random_box(random, large, 3))
                                          : Shape<double>(test::random_hull(random, 20, large, 3));
  Pose<double> pose{random.rotation(), random.level(size, 0)};
  pose.position.y() = size * random.uniform(-0.3, 0.6);
  return test::moved({shape, pose, terrain, {}}, random.pose(size));
}

// The contacts of single triangles are the oracle: nothing is invented, the deepest point stays, and
// so does every direction unless there are too many.
TEST(MergeTriangles, OnATerrainTheyKeepTheDeepestPointAndInventNone) {
  test::Random random(371);
  int merged = 0, limited = 0;
  for (const double size : {1e-4, 1.0, 1e4}) {
    const Mesh<double> terrain = make_grid(4 * size, 4 * size, 24, 24, 0.3 * size);
    for (int i = 0; i < test::cases(400); ++i) {
      const PlacedShapes pair = random_on_terrain(random, terrain, size);
      const Manifolds<double> triangles = manifolds_of(pair, kByTriangle);
      const Manifolds<double> found = manifolds_of(pair, kMerged);
      ASSERT_EQ(found.empty(), triangles.empty()) << i;
      if (found.empty()) continue;
      ASSERT_NEAR(deepest_of(found), deepest_of(triangles), 1e-14 * size) << i;
      ASSERT_LE(points_in(found), 12) << i;
      for (const Manifold<double>& manifold : found) {
        ASSERT_FALSE(manifold.points.empty()) << i;
        ASSERT_LE(manifold.points.size(), 4u) << i;
      }
      for (const Manifold<double>& manifold : triangles) {
        double nearest = 2;
        for (const Manifold<double>& other : found)
          nearest = std::min(nearest, (other.normal - manifold.normal).norm());
        if (points_in(found) < 12) {
          ASSERT_LE(nearest, 2 * std::sin(kFlatEdgeAngle / 2) + 1e-14) << i;
        } else {
          ++limited;
        }
      }
      merged += triangles.size() > found.size() ? 1 : 0;
    }
  }
  EXPECT_GT(merged, 100 / test::kOneIn);
  EXPECT_GT(limited, 100 / test::kOneIn);
}

TEST(MergeTriangles, SlowWithoutAReducerEveryPointOfEveryTriangleRemains) {
  test::Random random(372);
  CollideOptions every = kByTriangle, merged = kMerged;
  const ReducerInfo* const none = find_reducer("none");
  every.reducer = merged.reducer = none;
  ASSERT_EQ(none, nullptr);
  int most = 0;
  // Flat, so that a merged point keeps its normal and depth.
  const Mesh<double> floor = make_grid(4, 4, 40, 40, 0);
  for (int i = 0; i < test::cases(25); ++i) {
    const double half = random.uniform(0.1, 0.9);
    Pose<double> pose{about(Vec3d::UnitY(), random.uniform(0, 7)), random.level(1, half - 0.001)};
    const PlacedShapes pair = test::moved({test::cube(half), pose, floor, {}}, random.pose(1));
    const Manifolds<double> triangles = manifolds_of(pair, every),
                            found = manifolds_of(pair, merged);
    for (const Manifold<double>& manifold : triangles)
      for (const ContactPoint<double>& point : manifold.points)
        ASSERT_LT(distance_to(found, manifold, point, 1), 1e-13) << i;
    for (const Manifold<double>& manifold : found)
      for (const ContactPoint<double>& point : manifold.points)
        ASSERT_LT(distance_to(triangles, manifold, point, 1), 1e-13) << i;
    ASSERT_LT(points_in(found), points_in(triangles)) << i;
    most = std::max(most, points_in(found));
  }
  EXPECT_GT(most, static_cast<int>(kMaxManifoldPoints));
}

// Two triangles share the ridge, which touches the ball: one manifold, one point, one id.
TEST(MergeTriangles, AnEdgeBetweenTwoTrianglesHasOneId) {
  const Mesh<double> ridge =
      build_mesh({{0, 0, -2}, {0, 0, 2}, {2, -2, 0}, {-2, -2, 0}}, {{{1, 2, 0}}, {{0, 3, 1}}});
  std::set<std::string> ids;
  for (const double x : {-1e-3, -1e-9, 0.0, 1e-9, 1e-3}) {
    const Manifolds<double> manifolds =
        manifolds_of({test::ball(0.5), at(x, 0.499, 0.1), ridge, {}});
    ASSERT_EQ(manifolds.size(), 1u) << x;
    ASSERT_EQ(manifolds[0].points.size(), 1u) << x;
    ids.insert(to_string(manifolds[0].points[0].id));
  }
  EXPECT_EQ(ids, std::set<std::string>{"a:v0 b:e2"});  // edge 2 of triangle 0
}

TEST(MergeTriangles, ARecordHasTheTrianglesAndTheMergedPoints) {
  test::Random random(373);
  const Mesh<double> terrain = make_grid(4, 4, 24, 24, 0.1);
  for (int i = 0; i < 100; ++i) {
    const PlacedShapes pair = random_on_terrain(random, terrain, 1);
    const trace::Pair record = test::record_of<double>(pair, kMerged);
    const Manifolds<double> manifolds = manifolds_of(pair, kMerged);
    ASSERT_EQ(record.manifolds.size(), manifolds.size());
    ASSERT_EQ(record.merge.has_value(), !manifolds.empty());
    if (manifolds.empty()) continue;
    ASSERT_EQ(record.merge->manifolds.size(), manifolds.size());
    for (std::size_t m = 0; m < manifolds.size(); ++m) {
      const trace::MergedManifold& merged = record.merge->manifolds[m];
      EXPECT_FALSE(merged.triangles.empty());
      EXPECT_GE(merged.points, static_cast<int>(manifolds[m].points.size()));
      EXPECT_FALSE(record.manifolds[m].triangle.has_value());
      EXPECT_EQ(record.manifolds[m].normal, manifolds[m].normal);
      ASSERT_EQ(record.manifolds[m].points.size(), manifolds[m].points.size());
      for (std::size_t p = 0; p < manifolds[m].points.size(); ++p) {
        EXPECT_EQ(record.manifolds[m].points[p].position, manifolds[m].points[p].position);
      }
    }
    // The reduction of the deepest manifold is among all its points, each with its own id.
    ASSERT_TRUE(record.reduction.has_value());
    std::set<std::string> ids;
    for (const trace::Point& point : record.reduction->points) ids.insert(point.id);
    EXPECT_EQ(ids.size(), record.reduction->points.size());
    if (record.manifolds.size() > 1) continue;
    ASSERT_EQ(record.reduction->kept.size(), record.manifolds[0].points.size());
    for (std::size_t k = 0; k < record.reduction->kept.size(); ++k)
      EXPECT_EQ(contactscope::at(record.reduction->points, record.reduction->kept[k]).id,
                record.manifolds[0].points[k].id);
  }
}

/// On grounds from flat to rough.
PlacedShapes random_on_grid(test::Random& random, double size) {
  const double rough = random.index(3) == 0 ? 0 : random.decade(-3, -0.5);
  return random_on_terrain(random, make_grid(4 * size, 4 * size, 32, 32, rough * size), size);
}

// The oracle sorts and groups the contacts of single triangles.
TEST(MergeTriangles, GroupsAreInTheOrderOfTheirDeepestTriangles) {
  test::Random random(374);
  CollideOptions every = kByTriangle, merged = kMerged;
  every.reducer = merged.reducer = nullptr;
  int several = 0;
  for (int i = 0; i < test::cases(600); ++i) {
    const PlacedShapes pair = random_on_grid(random, 1);
    Manifolds<double> left = manifolds_of(pair, every);
    std::sort(left.begin(), left.end(), [](const auto& one, const auto& other) {
      return std::pair(deepest_of(one), one.triangle) <
             std::pair(deepest_of(other), other.triangle);
    });
    std::vector<Vec3d> expected, normals;
    while (!left.empty()) {
      expected.push_back(left.front().normal);
      std::erase_if(left, [&](const Manifold<double>& manifold) {
        return (manifold.normal - expected.back()).norm() <= kFlatEdgeAngle;
      });
    }
    for (const Manifold<double>& manifold : manifolds_of(pair, merged))
      if (normals.empty() || normals.back() != manifold.normal) normals.push_back(manifold.normal);
    ASSERT_EQ(normals, expected) << i;
    several += normals.size() > 1 ? 1 : 0;
  }
  EXPECT_GT(several, 60 / test::kOneIn);
}

/// The farthest a point is outside a convex polygon in the plane; negative inside.
double height_above(const std::vector<Vec2d>& polygon, const Vec2d& point) {
  double most = -1e9;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2d from = polygon[k], along = polygon[(k + 1) % polygon.size()] - from;
    most = std::max(most, cross(Vec2d(point - from), along) / along.norm());
  }
  return most;
}

// Andrew's monotone chain is the oracle, and the points without a reducer.
template <class S> void expect_outlines(test::Random& random, double size, int& dropped) {
  const double rounding = size * (std::is_same_v<S, float> ? 1e-4 : 1e-12);
  CollideOptions every = kMerged, outlines = kMerged;
  every.reducer = nullptr;
  outlines.reduction.max_points = static_cast<int>(kMaxManifoldPoints);
  const PlacedShapes pair = random_on_grid(random, size);
  const Manifolds<S> all = manifolds_of<S>(pair, every), kept = manifolds_of<S>(pair, outlines);
  if (all.size() != kept.size()) return;  // a group had too many points for one manifold
  for (std::size_t m = 0; m < all.size(); ++m) {
    std::vector<Vec3d> places, corners;
    for (const ContactPoint<S>& point : all[m].points)
      places.push_back(point.position.template cast<double>());
    for (const ContactPoint<S>& point : kept[m].points)
      corners.push_back(point.position.template cast<double>());
    const PlaneFrame<double> plane(places[0], test::normal_of(all[m]).normalized());
    const auto seen = [&](const Vec3d& place) { return plane.seen(place); };
    const std::vector<Vec2d> in_plane = mapped(places, seen), kept_there = mapped(corners, seen);
    const std::vector<Vec2d> outline = convex_polygon(kept_there);
    for (const Vec2d& place : in_plane) {
      double nearest = 1e9;
      for (const Vec2d& corner : kept_there) nearest = std::min(nearest, (corner - place).norm());
      if (nearest == 0) continue;
      ++dropped;
      if (outline.size() > 2) {
        ASSERT_LT(height_above(outline, place), rounding);
      } else {
        ASSERT_LT(std::min(nearest, std::abs(turn(outline.front(), outline.back(), place)) /
                                        (outline.back() - outline.front()).norm()),
                  rounding);
      }
    }
    EXPECT_NEAR(deepest_of(all[m]), deepest_of(kept[m]), rounding);
  }
}

TEST(MergeTriangles, SlowTheOutlineOfAGroupHoldsItsPoints) {
  test::Random random(375);
  int in_float = 0, in_double = 0;
  for (const double size : {1e-4, 1.0, 1e4})
    for (int i = 0; i < test::cases(200); ++i) {
      expect_outlines<float>(random, size, in_float);
      expect_outlines<double>(random, size, in_double);
    }
  EXPECT_GT(in_float, 800 / test::kOneIn);
  EXPECT_GT(in_double, 800 / test::kOneIn);
}

// The special path of boxes: the same bits as for a hull that is not known to be a box.
TEST(MergeTriangles, ABoxMergesAsAnyHull) {
  test::Random random(376);
  int points = 0;
  for (int i = 0; i < test::cases(600); ++i) {
    PlacedShapes pair = random_on_grid(random, 1);
    pair.a = test::random_box(random, 0.5, 3);
    const Manifolds<double> of_box = manifolds_of(pair, kMerged);
    std::get<Hull<double>>(pair.a).half_extents.setZero();
    const Manifolds<double> of_hull = manifolds_of(pair, kMerged);
    ASSERT_EQ(of_box.size(), of_hull.size()) << i;
    for (std::size_t m = 0; m < of_box.size(); ++m) {
      ASSERT_EQ(of_box[m].normal, of_hull[m].normal) << i;
      ASSERT_EQ(test::ids_of(of_box[m]), test::ids_of(of_hull[m])) << i;
      for (std::size_t p = 0; p < of_box[m].points.size(); ++p) {
        ASSERT_EQ(of_box[m].points[p].position, of_hull[m].points[p].position) << i;
        ASSERT_EQ(of_box[m].points[p].separation, of_hull[m].points[p].separation) << i;
      }
      points += static_cast<int>(of_box[m].points.size());
    }
  }
  EXPECT_GT(points, 1000 / test::kOneIn);
}

}  // namespace
}  // namespace contactscope
