#include "draw/scene/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace contactscope::draw {
namespace {

trace::Shape box(const Vec3d& half, double margin) {
  trace::Shape shape;
  shape.type = "hull";
  for (int i = 0; i < 8; ++i)
    shape.vertices.emplace_back(i & 1 ? half.x() : -half.x(), i & 2 ? half.y() : -half.y(),
                                i & 4 ? half.z() : -half.z());
  shape.faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                 {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  shape.margin = margin;
  return shape;
}

double volume(const trace::Shape& shape) {
  double six = 0;
  for (const std::vector<int>& face : shape.faces)
    for (std::size_t i = 2; i < face.size(); ++i)
      six += at(shape.vertices, face[0])
                 .dot(at(shape.vertices, face[i - 1]).cross(at(shape.vertices, face[i])));
  return six / 6;
}

/// Faces, strips and caps close it, and all are on the surface that they represent.
TEST(Rounded, ABoxIsClosedAndAsLargeAsItsMarginMakesIt) {
  for (const double margin : {0.01, 0.1, 1.0}) {
    const Vec3d half(0.5, 0.3, 0.2);
    const trace::Shape shape = rounded(box(half, margin));
    EXPECT_EQ(shape.margin, 0);
    std::map<std::pair<int, int>, int> edges;
    for (const std::vector<int>& face : shape.faces)
      for (std::size_t i = 0; i < face.size(); ++i) ++edges[{face[i], face[(i + 1) % face.size()]}];
    for (const auto& [edge, count] : edges) {
      EXPECT_EQ(count, 1);
      EXPECT_TRUE(edges.contains({edge.second, edge.first}));
    }
    for (const Vec3d& vertex : shape.vertices) {
      const Vec3d beyond = (vertex.cwiseAbs() - half).cwiseMax(0);
      EXPECT_NEAR(beyond.norm(), margin, 1e-12);
    }
    // Steiner's formula: the box, slabs on its faces, quarter cylinders along its edges, a ball.
    const Vec3d sides = 2 * half;
    const double whole =
        sides.prod() +
        2 * margin * (sides.x() * sides.y() + sides.y() * sides.z() + sides.z() * sides.x()) +
        std::numbers::pi * margin * margin * sides.sum() +
        4 / 3.0 * std::numbers::pi * std::pow(margin, 3);
    EXPECT_LT(volume(shape), whole);
    EXPECT_GT(volume(shape), 0.8 * whole);
  }
}

}  // namespace
}  // namespace contactscope::draw
