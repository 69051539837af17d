#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/convex_polygon.h"
#include "manifold/placed_shapes.h"
#include "support/builders.h"
#include "support/cases.h"

// Shapes that share part of a face without overlap. Rounding puts the corners of one a few ulps
// above or below the other. It may remove the whole contact, but no single corner.
namespace contactscope {
namespace {

using test::about;
using test::kDegree;
using test::PlacedShapes;
using test::Random;

using Outline = std::vector<Vec2d>;  // (z, x) of a face in the plane y = 0, counter-clockwise

/// Distance of a place outside an edge's line; negative inside.
double beyond(const Outline& outline, std::size_t edge, const Vec2d& place) {
  const Vec2d& from = outline[edge];
  const Vec2d along = outline[(edge + 1) % outline.size()] - from;
  const Vec2d offset = place - from;
  return (along.y() * offset.x() - along.x() * offset.y()) / along.norm();
}

bool holds(const Outline& outline, const Vec2d& place) {
  for (std::size_t edge = 0; edge < outline.size(); ++edge)
    if (beyond(outline, edge, place) > 1e-9) return false;
  return true;
}

/// Corners of two outlines' intersection, by definition: inner corners, and crossings of edges.
Outline shared_corners(const Outline& one, const Outline& other) {
  Outline corners;
  const auto add = [&](const Vec2d& place) {
    if (!holds(one, place) || !holds(other, place)) return;
    for (const Vec2d& known : corners)
      if ((known - place).norm() < 1e-9) return;
    corners.push_back(place);
  };
  for (const Vec2d& corner : one) add(corner);
  for (const Vec2d& corner : other) add(corner);
  for (std::size_t i = 0; i < one.size(); ++i) {
    const Vec2d along = one[(i + 1) % one.size()] - one[i];
    for (std::size_t k = 0; k < other.size(); ++k) {
      const Vec2d across = other[(k + 1) % other.size()] - other[k];
      if (std::abs(along.x() * across.y() - along.y() * across.x()) < 1e-9) continue;
      const double before = beyond(other, k, one[i]);
      const double after = beyond(other, k, Vec2d(one[i] + along));
      add(one[i] + before / (before - after) * along);
    }
  }
  return corners;
}

/// A shape below or above the plane y = 0, with a face on it.
struct Block {
  Shape<double> shape;
  Pose<double> pose;
  Outline face;
};

Quatd quarter_turns(Random& random) {
  Quatd turn = Quatd::Identity();
  for (int i = 0; i < 3; ++i)
    turn = turn * about(Vec3d::Unit(random.index(3)), random.index(4) * 90 * kDegree);
  return turn;
}

/// A box with integer coordinates, a prism, or a triangle of a mesh.
Block random_block(Random& random, double side, double size) {
  const Vec3d half(1 + random.index(3), 1 + random.index(3), 1 + random.index(3));
  const Vec3d middle(random.index(7) - 3, side * half.y(), random.index(7) - 3);
  Block block;
  block.pose.position = size * middle;
  const int kind = random.index(side < 0 ? 4 : 3);
  if (kind < 2) {
    block.pose.rotation = quarter_turns(random);
    const Vec3d local = block.pose.rotation.conjugate() * half;
    block.shape = make_box(size * Vec3d(local.cwiseAbs().array().round()));
    for (const Vec2d& sign : {Vec2d(-1, -1), Vec2d(1, -1), Vec2d(1, 1), Vec2d(-1, 1)})
      block.face.emplace_back(middle.z() + sign.x() * half.z(), middle.x() + sign.y() * half.x());
  } else if (kind == 2) {
    const int corners[] = {3, 4, 6};
    const int count = corners[random.index(3)];
    block.shape = make_cylinder(size * half.x(), size * half.y(), count);
    for (int k = 0; k < count; ++k) {
      const double angle = k * 360 * kDegree / count;  // from +x towards -z
      block.face.emplace_back(middle.z() - half.x() * std::sin(angle),
                              middle.x() + half.x() * std::cos(angle));
    }
    std::reverse(block.face.begin(), block.face.end());
  } else {
    block.face = {Vec2d(-2 - half.x(), -3), Vec2d(2 + half.y(), -half.z()), Vec2d(half.x(), 4)};
    std::vector<Vec3d> corners;
    for (const Vec2d& corner : block.face)
      corners.emplace_back(size * Vec3d(corner.y(), 0, corner.x()));
    block.shape = build_mesh(corners, {{{0, 1, 2}}});
    block.pose.position.setZero();
  }
  return block;
}

double length_of(const Shape<double>& shape) {
  if (const auto* hull = std::get_if<Hull<double>>(&shape)) return hull->radius;
  double length = 0;
  for (const Vec3d& vertex : std::get<Mesh<double>>(shape).vertices)
    length = std::max(length, vertex.norm());
  return length;
}

template <class S>
double farthest_of(const Manifold<S>& manifold, const std::vector<Vec3d>& corners) {
  double farthest = 0;
  for (const Vec3d& corner : corners)
    farthest = std::max(farthest, test::distance_to_nearest(manifold, corner));
  for (const ContactPoint<S>& point : manifold.points) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vec3d& corner : corners)
      nearest = std::min(nearest, (point.position.template cast<double>() - corner).norm());
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

template <class S> class KissingFaces : public testing::Test {
 protected:
  static constexpr double kEpsilon = std::numeric_limits<S>::epsilon();
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(KissingFaces, Scalars);

TYPED_TEST(KissingFaces, AQuarterTurnLeavesAllFourCorners) {
  using S = TypeParam;
  // In single precision, clipping left all four up to 7e-7 m above A's face.
  PlacedShapes pair{make_box({2, 1, 1}), test::at(-2, 1, 2), make_box({3, 3, 1}),
                    test::at(3, 1, 2)};
  pair.pose_a.rotation = about(Vec3d::UnitX(), 90 * kDegree);
  pair.pose_b.rotation = about(Vec3d::UnitZ(), 90 * kDegree);
  for (const double margin : {0.0, 512 * this->kEpsilon}) {
    CollideOptions options;
    options.margin = margin;
    const Manifold<S> manifold = test::manifold_of<S>(pair, options);
    EXPECT_EQ(manifold.points.size(), 4u) << margin;
    EXPECT_LE(farthest_of(manifold, {{0, 0, 1}, {0, 2, 1}, {0, 2, 3}, {0, 0, 3}}),
              64 * this->kEpsilon);
  }
}

TYPED_TEST(KissingFaces, SlowHaveTheCornersOfWhatTheyShareAndNoOtherPoint) {
  using S = TypeParam;
  Random random(20150304);
  int touching = 0, moved_and_touching = 0;
  for (int i = 0; i < test::cases(5'000); ++i) {
    SCOPED_TRACE("pair " + std::to_string(i));
    const double size = random.decade(-4, 4);
    const bool is_moved = random.chance(0.7);
    const Block below = random_block(random, -1, size), above = random_block(random, 1, size);
    Pose<double> motion;
    if (is_moved) motion = random.pose(5 * size);
    PlacedShapes pair{below.shape, below.pose, above.shape, above.pose};
    if (random.chance(0.5)) pair = {above.shape, above.pose, below.shape, below.pose};
    pair = test::moved(pair, motion);
    const Outline shared = shared_corners(below.face, above.face);
    if (shared.size() < 3) continue;  // they share a point, an edge or nothing
    std::vector<Vec3d> corners;
    for (const Vec2d& corner : shared)
      corners.push_back(motion.transform(size * Vec3d(corner.y(), 0, corner.x())));

    const double rounding = 64 * this->kEpsilon *
                            (length_of(pair.a) + pair.pose_a.position.norm() + length_of(pair.b) +
                             pair.pose_b.position.norm());
    for (const double margin : {0.0, rounding}) {
      CollideOptions options;
      options.margin = margin;
      const Manifold<S> manifold = test::manifold_of<S>(pair, options);
      if (margin > 0) {
        ASSERT_FALSE(manifold.points.empty());
      }
      if (manifold.points.empty()) continue;  // separated by rounding
      if (margin == 0) ++(is_moved ? moved_and_touching : touching);
      ASSERT_EQ(manifold.points.size(), corners.size());
      ASSERT_LE(farthest_of(manifold, corners), rounding);
      for (const ContactPoint<S>& point : manifold.points) {
        ASSERT_LE(point.separation, static_cast<S>(margin));
        ASSERT_LE(std::abs(static_cast<double>(point.separation)), rounding);
      }
    }
  }
  EXPECT_GT(touching, 300);
  EXPECT_GT(moved_and_touching, 300);
}

}  // namespace
}  // namespace contactscope
