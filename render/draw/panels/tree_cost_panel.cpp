#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "draw/charts/series_chart.h"
#include "draw/panels/panel.h"
#include "draw/scene/pairs.h"

/// What refitting a tree costs a query, and what a rebuild gives back.
namespace contactscope::draw {
namespace {

constexpr double kLeastChart = 70, kMostChart = 230, kMostAlone = 400, kAxisBelow = 20,
                 kNames = 20;  // px at 720 lines
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// A curve a name, in the order in which they first appear; NaN in frames that do not have it.
class NamedCurves {
 public:
  explicit NamedCurves(std::size_t frames) : frames_(frames) {}

  void set(const std::string& name, std::size_t frame, double value) {
    const auto [place, is_new] = places_.try_emplace(name, names.size());
    if (is_new) {
      names.push_back(name);
      curves.emplace_back(frames_, kNone);
    }
    curves[place->second][frame] = value;
  }

  std::vector<std::string> names;
  std::vector<std::vector<double>> curves;

 private:
  std::size_t frames_;
  std::map<std::string, std::size_t> places_;
};

/// Two charts over each other: boxes that a small query tests in the tree of each mesh that deforms,
/// by the surfaces of its boxes, and node pairs that were really compared by each pair of meshes. A
/// rebuild is the tooth of a saw. Where no mesh deforms the first is left out.
class TreeCostPanel : public PanelContent {
 public:
  TreeCostPanel(const Staging& staging, const Frames& frames)
      : frames_(frames), scale_(staging.layout.scale) {}

  PanelNeed need(const PanelMoment&) const override {
    const double charts = deforms() ? 2 : 1;
    const auto high = [&](double chart) {
      return Sheet::heading_height(scale_) +
             static_cast<float>(charts * (chart + kNames) + kAxisBelow) * scale_;
    };
    return {high(kLeastChart), high(1.3 * kLeastChart), high(most()), 0};
  }

  std::string lay_out(const PanelMoment& moment, Sheet& sheet) override {
    if (charts_.empty()) gather();
    sheet.heading("what the trees cost");
    const Pen pen(sheet.pen().drawing(), sheet.pen().scale(), kChartText);
    const Rect rect = sheet.rest();
    const auto charts = static_cast<double>(charts_.size());
    const double height = std::min<double>(
        pen.px(most()), (rect.height - pen.px(kAxisBelow)) / charts - pen.px(kNames));
    double y = rect.y;
    for (const NamedChart& named : charts_) {
      double x = rect.x;
      // Both charts have the same names.
      const bool is_named = named.names.size() > 1 && &named == &charts_.front();
      for (std::size_t i = 0; i < named.names.size() && is_named; ++i) {
        draw_series_swatch(i, pixel(x, y + pen.px(0.5 * kNames)), 18, pen);
        pen.text(named.names[i], pixel(x + pen.px(22), y + pen.px(0.75 * kNames)), Align::Left,
                 kText);
        x += pen.px(34) + pen.width_of(named.names[i]);
      }
      y += is_named ? pen.px(kNames) : 0;
      draw_series_chart(named.chart, moment.frame, {rect.x, y, rect.width, height}, pen);
      y += height;
    }
    const double gutter = pen.px(kChartGutter);
    draw_time_axis(frames_.back().time, rect.x + gutter, rect.width - gutter,
                   y + pen.px(kAxisBelow - 4), pen);
    return {};
  }

 private:
  double most() const { return deforms() ? kMostChart : kMostAlone; }
  bool deforms() const { return !frames_.front().deformed.empty(); }

  /// What the pair of a mesh is called, so that both charts have the same names.
  static std::string name_of(const trace::Deformed& deformed,
                             const std::vector<trace::Pair>& pairs) {
    for (const trace::Pair& pair : pairs)
      if (!pair.label.empty() && (pair.a == deformed.name || pair.b == deformed.name))
        return pair.label;
    return deformed.name;
  }

  struct NamedChart {
    SeriesChart chart;
    std::vector<std::string> names;
  };

  void gather() {
    NamedCurves expected(frames_.size()), compared(frames_.size());
    for (std::size_t f = 0; f < frames_.size(); ++f) {
      for (const trace::Deformed& deformed : frames_[f].deformed)
        expected.set(name_of(deformed, frames_[f].pairs), f, deformed.cost);
      for (const trace::Pair& pair : frames_[f].pairs)
        if (pair.query && pair.query->trees)
          compared.set(pair.label.empty() ? pair_name(pair) : pair.label, f,
                       pair.query->trees->node_pairs);
    }
    if (deforms()) add("boxes a query is expected to test", expected);
    add("pairs of boxes compared", compared);
  }

  void add(const char* name, const NamedCurves& curves) {
    SeriesChart chart{name, ""};
    chart.curves = curves.curves;
    chart.fit();
    charts_.push_back({std::move(chart), curves.names});
  }

  const Frames& frames_;
  float scale_;
  std::vector<NamedChart> charts_;
};

}  // namespace

std::unique_ptr<PanelContent> make_tree_cost_panel(const Staging& staging, const Frames& frames) {
  return std::make_unique<TreeCostPanel>(staging, frames);
}

}  // namespace contactscope::draw
