#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "draw/charts/axis_history.h"
#include "draw/charts/pair_history.h"
#include "draw/panels/panel.h"
#include "draw/scene/palette.h"

namespace contactscope::draw {
namespace {

struct AxisRow {
  const char* axis;
  const char* name;
};
constexpr std::array<AxisRow, 3> kAxisRows{
    {{"face_a", "face A"}, {"face_b", "face B"}, {"edge_edge", "edges"}}};

// Lines of text.
constexpr float kMostRow = 1.8f;
constexpr float kLeastRow = 0.9f;
constexpr float kAroundHistory = 1.6f;  // a title and space below
constexpr float kLeastHistory = kAroundHistory + kLeastRow * static_cast<float>(kAxisRows.size());

constexpr double kNameColumn = 62;  // pixels at 720 lines

bool from_cache(const trace::Pair& pair) {
  return pair.cache && pair.cache->hit;
}

/// What the frames up to one come to.
struct Counts {
  int switches = 0;
  int hits = 0;
  int tests = 0;
};

/// One pair through the sequence.
struct PairAxes {
  std::string name;
  std::vector<AxisMoment> moments;
  std::vector<Counts> counts;
};

std::string number_of(int number, const char* one, const char* many) {
  return std::to_string(number) + " " + (number == 1 ? one : many);
}

/// "2 switches", and where a cache is at work how often the full test ran.
std::string told(const Counts& counts) {
  std::string text = number_of(counts.switches, "switch", "switches");
  if (counts.hits > 0)
    text += ", " + number_of(counts.tests, "full test", "full tests") + ", " +
            number_of(counts.hits, "cache hit", "cache hits");
  return text;
}

/// The pairs of which an axis is known in some frame.
std::vector<PairAxes> axes_of(const Frames& frames) {
  std::vector<PairAxes> all;
  std::vector<const trace::Pair*> known;
  for (const trace::Frame& frame : frames) {
    for (std::size_t i = 0; i < frame.pairs.size(); ++i) {
      const trace::Pair& pair = frame.pairs[i];
      if (axis_of(pair).empty()) continue;
      if (i < known.size() && same_pair(*known[i], pair)) continue;  // mostly the same ones
      const auto same = [&](const trace::Pair* other) { return same_pair(*other, pair); };
      if (std::ranges::none_of(known, same)) known.push_back(&pair);
    }
  }
  for (const trace::Pair* pair : known) {
    PairAxes& axes = all.emplace_back();
    axes.name = pair_name(*pair);
    axes.moments = axis_history(pair_history(frames, *pair));
    Counts counts;
    for (const AxisMoment& moment : axes.moments) {
      if (moment.pair != nullptr) {
        counts.switches += moment.switched;
        ++(from_cache(*moment.pair) ? counts.hits : counts.tests);
      }
      axes.counts.push_back(counts);
    }
  }
  return all;
}

/// Which axis made the contact, frame by frame: a switch of rows is a flip-flop, and so is a gap in
/// a row, where another face or another pair of edges took over. Frames that went by the cache are
/// half as high: no axis was looked for in them.
class AxisHistoryPanel : public PanelContent {
 public:
  AxisHistoryPanel(const Staging& staging, const Frames& frames)
      : scale_(staging.layout.scale), pairs_(axes_of(frames)) {
    cached_ = std::ranges::any_of(pairs_,
                                  [](const PairAxes& pair) { return pair.counts.back().hits > 0; });
  }

  PanelNeed need(const PanelMoment&) const override {
    const float line = Sheet::line_height(scale_);
    const std::size_t pairs = std::max<std::size_t>(1, pairs_.size());
    const float frame = Sheet::heading_height(scale_) + (cached_ ? line : 0);
    const float each = kLeastHistory * line;
    return {frame + each + (pairs > 1 ? line : 0), frame + each * static_cast<float>(pairs), 0, 1};
  }

  std::string lay_out(const PanelMoment& moment, Sheet& sheet) const override {
    sheet.heading("chosen axis, frame by frame");
    if (pairs_.empty()) {
      sheet.paragraph("does not apply: no separating axis test of two hulls in this sequence",
                      kQuietText);
      return {};
    }
    if (cached_) sheet.line("half as high: from the cache, untested", kText);
    const float line = sheet.line_height();
    auto available = static_cast<float>(sheet.rest().height);
    std::size_t shown = pairs_.size();
    if (kLeastHistory * line * static_cast<float>(shown) > available) {
      available -= line;  // for the words below
      const float fitting = std::max(1.0f, available / (kLeastHistory * line));
      shown = std::min(shown, static_cast<std::size_t>(fitting));
    }
    const float row =
        std::min(kMostRow * line, (available / static_cast<float>(shown) - kAroundHistory * line) /
                                      static_cast<float>(kAxisRows.size()));
    for (std::size_t p = 0; p < shown; ++p) {
      sheet.line(pairs_[p].name + ": " + told(pairs_[p].counts[moment.frame]), kText);
      draw_rows(pairs_[p].moments, moment.frame, row, sheet);
      sheet.skip(row * static_cast<float>(kAxisRows.size()) + 0.5f * line);
    }
    return sheet.more(pairs_.size() - shown, "pair", "pairs");
  }

 private:
  static void draw_rows(const std::vector<AxisMoment>& moments, std::size_t now, float row,
                        const Sheet& sheet) {
    const Pen& pen = sheet.pen();
    const Rect rest = sheet.rest();
    const double left = rest.x + pen.px(kNameColumn), width = rest.x + rest.width - left;
    const double cell = width / static_cast<double>(moments.size());
    const double gap = pen.px(1);
    const auto at = [&](std::size_t frame) { return left + cell * static_cast<double>(frame); };
    for (std::size_t r = 0; r < kAxisRows.size(); ++r) {
      const double y = rest.y + row * static_cast<double>(r);
      pen.text(kAxisRows[r].name,
               {static_cast<float>(rest.x),
                static_cast<float>(y + 0.5 * row + 0.3 * sheet.text_height())},
               Align::Left, kQuietText);
      pen.fill({left, y + gap, width, row - 2 * gap}, with_alpha(kQuietText, 0.10f));
      const auto is_here = [&](std::size_t f) {
        return moments[f].pair != nullptr && moments[f].axis == kAxisRows[r].axis;
      };
      const auto bar = [&](std::size_t from, std::size_t to, bool cached, const Color& color) {
        const double top = cached ? y + 0.5 * row : y + gap;
        pen.fill({at(from), top, at(to) - at(from), y + row - gap - top}, color);
      };
      for (std::size_t from = 0; from < now;) {
        if (!is_here(from)) {
          ++from;
          continue;
        }
        const bool cached = from_cache(*moments[from].pair);
        std::size_t to = from + 1;
        while (to < now && is_here(to) && from_cache(*moments[to].pair) == cached) ++to;
        bar(from, to, cached, kAxis);
        from = to;
      }
      if (is_here(now)) bar(now, now + 1, from_cache(*moments[now].pair), kAxisText);
      for (std::size_t f = 0; f <= now; ++f) {
        if (!is_here(f) || !moments[f].switched) continue;
        pen.fill({at(f) - pen.px(1.5), y, pen.px(3), static_cast<double>(row)}, kWhite);
      }
    }
  }

  float scale_;
  std::vector<PairAxes> pairs_;
  bool cached_ = false;
};

}  // namespace

std::unique_ptr<PanelContent> make_axis_history_panel(const Staging& staging,
                                                      const Frames& frames) {
  return std::make_unique<AxisHistoryPanel>(staging, frames);
}

}  // namespace contactscope::draw
