#include "draw/scene/layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "draw/crate_on_slab.h"
#include "draw/scene/palette.h"

namespace contactscope::draw {
namespace {

using crate_sample::CrateOnSlab;

constexpr std::array kThemes = {Theme::Light, Theme::Dark, Theme::Grey, Theme::Print};
constexpr std::array kRoles = {kReferenceFace, kSidePlane, kIncidentFace, kClipPolygon,
                               kContact,       kDropped,   kNormal,       kAxis};

/// The drawing with all colours black, including those of halos and ground.
Drawing without_colors(Drawing drawing) {
  drawing.background = {};
  for (Primitive& primitive : drawing.primitives) {
    std::visit([](auto& shape) { shape.color = {}; }, primitive);
    if (Text* const text = std::get_if<Text>(&primitive)) text->halo_color = {};
  }
  return drawing;
}

/// The text form of a primitive without its colours.
std::string spelled(const Drawing& drawing) {
  std::string all;
  const auto add = [&](double number) { all += std::to_string(number) + ' '; };
  for (const Primitive& primitive : drawing.primitives) {
    add(static_cast<double>(primitive.index()));
    if (const Fill* const fill = std::get_if<Fill>(&primitive)) {
      for (const Point2& corner : fill->polygon) add(corner.x), add(corner.y);
    } else if (const Stroke* const line = std::get_if<Stroke>(&primitive)) {
      for (const float number : {line->from.x, line->from.y, line->to.x, line->to.y, line->width,
                                 line->dash, line->gap, line->phase})
        add(number);
    } else if (const Disc* const disc = std::get_if<Disc>(&primitive)) {
      for (const float number : {disc->center.x, disc->center.y, disc->inner, disc->outer})
        add(number);
    } else if (const Text* const text = std::get_if<Text>(&primitive)) {
      all += text->text;
      for (const float number : {text->at.x, text->at.y, text->size, text->halo}) add(number);
    }
  }
  return all;
}

TEST(Theme, ChangesColoursAndNothingElse) {
  const CrateOnSlab scene;
  const Drawing light = illustrate(scene.staged(), scene.frames[0]);
  for (const Theme theme : kThemes) {
    Drawing drawing = light;
    apply_theme(theme, {}, drawing);
    EXPECT_EQ(spelled(without_colors(drawing)), spelled(without_colors(light)));
    EXPECT_EQ(drawing.parts.size(), light.parts.size());
  }
}

TEST(Theme, LightIsThePictureAsItIs) {
  for (const Color& role : kRoles) {
    const Color same = themed(role, ColorUse::Fill, Theme::Light, kWhite);
    EXPECT_TRUE(crate_sample::same(same, role));
  }
}

TEST(Theme, RolesStandOutFromTheGround) {
  for (const Theme theme : {Theme::Dark, Theme::Grey, Theme::Print}) {
    const Color ground = ground_of(theme);
    for (const Color& role : kRoles) {
      EXPECT_GE(contrast(themed(role, ColorUse::Line, theme, ground), ground), 2.99);
      EXPECT_GE(contrast(themed(role, ColorUse::Text, theme, ground), ground), 4.49);
    }
    EXPECT_GE(contrast(themed(kText, ColorUse::Text, theme, ground), ground), 7);
  }
}

TEST(Theme, HalosTakeTheBackgroundColour) {
  const Color ground = rgb(0x203040);
  for (const Theme theme : kThemes) {
    const Color halo = themed(with_alpha(kWhite, 0.85f), ColorUse::Line, theme, ground);
    EXPECT_TRUE(crate_sample::same(halo, ground));
    EXPECT_FLOAT_EQ(halo.a, 0.85f);
  }
}

TEST(Theme, GreyHasNoHueAndDistinctRoles) {
  const auto grey = [](const Color& color) {
    return themed(color, ColorUse::Line, Theme::Grey, kWhite);
  };
  for (const Color& role : kRoles) {
    EXPECT_NEAR(grey(role).r, grey(role).g, 2e-3);
    EXPECT_NEAR(grey(role).g, grey(role).b, 2e-3);
  }
  // Neighbours in pictures of clipping, darkest first.
  const std::array rising = {kContact, kReferenceFace, kClipPolygon, kIncidentFace};
  for (std::size_t i = 1; i < rising.size(); ++i)
    EXPECT_GT(grey(rising[i]).g, grey(rising[i - 1]).g + 0.06f) << i;
}

TEST(Theme, PrintHasBlackTextAndNoTintThatAPressLoses) {
  EXPECT_TRUE(crate_sample::same(themed(kText, ColorUse::Text, Theme::Print, kWhite), Color{}));
  const Color faint = themed(with_alpha(kSidePlane, 0.05f), ColorUse::Fill, Theme::Print, kWhite);
  EXPECT_GT(faint.a, 0.15f);
  EXPECT_FLOAT_EQ(themed(with_alpha(kContact, 0), ColorUse::Fill, Theme::Print, kWhite).a, 0);
}

TEST(Theme, BackgroundIsTheAuthorsOrTheThemes) {
  Drawing drawing;
  apply_theme(Theme::Dark, {}, drawing);
  EXPECT_TRUE(crate_sample::same(drawing.background, ground_of(Theme::Dark)));
  apply_theme(Theme::Dark, Color{1, 1, 1, 0}, drawing);
  EXPECT_EQ(drawing.background.a, 0);
  apply_theme(Theme::Light, rgb(0xFFF8E7), drawing);
  EXPECT_TRUE(crate_sample::same(drawing.background, rgb(0xFFF8E7)));
}

}  // namespace
}  // namespace contactscope::draw
