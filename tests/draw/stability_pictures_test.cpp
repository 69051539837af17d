// Pictures of incremental manifolds, stability and solvers, from facts by hand.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "crate_on_slab.h"
#include "draw/scene/palette.h"
#include "draw/scene/quantity.h"
#include "draw/staging.h"

namespace contactscope::draw {
namespace {

using crate_sample::CrateOnSlab;
using crate_sample::same;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

std::vector<MarkKind> marks(const Sketch& sketch) {
  std::vector<MarkKind> kinds;
  for (const Mark& mark : sketch.marks) kinds.push_back(mark.kind);
  return kinds;
}

std::vector<std::string> labels(const Sketch& sketch) {
  std::vector<std::string> texts;
  for (const Label& label : sketch.labels) texts.push_back(label.text);
  return texts;
}

std::vector<std::string> legend(const Sketch& sketch) {
  std::vector<std::string> texts;
  for (const LegendEntry& entry : sketch.legend.sorted()) texts.push_back(entry.text);
  return texts;
}

TEST(IncrementalPicture, NewIsFilledPersistedHalfFilledAndBrokenHollowWithItsReason) {
  CrateOnSlab scene;
  scene.persist();
  scene.view.layers = {Layer::Persistent};
  const Sketch sketch = scene.sketch();
  std::vector<MarkKind> states = marks(sketch);
  std::erase(states, MarkKind::Core);  // of the anchors
  EXPECT_THAT(states, ElementsAre(MarkKind::Hollow, MarkKind::Half, MarkKind::Dot));
  EXPECT_THAT(labels(sketch), ElementsAre(HasSubstr(" mm apart, slid"), "7", "new"));
  EXPECT_THAT(legend(sketch), Contains("new point"));
  EXPECT_THAT(legend(sketch), Contains("taken out, and why"));
}

TEST(IncrementalPicture, AReplacedPointHasALineToItsReplacementAndTheDistance) {
  CrateOnSlab scene;
  scene.persist();
  std::vector<trace::PersistentPoint>& points = scene.pair().incremental->points;
  const auto broken = std::ranges::find(points, "broken", &trace::PersistentPoint::state);
  ASSERT_NE(broken, points.end());
  broken->reason = "replaced";
  for (trace::PersistentPoint& point : points) {
    point.point.on_a = point.point.on_b = point.point.position;
    if (point.state == "broken") continue;
    point.point.position = broken->point.position + Vec3d(point.state == "new" ? 0.125 : 0.5, 0, 0);
    point.point.on_a = point.point.on_b = point.point.position;
  }
  scene.view.layers = {Layer::Persistent};
  const Sketch sketch = scene.sketch();
  EXPECT_THAT(labels(sketch), Contains("replaced"));
  EXPECT_THAT(labels(sketch), Contains("0.125 m"));
  ASSERT_EQ(sketch.arrows.size(), 1u);
  const Vec3d offset = *sketch.arrows[0].to - sketch.arrows[0].from;
  EXPECT_LT(offset.norm(), 0.125) << "up to the border of the dot";
  EXPECT_NEAR(offset.normalized().x(), 1, 1e-12);
}

TEST(IncrementalPicture, DriftOfAnchorsIsDrawnToAStatedFactorAndNotWhereADotHidesIt) {
  CrateOnSlab scene;
  scene.persist();
  for (trace::PersistentPoint& point : scene.pair().incremental->points) {
    point.point.on_a = point.point.on_b = point.point.position;
  }
  trace::PersistentPoint& drifted = scene.pair().incremental->points[0];
  drifted.point.on_a->x() += 0.002;
  scene.view.layers = {Layer::Persistent};
  const Staging staging = scene.staged();
  EXPECT_GT(staging.scales.drift, 1);
  const Sketch sketch = sketch_frame(staging, scene.frames[0]);
  ASSERT_EQ(sketch.lines.size(), 2u);  // a halo and the line, of only one point
  EXPECT_NEAR((sketch.lines[1].to - sketch.lines[1].from).norm(), 0.002 * staging.scales.drift,
              1e-12);
  EXPECT_THAT(legend(sketch), Contains(HasSubstr("× ")));
}

TEST(IncrementalPicture, CoreOfABoxIsASmallerBoxWithTwelveDashedEdges) {
  CrateOnSlab scene;
  scene.persist();
  scene.pair().incremental->margin_a = 0;
  scene.view.layers = {Layer::Core};
  const Staging staging = scene.staged();
  const Sketch sketch = sketch_frame(staging, scene.frames[0]);
  ASSERT_EQ(sketch.lines.size(), 12u);
  for (const Line& line : sketch.lines) {
    EXPECT_TRUE(line.style.dashed);
    EXPECT_NEAR((line.to - line.from).norm(), 0.8, 1e-12);
    EXPECT_NEAR(line.from.x() * line.from.x(), 0.16, 1e-12);
    EXPECT_NEAR(line.from.z() * line.from.z(), 0.16, 1e-12);
  }
  EXPECT_THAT(legend(sketch), ElementsAre("core, 100 mm within the faces",
                                          "core and margin: the surface that touches"));
  // The touching surface is the outline of everything within 0.1 m of the core: rays of the eye
  // touch it there, and it is inside the crate.
  ASSERT_EQ(sketch.curves.size(), 1u);
  const Vec3d center = scene.frames[0].poses[1].second.position;
  for (const Vec3d& place : sketch.curves[0].points) {
    const Vec3d local = place - center;
    const Vec3d nearest = local.cwiseMax(Vec3d::Constant(-0.4)).cwiseMin(Vec3d::Constant(0.4));
    EXPECT_NEAR((local - nearest).norm(), 0.1, 1e-9);
    const Vec3d ray = staging.camera.to_eye(place);
    EXPECT_NEAR((local - nearest).normalized().dot(ray), 0, 1e-6);
    EXPECT_LE(local.lpNorm<Eigen::Infinity>(), 0.5 + 1e-9);
  }
}

/// Sets the distance of the cores of crate and slab by GJK, at the crate's first corner.
void part_cores(CrateOnSlab& scene, double distance) {
  scene.persist();
  scene.pair().incremental->query = "gjk";
  trace::Gjk& gjk = scene.pair().gjk.emplace();
  gjk.status = "separated";
  gjk.distance = distance;
  gjk.point_a = Vec3d(-0.4, -0.05, 0.4);
  gjk.point_b = gjk.point_a + Vec3d(0, distance, 0);
  scene.view.layers = {Layer::Core};
}

TEST(IncrementalPicture, DistanceOfTheCoresIsBothMarginsAndTheGapOrLessTheOverlap) {
  for (const double distance : {0.35, 0.11}) {
    CrateOnSlab scene;
    part_cores(scene, distance);  // margins of 0.05 and 0.1
    const Sketch sketch = scene.sketch();
    ASSERT_EQ(sketch.arrows.size(), 2u);
    EXPECT_NEAR((*sketch.arrows[0].to - sketch.arrows[0].from).norm(), distance, 1e-12);
    EXPECT_TRUE(same(sketch.arrows[0].color, kAxis));
    const Vec3d left = *sketch.arrows[1].to - sketch.arrows[1].from;
    EXPECT_NEAR(left.y(), distance - 0.15, 1e-12);
    EXPECT_TRUE(same(sketch.arrows[1].color, distance > 0.15 ? kAxis : kContact));
    EXPECT_THAT(labels(sketch), ElementsAre("A's margin 50.0 mm", "B's margin 100 mm",
                                            distance > 0.15 ? "gap 200 mm" : "overlap 40.0 mm",
                                            "cores " + spell_margin(distance) + " apart"));
  }
}

TEST(IncrementalPicture, OverlappingCoresShowTheDepthAndTheMethod) {
  CrateOnSlab scene;
  scene.persist();
  scene.pair().incremental->query = "sat";
  trace::PersistentPoint& deepest = scene.pair().incremental->points[1];
  deepest.point.separation = -0.2;  // 0.15 of this are the margins
  deepest.point.on_a = Vec3d(0.5, 0.1, 0.5);
  deepest.point.on_b = Vec3d(0.5, -0.1, 0.5);
  scene.view.layers = {Layer::Core};
  const Sketch sketch = scene.sketch();
  EXPECT_THAT(labels(sketch), ElementsAre("cores overlap 50.0 mm, by SAT", "A's margin 50.0 mm",
                                          "B's margin 100 mm"));
  ASSERT_EQ(sketch.arrows.size(), 1u);
  // Next to the whole overlap, which is the contact's whisker.
  const Vec3d from = sketch.arrows[0].from, to = *sketch.arrows[0].to;
  EXPECT_NEAR((to - from - Vec3d(0, -0.05, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR(from.y(), 0.05, 1e-12);
  EXPECT_GT((from - Vec3d(0.5, 0.05, 0.5)).norm(), 0.01);
}

TEST(IncrementalPicture, WithoutThoseFactsTheirLayersDrawNothing) {
  CrateOnSlab scene;
  scene.view.layers = {Layer::Persistent, Layer::Core,       Layer::CenterOfMass,
                       Layer::Support,    Layer::Velocities, Layer::Impulses};
  const Sketch sketch = scene.sketch();
  EXPECT_TRUE(sketch.lines.empty() && sketch.marks.empty() && sketch.arrows.empty());
  EXPECT_TRUE(sketch.labels.empty() && sketch.curves.empty() && sketch.surfaces.empty());
  EXPECT_TRUE(legend(sketch).empty());
}

TEST(StabilityPicture, CentreOfMassIsQuarteredAndDashedDownToItsProjection) {
  CrateOnSlab scene;
  scene.balance("stable");
  scene.view.layers = {Layer::CenterOfMass};
  const Sketch sketch = scene.sketch();
  EXPECT_THAT(marks(sketch), ElementsAre(MarkKind::Quartered, MarkKind::SmallQuartered));
  ASSERT_EQ(sketch.lines.size(), 2u);
  EXPECT_TRUE(sketch.lines[1].style.dashed);
  EXPECT_EQ(sketch.lines[1].to, scene.pair().stability->projection);
  EXPECT_THAT(legend(sketch), ElementsAre("centre of mass, and its projection"));
}

TEST(StabilityPicture, BodiesWithoutContactHaveACentreOfMassToo) {
  CrateOnSlab scene;
  scene.solve(1);
  scene.view.layers = {Layer::CenterOfMass};
  const Sketch sketch = scene.sketch();
  EXPECT_THAT(marks(sketch), ElementsAre(MarkKind::Quartered));
  EXPECT_THAT(legend(sketch), ElementsAre("centre of mass"));
}

TEST(StabilityPicture, StableBodyShowsItsMarginAndHasNoAxis) {
  CrateOnSlab scene;
  scene.balance("stable");
  scene.view.layers = {Layer::Support};
  const Sketch sketch = scene.sketch();
  EXPECT_THAT(labels(sketch), ElementsAre("stable, 250 mm inside"));
  EXPECT_TRUE(sketch.curves.empty() && sketch.arrows.empty());
  EXPECT_THAT(legend(sketch), ElementsAre("support: hull of the contact points"));
}

TEST(StabilityPicture, AtCloseRangeTheDistanceToTheBorderIsShown) {
  CrateOnSlab scene;
  scene.balance("stable");
  const Vec3d from = scene.pair().stability->projection;
  scene.view.layers = {Layer::Support};
  scene.view.target = from;
  scene.view.eye = Vec3d(from + Vec3d(0.2, 1.5, 1.5));
  const Sketch sketch = scene.sketch();
  EXPECT_THAT(labels(sketch), ElementsAre("250 mm inside", "stable"));
  ASSERT_EQ(sketch.arrows.size(), 1u);
  EXPECT_TRUE(sketch.arrows[0].double_headed);
  EXPECT_EQ(sketch.arrows[0].from, from);
}

TEST(StabilityPicture, PanelIsExplainedWhereNoLayerShowsTheSame) {
  CrateOnSlab scene;
  const auto picture_legend = [&] {
    std::vector<std::string> texts;
    for (const LegendEntry& entry : legend_of(scene.staged(), scene.frames[0]).listed)
      texts.push_back(entry.text);
    return texts;
  };
  scene.balance("turns about a line");
  scene.view.panels = {Panel::Stability};
  EXPECT_THAT(picture_legend(),
              ElementsAre("support: a line between two points", "axis about which the body turns",
                          "margin: to the border of the support"));
  scene.pair().stability->margin = 0;  // in balance: no such arrow
  EXPECT_THAT(picture_legend(),
              ElementsAre("support: a line between two points", "axis about which the body turns"));
  scene.view.layers = {Layer::Support};
  EXPECT_THAT(picture_legend(),
              ElementsAre("support: a line between two points", "axis about which the body turns"));
}

TEST(StabilityPicture, FreeAxisIsNamedAndTurnsAsTheBodyFalls) {
  CrateOnSlab scene;
  scene.balance("turns about a line");
  scene.view.layers = {Layer::Support};
  const Sketch sketch = scene.sketch();
  EXPECT_THAT(labels(sketch), ElementsAre("unstable: turns about a line"));
  EXPECT_THAT(legend(sketch), Contains("axis about which the body turns"));
  // The crate's centre has a smaller z than the axis, so it sinks on that side.
  ASSERT_EQ(sketch.arrows.size(), 1u);
  const Arrow& tip = sketch.arrows[0];
  const std::vector<Vec3d>& arc = sketch.curves.back().points;
  const Vec3d center = 0.5 * (arc.front() + arc[arc.size() / 2]);
  const Vec3d turn = (tip.from - center).cross(*tip.to - tip.from);
  EXPECT_LT(turn.x(), 0) << "the top towards smaller z is a negative turn about x";
  EXPECT_NEAR(turn.normalized().x(), -1, 0.1);
}

TEST(StabilityPicture, BodyOnOnePointTurnsAboutItTowardsItsCentreOfMass) {
  CrateOnSlab scene;
  scene.balance("turns about a point");
  trace::Stability& stability = *scene.pair().stability;
  stability.axis.reset();
  stability.support = {stability.projection + Vec3d(0.5, 0, 0)};
  stability.margin = -0.5;
  scene.view.layers = {Layer::Support};
  const Sketch sketch = scene.sketch();
  EXPECT_THAT(legend(sketch), ElementsAre("axis about which the body turns"));
  ASSERT_EQ(sketch.arrows.size(), 1u);
  const std::vector<Vec3d>& arc = sketch.curves.back().points;
  const Vec3d center = 0.5 * (arc.front() + arc[arc.size() / 2]);
  const Arrow& tip = sketch.arrows[0];
  EXPECT_GT((tip.from - center).cross(*tip.to - tip.from).normalized().z(), 0.9);
}

TEST(DynamicsPicture, ArrowsHaveTheLengthOfTheLegend) {
  CrateOnSlab scene;
  scene.solve(2);
  scene.view.layers = {Layer::Velocities, Layer::Impulses};
  const Staging staging = scene.staged();
  const Sketch sketch = sketch_frame(staging, scene.frames[0]);
  const SequenceScales& scales = staging.scales;
  int normal = 0, friction = 0, velocity = 0;
  for (const Arrow& arrow : sketch.arrows) {
    const Vec3d offset = *arrow.to - arrow.from;
    if (same(arrow.color, kImpulse)) {
      ++normal;
      EXPECT_NEAR((offset - Vec3d(0, 2 * scales.impulse, 0)).norm(), 0, 1e-12);
    } else if (arrow.open) {
      ++friction;
      EXPECT_NEAR((offset - Vec3d(-0.5 * scales.impulse, 0, 0)).norm(), 0, 1e-12);
    } else if (arrow.head_share < 1) {
      ++velocity;
      EXPECT_NEAR((offset - Vec3d(0.5 * scales.velocity, 0, 0)).norm(), 0, 1e-12);
    }
  }
  EXPECT_EQ(normal, 2);
  EXPECT_EQ(friction, 2);
  EXPECT_EQ(velocity, 1);
  EXPECT_THAT(legend(sketch), Contains("normal impulse, " + spell_impulse_scale(scales.impulse)));
  EXPECT_THAT(legend(sketch), Contains("kept from the step before"));
  EXPECT_THAT(legend(sketch), Contains(StartsWith("spin, turn in ")));
  EXPECT_THAT(labels(sketch), Contains("0.500 m/s"));
  EXPECT_THAT(labels(sketch), Contains("2.00 N s"));
}

TEST(DynamicsPicture, SpinTurnsByItsAngleInTheStatedTime) {
  CrateOnSlab scene;
  scene.solve(1);
  scene.frames[0].solver->bodies[0].velocity = Vec3d::Zero();
  scene.view.layers = {Layer::Velocities};
  const Staging staging = scene.staged();
  const Sketch sketch = sketch_frame(staging, scene.frames[0]);
  ASSERT_EQ(sketch.arrows.size(), 1u);
  const Vec3d center = scene.frames[0].solver->bodies[0].center_of_mass;
  const Vec3d from = sketch.curves.back().points.front() - center;
  const Vec3d to = *sketch.arrows[0].to - center;
  EXPECT_NEAR(from.y(), 0, 1e-12) << "across the axis";
  const double angle = 0.5 * staging.scales.spin;
  EXPECT_NEAR(from.normalized().dot(to.normalized()), std::cos(angle), 1e-9);
  EXPECT_NEAR(from.normalized().cross(to.normalized()).y(), std::sin(angle), 1e-9);
}

TEST(DynamicsPicture, WithoutASolverVelocitiesLeadToTheNextFrameAndAtTheEndFromTheLast) {
  CrateOnSlab scene;
  scene.frames.push_back(scene.frames[0]);
  scene.frames[1].frame = 1;
  scene.frames[1].time = scene.frames[0].time + 0.1;
  Pose<double>& later = scene.frames[1].poses[1].second;
  later.position.x() += 0.05;
  later.rotation = Quatd(Eigen::AngleAxisd(0.02, Vec3d::UnitY()));
  scene.view.layers = {Layer::Velocities};
  const Staging staging = scene.staged();
  for (const trace::Frame& frame : scene.frames) {
    const Sketch sketch = sketch_frame(staging, frame);
    EXPECT_THAT(labels(sketch), ElementsAre("0.500 m/s", "0.200 rad/s"));
    ASSERT_EQ(sketch.arrows.size(), 2u) << "none of the slab, which rests";
    const Vec3d offset = *sketch.arrows[0].to - sketch.arrows[0].from;
    EXPECT_NEAR((offset - Vec3d(0.5 * staging.scales.velocity, 0, 0)).norm(), 0, 1e-9);
  }
}

TEST(DynamicsPicture, ImpulsesAreThoseOnTheBodyThatMoves) {
  CrateOnSlab scene;
  scene.solve(2);
  std::swap(scene.pair().a, scene.pair().b);
  scene.manifold().normal = -Vec3d::UnitY();
  scene.view.layers = {Layer::Impulses};
  for (const Arrow& arrow : scene.sketch().arrows) {
    EXPECT_GE(arrow.to->y(), arrow.from.y());
  }
}

TEST(DynamicsPicture, TwoBodiesThatMeetAtOnePointHaveEqualAndOppositeArrows) {
  CrateOnSlab scene;
  scene.manifold().points.pop_back();
  scene.solve(2);
  trace::Body slab;
  slab.name = "slab";
  scene.frames[0].solver->bodies.push_back(slab);
  for (trace::Point& point : scene.manifold().points) point.impulse->friction = Vec3d::Zero();
  scene.view.layers = {Layer::Impulses};
  const Sketch sketch = scene.sketch();
  ASSERT_EQ(sketch.arrows.size(), 2u);
  const Vec3d on_b = *sketch.arrows[0].to - sketch.arrows[0].from;
  EXPECT_GT(on_b.y(), 0);
  EXPECT_EQ(*sketch.arrows[1].to - sketch.arrows[1].from, Vec3d(-on_b));
  EXPECT_THAT(marks(sketch), ElementsAre(MarkKind::Node)) << "where they meet";
}

TEST(DynamicsPicture, LabelStandsAtTheBodyThatMovesAlsoBelowTheGround) {
  CrateOnSlab scene;
  scene.pair().label = "fallen";
  scene.view.focus = Focus::Shapes;
  scene.frames[0].poses[1].second.position = {0, -5, 0};
  const auto nearer_to_the_slab = [&] {
    const Vec3d at = scene.sketch().labels.at(0).at;
    return (at - Vec3d(0, -0.2, 0)).norm() < (at - Vec3d(0, -5, 0)).norm();
  };
  EXPECT_TRUE(nearer_to_the_slab());
  scene.solve(1);
  EXPECT_FALSE(nearer_to_the_slab());
}

TEST(DynamicsPicture, AnImpactIsCutAndMarkedSoThatRestingImpulsesStayLegible) {
  CrateOnSlab scene;
  scene.solve(1);
  for (int i = 0; i < 4; ++i) scene.frames.push_back(scene.frames[0]);
  for (trace::Point& point : scene.frames[1].pairs[0].manifolds[0].points) {
    point.impulse->normal = 100;
    point.impulse->friction = {100, 0, 0};
    point.impulse->warm_start = 0;
  }
  scene.view.layers = {Layer::Impulses};
  const Staging staging = scene.staged();
  const Sketch resting = sketch_frame(staging, scene.frames[0]);
  const Sketch impact = sketch_frame(staging, scene.frames[1]);
  const auto longest = [](const Sketch& sketch) {
    double length = 0;
    for (const Arrow& arrow : sketch.arrows) {
      length = std::max(length, (*arrow.to - arrow.from).norm());
    }
    return length;
  };
  EXPECT_NEAR(longest(resting), staging.scales.impulse, 1e-12);
  EXPECT_NEAR(longest(impact), staging.scales.longest_impulse, 1e-12);
  EXPECT_GT(staging.camera.pixels_per_metre({0, 0, 0}) * longest(resting), 40);
  EXPECT_EQ(impact.lines.size(), 16u) << "two strokes with halos across each of four arrows";
}

TEST(DynamicsPicture, LoadsAreForcesOverAFrameAndOneSumAPair) {
  CrateOnSlab scene;
  scene.solve(2);
  scene.frames.push_back(scene.frames[0]);
  scene.frames[1].frame = 1;
  scene.frames[1].time = scene.frames[0].time + 0.01;
  scene.view.layers = {Layer::Impulses, Layer::Loads};
  scene.view.impulse_scale = 0.002;  // metres per newton
  const Staging staging = scene.staged();
  EXPECT_NEAR(staging.scales.step, 0.01, 1e-15);
  const Sketch sketch = sketch_frame(staging, scene.frames[0]);
  EXPECT_THAT(labels(sketch), ElementsAre("Σ 400 N")) << "twice 2 N s in 10 ms";
  EXPECT_THAT(legend(sketch), Contains("normal force, 100 N = 0.2 m"));
  EXPECT_NEAR((*sketch.arrows[0].to - sketch.arrows[0].from).norm(), 0.4, 1e-12);
}

TEST(DynamicsPicture, FrictionAsASubjectHasAScaleOfItsOwn) {
  CrateOnSlab scene;
  scene.solve(2);
  for (trace::Point& point : scene.manifold().points) point.impulse->friction = {0.02, 0, 0};
  scene.view.layers = {Layer::Impulses};
  EXPECT_THAT(legend(scene.sketch()), Not(Contains(StartsWith("friction"))));
  scene.view.layers = {Layer::Impulses, Layer::Friction};
  const Staging staging = scene.staged();
  EXPECT_GT(staging.scales.friction, 10 * staging.scales.impulse);
  const Sketch sketch = sketch_frame(staging, scene.frames[0]);
  EXPECT_THAT(legend(sketch),
              Contains("friction, " + spell_impulse_scale(staging.scales.friction)));
}

TEST(DynamicsPicture, TheNormalPartOfTheRelativeVelocityIsNamed) {
  CrateOnSlab scene;
  scene.manifold().points.pop_back();
  scene.solve(2);
  trace::Point& point = scene.manifold().points[0];
  point.relative_velocity = trace::RelativeVelocity{{0.5, -2.5, 0}, {0.5, 0, 0}};
  scene.frames.push_back(scene.frames[0]);
  scene.frames[1].pairs[0].manifolds[0].points[0].relative_velocity->before = {0.5, 0.004, 0};
  scene.view.layers = {Layer::RelativeVelocity};
  const Staging staging = scene.staged();
  const Sketch sketch = sketch_frame(staging, scene.frames[0]);
  EXPECT_THAT(labels(sketch), ElementsAre("−2.50 m/s"));
  ASSERT_EQ(sketch.arrows.size(), 2u);
  const double scale = staging.scales.velocity;
  EXPECT_NEAR((*sketch.arrows[0].to - sketch.arrows[0].from - scale * Vec3d(0.5, -2.5, 0)).norm(),
              0, 1e-12);
  EXPECT_NEAR((*sketch.arrows[1].to - sketch.arrows[1].from - scale * Vec3d(0, -2.5, 0)).norm(), 0,
              1e-12);
  EXPECT_THAT(labels(sketch_frame(staging, scene.frames[1])), ElementsAre("slides at 0.500 m/s"));
}

TEST(DynamicsPicture, AheadIsWhereABodyWouldBeAFrameLaterAndTheGap) {
  CrateOnSlab scene;
  scene.manifold().points.pop_back();
  scene.solve(2);
  scene.manifold().points[0].separation = 0.25;
  trace::Body& body = scene.frames[0].solver->bodies[0];
  body.mass = 100;
  body.velocity = {0, -30, 0};
  body.angular_velocity = Vec3d::Zero();
  scene.frames.push_back(scene.frames[0]);
  scene.frames[1].frame = 1;
  scene.frames[1].time = scene.frames[0].time + 0.01;
  scene.view.layers = {Layer::Ahead, Layer::Masses};
  const Sketch sketch = scene.sketch();
  EXPECT_THAT(labels(sketch), ElementsAre("gap 0.250 m", "100 kg"));
  std::vector<Line> dashed;
  for (const Line& line : sketch.lines) {
    if (line.style.dashed) dashed.push_back(line);
  }
  ASSERT_GE(dashed.size(), 5u) << "a silhouette, and the way";
  ASSERT_EQ(sketch.arrows.size(), 2u) << "the head of the way, and the gap";
  EXPECT_NEAR((*sketch.arrows[0].to - dashed.back().from - Vec3d(0, -0.3, 0)).norm(), 0, 1e-12);
  const Vec3d gap = *sketch.arrows[1].to - sketch.arrows[1].from;
  EXPECT_NEAR((gap - Vec3d(0, 0.25, 0)).norm(), 0, 1e-12);
}

TEST(DynamicsPicture, RoundScales) {
  EXPECT_EQ(round_down(0.0499), 0.02);
  EXPECT_EQ(round_down(0.05), 0.05);
  EXPECT_EQ(round_down(199), 100);
  EXPECT_EQ(spell_impulse_scale(0.2), "1 N s = 0.2 m");
  EXPECT_EQ(spell_impulse_scale(5), "0.1 N s = 0.5 m");
  EXPECT_EQ(spell_impulse_scale(0.005), "100 N s = 0.5 m");
  EXPECT_EQ(spell_impulse_scale(0.002, "N"), "100 N = 0.2 m");
}

TEST(DynamicsPicture, LabelsAndLegendStayInsideOfTheFrameAtBothSizes) {
  CrateOnSlab scene;
  scene.persist();
  scene.balance("turns about a line");
  scene.solve(2);
  scene.view.layers = {Layer::Shapes,     Layer::Support,  Layer::Persistent, Layer::CenterOfMass,
                       Layer::Velocities, Layer::Impulses, Layer::Core};
  for (const auto& [width, height] : {std::pair{1280, 720}, {640, 360}}) {
    const Drawing drawing = illustrate(scene.staged(width, height), scene.frames[0]);
    for (const Primitive& primitive : drawing.primitives) {
      const Text* text = std::get_if<Text>(&primitive);
      if (text == nullptr || text->align != Align::Left) continue;
      const FontWeight weight =
          text->weight == Weight::Bold ? FontWeight::Bold : FontWeight::Regular;
      EXPECT_GE(text->at.x, 0) << text->text;
      EXPECT_LE(text->at.x + text_width(text->text, text->size, weight), width) << text->text;
      EXPECT_LE(text->at.y, height) << text->text;
      EXPECT_GE(text->size, 10) << text->text;
    }
  }
}

TEST(StagesShown, StabilityIsRecordedForWhatShowsIt) {
  View view;
  EXPECT_FALSE(stages_shown({view}).stability);
  view.panels = {Panel::Stability};
  EXPECT_TRUE(stages_shown({view}).stability);
  view.panels.clear();
  for (const Layer layer : {Layer::Support, Layer::CenterOfMass}) {
    view.layers = {layer};
    EXPECT_TRUE(stages_shown({view}).stability) << name_of(layer);
  }
}

}  // namespace
}  // namespace contactscope::draw
