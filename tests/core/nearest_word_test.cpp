#include "core/key_table.h"

#include <gtest/gtest.h>

namespace contactscope {
namespace {

TEST(NearestWord, CaseAndUnderscoresDoNotCount) {
  const std::vector<std::string_view> keys = {"type", "half_extents", "quat_wxyz", "y"};
  EXPECT_EQ(nearest("halfExtents", keys), "half_extents");
  EXPECT_EQ(nearest("HALFEXTENTS", keys), "half_extents");
  EXPECT_EQ(nearest("QuatWXYZ", keys), "quat_wxyz");
  EXPECT_EQ(nearest("Y", keys), "y");
  EXPECT_EQ(nearest("Z", keys), "");
  // Options differ by case alone.
  EXPECT_EQ(nearest("-V", {"--verbose", "--version"}), "--version");
  EXPECT_EQ(nearest("-v", {"--version", "--verbose"}), "--verbose");
}

TEST(NearestWord, WordsOfOtherProgramsAreKnown) {
  EXPECT_EQ(nearest("Cube", {"hull", "box"}), "box");
  EXPECT_EQ(nearest("halfSize", {"half_extents", "radius"}), "half_extents");
  EXPECT_EQ(nearest("single", {"double", "float"}), "float");
  EXPECT_EQ(nearest("depth", {"separation", "overlap"}), "overlap");
  EXPECT_EQ(nearest("depth", {"separation", "normal"}), "separation");
}

TEST(NearestWord, AWordThatIsNotAllowedComesWithThoseThatAre) {
  EXPECT_EQ(not_among({"y", "z"}, "z"), "");
  EXPECT_EQ(not_among({"y", "z"}, "Y"), "is 'Y'; did you mean 'y'? it may be 'y' or 'z'");
  EXPECT_EQ(not_among({"y", "z"}, "up"), "is 'up'; it may be 'y' or 'z'");
}

}  // namespace
}  // namespace contactscope
