#include "draw/charts/plot.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "draw/charts/plot_page.h"
#include "draw/charts/plot_panel.h"
#include "draw/scene/layout.h"
#include "draw/scene/palette.h"
#include "draw/scene/quantity.h"

namespace contactscope::draw {
namespace {

constexpr double kTitle = 28;
constexpr double kSubtitle = 15;
constexpr double kCaption = 14;
constexpr double kGutter = 22;

std::string subtitle(const trace::Study& study) {
  std::set<double> parameters;
  for (const trace::StudySeries& series : study.series) {
    for (const trace::StudyPoint& point : series.points) parameters.insert(point.parameter);
  }
  // Panels are headed by what they are of, so the error is named here.
  std::string line = trace::has_panels(study) ? "Up: mean " + study.error + ". " : std::string();
  line += "Along a line: ";
  bool first = true;
  for (const double parameter : parameters) {
    line += (first ? "" : ", ") + spell_number(parameter);
    first = false;
  }
  line += " " + study.parameter;
  if (trace::has_panels(study))
    return line + ". Strong: at half or more nothing in the panel as fast is as close.";
  return line + ". Strong: at half of these or more, nothing else is both as fast and as close.";
}

bool has_worst(const trace::Study& study) {
  return std::ranges::any_of(study.series, [](const trace::StudySeries& series) {
    return std::ranges::any_of(series.points, [](const trace::StudyPoint& point) {
      return point.error_worst.has_value();
    });
  });
}

}  // namespace

Drawing plot(const trace::Study& study, int width, int height) {
  const Layout layout = make_layout(width, height, false, {});
  Drawing drawing;
  drawing.width = width;
  drawing.height = height;
  draw_captions(study.title, "Against " + study.reference, spell_context(study.context, true),
                layout, drawing);

  const double left = layout.legend.x;
  const double inner = layout.legend.width;
  double top = left + layout.px(kTitle + 4);
  Pen(drawing, layout.scale, kSubtitle)
      .text(subtitle(study),
            {static_cast<float>(left), static_cast<float>(top) + 0.8f * layout.px(kSubtitle)},
            Align::Left, kQuietText);
  top += layout.px(kSubtitle + 12);
  const double bottom = height - left - layout.px(kCaption + 6);

  if (trace::has_panels(study)) {
    const std::vector<PlotPanel> panels = panels_of(study);
    const std::size_t rows = panels.size() > 2 ? 2 : 1;
    const std::size_t columns = (panels.size() + rows - 1) / rows;
    const double gutter = layout.px(kGutter);
    const double across = (inner + gutter) / static_cast<double>(columns);
    const double down = (bottom - top + 0.5 * gutter) / static_cast<double>(rows);
    for (std::size_t i = 0; i < panels.size(); ++i) {
      const Rect rect{left + across * static_cast<double>(i % columns),
                      top + down * static_cast<double>(i / columns), across - gutter,
                      down - 0.5 * gutter};
      draw_plot_panel(study, ErrorKind::Mean, rect, layout.scale, drawing, panels[i].name);
    }
    return drawing;
  }
  if (!has_worst(study)) {
    draw_plot_panel(study, ErrorKind::Mean, {left, top, inner, bottom - top}, layout.scale,
                    drawing);
    return drawing;
  }
  const double down = bottom - top;
  const double gutter = layout.px(kGutter);
  const bool is_tall = height > width;
  const double panel_width = is_tall ? inner : 0.5 * (inner - gutter);
  const double panel_height = is_tall ? 0.5 * (down - gutter) : down;
  draw_plot_panel(study, ErrorKind::Mean, {left, top, panel_width, panel_height}, layout.scale,
                  drawing);
  draw_plot_panel(
      study, ErrorKind::Worst,
      {left + inner - panel_width, top + down - panel_height, panel_width, panel_height},
      layout.scale, drawing);
  return drawing;
}

}  // namespace contactscope::draw
