#include "draw/panels/sheet.h"

#include <algorithm>
#include <cmath>

#include "draw/scene/layout.h"
#include "draw/scene/palette.h"

namespace contactscope::draw {
namespace {

// Pixels at 720 lines.
constexpr float kTextSize = 15, kHeadingSize = 16;
constexpr float kLineSpacing = 4;
constexpr float kUnderRule = 4;
constexpr double kValueColumn = 84;

float whole_size(float size, float scale) {
  return std::round(size * scale);
}

float spacing_at(float scale) {
  return std::floor(kLineSpacing * scale);
}

/// Baseline of text whose top is at `top`, so that its letters stand on whole pixels.
float baseline_below(float top, float size, FontWeight weight) {
  return std::floor(top) + std::floor(ascent(size, weight) + 1);
}

}  // namespace

std::vector<std::string> wrapped(const std::string& text, float size, float width) {
  std::vector<std::string> lines;
  std::string line;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t space = std::min(text.find(' ', from), text.size());
    const std::string word = text.substr(from, space - from);
    const std::string longer = line.empty() ? word : line + ' ' + word;
    if (!line.empty() && text_width(longer, size, FontWeight::Regular) > width) {
      lines.push_back(line);
      line = word;
    } else {
      line = longer;
    }
    from = space + 1;
  }
  lines.push_back(line);
  return lines;
}

Sheet::Sheet(const Rect& rect, float scale, Drawing& drawing)
    : rect_(rect),
      pen_(drawing, scale, whole_size(kTextSize, scale) / scale),
      text_(whole_size(kTextSize, scale)),
      spacing_(spacing_at(scale)),
      y_(static_cast<float>(rect.y)) {}

void Sheet::advance(float height) {
  y_ = std::floor(y_ + height + spacing_);
}

void Sheet::write(const std::string& text, float x, float y, const Color& color) {
  const auto room = static_cast<float>(rect_.x + rect_.width) - x;
  pen_.text(fitted(text, text_, FontWeight::Regular, room),
            {x, baseline_below(y, text_, FontWeight::Regular)}, Align::Left, color);
}

void Sheet::heading(const std::string& text) {
  const float scale = pen_.scale(), size = whole_size(kHeadingSize, scale);
  const auto left = static_cast<float>(rect_.x), width = static_cast<float>(rect_.width);
  pen_.text(fitted(text, size, FontWeight::Bold, width),
            {left, baseline_below(y_, size, FontWeight::Bold)}, Align::Left, kText, Weight::Bold,
            size / scale);
  advance(size);
  const float middle = y_ + 0.5f;  // of a row of pixels
  pen_.line({left, middle}, {left + width, middle}, std::max(1.0f, 1 / scale),
            with_alpha(kQuietText, 0.5f));
  advance(kUnderRule * scale);
}

void Sheet::line(const std::string& text, const Color& color) {
  lines({text}, color);
}

void Sheet::write(const std::vector<std::string>& lines, float x, const Color& color) {
  for (std::size_t i = 0; i < lines.size(); ++i)
    write(lines[i], x, y_ + text_ * static_cast<float>(i), color);
}

void Sheet::lines(const std::vector<std::string>& all, const Color& color) {
  write(all, static_cast<float>(rect_.x), color);
  advance(text_ * static_cast<float>(all.size()));
}

void Sheet::paragraph(const std::string& text, const Color& color) {
  lines(wrapped(text, text_, static_cast<float>(rect_.width)), color);
}

void Sheet::row(const NamedValue& row) {
  const auto left = static_cast<float>(rect_.x);
  const float values = left + std::floor(pen_.px(kValueColumn));
  write(row.first, left, y_, kQuietText);
  const std::vector<std::string> all =
      wrapped(row.second, text_, static_cast<float>(rect_.x + rect_.width) - values);
  write(all, values, kText);
  advance(text_ * static_cast<float>(all.size()));
}

void Sheet::skip(float pixels) {
  advance(pixels);
}

std::string Sheet::more(std::size_t count, const char* one, const char* many) {
  if (count == 0) return {};
  const std::string counted = std::to_string(count) + " " + (count == 1 ? one : many);
  line("and " + std::to_string(count) + " more " + (count == 1 ? one : many), kQuietText);
  return counted;
}

Rect Sheet::rest() const {
  return {rect_.x, y_, rect_.width, rect_.y + rect_.height - y_};
}

float Sheet::line_height(float scale) {
  return whole_size(kTextSize, scale) + spacing_at(scale);
}

float Sheet::heading_height(float scale) {
  return whole_size(kHeadingSize, scale) + kUnderRule * scale + 2 * spacing_at(scale);
}

}  // namespace contactscope::draw
