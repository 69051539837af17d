#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "app/cli/progress.h"
#include "app/cli/trace_file.h"
#include "app/cli/verbs.h"
#include "app/compare/diff_picture.h"
#include "app/render/renderer.h"
#include "snapshot/compare_facts.h"
#include "snapshot/compare_runs.h"
#include "snapshot/finding.h"
#include "snapshot/spelling.h"
#include "trace/find.h"

namespace contactscope::app {
namespace {

using snapshot::key_of;
using snapshot::RunComparison;
using snapshot::RunDistance;
using snapshot::Stage;

/// The frames are compared even if the headers differ.
struct ComparedRuns : RunComparison {
  std::optional<snapshot::Parting> header{};  // its first difference; `parting` is in a frame
  std::size_t more_pairs = 0;                 // that differ in the frame of the parting
};

/// "up to 3 mm in frame 9, at crate"; empty if no shape moved.
std::string farthest(const RunComparison& runs) {
  const auto most = std::ranges::max_element(runs.distances, {}, &RunDistance::metres);
  if (most == runs.distances.end() || most->metres == 0) return {};
  return "up to " + snapshot::spell_length(most->metres) + " in frame " +
         std::to_string(most->frame) + ", at " + most->shape;
}

/// The largest change of a point: of its impulse in newton seconds, or of its place in metres.
double change_of(const trace::Pair& before, const trace::Pair& now, bool is_of_solver) {
  const auto values_of = [&](const trace::Pair& pair) {
    std::vector<Vec3d> values;
    for (const trace::Manifold& manifold : pair.manifolds)
      for (const trace::Point& point : manifold.points) {
        const trace::Impulse impulse = point.impulse.value_or(trace::Impulse{});
        const Vec3d acts = impulse.normal * manifold.normal + impulse.friction;
        const Vec3d place = point.position + point.separation * manifold.normal;
        values.push_back(is_of_solver ? acts : place);
      }
    return values;
  };
  const std::vector<Vec3d> from = values_of(before), to = values_of(now);
  double most = 0;
  for (std::size_t i = 0; i < std::min(from.size(), to.size()); ++i)
    most = std::max(most, (to[i] - from[i]).norm());
  return most;
}

/// The pair, or the shape with another pose, that differs most of those that differ in the stage
/// of the parting. Their values have one unit, so that the size of the quantity does not matter.
/// Counts the pairs that differ.
std::string most_different(ComparedRuns& runs) {
  std::vector<snapshot::Difference> all;
  trace::Frame settled = runs.frames[1];
  snapshot::Comparison([](const auto&, const auto&) {
    return snapshot::Tolerance{};  // numbers within rounding are equal there
  }).compare(runs.frames[0], settled, {}, "", all);
  std::map<std::string, std::array<trace::Pair, 2>> pairs;
  for (std::size_t i = 0; i < runs.frames.size(); ++i)
    for (const trace::Pair& pair : runs.frames[i].pairs) pairs[key_of(pair)][i] = pair;
  std::set<std::string> differing;
  std::string most = runs.parting->subject;
  double largest = 0;
  for (const snapshot::Difference& one : all) {
    const auto pair = pairs.find(one.subject);
    const bool is_pair = pair != pairs.end();
    if (is_pair) differing.insert(one.subject);
    if (one.stage != runs.parting->stage || is_pair == runs.a.empty()) continue;
    const auto* const from = trace::find_pose(runs.frames[0], one.subject);
    const auto* const to = trace::find_pose(settled, one.subject);
    double change = from && to ? (to->position - from->position).norm() : 0;
    if (is_pair) change = change_of(pair->second[0], pair->second[1], one.stage == Stage::Solver);
    if (change > largest) largest = change, most = one.subject;
  }
  runs.more_pairs = differing.size() - std::size_t(runs.a.empty() ? 0 : 1);
  return most;
}

ComparedRuns compare(TraceFile& a, TraceFile& b) {
  Workers workers(hardware_threads());
  std::istringstream first(trace::to_json_line(a.reader().header()));
  std::istringstream second(trace::to_json_line(b.reader().header()));
  trace::TraceReader before(first, a.name()), after(second, b.name());
  RunComparison headers = snapshot::compare_runs(before, after, workers);
  trace::Header alike = before.header();
  alike.scalar = after.header().scalar;
  b.reader().assume(alike);
  ComparedRuns runs{snapshot::compare_runs(a.reader(), b.reader(), workers), headers.parting};
  runs.notes = std::move(headers.notes);
  if (!runs.parting) return runs;
  if (const std::string most = most_different(runs); most != runs.parting->subject) {
    for (TraceFile* file : {&a, &b}) {
      file->rewind();
      file->reader().change_frames([most](trace::Frame& frame) {
        std::stable_partition(frame.poses.begin(), frame.poses.end(),
                              [&](auto& one) { return one.first == most; });
        std::stable_partition(frame.pairs.begin(), frame.pairs.end(),
                              [&](auto& one) { return key_of(one) == most; });
      });
    }
    RunComparison again = snapshot::compare_runs(a.reader(), b.reader(), workers);
    runs.parting = again.parting, runs.a = again.a, runs.b = again.b;
  }
  std::string& chain = runs.parting->chain;
  if (chain.ends_with(" pairs differ in it")) chain.resize(chain.rfind("; "));
  return runs;
}

nlohmann::ordered_json json_of(const ComparedRuns& runs, const std::vector<std::string>& files,
                               bool is_same) {
  nlohmann::ordered_json json{
      {"schema", "contactscope.diff/1"}, {"files", files},      {"same", is_same},
      {"frames", runs.distances.size()}, {"equal", runs.equal}, {"only_in", runs.alone}};
  if (runs.rounding) json["rounding"] = *runs.rounding;
  if (!runs.notes.empty()) json["notes"] = runs.notes;
  for (const auto* parting : {&runs.header, &runs.parting}) {
    if (!*parting) continue;
    const bool is_pair = parting == &runs.parting && !runs.a.empty();
    nlohmann::ordered_json& first = json[parting == &runs.header ? "header" : "first"];
    if ((*parting)->frame >= 0) first["frame"] = (*parting)->frame;
    if (is_pair) first["a"] = runs.a, first["b"] = runs.b;
    if (!is_pair && !(*parting)->subject.empty()) first["shape"] = (*parting)->subject;
    first["stage"] = name_of((*parting)->stage);
    first["what"] = (*parting)->what;
    first["cause"] = (*parting)->chain;
  }
  if (runs.more_pairs > 0) json["first"]["more_pairs"] = runs.more_pairs;
  for (const auto& [frame, time, metres, shape] : runs.distances)
    if (metres > 0)
      json["distances"].push_back({{"frame", frame}, {"distance", metres}, {"shape", shape}});
  return json;
}

void print_text(const ComparedRuns& runs, const std::vector<std::string>& files) {
  const std::string frames = counted(runs.distances.size(), "frame");
  for (const auto& parting : {runs.header, runs.parting})
    if (parting)
      std::cout << files[1] << " differs from " << files[0]
                << (parting->frame < 0 ? " in " : " first in ") << place_of(*parting)
                << ", stage: " << name_of(parting->stage) << "\n  " << parting->chain << '\n';
  if (runs.more_pairs > 0)
    std::cout << "  " << counted(runs.more_pairs, "more pair")
              << (runs.more_pairs == 1 ? " differs" : " differ") << " in this frame\n";
  if (runs.header || runs.parting) {
    if (const std::string far = farthest(runs); !far.empty())
      std::cout << "  shapes are apart " << far << '\n';
    std::cout << "  " << runs.equal << " of " << frames << " are equal\n";
  } else {
    std::cout << "the same: " << frames << '\n';
  }
  if (runs.rounding)
    std::cout << "  from frame " << *runs.rounding << " on there are differences by rounding\n";
  for (std::size_t i = 0; i < files.size(); ++i)
    if (runs.alone[i] > 0)
      std::cout << "  " << counted(runs.alone[i], "frame") << " only in " << files[i] << '\n';
  for (const std::string& note : runs.notes) std::cout << "  " << note << '\n';
}

void write_picture(const ComparedRuns& runs, const std::array<trace::Header, 2>& headers,
                   const Options& options) {
  if (!runs.parting) {
    std::cerr << "no frame differs, so there is no picture\n";
    return;
  }
  // Without folders, unless both files have the same name.
  std::array<std::string, 2> names;
  for (std::size_t i = 0; i < names.size(); ++i)
    names[i] = std::filesystem::path(options.scenarios[i]).filename().string();
  if (names[0] == names[1]) std::copy_n(options.scenarios.begin(), 2, names.begin());
  RunLog log;
  Renderer renderer(options.backend, log);
  write_png(options.picture, diff_picture(runs, headers, names, options.size, renderer));
  if (!options.quiet) std::cerr << "a picture in " << options.picture << '\n';
}

ExitCode run_diff(const Options& options) {
  note_interrupts();
  const std::vector<std::string>& names = options.scenarios;
  if (names.size() != 2)
    throw UsageError("diff compares two traces, as contactscope diff a.jsonl b.jsonl");
  TraceFile a(names[0], TraceFile::Passes::Several), b(names[1], TraceFile::Passes::Several);
  const ComparedRuns runs = compare(a, b);
  for (const TraceFile* file : {&a, &b}) file->report_torn();
  if (runs.distances.empty())
    throw UsageError("no frame of " + names[0] + " has the number of a frame of " + names[1]);
  const bool is_same = !runs.header && !runs.parting && runs.alone == std::array{0, 0};
  if (options.json)
    std::cout << json_of(runs, names, is_same).dump() << '\n';
  else
    print_text(runs, names);
  if (!options.picture.empty()) write_picture(runs, {a.header(), b.header()}, options);
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
  contactscope diff before.jsonl after.jsonl --json
  contactscope diff before.jsonl after.jsonl --picture parting.png
Exit codes: 0 the same, 1 they differ, 2 an error.)"};
}

}  // namespace contactscope::app
