#include "draw/scene/drawing.h"

namespace contactscope::draw {
namespace {

void move_by(const Point2& offset, Fill& fill) {
  for (Point2& corner : fill.polygon) corner = corner + offset;
}
void move_by(const Point2& offset, Stroke& stroke) {
  stroke.from = stroke.from + offset;
  stroke.to = stroke.to + offset;
}
void move_by(const Point2& offset, Disc& disc) { disc.center = disc.center + offset; }
void move_by(const Point2& offset, Text& text) { text.at = text.at + offset; }

}  // namespace

void Drawing::begin(std::string_view layer, std::string_view pair, std::string_view role) {
  // An empty part is removed.
  if (!parts.empty() && parts.back().first == primitives.size()) parts.pop_back();
  if (!parts.empty() && parts.back().layer == layer && parts.back().pair == pair &&
      parts.back().role == role)
    return;
  parts.push_back({primitives.size(), std::string(layer), std::string(pair), std::string(role)});
}

Drawing Drawing::taken(const std::function<bool(const Part&)>& wanted) const {
  Drawing left = *this;
  left.primitives.clear();
  left.parts.clear();
  left.callouts.clear();
  std::vector<std::size_t> moved(primitives.size());  // new index of each primitive
  std::size_t part = 0;
  bool is_left = wanted({});
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    for (; part < parts.size() && parts[part].first == i; ++part) {
      is_left = wanted(parts[part]);
      if (is_left) left.begin(parts[part].layer, parts[part].pair, parts[part].role);
    }
    moved[i] = left.primitives.size();
    if (is_left) left.primitives.push_back(primitives[i]);
  }
  for (Callout callout : callouts) {
    callout.text = moved[callout.text];
    left.callouts.push_back(std::move(callout));
  }
  return left;
}

void Drawing::append(const Drawing& other, const Point2& offset) {
  const std::size_t first = primitives.size();
  for (const Part& part : other.parts) {
    // Primitives before the first part of `other` belong to the current part.
    if (!parts.empty() && parts.back().first == first + part.first) parts.pop_back();
    parts.push_back({first + part.first, part.layer, part.pair, part.role});
  }
  for (Callout callout : other.callouts) {
    callout.text += first;
    callout.at = callout.at + offset;
    callouts.push_back(std::move(callout));
  }
  primitives.reserve(first + other.primitives.size());
  for (Primitive primitive : other.primitives) {
    std::visit([&](auto& shape) { move_by(offset, shape); }, primitive);
    primitives.push_back(std::move(primitive));
  }
}

}  // namespace contactscope::draw
