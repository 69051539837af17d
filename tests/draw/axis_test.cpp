#include "draw/charts/axis.h"

#include <gmock/gmock.h>

#include <cmath>

#include "image/font.h"

namespace contactscope::draw {
namespace {

std::vector<double> labelled(const Axis& axis) {
  std::vector<double> values;
  for (const Axis::Tick& tick : axis.ticks()) {
    if (tick.labelled) values.push_back(tick.value);
  }
  return values;
}

TEST(LogarithmicAxis, EndsLieWithinTheMargins) {
  const Axis axis = Axis::logarithmic(20, 5000, 100, 700, 30, 90);
  EXPECT_NEAR(axis.at(20), 130, 1e-3);
  EXPECT_NEAR(axis.at(5000), 610, 1e-3);
}

TEST(LogarithmicAxis, EqualFactorsAreEqualDistances) {
  const Axis axis = Axis::logarithmic(1, 1000, 400, 40, 0, 0);  // upwards on the canvas
  EXPECT_NEAR(axis.at(1), 400, 1e-3);
  EXPECT_NEAR(axis.at(10), 280, 1e-3);
  EXPECT_NEAR(axis.at(100), 160, 1e-3);
  EXPECT_NEAR(axis.at(1000), 40, 1e-3);
}

TEST(LogarithmicAxis, ValuesBeyondTheEndsStayOnTheAxis) {
  const Axis axis = Axis::logarithmic(1, 100, 0, 200, 10, 10);
  EXPECT_EQ(axis.at(1e-30), 0);
  EXPECT_EQ(axis.at(1e30), 200);
}

TEST(LogarithmicAxis, OneValueGetsAnAxisOfAFactorOfThree) {
  const Axis axis = Axis::logarithmic(7, 7, 0, 300, 0, 0);
  EXPECT_NEAR(axis.at(7), 150, 1e-3);
  EXPECT_NEAR(axis.at(7 * std::sqrt(3)), 300, 0.2);
}

TEST(LogarithmicAxis, ManyDecadesAreLabelledAloneAndFewWithTwoAndFive) {
  EXPECT_THAT(labelled(Axis::logarithmic(0.9e-4, 1.1, 0, 500, 0, 0)),
              testing::Pointwise(testing::DoubleEq(), {1e-4, 1e-3, 1e-2, 1e-1, 1.0}));
  EXPECT_THAT(labelled(Axis::logarithmic(40, 450, 0, 500, 0, 0)),
              testing::Pointwise(testing::DoubleEq(), {50.0, 100.0, 200.0}));
}

TEST(LogarithmicAxis, TicksGrowAndHoldTheDecades) {
  const std::vector<Axis::Tick> ticks = Axis::logarithmic(3, 200, 0, 500, 0, 0).ticks();
  ASSERT_EQ(ticks.size(), 7u + 9u + 2u);
  EXPECT_EQ(std::ranges::count_if(ticks, [](const Axis::Tick& t) { return t.decade; }), 2);
  for (std::size_t i = 1; i < ticks.size(); ++i) {
    EXPECT_LT(ticks[i - 1].value, ticks[i].value);
    EXPECT_LT(ticks[i - 1].at, ticks[i].at);
  }
}

TEST(LogarithmicAxis, ShortDecadesHaveNoMinorTicks) {
  const Axis axis = Axis::logarithmic(0.9, 1.1e4, 0, 200, 0, 0);  // about 49 pixels a decade
  EXPECT_EQ(axis.ticks(60).size(), 5u);
  EXPECT_GT(axis.ticks(40).size(), 36u);
}

TEST(LinearAxis, EqualStepsAreEqualDistances) {
  const Axis axis{-1, 3, 400, 0};  // upwards on the canvas
  EXPECT_NEAR(axis.at(-1), 400, 1e-3);
  EXPECT_NEAR(axis.at(0), 300, 1e-3);
  EXPECT_NEAR(axis.at(3), 0, 1e-3);
}

TEST(TickText, TimesCarryTheUnitThatFits) {
  EXPECT_EQ(spell_tick_time(50), "50 ns");
  EXPECT_EQ(spell_tick_time(1000), "1 µs");
  EXPECT_EQ(spell_tick_time(20000), "20 µs");
  EXPECT_EQ(spell_tick_time(5e6), "5 ms");
}

TEST(TickText, SmallErrorsAreSpelledAsPowersTheFontHas) {
  EXPECT_EQ(spell_tick_error(1, ""), "1");
  EXPECT_EQ(spell_tick_error(0.001, ""), "0.001");
  EXPECT_EQ(spell_tick_error(1e-6, ""), "10⁻⁶");
  EXPECT_EQ(spell_tick_error(2e-12, "m"), "2·10⁻¹² m");
  for (const char32_t code : code_points("≤ 10⁻⁰¹²³⁴⁵⁶⁷⁸⁹·µ")) {
    EXPECT_TRUE(has_glyph(code, FontWeight::Regular)) << static_cast<unsigned>(code);
  }
}

}  // namespace
}  // namespace contactscope::draw
