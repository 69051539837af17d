#include "draw/panels/panel.h"

#include <gmock/gmock.h>

namespace contactscope::draw {
namespace {

using ::testing::ElementsAre;
using ::testing::FloatEq;

constexpr float kGap = 10, kNote = 20;

/// A list of 100 to 400 pixels, a chart of 80, or 200 with all its curves, and a map of 120.
constexpr PanelNeed kList{100, 100, 400, 0};
constexpr PanelNeed kChart{80, 200, 0, 2};
constexpr PanelNeed kMap{120, 120, 0, 2};

TEST(PanelHeights, OnePanelWithAWantedHeightLeavesTheRestFree) {
  EXPECT_THAT(divide_column({kList}, 600, kGap, kNote), ElementsAre(400));
}

TEST(PanelHeights, HeightLeftByTheListIsDividedByShares) {
  EXPECT_THAT(divide_column({kList, kChart, kMap}, 1020, kGap, kNote), ElementsAre(400, 300, 300));
}

TEST(PanelHeights, ChartsGetAllTheirCurvesBeforeTheListGrows) {
  EXPECT_THAT(divide_column({kChart, kList}, 360, kGap, kNote), ElementsAre(200, 150));
}

TEST(PanelHeights, ASmallShareStillGetsItsMinimum) {
  const PanelNeed strip{90, 90, 0, 0.1f};
  EXPECT_THAT(divide_column({strip, kMap}, 410, kGap, kNote), ElementsAre(90, 310));
}

TEST(PanelHeights, LastPanelIsLeftOutWhereNotEvenTheLeastHeightsFit) {
  EXPECT_THAT(divide_column({kList, kMap, kChart}, 310, kGap, kNote), ElementsAre(160, 120, 0));
}

TEST(PanelHeights, FirstPanelIsCutToAColumnThatIsLowerThanItsLeast) {
  EXPECT_THAT(divide_column({kMap, kList}, 90, kGap, kNote), ElementsAre(FloatEq(70), 0));
}

TEST(PanelHeights, EveryColumnIsFilledAndNeverOverfull) {
  for (float height = 130; height < 1200; height += 7) {
    const std::vector<float> heights = divide_column({kList, kMap, kChart}, height, kGap, kNote);
    float used = -kGap;
    for (const float each : heights) used += each > 0 ? each + kGap : 0;
    EXPECT_LE(used, height + 1e-3f) << height;
    if (heights[2] > 0) {
      EXPECT_NEAR(used, height, 1e-3f);
    }
  }
}

}  // namespace
}  // namespace contactscope::draw
