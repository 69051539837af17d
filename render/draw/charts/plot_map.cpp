#include "core/spell.h"
#include "draw/charts/curve_labels.h"
#include "draw/charts/plot.h"
#include "draw/scene/palette.h"

namespace contactscope::draw {
namespace {

constexpr double kLeftNumbers = 56, kLeftNames = 132;
constexpr double kBarCell = 58;  // of the legend's bar

// From white over Okabe-Ito's sky blue and blue to near black: lightness alone shows the order.
constexpr std::array<Color, 8> kDecades = {rgb(0xEAF5FC), rgb(0xC4E3F6), rgb(0x8FCBEE),
                                           rgb(0x56B4E9), rgb(0x1F88C4), rgb(0x005F96),
                                           rgb(0x003F66), rgb(0x001F33)};
constexpr Color kFailure = rgb(0xD55E00);

/// Errors up to 1 are the first decade, up to 10 the second, and so on; the last is open.
std::size_t decade_of(double error) {
  if (!(error > 1)) return 0;
  const double above = std::ceil(std::log10(error));
  return static_cast<std::size_t>(std::clamp(above, 0.0, double(kDecades.size() - 1)));
}

/// A class of the share of failed cases, up to `most`.
struct ShareStep {
  double most;
  const char* name;
  std::size_t shade;  // index into kDecades
};
constexpr std::array<ShareStep, 5> kShares = {{{0, "none", 0},
                                               {0.1, "≤ 10 %", 2},
                                               {0.5, "≤ 50 %", 3},
                                               {0.9999, "< 100 %", 5},
                                               {1, "all", 7}}};

const ShareStep& share_of(const trace::StudyPoint& point) {
  const double share = point.of > 0 ? static_cast<double>(point.failed) / point.of : 0;
  return *std::ranges::find_if(
      kShares, [&](const ShareStep& step) { return share <= step.most || step.most == 1; });
}

/// An axis that extends half a cell beyond the first and the last value.
Axis axis_through(const std::vector<double>& values, double from, double to) {
  const double cell = std::abs(to - from) / static_cast<double>(values.size());
  const auto half = static_cast<float>(0.5 * cell);
  return Axis::logarithmic(values.front(), values.back(), static_cast<float>(from),
                           static_cast<float>(to), half, half);
}

struct Map : Pen {
  const trace::Study& study;
  bool numbered;  // rows are numbers

  bool has_shares() const { return study.unit == trace::kShare; }

  /// Cells with the same mark, by column and series.
  using Marked = std::map<std::pair<std::size_t, std::size_t>, Rect>;

  /// Outlines all of them, with the text in the upper right corner inside, so that it does not name
  /// a neighbouring column. Without room, or if not a rectangle, it is to the right or left.
  void mark(const std::string& words, const Marked& cells, const Rect& area) const {
    Rect all = cells.begin()->second;
    for (const auto& [place, rect] : cells) {
      const double right = std::max(all.right(), rect.right());
      const double bottom = std::max(all.bottom(), rect.bottom());
      all.x = std::min(all.x, rect.x);
      all.y = std::min(all.y, rect.y);
      all.width = right - all.x;
      all.height = bottom - all.y;
    }
    const double height = cells.begin()->second.height;
    const double area_of_cells =
        static_cast<double>(cells.size()) * cells.begin()->second.width * height;
    // A white border keeps the line visible on dark cells. A rectangle's outline has no joints.
    const bool is_rectangle = area_of_cells > 0.999 * all.width * all.height;
    for (const auto& [width, color] : {std::pair{5.0, kWhite}, std::pair{2.6, kText}})
      if (is_rectangle)
        outline(corners_of(all), width, color);
      else
        draw_border(cells, width, color);
    const auto middle = static_cast<float>(all.y + 0.5 * height) + px(0.36 * kMarkLetters);
    const float width = text_width(words, px(kMarkLetters), FontWeight::Bold);
    const bool is_inside =
        is_rectangle && cells.size() > 1 && all.width > width + px(24) && height > px(28);
    const bool fits = all.right() + px(10) + width < area.right();
    // On a white plate, because cells may have any shade.
    const auto begin = static_cast<float>(is_inside ? all.right() - px(12) - width
                                          : fits    ? all.right() + px(8)
                                                    : all.x - px(8) - width);
    const Rect plate{begin - px(4), middle - px(0.36 * kMarkLetters + 10), width + px(8), px(20)};
    fill(plate, kWhite);
    frame(plate, 1, kChartBorder);
    text(words, {begin, middle}, Align::Left, kText, Weight::Bold, kMarkLetters);
  }

  void draw_border(const Marked& cells, double width, const Color& color) const {
    for (const auto& [place, rect] : cells) {
      const auto& [column, row] = place;
      const std::vector<Point2> corners = corners_of(rect);  // from the top left one
      const auto side = [&](std::size_t i, std::size_t c, std::size_t r) {
        if (cells.contains({c, r})) return;
        const Point2 from = corners[i], to = corners[(i + 1) % 4];
        const Point2 end = (0.5f * px(width) / distance(from, to)) * (to - from);
        line(from - end, to + end, width, color);  // extended to close corners and joints
      };
      side(0, column, numbered ? row + 1 : row - 1);
      side(1, column + 1, row);
      side(2, column, numbered ? row - 1 : row + 1);
      side(3, column - 1, row);
    }
  }

  void legend(const Point2& begin) const {
    float at = begin.x;
    const auto name = [&](const std::string& what, float aside) {
      text(what, {at + aside, begin.y + px(5)}, Align::Left, kText);
      at += aside + width_of(what) + px(18);
    };
    const auto box = [&](double width) { return Rect{at, begin.y - px(8), px(width), px(16)}; };
    // One bar of all classes, each with its bound inside.
    const std::vector<std::pair<std::string, std::size_t>> steps = steps_of_bar();
    const auto bar = static_cast<double>(kBarCell);
    const Rect whole{at, begin.y - px(8), px(bar * static_cast<double>(steps.size())), px(16)};
    for (const auto& [bound, shade] : steps) {
      fill(box(bar), contactscope::at(kDecades, shade));
      text(bound, {at + px(0.5 * bar), begin.y + px(5)}, Align::Center, shade > 3 ? kWhite : kText);
      at += px(bar);
    }
    frame(whole, 1.2, kChartBorder);
    if (has_shares()) return;
    at += px(24);
    cross({at + px(10), begin.y}, 5, 1.8, kFailure);
    at += px(22);
    name(study.failed.empty() ? "some cases failed" : "some " + study.failed, 0);
    hatched(box(26));
    frame(box(26), 1.2, kChartBorder);
    name("all " + (study.failed.empty() ? "failed" : study.failed), px(32));
  }

  /// Texts and shades of the legend's bar, the lightest first.
  std::vector<std::pair<std::string, std::size_t>> steps_of_bar() const {
    std::vector<std::pair<std::string, std::size_t>> steps;
    if (has_shares()) {
      for (const ShareStep& step : kShares)
        if (std::ranges::any_of(points_of(study), [&](const trace::StudyPoint& point) {
              return &share_of(point) == &step;
            }))
          steps.emplace_back(step.name, step.shade);
      return steps;
    }
    std::size_t most = 0;
    for (const trace::StudyPoint& point : points_of(study))
      if (point.error) most = std::max(most, decade_of(largest_error(point)));
    for (std::size_t i = 0; i <= most; ++i) {
      const bool open = i + 1 == kDecades.size();
      const double bound = std::pow(10.0, static_cast<double>(open ? i - 1 : i));
      steps.emplace_back((open ? "> " : "≤ ") + spell_tick_error(bound, ""), i);
    }
    return steps;
  }

  /// The columns' parameters to two digits if there is room; otherwise the axis shows decades.
  std::vector<double> ticks_of(const std::vector<double>& parameters, double width) const {
    std::vector<double> ticks =
        mapped(parameters, [](double parameter) { return std::stod(printed("%.2g", parameter)); });
    const bool have_room = std::ranges::all_of(
        ticks, [&](double tick) { return width_of(spell_tick_error(tick, "")) + px(6) < width; });
    return have_room ? ticks : std::vector<double>{};
  }

  void panel(const PlotPanel& panel) const {
    const Rect& area = panel.area;
    const std::vector<double> parameters =
        mapped(panel.series.front()->points, &trace::StudyPoint::parameter);
    if (parameters.empty()) return;
    std::vector<double> rows;
    std::map<std::string, Marked> marked;
    const auto left = static_cast<float>(area.x);
    const Axis x = axis_through(parameters, area.x, area.right());
    const double width = area.width / static_cast<double>(parameters.size());
    const double height = area.height / static_cast<double>(panel.series.size());
    for (std::size_t i = 0; i < panel.series.size(); ++i) {
      const trace::StudySeries& series = *panel.series[i];
      // Numbers increase upwards, names are read downwards.
      const double row = static_cast<double>(numbered ? panel.series.size() - 1 - i : i);
      const double top = area.y + row * height;
      for (std::size_t j = 0; j < series.points.size(); ++j) {
        const trace::StudyPoint& point = series.points[j];
        const Rect rect{x.at(point.parameter) - 0.5 * width, top, width, height};
        cell(point, rect);
        if (!point.mark.empty()) marked[point.mark][{j, i}] = rect;
      }
      if (numbered) {
        rows.push_back(*series.row);
      } else if (panel.begins_row) {
        const auto middle = static_cast<float>(top + 0.5 * height);
        text(series.method, {left - px(8), middle + px(5)}, Align::Right, kText);
      }
    }
    if (numbered)
      draw_decades_up(axis_through(rows, area.bottom(), area.y), area, false, panel.begins_row,
                      *this);
    draw_decades_along(x, area, false, *this, ticks_of(parameters, width));
    frame(area, 1.2, kChartBorder);
    for (const auto& [words, cells] : marked) mark(words, cells, area);
    const float above = static_cast<float>(area.y) - px(6);
    text(panel.name, {left, above}, Align::Left, kText, Weight::Bold);
    text(fitted(panel.parameter, Weight::Regular, static_cast<float>(area.width)),
         {static_cast<float>(area.right()), static_cast<float>(area.bottom()) + px(34)},
         Align::Right, kQuietText);
    if (numbered && !study.row.empty()) {
      const std::string up = "up: " + study.row;
      if (width_of(up) + width_of(panel.name, Weight::Bold) + px(12) < area.width)
        text(up, {static_cast<float>(area.right()), above}, Align::Right, kQuietText);
    }
  }

  /// A cell without a value is hatched, because white would look like the smallest error.
  void hatched(const Rect& rect) const {
    const double right = rect.right(), bottom = rect.bottom();
    hatch({{rect.x, rect.y}, {right, rect.y}, {right, bottom}, {rect.x, bottom}}, {}, 6, 1,
          with_alpha(kDropped, 0.4f));
  }

  void cell(const trace::StudyPoint& point, const Rect& rect) const {
    if (has_shares()) return fill(rect, contactscope::at(kDecades, share_of(point).shade));
    if (point.error) fill(rect, kDecades[decade_of(largest_error(point))]);
    if (point.failed == 0) return;
    if (!point.error) return hatched(rect);
    const double room = 0.32 * std::min(rect.width, rect.height) / px(1);
    cross(pixel(rect.x + 0.5 * rect.width, rect.y + 0.5 * rect.height), std::clamp(room, 2.0, 5.0),
          1.8, kFailure);
  }
};

}  // namespace

Drawing plot_map(const trace::Study& study, int width, int height) {
  PlotPage page = plot_page(study, study.shown.empty() ? "Colour: " + study.error : study.shown,
                            true, width, height);
  const bool numbered =
      std::ranges::all_of(study.series, [](const auto& series) { return series.row.has_value(); });
  const Map map{Pen(page.drawing, page.scale, kPlotText), study, numbered};
  map.legend(page.legend);
  const double left = numbered ? kLeftNumbers : kLeftNames;
  for (const PlotPanel& panel : panels_on(page, study, left)) map.panel(panel);
  return page.drawing;
}

}  // namespace contactscope::draw
