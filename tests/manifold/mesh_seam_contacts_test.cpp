#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/primitives.h"
#include "manifold/placed_shapes.h"
#include "support/builders.h"
#include "support/tiled_floor.h"

namespace contactscope {
namespace {

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

/// Shapes 2 mm deep, for a floor of 1 m, near corners of the tiles. The floor is a plane, the oracle.
template <class S>
SeamContacts contacts_near_corners(double size, double crack, bool has_seams, MeshManifolds how) {
  CollideOptions options;
  options.mesh_manifolds = how;
  test::Random random(3710);
  SeamContacts all;
  for (int i = 0; i < 40; ++i) {
    const test::TiledFloor tiles(random, size, crack * size);
    Mesh<double> floor = build_mesh(tiles.vertices, tiles.triangles);
    if (!has_seams) {
      floor.seams.clear();
      update_surface(floor);
    }
    for (int k = 0; k < 40; ++k) {
      Vec3d place =
          floor.vertices[static_cast<std::size_t>(random.index(count_of(floor.vertices)))];
      place += random.level(0.03 * size, 0);
      if (std::max(std::abs(place.x()), std::abs(place.z())) > 0.5 * size) continue;
      double height = 0;
      const Shape<double> shape = on_seam(random, k % 5, size, height);
      place.y() = height - 0.002 * size;
      const Quatd turn(Eigen::AngleAxisd(random.uniform(0, 7), Vec3d::UnitY()));
      const Pose<double> by = random.pose(size);
      const PlacedShapes pair = test::moved({shape, {turn, place}, floor, {}}, by);
      const Manifolds<S> manifolds = manifolds_of<S>(pair, options);
      double deepest = 0;
      for (const Manifold<S>& manifold : manifolds) {
        all.lean =
            std::max(all.lean, (test::normal_of(manifold) + by.rotate(Vec3d::UnitY())).norm());
        for (const ContactPoint<S>& point : manifold.points)
          deepest = std::min(deepest, static_cast<double>(point.separation));
      }
      all.error = std::max(all.error, std::abs(deepest / size + 0.002));
      ++all.found;
    }
  }
  return all;
}

template <class S> void expect_contacts_of_a_plane(double rounding) {
  for (const MeshManifolds how : {MeshManifolds::Pair, MeshManifolds::Triangle})
    for (const double size : {1e-4, 1.0, 1e4})
      for (const double crack : {0.0, 1e-9, 2e-7}) {
        const SeamContacts all = contacts_near_corners<S>(size, crack, true, how);
        EXPECT_GT(all.found, 200);
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
  EXPECT_GT(contacts_near_corners<double>(1, 0, false, MeshManifolds::Pair).lean, 0.1);
}

}  // namespace
}  // namespace contactscope
