#include <gmock/gmock.h>

#include "core/input_error.h"
#include "scenario/broken.h"
#include "scenario/run.h"

namespace contactscope {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string plate_on_box(const std::string& rest = "") {
  return "title = \"Flat\"\n"
         "[shapes.box]\ntype = \"box\"\nhalf_extents = [0.5, 0.5, 0.5]\n"
         "[shapes.plate]\ntype = \"hull\"\n"
         "vertices = [[-0.3, 0, -0.2], [0.3, 0, -0.2], [0.3, 0, 0.2], [-0.3, 0, 0.2]]\n"
         "position = [0, 0.49, 0]\n" +
         rest;
}

TEST(FlatHulls, AreTakenWithAWarning) {
  const Scenario scenario = parse_scenario(plate_on_box(), "g/flat.toml");
  EXPECT_TRUE(scenario.shapes[1].hull()->flat());
  EXPECT_THAT(
      scenario.warnings,
      ElementsAre("line 7: the hull 'plate' is flat: its points lie on one plane, so it "
                  "becomes a polygon with two sides; add a point off the plane to give it a "
                  "volume"));
}

TEST(FlatHulls, TouchWithAllTheirCorners) {
  for (const char* settings :
       {"", "[pipeline]\npenetration = \"epa\"\n", "[pipeline]\npenetration = \"mpr\"\n",
        "[pipeline]\nscalar = \"double\"\n"}) {
    const Scenario scenario = parse_scenario(plate_on_box(settings), "g/flat.toml");
    const trace::Frame frame = Runner(scenario).frame(0);
    ASSERT_EQ(frame.pairs.at(0).manifolds.size(), 1u) << settings;
    EXPECT_EQ(frame.pairs[0].manifolds[0].points.size(), 4u);
    EXPECT_NEAR(frame.pairs[0].manifolds[0].normal.y(), 1, 1e-6);
    EXPECT_NEAR(frame.pairs[0].separation, -0.01, 1e-6);
  }
}

TEST(FlatHulls, AreIncrementalToo) {
  const Scenario scenario = parse_scenario(
      plate_on_box("[time]\nframes = 6\n[pipeline]\nmanifold = \"incremental\"\n"), "g/flat.toml");
  const trace::Frame frame = Runner(scenario).frame(5);
  ASSERT_EQ(frame.pairs.at(0).manifolds.size(), 1u);
  EXPECT_NEAR(frame.pairs[0].separation, -0.01, 1e-6);
}

TEST(FlatHulls, AreNotMovedByTheSolver) {
  try {
    parse_scenario(plate_on_box("motion = { dynamic = true, mass = 1 }\n"), "g/flat.toml");
    FAIL() << "it was taken";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("g/flat.toml:9:"));
    EXPECT_THAT(error.what(), HasSubstr("'plate' is a flat hull, which has no volume and no mass; "
                                        "give it a point off its plane, or leave out 'dynamic'"));
  }
}

}  // namespace
}  // namespace contactscope
