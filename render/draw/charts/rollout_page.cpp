#include "draw/charts/rollout_page.h"

#include "draw/charts/plot.h"
#include "draw/scene/layout.h"
#include "draw/scene/palette.h"

namespace contactscope::draw {
namespace {

// Pixels at 720 lines.
constexpr double kCaptions = 30;  // heading, and source below
constexpr double kScene = 26;     // the line under the heading
constexpr double kChartGap = 22, kCellGap = 12;
constexpr double kCellName = 40;   // name and note below a cell
constexpr double kCellRow = 222;   // a row of cells with their names, if there is only one
constexpr double kCellRows = 172;  // each of several rows
constexpr double kLargeRow = 280;  // below a single chart
constexpr double kPairRow = 410;   // of two cells below a single chart
constexpr float kLarger = 1.2f;    // factor of text and lines on a page with one row and one chart
constexpr int kPage = 720;         // height of a page with up to two rows of cells
constexpr std::size_t kMaxInRow = 5;

/// Cells per row, equal in all rows except the last.
std::size_t columns_of(std::size_t cells) {
  const std::size_t rows = (cells + kMaxInRow - 1) / kMaxInRow;
  return rows == 0 ? 1 : (cells + rows - 1) / rows;
}

std::size_t rows_of(std::size_t cells) {
  return (cells + columns_of(cells) - 1) / columns_of(cells);
}

}  // namespace

trace::StudySeries line_over_time(const std::string& name, const std::vector<double>& time,
                                  const std::vector<double>& values) {
  trace::StudySeries line{name, {}};
  for (std::size_t i = 0; i < time.size(); ++i) {
    trace::StudyPoint& point = line.points.emplace_back();
    point.parameter = time[i];
    point.error = values[i];
  }
  return line;
}

int rollout_page_height(std::size_t cells) {
  const std::size_t rows = std::max<std::size_t>(2, rows_of(cells));
  return kPage + static_cast<int>(rows - 2) * static_cast<int>(kCellRows);
}

RolloutPage rollout_page(const std::string& result, const std::string& title,
                         const std::string& source, const std::string& moment,
                         const std::vector<trace::Study>& charts,
                         const std::vector<RolloutCell>& cells, int width, int height) {
  // Text size follows the usual aspect ratio, even if the page is higher for more rows.
  Layout layout = make_layout(width, height, false, {});
  layout.scale = std::min(layout.scale, interface_scale(width, width * 9 / 16));
  RolloutPage page{{.width = width, .height = height}, {}};
  draw_captions(result, source, moment, layout, page.drawing);
  const Pen pen(page.drawing, layout.scale, kPlotText);
  const double left = layout.legend.x, whole = layout.legend.width;
  const double top = left + pen.px(kCaptions);
  pen.text(fitted(title, pen.px(16), Weight::Regular, static_cast<float>(whole)),
           pixel(left, top + pen.px(15)), Align::Left, kQuietText, Weight::Regular, 16);
  const double begin = top + pen.px(kScene), end = height - left - pen.px(kCaptions);
  const auto rows = static_cast<double>(std::max<std::size_t>(1, rows_of(cells.size())));
  const bool is_large = charts.size() <= 1 && rows_of(cells.size()) <= 1;
  double cell_row = kCellRow;
  if (charts.empty())
    cell_row = (end - begin) / rows / pen.px(1);  // all the room
  else if (rows > 1)
    cell_row = kCellRows;
  else if (is_large)
    cell_row = cells.size() > 2 ? kLargeRow : kPairRow;
  const Pen writing(page.drawing, (is_large ? kLarger : 1) * layout.scale, kPlotText);
  const double cells_begin = end - rows * pen.px(cell_row);
  const auto count = static_cast<double>(charts.size());
  const double chart_width = (whole - (count - 1) * pen.px(kChartGap)) / count;
  for (std::size_t i = 0; i < charts.size(); ++i)
    draw_over_time(charts[i],
                   {left + static_cast<double>(i) * (chart_width + pen.px(kChartGap)), begin,
                    chart_width, cells_begin - pen.px(kCellGap) - begin},
                   writing);
  const std::size_t columns = columns_of(cells.size());
  const double cell_width = std::min(
      (whole - static_cast<double>(columns - 1) * pen.px(kCellGap)) / static_cast<double>(columns),
      1.6 * pen.px(cell_row));
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto column = static_cast<double>(i % columns), row = static_cast<double>(i / columns);
    const Rect cell{std::round(left + column * (cell_width + pen.px(kCellGap))),
                    std::round(cells_begin + row * pen.px(cell_row)), std::floor(cell_width),
                    std::floor(pen.px(cell_row - kCellName))};
    page.cells.push_back(cell);
    const auto x = static_cast<float>(cell.x), y = static_cast<float>(cell.bottom());
    const float room = static_cast<float>(cell.width);
    const Color color = cells[i].quiet ? kText : method_style(cells[i].style).text;
    writing.text(cells[i].name, {x, y + writing.px(17)}, Align::Left, color, Weight::Bold);
    const float used = writing.width_of(cells[i].name + "  ", Weight::Bold);
    writing.text(fitted(cells[i].note, writing.px(kPlotText), Weight::Regular, room - used),
                 {x + used, y + writing.px(17)}, Align::Left, kText);
  }
  return page;
}

}  // namespace contactscope::draw
