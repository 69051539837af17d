#include <algorithm>
#include <cmath>

#include "draw/panels/panel.h"
#include "draw/scene/answers.h"
#include "draw/scene/pair_words.h"
#include "draw/scene/pairs.h"
#include "draw/scene/quantity.h"

/// The separating axis test of two bounds as on a blackboard: on each axis the interval of A above
/// the interval of B, and the gap between them.
namespace contactscope::draw {
namespace {

// Pixels at 720 lines.
constexpr double kIntervalNames = 90, kGapColumn = 82;
constexpr double kBar = 5;  // an interval
constexpr float kBelowPair = 8;
constexpr float kHeadRow = 4;
constexpr double kLargestIntervals = 1.25;  // factor of all sizes if there is room

bool has_axes(const trace::Pair& pair) { return pair.query && !pair.query->axes.empty(); }

class AxisIntervalsPanel : public PanelContent {
 public:
  AxisIntervalsPanel(const Staging& staging, const Frames& frames) : PanelContent(staging, frames) {
    for (const trace::Frame& frame : frames) {
      for (const trace::Pair& pair : frame.pairs) {
        if (!is_shown(pair)) continue;
        for (const trace::TestedAxis& axis : pair.query->axes)
          for (const double end :
               {axis.interval_a[0], axis.interval_a[1], axis.interval_b[0], axis.interval_b[1]})
            reach_ = std::max(reach_, std::abs(end));
      }
    }
  }

  PanelNeed need(const PanelMoment& moment) const override {
    float all = 0, first = 0;
    for (const trace::Pair& pair : frames_[moment.frame].pairs) {
      if (!is_shown(pair)) continue;
      all += height_of(pair);
      if (first == 0) first = all;
    }
    const float heading = Sheet::heading_height(scale_) + Sheet::line_height(scale_);
    return {heading + first, heading + all, heading + static_cast<float>(kLargestIntervals) * all,
            0};
  }

  std::string lay_out(const PanelMoment& moment, Sheet& sheet) override {
    sheet.heading("intervals of A and B along each axis");
    std::size_t left_out = 0;
    bool any = false;
    double all = 0;
    for (const trace::Pair& pair : frames_[moment.frame].pairs)
      if (is_shown(pair)) all += height_of(pair);
    larger_ = all > 0 ? std::clamp(sheet.rest().height / all, 1.0, kLargestIntervals) : 1;
    sheet.enlarge(larger_);
    for (const trace::Pair& pair : frames_[moment.frame].pairs) {
      if (!is_shown(pair)) continue;
      const bool fits = larger_ * height_of(pair) <= sheet.rest().height + 1;
      if (any && (!fits || left_out > 0)) {
        ++left_out;
        continue;
      }
      any = true;
      draw_head(pair, sheet);
      for (const trace::TestedAxis& axis : pair.query->axes) draw_row(*pair.query, axis, sheet);
      sheet.skip(kBelowPair * scale_ * static_cast<float>(larger_));
    }
    if (!any) sheet.paragraph("does not apply: no bounds were asked in this frame", kQuietText);
    return sheet.more(left_out, "pair", "pairs");
  }

 private:
  /// Only pairs in view have rows. Side by side, each pair has its own camera.
  bool is_shown(const trace::Pair& pair) const {
    if (!has_axes(pair)) return false;
    if (!staging_.viewports.empty() || !pair.query->bounds_a || !pair.query->bounds_b) return true;
    return staging_.camera.sees(0.5 *
                                (pair.query->bounds_a->center + pair.query->bounds_b->center));
  }

  /// The pair's name, and the meaning of its numbers: overlaps, unless marked as gaps.
  void draw_head(const trace::Pair& pair, Sheet& sheet) const {
    const Pen& pen = sheet.pen();
    const Rect rest = sheet.rest();
    const double baseline = rest.y + 0.86 * static_cast<double>(sheet.text_height());
    pen.text("overlap", pixel(rest.right(), baseline), Align::Right, kQuietText);
    sheet.line(pair_name(pair), kText);
  }

  float row_height() const { return Sheet::line_height(scale_); }
  float height_of(const trace::Pair& pair) const {
    return row_height() * static_cast<float>(1 + pair.query->axes.size()) +
           (kBelowPair + kHeadRow) * scale_;
  }

  void draw_row(const trace::Query& query, const trace::TestedAxis& axis, Sheet& sheet) const {
    const Pen& pen = sheet.pen();
    const Rect rest = sheet.rest();
    const double middle = rest.y + 0.5 * sheet.text_height();
    const double left = rest.x + pen.px(larger_ * kIntervalNames);
    const double right = rest.right() - pen.px(larger_ * kGapColumn), high = pen.px(larger_ * kBar);
    const bool vanishes = axis.direction.isZero(0);
    const bool counts = !axis.skipped && !vanishes;
    const auto at = [&](double metres) {
      return 0.5 * (left + right) + 0.5 * (right - left) * metres / std::max(reach_, 1e-300);
    };
    const auto bar = [&](const std::array<double, 2>& interval, double top, const Color& color) {
      const double width = std::max<double>(pen.px(1), at(interval[1]) - at(interval[0]));
      pen.fill({at(interval[0]), top, width, high}, with_alpha(color, counts ? 1.0f : 0.25f));
    };
    if (!vanishes) {
      bar(axis.interval_a, middle - high - pen.px(0.5), kArcOfA);
      bar(axis.interval_b, middle + pen.px(0.5), kArcOfB);
    }
    if (axis.separates) {
      double from = at(axis.interval_a[1]), to = at(axis.interval_b[0]);
      if (from > to) std::swap(from, to);
      const double width = std::max<double>(pen.px(3), to - from);
      pen.fill({0.5 * (from + to - width), middle - high - pen.px(2), width, 2 * high + pen.px(4)},
               with_alpha(kAxis, 0.8f));
    }
    const std::string gap = vanishes       ? "parallel"
                            : axis.skipped ? "skipped"
                            : axis.gap > 0
                                ? spell_separation(axis.gap, 0, staging_.scales.length)
                                : spell_length(std::abs(axis.gap), 0, staging_.scales.length);
    const float baseline = static_cast<float>(rest.y) + sheet.text_height() * 0.86f;
    pen.text(gap, {static_cast<float>(rest.right()), baseline}, Align::Right,
             axis.separates ? kAxisText
             : counts       ? kText
                            : kQuietText,
             axis.separates ? Weight::Bold : Weight::Regular);
    sheet.line(spell_axis(query, axis), counts ? kText : kQuietText);
  }

  double larger_ = 1;  // enlargement if the sheet has room
  double reach_ = 0;   // metres: largest distance of an interval's end from the middle
};

}  // namespace

const PanelDrawing kAxisIntervalsPanel{.needs = {&Stages::query},
                                       .make = make_panel<AxisIntervalsPanel>};

}  // namespace contactscope::draw
