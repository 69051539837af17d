#pragma once

#include "draw/scene/drawing.h"

/// Colours by role: Okabe-Ito colours, each always combined with a shape of its own.
namespace contactscope::draw {

constexpr Color rgb(unsigned hex, float alpha = 1.0f) {
  return {static_cast<float>((hex >> 16) & 0xFF) / 255.0f,
          static_cast<float>((hex >> 8) & 0xFF) / 255.0f, static_cast<float>(hex & 0xFF) / 255.0f,
          alpha};
}
constexpr Color with_alpha(Color color, float alpha) {
  color.a = alpha;
  return color;
}

inline constexpr Color kShapeA = rgb(0xDDE3EA);
inline constexpr Color kShapeB = rgb(0xEDE6DA);
inline constexpr Color kShapeEdge = rgb(0x4A5058);
// Darker greys of the shapes, for their arcs on the Gauss map.
inline constexpr Color kArcOfA = rgb(0x4F6076);
inline constexpr Color kArcOfB = rgb(0x94764A);
inline constexpr Color kReferenceFace = rgb(0x0072B2);
inline constexpr Color kSidePlane = rgb(0x56B4E9);
inline constexpr Color kIncidentFace = rgb(0xE69F00);
inline constexpr Color kClipPolygon = rgb(0x009E73);
inline constexpr Color kContact = rgb(0xD55E00);
inline constexpr Color kDropped = rgb(0x666666);
// One meaning each, next to the roles above: motion, margins, the polytope of EPA, boxes of trees
// and broad phases, and answers of bounds or shapes.
inline constexpr Color kMotion = rgb(0x5B3FA0);
inline constexpr Color kMargin = rgb(0x7A6A00);
inline constexpr Color kPolytope = rgb(0x8A5A2B);
inline constexpr Color kBox = rgb(0x2B8A99);
inline constexpr Color kImpulse = rgb(0xB2182B);
inline constexpr Color kFriction = rgb(0xC27A6B);
inline constexpr Color kNormal = rgb(0x000000);
inline constexpr Color kAxis = rgb(0xCC79A7);
// The axis colour is too light for text on white. This is the same hue with a contrast of 4.6.
inline constexpr Color kAxisText = rgb(0xA2477B);
inline constexpr Color kText = rgb(0x1A1D21);
inline constexpr Color kQuietText = rgb(0x666666);
inline constexpr Color kWhite = rgb(0xFFFFFF);

/// A surface has three tones. Cosines to the light at which the tone changes, brightest first.
inline constexpr std::array<double, 2> kToneBorders = {0.6, 0.1};
/// Colour of a surface whose normal has this cosine to the light. It is light enough to show
/// contacts inside and dense enough to make a shape look solid.
constexpr Color toned(const Color& base, double lit) {
  const float tone = lit > kToneBorders[0] ? 1.0f : lit > kToneBorders[1] ? 0.93f : 0.84f;
  return {base.r * tone, base.g * tone, base.b * tone, 0.52f};
}

}  // namespace contactscope::draw
