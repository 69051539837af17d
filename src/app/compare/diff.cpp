#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/cli/progress.h"
#include "app/cli/table.h"
#include "app/cli/trace_file.h"
#include "app/cli/verbs.h"
#include "app/compare/rollout_picture.h"
#include "app/render/renderer.h"
#include "core/input_error.h"
#include "draw/charts/time_chart.h"
#include "image/png.h"
#include "snapshot/compare_runs.h"
#include "snapshot/finding.h"
#include "snapshot/spelling.h"

namespace contactscope::app {
namespace {

namespace fs = std::filesystem;
using snapshot::Parting;
using snapshot::RunComparison;
using snapshot::RunDistance;

/// "frame 12, crate-floor".
std::string place_of(const Parting& parting) {
  std::string text = parting.frame < 0 ? "header" : "frame " + std::to_string(parting.frame);
  return parting.subject.empty() ? text : text + ", " + parting.subject;
}

RunDistance largest(const RunComparison& runs) {
  return runs.distances.empty()
             ? RunDistance{}
             : *std::ranges::max_element(runs.distances, {}, &RunDistance::metres);
}

/// Distance over time: the largest in each of some intervals.
draw::TimeChart chart_of(const RunComparison& runs, const std::string& name) {
  constexpr std::size_t kMaxPoints = 1000;
  draw::TimeChart chart{"Largest distance of a point of a shape between the runs", "m"};
  draw::TimeLine& line = chart.lines.emplace_back();
  line.name = name;
  const std::size_t every = runs.distances.size() / kMaxPoints + 1;
  for (std::size_t i = 0; i < runs.distances.size(); i += every) {
    const auto begin = runs.distances.begin() + static_cast<std::ptrdiff_t>(i);
    const auto end = std::next(begin, std::min<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(every),
                                                               runs.distances.end() - begin));
    line.time.push_back(begin->time);
    line.values.push_back(std::max_element(begin, end, [](const auto& one, const auto& other) {
                            return one.metres < other.metres;
                          })->metres);
    const bool is_parting = runs.parting && std::any_of(begin, end, [&](const RunDistance& one) {
                              return one.frame == runs.parting->frame;
                            });
    if (is_parting) line.marked = line.time.size() - 1;
  }
  line.mark = runs.parting ? "frame " + std::to_string(runs.parting->frame) : "";
  return chart;
}

/// Hides what is not about the parting: of a pair, all other shapes.
trace::Frame about(const Parting& parting, trace::Frame frame) {
  if (parting.a.empty()) return frame;
  std::erase_if(frame.poses, [&](const trace::Placement& one) {
    return one.first != parting.a && one.first != parting.b;
  });
  std::erase_if(frame.pairs, [&](const trace::Pair& pair) {
    return !(pair.a == parting.a && pair.b == parting.b) &&
           !(pair.a == parting.b && pair.b == parting.a);
  });
  return frame;
}

/// The distance over time, and below it the frame in which the runs part, of both.
Image picture_of(const RunComparison& runs, const std::vector<std::string>& names,
                 Renderer& renderer) {
  const Parting& parting = *runs.parting;
  const RunDistance farthest = largest(runs);
  const bool has_frame = parting.frame >= 0;
  std::vector<draw::RolloutCell> cells;
  for (std::size_t i = 0; i < names.size() && has_frame; ++i)
    cells.push_back({names[i], i == 0 ? "" : parting.what, i});
  const std::string moment = has_frame ? "frame " + std::to_string(parting.frame) + ", " +
                                             spelled("%.4g", parting.frames[0].time) + " s"
                                       : "";
  const Size size{1280, draw::rollout_page_height(cells.size())};
  const draw::RolloutPage page = draw::rollout_page(
      "The runs part in " + place_of(parting) + ": " + std::string(name_of(parting.stage)),
      farthest.metres > 0 ? "Up to " + snapshot::spell_length(farthest.metres) + " in frame " +
                                std::to_string(farthest.frame) + ", at " + farthest.shape
                          : "All shapes stay where they are in the other run",
      "", moment, {chart_of(runs, names[1])}, cells, size.width, size.height);
  Image picture = renderer.paint(page.drawing);
  if (!has_frame) return picture;
  View view = default_view();
  view.panels.clear();
  const std::vector<trace::Frame> frames = {about(parting, parting.frames[0]),
                                            about(parting, parting.frames[1])};
  for (std::size_t i = 0; i < frames.size(); ++i) {
    trace::Header header = runs.headers[i];
    header.title.clear();
    header.source.clear();
    const draw::Staging staging = staged_in_cell(header, frames, view, page.cells[i]);
    paste(renderer.paint(draw::illustrate(staging, frames[i])), staging.layout.view, page.cells[i],
          picture);
  }
  return picture;
}

nlohmann::ordered_json to_json(const RunComparison& runs, const std::vector<std::string>& files,
                               bool is_same) {
  nlohmann::ordered_json json{
      {"schema", "contactscope.diff/1"}, {"files", files},      {"same", is_same},
      {"frames", runs.distances.size()}, {"equal", runs.equal}, {"only_in", runs.alone}};
  if (runs.rounding) json["rounding"] = *runs.rounding;
  if (!runs.notes.empty()) json["notes"] = runs.notes;
  if (runs.parting) {
    const Parting& parting = *runs.parting;
    nlohmann::ordered_json& first = json["first"];
    if (parting.frame >= 0) first["frame"] = parting.frame;
    if (!parting.a.empty()) {
      first["a"] = parting.a;
      first["b"] = parting.b;
    } else if (!parting.subject.empty()) {
      first["subject"] = parting.subject;
    }
    first["stage"] = name_of(parting.stage);
    first["what"] = parting.what;
    first["cause"] = parting.chain;
  }
  for (const RunDistance& one : runs.distances)
    if (one.metres > 0)
      json["distances"].push_back(
          {{"frame", one.frame}, {"distance", one.metres}, {"shape", one.shape}});
  return json;
}

void print_text(const RunComparison& runs, const std::vector<std::string>& files, bool is_same) {
  const std::string compared = snapshot::counted(static_cast<int>(runs.distances.size()), "frame");
  if (is_same) {
    std::cout << "the same: " << compared;
    if (runs.rounding)
      std::cout << "; from frame " << *runs.rounding << " on they differ by rounding";
    std::cout << '\n';
  } else if (runs.parting) {
    const Parting& parting = *runs.parting;
    std::cout << files[1] << " differs from " << files[0] << " in " << place_of(parting)
              << ", first in: " << name_of(parting.stage) << "\n  " << parting.chain << '\n';
    if (runs.rounding)
      std::cout << "  by rounding alone already in frame " << *runs.rounding << '\n';
    const RunDistance farthest = largest(runs);
    if (farthest.metres > 0)
      std::cout << "  the shapes are up to " << snapshot::spell_length(farthest.metres)
                << " from where they are in the other run, " << farthest.shape << " in frame "
                << farthest.frame << '\n';
    std::cout << "  " << runs.equal << " of " << compared << " have the same text\n";
  } else {
    std::cout << "the same in the " << compared << " that are in both\n";
  }
  for (std::size_t i = 0; i < files.size(); ++i)
    if (runs.alone[i] > 0)
      std::cout << "  " << snapshot::counted(runs.alone[i], "frame") << " only in " << files[i]
                << '\n';
  for (const std::string& note : runs.notes) std::cout << "  " << note << '\n';
}

ExitCode run_diff(const Options& options) {
  note_interrupts();
  const std::vector<std::string>& files = options.scenarios;
  if (files.size() != 2)
    throw UsageError("diff compares two traces: contactscope diff a.jsonl b.jsonl");
  TraceFile a(files[0]), b(files[1]);
  Workers workers(hardware_threads());
  const RunComparison runs = snapshot::compare_runs(a.reader(), b.reader(), workers);
  for (const TraceFile* file : {&a, &b}) file->report_torn();
  if (runs.distances.empty())
    throw UsageError("no frame of " + files[0] + " has the number of a frame of " + files[1]);
  const bool is_same = !runs.parting && runs.alone[0] + runs.alone[1] == 0;
  std::string picture;
  if (!options.picture_folder.empty() && runs.parting) {
    RunLog log;
    Renderer renderer(options.backend, log);
    fs::create_directories(options.picture_folder);
    picture = (fs::path(options.picture_folder) / "diff.png").string();
    write_png(picture, picture_of(runs, files, renderer));
  }
  if (options.json) {
    nlohmann::ordered_json json = to_json(runs, files, is_same);
    if (!picture.empty()) json["picture"] = picture;
    std::cout << json.dump() << '\n';
  } else {
    print_text(runs, files, is_same);
    if (!picture.empty()) std::cout << picture << '\n';
  }
  return is_same ? ExitCode::Same : ExitCode::Different;
}

}  // namespace

Verb diff_verb() {
  return {
      "diff", "Find where two runs of one scene part: the first frame, pair and stage", &run_diff,
      R"(Frames are compared by number, shapes and pairs by name. Numbers that differ by rounding alone, of the
coarser of the two scalars, do not count.

Examples:
  contactscope diff before.jsonl after.jsonl
  contactscope diff before.jsonl after.jsonl --out out    # also out/diff.png
Exit codes: 0 the same, 1 they differ, 2 an error.)"};
}

}  // namespace contactscope::app
