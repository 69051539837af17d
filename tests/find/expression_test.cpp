#include "find/expression.h"

#include <gmock/gmock.h>

#include <map>

namespace contactscope::find {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// As that of `shrink`: any side, and causes of `lint`.
const Vocabulary& sides_and_causes() {
  static const Vocabulary known{
      {{"points", Unit::Count}, {"separation", Unit::Metres}, {"axis", Unit::Text}},
      {},
      {"lint", "unmet"}};
  return known;
}

bool holds(const std::string& text, const std::map<std::string, Value>& facts = {}) {
  return Expression(text, sides_and_causes())
      .holds([&](const std::string& side, const std::string& quantity) {
        const auto found = facts.find(side + (quantity.empty() ? "" : "." + quantity));
        return found == facts.end() ? Value(kUnknown) : found->second;
      });
}

std::string complaint(const std::string& text) {
  try {
    Expression expression(text, sides_and_causes());
  } catch (const ExpressionError& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(Expression, BindsAsArithmeticDoes) {
  EXPECT_TRUE(holds("1 + 2 * 3 == 7"));
  EXPECT_TRUE(holds("(1 + 2) * 3 == 9"));
  EXPECT_TRUE(holds("-2 - -3 == 1"));
  EXPECT_TRUE(holds("8 / 2 / 2 == 2"));
  EXPECT_TRUE(holds("1e-3 * 1e+3 == 1"));
  EXPECT_TRUE(holds("abs(1 - 3) >= 2"));
  EXPECT_TRUE(holds("1 < 2 and not 2 < 1 or 1 == 2"));
  EXPECT_TRUE(holds("0 && 1 || !0"));
}

TEST(Expression, ComparesBothSides) {
  const std::map<std::string, Value> facts = {{"float.points", 2.0},
                                              {"double.points", 4.0},
                                              {".axis", std::string("face_a")},
                                              {"lint.x", 3.0}};
  EXPECT_TRUE(holds("float.points != double.points", facts));
  EXPECT_TRUE(holds("double.points - float.points == 2", facts));
  EXPECT_TRUE(holds("axis == 'face_a'", facts));
  EXPECT_FALSE(holds("axis != \"face_a\"", facts));
  EXPECT_TRUE(holds("lint.x", facts));
  EXPECT_FALSE(holds("lint.y", facts));
}

TEST(Expression, UnknownValuesAreNeitherEqualNorUnequal) {
  EXPECT_FALSE(holds("separation == separation"));
  EXPECT_FALSE(holds("separation != 1"));
  EXPECT_FALSE(holds("separation"));
  EXPECT_FALSE(holds("abs(separation) >= 0"));
  EXPECT_FALSE(holds("axis == 3", {{".axis", std::string("3")}}));
}

TEST(Expression, MeasuresAnAngleBetweenTwoNormals) {
  const std::map<std::string, Value> facts = {{"a.normal_x", 1.0}, {"a.normal_y", 0.0},
                                              {"a.normal_z", 0.0}, {"b.normal_x", 0.0},
                                              {"b.normal_y", 1.0}, {"b.normal_z", 0.0}};
  EXPECT_TRUE(holds("abs(angle(a, b) - 90) < 1e-9", facts));
  EXPECT_FALSE(holds("angle(a, c) > 0", facts));
}

TEST(Expression, NamesItsSides) {
  EXPECT_THAT(Expression("angle(bullet, double) > 1 and lint.half_depths and points > 1",
                         sides_and_causes())
                  .sides(),
              ElementsAre("", "bullet", "double", "lint"));
}

TEST(Expression, SaysWhichUnitItAssumes) {
  const auto assumed = [](const std::string& text) {
    return Expression(text, sides_and_causes()).assumptions();
  };
  EXPECT_THAT(assumed("separation > 50 and 2 < separation"), ElementsAre("50 is 50 m", "2 is 2 m"));
  EXPECT_THAT(assumed("separation > 5 mm and points > 3 and separation > 0"), IsEmpty());
}

TEST(Expression, ReportsTheErrorWithItsPlaceAndRemedy) {
  EXPECT_THAT(complaint("float.pionts > 1"), HasSubstr("did you mean 'points'?"));
  EXPECT_THAT(complaint("axis == face_a"), HasSubstr("'face_a' is not a quantity; put the name"));
  EXPECT_THAT(complaint("points = 1"), HasSubstr("column 8 of 'points = 1': compare with '=='"));
  EXPECT_THAT(complaint("points >"), HasSubstr("a quantity is missing at the end"));
  EXPECT_THAT(complaint("(points > 1"), HasSubstr("')' is missing"));
  EXPECT_THAT(complaint("points > 1 2"), HasSubstr("unexpected '2'"));
  EXPECT_THAT(complaint("axis == 'face"), HasSubstr("closing quote"));
  EXPECT_THAT(complaint("1.2.3 > 1"), HasSubstr("column 4 of '1.2.3 > 1': unexpected '.3'"));
  EXPECT_THAT(complaint("angle(1, double) > 1"), HasSubstr("expected a side"));
}

}  // namespace
}  // namespace contactscope::find
