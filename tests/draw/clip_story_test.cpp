#include "draw/scene/clip_story.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/pose.h"
#include "draw/crate_on_slab.h"
#include "draw/scene/palette.h"

namespace contactscope::draw {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

trace::Polygon level(double x0, double x1, double z0, double z1) {
  return {{x0, -0.1, z0}, {x1, -0.1, z0}, {x1, -0.1, z1}, {x0, -0.1, z1}};
}

/// A square of 3 m is clipped by one of 2 m: to x <= 1, z <= 1, x >= -1, z >= -1.
struct ClippedSquare : crate_sample::CrateOnSlab {
  ClippedSquare() {
    view.layers = {Layer::SidePlanes, Layer::ClipPolygons, Layer::Dropped, Layer::Contacts};
    view.story = Story::ClipSteps;
    trace::Clip& clip = pair().clip.emplace();
    clip.reference = {"slab", 2, Vec3d::UnitY(), {{1, 0, -1}, {1, 0, 1}, {-1, 0, 1}, {-1, 0, -1}}};
    clip.incident = {"crate", 3, -Vec3d::UnitY(), level(-1.5, 1.5, -1.5, 1.5)};
    clip.steps = {{Vec3d::UnitX(), 1, level(-1.5, 1, -1.5, 1.5)},
                  {Vec3d::UnitZ(), 1, level(-1.5, 1, -1.5, 1)},
                  {-Vec3d::UnitX(), 1, level(-1, 1, -1.5, 1)},
                  {-Vec3d::UnitZ(), 1, level(-1, 1, -1, 1)}};
    clip.dropped = {{{-1, 0.2, -1}, "above the reference face"}};
  }

  const trace::Clip& clip() { return *pair().clip; }
  Sketch at(int frame) {
    frames[0].frame = frame;
    return sketch();
  }
};

double area_in_space(const trace::Polygon& polygon) { return 0.5 * newell_normal(polygon).norm(); }

TEST(CutAway, IsWhatLiesBeyondThePlane) {
  ClippedSquare scene;
  EXPECT_NEAR(area_in_space(cut_away(scene.clip(), 0)), 0.5 * 3, 1e-12);
  EXPECT_NEAR(area_in_space(cut_away(scene.clip(), 3)), 0.5 * 2, 1e-12);
}

TEST(CutAway, IsNothingOfAPlaneThatTouchesABorder) {
  ClippedSquare scene;
  scene.pair().clip->steps[0].offset = 1.5;
  EXPECT_THAT(cut_away(scene.clip(), 0), IsEmpty());
}

TEST(NumberedCorners, KeepTheirNumbersUntilTheyAreCutAway) {
  ClippedSquare scene;
  const auto numbers = [&](std::size_t steps, bool is_new) {
    std::vector<int> found;
    for (const NumberedCorner& corner : numbered_corners(scene.clip(), steps))
      if (corner.is_new == is_new) found.push_back(corner.number);
    return found;
  };
  EXPECT_THAT(numbers(1, true), ElementsAre(1, 2));
  EXPECT_THAT(numbers(2, true), ElementsAre(3, 4));
  EXPECT_THAT(numbers(2, false), ElementsAre(1));  // the second one is beyond the second plane
  EXPECT_THAT(numbered_corners(scene.clip(), 0), IsEmpty());
}

TEST(ClipStory, DescribesEachPlane) {
  ClippedSquare scene;
  EXPECT_EQ(scene.at(0).heading, "The two faces before clipping");
  EXPECT_EQ(scene.at(1).heading, "Side plane 1 of 4 cuts 2 corners away and makes 2");
  EXPECT_EQ(scene.at(5).heading,
            "2 corners are at or below the reference face, 1 above it dropped");
  scene.pair().clip->steps[0] = {Vec3d::UnitX(), 2, level(-1.5, 1.5, -1.5, 1.5)};
  EXPECT_EQ(scene.at(1).heading, "Side plane 1 of 4 cuts nothing");
}

TEST(ClipStory, HatchesWhatIsCutAwayAndNothingElse) {
  ClippedSquare scene;
  const Sketch sketch = scene.at(1);
  std::size_t hatched = 0;
  for (const Line& line : sketch.lines) {
    if (!crate_sample::same(line.style.color, kDropped)) continue;
    ++hatched;
    for (const Vec3d& end : {line.from, line.to}) {
      EXPECT_GE(end.x(), 1 - 1e-9);
      EXPECT_NEAR(end.y(), -0.1, 1e-9);
    }
  }
  EXPECT_GT(hatched, 8u);  // not only the four sides of the outline
}

TEST(ClipStory, TheActivePlaneIsTheOnlyOne) {
  ClippedSquare scene;
  const auto filled = [&](int frame) {
    const Sketch sketch = scene.at(frame);
    return std::ranges::count_if(sketch.surfaces, [](const Surface& surface) {
      return crate_sample::same(surface.color, kSidePlane);
    });
  };
  EXPECT_EQ(filled(1), 1);
  EXPECT_EQ(filled(3), 1);
  EXPECT_EQ(filled(5), 0);  // the contacts are the subject
  const Sketch third = scene.at(3);
  EXPECT_EQ(std::ranges::count_if(
                third.lines,
                [](const Line& line) { return crate_sample::same(line.style.color, kSidePlane); }),
            4);  // its own border
}

TEST(ClipStory, TheLastStepHasNoSidePlanesAndShowsHeightAboveTheFace) {
  ClippedSquare scene;
  const Sketch sketch = scene.at(5);
  for (const Curve& curve : sketch.curves)
    EXPECT_FALSE(crate_sample::same(curve.style.color, kSidePlane));
  const auto above = std::ranges::find_if(sketch.lines, [](const Line& line) {
    return crate_sample::same(line.style.color, kDropped);
  });
  ASSERT_NE(above, sketch.lines.end());
  EXPECT_NEAR(above->from.y(), 0.2, 1e-9);
  EXPECT_NEAR(above->to.y(), 0, 1e-9);
}

TEST(ClipStory, TheHeadingIsInThePictureAtOnePlace) {
  ClippedSquare scene;
  const Staging staging = scene.staged();
  std::vector<Point2> places;
  for (const int frame : {1, 2}) {
    scene.frames[0].frame = frame;
    for (const Primitive& primitive : illustrate(staging, scene.frames[0]).primitives)
      if (const Text* text = std::get_if<Text>(&primitive); text && text->text.starts_with("Side"))
        places.push_back(text->at);
  }
  ASSERT_GE(places.size(), 2u);
  EXPECT_TRUE(places.front() == places.back());
}

}  // namespace
}  // namespace contactscope::draw
