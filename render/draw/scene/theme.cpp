#include "draw/scene/layout.h"
#include "draw/scene/palette.h"

namespace contactscope::draw {
namespace {

// Minimum contrast with the ground (WCAG 2.2, 1.4.3 and 1.4.11).
constexpr double kTextContrast = 4.5, kLineContrast = 3;
// OKLab chroma below which a colour is a tinted grey: shapes, text, edges.
constexpr double kNeutral = 0.045;
// Lightness above which a grey is a surface or a grid rather than ink.
constexpr double kPale = 0.7;
// For surfaces: chroma of a tint, and the lightness that it adds without colours.
constexpr double kTinge = 0.008, kCoolShift = -0.06, kWarmShift = 0.02;
// A press loses tints that are lighter than this.
constexpr double kMinTint = 0.08, kMinLine = 0.35;
constexpr float kAlmostOpaque = 0.99f;

/// Lightness, green to red, blue to yellow. Ottosson 2020, "A perceptual color space for image
/// processing".
struct Oklab {
  double l = 0, a = 0, b = 0;

  double chroma() const { return std::hypot(a, b); }
  double hue() const { return std::atan2(b, a) * 180 / std::numbers::pi; }  // degrees
};

double linear(double channel) {
  return channel <= 0.04045 ? channel / 12.92 : std::pow((channel + 0.055) / 1.055, 2.4);
}

float encoded(double light) {
  const double x = std::clamp(light, 0.0, 1.0);
  return static_cast<float>(x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055);
}

Oklab to_oklab(const Color& color) {
  const double r = linear(color.r), g = linear(color.g), b = linear(color.b);
  const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

Color to_color(const Oklab& lab, float alpha) {
  const double l = std::pow(lab.l + 0.3963377774 * lab.a + 0.2158037573 * lab.b, 3);
  const double m = std::pow(lab.l - 0.1055613458 * lab.a - 0.0638541728 * lab.b, 3);
  const double s = std::pow(lab.l - 0.0894841775 * lab.a - 1.2914855480 * lab.b, 3);
  return {encoded(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          encoded(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          encoded(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s), alpha};
}

double luminance(const Color& color) {
  return 0.2126 * linear(color.r) + 0.7152 * linear(color.g) + 0.0722 * linear(color.b);
}

bool is_white(const Color& color) { return color.r >= 1 && color.g >= 1 && color.b >= 1; }

/// Changes the lightness in steps until the contrast is sufficient or the limit is reached.
Oklab made_to_stand_out(Oklab lab, ColorUse use, const Color& ground, double step) {
  const double least = use == ColorUse::Text ? kTextContrast : kLineContrast;
  while (contrast(to_color(lab, 1), ground) < least && lab.l + step > 0 && lab.l + step < 1)
    lab.l += step;
  return lab;
}

Color in_the_dark(const Color& color, ColorUse use, const Color& ground) {
  Oklab lab = to_oklab(color);
  if (lab.chroma() >= kNeutral) return to_color(made_to_stand_out(lab, use, ground, 0.01), color.a);
  if (lab.l < kPale) {
    lab.l = 0.97 - 0.5 * lab.l;  // ink
  } else if (use == ColorUse::Fill) {
    // A surface: as far from the ground as it was from white; lit sides remain lighter.
    lab.l = std::max(0.24, 0.27 + 1.1 * (lab.l - 0.78));
    lab.a *= 1.4;
    lab.b *= 1.4;
  } else {
    lab.l = to_oklab(ground).l + 0.75 * (1 - lab.l);
  }
  return to_color(lab, color.a);
}

/// Lightness added to a hue if colours are left out, so that roles of equal lightness differ.
/// Contact points are darkest, then the reference face, the polygon, the incident face and the side
/// planes. Other hues are interpolated.
double shift_of_hue(double hue) {
  struct Anchor {
    double hue, shift;
  };
  // Pink, vermilion, orange, green, sky blue, blue, and pink again.
  constexpr std::array<Anchor, 7> kAnchors{{{-10, -0.13},
                                            {45, -0.36},
                                            {75, -0.10},
                                            {163, -0.10},
                                            {235, -0.08},
                                            {244, -0.15},
                                            {350, -0.13}}};
  if (hue < -10) hue += 360;
  for (std::size_t i = 0; i + 1 < kAnchors.size(); ++i) {
    const Anchor &from = kAnchors[i], &to = kAnchors[i + 1];
    if (hue > to.hue) continue;
    const double t = (hue - from.hue) / (to.hue - from.hue);
    return from.shift + t * (to.shift - from.shift);
  }
  return kAnchors.back().shift;
}

Color in_grey(const Color& color, ColorUse use, const Color& ground) {
  Oklab lab = to_oklab(color);
  // A weak tint counts in proportion to its chroma.
  lab.l += std::min(1.0, lab.chroma() / 0.1) * shift_of_hue(lab.hue());
  const bool is_colored = lab.chroma() >= kNeutral;
  // The surfaces of A and B differ by a cool and a warm tint.
  if (lab.l > kPale && lab.chroma() > kTinge) lab.l += lab.b < 0 ? kCoolShift : kWarmShift;
  lab.a = lab.b = 0;
  if (use == ColorUse::Text || is_colored) lab = made_to_stand_out(lab, use, ground, -0.01);
  return to_color(lab, color.a);
}

Color in_print(const Color& color, ColorUse use, const Color& ground) {
  Oklab lab = to_oklab(color);
  const bool is_neutral = lab.chroma() < kNeutral;
  if (use == ColorUse::Text) {
    if (is_neutral) return {0, 0, 0, color.a};
    return to_color(made_to_stand_out(lab, use, ground, -0.01), color.a);
  }
  if (use == ColorUse::Line) lab = made_to_stand_out(lab, use, ground, -0.01);
  Color strong = to_color(lab, color.a);
  // Darkness against the ground is raised by alpha first, then by lightness.
  const double least = use == ColorUse::Line ? kMinLine : kMinTint;
  const auto darkness = [&] { return 1 - lab.l; };
  if (color.a > 0 && color.a * darkness() < least) {
    if (darkness() < least) lab.l = 1 - least;
    // Translucent fills stay translucent, because vector files drop objects that are fully hidden.
    const float most = color.a < 1 ? kAlmostOpaque : 1.0f;
    strong = to_color(lab, std::min(most, static_cast<float>(least / darkness())));
  }
  return strong;
}

void widen(Primitive& primitive, float factor) {
  if (Stroke* const stroke = std::get_if<Stroke>(&primitive)) {
    stroke->width *= factor;
  } else if (Disc* const disc = std::get_if<Disc>(&primitive); disc != nullptr && disc->inner > 0) {
    // A ring is a circular line, widened around its middle radius.
    const float middle = 0.5f * (disc->inner + disc->outer);
    const float half = 0.5f * factor * (disc->outer - disc->inner);
    disc->inner = std::max(0.0f, middle - half);
    disc->outer = middle + half;
  }
}

}  // namespace

Color ground_of(Theme theme) { return theme == Theme::Dark ? rgb(0x14171A) : kWhite; }

double contrast(const Color& a, const Color& b) {
  const auto [low, high] = std::minmax({luminance(a), luminance(b)});
  return (high + 0.05) / (low + 0.05);
}

Color themed(const Color& color, ColorUse use, Theme theme, const Color& ground) {
  if (is_white(color) || use == ColorUse::Halo) return with_alpha(ground, color.a);
  switch (theme) {
    case Theme::Light:
      return color;
    case Theme::Dark:
      return in_the_dark(color, use, ground);
    case Theme::Grey:
      return in_grey(color, use, ground);
    case Theme::Print:
      return in_print(color, use, ground);
  }
  return color;
}

void apply_theme(Theme theme, const std::optional<Color>& background, Drawing& drawing) {
  drawing.background = background.value_or(ground_of(theme));
  const Color ground =
      drawing.background.a > 0 ? with_alpha(drawing.background, 1) : ground_of(theme);
  const auto map = [&](Color& color, ColorUse use) { color = themed(color, use, theme, ground); };
  for (Primitive& primitive : drawing.primitives) {
    std::visit(
        [&](auto& shape) {
          using Shape = std::remove_reference_t<decltype(shape)>;
          constexpr bool is_line = std::is_same_v<Shape, Stroke> || std::is_same_v<Shape, Disc>;
          constexpr bool is_text = std::is_same_v<Shape, Text>;
          map(shape.color, is_text ? ColorUse::Text : is_line ? ColorUse::Line : ColorUse::Fill);
          if constexpr (is_text) map(shape.halo_color, ColorUse::Halo);
        },
        primitive);
  }
}

void finish(const FigureStyle& style, Drawing& drawing) {
  drawing.points_per_pixel = style.points_per_pixel;
  if (style.line_width != 1) {
    for (Primitive& primitive : drawing.primitives)
      widen(primitive, static_cast<float>(style.line_width));
  }
  if (style.theme != Theme::Light || style.background)
    apply_theme(style.theme, style.background, drawing);
}

}  // namespace contactscope::draw
