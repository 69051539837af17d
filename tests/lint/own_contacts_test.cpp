#include "lint/solid.h"

#include <gtest/gtest.h>

namespace contactscope::lint {
namespace {

trace::Shape rounded_box(double margin) {
  trace::Shape shape;
  shape.name = "box";
  shape.type = "box";
  for (int i = 0; i < 8; ++i)
    shape.vertices.emplace_back(i & 1 ? 0.3 : -0.3, i & 2 ? 0.2 : -0.2, i & 4 ? 0.4 : -0.4);
  shape.margin = margin;
  return shape;
}

/// Two triangles in the plane y = 0, facing up.
trace::Shape floor_of_triangles() {
  trace::Shape shape;
  shape.name = "floor";
  shape.type = "mesh";
  shape.vertices = {{-2, 0, -2}, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}};
  shape.faces = {{0, 1, 2}, {0, 2, 3}};
  return shape;
}

// The lowest corner of a box of half extents h, turned by R, is h . |R's row| below its centre.
double lowest_corner(const Quatd& rotation) {
  return rotation.toRotationMatrix().row(1).cwiseAbs().dot(Vec3d(0.3, 0.2, 0.4));
}

TEST(OwnContacts, ARoundedHullOnAMeshIsDeeperByTheMargin) {
  const Quatd leaning(Eigen::AngleAxisd(0.4, Vec3d(1, 0.3, 0.2).normalized()));
  for (const Quatd& rotation : {Quatd(Quatd::Identity()), leaning}) {
    for (const double margin : {0.0, 0.05, 0.2}) {
      for (const double separation : {-0.02, -0.001}) {
        const Solid on_top(rounded_box(margin)), below(floor_of_triangles());
        const double height = lowest_corner(rotation) + margin + separation;
        const auto found =
            own_contacts({&below, {}}, {&on_top, {rotation, Vec3d(0.1, height, -0.2)}});
        ASSERT_TRUE(found);
        EXPECT_NEAR(found->separation, separation, 1e-9) << margin;
      }
    }
  }
}

TEST(OwnContacts, ShapesBeyondTheirMarginsHaveNone) {
  const Solid on_top(rounded_box(0.05)), below(floor_of_triangles());
  const auto found =
      own_contacts({&below, {}}, {&on_top, {Quatd(Quatd::Identity()), Vec3d(0, 0.26, 0)}});
  ASSERT_TRUE(found);
  EXPECT_GT(found->separation, 0);
}

}  // namespace
}  // namespace contactscope::lint
