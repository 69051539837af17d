#include "draw/insets/stability_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "draw/charts/id_strip.h"
#include "draw/charts/pair_history.h"
#include "draw/scene/layout.h"
#include "draw/scene/pair_points.h"
#include "draw/scene/palette.h"
#include "draw/scene/quantity.h"
#include "draw/scene/sketch.h"

namespace contactscope::draw {
namespace {

// Pixels at 720 lines.
constexpr double kWordsLine = 19;
constexpr double kMapReserve = 15;  // around what a map shows
constexpr double kLeastStabilityMap = 70;
constexpr double kLeastMarginChart = 58;
constexpr double kMostMarginChart = 120;
constexpr double kVerdictRow = 17;
constexpr double kTimeRow = 20;
constexpr double kNameSwatch = 30;
constexpr double kMapDot = 5.2;
constexpr double kMapSquare = 4.6;
constexpr double kMapCenter = 7.5;
constexpr std::size_t kMostMaps = 3;

struct VerdictRow {
  const char* verdict;
  const char* name;
};
constexpr std::array<VerdictRow, 3> kVerdictRows{
    {{"stable", "stable"}, {"turns about a line", "line"}, {"turns about a point", "point"}}};

bool in_contact(const trace::Pair& pair) {
  return pair.stability && pair.stability->verdict != "no contact" && !pair.manifolds.empty();
}

Point2 nearest_on(const Point2& from, const Point2& to, const Point2& p) {
  const Point2 way = to - from;
  const float squared = dot(way, way);
  if (!(squared > 0)) return from;
  return from + std::clamp(dot(p - from, way) / squared, 0.0f, 1.0f) * way;
}

/// From the projection to the nearest place of the border.
void draw_margin(const Point2& from, const std::vector<Point2>& border, const Pen& pen) {
  Point2 nearest = from;
  float least = std::numeric_limits<float>::max();
  for (std::size_t i = 0; i < border.size(); ++i) {
    const Point2 place = nearest_on(border[i], border[(i + 1) % border.size()], from);
    if (distance(place, from) >= least) continue;
    least = distance(place, from);
    nearest = place;
  }
  if (border.empty() || least <= pen.px(14)) return;
  pen.path({from, nearest}, 2.2, kAxis);
  const Point2 back = pen.px(8) / least * (from - nearest);
  const Point2 aside = 0.45f * perpendicular(back);
  pen.fill({nearest, nearest + back + aside, nearest + back - aside}, kAxis);
}

}  // namespace

StabilityPlot::StabilityPlot(const std::vector<trace::Frame>& frames) {
  if (frames.empty()) return;
  duration_ = frames.back().time;
  has_ages_ = std::ranges::any_of(frames, [](const trace::Frame& frame) {
    return std::ranges::any_of(
        frame.pairs, [](const trace::Pair& pair) { return pair.incremental.has_value(); });
  });
  std::vector<const trace::Pair*> pairs =
      distinct_pairs(frames, [](const trace::Pair& pair) { return pair.stability.has_value(); });
  if (pairs.size() > kMostMaps) pairs.resize(kMostMaps);
  for (const trace::Pair* wanted : pairs) {
    History& history = histories_.emplace_back();
    history.name = pair_name(*wanted);
    history.pairs = pair_history(frames, *wanted);
    std::vector<double>& margins = margins_.curves.emplace_back();
    for (const trace::Pair*& pair : history.pairs) {
      if (pair != nullptr && !in_contact(*pair)) pair = nullptr;
      margins.push_back(pair == nullptr ? std::numeric_limits<double>::quiet_NaN()
                                        : pair->stability->margin);
      if (pair == nullptr) continue;
      std::vector<Vec3d>& points = history.points;
      points.insert(points.end(), pair->stability->support.begin(), pair->stability->support.end());
      points.push_back(pair->stability->projection);
      for (const PairPoint& any : all_points(*pair)) points.push_back(any.point->position);
    }
  }
  margins_.baseline = true;
  margins_.fit();
}

void StabilityPlot::draw(std::size_t moment, const Camera& camera, const Rect& rect,
                         const Pen& pen) const {
  if (histories_.empty()) {
    pen.text("no stability in this sequence", pixel(rect.x, rect.y + 0.8 * pen.px(kWordsLine)),
             Align::Left, kQuietText);
    return;
  }
  const double words = pen.px(kWordsLine) * (histories_.size() > 1 ? 3 : 2) + pen.px(8);
  double chart =
      std::clamp<double>(0.26 * rect.height, pen.px(kLeastMarginChart), pen.px(kMostMarginChart));
  double band =
      pen.px(kVerdictRow) * static_cast<double>(kVerdictRows.size()) + pen.px(kTimeRow + 6);
  // The map says most; over time comes next, and the verdicts' rows last.
  const auto map_height = [&] { return rect.height - words - chart - band; };
  if (histories_[0].pairs.size() < 2) chart = band = 0;
  if (map_height() < pen.px(kLeastStabilityMap)) band = 0;
  if (map_height() < pen.px(kLeastStabilityMap)) chart = 0;
  const double map = map_height();
  if (map > pen.px(0.5 * kLeastStabilityMap)) draw_maps(moment, camera, rect, map, pen);
  double y = rect.y + words + std::max(0.0, map);
  if (chart > 0) draw_series_chart(margins_, moment, {rect.x, y, rect.width, chart}, pen);
  y += chart + pen.px(6);
  if (band > 0) draw_verdicts(moment, {rect.x, y, rect.width, band}, pen);
}

// One scale for all pairs and frames; each pair has a middle of its own.
void StabilityPlot::draw_maps(std::size_t moment, const Camera& camera, const Rect& rect,
                              double height, const Pen& pen) const {
  const bool named = histories_.size() > 1;
  const double above = named ? pen.px(kWordsLine) : 0;
  const double column = rect.width / static_cast<double>(histories_.size());
  const auto cell = [&](std::size_t h) {
    return Rect{rect.x + column * static_cast<double>(h), rect.y + above,
                column - (named ? pen.px(8) : 0), height};
  };
  double scale = std::numeric_limits<double>::max();
  std::vector<PlaneAxes> axes;
  std::vector<PlaneExtent> extents;
  for (std::size_t h = 0; h < histories_.size(); ++h) {
    // The newest normal, or where there was none yet the first one to come.
    const std::vector<const trace::Pair*>& pairs = histories_[h].pairs;
    const auto now = pairs.begin() + static_cast<std::ptrdiff_t>(moment) + 1;
    const auto touches = [](const trace::Pair* pair) { return pair != nullptr; };
    const auto newest = std::find_if(std::make_reverse_iterator(now), pairs.rend(), touches);
    const auto next = std::find_if(now, pairs.end(), touches);
    const trace::Pair* pair = newest != pairs.rend() ? *newest
                              : next != pairs.end()  ? *next
                                                     : nullptr;
    axes.push_back(pair == nullptr ? PlaneAxes{}
                                   : axes_as_seen(camera, pair->manifolds.front().normal));
    PlaneExtent& extent = extents.emplace_back();
    for (const Vec3d& point : histories_[h].points) extent.extend(axes[h].along(point));
    if (extent.isEmpty()) continue;
    const double least = 1e-9 * std::max(1.0, extent.center().cwiseAbs().maxCoeff());
    const double reserve = pen.px(2 * kMapReserve);
    const double free_width = std::max<double>(pen.px(10), cell(h).width - reserve);
    const double free_height = std::max<double>(pen.px(10), height - reserve);
    const Vec2d sizes = extent.sizes().cwiseMax(Vec2d::Constant(least));
    scale = std::min({scale, free_width / sizes.x(), free_height / sizes.y()});
  }
  for (std::size_t h = 0; h < histories_.size(); ++h) {
    const Rect map = cell(h);
    const trace::Pair* pair = histories_[h].pairs[moment];
    if (named) {
      const Point2 left = pixel(map.x, rect.y);
      const float swatch = pen.px(kNameSwatch);
      draw_series_swatch(h, {left.x, left.y + 0.5f * pen.px(kWordsLine)}, kNameSwatch - 6, pen);
      pen.text(fitted(histories_[h].name, pen.px(kChartText), Weight::Bold,
                      static_cast<float>(map.width) - swatch),
               left + Point2{swatch, 0.75f * pen.px(kWordsLine)}, Align::Left,
               series_style(h).color, Weight::Bold);
    }
    const ContactPlane plane(axes[h], extents[h].center(), scale, map, pen);
    if (pair != nullptr) draw_map(*pair, plane);
    draw_words(pair, map, pen);
    const bool last = h + 1 == histories_.size();
    if (last && scale <= 1e299) plane.scale_bar(0.25, map.bottom() + pen.px(0.5 * kWordsLine));
  }
}

void StabilityPlot::draw_map(const trace::Pair& pair, const ContactPlane& plane) const {
  const trace::Stability& stability = *pair.stability;
  const std::vector<Point2> support = plane.at(stability.support);
  if (support.size() > 2) plane.fill(support, with_alpha(kClipPolygon, 0.25f));
  if (stability.axis && stability.verdict != "stable")
    plane.line_through((*stability.axis)[0], (*stability.axis)[1], 2.2, kNormal, 7);
  if (support.size() > 1) plane.outline(support, 2.6, kClipPolygon);
  const Point2 projection = plane.at(stability.projection);
  draw_margin(projection, support, plane);
  const auto dot = [&](const trace::Point& point, PointState state) {
    draw_state_dot(state, plane.at(point.position), plane.px(kMapDot), kContact, plane.drawing());
  };
  if (pair.incremental) {
    for (const trace::PersistentPoint& point : pair.incremental->points) {
      const PointState state = point_state(point.state);
      if (state != PointState::Broken) dot(point.point, state);
    }
  } else {
    for (const PairPoint& any : all_points(pair)) {
      if (has_ages_)
        draw_square(plane.at(any.point->position), plane.px(kMapSquare), kContact, plane.drawing());
      else
        dot(*any.point, PointState::New);
    }
  }
  draw_quartered_disc(projection, plane.px(kMapCenter), plane.px(1.4), plane.drawing());
}

void StabilityPlot::draw_words(const trace::Pair* pair, const Rect& rect, const Pen& pen) const {
  const double first = rect.bottom() + 0.75 * pen.px(kWordsLine);
  const auto write = [&](const std::string& what, double baseline, Weight weight) {
    pen.text(fitted(what, pen.px(kChartText), weight, static_cast<float>(rect.width)),
             pixel(rect.x, baseline), Align::Left, kText, weight);
  };
  write(pair == nullptr ? "no contact" : pair->stability->verdict, first, Weight::Bold);
  if (pair == nullptr) return;
  const double margin = pair->stability->margin;
  std::string side = margin < 0 ? " outside" : " inside";
  if (histories_.size() == 1) side += " of the support";
  write(margin == 0 ? "on the border of the support" : spell_margin(std::abs(margin)) + side,
        first + pen.px(kWordsLine), Weight::Regular);
}

// A row a verdict, and in them a stepped line a pair, drawn as in the chart above.
void StabilityPlot::draw_verdicts(std::size_t moment, const Rect& rect, const Pen& pen) const {
  const double gutter = pen.px(kChartGutter), row = pen.px(kVerdictRow);
  const Rect rows{rect.x + gutter, rect.y, rect.width - gutter,
                  row * static_cast<double>(kVerdictRows.size())};
  double top = rows.y;
  for (const VerdictRow& verdict : kVerdictRows) {
    pen.text(verdict.name, pixel(rows.x, top + 0.78 * row) - Point2{pen.px(6), 0}, Align::Right,
             kQuietText);
    pen.fill({rows.x, top + pen.px(1), rows.width, row - pen.px(2)}, with_alpha(kQuietText, 0.10f));
    top += row;
  }
  const std::size_t frames = histories_[0].pairs.size();
  const double column = rows.width / static_cast<double>(frames);
  for (std::size_t h = 0; h < histories_.size(); ++h) {
    const SeriesStyle style = series_style(h);
    // Beside each other where verdicts are the same.
    const double aside =
        pen.px(4.5) * (static_cast<double>(h) - 0.5 * static_cast<double>(histories_.size() - 1));
    std::vector<Point2> corners;
    const auto finish = [&] {
      pen.path(corners, 2.6, style.color, style.dash);
      corners.clear();
    };
    for (std::size_t f = 0; f <= moment && f < frames; ++f) {
      const trace::Pair* pair = histories_[h].pairs[f];
      const auto* known = std::ranges::find_if(kVerdictRows, [&](const VerdictRow& verdict) {
        return pair != nullptr && pair->stability->verdict == verdict.verdict;
      });
      if (known == kVerdictRows.end()) {
        finish();
        continue;
      }
      const auto level = static_cast<double>(known - kVerdictRows.begin());
      const Point2 from = pixel(rows.x + column * static_cast<double>(f),
                                rows.y + pen.px(kVerdictRow) * (level + 0.5) + aside);
      if (corners.size() > 1 && corners.back().y == from.y)
        corners.pop_back();  // goes on
      else
        corners.push_back(from);
      corners.push_back(from + Point2{static_cast<float>(column), 0});
    }
    finish();
  }
  draw_moment(rows, frames, moment, pen);
  draw_time_axis(duration_, rows.x, rows.width, top + 0.82 * pen.px(kTimeRow), pen);
}

}  // namespace contactscope::draw
