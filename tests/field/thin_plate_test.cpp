#include "field/thin_plate.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace contactscope {
namespace {

using test::kPlateCells;
using test::kPlatePlaces;
using test::places_lost;

TEST(ThinPlate, SlowExactAndSmoothCellsLoseNoPlaceOfAPlateOfHalfACell) {
  for (const auto interpolation : {FieldInterpolation::Trilinear, FieldInterpolation::Cubic})
    for (const double smooth : {0.0, kSmoothPart, 1.0 / 8})
      for (int i = 0; i < 5; ++i)
        EXPECT_EQ(
            places_lost({.cells = kPlateCells, .interpolation = interpolation, .smooth = smooth},
                        0.2 * i),
            0);
}

TEST(ThinPlate, VanishesBetweenNodesAsTheLatticeSlides) {
  int most = 0, least = kPlatePlaces;
  for (int i = 0; i < 5; ++i) {
    const int lost = places_lost(
        {.cells = kPlateCells, .interpolation = FieldInterpolation::Trilinear, .exact = false},
        0.2 * i);
    most = std::max(most, lost);
    least = std::min(least, lost);
  }
  EXPECT_EQ(most, kPlatePlaces);
  EXPECT_LT(least, kPlatePlaces);
}

}  // namespace
}  // namespace contactscope
