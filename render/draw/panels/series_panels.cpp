// The panels "stability" and "plots": charts over time.
#include <algorithm>
#include <optional>

#include "draw/charts/series_plots.h"
#include "draw/insets/stability_plot.h"
#include "draw/panels/panel.h"

namespace contactscope::draw {
namespace {

// Pixels at 720 lines, of what the drawings below need.
constexpr double kStabilityWords = 65;  // lines under the map, and the name over it
constexpr double kStabilityMap = 70;
constexpr double kStabilityOverTime = 64;
constexpr double kPlotsAxis = 40;  // of time, and a row of names
constexpr double kPlotsChart = 46;

/// Whether the centre of mass projects into the manifold, by what margin, and over time.
class StabilityPanel : public PanelContent {
 public:
  StabilityPanel(const Staging& staging, const Frames& frames) : staging_(staging), plot_(frames) {}

  PanelNeed need(const PanelMoment&) const override {
    const Layout& layout = staging_.layout;
    const float least =
        Sheet::heading_height(layout.scale) + layout.px(kStabilityWords + kStabilityMap);
    return {least, least + layout.px(kStabilityOverTime), 0, 2};
  }

  std::string lay_out(const PanelMoment& moment, Sheet& sheet) override {
    sheet.heading("stability: centre of mass over the contact");
    // Charts have a text size of their own, which is not a whole number of pixels everywhere.
    plot_.draw(moment.frame, staging_.camera, sheet.rest(),
               {sheet.pen().drawing(), sheet.pen().scale(), kChartText});
    return {};
  }

 private:
  const Staging& staging_;
  StabilityPlot plot_;
};

/// What the solver made of it, up to the current frame. The series are gathered for the first
/// picture that has room for them.
class PlotsPanel : public PanelContent {
 public:
  PlotsPanel(const Staging& staging, const Frames& frames) : staging_(staging), frames_(frames) {
    solved_ = std::ranges::any_of(
        frames, [](const trace::Frame& frame) { return frame.solver.has_value(); });
  }

  PanelNeed need(const PanelMoment&) const override {
    const Layout& layout = staging_.layout;
    const float least = Sheet::heading_height(layout.scale) + layout.px(kPlotsAxis + kPlotsChart);
    const int charts = solved_ ? 4 : 2;
    return {least, least + layout.px((charts - 1) * kPlotsChart), 0, 2};
  }

  std::string lay_out(const PanelMoment& moment, Sheet& sheet) override {
    if (!plots_) {
      const double step = staging_.view.shows(Layer::Loads) ? staging_.scales.step : 0;
      plots_.emplace(time_series(frames_), frames_.back().time, step);
    }
    sheet.heading("over time");
    const float scale = staging_.layout.scale;
    const Rect rest = sheet.rest();
    Drawing whole;
    std::size_t missing = plots_->draw(moment.frame, rest, {whole, scale, kChartText});
    if (missing > 0) {  // again, with a line below that says so
      whole = {};
      const double line = sheet.line_height();
      const Rect above{rest.x, rest.y, rest.width, rest.height - line};
      missing = plots_->draw(moment.frame, above, {whole, scale, kChartText});
      sheet.skip_to(rest.y + above.height);
    }
    std::vector<Primitive>& all = sheet.pen().drawing().primitives;
    all.insert(all.end(), whole.primitives.begin(), whole.primitives.end());
    return sheet.more(missing, "chart", "charts");
  }

 private:
  const Staging& staging_;
  const Frames& frames_;
  bool solved_ = false;
  std::optional<SeriesPlots> plots_;
};

}  // namespace

std::unique_ptr<PanelContent> make_stability_panel(const Staging& staging, const Frames& frames) {
  return std::make_unique<StabilityPanel>(staging, frames);
}

std::unique_ptr<PanelContent> make_plots_panel(const Staging& staging, const Frames& frames) {
  return std::make_unique<PlotsPanel>(staging, frames);
}

}  // namespace contactscope::draw
