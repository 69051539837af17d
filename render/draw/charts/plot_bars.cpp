#include "draw/charts/plot.h"
#include "draw/scene/palette.h"

namespace contactscope::draw {
namespace {

// Pixels at 720 lines.
constexpr double kBarText = 17;
constexpr double kOverBars = 44;  // heading, or the goal's words
constexpr double kMaxRow = 135;
constexpr double kBetweenPanels = 30;
constexpr double kBarShare = 0.6;  // of a row
constexpr double kVolumeRoom = 144;

/// A bounding volume, seen along an axis: `sides` lines at equal angles, the first one turned.
struct Volume {
  std::string_view name;  // with which the name of its method begins
  int sides;
  double turned;  // radians
};
constexpr double kLean = 0.5;  // of the bounded triangles
constexpr Volume kVolumes[] = {{"AABB", 4, 0}, {"OBB", 4, kLean}, {"18-DOP", 8, 0}};

const Volume* volume_of(const std::string& method) {
  const auto found = std::ranges::find_if(
      kVolumes, [&](const Volume& volume) { return method.starts_with(volume.name); });
  return found == std::end(kVolumes) ? nullptr : found;
}

/// A strip of triangles in its volume.
void draw_volume(const Volume& volume, const Point2& middle, const Color& color, const Pen& pen) {
  const auto placed = [&](const Eigen::Vector2d& p) {
    return Point2{middle.x + pen.px(p.x()), middle.y + pen.px(p.y())};
  };
  std::vector<Eigen::Vector2d> strip;
  for (int i = 0; i < 7; ++i)
    strip.push_back(Eigen::Rotation2Dd(kLean) *
                    Eigen::Vector2d(18.0 * i - 54, i % 2 == 0 ? -11 : 11));
  for (std::size_t i = 1; i < strip.size(); ++i) {
    pen.line(placed(strip[i - 1]), placed(strip[i]), 1.2, kShapeEdge);
    if (i > 1) pen.line(placed(strip[i - 2]), placed(strip[i]), 1.2, kShapeEdge);
  }
  const auto corner = [&](int side) {  // where this side meets the next one
    Eigen::Matrix2d normals;
    Eigen::Vector2d offsets;
    for (int k = 0; k < 2; ++k) {
      const double angle = volume.turned + 2 * std::numbers::pi * (side + k) / volume.sides;
      normals.row(k) << std::cos(angle), std::sin(angle);
      offsets[k] = -std::numeric_limits<double>::infinity();
      for (const Eigen::Vector2d& p : strip)
        offsets[k] = std::max(offsets[k], normals.row(k).dot(p));
    }
    return placed(normals.inverse() * offsets);
  };
  for (int side = 0; side < volume.sides; ++side)
    pen.line(corner(side), corner(side + 1), 2, color);
}

void draw_bars(const PlotPanel& panel, const std::string& goal, double row, const Pen& pen) {
  const Rect& area = panel.area;
  const auto left = static_cast<float>(area.x), top = static_cast<float>(area.y),
             bottom = static_cast<float>(area.bottom());
  double most = 0, room = 0;
  for (const trace::StudySeries* bar : panel.series) {
    const trace::StudyPoint& point = bar->points.front();
    most = std::max(most, point.error.value_or(0));
    if (bar->method != goal)
      room = std::max(room, double{pen.width_of(point.mark, Weight::Bold)} + pen.px(16));
  }
  pen.text(panel.name, {left, top - pen.px(14)}, Align::Left, kText);
  pen.line({left, top}, {left, bottom}, 1.4, kChartBorder);
  double y = area.y;
  for (std::size_t i = 0; i < panel.series.size(); ++i) {
    const trace::StudyPoint& point = panel.series[i]->points.front();
    const double length = (area.width - room) * point.error.value_or(0) / (most > 0 ? most : 1);
    const float end = left + static_cast<float>(length);
    if (panel.series[i]->method == goal) {
      pen.line({end, top - pen.px(8)}, {end, bottom}, 2.2, kText, 7);
      pen.text(point.mark, {end + pen.px(6), top - pen.px(12)}, Align::Left, kText, Weight::Bold);
      continue;
    }
    const int look_index = panel.series[i]->look.value_or(static_cast<int>(i));
    const MethodStyle look = method_style(static_cast<std::size_t>(look_index));
    const float middle = static_cast<float>(y + 0.5 * row), words = middle + pen.px(6);
    pen.fill(Rect{area.x, y + 0.5 * (1 - kBarShare) * row, length, kBarShare * row}, look.color);
    if (!point.error) pen.cross({left + pen.px(12), middle}, 8, 3, look.color);
    pen.text(point.mark, {end + pen.px(point.error ? 8 : 30), words}, Align::Left, look.text,
             Weight::Bold);
    const std::string& method = panel.series[i]->method;
    if (panel.begins_row) {
      pen.text(method, {left - pen.px(12), words}, Align::Right, look.text, Weight::Bold);
      if (const Volume* const volume = volume_of(method))
        draw_volume(
            *volume,
            {left - pen.px(12 + 0.55 * kVolumeRoom) - pen.width_of(method, Weight::Bold), middle},
            look.color, pen);
    }
    y += row;
  }
}

}  // namespace

Drawing plot_bars(const trace::Study& study, int width, int height) {
  PlotPage page = plot_page(study, study.shown, false, width, height);
  const Pen pen(page.drawing, page.scale, kBarText);
  std::vector<PlotPanel> panels = panels_of(study);
  double names = 0, rows = 0;
  for (const trace::StudySeries* bar : panels.front().series) {
    if (bar->method == study.signal) continue;
    names = std::max(names, double{pen.width_of(bar->method, Weight::Bold)} + pen.px(12) +
                                (volume_of(bar->method) != nullptr ? pen.px(kVolumeRoom) : 0));
    ++rows;
  }
  const double room = page.panels.height - pen.px(kOverBars);
  const double row = std::min(room / std::max(rows, 1.0), double{pen.px(kMaxRow)});
  const Rect all{page.panels.x + names,
                 page.panels.y + pen.px(kOverBars) + 0.4 * (room - rows * row),
                 page.panels.width - names, rows * row};
  for (std::size_t i = 0; i < panels.size(); ++i) {
    panels[i].area = all.cell(i, panels.size(), 1, pen.px(kBetweenPanels), 0);
    panels[i].begins_row = i == 0;
    draw_bars(panels[i], study.signal, row, pen);
  }
  return page.drawing;
}

}  // namespace contactscope::draw
