#include "draw/scene/marks.h"

#include <cmath>
#include <numbers>

#include "draw/scene/palette.h"

namespace contactscope::draw {
namespace {

constexpr int kSteps = 12;  // of a quarter of a circle

/// Part of a disc, angles in quarters of a turn, clockwise on the screen from the right.
Fill sector(const Point2& center, float radius, int from, int to, const Color& color) {
  Fill fill;
  fill.color = color;
  if (to - from < 2) fill.polygon.push_back(center);
  for (int i = from * kSteps; i <= to * kSteps; ++i) {
    const float angle = 0.5f * std::numbers::pi_v<float> * static_cast<float>(i) / kSteps;
    fill.polygon.push_back(
        {center.x + radius * std::cos(angle), center.y + radius * std::sin(angle)});
  }
  return fill;
}

}  // namespace

PointState point_state(const std::string& state) {
  if (state == "new") return PointState::New;
  return state == "broken" ? PointState::Broken : PointState::Persisted;
}

void draw_half_dot(const Point2& center, float radius, float border, const Color& color,
                   Drawing& drawing) {
  drawing.primitives.push_back(sector(center, radius - 0.5f * border, 1, 3, color));
  drawing.primitives.push_back(Disc{center, radius - border, radius, color});
}

void draw_quartered_disc(const Point2& center, float radius, float border, Drawing& drawing) {
  drawing.primitives.push_back(Disc{center, 0, radius + border, kWhite});
  for (const int quarter : {0, 2}) {
    drawing.primitives.push_back(
        sector(center, radius - 0.5f * border, quarter, quarter + 1, kNormal));
  }
  drawing.primitives.push_back(Disc{center, radius - border, radius, kNormal});
}

void draw_square(const Point2& center, float half, const Color& color, Drawing& drawing) {
  for (const bool halo : {true, false}) {
    const float h = halo ? 1.4f * half : half;
    drawing.primitives.push_back(Fill{{{center.x - h, center.y - h},
                                       {center.x + h, center.y - h},
                                       {center.x + h, center.y + h},
                                       {center.x - h, center.y + h}},
                                      halo ? kWhite : color});
  }
}

void draw_state_dot(PointState state, const Point2& center, float radius, const Color& color,
                    Drawing& drawing) {
  drawing.primitives.push_back(Disc{center, 0, 1.33f * radius, kWhite});
  if (state == PointState::Persisted) {
    draw_half_dot(center, radius, 0.4f * radius, color, drawing);
  } else {
    const float inner = state == PointState::Broken ? 0.6f * radius : 0.0f;
    drawing.primitives.push_back(Disc{center, inner, radius, color});
  }
}

}  // namespace contactscope::draw
