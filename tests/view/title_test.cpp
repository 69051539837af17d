#include "view/title.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace contactscope {
namespace {

using ::testing::HasSubstr;

TEST(Titles, WithoutBracesAreOnePiece) {
  const ParsedTitle parsed = parse_title("Four points of eight");
  ASSERT_TRUE(parsed.problem.empty());
  ASSERT_EQ(parsed.title.size(), 1u);
  ASSERT_EQ(parsed.title[0].size(), 1u);
  EXPECT_EQ(parsed.title[0][0].text, "Four points of eight");
  EXPECT_FALSE(parsed.title[0][0].fact);
}

TEST(Titles, PlaceholdersNameFactsPairsAndNouns) {
  const ParsedTitle parsed =
      parse_title("{kept of crate and floor:point} keep {area_kept} | {from 12}later {{x}}");
  ASSERT_EQ(parsed.problem, "");
  ASSERT_EQ(parsed.title.size(), 2u);
  const TitlePiece& first = parsed.title[0][0];
  EXPECT_EQ(first.fact, TitleFact::Kept);
  EXPECT_EQ(first.of, "crate");
  EXPECT_EQ(first.of_other, "floor");
  EXPECT_EQ(first.one, "point");
  EXPECT_EQ(first.many, "points");
  EXPECT_EQ(parsed.title[0][1].text, " keep ");
  EXPECT_EQ(parsed.title[0][1].fact, TitleFact::AreaKept);
  EXPECT_EQ(parsed.title[1][0].from, 12);
  EXPECT_EQ(parsed.title[1][1].text, "later {x}");
}

TEST(Titles, ErrorsAreReportedWithTheRemedy) {
  const auto problem = [](const char* text) { return parse_title(text).problem; };
  EXPECT_THAT(problem("{depth}"), HasSubstr("unknown placeholder '{depth}'; known: frame, time"));
  EXPECT_THAT(problem("a {kept"), HasSubstr("'{' without its '}'"));
  EXPECT_THAT(problem("a } b"), HasSubstr("'}' without its '{'"));
  EXPECT_THAT(problem("{from soon}"), HasSubstr("as {from 12}"));
  EXPECT_THAT(problem("{kept:}"), HasSubstr("no noun"));
  EXPECT_THAT(problem("fine | {nothing}"), HasSubstr("'{nothing}'"));
}

TEST(Titles, WithoutAFrameTheAlternativeWithoutNumbersIsShown) {
  EXPECT_EQ(plain_title("{kept} points | Four points"), "Four points");
  EXPECT_EQ(plain_title("{kept:point} keep {area_kept}"), "… points keep …");
  EXPECT_EQ(plain_title("a { of another engine"), "a { of another engine");
}

}  // namespace
}  // namespace contactscope
