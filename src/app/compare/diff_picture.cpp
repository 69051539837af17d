#include "app/compare/diff_picture.h"

#include <algorithm>

#include "app/cli/table.h"
#include "app/compare/page_cells.h"
#include "app/render/renderer.h"
#include "draw/charts/time_chart.h"
#include "draw/scene/quantity.h"
#include "scenario/scenario.h"
#include "snapshot/finding.h"
#include "trace/find.h"
#include "view/title.h"

namespace contactscope::app {
namespace {

using snapshot::RunComparison;

/// The distance over time, with a ring at the parting; none if no shape moved.
std::vector<draw::TimeChart> charts_of(const RunComparison& runs) {
  draw::TimeLine line{"", 0, {}, {}};
  for (const auto& [frame, time, metres, shape] : runs.distances) {
    if (frame == runs.parting->frame) line.marked = line.time.size();
    line.time.push_back(time);
    line.values.push_back(metres);
  }
  if (std::ranges::count(line.values, 0.0) == std::ssize(line.values)) return {};
  line.mark = "frame " + std::to_string(runs.parting->frame);
  return {{"Largest distance of a shape between the runs", "m", {line}}};
}

/// "4 points, 3.2 mm deep", of the pair that differs.
std::string note_of(const RunComparison& runs, const trace::Frame& frame) {
  if (runs.a.empty()) return "";
  const auto pair = std::ranges::find_if(
      frame.pairs, [&](const trace::Pair& one) { return one.a == runs.a && one.b == runs.b; });
  if (pair == frame.pairs.end()) return "no such pair";
  int points = 0;
  double deepest = 0;
  for (const trace::Manifold& manifold : pair->manifolds)
    for (const trace::Point& point : manifold.points) {
      ++points;
      deepest = std::max(deepest, -point.separation);
    }
  if (points == 0) return "no contact";
  return snapshot::counted(points, "point") + ", " + draw::spell_length(deepest) + " deep";
}

/// A frame with the pair that differs, or the pairs of the shape that differs.
trace::Frame only_parting(const RunComparison& runs, trace::Frame frame) {
  const std::string& subject = runs.parting->subject;
  std::erase_if(frame.pairs, [&](const trace::Pair& pair) {
    return runs.a.empty() ? !subject.empty() && pair.a != subject && pair.b != subject
                          : pair.a != runs.a || pair.b != runs.b;
  });
  return frame;
}

/// The view of a trace, on what differs, with the layer of its stage.
View view_of(const RunComparison& runs) {
  View view = default_view();
  view.panels.clear();
  if (runs.parting->stage == snapshot::Stage::Reduction) view.layers.push_back(Layer::Candidates);
  if (runs.parting->stage == snapshot::Stage::Solver) view.layers.push_back(Layer::Impulses);
  if (!runs.a.empty())
    view.focus_on = {runs.a, runs.b};
  else if (trace::find_pose(runs.frames[0], runs.parting->subject) != nullptr)
    view.focus_on = {runs.parting->subject};
  return view;
}

}  // namespace

Image diff_picture(const RunComparison& runs, const std::array<trace::Header, 2>& headers,
                   const std::array<std::string, 2>& names, const std::optional<Size>& size,
                   Renderer& renderer) {
  std::vector<draw::RolloutCell> cells;
  for (std::size_t i = 0; i < names.size(); ++i)
    cells.push_back({names[i], note_of(runs, runs.frames[i]), 0, true});
  const Size page_size = size.value_or(Size{1280, draw::rollout_page_height(cells.size())});
  const std::string frame = "frame " + std::to_string(runs.parting->frame);
  const std::string subject = runs.parting->subject.empty() ? "" : ", " + runs.parting->subject;
  const draw::RolloutPage page = draw::rollout_page(
      "The runs part in " + frame + subject + ": " + std::string(name_of(runs.parting->stage)),
      runs.parting->chain, headers[0].source, "scenes: " + frame, charts_of(runs), cells,
      page_size.width, page_size.height);
  Image picture = renderer.paint(page.drawing);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    trace::Header header = headers[i];
    header.title.clear();
    header.source.clear();
    // One camera: both are staged from the frames of both.
    const std::vector<trace::Frame> both = {only_parting(runs, runs.frames[0]),
                                            only_parting(runs, runs.frames[1])};
    const draw::Staging staging = stage_cell(header, both, view_of(runs), page.cells[i]);
    paste(renderer.paint(draw::illustrate(staging, both[i])), staging.layout.view, page.cells[i],
          picture);
  }
  return picture;
}

}  // namespace contactscope::app
