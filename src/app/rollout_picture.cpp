#include "app/rollout_picture.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "app/studio.h"
#include "app/table.h"
#include "core/at.h"
#include "core/title.h"
#include "draw/charts/time_chart.h"
#include "draw/scene/quantity.h"
#include "draw/staging.h"

namespace contactscope::app {
namespace {

using versus::RolloutScore;

/// "bullet, ode and jolt"
std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

/// Of scenes in which nothing rests, for the heading: who keeps bodies apart.
std::string overlaps_of(const Rollout& rollout) {
  std::vector<const RolloutScore*> scores;
  for (const RolloutScore& score : rollout.scores)
    if (!score.time.empty()) scores.push_back(&score);
  if (scores.empty()) return "No engine steps it";
  std::vector<std::string> passed, stopped;
  for (const RolloutScore* score : scores)
    (score->passed > 0 ? passed : stopped).push_back(score->name);
  if (stopped.empty()) return "Bodies pass through each other in all engines";
  if (!passed.empty())
    return "Bodies pass through each other in " + listed(passed) + ", and not in " +
           listed(stopped);
  std::ranges::sort(scores, {}, &RolloutScore::worst_penetration);
  const auto told = [](const RolloutScore& score) {
    return draw::spell_length(score.worst_penetration) + " in " + score.name;
  };
  if (scores.size() == 1) return "Overlaps of up to " + told(*scores.front());
  return "Overlaps of up to " + told(*scores.front()) + ", and " + told(*scores.back());
}

/// What became of the bodies that rest, for the heading.
std::string result_of(const Rollout& rollout) {
  std::vector<std::string> fallen, standing;
  int resting = 0;
  for (const RolloutScore& score : rollout.scores) {
    if (score.time.empty() || score.resting == 0) continue;
    resting = score.resting;
    if (score.fell_at)
      fallen.push_back(score.name + " (" + spelled("%.2f", *score.fell_at) + " s)");
    else
      standing.push_back(score.name);
  }
  const std::string bodies =
      resting == 1 ? "The body" : "All " + std::to_string(resting) + " bodies";
  const std::string stand = resting == 1 ? " stands in " : " stand in ";
  if (resting == 0) return overlaps_of(rollout);
  if (fallen.empty()) return bodies + stand + listed(standing);
  if (standing.empty()) return "It falls in " + listed(fallen);
  // Those that fall are named each, with their times; the others where there is room.
  const std::string others =
      standing.size() > 3 ? std::to_string(standing.size()) + " others" : listed(standing);
  return "It falls in " + listed(fallen) + ", and stands in " + others;
}

std::string note_of(const RolloutScore& score) {
  if (!score.failure.empty())
    return "broke off after " + std::to_string(score.time.size()) + " frames";
  if (score.resting == 0) return "";
  if (score.fallen == 0) return "drift " + millimetres(score.worst_drift) + " mm";
  return std::to_string(score.fallen) + " of " + std::to_string(score.resting) + " fell";
}

std::vector<draw::TimeChart> charts_of(const Rollout& rollout) {
  std::vector<draw::TimeChart> charts = {
      {"height of the highest", "m"}, {"energy since the start", "J"}, {"deepest overlap", "m"}};
  const auto frames = rollout.request.frames.size();
  for (std::size_t i = 0; i < rollout.scores.size(); ++i) {
    const RolloutScore& score = rollout.scores[i];
    if (score.time.empty()) continue;
    std::vector<double> energy = score.energy;
    for (double& joules : energy) joules -= score.energy.front();
    const bool breaks_off = score.time.size() < frames;
    charts[0].lines.push_back({score.name, i, score.time, score.height, breaks_off});
    charts[1].lines.push_back({score.name, i, score.time, energy, breaks_off});
    charts[2].lines.push_back({score.name, i, score.time, score.penetration, breaks_off});
  }
  return charts;
}

/// The frame of an engine to draw, with all poses: what it leaves out is where the request has it.
trace::Frame frame_of(const Rollout& rollout, std::size_t engine, int shown) {
  const std::vector<trace::Frame>& told = rollout.contenders[engine].trace.frames;
  const std::size_t judged = rollout.scores[engine].time.size();
  std::size_t last = 0;
  while (last + 1 < judged && told[last + 1].frame <= shown) ++last;
  trace::Frame frame;
  frame.frame = told[last].frame;
  frame.poses = told[last].poses;
  for (const trace::Shape& shape : rollout.request.header.shapes) {
    if (std::ranges::count(frame.poses, shape.name, &trace::Placement::first) > 0) continue;
    for (int k = frame.frame; k >= 0; --k) {
      const auto& asked = at(rollout.request.frames, k).poses;
      const auto pose = std::ranges::find(asked, shape.name, &trace::Placement::first);
      if (pose == asked.end()) continue;
      frame.poses.push_back(*pose);
      break;
    }
  }
  return frame;
}

/// Whether all bodies are where a picture of the others can show them.
bool is_near(const trace::Frame& frame, const trace::Frame& start) {
  double reach = 1;
  for (const auto& [name, pose] : start.poses) reach = std::max(reach, pose.position.norm());
  return std::ranges::all_of(frame.poses, [&](const trace::Placement& one) {
    return one.second.position.norm() < 3 * reach;
  });
}

/// A canvas whose view, without captions and legend, is as large as a cell.
draw::Staging staged(const trace::Header& header, const std::vector<trace::Frame>& frames,
                     const View& view, const draw::Rect& cell) {
  int width = static_cast<int>(1.2 * cell.width), height = static_cast<int>(1.5 * cell.height);
  for (int round = 0; round < 2; ++round) {
    const draw::Rect room = draw::stage(header, frames, view, width, height).layout.view;
    width += static_cast<int>(std::ceil(cell.width - room.width));
    height += static_cast<int>(std::ceil(cell.height - room.height));
  }
  return draw::stage(header, frames, view, width, height);
}

/// The middle of a part of a picture, into the middle of a cell of another one.
void paste(const Image& from, const draw::Rect& part, const draw::Rect& cell, Image& to) {
  const int columns = static_cast<int>(std::min(part.width, cell.width));
  const int rows = static_cast<int>(std::min(part.height, cell.height));
  const auto begin = [&](const draw::Rect& rect) {
    return std::pair(static_cast<int>(rect.x + (rect.width - columns) / 2),
                     static_cast<int>(rect.y + (rect.height - rows) / 2));
  };
  const auto [from_x, from_y] = begin(part);
  const auto [x, y] = begin(cell);
  const auto pixel = [](const Image& image, int column, int row) {
    return 3 * static_cast<std::size_t>(row * image.width + column);
  };
  for (int row = 0; row < rows; ++row)
    std::memcpy(&to.rgb[pixel(to, x, y + row)], &from.rgb[pixel(from, from_x, from_y + row)],
                3 * static_cast<std::size_t>(columns));
}

}  // namespace

Image rollout_picture(const Rollout& rollout, int shown, const std::optional<Size>& size,
                      Studio& studio) {
  std::vector<std::size_t> drawn;  // engines that told a frame
  std::vector<draw::RolloutCell> cells;
  for (std::size_t i = 0; i < rollout.scores.size(); ++i) {
    if (rollout.scores[i].time.empty()) continue;
    drawn.push_back(i);
    cells.push_back({rollout.scores[i].name, note_of(rollout.scores[i]), i});
  }
  const Size page_size = size.value_or(Size{1280, draw::rollout_page_height(cells.size())});
  const trace::Header& asked = rollout.request.header;
  const draw::RolloutPage page =
      draw::rollout_page(result_of(rollout), plain_title(asked.title), asked.source,
                         "scenes of frame " + std::to_string(shown), charts_of(rollout), cells,
                         page_size.width, page_size.height);
  Image picture = studio.paint(page.drawing);
  if (drawn.empty()) return picture;

  trace::Header header = asked;
  header.title.clear();
  header.source.clear();
  View view;
  view.focus = Focus::Shapes;
  view.layers = {Layer::Shapes};
  // One camera for all, which holds those that are still there.
  std::vector<trace::Frame> frames = {rollout.request.frames.front()};
  frames.front().pairs.clear();
  for (const std::size_t i : drawn) {
    trace::Frame frame = frame_of(rollout, i, shown);
    if (is_near(frame, frames.front())) frames.push_back(std::move(frame));
  }
  const draw::Staging staging = staged(header, frames, view, page.cells.front());
  for (std::size_t k = 0; k < drawn.size(); ++k)
    paste(studio.paint(draw::illustrate(staging, frame_of(rollout, drawn[k], shown))),
          staging.layout.view, page.cells[k], picture);
  return picture;
}

}  // namespace contactscope::app
