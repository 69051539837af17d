#include "draw/scene/quantity.h"

#include <gtest/gtest.h>

namespace contactscope::draw {
namespace {

TEST(SpellLength, PicksTheUnitThatFits) {
  EXPECT_EQ(spell_length(-0.005), "−5.00 mm");
  EXPECT_EQ(spell_length(0.25), "0.250 m");
  EXPECT_EQ(spell_length(0.1), "0.100 m");
  EXPECT_EQ(spell_length(0.0999), "99.9 mm");
  EXPECT_EQ(spell_length(12.345), "12.3 m");
  EXPECT_EQ(spell_length(-3.2e-6), "−3.20 µm");
  EXPECT_EQ(spell_length(12000), "12.0 km");
  EXPECT_EQ(spell_length(0), "0 m");
  EXPECT_EQ(spell_length(4e-9), "4.00 nm");
}

TEST(SpellLength, RoundingUpDoesNotPrintFourDigitsOfTheSmallerUnit) {
  EXPECT_EQ(spell_length(0.09999), "0.100 m");
  EXPECT_EQ(spell_length(0.0009999), "1.00 mm");
}

TEST(SpellArea, HasFourDigitsAndNoTrailingPoint) {
  EXPECT_EQ(spell_area(0.58578), "0.5858 m²");
  EXPECT_EQ(spell_area(1), "1.000 m²");
  EXPECT_EQ(spell_area(0.0012), "1200 mm²");
  EXPECT_EQ(spell_area(8019.3), "8019 m²");
  EXPECT_EQ(spell_area(1e8), "100.0 km²");
  EXPECT_EQ(spell_area(2.5e-9), "2500 µm²");
  EXPECT_EQ(spell_area(0), "0 m²");
  EXPECT_EQ(spell_area(-0.0012), "−1200 mm²");
}

TEST(SpellNumber, HasARealMinusSign) {
  EXPECT_EQ(spell_number(-20), "−20");
  EXPECT_EQ(spell_number(0.5), "0.5");
}

TEST(Quantity, PrefixesSuitTheValue) {
  EXPECT_EQ(spell_quantity(0.5, "m/s"), "0.500 m/s");
  EXPECT_EQ(spell_quantity(0.0123, "N s"), "12.3 mN s");
  EXPECT_EQ(spell_quantity(12.34, "J"), "12.3 J");
  EXPECT_EQ(spell_quantity(-999.9, "J"), "−1.00 kJ");
  EXPECT_EQ(spell_quantity(0, "J"), "0.00 J");
  EXPECT_EQ(spell_quantity(0.2, "s", 1), "0.2 s");
  EXPECT_EQ(spell_quantity(4.2e-6, "J"), "4.20 µJ");
}

}  // namespace
}  // namespace contactscope::draw
