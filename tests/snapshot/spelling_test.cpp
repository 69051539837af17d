#include "snapshot/changes.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <vector>

namespace contactscope::snapshot {
namespace {

TEST(Spelling, LengthsTakeTheUnitThatFits) {
  EXPECT_EQ(spell_length(0.0013), "1.3 mm");
  EXPECT_EQ(spell_length(-0.0013), "1.3 mm");
  EXPECT_EQ(spell_length(1.254), "1.25 m");
  EXPECT_EQ(spell_length(12.4e-6), "12.4 um");
  EXPECT_EQ(spell_length(3e-9), "3 nm");
  EXPECT_EQ(spell_length(0.4), "400 mm");
  EXPECT_EQ(spell_length(25000), "25000 m");
  EXPECT_EQ(spell_length(0), "0 nm");
}

TEST(Spelling, RoundingUpTakesTheNextUnit) {
  EXPECT_EQ(spell_length(999.7e-6), "1 mm");
  EXPECT_EQ(spell_length(0.9996), "1 m");
  EXPECT_EQ(spell_length(999.4e-6), "999 um");
}

TEST(Spelling, AChangeShowsTheDigitsThatDiffer) {
  EXPECT_EQ(spell_change(-0.005, -0.0037), "-0.0050 -> -0.0037");
  EXPECT_EQ(spell_change(-0.005, -0.25), "-0.005 -> -0.250");
  EXPECT_EQ(spell_change(1.0, 250.0), "1 -> 250");
  EXPECT_EQ(spell_change(-1e-9, 0.0013), "0.0000 -> 0.0013");
  EXPECT_EQ(spell_change(0.1, 0.1 + 3e-8), "0.100000000 -> 0.100000030");
  EXPECT_EQ(spell_change(1e300, 2e300), "1.0000000000000001e+300 -> 2.0000000000000001e+300");
  EXPECT_EQ(spell_change(0.5, std::numeric_limits<double>::quiet_NaN()), "0.5 -> nan");
}

TEST(Spelling, TextsAndCountsChange) {
  EXPECT_EQ(spell_change(std::string("face_a"), std::string("edge_edge")), "face_a -> edge_edge");
  EXPECT_EQ(spell_change(std::string("left"), std::string()), "left -> (none)");
  EXPECT_EQ(spell_change(4, 2), "4 -> 2");
  EXPECT_EQ(spell_list(std::vector<int>{0, 3, 5}), "0 3 5");
}

TEST(Spelling, MovesAlongAnAxisNameIt) {
  EXPECT_EQ(spell_move(Vec3d::Zero(), Vec3d(0.0013, 0, 0)), "moved 1.3 mm along x");
  EXPECT_EQ(spell_move(Vec3d::Zero(), Vec3d(0, 0, -2)), "moved 2 m along -z");
  EXPECT_EQ(spell_move(Vec3d(1, 1, 1), Vec3d(1.3, 1.4, 1)), "moved 500 mm along (0.6, 0.8, 0)");
}

TEST(Spelling, AMoveToNanNamesBothPlaces) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(spell_move(Vec3d(1, 2, 3), Vec3d(1, nan, 3)), "moved from (1, 2, 3) to (1, nan, 3)");
}

TEST(Spelling, OneDegreeIsOne) {
  const double degree = std::numbers::pi / 180;
  EXPECT_EQ(spell_angle(degree), "1 degree");
  EXPECT_EQ(spell_angle(1.1 * degree), "1.1 degrees");
  EXPECT_EQ(spell_angle(2 * degree), "2 degrees");
}

TEST(Spelling, DirectionsFlipOrTurn) {
  const double angle = 3.2 * std::numbers::pi / 180;
  EXPECT_EQ(spell_turn(Vec3d(0, 1, 0), Vec3d(0, -1, 0)), "flipped");
  EXPECT_EQ(spell_turn(Vec3d(1, 0, 0), Vec3d(std::cos(angle), std::sin(angle), 0)),
            "turned by 3.2 degrees");
  EXPECT_EQ(spell_turn(Vec3d(0, 1, 0), Vec3d(0, 1.1, 0)), "changed (0, 1, 0) -> (0, 1.1, 0)");
  EXPECT_EQ(spell_turn(Vec3d(0, 1, 0), Vec3d(0, 0, 0)), "changed (0, 1, 0) -> (0, 0, 0)");
}

}  // namespace
}  // namespace contactscope::snapshot
