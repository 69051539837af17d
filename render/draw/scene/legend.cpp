#include "draw/scene/legend.h"

namespace contactscope::draw {
namespace {

constexpr double kSwatch = 26;
constexpr double kSwatchBox = kSwatch - 4;  // width
constexpr double kHalfBox = 7;              // half its height

}  // namespace

void Legend::explain(const LegendEntry& entry) {
  const auto found = std::ranges::find(entries_, entry);
  if (found == entries_.end()) return entries_.push_back(entry);
  if (!found->anchor) found->anchor = entry.anchor;
  found->in_panel = found->in_panel && entry.in_panel;
}

void Legend::explain(const Legend& other) {
  for (const LegendEntry& entry : other.entries_) explain(entry);
}

std::vector<LegendEntry> Legend::sorted() const {
  const auto has = [&](const Swatch& swatch, const auto& holds) {
    return std::ranges::any_of(entries_, [&](const LegendEntry& entry) {
      return entry.swatch == &swatch && holds(entry.text);
    });
  };
  std::vector<LegendEntry> sorted;
  for (const LegendEntry& entry : entries_) {
    // Measures mean the same, narrow or not; so do points whose whisker is hidden by the dot.
    if (entry.swatch == &kNarrowAxisSwatch &&
        has(kAxisSwatch, [&](const std::string& text) { return text == entry.text; }))
      continue;
    if (entry.swatch == &kPlainPointSwatch && has(kContactSwatch, [](const auto&) { return true; }))
      continue;
    const auto same = std::ranges::find(sorted, entry.swatch, &LegendEntry::swatch);
    if (same == sorted.end()) {
      sorted.push_back(entry);
    } else if (entry.text.find(same->text) != std::string::npos) {
      same->text = entry.text;
    } else if (same->text.find(entry.text) == std::string::npos) {
      // "distance, every 200 mm or 50 mm": the common beginning is written once.
      std::size_t alike = 0;
      while (alike < std::min(same->text.size(), entry.text.size()) &&
             same->text[alike] == entry.text[alike])
        ++alike;
      const std::size_t word = entry.text.rfind(' ', alike == 0 ? 0 : alike - 1);
      same->text += " or " + entry.text.substr(word == std::string::npos ? 0 : word + 1);
    }
  }
  std::ranges::stable_sort(sorted, {}, [](const LegendEntry& entry) {
    return std::tuple(entry.swatch->group, entry.swatch->place);
  });
  return sorted;
}

LegendChoice choose_legend(const std::vector<LegendEntry>& sorted) {
  LegendChoice choice;
  if (sorted.size() <= kMaxLegendEntries) return {sorted, {}};
  // Entries with smaller ranks are listed: those of the legend's groups, in their order.
  constexpr int kRanks[] = {5, 5, 3, 1, 2, 2, 5, 4, 4, 4, 4};
  const auto rank = [&](const LegendEntry& entry) {
    if (entry.in_panel) return 6;
    return entry.anchor ? kRanks[static_cast<std::size_t>(entry.swatch->group)] : 0;
  };
  const auto bears_words = [](const LegendEntry& entry) {
    const LegendGroup group = entry.swatch->group;
    return group == LegendGroup::Points || group == LegendGroup::Forces ||
           group == LegendGroup::Motion || group == LegendGroup::Masses;
  };
  std::vector<std::size_t> order(sorted.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return rank(sorted[i]); });
  std::vector<bool> listed(sorted.size());
  for (std::size_t k = 0; k < kMaxLegendEntries; ++k) listed[order[k]] = true;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    if (listed[i])
      choice.listed.push_back(sorted[i]);
    else if (sorted[i].anchor && !bears_words(sorted[i]) && choice.labelled.size() < kMaxInPlace)
      choice.labelled.push_back(sorted[i]);
  }
  return choice;
}

std::string label_of(const LegendEntry& entry) {
  const std::size_t end = std::min(entry.text.find(", "), entry.text.find(": "));
  return entry.text.substr(0, end);
}

void SwatchPen::box(const Color& fill_color, const Color& border, double width, bool dashed) const {
  const std::vector<Point2> corners = block(0, kSwatchBox, kHalfBox);
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
