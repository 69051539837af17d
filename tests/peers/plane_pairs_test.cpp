#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string_view>
#include <vector>

#include "manifold/dispatch.h"
#include "peers/peer.h"
#include "peers/round_pair.h"
#include "peers/rules.h"

// Spheres, capsules and hulls on a plane through Bullet, ODE, FCL and our own pipeline. The depth
// is that of the lowest point; only ODE, which stops at eight corners, may miss it.
namespace contactscope::peers {
namespace {

using test::Random;

constexpr int kPairs = 500;

struct OnPlane {
  Shape<double> shape;
  Pose<double> pose;
  HalfSpace<double> plane;
  Pose<double> plane_pose;
  Vec3d up;           // world
  double separation;  // of the lowest point, as placed
};

/// A shape up to 0.05 m above the plane's surface or up to 0.2 m deep.
OnPlane random_on_plane(ShapeKind kind, Random& random) {
  // The sphere takes the plane's place and is not used.
  const RoundPair drawn = random_round_pair(kind, ShapeKind::Sphere, random);
  OnPlane result{drawn.a, drawn.pose_a, {{random.unit_vector(), random.uniform(-1, 1)}}, {}, {}, 0};
  result.plane_pose = random.pose(5);
  result.up = result.plane_pose.rotate(result.plane.plane.normal);
  const RoundPair against{result.shape, result.pose, Sphere<double>{1e-3}, {}};
  // The lowest point: separation from a tiny ball at the origin below, plus its radius.
  const double lowest = separation_along(Vec3d(-result.up), against) + 1e-3;
  const double level = result.plane.plane.offset + result.up.dot(result.plane_pose.position);
  const double wanted = random.uniform(-0.2, 0.05);
  result.pose.position += (wanted + level - lowest) * result.up;
  result.separation = wanted;
  return result;
}

void expect_answer(const char* who, double tolerance, const OnPlane& pair, bool touching,
                   double separation, const Vec3d& normal) {
  if (std::abs(pair.separation) <= tolerance) return;
  EXPECT_EQ(touching, pair.separation < 0) << who << ' ' << pair.separation;
  if (!touching) return;
  EXPECT_NEAR(separation, pair.separation, tolerance) << who;
  EXPECT_LE((normal + pair.up).norm(), 1e-5) << who << ": from the shape into the plane";
}

template <class S> void expect_ours(const OnPlane& pair, double tolerance) {
  Manifolds<S> manifolds;
  collide<S>(shape_cast<S>(pair.shape), pair.pose.cast<S>(),
             shape_cast<S>(Shape<double>(pair.plane)), pair.plane_pose.cast<S>(), {}, manifolds);
  double deepest = std::numeric_limits<double>::infinity();
  Vec3d normal = Vec3d::Zero();
  for (const Manifold<S>& manifold : manifolds) {
    normal = manifold.normal.template cast<double>();
    for (const ContactPoint<S>& point : manifold.points) {
      deepest = std::min(deepest, static_cast<double>(point.separation));
    }
  }
  expect_answer("ours", tolerance, pair, !manifolds.empty(), deepest, normal);
}

/// dCollideConvexPlane takes corners below the plane in their order until it has as many as the
/// caller wants, eight in ode.cpp; the lowest may come later.
bool too_many_corners_for_ode(const OnPlane& pair) {
  const auto* hull = std::get_if<Hull<double>>(&pair.shape);
  if (hull == nullptr) return false;
  const double level = pair.plane.plane.offset + pair.up.dot(pair.plane_pose.position);
  const auto below = [&](const Vec3d& vertex) {
    return pair.up.dot(pair.pose.transform(vertex)) < level;
  };
  return std::count_if(hull->vertices.begin(), hull->vertices.end(), below) > 8;
}

void compare_all(ShapeKind kind) {
  Random random(20150307);
  const std::vector<std::unique_ptr<Peer>> peers = make_peers();
  int excused = 0;
  for (int i = 0; i < kPairs; ++i) {
    const OnPlane pair = random_on_plane(kind, random);
    // Coordinates of several metres are rounded to float.
    constexpr double kTolerance = 1e-5;
    expect_ours<float>(pair, kTolerance);
    expect_ours<double>(pair, kTolerance);
    for (const auto& peer : peers) {
      const auto prepared = peer->pair(shape_of(pair.shape), pair.plane);
      ASSERT_NE(prepared, nullptr);
      prepared->place(pair.pose, pair.plane_pose);
      const PeerContact answer = prepared->collide();
      if (std::string_view(peer->name()) == "ODE" && too_many_corners_for_ode(pair)) {
        ++excused;
        EXPECT_TRUE(answer.touching());
        EXPECT_GE(answer.deepest()->separation, pair.separation - kTolerance);
        continue;
      }
      const PeerPoint* deepest = answer.deepest();
      expect_answer(peer->name(), kTolerance, pair, answer.touching(),
                    deepest == nullptr ? 0 : deepest->separation,
                    deepest == nullptr ? Vec3d::Zero() : deepest->normal);
    }
  }
  EXPECT_LE(excused, kPairs / 5);
}

TEST(PlanePairs, SpheresAgreeWithAll) { compare_all(ShapeKind::Sphere); }

TEST(PlanePairs, CapsulesAgreeWithAll) { compare_all(ShapeKind::Capsule); }

TEST(PlanePairs, BoxesAndHullsAgreeWithAll) { compare_all(ShapeKind::Hull); }

}  // namespace
}  // namespace contactscope::peers
