#include "core/spell.h"

#include <gtest/gtest.h>

#include <set>

namespace contactscope {
namespace {

TEST(SpellCount, GroupsDigitsByThree) {
  EXPECT_EQ(spell_count(0), "0");
  EXPECT_EQ(spell_count(999), "999");
  EXPECT_EQ(spell_count(1000), "1,000");
  EXPECT_EQ(spell_count(1234567), "1,234,567");
  EXPECT_EQ(spell_count(-100), "−100");
  EXPECT_EQ(spell_count(-123456), "−123,456");
}

TEST(Spell, CountsHaveTheirNoun) {
  EXPECT_EQ(counted(0, "pair"), "0 pairs");
  EXPECT_EQ(counted(1, "pair"), "1 pair");
  EXPECT_EQ(counted(2, "vertex", "vertices"), "2 vertices");
  EXPECT_EQ(counted(11175, "pair"), "11175 pairs");
}

TEST(Spell, ListsHaveSeparatorsBetweenTheirEntries) {
  EXPECT_EQ(separated(std::vector<std::string>{}, ", "), "");
  EXPECT_EQ(separated(std::vector<std::string>{"a", "", "c"}, ", "), "a, , c");
  EXPECT_EQ(separated(std::set{3, -1, 2}, " "), "-1 2 3");
  EXPECT_EQ(separated(std::vector{1.5, 2.0}, "; ", shortest), "1.5; 2");
  EXPECT_EQ(listed({}), "");
  EXPECT_EQ(listed({"spheres"}), "spheres");
  EXPECT_EQ(listed({"spheres", "boxes"}), "spheres and boxes");
  EXPECT_EQ(listed({"spheres", "boxes", "rods"}), "spheres, boxes and rods");
}

TEST(Spell, NumbersReadBackAsTheSame) {
  for (const double number : {0.1, 1.0 / 3, 1e300, 2.2250738585072014e-308, -2.5, 123456789.0})
    EXPECT_EQ(std::stod(shortest(number)), number);
  EXPECT_EQ(shortest(0.1), "0.1");
  EXPECT_EQ(printed("%.2f of %d", 0.5, 7), "0.50 of 7");
  EXPECT_EQ("10" + superscript(-12), "10⁻¹²");
}

}  // namespace
}  // namespace contactscope
