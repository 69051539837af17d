#include "draw/insets/stability_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>

#include "draw/charts/id_strip.h"
#include "draw/charts/series_chart.h"
#include "draw/insets/stability_map.h"
#include "draw/scene/layout.h"
#include "draw/scene/palette.h"
#include "draw/scene/quantity.h"
#include "draw/scene/sequence_scales.h"
#include "image/font.h"

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
constexpr std::size_t kMostMaps = 3;

struct VerdictRow {
  const char* verdict;
  const char* name;
};
constexpr std::array<VerdictRow, 3> kVerdictRows{
    {{"stable", "stable"}, {"turns about a line", "line"}, {"turns about a point", "point"}}};

const trace::Pair* same_pair(const trace::Frame& frame, const trace::Pair& wanted) {
  for (const trace::Pair& pair : frame.pairs) {
    if (pair.a == wanted.a && pair.b == wanted.b && pair.label == wanted.label) return &pair;
  }
  return nullptr;
}

/// The pairs whose stability was recorded in any frame.
std::vector<trace::Pair> pairs_of(const std::vector<trace::Frame>& frames) {
  std::vector<trace::Pair> pairs;
  for (const trace::Frame& frame : frames) {
    for (const trace::Pair& pair : frame.pairs) {
      const bool known = std::ranges::any_of(pairs, [&](const trace::Pair& other) {
        return pair.a == other.a && pair.b == other.b && pair.label == other.label;
      });
      if (pair.stability && !known && pairs.size() < kMostMaps) pairs.push_back(pair);
    }
  }
  return pairs;
}

/// Beside points that have an age, those without are drawn as such.
bool has_ages(const std::vector<trace::Frame>& frames) {
  return std::ranges::any_of(frames, [](const trace::Frame& frame) {
    return std::ranges::any_of(
        frame.pairs, [](const trace::Pair& pair) { return pair.incremental.has_value(); });
  });
}

bool in_contact(const trace::Pair* pair) {
  return pair != nullptr && pair->stability && pair->stability->verdict != "no contact" &&
         !pair->manifolds.empty();
}

class StabilityPainter {
 public:
  StabilityPainter(const std::vector<trace::Frame>& frames, std::size_t moment,
                   const Camera& camera, const Rect& rect, float pixel, Drawing& drawing)
      : frames_(frames),
        moment_(moment),
        camera_(camera),
        rect_(rect),
        pixel_(pixel),
        out_(drawing),
        pairs_(pairs_of(frames)),
        has_ages_(has_ages(frames)) {}

  void run() {
    if (pairs_.empty()) {
      text("no stability in this sequence", rect_.x, rect_.y + 0.8 * px(kWordsLine), kQuietText);
      return;
    }
    const bool named = pairs_.size() > 1;
    const double words = px(kWordsLine) * (named ? 3 : 2) + px(8);
    const double rows =
        px(kVerdictRow) * static_cast<double>(kVerdictRows.size()) + px(kTimeRow + 6);
    double chart = std::clamp(0.26 * rect_.height, px(kLeastMarginChart), px(kMostMarginChart));
    double band = rows;
    // The map says most; over time comes next, and the verdicts' rows last.
    const auto map_height = [&] { return rect_.height - words - chart - band; };
    if (frames_.size() < 2) chart = band = 0;
    if (map_height() < px(kLeastStabilityMap)) band = 0;
    if (map_height() < px(kLeastStabilityMap)) chart = 0;
    const double map = map_height();
    if (map > px(0.5 * kLeastStabilityMap)) draw_maps(map, named);
    double y = rect_.y + words + std::max(0.0, map);
    if (chart > 0) {
      draw_series_chart(margins(), moment_, {rect_.x, y, rect_.width, chart}, pixel_, out_);
    }
    y += chart + px(6);
    if (band > 0) draw_verdicts(y);
  }

 private:
  double px(double at_720) const { return pixel_ * at_720; }

  void text(const std::string& what, double x, double baseline, const Color& color,
            Weight weight = Weight::Regular) {
    chart_text(what, {static_cast<float>(x), static_cast<float>(baseline)}, Align::Left, color,
               pixel_, out_, weight);
  }

  Rect cell(std::size_t pair, double height, bool named) const {
    const double width = rect_.width / static_cast<double>(pairs_.size());
    return {rect_.x + width * static_cast<double>(pair), rect_.y + (named ? px(kWordsLine) : 0),
            width - (named ? px(8) : 0), height};
  }

  // One scale for all pairs and frames; each pair has a middle of its own.
  void draw_maps(double height, bool named) {
    const auto normal_of = [&](const trace::Pair& wanted) -> std::optional<Vec3d> {
      std::optional<Vec3d> normal;
      for (std::size_t f = 0; f < frames_.size(); ++f) {
        const trace::Pair* pair = same_pair(frames_[f], wanted);
        if (in_contact(pair) && (!normal || f <= moment_)) {
          normal = pair->manifolds.front().normal;
        }
      }
      return normal;
    };
    double scale = std::numeric_limits<double>::max();
    std::vector<std::optional<StabilityMap>> maps;
    std::vector<std::array<double, 2>> centers;
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
      maps.emplace_back();
      centers.emplace_back();
      const std::optional<Vec3d> normal = normal_of(pairs_[p]);
      if (!normal) continue;
      const Rect rect = cell(p, height, named);
      maps[p].emplace(*normal, camera_, rect);
      std::array<double, 2> low{1e300, 1e300}, high{-1e300, -1e300};
      for (const trace::Frame& frame : frames_) {
        const trace::Pair* pair = same_pair(frame, pairs_[p]);
        if (!in_contact(pair)) continue;
        for (const Vec3d& point : stability_extent(*pair)) {
          const std::array<double, 2> at = maps[p]->flat(point);
          for (std::size_t k = 0; k < 2; ++k) {
            low[k] = std::min(low[k], at[k]);
            high[k] = std::max(high[k], at[k]);
          }
        }
      }
      centers[p] = {0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])};
      const double least = 1e-9 * std::max({1.0, std::abs(centers[p][0]), std::abs(centers[p][1])});
      const double free_width = std::max(px(10), rect.width - px(2 * kMapReserve));
      const double free_height = std::max(px(10), rect.height - px(2 * kMapReserve));
      scale = std::min({scale, free_width / std::max(least, high[0] - low[0]),
                        free_height / std::max(least, high[1] - low[1])});
    }
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
      const Rect rect = cell(p, height, named);
      const trace::Pair* pair = same_pair(frames_[moment_], pairs_[p]);
      if (named) {
        const std::string& label = pairs_[p].label;
        const std::string name = label.empty() ? pairs_[p].a + ", " + pairs_[p].b : label;
        const auto size = static_cast<float>(px(kChartText));
        draw_name_swatch(p, rect.x);
        text(fitted(name, size, FontWeight::Bold, static_cast<float>(rect.width - px(kNameSwatch))),
             rect.x + px(kNameSwatch), rect_.y + 0.75 * px(kWordsLine), series_style(p).color,
             Weight::Bold);
      }
      if (maps[p] && in_contact(pair)) {
        maps[p]->show(centers[p], scale);
        maps[p]->draw(*pair, !has_ages_, pixel_, out_);
      }
      draw_words(pair, rect);
    }
    draw_scale_bar(scale, cell(pairs_.size() - 1, height, named));
  }

  // How the pair's lines look below.
  void draw_name_swatch(std::size_t p, double x) {
    const SeriesStyle style = series_style(p);
    const auto y = static_cast<float>(rect_.y + 0.5 * px(kWordsLine));
    Stroke swatch{{static_cast<float>(x), y},
                  {static_cast<float>(x + px(kNameSwatch - 6)), y},
                  2.4f * pixel_,
                  style.color};
    swatch.dash = pixel_ * style.dash;
    swatch.gap = 0.6f * swatch.dash;
    out_.primitives.push_back(swatch);
  }

  void draw_words(const trace::Pair* pair, const Rect& rect) {
    const bool touching = in_contact(pair);
    const double first = rect.y + rect.height + 0.75 * px(kWordsLine);
    const auto write = [&](const std::string& what, double baseline, Weight weight) {
      const auto size = static_cast<float>(px(kChartText));
      const FontWeight font = weight == Weight::Bold ? FontWeight::Bold : FontWeight::Regular;
      text(fitted(what, size, font, static_cast<float>(rect.width)), rect.x, baseline, kText,
           weight);
    };
    write(touching ? pair->stability->verdict : "no contact", first, Weight::Bold);
    if (!touching) return;
    const double margin = pair->stability->margin;
    std::string side = margin < 0 ? " outside" : " inside";
    if (pairs_.size() == 1) side += " of the support";
    write(margin == 0 ? "on the border of the support" : spell_margin(std::abs(margin)) + side,
          first + px(kWordsLine), Weight::Regular);
  }

  void draw_scale_bar(double scale, const Rect& rect) {
    if (!std::isfinite(scale) || scale > 1e299) return;
    const double length = round_down(0.25 * rect.width / scale);
    const auto right = static_cast<float>(rect.x + rect.width - px(2));
    const auto left = right - static_cast<float>(length * scale);
    const auto y = static_cast<float>(rect.y + rect.height + px(0.5 * kWordsLine));
    const auto end = static_cast<float>(px(3));
    const auto line = [&](const Point2& from, const Point2& to) {
      out_.primitives.push_back(Stroke{from, to, 1.5f * pixel_, kQuietText});
    };
    line({left, y}, {right, y});
    line({left, y - end}, {left, y + end});
    line({right, y - end}, {right, y + end});
    chart_text(spell_quantity(length, "m", 1),
               {left - static_cast<float>(px(6)), y + static_cast<float>(px(4))}, Align::Right,
               kQuietText, pixel_, out_);
  }

  SeriesChart margins() const {
    SeriesChart chart{"margin", "m", {}, false, true};
    for (const trace::Pair& wanted : pairs_) {
      std::vector<double>& values = chart.curves.emplace_back();
      for (const trace::Frame& frame : frames_) {
        const trace::Pair* pair = same_pair(frame, wanted);
        values.push_back(in_contact(pair) ? pair->stability->margin
                                          : std::numeric_limits<double>::quiet_NaN());
      }
    }
    return chart;
  }

  // A row a verdict, and in them a stepped line a pair, drawn as in the chart above.
  void draw_verdicts(double y) {
    const double left = rect_.x + px(kChartGutter), width = rect_.x + rect_.width - left;
    const double row = px(kVerdictRow);
    for (std::size_t i = 0; i < kVerdictRows.size(); ++i) {
      const double top = y + row * static_cast<double>(i);
      chart_text(kVerdictRows[i].name,
                 {static_cast<float>(left - px(6)), static_cast<float>(top + 0.78 * row)},
                 Align::Right, kQuietText, pixel_, out_);
      const auto x0 = static_cast<float>(left), x1 = static_cast<float>(left + width);
      const auto y0 = static_cast<float>(top + px(1)), y1 = static_cast<float>(top + row - px(1));
      out_.primitives.push_back(
          Fill{{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, with_alpha(kQuietText, 0.10f)});
    }
    for (std::size_t p = 0; p < pairs_.size(); ++p) draw_verdict_line(p, left, width, y);
    const double height = row * static_cast<double>(kVerdictRows.size());
    draw_moment({left, y, width, height}, frames_.size(), moment_, pixel_, out_);
    const auto baseline = static_cast<float>(y + height + 0.82 * px(kTimeRow));
    const auto at = [&](const std::string& what, double x, Align align) {
      chart_text(what, {static_cast<float>(x), baseline}, align, kQuietText, pixel_, out_);
    };
    at("0", left, Align::Left);
    at("time", left + 0.5 * width, Align::Center);
    at(spell_quantity(frames_.back().time, "s"), left + width, Align::Right);
  }

  void draw_verdict_line(std::size_t p, double left, double width, double top) {
    const SeriesStyle style = series_style(p);
    const double column = width / static_cast<double>(frames_.size());
    // Beside each other where verdicts are the same.
    const double aside =
        px(4.5) * (static_cast<double>(p) - 0.5 * static_cast<double>(pairs_.size() - 1));
    std::vector<Point2> corners;
    const auto finish = [&] {
      float run = 0;
      for (std::size_t i = 1; i < corners.size(); ++i) {
        Stroke stroke{corners[i - 1], corners[i], 2.6f * pixel_, style.color,
                      style.dash > 0 ? Cap::Butt : Cap::Round};
        stroke.dash = pixel_ * style.dash;
        stroke.gap = 0.6f * stroke.dash;
        stroke.phase = run;
        out_.primitives.push_back(stroke);
        run += std::hypot(corners[i].x - corners[i - 1].x, corners[i].y - corners[i - 1].y);
      }
      corners.clear();
    };
    for (std::size_t f = 0; f <= moment_ && f < frames_.size(); ++f) {
      const trace::Pair* pair = same_pair(frames_[f], pairs_[p]);
      const auto* known = std::ranges::find_if(kVerdictRows, [&](const VerdictRow& verdict) {
        return in_contact(pair) && pair->stability->verdict == verdict.verdict;
      });
      if (known == kVerdictRows.end()) {
        finish();
        continue;
      }
      const auto level = static_cast<double>(known - kVerdictRows.begin());
      const auto y = static_cast<float>(top + px(kVerdictRow) * (level + 0.5) + aside);
      const auto from = static_cast<float>(left + column * static_cast<double>(f));
      if (corners.size() > 1 && corners.back().y == y)
        corners.pop_back();  // goes on
      else
        corners.push_back({from, y});
      corners.push_back({from + static_cast<float>(column), y});
    }
    finish();
  }

  const std::vector<trace::Frame>& frames_;
  std::size_t moment_;
  const Camera& camera_;
  Rect rect_;
  float pixel_;
  Drawing& out_;
  std::vector<trace::Pair> pairs_;
  bool has_ages_;
};

}  // namespace

std::string spell_margin(double metres) {
  const bool usual = metres >= 1e-4 && metres < 1;
  std::array<char, 32> text{};
  const int decimals = metres >= 0.09995 ? 0 : metres >= 0.009995 ? 1 : 2;
  std::snprintf(text.data(), text.size(), "%.*f mm", decimals, 1e3 * metres);
  return usual ? text.data() : spell_length(metres);
}

void draw_stability(const std::vector<trace::Frame>& frames, std::size_t moment,
                    const Camera& camera, const Rect& rect, float pixel, Drawing& drawing) {
  StabilityPainter(frames, moment, camera, rect, pixel, drawing).run();
}

}  // namespace contactscope::draw
