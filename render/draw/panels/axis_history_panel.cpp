#include "draw/panels/panel.h"
#include "draw/scene/pairs.h"

namespace contactscope::draw {
namespace {

struct AxisRow {
  const char* axis;
  const char* name;
};
constexpr std::array<AxisRow, 3> kAxisRows{
    {{"face_a", "faces of A"}, {"face_b", "faces of B"}, {"edge_edge", "edges"}}};

// Lines of text.
constexpr float kMaxRow = 3.6f, kMaxRowOfOne = 6, kMinRow = 0.9f;
constexpr float kAroundHistory = 2.8f;  // title, frame numbers and space below
constexpr float kHeadline = 2.4f;       // number of cache hits, if one pair is shown
constexpr float kTestsRow = 3;          // frames without a cache hit
constexpr float kMinHistory = kAroundHistory + kMinRow * static_cast<float>(kAxisRows.size());

constexpr double kNameColumn = 78;    // pixels at 720 lines
constexpr double kHeadlineSize = 30;  // pixels at 720 lines

bool from_cache(const trace::Pair& pair) { return pair.cache && pair.cache->hit; }

/// Counts up to a frame.
struct AxisCounts {
  std::size_t switches = 0, hits = 0, tests = 0;
};

AxisCounts axis_counts(const std::vector<AxisMoment>& moments, std::size_t now) {
  AxisCounts counts;
  for (const AxisMoment& moment : std::span(moments).first(now + 1)) {
    if (moment.pair == nullptr) continue;
    counts.switches += moment.switched;
    ++(from_cache(*moment.pair) ? counts.hits : counts.tests);
  }
  return counts;
}

/// "2 switches", and with a cache the number of full tests.
std::string record(const AxisCounts& counts) {
  std::string text = counted(counts.switches, "switch", "switches");
  if (counts.hits > 0)
    text += ", " + counted(counts.tests, "full test", "full tests") + ", " +
            counted(counts.hits, "cache hit", "cache hits");
  return text;
}

/// Axis of the contact, frame by frame. A change of rows is a flip-flop; a mark within a row is a
/// change of face or edge pair. With a cache, a row below shows the frames that tested all axes.
class AxisHistoryPanel : public PanelContent {
 public:
  AxisHistoryPanel(const Staging& staging, const Frames& frames) : PanelContent(staging, frames) {
    cached_ = std::ranges::any_of(
        frames, [](const trace::Frame& frame) { return first_pair(frame, from_cache) != nullptr; });
    const std::vector<const trace::Pair*> pairs =
        distinct_pairs(frames, [](const trace::Pair& pair) { return !axis_of(pair).empty(); });
    count_ = pairs.size();
    // No more than fit into the panel column.
    const double least = kMinHistory * Sheet::line_height(scale_);
    const double most = std::max(1.0, staging.layout.panels.height / least);
    for (std::size_t i = 0; i < std::min(count_, static_cast<std::size_t>(most)); ++i)
      pairs_.push_back({pair_name(*pairs[i]), axis_history(pair_history(frames, *pairs[i]))});
  }

  PanelNeed need(const PanelMoment&) const override {
    const float line = Sheet::line_height(scale_);
    const float frame = Sheet::heading_height(scale_) + headline_height();
    const float each = (kMinHistory + tests_row()) * line;
    return {frame + each + (count_ > 1 ? line : 0),
            frame + each * std::max(1.0f, static_cast<float>(count_)), 0, 1};
  }

  std::string lay_out(const PanelMoment& moment, Sheet& sheet) override {
    sheet.heading("chosen axis, frame by frame");
    if (pairs_.empty())
      return sheet.inapplicable("no separating axis test of two hulls in this sequence");
    if (headline_height() > 0) draw_headline(pairs_.front().second, moment.frame, sheet);
    const float line = sheet.line_height();
    const float least = (kMinHistory + tests_row()) * line;
    auto available = static_cast<float>(sheet.rest().height);
    if (least * static_cast<float>(count_) > available) available -= line;  // for the note below
    const float fitting = std::max(1.0f, available / least);
    const std::size_t shown = std::min(pairs_.size(), static_cast<std::size_t>(fitting));
    const float row =
        std::min((count_ > 1 ? kMaxRow : kMaxRowOfOne) * line,
                 (available / static_cast<float>(shown) - (kAroundHistory + tests_row()) * line) /
                     static_cast<float>(kAxisRows.size()));
    for (const auto& [name, moments] : std::span(pairs_).first(shown)) {
      if (!(headline_height() > 0))
        sheet.line(name + ": " + record(axis_counts(moments, moment.frame)), kText);
      draw_rows(moments, moment.frame, row, sheet);
      sheet.skip(row * static_cast<float>(kAxisRows.size()));
      if (cached_) {
        draw_tests(moments, moment.frame, sheet);
        sheet.skip(tests_row() * line);
      }
      draw_ends(moments.size(), moment.frame, sheet);
      sheet.skip(1.5f * line);
    }
    return sheet.more(count_ - shown, "pair", "pairs");
  }

 private:
  /// Height of the headline, for a single pair with cache hits.
  float headline_height() const {
    return cached_ && count_ == 1 ? kHeadline * Sheet::line_height(scale_) : 0;
  }

  /// Lines of text.
  float tests_row() const { return cached_ ? kTestsRow : 0; }

  /// Summary of the history, large enough to be legible on a thumbnail.
  void draw_headline(const std::vector<AxisMoment>& moments, std::size_t now, Sheet& sheet) const {
    const AxisCounts counts = axis_counts(moments, now);
    const Rect rest = sheet.rest();
    const Pen& pen = sheet.pen();
    const std::string number = std::to_string(counts.hits) + " of " + std::to_string(now + 1);
    const Point2 at = pixel(rest.x, rest.y + pen.px(kHeadlineSize));
    pen.text(number, at, Align::Left, kAxisText, Weight::Bold, kHeadlineSize);
    const float used = text_width(pen.said(number).text + " ", pen.px(kHeadlineSize), Weight::Bold);
    pen.text("frames need no full test", {at.x + used, at.y}, Align::Left, kText, Weight::Bold, 17);
    sheet.skip(headline_height());
  }

  /// Below the rows: the first and the last frame number, and the current frame if there is room.
  static void draw_ends(std::size_t frames, std::size_t now, const Sheet& sheet) {
    const Pen& pen = sheet.pen();
    const Rect rest = sheet.rest();
    const double y = rest.y + sheet.text_height();
    const std::string first = "frame 0", last = std::to_string(frames - 1), here = "this frame";
    const double left = rest.x + pen.px(kNameColumn), width = rest.right() - left;
    const double x = left + width * (static_cast<double>(now) + 0.5) / static_cast<double>(frames);
    const double half = 0.5 * pen.width_of(here, Weight::Bold) + pen.px(6);
    const double low = left + half, high = rest.right() - half;
    const double at = std::clamp(x, low, std::max(low, high));
    pen.text(here, pixel(at, y), Align::Center, kText, Weight::Bold);
    if (at - half > left + pen.width_of(first))
      pen.text(first, pixel(left, y), Align::Left, kQuietText);
    if (at + half < rest.right() - pen.width_of(last))
      pen.text(last, pixel(rest.right(), y), Align::Right, kQuietText);
  }

  void draw_rows(const std::vector<AxisMoment>& moments, std::size_t now, float row,
                 const Sheet& sheet) const {
    const Pen& pen = sheet.pen();
    const Rect rest = sheet.rest();
    const double left = rest.x + pen.px(kNameColumn), width = rest.right() - left;
    const double cell = width / static_cast<double>(moments.size());
    const double gap = pen.px(1);
    const auto at = [&](std::size_t frame) { return left + cell * static_cast<double>(frame); };
    for (std::size_t r = 0; r < kAxisRows.size(); ++r) {
      const double y = rest.y + row * static_cast<double>(r);
      pen.text(kAxisRows[r].name, pixel(rest.x, y + 0.5 * row + 0.3 * sheet.text_height()),
               Align::Left, kQuietText);
      pen.fill({left, y + gap, width, row - 2 * gap}, with_alpha(kQuietText, 0.10f));
      const auto is_here = [&](std::size_t f) {
        return moments[f].pair != nullptr && moments[f].axis == kAxisRows[r].axis;
      };
      for (std::size_t from = 0, to = 0; from <= now; from = to) {
        to = from + 1;
        if (!is_here(from)) continue;
        while (to <= now && is_here(to)) ++to;
        pen.fill({at(from), y + gap, at(to) - at(from), row - 2 * gap}, kAxis);
      }
      for (std::size_t f = 0; f <= now; ++f) {
        if (!is_here(f) || !moments[f].switched) continue;
        pen.fill({at(f) - pen.px(1.5), y, pen.px(3), static_cast<double>(row)}, kWhite);
      }
    }
    const double most = row * static_cast<double>(kAxisRows.size());
    pen.frame({at(now), rest.y - pen.px(1), cell, most + pen.px(2)}, 1.5, kText);
  }

  /// Below the rows: frames without a cache hit.
  static void draw_tests(const std::vector<AxisMoment>& moments, std::size_t now,
                         const Sheet& sheet) {
    const Pen& pen = sheet.pen();
    const Rect rest = sheet.rest();
    const double left = rest.x + pen.px(kNameColumn), width = rest.right() - left;
    const double cell = width / static_cast<double>(moments.size());
    const double y = rest.y + 0.4 * sheet.line_height();
    const double height = (kTestsRow - 0.6) * sheet.line_height();
    pen.text("full test", pixel(rest.x, y + 0.5 * height + 0.3 * sheet.text_height()), Align::Left,
             kText);
    pen.fill({left, y, width, height}, with_alpha(kQuietText, 0.10f));
    for (std::size_t f = 0; f <= now; ++f) {
      if (moments[f].pair != nullptr && !from_cache(*moments[f].pair))
        pen.fill({left + cell * static_cast<double>(f), y, cell, height}, kText);
    }
  }

  bool cached_ = false;    // some frame has a cache hit
  std::size_t count_ = 0;  // pairs with a known axis
  std::vector<std::pair<std::string, std::vector<AxisMoment>>> pairs_;  // the first pairs, by name
};

}  // namespace

const PanelDrawing kAxisHistoryPanel{.needs = {&Stages::sat}, .make = make_panel<AxisHistoryPanel>};

}  // namespace contactscope::draw
