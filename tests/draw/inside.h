#pragma once

#include <gtest/gtest.h>

#include "draw/scene/camera.h"
#include "draw/scene/drawing.h"
#include "draw/scene/pen.h"

namespace contactscope::draw {

/// Expects that the rectangle contains everything that the primitives cover.
inline void expect_inside(const Drawing& drawing, const Rect& rect) {
  const auto inside = [&](const Point2& p, double slack) {
    return p.x >= rect.x - slack && p.x <= rect.x + rect.width + slack && p.y >= rect.y - slack &&
           p.y <= rect.y + rect.height + slack;
  };
  for (const Primitive& primitive : drawing.primitives) {
    if (const Fill* fill = std::get_if<Fill>(&primitive)) {
      for (const Point2& p : fill->polygon) EXPECT_TRUE(inside(p, 1)) << p.x << " " << p.y;
    } else if (const Stroke* stroke = std::get_if<Stroke>(&primitive)) {
      EXPECT_TRUE(inside(stroke->from, 2.5) && inside(stroke->to, 2.5))
          << stroke->to.x << " " << stroke->to.y;
    } else if (const Text* text = std::get_if<Text>(&primitive)) {
      const float width = text_width(text->text, text->size, text->weight);
      const float left = text->at.x - (text->align == Align::Left     ? 0
                                       : text->align == Align::Center ? 0.5f * width
                                                                      : width);
      EXPECT_TRUE(inside({left, text->at.y}, 1) && inside({left + width, text->at.y}, 1))
          << text->text;
      EXPECT_TRUE(inside({left, text->at.y - 0.7f * text->size}, 1)) << text->text;
    }
  }
}

}  // namespace contactscope::draw
