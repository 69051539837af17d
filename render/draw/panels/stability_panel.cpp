#include "draw/panels/panel.h"
#include "draw/scene/pairs.h"
#include "draw/scene/points.h"

namespace contactscope::draw {
namespace {

// Pixels at 720 lines.
constexpr double kWordsLine = 19;
constexpr double kMapReserve = 15;  // around a map's contents
constexpr double kMinStabilityMap = 70;
constexpr double kWordsAndMap = 65 + kMinStabilityMap;  // text below the map, name above it
constexpr double kStabilityOverTime = 64, kMinMarginChart = 58, kMaxMarginChart = 120;
constexpr double kVerdictRow = 17, kTimeRow = 20, kNameSwatch = 30, kMapDot = 5.2;
constexpr double kMapSquare = 4.6, kMapCenter = 7.5;
constexpr std::size_t kMaxMaps = 3;

// One row for each, labelled with the last word.
constexpr std::array<std::string_view, 3> kVerdicts{"stable", "turns about a line",
                                                    "turns about a point"};

/// Arrow from the projection to the nearest point of the border.
void draw_margin(const Point2& from, const std::vector<Point2>& border, const Pen& pen) {
  if (border.empty()) return;
  std::vector<Point2> places;
  for (std::size_t i = 0; i < border.size(); ++i)
    places.push_back(Segment2{border[i], border[(i + 1) % border.size()]}.nearest(from));
  const auto reach = [&](const Point2& place) { return distance(place, from); };
  const Point2 nearest = std::ranges::min(places, {}, reach);
  const float least = reach(nearest);
  if (least <= pen.px(14)) return;
  pen.path({from, nearest}, 2.2, kAxis);
  const Point2 back = pen.px(8) / least * (from - nearest);
  const Point2 aside = 0.45f * perpendicular(back);
  pen.fill({nearest, nearest + back + aside, nearest + back - aside}, kAxis);
}

/// Whether the centre of mass projects into the manifold, its margin, and both over time. Shows up
/// to three pairs with recorded stability. Each has a map of the contact plane, seen along the
/// normal and with the camera's right: the points, their hull, which supports the body, the
/// projected centre of mass and its distance from the border. Below are the verdict in words, the
/// margin over time, and a row for each verdict that shows the pairs. All frames and pairs have one
/// scale. Without room for everything, the map has priority.
class StabilityPanel : public PanelContent {
 public:
  StabilityPanel(const Staging& staging, const Frames& frames) : PanelContent(staging, frames) {
    has_ages_ = staging.view.shows(Layer::Persistent) &&
                std::ranges::any_of(frames, [](const trace::Frame& frame) {
                  return first_pair(frame, [](const trace::Pair& pair) {
                           return pair.incremental.has_value();
                         }) != nullptr;
                });
    std::vector<const trace::Pair*> pairs =
        distinct_pairs(frames, [](const trace::Pair& pair) { return pair.stability.has_value(); });
    if (pairs.size() > kMaxMaps) pairs.resize(kMaxMaps);
    for (const trace::Pair* wanted : pairs) {
      History& history = histories_.emplace_back();
      history.name = pair_name(*wanted);
      history.pairs = pair_history(frames, *wanted);
      for (const trace::Pair*& pair : history.pairs)
        if (pair != nullptr && stability_of(*pair) == nullptr) pair = nullptr;
      const auto first =
          std::ranges::find_if(history.pairs, [](auto* pair) { return pair != nullptr; });
      const trace::Pair* newest = first == history.pairs.end() ? nullptr : *first;
      std::vector<double>& margins = margins_.curves.emplace_back();
      for (const trace::Pair* pair : history.pairs) {
        if (pair != nullptr) newest = pair;
        history.seen.push_back(newest);
        margins.push_back(pair == nullptr ? std::numeric_limits<double>::quiet_NaN()
                                          : pair->stability->margin);
        if (pair == nullptr) continue;
        append(history.points, pair->stability->support);
        history.points.push_back(pair->stability->projection);
        append(history.points, positions_of(*pair));
      }
    }
    margins_.baseline = true;
    margins_.fit();
  }

  PanelNeed need(const PanelMoment&) const override {
    const Layout& layout = staging_.layout;
    const float least = Sheet::heading_height(layout.scale) + layout.px(kWordsAndMap);
    return {least, least + layout.px(kStabilityOverTime), 0, 2};
  }

  std::string lay_out(const PanelMoment& moment, Sheet& sheet) override {
    sheet.heading("stability: centre of mass over the contact");
    // Charts have their own text size, which need not be a whole number of pixels.
    const Pen pen(sheet.pen().drawing(), sheet.pen().scale(), kChartText);
    const Rect rect = sheet.rest();
    if (histories_.empty()) {
      pen.text("no stability in this sequence", pixel(rect.x, rect.y + 0.8 * pen.px(kWordsLine)),
               Align::Left, kQuietText);
      return {};
    }
    const double words = pen.px(kWordsLine) * (histories_.size() > 1 ? 3 : 2) + pen.px(8);
    double chart =
        std::clamp<double>(0.26 * rect.height, pen.px(kMinMarginChart), pen.px(kMaxMarginChart));
    double band =
        pen.px(kVerdictRow) * static_cast<double>(kVerdicts.size()) + pen.px(kTimeRow + 6);
    // Priorities: the map, then the chart over time, then the rows of verdicts.
    const auto map_height = [&] { return rect.height - words - chart - band; };
    if (frames_.size() < 2) chart = band = 0;
    if (!staging_.view.shows(Chart::Margin)) chart = 0;
    if (!staging_.view.shows(Chart::Verdict)) band = 0;
    if (map_height() < pen.px(kMinStabilityMap)) band = 0;
    if (map_height() < pen.px(kMinStabilityMap)) chart = 0;
    const double map = map_height();
    if (map > pen.px(0.5 * kMinStabilityMap)) draw_maps(moment.frame, rect, map, pen);
    double y = rect.y + words + std::max(0.0, map);
    if (chart > 0) draw_series_chart(margins_, moment.frame, {rect.x, y, rect.width, chart}, pen);
    y += chart + pen.px(6);
    if (band > 0) draw_verdicts(moment.frame, {rect.x, y, rect.width, band}, pen);
    return {};
  }

 private:
  struct History {
    std::string name;
    std::vector<const trace::Pair*> pairs;  // in every frame; null without contact
    std::vector<const trace::Pair*> seen;   // the latest pair, or the first one before there is any
    std::vector<Vec3d> points;              // everything that must fit in any frame
  };

  // One scale for all pairs and frames; each pair has its own centre.
  void draw_maps(std::size_t moment, const Rect& rect, double height, const Pen& pen) const {
    const bool named = histories_.size() > 1;
    const double above = named ? pen.px(kWordsLine) : 0;
    const double column = rect.width / static_cast<double>(histories_.size());
    const double width = column - (named ? pen.px(8) : 0);
    double scale = std::numeric_limits<double>::max();
    std::vector<ContactPlane> planes;
    for (const History& history : histories_) {
      const trace::Pair* seen = history.seen[moment];
      const PlaneAxes axes = seen == nullptr
                                 ? PlaneAxes{}
                                 : axes_as_seen(staging_.camera, seen->manifolds.front().normal);
      PlaneExtent extent;
      for (const Vec3d& point : history.points) extent.extend(axes.along(point));
      const double x = rect.x + column * static_cast<double>(planes.size());
      planes.emplace_back(axes, extent.center(), 0, Rect{x, rect.y + above, width, height}, pen);
      if (extent.isEmpty()) continue;
      const double least = 1e-9 * std::max(1.0, extent.center().cwiseAbs().maxCoeff());
      const double reserve = pen.px(2 * kMapReserve);
      const Vec2d room = Vec2d(width - reserve, height - reserve).cwiseMax(pen.px(10));
      const Vec2d sizes = extent.sizes().cwiseMax(least);
      scale = std::min(scale, room.cwiseQuotient(sizes).minCoeff());
    }
    for (std::size_t h = 0; h < planes.size(); ++h) {
      ContactPlane& plane = planes[h];
      plane.pixels_per_metre = scale;
      const Rect& map = plane.map;
      if (named) {
        const Point2 left = pixel(map.x, rect.y);
        const float swatch = pen.px(kNameSwatch);
        draw_series_swatch(h, {left.x, left.y + 0.5f * pen.px(kWordsLine)}, kNameSwatch - 6, pen);
        pen.text(pen.fitted(histories_[h].name, Weight::Bold,
                            static_cast<float>(map.width) - swatch, kChartText),
                 left + Point2{swatch, 0.75f * pen.px(kWordsLine)}, Align::Left,
                 series_style(h).color, Weight::Bold);
      }
      const trace::Pair* pair = histories_[h].pairs[moment];
      if (pair != nullptr) draw_map(*pair, plane);
      draw_words(pair, map, pen);
    }
    if (scale <= 1e299) {
      const ContactPlane& last = planes.back();
      last.scale_bar(0.25, last.map.bottom() + pen.px(0.5 * kWordsLine));
    }
  }

  void draw_map(const trace::Pair& pair, const ContactPlane& plane) const {
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
        if (state != PointState::Broken) dot(point.point, has_ages_ ? state : PointState::New);
      }
    } else {
      for (const PairPoint& any : all_points(pair)) {
        if (has_ages_)
          draw_square(plane.at(any.point->position), plane.px(kMapSquare), kContact,
                      plane.drawing());
        else
          dot(*any.point, PointState::New);
      }
    }
    draw_quartered_disc(projection, plane.px(kMapCenter), plane.px(1.4), plane.drawing());
  }

  void draw_words(const trace::Pair* pair, const Rect& map, const Pen& pen) const {
    double baseline = map.bottom() + 0.75 * pen.px(kWordsLine);
    const auto write = [&](const std::string& what, Weight weight) {
      pen.text(pen.fitted(what, weight, static_cast<float>(map.width), kChartText),
               pixel(map.x, baseline), Align::Left, kText, weight);
      baseline += pen.px(kWordsLine);
    };
    write(pair == nullptr                        ? "no contact"
          : pair->stability->verdict == "stable" ? spell_balance(balance_of(*pair->stability))
          : histories_.size() > 1                ? pair->stability->verdict
                                                 : "unstable: " + pair->stability->verdict,
          Weight::Bold);
    if (pair == nullptr) return;
    const double margin = pair->stability->margin;
    std::string side = margin < 0 ? " outside" : " inside";
    if (histories_.size() == 1) side += " of the support";
    write(margin == 0 ? "on the border of the support" : spell_margin(std::abs(margin)) + side,
          Weight::Regular);
  }

  // A row for each verdict, with a stepped line for each pair in the style of the chart above.
  void draw_verdicts(std::size_t moment, const Rect& rect, const Pen& pen) const {
    const double gutter = pen.px(kChartGutter), row = pen.px(kVerdictRow);
    const Rect rows{rect.x + gutter, rect.y, rect.width - gutter,
                    row * static_cast<double>(kVerdicts.size())};
    double top = rows.y;
    for (const std::string_view verdict : kVerdicts) {
      const std::string name(verdict.substr(verdict.rfind(' ') + 1));
      pen.text(name, pixel(rows.x, top + 0.78 * row) - Point2{pen.px(6), 0}, Align::Right,
               kQuietText);
      pen.fill({rows.x, top + pen.px(1), rows.width, row - pen.px(2)},
               with_alpha(kQuietText, 0.10f));
      top += row;
    }
    const double column = rows.width / static_cast<double>(frames_.size());
    for (std::size_t h = 0; h < histories_.size(); ++h) {
      const SeriesStyle style = series_style(h);
      // Offset, so that equal verdicts do not overlap.
      const double aside =
          pen.px(4.5) * (static_cast<double>(h) - 0.5 * static_cast<double>(histories_.size() - 1));
      std::vector<Point2> corners;
      const auto finish = [&] {
        pen.path(corners, 2.6, style.color, style.dash);
        corners.clear();
      };
      for (std::size_t f = 0; f <= moment; ++f) {
        const trace::Pair* pair = histories_[h].pairs[f];
        const auto* known = pair == nullptr
                                ? kVerdicts.end()
                                : std::ranges::find(kVerdicts, pair->stability->verdict);
        if (known == kVerdicts.end()) {
          finish();
          continue;
        }
        const auto level = static_cast<double>(known - kVerdicts.begin());
        const Point2 from = pixel(rows.x + column * static_cast<double>(f),
                                  rows.y + pen.px(kVerdictRow) * (level + 0.5) + aside);
        if (corners.size() > 1 && corners.back().y == from.y)
          corners.pop_back();  // continue the line
        else
          corners.push_back(from);
        corners.push_back(from + Point2{static_cast<float>(column), 0});
      }
      finish();
    }
    draw_moment(rows, frames_.size(), moment, pen);
    draw_time_axis(frames_, rows.x, rows.width, top + 0.82 * pen.px(kTimeRow), pen);
  }

  std::vector<History> histories_;
  SeriesChart margins_{"margin", "m"};
  bool has_ages_ = false;  // the picture shows ages: points without an age look different
};

}  // namespace

const PanelDrawing kStabilityPanel{.needs = {&Stages::stability},
                                   .make = make_panel<StabilityPanel>};

}  // namespace contactscope::draw
