#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "geometry/hull_builder.h"
#include "geometry/mesh_seams.h"
#include "geometry/primitives.h"
#include "manifold/placed_shapes.h"
#include "support/builders.h"
#include "support/cases.h"
#include "support/tiled_floor.h"

namespace contactscope {
namespace {

using test::manifold_of;
using test::manifolds_of;
using test::PlacedShapes;

Shape<double> on_seam(test::Random& random, int kind, double size, double& height) {
  const double large = size * random.uniform(0.1, 0.3), small = size * random.uniform(0.05, 0.1);
  height = kind == 1 ? large + small : kind == 2 ? small : large;
  if (kind == 0) return test::ball(large);
  if (kind == 1) return test::upright_capsule(large, small);
  if (kind == 2) return test::lying_capsule(large, small);
  if (kind == 3) return test::cube(large);
  return make_cylinder(small, large, 12);
}

struct SeamContacts {
  int found = 0;
  double lean = 0;   // largest difference of a normal from the floor's
  double error = 0;  // of the largest depth, in sizes
};

using Part = std::pair<Shape<double>, Pose<double>>;
using Parts = std::vector<Part>;

/// Shapes 2 mm deep, for a floor of 1 m, near corners of the tiles. The floor is a plane, the oracle.
template <class S, class MakeFloor>
SeamContacts contacts_near_corners(double size, double crack, const CollideOptions& options,
                                   const MakeFloor& floor_of, int floors = test::cases(40)) {
  test::Random random(3710);
  SeamContacts all;
  for (int i = 0; i < floors; ++i) {
    const test::TiledFloor tiles(random, size, crack * size);
    const Parts floor = floor_of(random, tiles);
    for (int k = 0; k < 40; ++k) {
      Vec3d place =
          tiles.vertices[static_cast<std::size_t>(random.index(count_of(tiles.vertices)))];
      place += random.level(0.03 * size, 0);
      if (std::max(std::abs(place.x()), std::abs(place.z())) > 0.5 * size) continue;
      double height = 0;
      const Shape<double> shape = on_seam(random, k % 5, size, height);
      place.y() = height - 0.002 * size;
      const Quatd turn(Eigen::AngleAxisd(random.uniform(0, 7), Vec3d::UnitY()));
      const Pose<double> by = random.pose(size);
      double deepest = 0;
      for (const auto& [part, pose] : floor) {
        const PlacedShapes pair = test::moved({shape, {turn, place}, part, pose}, by);
        for (const Manifold<S>& manifold : manifolds_of<S>(pair, options)) {
          all.lean =
              std::max(all.lean, (test::normal_of(manifold) + by.rotate(Vec3d::UnitY())).norm());
          for (const ContactPoint<S>& point : manifold.points)
            deepest = std::min(deepest, static_cast<double>(point.separation));
        }
      }
      all.error = std::max(all.error, std::abs(deepest / size + 0.002));
      ++all.found;
    }
  }
  return all;
}

Parts one_mesh(test::Random&, const test::TiledFloor& tiles) {
  return {{build_mesh(tiles.vertices, tiles.triangles), {}}};
}

Parts one_welded_mesh(test::Random&, const test::TiledFloor& tiles) {
  Mesh<double> floor = build_mesh(tiles.vertices, tiles.triangles);
  weld(floor, 1e-4);
  return {{floor, {}}};
}

Parts without_seams(test::Random&, const test::TiledFloor& tiles) {
  Mesh<double> floor = build_mesh(tiles.vertices, tiles.triangles);
  floor.seams.clear();
  update_surface(floor);
  return {{floor, {}}};
}

template <class S> void expect_contacts_of_a_plane(double rounding) {
  for (const MeshManifolds how : {MeshManifolds::Pair, MeshManifolds::Triangle})
    for (const double size : {1e-4, 1.0, 1e4})
      for (const double crack : {0.0, 1e-9, 2e-7, 2e-5}) {
        CollideOptions options;
        options.mesh_manifolds = how;
        const SeamContacts all = contacts_near_corners<S>(
            size, crack, options, crack > 1e-6 ? one_welded_mesh : one_mesh);
        EXPECT_GT(all.found, 200 / test::kOneIn);
        // A step of two cracks leans a ball of radius r by sqrt(2 h / r); the smallest has r = 0.05.
        const double step = std::sqrt(80 * crack);
        EXPECT_LT(all.lean, rounding + step) << size << ", " << crack;
        EXPECT_LT(all.error, rounding + 2 * crack) << size << ", " << crack;
      }
}

TEST(MeshSeamContacts, NothingLeansAtCracksAndTJunctionsOfAFlatFloor) {
  expect_contacts_of_a_plane<float>(2e-5);
  expect_contacts_of_a_plane<double>(1e-12);
  // The same floors without their seams: shapes trip.
  EXPECT_GT(contacts_near_corners<double>(1, 0, {}, without_seams).lean, 0.1);
  EXPECT_GT(contacts_near_corners<double>(1, 2e-5, {}, one_mesh).lean, 0.1);
}

/// A tile as a hull below it or as a mesh of its own, about its middle.
Part part_of(const test::TiledFloor& tiles, int tile, bool is_hull) {
  const auto corners = std::span(tiles.vertices).subspan(static_cast<std::size_t>(4 * tile), 4);
  const Vec3d middle = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
  std::vector<Vec3d> points;
  for (const Vec3d& corner : corners) points.push_back(corner - middle);
  const Pose<double> pose{Quatd::Identity(), middle};
  if (!is_hull) return {build_mesh(points, {{0, 1, 2}, {0, 2, 3}}), pose};
  for (int i = 0; i < 4; ++i)
    points.push_back(points[static_cast<std::size_t>(i)] - tiles.size() * Vec3d::UnitY());
  return {build_hull(points), pose};
}

Parts unjoined(test::Random& random, const test::TiledFloor& tiles, double share_of_hulls) {
  Parts parts;
  for (int tile = 0; tile < tiles.tile_count(); ++tile)
    parts.push_back(part_of(tiles, tile, random.uniform(0, 1) < share_of_hulls));
  return parts;
}

Parts joined(Parts parts) {
  std::vector<PlacedSurface> placed;
  for (auto& [shape, pose] : parts) placed.push_back({&shape, pose});
  join_seams(placed);
  return parts;
}

template <class S> void expect_parts_make_a_plane(double rounding) {
  for (const double share : {0.0, 1.0, 0.5})
    for (const double size : {1e-4, 1.0, 1e4}) {
      const SeamContacts all = contacts_near_corners<S>(
          size, 0, {},
          [&](test::Random& random, const test::TiledFloor& tiles) {
            return joined(unjoined(random, tiles, share));
          },
          test::cases(10));
      EXPECT_GT(all.found, 50 / test::kOneIn);
      EXPECT_LT(all.lean, rounding) << size << ", " << share;
      EXPECT_LT(all.error, rounding) << size << ", " << share;
    }
}

TEST(PartSeamContacts, NothingLeansBetweenTheHullsAndMeshesOfAFlatFloor) {
  expect_parts_make_a_plane<float>(2e-5);
  expect_parts_make_a_plane<double>(1e-12);
  for (const double share : {0.0, 1.0}) {
    const auto floor = [&](test::Random& random, const test::TiledFloor& tiles) {
      return unjoined(random, tiles, share);
    };
    EXPECT_GT(contacts_near_corners<double>(1, 0, {}, floor).lean, 0.1) << share;
  }
}

/// Beyond the outline of a floor of parts contacts are those of its parts alone, bit for bit.
TEST(PartSeamContacts, TheOutlineOfAFloorIsReal) {
  test::Random random(3711);
  int touching = 0, at_rim = 0;
  for (int i = 0; i < 20; ++i) {
    const test::TiledFloor tiles(random, 1, 0);
    const Parts alone = unjoined(random, tiles, 1);
    const Parts floor = joined(alone);
    for (int k = 0; k < 40; ++k) {
      double height = 0;
      const Shape<double> shape = on_seam(random, k % 5, 1, height);
      // Next to one side, away from the corners of the floor.
      const double out = 1 + random.uniform(0, 0.3), along = random.uniform(-0.5, 0.5);
      const Pose<double> pose{random.rotation(), {out, random.uniform(-0.8, 0.1), along}};
      for (std::size_t part = 0; part < floor.size(); ++part) {
        const auto& hull = std::get<Hull<double>>(floor[part].first);
        const double side = box_around(hull.vertices).upper.x() + floor[part].second.position.x();
        if (side < 0.999) continue;
        const auto found = [&](const Parts& of) {
          return manifold_of<double>({shape, pose, of[part].first, of[part].second});
        };
        const Manifold<double> one = found(floor), other = found(alone);
        const bool from_side = other.normal.x() < -0.999999,
                   from_top = other.normal.y() < -0.999999;
        if (other.points.size() == 0) continue;
        ++touching;
        at_rim += from_side || from_top ? 0 : 1;
        if (std::abs(other.normal.z()) > 1e-9) continue;  // may be the side of a tile
        EXPECT_EQ(one.normal, other.normal);
        EXPECT_EQ(test::ids_of(one), test::ids_of(other));
      }
    }
  }
  EXPECT_GT(touching, 200);
  EXPECT_GT(at_rim, 50);
}

/// A ball or a box in the corner between a floor and a wall rests on the one and leans on the other.
TEST(PartSeamContacts, AWallOnAFloorIsTouched) {
  test::Random random(3712);
  for (const bool is_on_floor : {true, false}) {
    const Shape<double> slab = make_box({1, 0.5, 1}), wall = make_box({0.1, 1, 1});
    const Parts parts = joined({{slab, {Quatd::Identity(), {0, -0.5, 0}}},
                                {wall, {Quatd::Identity(), {is_on_floor ? 0.9 : 1.1, 1, 0}}}});
    const double side = is_on_floor ? 0.8 : 1;
    for (int i = 0; i < 200; ++i) {
      const double size = random.uniform(0.1, 0.3), depth = random.decade(-6, -3);
      const Pose<double> by = random.pose(1);
      const Pose<double> pose{Quatd::Identity(),
                              {side - size + depth, size - depth, random.uniform(-0.5, 0.5)}};
      for (const Shape<double>& shape : {test::ball(size), Shape<double>(test::cube(size))}) {
        const auto touched = [&](std::size_t part) {
          return manifold_of<double>(
              test::moved({shape, pose, parts[part].first, parts[part].second}, by));
        };
        const Manifold<double> on_floor = touched(0), on_wall = touched(1);
        EXPECT_LT((test::normal_of(on_floor) + by.rotate(Vec3d::UnitY())).norm(), 1e-6);
        EXPECT_LT((test::normal_of(on_wall) - by.rotate(Vec3d::UnitX())).norm(), 1e-6);
        EXPECT_NEAR(test::deepest_of(on_floor), -depth, 1e-12);
        EXPECT_NEAR(test::deepest_of(on_wall), -depth, 1e-12);
        EXPECT_EQ(on_floor.points.size(), kind_of(shape) == ShapeKind::Hull ? 4U : 1U);
      }
    }
  }
}

TEST(PartSeamContacts, TheRecordHasTheContactThatWasReplaced) {
  const Shape<double> box = make_box({1, 0.5, 1});
  const Parts parts =
      joined({{box, {Quatd::Identity(), {-1, -0.5, 0}}}, {box, {Quatd::Identity(), {1, -0.5, 0}}}});
  // 1 mm over the seam and 2 mm deep.
  const PlacedShapes pair{
      test::cube(0.2), {Quatd::Identity(), {-0.199, 0.198, 0}}, parts[1].first, parts[1].second};
  const trace::Pair record = test::record_of<double>(pair);
  ASSERT_TRUE(record.voided);
  EXPECT_EQ(record.voided->shape, "b");
  EXPECT_EQ(record.voided->reason, "covered face");
  EXPECT_LT((record.voided->normal - Vec3d::UnitX()).norm(), 1e-12);
  EXPECT_EQ(record.voided->points.size(), 4U);
  ASSERT_EQ(record.manifolds.size(), 1U);
  EXPECT_LT((record.manifolds[0].normal + Vec3d::UnitY()).norm(), 1e-12);
  EXPECT_NEAR(record.separation, -0.002, 1e-12);
  CollideOptions all_edges;
  all_edges.internal_edges = false;
  EXPECT_LT((test::normal_of(manifold_of<double>(pair, all_edges)) - Vec3d::UnitX()).norm(), 1e-12);
}

}  // namespace
}  // namespace contactscope
