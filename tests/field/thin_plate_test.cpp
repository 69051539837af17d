#include <gtest/gtest.h>

#include <cmath>

#include "field/distance_field.h"
#include "geometry/primitives.h"
#include "support/random_geometry.h"

namespace contactscope {
namespace {

/// Places in the middle of a plate of half a cell that are not found to be inside, of `count`. A block of
/// the plate's length beside it makes the lattice, so that the plate slides through the cells with
/// `shift`, in cells.
int places_lost(const FieldSettings& settings, double shift, int count) {
  const int cells = 64;
  const double cell = 1.0 / cells;
  // The plate's lower side is at `shift` cells above a plane of the lattice.
  const Hull<double> box = make_box(Vec3d(0.5, 0.25 * cell, 0.3));
  const Hull<double> block = make_box(Vec3d(0.02, 0.5, 0.02));
  std::vector<Vec3d> vertices;
  std::vector<std::array<int, 3>> triangles;
  const auto add = [&](const Hull<double>& hull, const Vec3d& offset) {
    const int first = count_of(vertices);
    for (const Vec3d& vertex : hull.vertices) vertices.emplace_back(vertex + offset);
    for (int face = 0; face < hull.face_count(); ++face) {
      const std::vector<int> around = face_vertices(hull, face);
      for (int k = 2; k < count_of(around); ++k)
        triangles.push_back({first + around[0], first + at(around, k - 1), first + at(around, k)});
    }
  };
  const Vec3d at_plate(0, (0.25 + shift) * cell, 0);
  add(box, at_plate);
  add(block, Vec3d(0.9, 0, 0));
  const PlacedField field =
      build_distance_field(build_mesh(std::move(vertices), std::move(triangles)), settings);
  test::Random random(11);
  int lost = 0;
  for (int k = 0; k < count; ++k) {
    const Vec3d p = at_plate + Vec3d(random.uniform(-0.49, 0.49), 0, random.uniform(-0.29, 0.29));
    if (!(field.sample(p).distance < 0)) ++lost;
  }
  return lost;
}

// Of the plate and the block beside it, whose length together is the lattice's: nearly 1/64 m each.
constexpr int kCells = 91;

TEST(ThinPlate, ExactCellsLoseNoPlaceOfAPlateOfHalfACell) {
  for (const auto interpolation : {FieldInterpolation::Trilinear, FieldInterpolation::Cubic})
    for (int i = 0; i < 5; ++i)
      EXPECT_EQ(places_lost({.cells = kCells, .interpolation = interpolation}, 0.2 * i, 8738), 0);
}

TEST(ThinPlate, VanishesBetweenNodesAsTheLatticeSlides) {
  int most = 0, least = 8738;
  for (int i = 0; i < 5; ++i) {
    const int lost = places_lost(
        {.cells = kCells, .interpolation = FieldInterpolation::Trilinear, .exact = false}, 0.2 * i,
        8738);
    most = std::max(most, lost);
    least = std::min(least, lost);
  }
  EXPECT_EQ(most, 8738);
  EXPECT_LT(least, 8738);
}

}  // namespace
}  // namespace contactscope
