#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "manifold/dispatch.h"
#include "peers/disagreement.h"
#include "peers/peer.h"
#include "peers/round_pair.h"
#include "peers/rules.h"

// Spheres and capsules, with each other and with hulls, through Bullet, ODE, FCL and our own
// pipeline, as in hull_pairs_test.cpp; judged by exhaustion.
namespace contactscope::peers {
namespace {

using test::Random;

constexpr int kPairs = 600;

/// Checks contact or none, depth, and a normal along which the overlap is least.
template <class S> void expect_right(const RoundPair& pair, double separation) {
  // Hulls have planes that were rounded to float.
  const double rounding = 32 * std::numeric_limits<float>::epsilon() * length_scale(pair);
  if (std::abs(separation) <= rounding) return;
  CollideOptions options;
  options.preference = Preference::None;
  Manifolds<S> manifolds;
  collide<S>(shape_cast<S>(pair.a), pair.pose_a.cast<S>(), shape_cast<S>(pair.b),
             pair.pose_b.cast<S>(), options, manifolds);
  EXPECT_EQ(manifolds.empty(), separation > 0) << separation;
  if (manifolds.empty()) return;
  const Manifold<S>& manifold = manifolds.front();
  double deepest = std::numeric_limits<double>::infinity();
  for (const ContactPoint<S>& point : manifold.points) {
    deepest = std::min(deepest, static_cast<double>(point.separation));
  }
  EXPECT_NEAR(deepest, separation, rounding);
  const Vec3d normal = manifold.normal.template cast<double>();
  EXPECT_NEAR(separation_along(normal, pair), separation, rounding);
}

struct Tallies {
  Tally bullet;
  Tally ode;
  Tally fcl;
};

Tallies compare_all(ShapeKind a, ShapeKind b) {
  const std::vector<std::unique_ptr<Peer>> peers = make_peers();
  std::vector<Tally> tallies;
  for (const auto& peer : peers) tallies.emplace_back(round_rules_of(*peer));
  Random random(20150305);
  int touching = 0;
  for (int k = 0; k < kPairs; ++k) {
    const RoundPair pair = random_round_pair(a, b, random);
    const double separation = separation_by_exhaustion(pair);
    touching += separation < 0 ? 1 : 0;
    expect_right<float>(pair, separation);
    expect_right<double>(pair, separation);
    for (std::size_t i = 0; i < peers.size(); ++i) {
      const auto prepared = peers[i]->pair(shape_of(pair.a), shape_of(pair.b));
      prepared->place(pair.pose_a, pair.pose_b);
      const PeerContact answer = prepared->collide();
      EXPECT_FALSE(answer.failed);
      const double tolerance = tolerance_of(*peers[i], length_scale(pair));
      tallies[i].add(compare(pair, separation, answer, tolerance));
    }
  }
  EXPECT_GT(touching, kPairs / 3);
  for (std::size_t i = 0; i < peers.size(); ++i) {
    EXPECT_EQ(tallies[i].unexplained(), "") << peers[i]->name();
    std::printf("%-6s %s\n", peers[i]->name(), tallies[i].summary().c_str());
  }
  return {tallies[0], tallies[1], tallies[2]};
}

TEST(RoundPairs, SpheresAgreeWithAll) {
  const Tallies tallies = compare_all(ShapeKind::Sphere, ShapeKind::Sphere);
  EXPECT_EQ(tallies.bullet.agreed(), kPairs);
  EXPECT_EQ(tallies.ode.agreed(), kPairs);
  EXPECT_EQ(tallies.fcl.agreed(), kPairs);
}

TEST(RoundPairs, SpheresOnCapsulesAgreeWithAll) {
  const Tallies tallies = compare_all(ShapeKind::Sphere, ShapeKind::Capsule);
  EXPECT_EQ(tallies.bullet.agreed(), kPairs);
  EXPECT_EQ(tallies.ode.agreed(), kPairs);
  EXPECT_EQ(tallies.fcl.agreed(), kPairs);
}

TEST(RoundPairs, CapsulesAgreeWithAllThatDoNotIterate) {
  const Tallies tallies = compare_all(ShapeKind::Capsule, ShapeKind::Capsule);
  EXPECT_GE(tallies.bullet.agreed(), kPairs - 3);
  EXPECT_EQ(tallies.ode.agreed(), kPairs);
  EXPECT_GT(tallies.fcl.count(kExitDepth), 0);
}

TEST(RoundPairs, SpheresOnHullsDifferByNamedRules) {
  const Tallies tallies = compare_all(ShapeKind::Sphere, ShapeKind::Hull);
  EXPECT_GE(tallies.bullet.agreed(), 440);
  EXPECT_GT(tallies.bullet.count(kEpaAccuracy), 0);
  EXPECT_GE(tallies.ode.agreed(), 350);
  EXPECT_GE(tallies.fcl.agreed(), 350);
}

TEST(RoundPairs, CapsulesOnHullsDifferByNamedRules) {
  const Tallies tallies = compare_all(ShapeKind::Capsule, ShapeKind::Hull);
  EXPECT_GE(tallies.bullet.agreed(), 440);
  EXPECT_GT(tallies.bullet.count(kEpaAccuracy), 0);
  EXPECT_GE(tallies.ode.agreed(), 300);
  EXPECT_LE(tallies.ode.count(kCapsuleAsBox), 35);
  EXPECT_GE(tallies.fcl.agreed(), 300);
}

TEST(RoundPairs, NoRuleExplainsAWrongAnswer) {
  const auto judged = [](const Peer& peer, const RoundPair& pair, const PeerContact& answer) {
    Tally tally(round_rules_of(peer));
    const double tolerance = tolerance_of(peer, length_scale(pair));
    tally.add(compare(pair, separation_by_exhaustion(pair), answer, tolerance));
    return tally.unexplained();
  };
  Random random(20150306);
  int judgements = 0;
  while (judgements < 50) {
    const RoundPair pair = random_round_pair(ShapeKind::Capsule, ShapeKind::Hull, random);
    if (separation_by_exhaustion(pair) > -0.01) continue;
    ++judgements;
    for (const auto& peer : make_peers()) {
      const auto prepared = peer->pair(shape_of(pair.a), shape_of(pair.b));
      prepared->place(pair.pose_a, pair.pose_b);
      const PeerContact right = prepared->collide();
      EXPECT_NE(judged(*peer, pair, PeerContact{}), "") << peer->name() << " finds nothing";
      PeerContact wrong = right;
      for (PeerPoint& point : wrong.points) point.normal = -point.normal;
      EXPECT_NE(judged(*peer, pair, wrong), "") << peer->name() << " has the normal reversed";
      wrong = right;
      for (PeerPoint& point : wrong.points) point.separation *= 8;
      EXPECT_NE(judged(*peer, pair, wrong), "") << peer->name() << " is too deep";
      wrong = right;
      for (PeerPoint& point : wrong.points) point.separation *= 0.5;
      EXPECT_NE(judged(*peer, pair, wrong), "") << peer->name() << " is not deep enough";
    }
  }
}

}  // namespace
}  // namespace contactscope::peers
