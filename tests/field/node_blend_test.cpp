#include "field/node_blend.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "support/random_geometry.h"

namespace contactscope {
namespace {

using test::Random;

/// A polynomial of third order in each of x, y and z alone, and of first order in their products.
struct Polynomial {
  explicit Polynomial(Random& random) {
    for (auto* numbers : {&x, &y, &z})
      for (double& number : *numbers) number = random.uniform(-0.1, 0.1);
    xy = random.uniform(-0.1, 0.1);
    yz = random.uniform(-0.1, 0.1);
  }
  static double value(const std::array<double, 4>& c, double t) {
    return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
  }
  static double slope(const std::array<double, 4>& c, double t) {
    return c[1] + t * (2 * c[2] + t * 3 * c[3]);
  }
  double operator()(const Vec3d& p) const {
    return value(x, p.x()) + value(y, p.y()) + value(z, p.z()) + xy * p.x() * p.y() +
           yz * p.y() * p.z();
  }
  Vec3d gradient(const Vec3d& p) const {
    return {slope(x, p.x()) + xy * p.y(), slope(y, p.y()) + xy * p.x() + yz * p.z(),
            slope(z, p.z()) + yz * p.y()};
  }
  std::array<double, 4> x{}, y{}, z{};
  double xy, yz;
};

Vec3d corner(int i) {
  return {static_cast<double>(i & 1), static_cast<double>(i >> 1 & 1), static_cast<double>(i >> 2)};
}

FieldNode rounded(double distance, const Vec3d& slope, const NodeLayout& layout) {
  return rounded_node(
      lanes::Pack<float>{static_cast<float>(distance), static_cast<float>(slope.x()),
                         static_cast<float>(slope.y()), static_cast<float>(slope.z())},
      1 / layout.step);
}

struct Cell {
  std::array<NodePair, 4> pairs;
  NodeLayout layout;
};

/// The cell whose nodes have these numbers at the corners of the unit cube.
Cell cell_of(const std::function<double(const Vec3d&)>& value,
             const std::function<Vec3d(const Vec3d&)>& gradient, int side_bits, float most) {
  Cell cell;
  cell.layout = NodeLayout(1, 2, side_bits, most);
  const auto node = [&](int i) {
    const Vec3d slope = gradient(corner(i)) / (1 << side_bits);
    return rounded(value(corner(i)), slope, cell.layout);
  };
  for (int row = 0; row < 4; ++row)
    at(cell.pairs, row) = NodePair(node(2 * row), node(2 * row + 1));
  return cell;
}

lanes::Flags<float> weights_at(const Vec3d& p) {
  return lanes::Flags<float>{static_cast<int>(p.x() * kWeightOne),
                             static_cast<int>(p.y() * kWeightOne),
                             static_cast<int>(p.z() * kWeightOne), 0};
}

TEST(NodeBlend, CubicIsRightForPolynomialsOfThirdOrder) {
  Random random(20);
  for (int i = 0; i < 500; ++i) {
    const Polynomial polynomial(random);
    const int side_bits = i % 2 == 0 ? 0 : 2;
    const Cell cell = cell_of([&](const Vec3d& p) { return polynomial(p); },
                              [&](const Vec3d& p) { return polynomial.gradient(p); }, side_bits, 1);
    for (int k = 0; k < 20; ++k) {
      const Vec3d p = random.vector(0, 1);
      const auto found = blend<true>(cell.pairs.data(), cell.layout, weights_at(p));
      // The nodes' steps, three slopes that are rounded to 2^-15, and the weights' 2^-14.
      EXPECT_NEAR(found[0], polynomial(p), 0x1p-16 + 3 * 0x1p-16 * (1 << side_bits) + 0x1p-14);
    }
  }
}

TEST(NodeBlend, TrilinearAndGradientsAreTheWeightedMeanOfTheNodes) {
  Random random(21);
  for (int i = 0; i < 500; ++i) {
    std::array<double, 8> values;
    std::array<Vec3d, 8> gradients;
    for (double& value : values) value = random.uniform(-10, 10);
    for (Vec3d& gradient : gradients) gradient = random.unit_vector();
    const auto number = [](const Vec3d& p) {
      return static_cast<int>(p.x()) + 2 * static_cast<int>(p.y()) + 4 * static_cast<int>(p.z());
    };
    const Cell cell = cell_of([&](const Vec3d& p) { return at(values, number(p)); },
                              [&](const Vec3d& p) { return at(gradients, number(p)); }, 0, 10);
    const Vec3d p = random.vector(0, 1);
    double distance = 0;
    Vec3d gradient = Vec3d::Zero();
    for (int k = 0; k < 8; ++k) {
      const Vec3d near = Vec3d::Ones() - (corner(k) - p).cwiseAbs();
      const double weight = near.x() * near.y() * near.z();
      distance += weight * at(values, k);
      gradient += weight * at(gradients, k);
    }
    const auto linear = blend<false>(cell.pairs.data(), cell.layout, weights_at(p));
    const auto cubic = blend<true>(cell.pairs.data(), cell.layout, weights_at(p));
    // 20 from node to node; the weights lose 2^-14 of it along three axes.
    EXPECT_NEAR(linear[0], distance, 10 * 0x1p-16 + 3 * 20 * 0x1p-14);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(linear[axis + 1], gradient[axis], 0x1p-14 + 3 * 2 * 0x1p-14);
      EXPECT_EQ(linear[axis + 1], cubic[axis + 1]);
    }
  }
}

TEST(NodeBlend, NodesAreOffByHalfAStepAndTheMarkOfACellChangesNoDistance) {
  Random random(22);
  const NodeLayout layout(1, 2, 0, 10);
  for (int i = 0; i < 5000; ++i) {
    const double distance = random.uniform(-10, 10);
    const Vec3d slope = random.unit_vector();
    const FieldNode node = rounded(distance, slope, layout);
    ASSERT_LE(std::abs(double{layout.step} * node.distance - distance),
              kNodeRounding * double{layout.step});
    for (int axis = 0; axis < 3; ++axis)
      ASSERT_NEAR(at(node.gradient, axis) / double{kGradientScale}, slope[axis], 1.01 * 0x1p-15);
    NodePair pair(node, node);
    ASSERT_FALSE(pair.queries_triangles());
    pair.query_triangles();
    ASSERT_TRUE(pair.queries_triangles());
    ASSERT_EQ(pair.distance[1], node.distance);
    ASSERT_NEAR(pair.gradient[2][1], node.gradient[2], 1);
  }
}

}  // namespace
}  // namespace contactscope
