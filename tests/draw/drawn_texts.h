#pragma once

#include <string>
#include <variant>
#include <vector>

#include "draw/scene/drawing.h"

/// The texts of a drawing, in drawing order.
namespace contactscope::draw {

inline std::vector<Text> drawn_texts(const Drawing& drawing) {
  std::vector<Text> list;
  for (const Primitive& primitive : drawing.primitives)
    if (const auto* text = std::get_if<Text>(&primitive)) list.push_back(*text);
  return list;
}

inline std::vector<std::string> words(const Drawing& drawing) {
  std::vector<std::string> list;
  for (const Text& text : drawn_texts(drawing)) list.push_back(text.text);
  return list;
}

}  // namespace contactscope::draw
