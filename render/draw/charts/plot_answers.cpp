#include "draw/charts/plot.h"
#include "draw/scene/palette.h"
#include "draw/scene/quantity.h"

namespace contactscope::draw {
namespace {

// Pixels at 720 lines.
constexpr double kLeftOfAnswers = 36, kBetweenAnswers = 28, kOverAnswers = 20, kUnderAnswers = 44;

struct NamedAnswer {
  const char* name;
  Color color;  // Okabe-Ito
};
constexpr NamedAnswer kAnswers[] = {
    {"apart", rgb(0x56B4E9)}, {"touching", rgb(0xF0E442)}, {"crossing", rgb(0xD55E00)}};
constexpr NamedAnswer kFeatures[] = {{"apart", rgb(0xFFFFFF)},
                                     {"face of A", kReferenceFace},
                                     {"face of B", kIncidentFace},
                                     {"two edges", kAxis}};
constexpr Color kWrongAnswer = rgb(0x000000);

struct AnswerMaps : Pen {
  AnswerMaps(Pen pen, trace::StudyForm form)
      : Pen(pen),
        is_judged(form == trace::StudyForm::Answers),
        answers(is_judged ? std::span<const NamedAnswer>(kAnswers) : kFeatures) {}

  bool is_judged;  // an answer can be wrong
  double tick_along_by = is_judged ? 8 : 80, tick_up_by = is_judged ? 8 : 15;  // units
  std::span<const NamedAnswer> answers;

  const NamedAnswer& answer_at(const trace::StudyPoint& point) const {
    const auto last = static_cast<double>(answers.size() - 1);
    return answers[static_cast<std::size_t>(std::clamp(point.error.value_or(0), 0.0, last))];
  }

  void legend(const Point2& begin) const {
    float x = begin.x;
    const auto name = [&](const char* what) {
      text(what, {x + px(32), begin.y + px(5)}, Align::Left, kText);
      x += px(32) + width_of(what) + px(18);
    };
    for (const NamedAnswer& answer : answers) {
      const Rect box{x, begin.y - px(8), px(26), px(16)};
      fill(box, answer.color);
      frame(box, 1.2, kChartBorder);
      name(answer.name);
    }
    if (!is_judged) return;
    fill(middle_of({x + px(5), begin.y - px(8), px(16), px(16)}), kWrongAnswer);
    name("wrong");
  }

  /// A square in the middle of a cell that leaves the cell's colour visible.
  static Rect middle_of(const Rect& cell) {
    const double side = 0.5 * std::min(cell.width, cell.height);
    return {cell.x + 0.5 * (cell.width - side), cell.y + 0.5 * (cell.height - side), side, side};
  }

  /// Rows from bottom to top; all have the same parameters.
  void panel(const PlotPanel& panel, const std::string& row) const {
    const Rect& area = panel.area;
    const std::vector<trace::StudyPoint>& first = panel.series.front()->points;
    const double width = area.width / static_cast<double>(first.size());
    const double height = area.height / static_cast<double>(panel.series.size());
    int wrong = 0, of = 0;
    for (std::size_t j = 0; j < panel.series.size(); ++j) {
      const std::vector<trace::StudyPoint>& points = panel.series[j]->points;
      const double top = area.bottom() - static_cast<double>(j + 1) * height;
      // Neighbours of one colour are one rectangle, to avoid seams.
      for (std::size_t i = 0, end = 0; i < points.size(); i = end) {
        const NamedAnswer& answer = answer_at(points[i]);
        while (end < points.size() && &answer_at(points[end]) == &answer) ++end;
        fill({area.x + static_cast<double>(i) * width, top, static_cast<double>(end - i) * width,
              height},
             answer.color);
      }
      for (std::size_t i = 0; i < points.size(); ++i) {
        ++of;
        if (points[i].failed == 0) continue;
        ++wrong;
        fill(middle_of({area.x + static_cast<double>(i) * width, top, width, height}),
             kWrongAnswer);
      }
      tick_up(*panel.series[j]->row, static_cast<float>(top + 0.5 * height), panel);
    }
    for (std::size_t i = 0; i < first.size(); ++i)
      tick_along(first[i].parameter,
                 static_cast<float>(area.x + (static_cast<double>(i) + 0.5) * width), area);
    frame(area, 1.2, kChartBorder);
    const auto left = static_cast<float>(area.x), right = static_cast<float>(area.right());
    const float above = static_cast<float>(area.y) - px(6);
    text(panel.name, {left, above}, Align::Left, kText, Weight::Bold);
    if (is_judged)
      text(spell_count(wrong) + " of " + spell_count(of) + " wrong", {right, above}, Align::Right,
           kText);
    text("across: " + panel.parameter + ", up: " + row,
         {left, static_cast<float>(area.bottom()) + px(38)}, Align::Left, kQuietText);
  }

 private:
  void tick_up(double value, float y, const PlotPanel& panel) const {
    if (std::remainder(value, tick_up_by) != 0) return;
    const auto left = static_cast<float>(panel.area.x);
    line({left - px(5), y}, {left, y}, 1.2, kChartBorder);
    if (panel.begins_row)
      text(spell_number(value), {left - px(8), y + px(5)}, Align::Right, kQuietText);
  }

  void tick_along(double value, float x, const Rect& area) const {
    if (std::remainder(value, tick_along_by) != 0) return;
    const auto bottom = static_cast<float>(area.bottom());
    line({x, bottom}, {x, bottom + px(5)}, 1.2, kChartBorder);
    text(spell_number(value), {x, bottom + px(18)}, Align::Center, kQuietText);
  }
};

}  // namespace

Drawing plot_answers(const trace::Study& study, int width, int height) {
  PlotPage page = plot_page(study, study.shown.empty() ? "Colour: " + study.error : study.shown,
                            true, width, height);
  const AnswerMaps maps{Pen(page.drawing, page.scale, kPlotText), study.form};
  maps.legend(page.legend);
  std::vector<PlotPanel> panels = panels_of(study);
  const double scale = page.scale, count = static_cast<double>(panels.size());
  const double across =
      (page.panels.width - scale * (kLeftOfAnswers + (count - 1) * kBetweenAnswers)) / count;
  const double side = std::min(across, page.panels.height - scale * (kOverAnswers + kUnderAnswers));
  double x = page.panels.x + scale * kLeftOfAnswers;
  // In the middle of the room below the legend.
  const double spare = page.panels.height - scale * (kOverAnswers + kUnderAnswers) - side;
  for (PlotPanel& panel : panels) {
    panel.area = {x, page.panels.y + scale * kOverAnswers + 0.4 * spare, side, side};
    panel.begins_row = &panel == &panels.front();
    maps.panel(panel, study.row);
    x += side + scale * kBetweenAnswers;
  }
  return page.drawing;
}

}  // namespace contactscope::draw
