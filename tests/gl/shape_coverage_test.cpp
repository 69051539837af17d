// Compares strokes and discs with areas computed by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "gl/painting.h"

namespace contactscope::gl {
namespace {

using draw::Cap;
using draw::Disc;
using draw::Stroke;
using testing::ink;
using testing::paint;
using testing::pixel;

constexpr double kPi = 3.14159265358979;
constexpr draw::Color kBlack{0, 0, 0, 1};
constexpr int kSide = 160;

class ShapeCoverage : public ::testing::Test {
 protected:
  double ink_of(const draw::Primitive& shape) {
    draw::Drawing drawing;
    drawing.primitives = {shape};
    return ink(paint(rasterizer_, drawing));
  }

  std::unique_ptr<Context> context_ = open_context(Backend::Auto);
  Rasterizer rasterizer_{*context_, kSide, kSide};
};

/// A stroke of `length` through the middle.
Stroke stroke_at(double angle, double length, float width) {
  const double dx = length / 2 * std::cos(angle), dy = length / 2 * std::sin(angle);
  Stroke stroke;
  stroke.from = {static_cast<float>(80.37 - dx), static_cast<float>(79.81 - dy)};
  stroke.to = {static_cast<float>(80.37 + dx), static_cast<float>(79.81 + dy)};
  stroke.width = width;
  stroke.color = kBlack;
  return stroke;
}

TEST_F(ShapeCoverage, StrokeHasWidthTimesLengthAtEveryAngle) {
  for (int i = 0; i < 24; ++i) {
    const double angle = 0.013 + 2 * kPi * i / 24;
    for (const float width : {0.4f, 1.0f, 1.5f, 2.0f, 3.0f, 7.3f}) {
      const double area = 120 * width;
      EXPECT_NEAR(ink_of(stroke_at(angle, 120, width)), area, 0.01 * area)
          << width << " wide at " << angle;
    }
  }
}

TEST_F(ShapeCoverage, RoundCapsAddTwoHalfDiscs) {
  for (const double angle : {0.0, 0.7, 2.1, 4.0}) {
    Stroke stroke = stroke_at(angle, 100, 10);
    stroke.cap = Cap::Round;
    const double area = 100 * 10 + kPi * 5 * 5;
    EXPECT_NEAR(ink_of(stroke), area, 0.01 * area);
  }
}

TEST_F(ShapeCoverage, RoundCapOfNoLengthIsADisc) {
  Stroke stroke = stroke_at(0, 0, 12);
  stroke.cap = Cap::Round;
  EXPECT_NEAR(ink_of(stroke), kPi * 36, 0.01 * kPi * 36);
}

TEST_F(ShapeCoverage, DiscsAndRingsHaveTheirArea) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(60, 100);
  for (const float outer : {4.0f, 5.5f, 12.0f, 50.0f}) {
    for (const float share : {0.0f, 0.5f, 0.8f}) {
      const float inner = share * outer;
      const double area = kPi * (outer * outer - inner * inner);
      // Spreading the rim over a pixel adds kPi / 12 to a full disc.
      EXPECT_NEAR(ink_of(Disc{{place(random), place(random)}, inner, outer, kBlack}), area,
                  0.01 * area + kPi / 12)
          << inner << " to " << outer;
    }
  }
}

TEST_F(ShapeCoverage, RingLeavesItsMiddleFree) {
  const Image image = paint(*context_, 40, 40, {Disc{{20, 20}, 8, 11, kBlack}});
  for (int y = 14; y < 26; ++y) {
    for (int x = 14; x < 26; ++x) {
      if (std::hypot(x - 19.5, y - 19.5) < 7) {
        EXPECT_EQ(pixel(image, x, y)[0], 255);
      }
    }
  }
  EXPECT_EQ(pixel(image, 29, 20)[0], 0);
}

TEST_F(ShapeCoverage, DashesPaintTheirShareOfTheLine) {
  // 120 px hold eight periods of 15 px; a phase only moves them.
  for (const double angle : {0.0, 0.4, 1.9}) {
    for (const float phase : {0.0f, 3.7f, 11.0f, 150.0f}) {
      Stroke stroke = stroke_at(angle, 120, 3);
      stroke.dash = 9;
      stroke.gap = 6;
      stroke.phase = phase;
      EXPECT_NEAR(ink_of(stroke), 8 * 9 * 3, 0.01 * 8 * 9 * 3) << angle << ", " << phase;
    }
  }
}

TEST_F(ShapeCoverage, FineDashesAverageOut) {
  Stroke stroke = stroke_at(0.3, 120, 4);
  stroke.dash = 0.5f;
  stroke.gap = 0.3f;
  EXPECT_NEAR(ink_of(stroke), 120 * 4 * 0.625, 0.02 * 120 * 4);
}

TEST_F(ShapeCoverage, DashesStandWhereThePhasePutsThem) {
  Stroke stroke;
  stroke.from = {10, 20.5f};
  stroke.to = {70, 20.5f};
  stroke.width = 3;
  stroke.dash = 10;
  stroke.gap = 5;
  stroke.phase = 4;
  stroke.color = kBlack;
  const Image image = paint(*context_, 80, 40, {stroke});
  for (int x = 0; x < 80; ++x) {
    const int along = x - 10;  // the pixel covers [along, along + 1]
    const bool on = along >= 0 && along < 60 && (along + 4) % 15 < 10;
    EXPECT_EQ(pixel(image, x, 20)[0], on ? 0 : 255) << x;
  }
}

TEST_F(ShapeCoverage, DashEndsAreAntiAliased) {
  Stroke stroke;
  stroke.from = {10.25f, 20.5f};
  stroke.to = {30.25f, 20.5f};
  stroke.width = 3;
  stroke.dash = 5;
  stroke.gap = 5;
  stroke.color = kBlack;
  const Image image = paint(*context_, 40, 40, {stroke});
  EXPECT_NEAR(pixel(image, 10, 20)[0], 255 * 0.25, 1.5);
  EXPECT_NEAR(pixel(image, 15, 20)[0], 255 * 0.75, 1.5);
  EXPECT_NEAR(pixel(image, 20, 20)[0], 255 * 0.25, 1.5);
  EXPECT_EQ(pixel(image, 12, 20)[0], 0);
  EXPECT_EQ(pixel(image, 17, 20)[0], 255);
}

TEST_F(ShapeCoverage, RoundDashesAreCapsules) {
  for (const float phase : {0.0f, 6.0f, 13.0f}) {
    Stroke stroke = stroke_at(0.5, 100, 6);
    stroke.cap = Cap::Round;
    stroke.dash = 8;
    stroke.gap = 12;
    stroke.phase = phase;
    // Phases 0 and 13 keep five dashes whole; phase 6 cuts one in two, with caps of their own.
    const double dashes = phase == 6.0f ? 6 : 5;
    const double area = 5 * 8 * 6 + dashes * kPi * 9;
    EXPECT_NEAR(ink_of(stroke), area, 0.015 * area) << phase;
  }
}

TEST_F(ShapeCoverage, DottedLineIsARowOfDiscs) {
  Stroke stroke = stroke_at(0, 95, 6);
  stroke.cap = Cap::Round;
  stroke.dash = 0;
  stroke.gap = 10;
  EXPECT_NEAR(ink_of(stroke), 10 * kPi * 9, 0.02 * 10 * kPi * 9);
}

TEST_F(ShapeCoverage, AThinLineIsFaintAndAPixelWideOneFull) {
  Stroke stroke;
  stroke.from = {5, 20.5f};
  stroke.to = {35, 20.5f};
  stroke.color = kBlack;
  stroke.width = 0.25f;
  EXPECT_NEAR(pixel(paint(*context_, 40, 40, {stroke}), 20, 20)[0], 255 * 0.75, 1);
  stroke.width = 1;
  const Image image = paint(*context_, 40, 40, {stroke});
  EXPECT_EQ(pixel(image, 20, 20)[0], 0);
  EXPECT_EQ(pixel(image, 20, 19)[0], 255);
  EXPECT_EQ(pixel(image, 20, 21)[0], 255);
}

TEST_F(ShapeCoverage, EndsFarOutsideDoNotDisturbWhatIsInside) {
  Stroke stroke;
  stroke.from = {-30000, 80};
  stroke.to = {40000, 80};
  stroke.width = 4;
  stroke.color = kBlack;
  EXPECT_NEAR(ink_of(stroke), 4 * kSide, 0.01 * 4 * kSide);
}

}  // namespace
}  // namespace contactscope::gl
