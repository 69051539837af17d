#include <cmath>

#include <gtest/gtest.h>

#include "dynamics/scene.h"
#include "field/closed_surface.h"
#include "field/distance_field.h"
#include "support/sphere_mesh.h"

namespace contactscope::test {
namespace {

Shape<double> field_of(const Shape<double>& shape, int cells) {
  return field_shape(build_distance_field(shape, {.cells = cells}), shape);
}

TEST(FieldBody, HasTheMassOfItsSourceAlsoMovedScaledAndInsideOut) {
  const Hull<double> box = make_box(Vec3d(0.5, 0.3, 0.2));
  Mesh<double> mesh = surface_of(box);
  std::vector<std::array<int, 3>> turned = mesh.triangles;
  for (auto& [a, b, c] : turned) std::swap(a, b);
  for (const Shape<double>& of : {Shape<double>(box), Shape<double>(mesh),
                                  Shape<double>(build_mesh(mesh.vertices, turned))}) {
    const Vec3d origin(0.1, 2, -3);
    const Shape<double> field = scaled(seen_from(field_of(of, 8), origin), 2);
    const MassProperties expected = *mass_properties<double>(scaled(seen_from(box, origin), 2));
    const MassProperties found = *mass_properties(field);
    EXPECT_NEAR(found.mass, expected.mass, 1e-12);
    EXPECT_LT((found.center - expected.center).norm(), 1e-12);
    EXPECT_LT((found.inertia - expected.inertia).norm(), 1e-12);
  }
}

/// A body on the ground keeps its pose for two seconds, its height within a tenth of a millimetre.
template <class S>
void expect_rest(const Shape<double>& body, const Shape<double>& ground,
                 const Pose<double>& of_ground) {
  Scene<S> scene;
  scene.settings.iterations = 20;
  scene.settings.slop = 0.001;
  scene.add(ground, of_ground, 0);
  const int index = scene.add(body, at(0.1, 0.499, 0.2), 3);
  scene.advance(120);
  const Vec3<S> position = scene.body(index).pose().position;
  EXPECT_NEAR(static_cast<double>(position.y()), 0.499, 2e-4);
  EXPECT_NEAR(static_cast<double>(position.x()), 0.1, 1e-3);
  EXPECT_GT(std::abs(static_cast<double>(scene.body(index).pose().rotation.w())), 1 - 1e-6);
  EXPECT_LT(static_cast<double>(scene.body(index).velocity.norm()), 1e-2);
}

TEST(FieldBody, ABoxRestsOnAFieldAndAFieldOnAPlaneAndOnAField) {
  const Shape<double> box = make_box(Vec3d(0.5, 0.5, 0.5));
  const Shape<double> floor = field_of(make_box(Vec3d(2, 0.5, 2)), 32);
  const Shape<double> crate = field_of(box, 16);
  const Pose<double> below = at(0, -0.5, 0);
  const HalfSpace<double> plane{{Vec3d::UnitY(), 0}};
  expect_rest<float>(box, floor, below);
  expect_rest<double>(box, floor, below);
  expect_rest<float>(crate, plane, {});
  expect_rest<double>(crate, plane, {});
  expect_rest<float>(crate, floor, below);
  expect_rest<double>(crate, floor, below);
}

}  // namespace
}  // namespace contactscope::test
