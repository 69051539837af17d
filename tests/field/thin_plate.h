#pragma once

#include "field/distance_field.h"
#include "geometry/primitives.h"
#include "support/random_geometry.h"

namespace contactscope::test {

/// A plate of half a cell, and a block that enlarges the lattice so that the plate slides through
/// the cells. Their common length is the lattice's: each of kPlateCells cells is nearly 1/64 m.
struct ThinPlate {
  Mesh<double> mesh;
  Vec3d middle;
};
inline constexpr int kPlateCells = 91;
inline constexpr int kPlatePlaces = 8738;

/// The plate's lower side is `shift` cells above a plane of the lattice.
inline ThinPlate thin_plate(double shift) {
  const double cell = 1.0 / 64;
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
  const Vec3d middle(0, (0.25 + shift) * cell, 0);
  add(box, middle);
  add(block, Vec3d(0.9, 0, 0));
  return {build_mesh(std::move(vertices), std::move(triangles)), middle};
}

/// Number of kPlatePlaces places in the middle of the plate for which `is_inside` returns false.
template <class IsInside> int places_lost(const ThinPlate& plate, const IsInside& is_inside) {
  Random random(11);
  int lost = 0;
  for (int k = 0; k < kPlatePlaces; ++k) {
    const double x = random.uniform(-0.49, 0.49), z = random.uniform(-0.29, 0.29);
    if (!is_inside(Vec3d(plate.middle + Vec3d(x, 0, z)))) ++lost;
  }
  return lost;
}

inline int places_lost(const FieldSettings& settings, double shift) {
  const ThinPlate plate = thin_plate(shift);
  const PlacedField field = build_distance_field(plate.mesh, settings);
  return places_lost(plate, [&](const Vec3d& p) { return field.sample(p).distance < 0; });
}

}  // namespace contactscope::test
