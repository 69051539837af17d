#include "draw/panels/panel.h"

namespace contactscope::draw {
namespace {

// Pixels at 720 lines.
constexpr float kTextSize = 15, kHeadingSize = 16, kLineSpacing = 4, kUnderRule = 4;
constexpr double kValueColumn = 84;

float whole_size(float size, float scale) { return std::round(size * scale); }

float spacing_at(float scale) { return std::floor(kLineSpacing * scale); }

/// Offset of the value from the left end of a row.
float value_column(float scale) { return std::floor(scale * static_cast<float>(kValueColumn)); }

/// Baseline of text whose top is at `top`, rounded so that letters start on whole pixels.
float baseline_below(float top, float size, Weight weight) {
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
    if (!line.empty() && text_width(longer, size, Weight::Regular) > width) {
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

void Sheet::skip(float pixels) { y_ = std::floor(y_ + pixels + spacing_); }

void Sheet::heading(const std::string& text) {
  const float scale = pen_.scale();
  const float size = std::round(kHeadingSize / kTextSize * text_);
  const auto left = static_cast<float>(rect_.x), width = static_cast<float>(rect_.width);
  pen_.text(pen_.fitted(text, Weight::Bold, width, size / scale),
            {left, baseline_below(y_, size, Weight::Bold)}, Align::Left, kText, Weight::Bold,
            size / scale);
  skip(size);
  const float middle = y_ + 0.5f;  // of a pixel row
  pen_.line({left, middle}, {left + width, middle}, std::max(1.0f, 1 / scale),
            with_alpha(kQuietText, 0.5f));
  skip(kUnderRule * scale);
}

void Sheet::enlarge(double times) {
  const float scale = pen_.scale() * static_cast<float>(times);
  text_ = whole_size(kTextSize, scale);
  spacing_ = spacing_at(scale);
  pen_.write_in(static_cast<double>(text_ / pen_.scale()));
}

void Sheet::write(const std::vector<std::string>& lines, float x, const Color& color) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const float top = y_ + text_ * static_cast<float>(i);
    const float room = static_cast<float>(rect_.right()) - x;
    pen_.text(Said{fitted(lines[i], text_, Weight::Regular, room)},
              {x, baseline_below(top, text_, Weight::Regular)}, Align::Left, color);
  }
  skip(text_ * static_cast<float>(lines.size()));
}

void Sheet::line(const std::string& text, const Color& color) {
  write({pen_.said(text).text}, static_cast<float>(rect_.x), color);
}

void Sheet::paragraph(const std::string& text, const Color& color) {
  write(wrapped(pen_.said(text).text, text_, static_cast<float>(rect_.width)),
        static_cast<float>(rect_.x), color);
}

void Sheet::row(const std::string& name, const std::string& value) {
  const auto left = static_cast<float>(rect_.x);
  const float values = left + value_column(pen_.scale());
  const float top = y_;
  write({pen_.said(name).text}, left, kQuietText);
  y_ = top;
  write(wrapped(pen_.said(value).text, text_, static_cast<float>(rect_.right()) - values), values,
        kText);
}

std::string Sheet::more(std::size_t count, const char* one, const char* many) {
  if (count == 0) return {};
  line("and " + std::to_string(count) + " more " + (count == 1 ? one : many), kQuietText);
  return counted(count, one, many);
}

std::string Sheet::inapplicable(const std::string& reason) {
  paragraph("does not apply: " + reason, kQuietText);
  return {};
}

Rect Sheet::rest() const { return {rect_.x, y_, rect_.width, rect_.bottom() - y_}; }

float Sheet::line_height(float scale) { return whole_size(kTextSize, scale) + spacing_at(scale); }

std::size_t Sheet::row_lines(const std::string& value, float width, float scale,
                             const Words* words) {
  return wrapped(words == nullptr ? value : words->of(value), whole_size(kTextSize, scale),
                 width - value_column(scale))
      .size();
}

float Sheet::heading_height(float scale) {
  return whole_size(kHeadingSize, scale) + kUnderRule * scale + 2 * spacing_at(scale);
}

const PanelDrawing kMinkowskiPanel{
    .needs = {&Stages::minkowski, &Stages::gjk, &Stages::penetration}};
const PanelDrawing kGaussMapPanel{.needs = {&Stages::gauss_map, &Stages::sat}};

std::vector<FilledPanel> make_panels(const Staging& staging, const Frames& frames) {
  std::vector<FilledPanel> panels;
  for (const Panel panel : staging.view.panels)
    if (const auto make = kPanels[static_cast<std::size_t>(panel)]->make)
      panels.push_back({panel, make(staging, frames)});
  return panels;
}

std::vector<float> divide_column(const std::vector<PanelNeed>& needs, float height, float gap,
                                 float note) {
  if (needs.empty()) return {};
  std::size_t count = needs.size();
  float room = 0;  // for the panels themselves
  float left = 0;
  while (true) {
    room = height - gap * static_cast<float>(count - 1);
    if (count < needs.size()) room -= note;
    left = room;
    for (std::size_t i = 0; i < count; ++i) left -= needs[i].least;
    if (left >= 0 || count == 1) break;
    --count;
  }

  std::vector<float> heights(count);
  for (std::size_t i = 0; i < count; ++i) heights[i] = needs[i].least;
  for (float PanelNeed::*const aim : {&PanelNeed::good, &PanelNeed::wanted}) {
    for (std::size_t i = 0; i < count; ++i) {
      const float more = std::clamp(needs[i].*aim - heights[i], 0.0f, std::max(0.0f, left));
      heights[i] += more;
      left -= more;
    }
  }
  // The others divide the rest by their shares, but none shrinks.
  float rest = room;
  std::vector<float> shares(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (needs[i].wanted > 0)
      rest -= heights[i];
    else
      shares[i] = needs[i].share;
  }
  const auto part_of = [&](std::size_t i) {
    float divided = rest;
    for (std::size_t k = 0; k < count; ++k)
      if (shares[k] == 0 && needs[k].wanted == 0) divided -= heights[k];
    return divided * shares[i] / std::accumulate(shares.begin(), shares.end(), 0.0f);
  };
  for (std::size_t i = 0; i < count;) {
    const bool starves = shares[i] > 0 && part_of(i) < heights[i];
    if (starves) shares[i] = 0;
    i = starves ? 0 : i + 1;
  }
  for (std::size_t i = 0; i < count; ++i)
    if (shares[i] > 0) heights[i] = part_of(i);
  if (count == 1) heights[0] = std::min(heights[0], room);
  heights.resize(needs.size());
  return heights;
}

}  // namespace contactscope::draw
