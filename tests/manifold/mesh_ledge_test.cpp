#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/primitives.h"
#include "manifold/placed_shapes.h"
#include "support/builders.h"

namespace contactscope {
namespace {

using test::about;
using test::at;
using test::kDegree;
using test::PlacedShapes;

template <class S> Manifolds<S> manifolds_of(const PlacedShapes& pair) {
  Manifolds<S> manifolds;
  collide(shape_cast<S>(pair.a), pair.pose_a.template cast<S>(), shape_cast<S>(pair.b),
          pair.pose_b.template cast<S>(), CollideOptions{}, manifolds);
  return manifolds;
}

template <class S> double deepest(const Manifolds<S>& manifolds) {
  double least = std::numeric_limits<double>::infinity();
  for (const Manifold<S>& manifold : manifolds) least = std::min(least, test::deepest(manifold));
  return least;
}

/// A level top that ends at x = 0.4, and a side that drops there; fronts up and to +x.
Mesh<double> ledge(double scale) {
  std::vector<Vec3d> vertices = {{-2, 0, -1}, {-2, 0, 1},    {0.4, 0, -1},
                                 {0.4, 0, 1}, {0.4, -1, -1}, {0.4, -1, 1}};
  for (Vec3d& vertex : vertices) vertex *= scale;
  return build_mesh(vertices, {{{0, 1, 3}}, {{0, 3, 2}}, {{2, 3, 5}}, {{2, 5, 4}}});
}

Shape<double> crate(double scale) { return make_box(scale * Vec3d(0.5, 0.25, 0.3)); }

// The overhanging part is in front of the side, but the crate is on the top and not behind it.
TEST(MeshLedge, ACrateThatPeeksOverIsNotPushedBack) {
  for (const double scale : {1e-4, 1.0, 1e4}) {
    for (const double over : {1e-4, 1e-3, 5e-3, 2e-2, 0.3}) {
      const Manifolds<double> manifolds = manifolds_of<double>(
          {crate(scale), at(scale * (over - 0.1), scale * 0.24, 0), ledge(scale), {}});
      ASSERT_FALSE(manifolds.empty());
      for (const Manifold<double>& manifold : manifolds)
        EXPECT_NEAR(manifold.normal.y(), -1, 1e-12) << "over " << over << ", scale " << scale;
      EXPECT_NEAR(deepest(manifolds), -0.01 * scale, 1e-14 * scale);
    }
  }
}

// The low end digs 3.6 cm into the top. The other end overhangs the side; the exit through the side
// would be as long as the crate.
template <class S> void expect_direction_up(double scale, double tolerance) {
  for (const double x : {0.2, 0.3, 0.45, 0.48, 0.55, 0.6}) {
    Pose<double> pose = at(scale * x, scale * 0.24, 0);
    pose.rotation = about(Vec3d::UnitZ(), 3 * kDegree);
    const double depth =
        std::cos(3 * kDegree) * 0.25 + std::sin(3 * kDegree) * 0.5 - 0.24;  // of the low corners
    const Manifolds<S> manifolds = manifolds_of<S>({crate(scale), pose, ledge(scale), {}});
    ASSERT_FALSE(manifolds.empty());
    EXPECT_NEAR(deepest(manifolds), -depth * scale, tolerance * scale) << x << ", scale " << scale;
    for (const Manifold<S>& manifold : manifolds)
      EXPECT_LT(static_cast<double>(manifold.normal.y()), -0.99) << x << ", scale " << scale;
  }
}

TEST(MeshLedge, ATiltedCrateThatHangsOverIsPushedUpAndNotOutOfTheSide) {
  for (const double scale : {1e-4, 1.0, 1e4}) {
    expect_direction_up<double>(scale, 1e-13);
    expect_direction_up<float>(scale, 1e-5);
  }
}

Mesh<double> surface_of(const Hull<double>& hull) {
  std::vector<std::array<int, 3>> triangles;
  for (int face = 0; face < hull.face_count(); ++face) {
    const std::vector<int> corners = face_vertices(hull, face);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
      triangles.push_back({corners[0], corners[i], corners[i + 1]});
  }
  return build_mesh(hull.vertices, triangles);
}

/// A triangle that does not decide whether the body is inside the solid: the body's centre is in
/// front of it, and the contact is on its face.
void expect_own_face(const Manifold<double>& manifold, const Mesh<double>& mesh,
                     const Pose<double>& pose, const Vec3d& center, int i) {
  const Vec3d& front = mesh.normal(manifold.triangle);
  EXPECT_NEAR((pose.inverse_rotate(manifold.normal) + front).norm(), 0, 1e-9) << i;
  EXPECT_GT(front.dot(center - mesh.corner(manifold.triangle, 0)), 0) << i;
}

/// Boxes and capsules that overlap a solid a little, with their centre outside, against its
/// surface: no contact is lost, on the wrong side, or far deeper than with the solid. The deepest
/// one pushes out as the solid does. Another may push back only from the front of a face: at a rim
/// of less than a right angle, the surface does not decide which face is the exit.
template <class MakeSolid>
void expect_like_the_solid(unsigned seed, int count, const MakeSolid& make_solid,
                           int least_touching) {
  test::Random random(seed);
  int touching = 0;
  for (int i = 0; i < count; ++i) {
    const Hull<double> solid = make_solid(random);
    const Vec3d half = random.vector(0.1, 0.6);
    const Shape<double> shape =
        i % 2 == 0 ? Shape<double>(make_box(half)) : test::upright_capsule(half.x(), half.y());
    const PlacedShapes pair{shape, random.pose(1.3), solid, random.pose(0.1)};
    const Manifold<double> expected = test::manifold_of<double>(pair);
    if (expected.points.empty() || test::deepest(expected) < -0.06) continue;
    const Vec3d center = pair.pose_b.inverse_transform(pair.pose_a.position);
    double outside = -1;
    for (const Plane<double>& plane : solid.planes)
      outside = std::max(outside, plane.distance(center));
    if (outside < 0.01) continue;
    ++touching;
    const Mesh<double> surface = surface_of(solid);
    const Manifolds<double> found =
        manifolds_of<double>({pair.a, pair.pose_a, surface, pair.pose_b});
    ASSERT_FALSE(found.empty()) << i;
    for (const Manifold<double>& manifold : found) {
      const double along = manifold.normal.dot(expected.normal);
      if (along > -1e-9) continue;
      expect_own_face(manifold, surface, pair.pose_b, center, i);
      EXPECT_GT(test::deepest(manifold), deepest(found)) << i << " pushes back the most";
    }
    EXPECT_GT(deepest(found), 1.5 * test::deepest(expected) - 0.02) << i;
    EXPECT_LT(deepest(found), 0.5 * test::deepest(expected) + 1e-9) << i;
  }
  EXPECT_GT(touching, least_touching);
}

TEST(MeshLedge, TheSurfaceOfACubeIsNoDeeperThanTheCube) {
  expect_like_the_solid(
      21, 4000, [](test::Random&) { return test::cube(0.5); }, 250);
}

TEST(MeshLedge, SlowTheSurfaceOfARandomHullIsNoDeeperThanTheHull) {
  expect_like_the_solid(
      22, 4000, [](test::Random& random) { return test::random_hull(random, 14, 1, 1.5); }, 250);
}

TEST(MeshLedge, SlowASharpRimIsNoDeeperThanTheConeOfIt) {
  expect_like_the_solid(
      123, 16000, [](test::Random&) { return make_cone(0.6, 0.4, 7); }, 1000);
}

/// Largest change of depth per displacement, in 1000 steps of a capsule (1.2 m, 0.5 m) over `roof`.
struct Sweep {
  double worst = 0;
  int touching = 0;
};

template <class S>
Sweep sweep_over(const Mesh<double>& roof, const Quatd& turn, const Vec3d& from, const Vec3d& to,
                 double size) {
  constexpr int kSteps = 1000;
  Sweep sweep;
  double last = 0;
  const double step = (to - from).norm() / kSteps;
  for (int i = 0; i <= kSteps; ++i) {
    const Pose<double> pose{turn, size * (from + (to - from) * i / kSteps)};
    const Manifolds<S> found =
        manifolds_of<S>({test::lying_capsule(0.6 * size, 0.25 * size), pose, roof, {}});
    const double depth = found.empty() ? 0 : std::min(0.0, deepest(found) / size);
    sweep.touching += found.empty() ? 0 : 1;
    if (i > 0) sweep.worst = std::max(sweep.worst, std::abs(depth - last) / step);
    last = depth;
  }
  return sweep;
}

TEST(MeshLedge, DepthDoesNotJumpAsACapsuleSinksPastTheRimOfARoof) {
  for (const double size : {1e-4, 1.0, 1e4}) {
    std::vector<Vec3d> corners = {{-1, 0, -1}, {1, 0, -1}, {0, 0.3, 1}, {-1, 0.2, 1}};
    for (Vec3d& corner : corners) corner *= size;
    const Mesh<double> roof = build_mesh(corners, {{{0, 2, 1}}, {{0, 3, 2}}});
    const Quatd turn(-0.08788343784, -0.646731931294, 0.5957433634, -0.4680856282384);
    const Vec3d from(-0.775430655, 1.8, -0.584269184);
    const Vec3d to(-0.740024842, 0.126, -0.556424678);  // its middle has not yet passed the roof
    const Sweep in_float = sweep_over<float>(roof, turn, from, to, size);
    const Sweep in_double = sweep_over<double>(roof, turn, from, to, size);
    EXPECT_GT(in_double.touching, 300);
    // The contact that reappears fades three times as fast as the rest deepens.
    EXPECT_LT(in_double.worst, 5);
    EXPECT_LT(in_float.worst, 5);
  }
}

// The centre went below the floor: no triangle is hidden from it, and the exit below is shorter.
TEST(MeshLedge, BehindAFloorIsStillBehindIt) {
  const Manifolds<double> manifolds =
      manifolds_of<double>({crate(1), at(0.03, -0.2, 0.05), make_grid(8, 8, 8, 8, 0), {}});
  ASSERT_FALSE(manifolds.empty());
  for (const Manifold<double>& manifold : manifolds) EXPECT_NEAR(manifold.normal.y(), 1, 1e-12);
  EXPECT_NEAR(deepest(manifolds), -0.05, 1e-14);
}

// Deeper than the triangles are wide, so that each one alone would push sideways.
TEST(MeshLedge, APinDeepInAFineFloorIsPushedUp) {
  const Mesh<double> floor = make_grid(0.4, 0.4, 40, 40, 0);
  const Manifolds<double> manifolds =
      manifolds_of<double>({make_box(Vec3d(0.004, 0.2, 0.004)), at(0.013, 0.17, 0.007), floor, {}});
  ASSERT_FALSE(manifolds.empty());
  for (const Manifold<double>& manifold : manifolds) EXPECT_NEAR(manifold.normal.y(), -1, 1e-12);
  EXPECT_NEAR(deepest(manifolds), -0.03, 1e-14);
}

}  // namespace
}  // namespace contactscope
