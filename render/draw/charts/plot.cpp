#include "draw/charts/plot.h"

#include "draw/scene/pairs.h"

namespace contactscope::draw {
namespace {

// Pixels at 720 lines.
constexpr double kHeading = 22;
constexpr double kUnder = 42;  // labels and the name of the axis
constexpr double kBetween = 18;
constexpr double kGutter = 22;  // between work precision diagrams
constexpr double kTitle = 28, kSubtitle = 15, kLegend = 24, kCaption = 20;

/// Powers of ten on an axis, in pixels, with as many labels as there is room for. If there are
/// fewer than three, also 2 and 5 times each.
std::vector<std::pair<float, std::string>> decades_of(const Axis& axis, float room) {
  std::vector<Axis::Tick> ticks = axis.ticks(1e9f);  // decades only: none is that long
  if (ticks.size() < 3) {
    ticks = axis.ticks();
    std::erase_if(ticks, [](const Axis::Tick& tick) { return !tick.labelled; });
    return mapped(ticks, [](const Axis::Tick& tick) {
      const double decade = std::pow(10.0, std::floor(std::log10(tick.value) + 1e-9));
      const std::string factor = tick.decade ? "" : printed("%.0f × ", tick.value / decade);
      const bool is_plain = tick.value > 0.9e-3 && tick.value < 1e4;
      return std::pair(tick.at, is_plain ? spell_tick_error(tick.value, "")
                                         : factor + spell_tick_error(decade, ""));
    });
  }
  int every = 1;
  if (ticks.size() > 1) {
    const float decade = std::abs(ticks[1].at - ticks[0].at);
    while (every < 7 && static_cast<float>(every) * decade < room) ++every;
    if (every == 7) every = 8;
  }
  return mapped(ticks, [&](const Axis::Tick& tick) {
    const bool labelled = std::lround(std::log10(tick.value)) % every == 0;
    return std::pair(tick.at, labelled ? spell_tick_error(tick.value, "") : "");
  });
}

/// Round numbers on a linear axis, with at least `room` pixels per label.
std::vector<std::pair<float, std::string>> counts_of(const Axis& axis, float room) {
  const double pixel = (axis.high - axis.low) / std::max(1.0f, std::abs(axis.to - axis.from));
  return mapped(axis.multiples_of(std::max(1.0, round_up(room * pixel))),
                [&](double value) { return std::pair(axis.at(value), spell_number(value)); });
}

/// "CPU · compiler · build · date", optionally with the scalar.
std::string spell_context(const trace::StudyContext& context, bool with_scalar) {
  std::vector<std::string> parts = {context.cpu, context.compiler, context.build_type,
                                    with_scalar ? context.scalar : "", context.date.substr(0, 10)};
  std::erase(parts, "");
  return separated(parts, " · ");
}

std::string subtitle(const trace::Study& study) {
  if (!study.shown.empty()) return study.shown;
  std::set<double> parameters;
  for (const trace::StudyPoint& point : points_of(study)) parameters.insert(point.parameter);
  const auto spell = [](double parameter) { return spell_number(parameter); };
  const std::string along = "Along a line: " + separated(parameters, ", ", spell) + " " +
                            study.parameter + ". Strong: at half ";
  if (!trace::has_panels(study))
    return along + "of these or more, nothing else is both as fast and as close.";
  // Panels have their own headings, so the error is named here.
  return "Up: mean " + study.error + ". " + along +
         "or more nothing in the panel as fast is as close.";
}

/// Factor of text, lines and markers if few diagrams share the page, as on a slide.
float enlarged(const trace::Study& study) {
  constexpr std::size_t kMaxLines = 10;
  if (study.form == trace::StudyForm::WorkPrecision) {
    const auto has_worst = [](const trace::StudyPoint& p) { return p.error_worst.has_value(); };
    const bool has_two =
        !trace::has_panels(study) && std::ranges::any_of(points_of(study), has_worst);
    if (has_two || study.series.size() > kMaxLines) return 1;
  }
  const std::size_t panels = panels_of(study).size();
  return panels <= 1 ? 1.3f : panels <= 3 ? 1.15f : 1;
}

}  // namespace

void draw_decades_along(const Axis& axis, const Rect& area, bool grid, const Pen& pen,
                        const std::vector<double>& values) {
  const auto top = static_cast<float>(area.y), bottom = static_cast<float>(area.bottom());
  const float room = pen.px(44);
  std::vector<std::pair<float, std::string>> ticks =
      axis.is_logarithmic ? decades_of(axis, room) : counts_of(axis, room);
  if (!values.empty())
    ticks = mapped(values, [&](double value) {
      return std::pair(axis.at(value), spell_tick_error(value, ""));
    });
  for (const auto& [at, label] : ticks) {
    if (grid) pen.line({at, top}, {at, bottom}, 1, kChartGrid);
    pen.line({at, bottom}, {at, bottom + pen.px(label.empty() ? 3 : 5)}, 1.2, kChartBorder);
    if (!label.empty()) pen.text(label, {at, bottom + pen.px(19)}, Align::Center, kQuietText);
  }
}

void draw_decades_up(const Axis& axis, const Rect& area, bool grid, bool labels, const Pen& pen) {
  const auto left = static_cast<float>(area.x), right = static_cast<float>(area.right());
  for (const auto& [at, label] : decades_of(axis, pen.px(22))) {
    if (grid && !label.empty()) pen.line({left, at}, {right, at}, 1, kChartGrid);
    pen.line({left - pen.px(label.empty() ? 3 : 5), at}, {left, at}, 1.2, kChartBorder);
    if (label.empty() || !labels) continue;
    pen.text(label, {left - pen.px(8), at + pen.px(5)}, Align::Right, kQuietText);
  }
}

void draw_linear_up(const Axis& axis, const Rect& area, double factor, const std::string& unit,
                    bool labels, const Pen& pen) {
  const auto left = static_cast<float>(area.x), right = static_cast<float>(area.right());
  const double step = round_up((axis.high - axis.low) / 6);
  // If the axis does not begin at zero, use as many digits as distinguish neighbouring ticks.
  const double largest = std::max(axis.high, -axis.low);
  const int digits = std::max(4, static_cast<int>(std::ceil(std::log10(largest / step))) + 1);
  for (const double value : axis.multiples_of(step)) {
    const float at = axis.at(value);
    const bool is_zero = value == 0 && axis.low < 0;
    if (value > axis.low)
      pen.line({left, at}, {right, at}, is_zero ? 1.4 : 1, is_zero ? kChartBorder : kChartGrid);
    pen.line({left - pen.px(5), at}, {left, at}, 1.2, kChartBorder);
    if (labels)
      pen.text(spell_number(factor * value, digits) + unit, {left - pen.px(8), at + pen.px(5)},
               Align::Right, kQuietText);
  }
}

void PositiveRange::include(double value) {
  if (!(value > 0)) return;
  low = std::min(low, value);
  high = std::max(high, value);
}

Axis PositiveRange::axis(float from, float to, float before, float after) const {
  return high > 0 ? Axis::logarithmic(low, high, from, to, before, after)
                  : Axis::logarithmic(1, 1, from, to, before, after);
}

double largest_error(const trace::StudyPoint& point) {
  return point.error_worst.value_or(point.error.value_or(0));
}

std::string spell_failures(const trace::StudySeries& series) {
  int failed = 0, of = 0;
  for (const trace::StudyPoint& point : series.points) {
    failed += point.failed;
    of += point.of;
  }
  return spell_count(failed) + " of " + spell_count(of);
}

PlotPage plot_page(const trace::Study& study, const std::string& shown, bool has_legend, int width,
                   int height) {
  const Layout layout = make_layout(width, height, false, {});
  const bool is_small = study.form != trace::StudyForm::WorkPrecision;  // small multiples
  const float larger = enlarged(study);
  PlotPage page{{.width = width, .height = height}, larger * layout.scale, {}, {}};
  const std::string against = study.reference.empty() ? "" : "Against " + study.reference;
  draw_captions(study.title, against, spell_context(study.context, !is_small), layout,
                page.drawing);
  const double left = layout.legend.x;
  const FittedTitle title =
      fit_title(study.title, static_cast<float>(layout.legend.width), layout.scale);
  const double title_rows = title.lines.size() > 1 ? 2.3 * title.size : kTitle;
  const double top = left + layout.px(title_rows + 4);
  const Pen pen(page.drawing, page.scale, is_small ? kPlotText : kSubtitle);
  const float baseline = is_small ? pen.px(12) : 0.8f * pen.px(kSubtitle);
  pen.text(shown, {static_cast<float>(left), static_cast<float>(top) + baseline}, Align::Left,
           kQuietText);
  const double legend = top + pen.px(16 + 0.5 * kLegend);
  page.legend = pixel(left, legend);
  const double begin =
      has_legend ? legend + pen.px(0.5 * kLegend + 4) : top + pen.px(kSubtitle + 12);
  page.panels = {left, begin, layout.legend.width, height - left - layout.px(kCaption) - begin};
  return page;
}

std::vector<PlotPanel> panels_of(const trace::Study& study) {
  std::vector<PlotPanel> panels;
  for (const trace::StudySeries& series : study.series) {
    auto panel = std::ranges::find(panels, series.panel, &PlotPanel::name);
    if (panel == panels.end()) {
      const std::string& parameter = series.parameter.empty() ? study.parameter : series.parameter;
      panel = panels.insert(panels.end(), PlotPanel{series.panel, parameter, {}});
    }
    panel->series.push_back(&series);
  }
  return panels;
}

std::vector<PlotPanel> panels_on(const PlotPage& page, const trace::Study& study, double left) {
  std::vector<PlotPanel> panels = panels_of(study);
  const std::size_t rows = panels.size() > 3 ? 2 : 1;
  const std::size_t columns = (panels.size() + rows - 1) / rows;
  const double scale = page.scale, label = scale * left;
  const Rect space{page.panels.x + label, page.panels.y, page.panels.width - label,
                   page.panels.height};
  for (std::size_t i = 0; i < panels.size(); ++i) {
    Rect& area = panels[i].area = space.cell(i, columns, rows, scale * kBetween, 0);
    area.y += scale * kHeading;
    area.height -= scale * (kHeading + kUnder);
    panels[i].begins_row = i % columns == 0;
  }
  return panels;
}

Drawing plot(const trace::Study& measured, int width, int height) {
  trace::Study study = measured;  // with readable names of options: "sweep and prune"
  for (trace::StudySeries& series : study.series) series.method = in_words(series.method);
  study.signal = in_words(study.signal);
  if (study.form == trace::StudyForm::Curves) return plot_curves(study, width, height);
  if (study.form == trace::StudyForm::Bars) return plot_bars(study, width, height);
  if (study.form == trace::StudyForm::Map) return plot_map(study, width, height);
  if (trace::has_cells(study.form)) return plot_answers(study, width, height);

  const bool in_panels = trace::has_panels(study);
  std::vector<std::pair<ErrorKind, std::string>> parts;  // error kind and panel
  if (in_panels) {
    for (const PlotPanel& panel : panels_of(study)) parts.emplace_back(ErrorKind::Mean, panel.name);
  } else {
    parts.emplace_back(ErrorKind::Mean, "");
    const auto has_worst = [](const trace::StudyPoint& p) { return p.error_worst.has_value(); };
    if (std::ranges::any_of(points_of(study), has_worst)) parts.emplace_back(ErrorKind::Worst, "");
  }
  std::size_t rows = height > width ? parts.size() : 1;
  if (in_panels) rows = parts.size() > 2 ? 2 : 1;
  const std::size_t columns = (parts.size() + rows - 1) / rows;

  PlotPage page = plot_page(study, subtitle(study), false, width, height);
  const double gutter = page.scale * static_cast<float>(kGutter);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Rect rect = page.panels.cell(i, columns, rows, gutter, in_panels ? 0.5 * gutter : gutter);
    draw_plot_panel(study, parts[i].first, rect, page, parts[i].second);
  }
  return page.drawing;
}

}  // namespace contactscope::draw
