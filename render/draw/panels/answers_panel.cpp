#include <algorithm>
#include <cmath>

#include "draw/panels/panel.h"
#include "draw/scene/answers.h"
#include "draw/scene/pairs.h"
#include "draw/scene/quantity.h"

/// What each pair answered, frame by frame, and which share of the answers was wrong: the survey's
/// "false positives" of bounds.
namespace contactscope::draw {
namespace {

constexpr float kBarLines = 0.55f;  // height of a row of cells, in lines of text
constexpr float kBelowBar = 3;      // pixels at 720 lines

bool has_query(const trace::Pair& pair) {
  return pair.query.has_value();
}

struct AnswerHistory {
  std::string name;
  std::vector<const trace::Pair*> moments;  // one a frame; null where it has no such pair
  bool of_bounds = false;
  std::vector<std::optional<AnswerKind>> answers;  // one a frame
};

class AnswersPanel : public PanelContent {
 public:
  AnswersPanel(const Staging& staging, const Frames& frames) : scale_(staging.layout.scale) {
    for (const trace::Pair* pair : distinct_pairs(frames, has_query)) {
      AnswerHistory& history = histories_.emplace_back();
      history.name = pair_name(*pair);
      history.moments = pair_history(frames, *pair);
      for (const trace::Pair* moment : history.moments) {
        std::optional<AnswerKind>& answer = history.answers.emplace_back();
        if (moment == nullptr || !moment->query) continue;
        answer = answer_kind(*moment);
        history.of_bounds = history.of_bounds || moment->query->shapes.has_value();
      }
    }
  }

  PanelNeed need(const PanelMoment&) const override {
    const float heading = Sheet::heading_height(scale_);
    const float one = row_height(), count = static_cast<float>(histories_.size());
    const float all = heading + one * std::max(1.0f, count);
    return {heading + one, all, all, 0};
  }

  std::string lay_out(const PanelMoment& moment, Sheet& sheet) override {
    sheet.heading(is_sequence() ? "answers, frame by frame" : "answers");
    if (histories_.empty()) {
      sheet.paragraph("does not apply: no pair is asked anything in this sequence", kQuietText);
      return {};
    }
    std::size_t shown = 0;
    for (const AnswerHistory& history : histories_) {
      const bool fits = row_height() <= static_cast<float>(sheet.rest().height) + 1;
      if (shown > 0 && !fits) break;
      sheet.line(history.name + ": " + told(history, moment.frame), kText);
      if (is_sequence()) draw_cells(history, moment.frame, sheet);
      const float bar = is_sequence() ? kBarLines * sheet.text_height() : 0;
      sheet.skip(bar + kBelowBar * scale_);
      ++shown;
    }
    return sheet.more(histories_.size() - shown, "pair", "pairs");
  }

 private:
  float row_height() const {
    const float bar = is_sequence() ? kBarLines : 0;
    return Sheet::line_height(scale_) * (1 + bar) + (kBelowBar + 2) * scale_;
  }

  /// A frame alone has no history.
  bool is_sequence() const {
    return std::ranges::any_of(
        histories_, [](const AnswerHistory& history) { return history.answers.size() > 1; });
  }

  /// Of shapes the answer of a frame; of bounds those up to it: "yes 12 of 24, 5 false (42 %)".
  static std::string told(const AnswerHistory& history, std::size_t now) {
    if (!history.of_bounds)
      return history.answers[now] ? spell_answer(*history.moments[now]) : "not asked";
    int asked = 0, yes = 0, wrong = 0, missed = 0;
    for (std::size_t f = 0; f <= now; ++f) {
      const auto& answer = history.answers[f];
      if (!answer) continue;
      ++asked;
      yes += *answer == AnswerKind::Yes || *answer == AnswerKind::FalsePositive;
      missed += *answer == AnswerKind::Missed;
      wrong += *answer == AnswerKind::FalsePositive;
    }
    std::string text = "yes " + std::to_string(yes) + " of " + std::to_string(asked);
    text += ", " + std::to_string(wrong) + " false";
    if (missed > 0) return text + ", " + std::to_string(missed) + " missed";
    if (wrong > 0) text += printed(" (%.0f %%)", 100.0 * wrong / yes);
    return text;
  }

  static void draw_cells(const AnswerHistory& history, std::size_t now, const Sheet& sheet) {
    const Pen& pen = sheet.pen();
    const Rect rest = sheet.rest();
    const double height = kBarLines * sheet.text_height();
    const double cell = rest.width / static_cast<double>(history.answers.size());
    pen.fill({rest.x, rest.y, rest.width, height}, with_alpha(kQuietText, 0.08f));
    for (std::size_t f = 0; f <= now; ++f) {
      if (!history.answers[f]) continue;
      const AnswerKind kind = *history.answers[f];
      const bool no = kind == AnswerKind::No;
      // A wrong one is higher, so that it is told apart in grey as well.
      const double top = rest.y + (no ? 0.6 : kind == AnswerKind::Yes ? 0.3 : 0.0) * height;
      pen.fill({rest.x + cell * static_cast<double>(f), top, cell, rest.y + height - top},
               with_alpha(answer_color(kind), no ? 0.35f : 1.0f));
    }
    const double here = rest.x + cell * static_cast<double>(now);
    pen.frame({here, rest.y - pen.px(1.5), cell, height + pen.px(3)}, 1.5, kText);
  }

  float scale_;
  std::vector<AnswerHistory> histories_;
};

}  // namespace

std::unique_ptr<PanelContent> make_answers_panel(const Staging& staging, const Frames& frames) {
  return std::make_unique<AnswersPanel>(staging, frames);
}

}  // namespace contactscope::draw
