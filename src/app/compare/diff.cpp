#include <iostream>
#include <nlohmann/json.hpp>

#include "app/render/figure_canvas.h"
#include "app/render/renderer.h"
#include "draw/charts/rollout_page.h"
#include "snapshot/compare_runs.h"
#include "trace/find.h"

namespace contactscope::app {
namespace {

using snapshot::RunComparison;

/// "up to 3 mm in frame 9, at crate"; empty if no shape moved.
std::string farthest(const RunComparison& runs) {
  const auto most = std::ranges::max_element(runs.distances, {}, &snapshot::RunDistance::metres);
  if (most == runs.distances.end() || most->metres == 0) return {};
  return "up to " + snapshot::spell_length(most->metres) + " in frame " +
         std::to_string(most->frame) + ", at " + most->shape;
}

/// "frame 12, crate-floor".
std::string place_of(const snapshot::Parting& parting) {
  const std::string frame =
      parting.frame < 0 ? "the header" : "frame " + std::to_string(parting.frame);
  return parting.subject.empty() ? frame : frame + ", " + parting.subject;
}

nlohmann::ordered_json json_of(const RunComparison& runs, const std::vector<std::string>& files,
                               bool is_same) {
  nlohmann::ordered_json json{
      {"schema", "contactscope.diff/1"}, {"files", files},      {"same", is_same},
      {"frames", runs.distances.size()}, {"equal", runs.equal}, {"only_in", runs.alone}};
  if (runs.rounding) json["rounding"] = *runs.rounding;
  if (!runs.notes.empty()) json["notes"] = runs.notes;
  for (const auto& [name, parting] :
       {std::pair("header", &runs.header), {"setting", &runs.setting}, {"first", &runs.parting}}) {
    if (!*parting) continue;
    const bool is_pair = parting == &runs.parting && !runs.a.empty();
    nlohmann::ordered_json& first = json[name];
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

void print_text(const RunComparison& runs, const std::vector<std::string>& files) {
  const std::string frames = counted(runs.distances.size(), "frame");
  for (const auto& parting : {runs.header, runs.setting, runs.parting})
    if (parting)
      std::cout << files[1] << " differs from " << files[0]
                << (parting->frame < 0 ? " in "
                    : runs.setting && parting->subject != runs.setting->subject
                        ? ", but for that, first in "
                        : " first in ")
                << place_of(*parting) << ", stage: " << name_of(parting->stage) << "\n  "
                << parting->chain << '\n';
  if (runs.more_pairs > 0)
    std::cout << "  " << counted(runs.more_pairs, "more pair")
              << (runs.more_pairs == 1 ? " differs" : " differ") << " in this frame\n";
  if (runs.differ()) {
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

std::vector<Vec3d> places_in(const trace::Frame& frame) {
  std::vector<Vec3d> places;
  for (const trace::Pair& pair : frame.pairs)
    for (const trace::Point& point : joined(pair.manifolds, &trace::Manifold::points))
      places.push_back(point.position);
  return places;
}

/// Places of the other run's points without those that are nearest to the points here.
std::vector<Vec3d> lost_places(const trace::Frame& here, const trace::Frame& other) {
  std::vector<Vec3d> lost = places_in(other);
  for (const Vec3d& place : places_in(here)) {
    if (lost.empty()) break;
    lost.erase(std::ranges::min_element(
        lost, {}, [&](const Vec3d& one) { return (one - place).squaredNorm(); }));
  }
  return lost;
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

/// Both runs in the frame in which they part, with one camera on the pair or shape that differs,
/// below their distance over time. They must part in a frame, not in their headers. `headers` and
/// `names` are those of the runs.
Image diff_picture(const RunComparison& runs, const std::array<trace::Header, 2>& headers,
                   const std::array<std::string, 2>& names, const std::optional<Size>& size,
                   Renderer& renderer) {
  const std::vector<trace::Frame> frames = {only_parting(runs, runs.frames[0]),
                                            only_parting(runs, runs.frames[1])};
  const std::array lost = {lost_places(frames[0], frames[1]), lost_places(frames[1], frames[0])};
  std::vector<draw::RolloutCell> cells;
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::string note = note_of(runs, frames[i]);
    if (!note.empty() && !lost[i].empty()) note += "; rings: points of the other run";
    cells.push_back({names[i], note, 0, true});
  }
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
    draw::Drawing drawing = draw::illustrate(staging, frames[i]);
    const draw::Pen pen(drawing, staging.layout.scale, 0);
    for (const Vec3d& place : lost[i])
      if (const std::optional<draw::Point2> at = staging.camera.project(place))
        pen.ring(*at, 7, 10, draw::kText);
    paste(renderer.paint(drawing), staging.layout.view, page.cells[i], picture);
  }
  return picture;
}

void write_picture(const RunComparison& runs, const std::array<trace::Header, 2>& headers,
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
  Workers workers(hardware_threads());
  const RunComparison runs = snapshot::compare_runs(a.reader(), b.reader(), workers);
  for (const TraceFile* file : {&a, &b}) file->report_torn();
  if (runs.distances.empty())
    throw UsageError("no frame of " + names[0] + " has the number of a frame of " + names[1]);
  const bool is_same = !runs.differ() && runs.alone == std::array{0, 0};
  if (options.json)
    std::cout << json_of(runs, names, is_same).dump() << '\n';
  else
    print_text(runs, names);
  if (!options.picture.empty()) write_picture(runs, {a.header(), b.header()}, options);
  return is_same ? ExitCode::Same : ExitCode::Different;
}

}  // namespace

Verb diff_verb() {
  return {"diff", "Find where two runs of one scene part: the first frame, pair and stage",
          &run_diff};
}

}  // namespace contactscope::app
