#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "manifold/dispatch.h"
#include "peers/disagreement.h"
#include "peers/mesh_pair.h"
#include "peers/peer.h"
#include "peers/rules.h"
#include "support/brute_force_sat.h"

// Boxes, hulls, spheres and capsules on a mesh of 10,000 triangles through Bullet, ODE, FCL and our
// own pipeline. Exhaustion over the nearby triangles judges touching, depth and normal.
namespace contactscope::peers {
namespace {

using bench::Workload;

constexpr int kPairs = 100;

/// Metres. Closer than this, both answers are accepted: Bullet's GJK has this tolerance.
constexpr double kNearlyTouching = 1e-4;

/// Metres. Bullet rounds coordinates of up to 30 m to float, and its GJK stops at a tenth of a
/// millimetre; the others iterate to a millionth.
double tolerance_on_mesh(const Peer& peer) { return peer.epsilon() > 1e-10 ? 1e-4 : 1e-6; }

Comparison compare_with(const WithTriangle& triangle, const PeerContact& answer, double tolerance) {
  if (const auto* hulls = std::get_if<test::PairCase<double>>(&triangle.pair)) {
    return compare(*hulls, {triangle.separation, triangle.normal}, answer, tolerance);
  }
  return compare(std::get<RoundPair>(triangle.pair), triangle.separation, answer, tolerance);
}

bool explains(std::span<const Rule> rules, const Comparison& comparison) {
  Tally alone(rules);
  alone.add(comparison);
  return alone.unexplained().empty();
}

/// Compares an answer with the deepest triangle for which it is right. If that is not the deepest
/// of all, this too must be explained.
void judge(const std::vector<WithTriangle>& triangles, const PeerContact& answer, double tolerance,
           std::span<const Rule> rules, Tally& tally) {
  const Comparison deepest = compare_with(triangles.front(), answer, tolerance);
  if (deepest.separation > 0 || !answer.touching()) return tally.add(deepest);
  for (const WithTriangle& triangle : triangles) {
    if (triangle.separation > 0) break;
    const Comparison comparison = compare_with(triangle, answer, tolerance);
    if (!explains(rules, comparison)) continue;
    const bool less = triangle.separation > triangles.front().separation + tolerance &&
                      deepest.reported < deepest.depth() - tolerance;
    return less ? tally.add(Aspect::Deepest, deepest) : tally.add(comparison);
  }
  tally.add(deepest);
}

/// Separation along a direction from the triangle for which it is closest to `separation`.
double nearest_gap(const std::vector<WithTriangle>& triangles, const Vec3d& direction,
                   double separation) {
  double best = std::numeric_limits<double>::infinity();
  for (const WithTriangle& triangle : triangles) {
    const auto* hulls = std::get_if<test::PairCase<double>>(&triangle.pair);
    const double gap =
        hulls != nullptr
            ? test::separation_along(direction, hulls->a, hulls->pose_a, hulls->b, hulls->pose_b)
            : separation_along(direction, std::get<RoundPair>(triangle.pair));
    if (std::abs(gap - separation) < std::abs(best - separation)) best = gap;
  }
  return best;
}

/// Checks contact or none and, for each triangle alone, the deepest point's depth and a normal
/// along which it is the overlap. With known internal edges, contacts that lean on one are replaced
/// by a contact on a face: no less deep, and little deeper if the surface is nearly flat.
void expect_right(const OnMesh& pair, const std::vector<WithTriangle>& triangles) {
  const double separation = triangles.front().separation;
  constexpr double kRounding = 1e-13;  // metres: 16 ulps of coordinates of up to 30 m
  CollideOptions options;
  options.preference = Preference::None;
  for (const bool internal_edges : {false, true}) {
    options.internal_edges = internal_edges;
    Manifolds<double> manifolds;
    collide<double>(*pair.shape, pair.pose, *pair.mesh, pair.mesh_pose, options, manifolds);
    EXPECT_EQ(manifolds.empty(), separation > 0) << separation;
    double deepest = std::numeric_limits<double>::infinity();
    Vec3d normal = Vec3d::Zero();
    for (const Manifold<double>& manifold : manifolds) {
      for (const ContactPoint<double>& point : manifold.points) {
        if (point.separation >= deepest) continue;
        deepest = point.separation;
        normal = manifold.normal;
      }
    }
    if (manifolds.empty()) continue;
    EXPECT_LE(deepest, separation + kRounding);
    EXPECT_GE(deepest, (internal_edges ? 1.1 * separation : separation) - kRounding);
    if (internal_edges) continue;
    EXPECT_NEAR(nearest_gap(triangles, normal, separation), separation, kRounding);
  }
}

struct Tallies {
  Tally bullet;
  Tally ode;
  Tally fcl;
};

std::span<const Rule> rules_on_mesh(const Peer& peer, const Shape<double>& shape) {
  const auto* hull = std::get_if<Hull<double>>(&shape);
  if (hull == nullptr) return round_mesh_rules_of(peer);
  return mesh_rules_of(peer, std::holds_alternative<Box>(shape_of(*hull)));
}

Tallies compare_all(const std::vector<OnMesh>& pairs) {
  const std::vector<std::unique_ptr<Peer>> peers = make_peers();
  std::vector<Tally> tallies;
  for (const auto& peer : peers) tallies.emplace_back(rules_on_mesh(*peer, *pairs.front().shape));
  int touching = 0;
  int separated = 0;
  for (const OnMesh& pair : pairs) {
    const std::vector<WithTriangle> triangles = triangles_near(pair);
    const double separation = triangles.front().separation;
    if (std::abs(separation) < kNearlyTouching) continue;
    (separation > 0 ? separated : touching) += 1;
    expect_right(pair, triangles);
    const std::shared_ptr<const Mesh<double>> mesh(pair.mesh, &pair.the_mesh());
    for (std::size_t i = 0; i < peers.size(); ++i) {
      const auto prepared = peers[i]->pair(shape_of(*pair.shape), mesh);
      if (!prepared) continue;
      prepared->place(pair.pose, pair.mesh_pose);
      const PeerContact answer = prepared->collide();
      EXPECT_FALSE(answer.failed);
      judge(triangles, answer, tolerance_on_mesh(*peers[i]), rules_on_mesh(*peers[i], *pair.shape),
            tallies[i]);
    }
  }
  EXPECT_GT(touching, kPairs / 3);
  EXPECT_GT(separated, kPairs / 4);
  for (std::size_t i = 0; i < peers.size(); ++i) {
    EXPECT_EQ(tallies[i].unexplained(), "") << peers[i]->name();
    std::printf("%-6s %s\n", peers[i]->name(), tallies[i].summary().c_str());
  }
  return {tallies[0], tallies[1], tallies[2]};
}

TEST(MeshPairs, BoxesDifferByNamedRules) {
  const Tallies tallies = compare_all(hulls_on_mesh(Workload::BoxMesh, kPairs));
  EXPECT_GE(tallies.bullet.agreed(), kPairs - 20);
  EXPECT_GE(tallies.ode.agreed(), kPairs - 40);
  EXPECT_GT(tallies.ode.count(kEdgeFactorOnMesh), 0);
  EXPECT_GE(tallies.fcl.agreed(), kPairs - 10);
}

TEST(MeshPairs, HullsDifferByNamedRules) {
  const Tallies tallies = compare_all(hulls_on_mesh(Workload::HullMesh, kPairs));
  EXPECT_GE(tallies.bullet.agreed(), kPairs - 20);
  EXPECT_EQ(tallies.ode.compared(), 0) << "ODE has no such pair";
  EXPECT_GE(tallies.fcl.agreed(), kPairs - 10);
}

TEST(MeshPairs, SpheresDifferByNamedRules) {
  const Tallies tallies = compare_all(rounds_on_mesh(ShapeKind::Sphere, kPairs));
  EXPECT_GE(tallies.bullet.agreed(), kPairs - 10);
  EXPECT_EQ(tallies.ode.agreed(), kPairs);
  EXPECT_EQ(tallies.fcl.count(kSphereSign), kPairs / 2) << "all that touch";
}

TEST(MeshPairs, CapsulesDifferByNamedRules) {
  const Tallies tallies = compare_all(rounds_on_mesh(ShapeKind::Capsule, kPairs));
  EXPECT_GE(tallies.bullet.agreed(), kPairs - 10);
  EXPECT_EQ(tallies.ode.agreed(), tallies.ode.compared());
  EXPECT_GE(tallies.fcl.agreed(), kPairs - 20);
}

TEST(MeshPairs, NoRuleExplainsAWrongAnswer) {
  const std::vector<std::unique_ptr<Peer>> peers = make_peers();
  const std::vector<OnMesh> drawn[] = {
      hulls_on_mesh(Workload::BoxMesh, 10), hulls_on_mesh(Workload::HullMesh, 10),
      rounds_on_mesh(ShapeKind::Sphere, 10), rounds_on_mesh(ShapeKind::Capsule, 10)};
  for (const std::vector<OnMesh>& pairs : drawn) {
    int judged = 0;
    for (const OnMesh& pair : pairs) {
      const std::vector<WithTriangle> triangles = triangles_near(pair);
      if (triangles.front().separation > -0.003) continue;
      ++judged;
      for (const auto& peer : peers) {
        const std::shared_ptr<const Mesh<double>> mesh(pair.mesh, &pair.the_mesh());
        const auto prepared = peer->pair(shape_of(*pair.shape), mesh);
        if (!prepared) continue;
        prepared->place(pair.pose, pair.mesh_pose);
        const PeerContact right = prepared->collide();
        const std::span<const Rule> rules = rules_on_mesh(*peer, *pair.shape);
        const auto judged_as = [&](const PeerContact& answer) {
          Tally tally(rules);
          judge(triangles, answer, tolerance_on_mesh(*peer), rules, tally);
          return tally;
        };
        const auto unexplained = [&](const PeerContact& answer) {
          return judged_as(answer).unexplained();
        };
        if (judged_as(right).agreed() == 0) continue;  // its habits show here
        EXPECT_NE(unexplained({}), "") << peer->name() << " finds nothing";
        PeerContact wrong = right;
        for (PeerPoint& point : wrong.points) point.normal = -point.normal;
        EXPECT_NE(unexplained(wrong), "") << peer->name() << " has the normal reversed";
        wrong = right;
        for (PeerPoint& point : wrong.points) point.separation *= 8;
        EXPECT_NE(unexplained(wrong), "") << peer->name() << " is too deep";
        // Another triangle may be half as deep.
        if (triangles.size() > 1 && triangles[1].separation <= 0) continue;
        wrong = right;
        for (PeerPoint& point : wrong.points) point.separation *= 0.5;
        EXPECT_NE(unexplained(wrong), "") << peer->name() << " is not deep enough";
      }
    }
    EXPECT_GE(judged, 2);
  }
}

}  // namespace
}  // namespace contactscope::peers
