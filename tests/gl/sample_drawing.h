#pragma once

#include <cmath>
#include <random>
#include <string>

#include "draw/scene/drawing.h"

namespace contactscope::testing {

/// A picture with every kind of primitive, overlapping, translucent, and not aligned to pixels.
inline draw::Drawing sample_drawing(int width = 640, int height = 360) {
  using namespace draw;
  std::mt19937 random(11);
  const auto between = [&random](double low, double high) {
    return static_cast<float>(low + (high - low) * static_cast<double>(random()) / 4294967296.0);
  };
  const Color blue{0, 114.0f / 255, 178.0f / 255, 0.35f};
  const Color orange{230.0f / 255, 159.0f / 255, 0, 0.35f};
  const Color green{0, 158.0f / 255, 115.0f / 255, 1};
  const Color vermilion{213.0f / 255, 94.0f / 255, 0, 1};

  Drawing drawing;
  drawing.width = width;
  drawing.height = height;
  for (int i = 0; i < 10; ++i) {
    Fill fill;
    fill.color = i % 2 ? blue : orange;
    const float x = between(0.1 * width, 0.9 * width), y = between(0.1 * height, 0.9 * height);
    const float radius = between(20, 120);
    const int corners = 3 + i % 4;
    for (int k = 0; k < corners; ++k) {
      const double angle = 0.3 * i + 6.283185307 * k / corners;
      fill.polygon.push_back({x + radius * static_cast<float>(std::cos(angle)),
                              y + radius * static_cast<float>(std::sin(angle))});
    }
    drawing.primitives.push_back(fill);
    for (std::size_t k = 0; k < fill.polygon.size(); ++k) {
      Stroke edge;
      edge.from = fill.polygon[k];
      edge.to = fill.polygon[(k + 1) % fill.polygon.size()];
      edge.width = 0.7f + 0.5f * static_cast<float>(i % 5);
      edge.color = i % 3 ? green : Color{0.4f, 0.4f, 0.4f, 0.6f};
      edge.cap = i % 2 ? Cap::Round : Cap::Butt;
      edge.dash = i % 3 == 1 ? 8.0f : 0.0f;
      edge.gap = i % 3 == 1 ? 5.0f : 0.0f;
      edge.phase = between(0, 13);
      drawing.primitives.push_back(edge);
    }
    const Point2 at{between(0, width), between(0, height)};
    drawing.primitives.push_back(Disc{at, 0, 7, {1, 1, 1, 1}});
    drawing.primitives.push_back(Disc{at, 0, 5, vermilion});
    drawing.primitives.push_back(Disc{at, 8.3f, 10.6f, vermilion});
    Text text;
    text.text = "point " + std::to_string(i) + "  \u22120.0050 m \u00D7 20";
    text.at = {between(0, width), between(0, height)};
    text.size = i % 2 ? 14.0f : 19.5f;
    text.weight = i % 4 ? Weight::Regular : Weight::Bold;
    text.align = i % 3 ? Align::Left : Align::Center;
    text.halo = i % 2 ? 2.5f : 0.0f;
    drawing.primitives.push_back(text);
  }
  return drawing;
}

}  // namespace contactscope::testing
