#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crate_on_slab.h"

namespace contactscope::draw {
namespace {

using crate_sample::CrateOnSlab;
using ::testing::Contains;

/// The crate on its slab twice, at a distance of 5 m.
struct TwoCrates : CrateOnSlab {
  TwoCrates() {
    view.layers = {Layer::Shapes, Layer::Contacts};
    view.layout = ViewLayout::SideBySide;
    pair().label = "left";
    header.shapes.push_back(crate_sample::cuboid("slab_2", {1, 0.2, 1}));
    header.shapes.push_back(crate_sample::cuboid("crate_2", {0.5, 0.5, 0.5}));
    trace::Frame& frame = frames[0];
    for (int i = 0; i < 2; ++i) {
      Pose<double> pose = frame.poses[static_cast<std::size_t>(i)].second;
      pose.position.x() += 5;
      frame.poses.push_back({i == 0 ? "slab_2" : "crate_2", pose});
    }
    trace::Pair other = pair();
    other.a = "slab_2";
    other.b = "crate_2";
    other.label = "right";
    for (trace::Point& point : other.manifolds[0].points) point.position.x() += 5;
    frame.pairs.push_back(other);
  }
};

TEST(SideBySide, PairsHaveEqualParallelViewports) {
  const TwoCrates crates;
  const Staging staging = crates.staged();
  ASSERT_EQ(staging.viewports.size(), 2u);
  const PairViewport &left = staging.viewports[0], &right = staging.viewports[1];
  EXPECT_FALSE(left.camera->is_perspective());
  EXPECT_DOUBLE_EQ(left.frame.width, right.frame.width);
  EXPECT_DOUBLE_EQ(left.frame.height, right.frame.height);
  EXPECT_DOUBLE_EQ(left.camera->pixels_per_metre(Vec3d::Zero()),
                   right.camera->pixels_per_metre(Vec3d::Zero()));
  // A point 5 m aside is at the same place in its own viewport.
  const Point2 of_left = *left.camera->project({0.5, 0, 0.5});
  const Point2 of_right = *right.camera->project({5.5, 0, 0.5});
  EXPECT_NEAR(of_left.x - left.frame.x, of_right.x - right.frame.x, 1e-3);
  EXPECT_NEAR(of_left.y - left.frame.y, of_right.y - right.frame.y, 1e-3);
}

TEST(Stages, EachLayerHasItsViewportWithTheSameCamera) {
  CrateOnSlab crate;
  crate.view.layout = ViewLayout::Stages;
  crate.view.layers = {Layer::Shapes, Layer::CandidatePairs, Layer::Contacts};
  const Staging staging = crate.staged();
  ASSERT_EQ(staging.viewports.size(), 2u);
  const PairViewport &candidates = staging.viewports[0], &contacts = staging.viewports[1];
  EXPECT_EQ(candidates.camera->eye(), contacts.camera->eye());
  const Point2 of_first = *candidates.camera->project({0.5, 0, 0.5}),
               of_second = *contacts.camera->project({0.5, 0, 0.5});
  EXPECT_NEAR(of_first.x - candidates.frame.x, of_second.x - contacts.frame.x, 1e-2);
  EXPECT_NEAR(of_first.y - candidates.frame.y, of_second.y - contacts.frame.y, 1e-2);
  EXPECT_EQ(part_of(crate.frames[0], contacts).poses.size(), 2u);
  const Drawing drawing = illustrate(staging, crate.frames[0]);
  EXPECT_THAT(
      crate_sample::texts(drawing),
      testing::IsSupersetOf({"1  broad phase: candidates, the boxes of 1 of 1 pairs overlap",
                             "2  narrow phase: contacts, 1 pair touches at 2 points"}));
}

TEST(Stages, ASimplexHasTheStepsOfEachLabelledPair) {
  TwoCrates crates;
  for (trace::Pair& pair : crates.frames[0].pairs)
    pair.gjk.emplace().iterations = pair.label == "left" ? 1 : 4;
  crates.view.layers = {Layer::Shapes, Layer::Simplex};
  EXPECT_THAT(crate_sample::texts(illustrate(crates.staged(), crates.frames[0])),
              testing::IsSupersetOf({"left: 1 step", "right: 4 steps"}));
  crates.view.layout = ViewLayout::Stages;
  crates.view.layers = {Layer::Shapes, Layer::Contacts, Layer::Simplex};
  EXPECT_THAT(crate_sample::texts(illustrate(crates.staged(), crates.frames[0])),
              testing::Contains(testing::EndsWith("simplex: left: 1 step; right: 4 steps")));
}

TEST(Stages, ASingleLayerIsNotDivided) {
  CrateOnSlab crate;
  crate.view.layout = ViewLayout::Stages;
  crate.view.layers = {Layer::Shapes, Layer::Contacts};
  EXPECT_TRUE(crate.staged().viewports.empty());
}

TEST(SideBySide, ATargetIsLookedAtInEachPair) {
  TwoCrates crates;
  crates.view.eye = Vec3d(0.5, 0, 9);
  crates.view.target = Vec3d(0.5, 0, 0.5);  // an edge of the left crate
  const Staging staging = crates.staged();
  for (int i = 0; i < 2; ++i) {
    const PairViewport& viewport = staging.viewports[static_cast<std::size_t>(i)];
    const Rect& view = viewport.camera->viewport();
    const Point2 seen = *viewport.camera->project({0.5 + 5 * i, 0, 0.5});
    EXPECT_NEAR(seen.x, view.x + 0.5 * view.width, 1e-3);
    EXPECT_NEAR(seen.y, view.y + 0.5 * view.height, 1e-3);
  }
}

TEST(SideBySide, EachIsNamedOnceAndShowsItsOwnPair) {
  const TwoCrates crates;
  const Staging staging = crates.staged();
  const trace::Frame part = part_of(crates.frames[0], staging.viewports[1]);
  ASSERT_EQ(part.poses.size(), 2u);
  EXPECT_EQ(part.poses[0].first, "slab_2");
  ASSERT_EQ(part.pairs.size(), 1u);
  const std::vector<std::string> drawn = crate_sample::texts(illustrate(staging, crates.frames[0]));
  EXPECT_EQ(std::ranges::count(drawn, "left"), 1);
  EXPECT_EQ(std::ranges::count(drawn, "right"), 1);
}

TEST(SideBySide, AnUnnamedPairIsNotShownAmongNamedOnes) {
  TwoCrates crates;
  trace::Frame& frame = crates.frames[0];
  frame.pairs.push_back(frame.pairs[1]);
  frame.pairs.back().label.clear();
  EXPECT_EQ(crates.staged().viewports.size(), 2u);
  for (trace::Pair& pair : frame.pairs) pair.label.clear();
  frame.pairs.back().a = "slab";
  EXPECT_EQ(crates.staged().viewports.size(), 3u) << "where none is named all are";
}

TEST(SideBySide, BoundsHaveTheirAnswerInTheHeading) {
  TwoCrates crates;
  for (trace::Pair& pair : crates.frames[0].pairs) {
    trace::Query& query = pair.query.emplace();
    query.requested = "overlap";
    query.bounds = "obb";
  }
  crates.frames[0].pairs[0].overlap = true;
  const std::vector<std::string> drawn =
      crate_sample::texts(illustrate(crates.staged(), crates.frames[0]));
  EXPECT_THAT(drawn, Contains("left: yes"));
  EXPECT_THAT(drawn, Contains("right: no"));
}

TEST(SideBySide, OnePairKeepsTheUsualView) {
  CrateOnSlab crate;
  crate.view.layout = ViewLayout::SideBySide;
  EXPECT_TRUE(crate.staged().viewports.empty());
}

/// Two points at a distance of 1 mm on a crate of 1 m.
struct TinyPatch : CrateOnSlab {
  TinyPatch() {
    view.layers = {Layer::Shapes, Layer::Contacts};
    view.focus = Focus::Shapes;
    manifold().points[0].position = {0, 0, 0.5};
    manifold().points[1].position = {0.001, 0, 0.5};
  }
};

TEST(Magnifiers, ShowWhatIsSmallerThanItsDots) {
  TinyPatch tiny;
  const Staging staging = tiny.staged();
  ASSERT_TRUE(staging.magnifier);
  const float seen = *seen_distance(staging.camera, {0, 0, 0.5}, {0.001, 0, 0.5});
  EXPECT_LT(seen, 20);
  EXPECT_GE(staging.magnifier->factor * seen, 40);
  EXPECT_LE(staging.magnifier->factor * seen, 180);
  EXPECT_THAT(crate_sample::texts(illustrate(staging, tiny.frames[0])),
              Contains(::testing::StartsWith("×")));
  tiny.view.inset = false;
  EXPECT_FALSE(tiny.staged().magnifier);
}

// There is room for a larger one next to the shapes; if they fill the view, it covers some.
TEST(Magnifiers, AreLargerWhereTheyCoverNothing) {
  TinyPatch tiny;
  tiny.view.eye = Vec3d(2, 2, 4);
  const auto magnifier = [&](double height) {
    tiny.view.orthographic_height = height;
    return *tiny.staged().magnifier;
  };
  const Magnifier aside = magnifier(5), over = magnifier(1.4);
  EXPECT_GT(aside.frame.height, 1.2 * over.frame.height);
  const Staging staging = tiny.staged();
  EXPECT_NEAR(over.frame.height, 0.3 * staging.layout.view.height, 1e-9);
  EXPECT_NEAR(aside.frame.width / aside.frame.height, over.frame.width / over.frame.height, 1e-9);
}

TEST(Magnifiers, AreNotThereWhereTheSubjectIsSeen) {
  CrateOnSlab crate;
  EXPECT_FALSE(crate.staged().magnifier);
  crate.manifold().points.resize(1);  // a point has no size
  EXPECT_FALSE(crate.staged().magnifier);
}

// The magnifier hides the view below it, and no label of the view is there.
TEST(Magnifiers, KeepLabelsOff) {
  TinyPatch tiny;
  tiny.pair().label = "a pair";
  tiny.view.layers.push_back(Layer::Names);
  const Staging staging = tiny.staged();
  const Rect& frame = staging.magnifier->frame;
  for (const Primitive& primitive : illustrate(staging, tiny.frames[0]).primitives) {
    const Text* text = std::get_if<Text>(&primitive);
    if (text == nullptr || text->text.starts_with("×")) continue;
    EXPECT_FALSE(frame.contains(text->at)) << text->text;
  }
}

// The reader would have to distinguish whiskers of two scales in one picture.
TEST(Magnifiers, HaveTheOnlyWhiskersWhereTheyShowThemToScale) {
  TinyPatch tiny;
  tiny.header.title = "{overlap} deep";
  const Staging staging = tiny.staged();
  ASSERT_GT(staging.scales.overlap, 1);
  const Drawing drawing = illustrate(staging, tiny.frames[0]);
  const std::vector<std::string> texts = crate_sample::texts(drawing);
  EXPECT_THAT(texts, Contains(::testing::EndsWith("overlap to scale")));
  EXPECT_THAT(texts, Contains("contact point"));
  int depths = 0;
  for (const Primitive& primitive : drawing.primitives) {
    const Text* text = std::get_if<Text>(&primitive);
    if (text == nullptr || text->text != "2.00 mm") continue;
    EXPECT_TRUE(staging.magnifier->frame.contains(text->at));
    ++depths;
  }
  EXPECT_EQ(depths, 1);
}

TEST(SideBySide, IsFittedToTheFramesThatAreShown) {
  TwoCrates crates;
  crates.frames.push_back(crates.frames[0]);
  crates.frames[1].frame = 1;
  crates.frames[1].time = 1;
  crates.frames[1].poses[1].second.position.y() += 6;
  crates.frames[1].pairs[0].manifolds.clear();
  const auto size = [&](const std::vector<int>& stored) {
    const Staging staging =
        stage(crates.header, crates.frames, crates.view, 1280, 720, {}, kLayers, stored);
    return staging.viewports[0].camera->pixels_per_metre(Vec3d::Zero());
  };
  EXPECT_GT(size({0}), 1.5 * size({0, 1}));
  EXPECT_EQ(size({7}), size({})) << "of frames that are not there none is shown";
}

}  // namespace
}  // namespace contactscope::draw
