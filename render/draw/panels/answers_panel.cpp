#include "draw/panels/panel.h"
#include "draw/scene/pairs.h"

/// Answers of each pair, frame by frame, and the share of wrong ones: the survey's "false
/// positives" of bounds. Without bounds, yes or no is a cell, and a distance or depth a column of
/// that height.
namespace contactscope::draw {
namespace {

// Pixels at 720 lines: a row of cells, the tallest column, and the room below and between rows.
constexpr double kAnswerBar = 14, kTallestBar = 26, kBelowAnswerBar = 3;
constexpr double kMinBetween = 8, kMaxBetween = 16;
constexpr double kLargestAnswers = 1.25;  // factor of all sizes if there is room

bool has_query(const trace::Pair& pair) { return pair.query.has_value(); }

bool is_measure(const trace::Query& query) {
  return query.requested == "distance" || query.requested == "penetration";
}

/// Distance or depth as queried, metres; 0 for the depth of separated and distance of overlapping
/// shapes.
double measured(const trace::Pair& pair) {
  const double gap = pair.query->gap.value_or(0);
  return std::max(0.0, pair.query->requested == "distance" ? gap : -gap);
}

struct AnswerHistory {
  std::string name;
  std::vector<const trace::Pair*> moments;  // one per frame; null without such a pair
  bool of_bounds = false;
  bool measures = false;                           // queries a distance or depth
  std::vector<std::optional<AnswerKind>> answers;  // one per frame
};

class AnswersPanel : public PanelContent {
 public:
  AnswersPanel(const Staging& staging, const Frames& frames) : PanelContent(staging, frames) {
    for (const trace::Pair* pair : distinct_pairs(frames, has_query)) {
      AnswerHistory& history = histories_.emplace_back();
      history.name = pair_name(*pair);
      history.moments = pair_history(frames, *pair);
      for (const trace::Pair* moment : history.moments) {
        std::optional<AnswerKind>& answer = history.answers.emplace_back();
        if (moment == nullptr || !moment->query) continue;
        answer = answer_kind(*moment);
        history.of_bounds = history.of_bounds || moment->query->shapes.has_value();
        has_wrong_ = has_wrong_ || is_wrong(*answer);
      }
    }
    std::ranges::stable_sort(histories_, {}, &AnswerHistory::of_bounds);
    // Next to bounds, a distance is the ground truth for comparison.
    if (std::ranges::any_of(histories_, &AnswerHistory::of_bounds)) return;
    for (AnswerHistory& history : histories_) {
      for (const trace::Pair* moment : history.moments) {
        if (moment == nullptr || !moment->query || !is_measure(*moment->query)) continue;
        history.measures = has_measure_ = true;
        farthest_ = std::max(farthest_, measured(*moment));
      }
    }
  }

  PanelNeed need(const PanelMoment&) const override {
    const float heading = Sheet::heading_height(scale_), count = static_cast<float>(rows());
    const auto between = scale_ * static_cast<float>(kMinBetween);
    return {heading + row_height(), heading + count * (row_height() + between),
            heading + count * most_of_row(), 0};
  }

  std::string lay_out(const PanelMoment& moment, Sheet& sheet) override {
    sheet.heading(is_sequence() ? "answers, frame by frame" : "answers");
    if (histories_.empty()) return sheet.inapplicable("no pair is asked anything in this sequence");
    const double room = sheet.rest().height / static_cast<double>(rows());
    const double row = row_height(), widest = kMaxBetween * static_cast<double>(scale_);
    larger_ = std::clamp(room / (row + widest), 1.0, kLargestAnswers);
    sheet.enlarge(larger_);
    const auto between =
        static_cast<float>(std::clamp(room - larger_ * row, 0.0, larger_ * widest));
    std::size_t shown = 0;
    for (const AnswerHistory& history : histories_) {
      const bool fits = larger_ * row <= sheet.rest().height + 1;
      if (shown > 0 && !fits) break;
      draw_row(history, moment.frame, sheet);
      sheet.skip(between);
      ++shown;
    }
    return sheet.more(histories_.size() - shown, "pair", "pairs");
  }

 private:
  std::size_t rows() const { return std::max<std::size_t>(1, histories_.size()); }

  /// Height of name and answer, the cells, and a line of text.
  float row_height() const {
    const double bar = is_sequence() ? bar_height() + kBelowAnswerBar : 0;
    return Sheet::line_height(scale_) * (has_wrong_ ? 2.0f : 1.0f) +
           static_cast<float>(bar + 8) * scale_;
  }

  double bar_height() const { return has_measure_ ? kTallestBar : kAnswerBar; }

  /// With the space before the next row.
  float most_of_row() const {
    const double row = row_height() + scale_ * static_cast<float>(kMaxBetween);
    return static_cast<float>(kLargestAnswers * row);
  }

  /// A single frame has no history.
  bool is_sequence() const {
    return std::ranges::any_of(
        histories_, [](const AnswerHistory& history) { return history.answers.size() > 1; });
  }

  void draw_row(const AnswerHistory& history, std::size_t now, Sheet& sheet) const {
    const Pen& pen = sheet.pen();
    const Rect rest = sheet.rest();
    const double baseline = rest.y + 0.82 * sheet.text_height();
    const std::string answer = answer_at(history, now);
    const float used = pen.width_of(answer) + pen.px(10);
    const auto size = static_cast<double>(sheet.text_height() / pen.scale());
    pen.text(pen.fitted(history.name, Weight::Bold, static_cast<float>(rest.width) - used, size),
             pixel(rest.x, baseline), Align::Left, kText, Weight::Bold);
    pen.text(answer, pixel(rest.right(), baseline), Align::Right, kText);
    sheet.skip(sheet.text_height());
    if (is_sequence()) {
      draw_cells(history, now, sheet);
      sheet.skip(pen.px(larger_ * (bar_height() + kBelowAnswerBar)));
    }
    if (has_wrong_) sheet.line(record(history, now), kQuietText);
  }

  /// For shapes the answer itself; for bounds whether it is right: "yes, falsely".
  std::string answer_at(const AnswerHistory& history, std::size_t now) const {
    if (!history.answers[now]) return "not asked";
    const trace::Pair& moment = *history.moments[now];
    if (history.measures) return spell_length(measured(moment), 0, staging_.scales.length);
    if (has_measure_) return *history.answers[now] == AnswerKind::Yes ? "yes" : "no";
    if (!history.of_bounds) return spell_answer(moment, staging_.scales.length);
    return spell_answer_kind(*history.answers[now]);
  }

  /// For bounds, the count up to a frame: "falsely in 5 of 24 frames". Empty if none is wrong.
  static std::string record(const AnswerHistory& history, std::size_t now) {
    std::size_t requested = 0, wrong = 0;
    for (std::size_t f = 0; f <= now; ++f) {
      const auto& answer = history.answers[f];
      if (!answer) continue;
      ++requested;
      wrong += is_wrong(*answer);
    }
    if (wrong == 0) return {};
    return "falsely in " + std::to_string(wrong) + " of " + counted(requested, "frame", "frames");
  }

  void draw_cells(const AnswerHistory& history, std::size_t now, const Sheet& sheet) const {
    const Pen& pen = sheet.pen();
    const Rect rest = sheet.rest();
    const double height = pen.px(larger_ * bar_height());
    const double cell = rest.width / static_cast<double>(history.answers.size());
    pen.fill({rest.x, rest.y, rest.width, height}, with_alpha(kQuietText, 0.08f));
    for (std::size_t f = 0; f <= now; ++f) {
      if (!history.answers[f]) continue;
      const double left = rest.x + cell * static_cast<double>(f);
      if (history.measures) {
        const double tall = farthest_ > 0 ? measured(*history.moments[f]) / farthest_ * height : 0;
        pen.fill({left, rest.y + height - tall, cell, tall}, kAxis);
        continue;
      }
      const AnswerKind kind = *history.answers[f];
      const bool no = kind == AnswerKind::No;
      // Wrong answers are taller, so that they also differ without colours.
      const double top = rest.y + (no ? 0.6 : kind == AnswerKind::Yes ? 0.3 : 0.0) * height;
      pen.fill({left, top, cell, rest.y + height - top},
               with_alpha(answer_color(kind), no ? 0.35f : 1.0f));
    }
    const double here = rest.x + cell * static_cast<double>(now);
    pen.frame({here, rest.y - pen.px(1.5), cell, height + pen.px(3)}, 1.5, kText);
  }

  double larger_ = 1;                     // enlargement if the sheet has room
  bool has_wrong_ = false;                // some bounds answered wrongly in some frame
  bool has_measure_ = false;              // some query of a distance or depth, and none of bounds
  double farthest_ = 0;                   // metres, largest of these answers
  std::vector<AnswerHistory> histories_;  // shapes before bounds
};

}  // namespace

const PanelDrawing kAnswersPanel{.needs = {&Stages::query}, .make = make_panel<AnswersPanel>};

}  // namespace contactscope::draw
