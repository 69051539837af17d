#include "app/compare/diff_picture.h"

#include <algorithm>

#include "app/cli/table.h"
#include "app/render/figure_canvas.h"
#include "app/render/renderer.h"
#include "core/at.h"
#include "draw/charts/rollout_page.h"
#include "draw/scene/quantity.h"
#include "scenario/scenario.h"
#include "snapshot/finding.h"
#include "trace/find.h"
#include "view/title.h"

namespace contactscope::app {
namespace {

using snapshot::RunComparison;

/// The distance over time, with a ring at the parting; none if no shape moved.
std::vector<trace::Study> charts_of(const RunComparison& runs) {
  trace::Study chart;
  chart.error = "Largest distance of a shape between the runs";
  chart.unit = "m";
  const auto distance = mapped(runs.distances, [](const auto& one) { return one.metres; });
  if (std::ranges::count(distance, 0.0) == std::ssize(distance)) return {};
  const auto time = mapped(runs.distances, [](const auto& one) { return one.time; });
  trace::StudySeries& line = chart.series.emplace_back(draw::line_over_time("", time, distance));
  line.look = 0;
  for (std::size_t i = 0; i < line.points.size(); ++i)
    if (runs.distances[i].frame == runs.parting->frame)
      line.points[i].mark = "frame " + std::to_string(runs.parting->frame);
  return {chart};
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

/// "4 points, 3.2 mm deep", from only_parting(); empty if a shape differs.
std::string note_of(const RunComparison& runs, const trace::Frame& frame) {
  if (runs.a.empty()) return "";
  if (frame.pairs.empty()) return "no such pair";
  const trace::Pair& pair = frame.pairs.front();
  const int points = count_of(joined(pair.manifolds, &trace::Manifold::points));
  if (points == 0) return "no contact";
  return counted(points, "point") + ", " + draw::spell_length(trace::overlap_of(pair)) + " deep";
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

std::string place_of(const snapshot::Parting& parting) {
  const std::string frame =
      parting.frame < 0 ? "the header" : "frame " + std::to_string(parting.frame);
  return parting.subject.empty() ? frame : frame + ", " + parting.subject;
}

Image diff_picture(const RunComparison& runs, const std::array<trace::Header, 2>& headers,
                   const std::array<std::string, 2>& names, const std::optional<Size>& size,
                   Renderer& renderer) {
  const std::vector<trace::Frame> frames = {only_parting(runs, runs.frames[0]),
                                            only_parting(runs, runs.frames[1])};
  std::vector<draw::RolloutCell> cells;
  for (std::size_t i = 0; i < names.size(); ++i)
    cells.push_back({names[i], note_of(runs, frames[i]), 0, true});
  const Size page_size = size.value_or(Size{1280, draw::rollout_page_height(cells.size())});
  const draw::RolloutPage page =
      draw::rollout_page("The runs part in " + place_of(*runs.parting) + ": " +
                             std::string(name_of(runs.parting->stage)),
                         runs.parting->chain, headers[0].source,
                         "scenes: frame " + std::to_string(runs.parting->frame), charts_of(runs),
                         cells, page_size.width, page_size.height);
  Image picture = renderer.paint(page.drawing);
  const View view = view_of(runs);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    trace::Header header = headers[i];
    header.title.clear();
    header.source.clear();
    // Both are staged from both frames, so that they have one camera.
    const draw::Staging staging = stage_cell(header, frames, view, page.cells[i]);
    paste(renderer.paint(draw::illustrate(staging, frames[i])), staging.layout.view, page.cells[i],
          picture);
  }
  return picture;
}

}  // namespace contactscope::app
