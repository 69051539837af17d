#include "draw/panels/panel.h"
#include "draw/scene/outlines.h"
#include "draw/scene/pairs.h"

/// The separating axis test of two bounds as on a blackboard: on each axis the interval of A above
/// the interval of B, and the gap between them.
namespace contactscope::draw {
namespace {

// Pixels at 720 lines.
constexpr double kIntervalNames = 90, kGapColumn = 82;
constexpr double kBar = 5;  // an interval
constexpr float kBelowPair = 8, kHeadRow = 4;
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

// State of sweep and prune: the ends of all boxes, sorted on each axis, and the ends that have
// swapped since the previous frame.

// Pixels at 720 lines: height of a row; larger if one or two axes without swaps leave room.
constexpr float kMinBox = 3, kMaxBox = 21, kLargestBox = 30, kLargestAlone = 44;
constexpr float kNamed = 14;         // rows from this height on have names
constexpr double kBoxNames = 74;     // pixels at 720 lines
constexpr double kLargerText = 1.2;  // next to the largest boxes
constexpr double kAfterAxis = 8;
constexpr double kBelowMiddle = 5.5;  // from the middle of a row to the baseline of a name
constexpr const char* kAxes[] = {"x", "y", "z"};

// If two boxes swap ends: the colour of a pair that begins or ends is that of overlapping boxes.
constexpr Color kPairPasses = kBox, kOthersPass = kShapeEdge;

class EndpointsPanel : public PanelContent {
 public:
  EndpointsPanel(const Staging& staging, const Frames& frames) : PanelContent(staging, frames) {
    for (const trace::Frame& frame : frames) {
      if (!frame.broad_phase) continue;
      boxes_ = std::max(boxes_, frame.broad_phase->bounds.size());
      for (const trace::Bounds& bounds : frame.broad_phase->bounds)
        world_.extend(solid_box(bounds.box));
    }
  }

  PanelNeed need(const PanelMoment&) const override {
    const auto height = [&](float row) {
      return Sheet::heading_height(scale_) +
             3 * (Sheet::line_height(scale_) +
                  scale_ * (row * static_cast<float>(boxes_) + static_cast<float>(kAfterAxis)));
    };
    return {height(kMinBox), height(kMaxBox), height(kMaxBox), 0};
  }

  std::string lay_out(const PanelMoment& moment, Sheet& sheet) override {
    sheet.heading("ends in order on three axes");
    const auto& phase = frames_[moment.frame].broad_phase;
    if (!phase || phase->bounds.empty())
      return sheet.inapplicable("no broad phase chooses the pairs");
    const double axes_height =
        3 * (sheet.line_height() + static_cast<double>(sheet.pen().px(kAfterAxis)));
    const int shown = axes_shown(*phase);
    const double room = (sheet.rest().height - axes_height) / static_cast<double>(boxes_);
    const float most = shown == 3 ? kMaxBox : shown == 2 ? kLargestBox : kLargestAlone;
    const double row = std::min<double>(sheet.pen().px(most), room / shown);
    sheet.enlarge(std::clamp(row / static_cast<double>(sheet.pen().px(kMaxBox)), 1.0, kLargerText));
    for (int axis = 0; axis < 3; ++axis)
      draw_axis(*phase, axis, shown == 3 || has_bars(*phase, axis), row, sheet);
    return {};
  }

 private:
  static bool passes(const trace::BroadPhase& phase, int axis) {
    return std::ranges::any_of(
        phase.end_swaps, [&](const trace::EndSwap& swap) { return swap.axis == kAxes[axis]; });
  }

  /// If only two boxes swap ends in a frame: whether they overlap on an axis without swaps.
  static std::optional<bool> passing_boxes_overlap(const trace::BroadPhase& phase, int axis) {
    if (phase.end_swaps.size() != 1) return std::nullopt;
    const trace::EndSwap& swap = phase.end_swaps[0];
    const auto lower = std::ranges::find(phase.bounds, swap.lower, &trace::Bounds::name),
               upper = std::ranges::find(phase.bounds, swap.upper, &trace::Bounds::name);
    if (lower == phase.bounds.end() || upper == phase.bounds.end()) return std::nullopt;
    return lower->box.lower[axis] <= upper->box.upper[axis] &&
           upper->box.lower[axis] <= lower->box.upper[axis];
  }

  /// Whether boxes with swaps on another axis are no pair because of this axis.
  static bool parts(const trace::BroadPhase& phase, int axis) {
    return !passes(phase, axis) && !passing_boxes_overlap(phase, axis).value_or(true);
  }

  static bool has_bars(const trace::BroadPhase& phase, int axis) {
    return passes(phase, axis) || parts(phase, axis);
  }

  static int axes_shown(const trace::BroadPhase& phase) {
    int shown = 0;
    for (int axis = 0; axis < 3; ++axis) shown += has_bars(phase, axis);
    return shown == 0 ? 3 : shown;
  }

  /// Describes the swaps on an axis; for a single swap with the names of the two boxes.
  static std::string what_passes(const trace::BroadPhase& phase, int axis) {
    int swaps = 0;
    std::size_t begun = 0, ended = 0;
    const trace::EndSwap* last = nullptr;
    for (const trace::EndSwap& swap : phase.end_swaps) {
      if (swap.axis != kAxes[axis]) continue;
      ++swaps;
      (swap.meets ? begun : ended) += swap.counts;
      last = &swap;
    }
    if (swaps == 0) {
      const std::optional<bool> overlap = passing_boxes_overlap(phase, axis);
      if (!overlap) return "nothing passes";
      const trace::EndSwap& swap = phase.end_swaps[0];
      return in_words(swap.lower) + (*overlap ? " overlaps " : " is apart from ") +
             in_words(swap.upper);
    }
    const std::string outcome = begun + ended == 0 ? "no pair begins"
                                : ended == 0       ? counted(begun, "pair begins", "pairs begin")
                                : begun == 0       ? counted(ended, "pair ends", "pairs end")
                                             : counted(begun, "pair begins", "pairs begin") + ", " +
                                                   counted(ended, "ends", "end");
    if (swaps > 1) return std::to_string(swaps) + " ends pass, " + outcome;
    return in_words(last->lower) + " passes " + in_words(last->upper) + ", " + outcome;
  }

  /// One bar per box, in the order of their lower ends; without bars only the text.
  void draw_axis(const trace::BroadPhase& phase, int axis, bool with_bars, double row,
                 Sheet& sheet) const {
    sheet.line(std::string("along ") + kAxes[axis] + ": " + what_passes(phase, axis), kText);
    const Pen& pen = sheet.pen();
    if (!with_bars) return sheet.skip(pen.px(kAfterAxis));
    const Rect rest = sheet.rest();
    const bool named = row >= static_cast<double>(pen.px(kNamed));
    const double left = rest.x + (named ? static_cast<double>(pen.px(kBoxNames)) : 0);
    const double extent = world_.sizes()[axis];
    const auto across = [&](double place) {
      return left +
             (rest.right() - left) * (extent > 0 ? (place - world_.min()[axis]) / extent : 0);
    };
    std::vector<trace::Bounds> boxes = phase.bounds;
    std::ranges::stable_sort(boxes, {}, [&](const trace::Bounds& b) { return b.box.lower[axis]; });
    std::map<std::string, double> height_of;
    double y = rest.y;
    for (const trace::Bounds& bounds : boxes) {
      const double bar = std::max(1.0, 0.5 * row), from = across(bounds.box.lower[axis]);
      pen.fill(
          {from, y + 0.5 * (row - bar), std::max(1.0, across(bounds.box.upper[axis]) - from), bar},
          color_of(phase, axis, bounds.name));
      if (named)
        pen.text(pen.fitted(in_words(bounds.name), FontWeight::Regular, pen.px(kBoxNames - 6)),
                 {static_cast<float>(rest.x),
                  static_cast<float>(y + 0.5 * row + static_cast<double>(pen.px(kBelowMiddle)))},
                 Align::Left, kQuietText);
      height_of[bounds.name] = y + 0.5 * row;
      y += row;
    }
    for (const trace::EndSwap& swap : phase.end_swaps) {
      if (swap.axis != kAxes[axis]) continue;
      const auto lower = height_of.find(swap.lower), upper = height_of.find(swap.upper);
      if (lower == height_of.end() || upper == height_of.end()) continue;
      const double x = across(swap.place);
      const Color color = swap.counts ? kPairPasses : kOthersPass;
      pen.line(pixel(x, lower->second), pixel(x, upper->second), swap.counts ? 2.5 : 1.5, color);
    }
    sheet.skip_to(y + static_cast<double>(pen.px(kAfterAxis)));
  }

  /// The strongest colour of the box's swaps on the axis, or of its separation there from the box
  /// with which it swaps elsewhere; otherwise faint.
  static Color color_of(const trace::BroadPhase& phase, int axis, const std::string& name) {
    Color color = with_alpha(kShapeEdge, 0.3f);
    for (const trace::EndSwap& swap : phase.end_swaps) {
      if (!(swap.axis == kAxes[axis] || parts(phase, axis)) ||
          (swap.lower != name && swap.upper != name))
        continue;
      if (swap.counts) return kPairPasses;
      color = with_alpha(kOthersPass, 0.75f);
    }
    return color;
  }

  std::size_t boxes_ = 0;
  Eigen::AlignedBox3d world_;
};

}  // namespace

const PanelDrawing kAxisIntervalsPanel{.needs = {&Stages::query},
                                       .make = make_panel<AxisIntervalsPanel>};

const PanelDrawing kEndpointsPanel{.needs = {&Stages::cells}, .make = make_panel<EndpointsPanel>};

}  // namespace contactscope::draw
