#include "draw/panels/panel.h"

namespace contactscope::draw {

const PanelDrawing kMinkowskiPanel{
    .needs = {&Stages::minkowski, &Stages::gjk, &Stages::penetration}};
const PanelDrawing kGaussMapPanel{.needs = {&Stages::gauss_map, &Stages::sat}};

std::vector<FilledPanel> make_panels(const Staging& staging, const Frames& frames) {
  std::vector<FilledPanel> panels;
  for (const Panel panel : staging.view.panels)
    if (const auto make = kPanels[static_cast<std::size_t>(panel)]->make)
      panels.push_back({panel, make(staging, frames)});
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
  // The others divide the rest by their shares, but none shrinks.
  float rest = room;
  std::vector<float> shares(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (needs[i].wanted > 0)
      rest -= heights[i];
    else
      shares[i] = needs[i].share;
  }
  const auto part_of = [&](std::size_t i) {
    float divided = rest;
    for (std::size_t k = 0; k < count; ++k)
      if (shares[k] == 0 && needs[k].wanted == 0) divided -= heights[k];
    return divided * shares[i] / std::accumulate(shares.begin(), shares.end(), 0.0f);
  };
  for (std::size_t i = 0; i < count;) {
    const bool starves = shares[i] > 0 && part_of(i) < heights[i];
    if (starves) shares[i] = 0;
    i = starves ? 0 : i + 1;
  }
  for (std::size_t i = 0; i < count; ++i)
    if (shares[i] > 0) heights[i] = part_of(i);
  if (count == 1) heights[0] = std::min(heights[0], room);
  heights.resize(needs.size());
  return heights;
}

}  // namespace contactscope::draw
