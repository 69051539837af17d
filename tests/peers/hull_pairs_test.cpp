#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "bench/workload.h"
#include "manifold/collide_pairs.h"
#include "peers/disagreement.h"
#include "peers/peer.h"
#include "peers/rules.h"
#include "support/brute_force_sat.h"
#include "support/builders.h"
#include "support/pair_case.h"

// The same pairs of hulls through Bullet, ODE, FCL and our own pipeline, judged by brute force.
// Ours must always be right; theirs must be, unless a rule of rules.h explains why not.
namespace contactscope::peers {
namespace {

using bench::Workload;
using test::PairCase;
using test::Random;

/// Rounded to float, because Bullet rounds.
PairCase<double> in_float(const PairCase<double>& pair) {
  PairCase<double> result = pair.cast<float>().cast<double>();
  result.pose_a.rotation.normalize();
  result.pose_b.rotation.normalize();
  return result;
}

std::vector<PairCase<double>> pairs_of(Workload workload, int count) {
  std::vector<PairCase<double>> result;
  const std::vector<bench::WorkloadPair> made = bench::make_workload(workload, count);
  for (const bench::WorkloadPair& pair : made) {
    const bench::Placement& placed = pair.steps.front();
    result.push_back(in_float(
        {std::get<Hull<double>>(*pair.a), placed.a, std::get<Hull<double>>(*pair.b), placed.b}));
  }
  return result;
}

bool both_boxes(const PairCase<double>& pair) {
  return std::holds_alternative<Box>(shape_of(pair.a)) &&
         std::holds_alternative<Box>(shape_of(pair.b));
}

template <class S> Manifold<S> ours(const PairCase<double>& pair) {
  CollideOptions options;
  options.preference = Preference::None;
  return test::collide(pair.template cast<S>(), options);
}

/// Tests ours: contact or none, depth, and a normal along which the overlap is least.
template <class S>
void expect_right(const PairCase<double>& pair, const test::BruteForceAxis& truth) {
  // The planes of these hulls have been rounded to float.
  const double rounding = 32 * std::numeric_limits<float>::epsilon() * test::length_scale(pair);
  if (std::abs(truth.separation) <= rounding) return;
  const Manifold<S> manifold = ours<S>(pair);
  EXPECT_EQ(manifold.points.empty(), truth.separation > 0) << truth.separation;
  if (manifold.points.empty()) return;
  EXPECT_NEAR(test::deepest(manifold), truth.separation, rounding);
  const Vec3d normal = manifold.normal.template cast<double>();
  EXPECT_NEAR(test::separation_along(normal, pair.a, pair.pose_a, pair.b, pair.pose_b),
              truth.separation, rounding);
}

std::vector<std::unique_ptr<Peer>>& peers() {
  static std::vector<std::unique_ptr<Peer>> made = make_peers();
  return made;
}

PeerContact answer_of(Peer& peer, const PairCase<double>& pair) {
  const std::unique_ptr<PeerPair> prepared = peer.pair(shape_of(pair.a), shape_of(pair.b));
  prepared->place(pair.pose_a, pair.pose_b);
  return prepared->collide();
}

struct Tallies {
  Tally bullet;
  Tally ode;
  Tally fcl;
};

/// Fails if one of ours is wrong or a difference is unexplained.
Tallies compare_all(const std::vector<PairCase<double>>& pairs) {
  const bool boxes = both_boxes(pairs.front());
  std::vector<Tally> tallies;
  for (const auto& peer : peers()) tallies.emplace_back(rules_of(*peer, boxes));
  for (const PairCase<double>& pair : pairs) {
    const test::BruteForceAxis truth =
        test::brute_force_sat(pair.a, pair.pose_a, pair.b, pair.pose_b);
    expect_right<float>(pair, truth);
    expect_right<double>(pair, truth);
    for (std::size_t i = 0; i < tallies.size(); ++i) {
      const PeerContact answer = answer_of(*peers()[i], pair);
      EXPECT_FALSE(answer.failed);
      tallies[i].add(
          compare(pair, truth, answer, tolerance_of(*peers()[i], test::length_scale(pair))));
    }
  }
  for (std::size_t i = 0; i < tallies.size(); ++i) {
    EXPECT_EQ(tallies[i].unexplained(), "") << peers()[i]->name();
    std::printf("%-6s %s\n", peers()[i]->name(), tallies[i].summary().c_str());
  }
  return {tallies[0], tallies[1], tallies[2]};
}

std::vector<PairCase<double>> everyday_pairs(bool boxes, std::size_t count) {
  Random random(20150303);
  std::vector<PairCase<double>> result;
  while (result.size() < count) {
    const PairCase<double> pair = in_float(test::everyday_pair(random));
    if (both_boxes(pair) == boxes) result.push_back(pair);
  }
  return result;
}

TEST(HullPairs, BoxesOnFacesAgreeWithAll) {
  const Tallies tallies = compare_all(pairs_of(Workload::BoxFace, 512));
  for (const Tally* tally : {&tallies.bullet, &tallies.ode, &tallies.fcl}) {
    EXPECT_EQ(tally->agreed(), 512);
  }
}

TEST(HullPairs, BoxesOnCrossedEdgesAgreeWithAll) {
  const Tallies tallies = compare_all(pairs_of(Workload::BoxEdge, 512));
  for (const Tally* tally : {&tallies.bullet, &tallies.ode, &tallies.fcl}) {
    EXPECT_EQ(tally->agreed(), 512);
  }
}

// The bounds are about a third above the numbers on Debian 12.
TEST(HullPairs, BoxesInRandomPosesDifferWhereTheEdgeFactorDecides) {
  const Tallies tallies = compare_all(pairs_of(Workload::BoxRandom, 1024));
  for (const Tally* tally : {&tallies.bullet, &tallies.ode, &tallies.fcl}) {
    EXPECT_GE(tally->agreed(), 900);
    EXPECT_LE(tally->count(kEdgeFactor), 100);
    EXPECT_GE(tally->count(kEdgeFactor), 50);
    EXPECT_LE(tally->count(kCornerOutside), 70);
  }
  EXPECT_LE(tallies.bullet.count(kCosineFudge), 15);
}

TEST(HullPairs, BoxesNearAKissAndDeepDifferByNamedRules) {
  const Tallies tallies = compare_all(everyday_pairs(true, 1000));
  for (const Tally* tally : {&tallies.bullet, &tallies.ode, &tallies.fcl}) {
    EXPECT_GE(tally->agreed(), 870);
    EXPECT_LE(tally->count(kEdgeFactor), 60);
    EXPECT_LE(tally->count(kCornerOutside), 20);
  }
  EXPECT_LE(tallies.bullet.count(kCosineFudge), 25);
  EXPECT_LE(tallies.bullet.count(kMerged), 70);
  EXPECT_GT(tallies.bullet.count(kMerged), 0);
}

TEST(HullPairs, HullsAFewMillimetresDeepDifferByNamedRules) {
  const Tallies tallies = compare_all(pairs_of(Workload::Hull32, 512));
  EXPECT_GE(tallies.ode.agreed(), 505);
  EXPECT_GE(tallies.fcl.agreed(), 505);
  EXPECT_GE(tallies.bullet.count(kFacePlane), 400);
  EXPECT_LE(tallies.bullet.count(kEpaAccuracy), 5);
}

TEST(HullPairs, HullsNearAKissAndDeepDifferByNamedRules) {
  const Tallies tallies = compare_all(everyday_pairs(false, 2000));
  EXPECT_GE(tallies.ode.agreed(), 1550);
  EXPECT_GE(tallies.fcl.agreed(), 1550);
  EXPECT_GT(tallies.ode.count(kExitDepth), 0);
  EXPECT_GT(tallies.fcl.count(kExitDepth), 0);
  EXPECT_GE(tallies.bullet.agreed(), 1050);
  EXPECT_LE(tallies.bullet.count(kMinDistance), 210);
  EXPECT_GT(tallies.bullet.count(kMinDistance), 0);
  EXPECT_LE(tallies.bullet.count(kEpaAccuracy), 30);
  EXPECT_LE(tallies.bullet.count(kClamped), 60);
  EXPECT_LE(tallies.bullet.count(kGaveUp), 2);
}

/// The largest distance, across the normal, from a point of one manifold to the other's nearest.
double distance_across(const Manifold<double>& manifold, const PeerContact& answer) {
  double worst = 0;
  const auto across = [&](const Vec3d& one, const Vec3d& other) {
    return manifold.normal.cross(one - other).norm();
  };
  for (const ContactPoint<double>& point : manifold.points) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const PeerPoint& other : answer.points) {
      nearest = std::min(nearest, across(point.position, other.position));
    }
    worst = std::max(worst, nearest);
  }
  for (const PeerPoint& point : answer.points) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const ContactPoint<double>& other : manifold.points) {
      nearest = std::min(nearest, across(point.position, other.position));
    }
    worst = std::max(worst, nearest);
  }
  return worst;
}

TEST(HullPairs, OdeClipsBoxFacesToTheSamePolygon) {
  Peer& ode = *peers()[1];
  for (const PairCase<double>& pair : pairs_of(Workload::BoxFace, 512)) {
    const Manifold<double> manifold = ours<double>(pair);
    const PeerContact answer = answer_of(ode, pair);
    ASSERT_EQ(manifold.points.size(), answer.points.size());
    // A point may lie on either surface or between them: 10 mm at 3 mrad.
    ASSERT_LE(distance_across(manifold, answer), 3e-5);
  }
}

TEST(HullPairs, CrossedBoxEdgesMeetAtTheSamePlaceInAll) {
  for (const PairCase<double>& pair : pairs_of(Workload::BoxEdge, 512)) {
    const Manifold<double> manifold = ours<double>(pair);
    ASSERT_EQ(manifold.points.size(), 1u);
    for (const auto& peer : peers()) {
      const PeerContact answer = answer_of(*peer, pair);
      ASSERT_EQ(answer.points.size(), 1u) << peer->name();
      ASSERT_LE(distance_across(manifold, answer), 1e-4) << peer->name();
    }
  }
}

TEST(HullPairs, NoRuleExplainsAWrongAnswer) {
  const auto judged = [](const Peer& peer, const PairCase<double>& pair, PeerContact answer) {
    Tally tally(rules_of(peer, both_boxes(pair)));
    const test::BruteForceAxis truth =
        test::brute_force_sat(pair.a, pair.pose_a, pair.b, pair.pose_b);
    tally.add(compare(pair, truth, answer, tolerance_of(peer, test::length_scale(pair))));
    return tally.unexplained();
  };
  for (const Workload workload : {Workload::BoxEdge, Workload::Hull32}) {
    const PairCase<double> pair = pairs_of(workload, 1).front();
    for (const auto& peer : peers()) {
      const PeerContact right = answer_of(*peer, pair);
      EXPECT_EQ(judged(*peer, pair, right), "") << peer->name();
      EXPECT_NE(judged(*peer, pair, PeerContact{}), "") << peer->name() << " finds nothing";
      PeerContact wrong = right;
      for (PeerPoint& point : wrong.points) point.normal = -point.normal;
      EXPECT_NE(judged(*peer, pair, wrong), "") << peer->name() << " has the normal reversed";
      wrong = right;
      for (PeerPoint& point : wrong.points) point.separation *= 8;
      EXPECT_NE(judged(*peer, pair, wrong), "") << peer->name() << " is too deep";
    }
  }
}

}  // namespace
}  // namespace contactscope::peers
