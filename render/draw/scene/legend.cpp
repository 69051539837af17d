#include "draw/scene/legend.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/words.h"
#include "image/font.h"

namespace contactscope::draw {
namespace {

constexpr double kSwatch = 26;
constexpr double kSwatchBox = kSwatch - 4;  // width
constexpr double kHalfBox = 7;              // half its height

}  // namespace

void Legend::explain(const Swatch& swatch, const std::string& text,
                     const std::optional<Vec3d>& anchor) {
  const LegendEntry entry{&swatch, text, anchor};
  const auto found = std::ranges::find(entries_, entry);
  if (found == entries_.end())
    entries_.push_back(entry);
  else if (!found->anchor)
    found->anchor = anchor;
}

void Legend::explain(const Legend& other) {
  for (const LegendEntry& entry : other.entries_) explain(*entry.swatch, entry.text, entry.anchor);
}

std::vector<LegendEntry> Legend::sorted() const {
  std::vector<LegendEntry> sorted = entries_;
  // A measure too narrow for its arrow means the same as one that is not.
  std::erase_if(sorted, [&](const LegendEntry& entry) {
    return entry.swatch == &kNarrowAxisSwatch &&
           std::ranges::find(entries_, LegendEntry{&kAxisSwatch, entry.text}) != entries_.end();
  });
  std::ranges::stable_sort(sorted, {}, [](const LegendEntry& entry) {
    return std::tuple(entry.swatch->group, entry.swatch->place);
  });
  return sorted;
}

LegendChoice choose_legend(const std::vector<LegendEntry>& sorted) {
  LegendChoice choice;
  if (sorted.size() <= kMostLegendEntries) return {sorted, {}};
  // Rank of each: smaller ones are listed.
  const auto rank = [](const LegendEntry& entry) {
    if (!entry.anchor) return 0;
    switch (entry.swatch->group) {
      case LegendGroup::Points:
        return 1;
      case LegendGroup::Forces:
      case LegendGroup::Motion:
        return 2;
      case LegendGroup::Faces:
        return 3;
      case LegendGroup::Axes:
      case LegendGroup::Trees:
      case LegendGroup::Differences:
      case LegendGroup::Directions:
        return 4;
      case LegendGroup::Shapes:
      case LegendGroup::Cores:
      case LegendGroup::Masses:
        break;
    }
    return 5;
  };
  std::vector<std::size_t> order(sorted.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return rank(sorted[i]); });
  std::vector<bool> listed(sorted.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    listed[order[k]] = k < kMostLegendEntries || !sorted[order[k]].anchor;
  for (std::size_t i = 0; i < sorted.size(); ++i)
    (listed[i] ? choice.listed : choice.labelled).push_back(sorted[i]);
  return choice;
}

std::string label_of(const LegendEntry& entry) {
  const std::size_t end = std::min(entry.text.find(", "), entry.text.find(": "));
  return entry.text.substr(0, end);
}

void SwatchPen::box(const Color& fill_color, const Color& border, double width, bool dashed) const {
  const std::vector<Point2> corners = {at(0, -kHalfBox), at(kSwatchBox, -kHalfBox),
                                       at(kSwatchBox, kHalfBox), at(0, kHalfBox)};
  fill(corners, fill_color);
  outline(corners, width, border, dashed ? 5 : 0);
}

void SwatchPen::hatched(const Color& color) const {
  const double h = px(kHalfBox), w = px(kSwatchBox), x = left_.x, y = left_.y;
  hatch({{x, y - h}, {x + w, y - h}, {x + w, y + h}, {x, y + h}}, {}, 5, 1.1, color);
}

void SwatchPen::head(double tip, double size, const Color& color) const {
  const Point2 to = at(tip);
  const float s = px(size), half = 0.5f * std::abs(s);
  fill({to, {to.x - s, to.y - half}, {to.x - s, to.y + half}}, color);
}

float legend_entry_width(const LegendEntry& entry, float scale, const Words* words) {
  return scale * static_cast<float>(kSwatch + 6 + kEntryGap) +
         text_width(words == nullptr ? entry.text : words->of(entry.text),
                    scale * static_cast<float>(SwatchPen::kLegendSize), FontWeight::Regular);
}

void draw_legend(const std::vector<LegendEntry>& entries, const Layout& layout, Drawing& drawing) {
  drawing.begin(kLegendPart);
  double x = layout.legend.x;
  double middle = layout.legend.y + layout.px(kLegendRow / 2);
  for (const LegendEntry& entry : entries) {
    const double width = legend_entry_width(entry, layout.scale, layout.words);
    if (x > layout.legend.x && x + width > layout.legend.x + layout.legend.width) {
      x = layout.legend.x;
      middle += layout.px(kLegendRow);
    }
    const SwatchPen pen(layout, pixel(x, middle), drawing);
    entry.swatch->draw(pen);
    const float size = layout.px(SwatchPen::kLegendSize);
    pen.text(entry.text, {pen.at(kSwatch + 6).x, static_cast<float>(middle) + 0.36f * size},
             Align::Left, kText);
    x += width;
  }
}

}  // namespace contactscope::draw
