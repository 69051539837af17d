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

/// As its own program spells it; one that told nothing has the name by which it was asked.
std::string name_of(const Rollout& rollout, std::size_t i) {
  const std::string& engine = rollout.contenders[i].engine;
  return engine.empty() ? rollout.scores[i].name : engine;
}

/// Of scenes in which nothing rests, for the heading: who keeps bodies apart.
std::string overlaps_of(const Rollout& rollout) {
  std::vector<std::size_t> engines;
  for (std::size_t i = 0; i < rollout.scores.size(); ++i)
    if (!rollout.scores[i].time.empty()) engines.push_back(i);
  if (engines.empty()) return "No engine steps it";
  std::vector<std::string> passed, stopped;
  for (const std::size_t i : engines)
    (rollout.scores[i].passed > 0 ? passed : stopped).push_back(name_of(rollout, i));
  if (stopped.empty()) return "Bodies pass through each other in all engines";
  if (!passed.empty())
    return "Bodies pass through each other in " + listed(passed) + ", and not in " +
           listed(stopped);
  const auto overlap = [&](std::size_t i) { return rollout.scores[i].worst_penetration; };
  std::ranges::sort(engines, {}, overlap);
  const auto told = [&](std::size_t i) {
    return draw::spell_length(overlap(i)) + " in " + name_of(rollout, i);
  };
  if (engines.size() == 1) return "Overlaps of up to " + told(engines.front());
  return "Overlaps of up to " + told(engines.front()) + ", and " + told(engines.back());
}

/// Engines that told a frame: those in which something fell first, then those that stand with the least drift.
std::vector<std::size_t> by_outcome(const Rollout& rollout) {
  std::vector<std::size_t> engines;
  for (std::size_t i = 0; i < rollout.scores.size(); ++i)
    if (!rollout.scores[i].time.empty()) engines.push_back(i);
  std::ranges::stable_sort(engines, {}, [&](std::size_t i) {
    const RolloutScore& score = rollout.scores[i];
    return std::pair(!score.fell_at, score.fell_at ? *score.fell_at : score.worst_drift);
  });
  return engines;
}

/// What became of the bodies that rest, for the heading.
std::string result_of(const Rollout& rollout) {
  std::vector<std::string> fallen, standing;
  int resting = 0;
  for (const std::size_t i : by_outcome(rollout)) {
    const RolloutScore& score = rollout.scores[i];
    if (score.resting == 0) continue;
    resting = score.resting;
    if (score.fell_at)
      fallen.push_back(name_of(rollout, i) + " (" + spelled("%.2f", *score.fell_at) + " s)");
    else if (score.failure.empty())  // who broke off does not know
      standing.push_back(name_of(rollout, i));
  }
  const std::string bodies = resting == 1   ? "The body"
                             : resting == 2 ? "Both bodies"
                                            : "All " + std::to_string(resting) + " bodies";
  constexpr std::size_t kMostNamed = 4;
  const std::string stand = resting == 1 ? " stands in " : " stand in ";
  if (resting == 0 || (fallen.empty() && standing.empty())) return overlaps_of(rollout);
  if (fallen.empty())
    return bodies + stand +
           (standing.size() > kMostNamed ? "all " + std::to_string(standing.size()) + " engines"
                                         : listed(standing));
  const std::string falls =
      (resting == 1 ? "The body falls in " : "A body falls in ") + listed(fallen);
  if (standing.empty()) return falls;
  // Those that fall are named each, with their times; the others where there is room.
  const std::string others =
      standing.size() > 3 ? std::to_string(standing.size()) + " others" : listed(standing);
  return falls + "; " + (resting == 1 ? "it stands in " : "all stand in ") + others;
}

std::string note_of(const RolloutScore& score) {
  if (!score.failure.empty())
    return "broke off after " + std::to_string(score.time.size()) + " frames";
  if (score.resting == 0) return "";
  if (score.fell_at) return "falls after " + spelled("%.2f", *score.fell_at) + " s";
  return "stands, " + millimetres(score.worst_drift) + " mm off its place";
}

/// Of the request: who is there, how heavy, and how long.
std::string scene_of(const trace::Trace& request) {
  const std::vector<versus::RolloutBody> bodies = versus::rollout_bodies(request);
  if (bodies.empty() || request.frames.empty()) return plain_title(request.header.title);
  const auto [lightest, heaviest] =
      std::ranges::minmax(bodies, {}, [](const versus::RolloutBody& body) { return body.mass; });
  std::string masses = draw::spell_number(lightest.mass);
  if (heaviest.mass > lightest.mass)
    masses += (bodies.size() == 2 ? " and " : " to ") + draw::spell_number(heaviest.mass);
  return std::string(bodies.size() == 1 ? "A body" : std::to_string(bodies.size()) + " bodies") +
         " of " + masses + " kg, for " + spelled("%.3g", request.frames.back().time) +
         " s; other engines have the settings that they come with";
}

/// How an engine's line and name look: by their outcome, so that neighbours differ. Of more engines than there are colours
/// those that let something fall have one each, and the others are grey.
struct Look {
  std::size_t style = 0;
  bool quiet = false;
};
std::vector<Look> looks_of(const Rollout& rollout) {
  constexpr std::size_t kColours = 7;
  const std::vector<std::size_t> order = by_outcome(rollout);
  std::vector<Look> looks(rollout.scores.size());
  const bool any_fell = std::ranges::any_of(
      order, [&](std::size_t i) { return rollout.scores[i].fell_at.has_value(); });
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool stands = !rollout.scores[order[k]].fell_at;
    looks[order[k]] = {k, order.size() > kColours && any_fell && stands};
  }
  return looks;
}

/// Where something falls, overlaps end with that: what lies on the ground then says nothing.
std::vector<draw::TimeChart> charts_of(const Rollout& rollout, const std::vector<Look>& looks) {
  draw::TimeChart height{"Height of the highest body", "m"}, energy{"Energy since the start", "J"},
      overlap{"Deepest overlap", "m"};
  const auto frames = rollout.request.frames.size();
  bool any_fell = false;
  for (std::size_t i = 0; i < rollout.scores.size(); ++i) {
    const RolloutScore& score = rollout.scores[i];
    if (score.time.empty()) continue;
    const std::string name = name_of(rollout, i);
    std::vector<double> joules = score.energy;
    for (double& one : joules) one -= score.energy.front();
    const bool breaks_off = score.time.size() < frames;
    const auto& [style, quiet] = looks[i];
    height.lines.push_back({name, style, score.time, score.height, breaks_off, quiet});
    energy.lines.push_back({name, style, score.time, joules, breaks_off, quiet});
    draw::TimeLine until{name, style, score.time, score.penetration, breaks_off, quiet};
    if (score.fell_at) {
      any_fell = true;
      const auto end = std::ranges::upper_bound(until.time, *score.fell_at) - until.time.begin();
      until.time.resize(static_cast<std::size_t>(end));
      until.values.resize(static_cast<std::size_t>(end));
      until.breaks_off = true;
    }
    overlap.lines.push_back(until);
  }
  if (!any_fell) return {height, energy, overlap};
  overlap.name += " until it falls";
  return {height, overlap};
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
  const std::vector<std::size_t> drawn = by_outcome(rollout);
  const std::vector<Look> looks = looks_of(rollout);
  std::vector<draw::RolloutCell> cells;
  for (const std::size_t i : drawn)
    cells.push_back(
        {name_of(rollout, i), note_of(rollout.scores[i]), looks[i].style, looks[i].quiet});
  const Size page_size = size.value_or(Size{1280, draw::rollout_page_height(cells.size())});
  const trace::Header& asked = rollout.request.header;
  const draw::RolloutPage page = draw::rollout_page(
      result_of(rollout), scene_of(rollout.request), asked.source,
      "scenes at " + spelled("%.3g", at(rollout.request.frames, shown).time) + " s",
      charts_of(rollout, looks), cells, page_size.width, page_size.height);
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
