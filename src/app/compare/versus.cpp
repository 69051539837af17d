#include <iostream>

#include "app/cli/faults.h"
#include "app/cli/table.h"
#include "app/compare/engine_runs.h"
#include "app/render/renderer.h"
#include "snapshot/store.h"
#include "trace/find.h"
#include "versus/request.h"

namespace contactscope::app {
namespace {

namespace fs = std::filesystem;
using versus::EngineRun;
using versus::Score;

/// A request and its context.
struct Match {
  std::string name;  // "group/idea"
  std::string title, source;
  trace::Trace request;
  std::vector<EngineRun> engine_runs{};
};

trace::Trace run_whole(const Input& input) {
  trace::Trace whole = run_frames(input.scenario, input.frames);
  for (trace::Frame& frame : whole.frames) versus::keep_queried_pairs(frame);
  return whole;
}

/// The first engine is the trace's own, or this program for a scenario, if requested.
Match match_of(Input input, const std::vector<std::string>& engines) {
  const bool wants_own = std::ranges::count(engines, kOwn) > 0;
  trace::Trace whole =
      input.trace ? trace::Trace{std::move(input.trace->header), std::move(input.trace->frames)}
                  : run_whole(input);
  std::erase_if(whole.frames, [&](const trace::Frame& frame) {
    return std::ranges::count(input.frames, frame.frame) == 0;
  });
  Match match{input.scenario.name, whole.header.title, whole.header.source,
              versus::request_of(whole)};
  const bool is_own = whole.header.engine.empty();
  if (input.trace && !is_own) {
    const std::string name = whole.header.engine + ", as recorded";
    match.engine_runs.push_back({name, whole.header.engine, whole.header.version, "", "", whole});
  }
  if (wants_own) {
    trace::Trace own = is_own ? std::move(whole) : versus::own_contacts(match.request);
    match.engine_runs.push_back({kOwn, kOwn, CONTACTSCOPE_VERSION, "", "", std::move(own)});
  }
  return match;
}

Table table_of(const std::vector<Score>& scores) {
  Table table = {{"engine", "pairs", "missed", "invented", "depth error mm", "worst",
                  "normal costs mm", "points", "area %", "ids kept %", "lint"}};
  for (const Score& score : scores) {
    const bool touched = score.touching > 0;
    const std::string causes = separated(score.findings, ",", &lint::Finding::cause);
    table.push_back(
        {score.name, std::to_string(score.pairs), std::to_string(score.missed),
         std::to_string(score.invented), touched ? millimetres(score.mean_depth_error) : "-",
         touched ? millimetres(score.worst_depth_error) : "-",
         touched ? millimetres(score.worst_normal) : "-",
         touched ? printed("%.1f", score.points) : "-",
         score.patches > 0 ? printed("%.0f", 100 * score.area) : "-",
         score.id_frames > 0
             ? (score.ids_are_made_up ? "~" : "") + printed("%.0f", 100 * score.ids_kept)
             : "-",
         causes.empty() ? "-" : causes});
  }
  return table;
}

nlohmann::ordered_json json_of(const Score& score, const EngineRun& engine_run) {
  nlohmann::ordered_json json = engine_json(engine_run, score.failure);
  json["pairs"] = score.pairs;
  json["missed"] = score.missed;
  json["invented"] = score.invented;
  json["touching"] = score.touching;
  if (score.touching > 0) {
    json["depth_error"] = {{"mean", score.mean_depth_error}, {"worst", score.worst_depth_error}};
    json["normal_costs"] = score.worst_normal;
    json["points"] = score.points;
  }
  if (score.patches > 0) json["area_ratio"] = score.area;
  if (score.id_frames > 0) json["ids_kept"] = score.ids_kept;
  if (score.id_frames > 0 && score.ids_are_made_up) json["ids_are_made_up"] = true;
  json["findings"] = findings_json(score.findings);
  return json;
}

/// Prints what does not fit into the table: failures, the largest error, lint findings.
void print_notes(const Match& match, const std::vector<Score>& scores, std::ostream& out) {
  for (const Score& score : scores) {
    print_words(*std::ranges::find(match.engine_runs, score.name, &EngineRun::name), out);
    if (!score.failure.empty()) out << score.name << ": " << score.failure << '\n';
    for (const lint::Finding& finding : score.findings) out << record(score.name, finding) << '\n';
  }
}

using Names = std::pair<std::string, std::string>;

/// Pairs in which any engine has contacts, in order.
std::vector<Names> touching_pairs(const Match& match) {
  std::vector<Names> pairs;
  for (const EngineRun& engine_run : match.engine_runs)
    for (const trace::Frame& frame : engine_run.trace.frames)
      for (const trace::Pair& pair : frame.pairs) {
        const bool known = std::ranges::any_of(pairs, [&](const Names& names) {
          return names == Names{pair.a, pair.b} || names == Names{pair.b, pair.a};
        });
        if (!known && !pair.manifolds.empty()) pairs.emplace_back(pair.a, pair.b);
      }
  return pairs;
}

draw::ContactCell cell_of(const EngineRun& engine_run, const trace::Frame* frame,
                          const Names& names) {
  draw::ContactCell cell;
  cell.name = engine_run.name;
  const std::optional<trace::Pair> pair =
      frame == nullptr ? std::nullopt : versus::pair_of(*frame, names.first, names.second);
  if (!pair || pair->manifolds.empty()) {
    if (frame == nullptr) cell.rows.push_back({"no answer", "", "no answer", true});
    return cell;
  }
  cell.normal = pair->manifolds.front().normal;
  for (const trace::Point& point : joined(pair->manifolds, &trace::Manifold::points)) {
    cell.kept.push_back(count_of(cell.points));
    cell.points.push_back(point);
  }
  const std::string points = counted(count_of(cell.points), "point");
  cell.rows.push_back({points, "", points});
  const std::string depth = draw::spell_length(trace::deepest_point(*pair)->separation);
  cell.rows.push_back({"deepest " + depth, "", depth});
  return cell;
}

void write_pictures(const Match& match, const Options& options, Renderer& renderer) {
  const std::vector<Names> pairs = touching_pairs(match);
  const Size size = options.size.value_or(roomy_size(match.engine_runs.size()));
  EncoderPool encoders(options.jobs);
  int pictures = 0;
  const fs::path root = fs::path(options.out) / "versus" / match.name;
  for (const Names& names : pairs) {
    std::vector<draw::ContactMoment> moments;
    for (const trace::Frame& wanted : match.request.frames) {
      draw::ContactMoment& moment = moments.emplace_back();
      moment.frame = wanted.frame;
      moment.caption =
          names.first + " and " + names.second + ", frame " + std::to_string(wanted.frame);
      for (const EngineRun& engine_run : match.engine_runs) {
        const auto& frames = engine_run.trace.frames;
        const auto frame = std::ranges::find(frames, wanted.frame, &trace::Frame::frame);
        moment.cells.push_back(
            cell_of(engine_run, frame == frames.end() ? nullptr : &*frame, names));
      }
    }
    const draw::ContactCells cells(plain_title(match.title), match.source, match.request.header.up,
                                   moments, 0, size.width, size.height);
    const fs::path folder = pairs.size() > 1 ? root / (names.first + "-" + names.second) : root;
    fs::create_directories(folder);
    for (const trace::Frame& wanted : match.request.frames) {
      const std::string name = snapshot::frame_stem(wanted.frame) + ".png";
      encoders.submit((folder / name).string(), renderer.paint(cells.frame(wanted.frame)));
      ++pictures;
    }
  }
  encoders.finish();
  if (!options.quiet) std::cerr << counted(pictures, "picture") << " in " << root.string() << '\n';
}

ExitCode run_versus(const Options& options) {
  note_interrupts();
  const std::vector<std::string> engines = requested_engines(options);
  const std::map<std::string, std::string> programs = programs_of(engines);
  if (options.rollout) return run_rollout(options, engines, programs);
  RunLog log;
  std::optional<Renderer> renderer;
  if (!options.tables_only) renderer.emplace(options.backend, log);
  nlohmann::ordered_json json{{"schema", "contactscope.versus/1"},
                              {"matches", nlohmann::ordered_json::array()}};
  bool all_right = true;
  for (Input& input : load_inputs(options)) {
    if (!input.scenario.patches.empty())
      throw InputError(
          input.scenario.path, 0, 0,
          "a [[patch]] has no shapes for engines; `explore` compares reducers on its points");
    Match match = match_of(std::move(input), engines);
    for (const std::string& name : engines)
      if (programs.contains(name))
        match.engine_runs.push_back(
            run_engine(name, programs.at(name), "contacts", match.request, options.time_limit));
    std::vector<Score> scores;
    nlohmann::ordered_json one{{"scenario", match.name},
                               {"engines", nlohmann::ordered_json::array()}};
    for (const EngineRun& engine_run : match.engine_runs) {
      const Score score = versus::judge(match.request, engine_run);
      one["engines"].push_back(json_of(score, engine_run));
      all_right = all_right && score.failure.empty() && score.missed == 0 && score.invented == 0 &&
                  score.findings.empty();
      scores.push_back(score);
    }
    json["matches"].push_back(one);
    if (!options.json) {
      std::cout << match.name << '\n';
      print(table_of(scores), std::cout);
      print_notes(match, scores, std::cout);
    }
    if (renderer) write_pictures(match, options, *renderer);
  }
  if (options.json) std::cout << json.dump() << '\n';
  return all_right ? ExitCode::Same : ExitCode::Different;
}

}  // namespace

Verb versus_verb() {
  return {"versus", "Compare the contacts of several engines on the same shapes", &run_versus};
}

}  // namespace contactscope::app
