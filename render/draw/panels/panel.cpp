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

/// Divides `room` by shares; who would get less than it has in `heights` keeps that, and the others
/// divide what then is left.
void divide_by_share(const std::vector<PanelNeed>& needs, float room, std::vector<float>& heights) {
  const std::vector<float> least = heights;
  std::vector<bool> settled(heights.size());
  for (bool again = true; again;) {
    again = false;
    float shares = 0, left = room;
    for (std::size_t i = 0; i < heights.size(); ++i) {
      if (needs[i].wanted > 0) continue;
      if (settled[i])
        left -= heights[i];
      else
        shares += needs[i].share;
    }
    for (std::size_t i = 0; i < heights.size(); ++i) {
      if (needs[i].wanted > 0 || settled[i]) continue;
      heights[i] = left * needs[i].share / shares;
      if (heights[i] >= least[i]) continue;
      heights[i] = least[i];
      settled[i] = true;
      again = true;
      break;
    }
  }
}

}  // namespace

std::vector<FilledPanel> make_panels(const Staging& staging, const Frames& frames) {
  std::vector<FilledPanel> panels;
  for (const Panel panel : staging.view.panels) {
    const auto* const row = std::ranges::find(kPanelRows, panel, &PanelRow::panel);
    if (row != std::end(kPanelRows)) panels.push_back({panel, row->make(staging, frames)});
  }
  return panels;
}

std::vector<float> divide_column(const std::vector<PanelNeed>& needs, float height, float gap,
                                 float note) {
  if (needs.empty()) return {};
  std::size_t count = needs.size();
  float room = 0;  // for the panels themselves
  float left = 0;
  while (true) {
    room = height - gap * static_cast<float>(count - 1);
    if (count < needs.size()) room -= note;
    left = room;
    for (std::size_t i = 0; i < count; ++i) left -= needs[i].least;
    if (left >= 0 || count == 1) break;
    --count;
  }

  std::vector<float> heights(count);
  for (std::size_t i = 0; i < count; ++i) heights[i] = needs[i].least;
  for (float PanelNeed::*const aim : {&PanelNeed::good, &PanelNeed::wanted}) {
    for (std::size_t i = 0; i < count; ++i) {
      const float more = std::clamp(needs[i].*aim - heights[i], 0.0f, std::max(0.0f, left));
      heights[i] += more;
      left -= more;
    }
  }
  float divided = room;
  for (std::size_t i = 0; i < count; ++i) {
    if (needs[i].wanted > 0) divided -= heights[i];
  }
  divide_by_share(needs, divided, heights);
  if (count == 1) heights[0] = std::min(heights[0], room);
  heights.resize(needs.size());
  return heights;
}

}  // namespace contactscope::draw
