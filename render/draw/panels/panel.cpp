#include "draw/panels/panel.h"

#include <algorithm>
#include <iterator>

namespace contactscope::draw {
namespace {

struct PanelRow {
  Panel panel;
  std::unique_ptr<PanelContent> (*make)(const Staging&, const Frames&);
};

constexpr PanelRow kPanelRows[] = {
    {Panel::Summary, make_summary_panel},
    {Panel::ContactPlane, make_contact_plane_panel},
    {Panel::AxisHistory, make_axis_history_panel},
    {Panel::Stability, make_stability_panel},
    {Panel::Plots, make_plots_panel},
};

}  // namespace

std::vector<FilledPanel> make_panels(const Staging& staging, const Frames& frames) {
  std::vector<FilledPanel> panels;
  for (const Panel panel : staging.view.panels) {
    const auto* const row = std::ranges::find(kPanelRows, panel, &PanelRow::panel);
    if (row != std::end(kPanelRows)) panels.push_back({panel, row->make(staging, frames)});
  }
  return panels;
}

}  // namespace contactscope::draw
