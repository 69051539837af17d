#include "app/compare/engine_runs.h"

#include "app/cli/table.h"
#include "app/render/figure_canvas.h"
#include "app/render/renderer.h"
#include "draw/charts/rollout_page.h"
#include "trace/find.h"

namespace contactscope::app {
namespace {

using versus::RolloutScore;

/// Name in the engine's own spelling; the requested name if it returned nothing.
std::string name_of(const Rollout& rollout, std::size_t i) {
  const std::string& engine = rollout.engine_runs[i].engine;
  return engine.empty() ? rollout.scores[i].name : engine;
}

std::vector<std::size_t> with_frames(const Rollout& rollout) {
  std::vector<std::size_t> engines;
  for (std::size_t i = 0; i < rollout.scores.size(); ++i)
    if (!rollout.scores[i].time.empty()) engines.push_back(i);
  return engines;
}

/// Heading for scenes without resting bodies: engines that do not keep bodies separated.
std::string overlaps_of(const Rollout& rollout) {
  const std::vector<std::size_t> engines = with_frames(rollout);
  if (engines.empty()) return "No engine steps it";
  std::vector<std::string> passed;
  double deepest = 0;
  for (const std::size_t i : engines) {
    if (rollout.scores[i].passed > 0) passed.push_back(name_of(rollout, i));
    deepest = std::max(deepest, rollout.scores[i].worst_penetration);
  }
  return passed.empty() ? "Overlaps of up to " + draw::spell_length(deepest)
                        : "Bodies pass through each other in " + listed(passed);
}

/// Engines with frames: first those in which a body fell, by time, then by increasing drift.
std::vector<std::size_t> by_outcome(const Rollout& rollout) {
  std::vector<std::size_t> engines = with_frames(rollout);
  std::ranges::stable_sort(engines, {}, [&](std::size_t i) {
    const RolloutScore& score = rollout.scores[i];
    return std::pair(!score.fell_at, score.fell_at ? *score.fell_at : score.worst_drift);
  });
  return engines;
}

bool stands(const RolloutScore& score) {
  return score.resting > 0 && !score.fell_at && score.failure.empty();
}

/// Heading: the engines in which a body fell, with the time, and those in which all stand.
std::string result_of(const Rollout& rollout) {
  std::vector<std::string> fallen, standing;
  for (const std::size_t i : by_outcome(rollout)) {
    const RolloutScore& score = rollout.scores[i];
    if (score.fell_at)
      fallen.push_back(name_of(rollout, i) + " (" + printed("%.2f", *score.fell_at) + " s)");
    else if (stands(score))
      standing.push_back(name_of(rollout, i));
  }
  if (fallen.empty() && standing.empty()) return overlaps_of(rollout);
  constexpr std::size_t kMaxNamed = 4;
  const std::string others =
      standing.size() > kMaxNamed
          ? std::to_string(standing.size()) + (fallen.empty() ? " engines" : " others")
          : listed(standing);
  if (fallen.empty()) return "Nothing falls in " + others;
  const std::string falls = "A body falls in " + listed(fallen);
  return standing.empty() ? falls : falls + "; nothing falls in " + others;
}

/// Limit of scenes in a row. Beyond it, only engines in which a body falls get a scene, and the one
/// with the largest drift of the others. The chart shows all engines.
constexpr std::size_t kMaxScenes = 5;

bool any_fell(const Rollout& rollout) {
  return std::ranges::any_of(rollout.scores,
                             [](const RolloutScore& score) { return score.fell_at.has_value(); });
}

std::vector<std::size_t> scenes_of(const Rollout& rollout) {
  std::vector<std::size_t> scenes = by_outcome(rollout);
  if (scenes.size() <= kMaxScenes || !any_fell(rollout)) return scenes;
  const auto is_standing = [&](std::size_t i) { return stands(rollout.scores[i]); };
  const auto drift = [&](std::size_t i) {
    return is_standing(i) ? rollout.scores[i].worst_drift : -1;
  };
  const std::size_t farthest = *std::ranges::max_element(scenes, {}, drift);
  std::erase_if(scenes, [&](std::size_t i) { return is_standing(i) && i != farthest; });
  return scenes;
}

std::string note_of(const RolloutScore& score) {
  if (!score.failure.empty())
    return "broke off after " + std::to_string(score.time.size()) + " frames";
  if (score.resting == 0) return "";
  if (score.fell_at) return "falls after " + printed("%.2f", *score.fell_at) + " s";
  return "stands, " + millimetres(score.worst_drift) + " mm off its place";
}

/// Bodies and duration of a request.
std::string scene_of(const trace::Trace& request) {
  const int bodies = count_of(versus::rollout_bodies(request));
  return counted(bodies, "body", "bodies") + ", for " +
         printed("%.3g", request.frames.back().time) +
         " s; other engines have the settings that they come with";
}

/// Style of an engine's line and name, by outcome, so that neighbours differ. With more engines
/// than scenes, those with falls have a colour each and the others are grey.
struct Look {
  std::size_t style = 0;
  bool quiet = false;
};
std::vector<Look> looks_of(const Rollout& rollout) {
  const std::vector<std::size_t> order = by_outcome(rollout);
  std::vector<Look> looks(rollout.scores.size());
  const bool some_are_quiet = order.size() > kMaxScenes && any_fell(rollout);
  for (std::size_t k = 0; k < order.size(); ++k)
    looks[order[k]] = {k, some_are_quiet && !rollout.scores[order[k]].fell_at};
  return looks;
}

trace::Study chart_of(const std::string& name, const std::string& unit) {
  trace::Study chart;
  chart.error = name;
  chart.unit = unit;
  return chart;
}

/// If a body falls, only the height is plotted, with a mark at the fall.
std::vector<trace::Study> charts_of(const Rollout& rollout, const std::vector<Look>& looks) {
  trace::Study height = chart_of("Height of the highest body", "m"),
               energy = chart_of("Energy since the start", "J"),
               overlap = chart_of("Deepest overlap", "m");
  for (std::size_t i = 0; i < rollout.scores.size(); ++i) {
    const RolloutScore& score = rollout.scores[i];
    if (score.time.empty()) continue;
    const auto add = [&](trace::Study& chart, const std::vector<double>& values) {
      trace::StudySeries& line =
          chart.series.emplace_back(draw::line_over_time(name_of(rollout, i), score.time, values));
      line.look = static_cast<int>(looks[i].style);
      line.quiet = looks[i].quiet;
      line.points.back().failed = score.time.size() < rollout.request.frames.size();
    };
    add(height, score.height);
    add(overlap, score.penetration);
    add(energy, mapped(score.energy, [&](double one) { return one - score.energy.front(); }));
    if (!score.fell_at) continue;
    const auto after = std::ranges::lower_bound(score.time, *score.fell_at) - score.time.begin();
    trace::StudySeries& line = height.series.back();
    at(line.points, std::min(static_cast<int>(after), count_of(line.points) - 1)).mark =
        std::exchange(line.method, "") + " " + printed("%.2f", *score.fell_at) + " s";
  }
  if (height.series.empty()) return {};
  if (any_fell(rollout)) return {height};
  return {height, energy, overlap};
}

/// The frame of an engine to draw; poses that it omits are those of the request.
trace::Frame frame_of(const Rollout& rollout, std::size_t engine, int shown) {
  const std::vector<trace::Frame>& record = rollout.engine_runs[engine].trace.frames;
  const std::size_t judged = rollout.scores[engine].time.size();
  std::size_t last = 0;
  while (last + 1 < judged && record[last + 1].frame <= shown) ++last;
  trace::Frame frame;
  frame.frame = record[last].frame;
  frame.poses = record[last].poses;
  for (const trace::Shape& shape : rollout.request.header.shapes) {
    for (int k = frame.frame; k >= 0 && trace::find_pose(frame, shape.name) == nullptr; --k)
      if (const auto* const pose = trace::find_pose(at(rollout.request.frames, k), shape.name))
        frame.poses.emplace_back(shape.name, *pose);
  }
  return frame;
}

/// True if no body is too far away for a picture of the others.
bool is_near(const trace::Frame& frame, const trace::Frame& start) {
  double reach = 1;
  for (const auto& [name, pose] : start.poses) reach = std::max(reach, pose.position.norm());
  return std::ranges::all_of(frame.poses, [&](const trace::Placement& one) {
    return one.second.position.norm() < 3 * reach;
  });
}

}  // namespace

Image rollout_picture(const Rollout& rollout, int shown, const std::optional<Size>& size,
                      Renderer& renderer) {
  const std::vector<std::size_t> drawn = scenes_of(rollout);
  const std::size_t left_out = by_outcome(rollout).size() - drawn.size();
  const std::vector<Look> looks = looks_of(rollout);
  std::vector<draw::RolloutCell> cells;
  for (const std::size_t i : drawn) {
    const RolloutScore& score = rollout.scores[i];
    const bool is_for_others = left_out > 0 && stands(score);
    cells.push_back(
        {name_of(rollout, i),
         is_for_others ? "stands, as in " + std::to_string(left_out) + " others" : note_of(score),
         looks[i].style, looks[i].quiet});
  }
  const Size page_size = size.value_or(Size{1280, draw::rollout_page_height(cells.size())});
  const trace::Header& requested = rollout.request.header;
  const draw::RolloutPage page = draw::rollout_page(
      result_of(rollout), scene_of(rollout.request), requested.source,
      "scenes at " + printed("%.3g", at(rollout.request.frames, shown).time) + " s",
      charts_of(rollout, looks), cells, page_size.width, page_size.height);
  Image picture = renderer.paint(page.drawing);
  if (drawn.empty()) return picture;

  trace::Header header = requested;
  header.title.clear();
  header.source.clear();
  View view;
  view.focus = Focus::Shapes;
  view.layers = {Layer::Shapes};
  const std::vector<versus::RolloutBody> bodies = versus::rollout_bodies(rollout.request);
  view.focus_on = mapped(bodies, &versus::RolloutBody::name);  // the ground may be cut off
  // One camera for all engines; ignores bodies that flew away.
  std::vector<trace::Frame> frames = {rollout.request.frames.front()};
  frames.front().pairs.clear();
  for (const std::size_t i : drawn) {
    trace::Frame frame = frame_of(rollout, i, shown);
    if (is_near(frame, frames.front())) frames.push_back(std::move(frame));
  }
  // The camera leaves half of the view around the bodies, and the cell has less of it.
  constexpr double kNearer = 1.7;
  const draw::Rect& cell = page.cells.front();
  const draw::Staging staging = stage_cell(
      header, frames, view,
      {cell.x, cell.y, std::floor(kNearer * cell.width), std::floor(kNearer * cell.height)});
  for (std::size_t k = 0; k < drawn.size(); ++k)
    paste(renderer.paint(draw::illustrate(staging, frame_of(rollout, drawn[k], shown))),
          staging.layout.view, page.cells[k], picture);
  return picture;
}

}  // namespace contactscope::app
