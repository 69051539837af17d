#include <iostream>

#include "app/cli/faults.h"
#include "app/cli/table.h"
#include "app/compare/engine_runs.h"
#include "app/render/renderer.h"
#include "dynamics/body.h"
#include "scenario/run.h"
#include "versus/request.h"

namespace contactscope::app {
namespace {

using versus::EngineRun;
using versus::RolloutScore;
using Json = nlohmann::ordered_json;

constexpr int kMaxFindings = 2;  // per engine, in the table and below it; JSON has all

/// Pose as in a run, rounded to the scenario's scalar.
Pose<double> scripted_pose(const Scenario& scenario, const ScenarioShape& shape, double time) {
  Pose<double> pose = collider_pose_at(shape, time);
  if (scenario.scalar == Scalar::Float) {
    // GCC 12 makes a copy of two numbers that are cast to float and back together.
    const auto round = [](double& number) {
      volatile float rounded = static_cast<float>(number);
      number = rounded;
    };
    for (double& number : pose.position) round(number);
    for (double& number : pose.rotation.coeffs()) round(number);
  }
  return recorded_pose(shape, time, pose);
}

std::vector<Vec3d> inertia_of(const ScenarioShape& shape) {
  const MassProperties filled = with_mass(*mass_properties(*shape.collider), shape.body->mass);
  std::vector<Vec3d> rows;
  for (int row = 0; row < 3; ++row) rows.push_back(filled.inertia.row(row).transpose());
  return rows;
}

/// Data for an engine to step a scene, see src/versus/README.md. The header has the world and each
/// shape's friction and restitution. Frame 0 has all poses, the pairs to query, and the bodies with
/// mass, inertia and velocities. Later frames have the poses of moving scripted shapes. Metres,
/// kilograms, seconds, world space.
///
/// Poses, vertices and velocities are those at the start of a run, rounded to the scenario's
/// scalar. Throws InputError with a remedy if the scenario has no dynamic shapes.
trace::Trace rollout_request(const Scenario& scenario) {
  if (std::ranges::none_of(scenario.shapes, &ScenarioShape::dynamic))
    throw InputError(scenario.path, 0, 0,
                     "no shape is dynamic, so there is nothing to step; add motion = { "
                     "dynamic = true, mass = 1.0 } to one, or leave out --rollout");
  Runner runner(scenario, trace::Stages::none());
  trace::Trace start{runner.header(), {runner.frame(0)}};
  trace::Trace request = versus::request_of(start);
  request.header.frames = scenario.frames;
  request.header.world = trace::World{scenario.world.gravity, scenario.dt};
  for (std::size_t i = 0; i < scenario.shapes.size(); ++i) {
    const ScenarioShape& shape = scenario.shapes[i];
    trace::Shape& record = request.header.shapes[i];
    record.friction = shape.friction.value_or(scenario.world.friction);
    record.restitution = shape.restitution.value_or(scenario.world.restitution);
  }
  trace::Solver& solver = request.frames.front().solver.emplace();
  solver = *start.frames.front().solver;
  solver.stops.clear();
  for (trace::Body& body : solver.bodies)
    body.inertia = inertia_of(*std::ranges::find(scenario.shapes, body.name, &ScenarioShape::name));
  for (int number = 1; number < scenario.frames; ++number) {
    trace::Frame& frame = request.frames.emplace_back();
    frame.frame = number;
    frame.time = number * scenario.dt;
    for (const ScenarioShape& shape : scenario.shapes)
      if (!shape.dynamic() && !(shape.motion.keyframes.empty() && shape.motion.velocity.isZero(0) &&
                                shape.motion.angular_velocity.isZero(0)))
        frame.poses.emplace_back(shape.name, scripted_pose(scenario, shape, frame.time));
  }
  return request;
}

/// This program's solver with the scenario's settings.
EngineRun own_rollout(const Scenario& scenario) {
  EngineRun own{kOwn, kOwn, CONTACTSCOPE_VERSION, "", "", {}};
  own.trace = run_frames(scenario, Options{}.selected(scenario.frames));
  // Other queries than contacts claim none.
  for (trace::Frame& frame : own.trace.frames)
    std::erase_if(frame.pairs, [](const trace::Pair& pair) { return pair.query.has_value(); });
  return own;
}

Rollout rollout_of(const Scenario& scenario, const std::vector<std::string>& engines,
                   const std::map<std::string, std::string>& programs, double time_limit) {
  Rollout rollout{scenario.name, rollout_request(scenario)};
  for (const std::string& name : engines) {
    stop_if_interrupted();
    rollout.engine_runs.push_back(
        programs.contains(name)
            ? run_engine(name, programs.at(name), "rollout", rollout.request, time_limit)
            : own_rollout(scenario));
    rollout.scores.push_back(versus::judge_rollout(rollout.request, rollout.engine_runs.back()));
  }
  return rollout;
}

/// The most frequent causes.
std::string causes_of(const RolloutScore& score) {
  std::string causes;
  for (int i = 0; i < std::min(kMaxFindings, count_of(score.findings)); ++i)
    causes += (i == 0 ? "" : ",") + at(score.findings, i).cause;
  const int left = count_of(score.findings) - kMaxFindings;
  return causes.empty() ? "-" : left > 0 ? causes + ",+" + std::to_string(left) : causes;
}

Table table_of(const Rollout& rollout) {
  Table table = {{"engine", "frames", "rest", "fell", "at s", "drift mm", "deepest mm", "passed",
                  "gained J", "points", "lint"}};
  for (const RolloutScore& score : rollout.scores) {
    if (!score.refusal.empty()) {
      table.push_back({score.name, "no rollout", "-", "-", "-", "-", "-", "-", "-", "-", "-"});
      continue;
    }
    const bool ran = !score.time.empty(), rests = score.resting > 0 && ran;
    const auto where = [](bool known, const std::string& text) { return known ? text : "-"; };
    table.push_back({score.name, std::to_string(score.time.size()), std::to_string(score.resting),
                     where(rests, std::to_string(score.fallen)),
                     score.fell_at ? printed("%.2f", *score.fell_at) : "-",
                     where(rests, millimetres(score.worst_drift)),
                     where(ran, millimetres(score.worst_penetration)),
                     where(ran, std::to_string(score.passed)),
                     where(ran, printed("%.3g", score.energy_gained)),
                     where(ran, printed("%.1f", score.points)), causes_of(score)});
  }
  return table;
}

Json json_of(const RolloutScore& score, const EngineRun& engine_run) {
  Json json = engine_json(engine_run, score.failure);
  if (!score.refusal.empty()) return json;
  json["frames"] = score.time.size();
  json["resting"] = score.resting;
  json["fallen"] = score.fallen;
  if (score.fell_at) json["fell"] = {{"time", *score.fell_at}, {"shape", score.first_fallen}};
  if (score.resting > 0) json["drift"] = {{"worst", score.worst_drift}, {"shape", score.drifted}};
  json["penetration"] = {{"worst", score.worst_penetration}, {"where", score.worst_place}};
  json["passed"] = {{"count", score.passed}};
  if (score.passed > 0) json["passed"]["first"] = score.first_passed;
  if (!score.unknown.empty()) json["penetration"]["unknown"] = score.unknown;
  json["energy_gained"] = score.energy_gained;
  json["velocities"] = score.has_velocities ? "told" : "differences";
  json["points"] = score.points;
  json["series"] = {{"time", score.time},
                    {"height", score.height},
                    {"energy", score.energy},
                    {"penetration", score.penetration},
                    {"drift", score.drift}};
  json["findings"] = findings_json(score.findings);
  return json;
}

/// Details that do not fit into the table.
void print_notes(const Rollout& rollout, std::ostream& out) {
  for (std::size_t i = 0; i < rollout.scores.size(); ++i) {
    const RolloutScore& score = rollout.scores[i];
    const auto note = [&](bool holds, const std::string& text) {
      if (holds) out << score.name << ": " << text << '\n';
    };
    note(!score.refusal.empty(), score.refusal);
    if (!score.refusal.empty()) continue;
    print_words(rollout.engine_runs[i], out);
    note(!score.failure.empty(), score.failure);
    note(score.fell_at.has_value(), "'" + score.first_fallen + "' is the first to fall, at " +
                                        printed("%.2f", score.fell_at.value_or(0)) + " s");
    note(score.worst_penetration > 0, "deepest in " + score.worst_place);
    note(score.passed > 0, "the first to pass through another in " + score.first_passed);
    note(!score.unknown.empty(), "the depth of " + score.unknown + " is not known, of two meshes");
    note(!score.has_velocities && !score.time.empty(),
         "reports no velocities; its energy is computed from the differences of poses");
    for (int k = 0; k < std::min(kMaxFindings, count_of(score.findings)); ++k)
      out << record(score.name, at(score.findings, k)) << '\n';
  }
}

/// True if all engines finished and agree on whether bodies stand or are stopped.
bool agree(const Rollout& rollout) {
  int standing = 0, falling = 0;
  for (const RolloutScore& score : rollout.scores) {
    if (!score.failure.empty()) return false;
    if (!score.refusal.empty()) continue;
    ++(score.fallen > 0 || score.passed > 0 ? falling : standing);
  }
  return standing == 0 || falling == 0;
}

/// Only scenarios: a trace records one result and cannot be stepped.
std::vector<Scenario> scenarios_of(const Options& options) {
  for (const std::string& argument : options.scenarios)
    if (is_trace_file(argument))
      throw UsageError("--rollout steps scenarios, but " + argument +
                       " is a trace; name a scenario, or leave out --rollout");
  return load_scenarios(options);
}

void write_picture(const Rollout& rollout, const Options& options, Renderer& renderer) {
  const std::vector<int> shown = options.selected(rollout.request.header.frames);
  const std::filesystem::path path =
      std::filesystem::path(options.out) / "versus" / rollout.name / "rollout.png";
  std::filesystem::create_directories(path.parent_path());
  write_png(path.string(), rollout_picture(rollout, shown.back(), options.size, renderer));
  if (!options.quiet) std::cerr << "a picture in " << path.string() << '\n';
}

}  // namespace

ExitCode run_rollout(const Options& options, const std::vector<std::string>& engines,
                     const std::map<std::string, std::string>& programs) {
  const std::vector<Scenario> scenarios = scenarios_of(options);
  Json json{{"schema", "contactscope.versus/1"}, {"matches", Json::array()}};
  bool all_agree = true;
  RunLog log;
  std::optional<Renderer> renderer;
  if (!options.tables_only) renderer.emplace(options.backend, log);
  for (const Scenario& scenario : scenarios) {
    const Rollout rollout = rollout_of(scenario, engines, programs, options.time_limit);
    all_agree = all_agree && agree(rollout);
    Json one{{"scenario", rollout.name}, {"rollout", true}, {"engines", Json::array()}};
    for (std::size_t i = 0; i < rollout.scores.size(); ++i)
      one["engines"].push_back(json_of(rollout.scores[i], rollout.engine_runs[i]));
    json["matches"].push_back(one);
    if (!options.json) {
      std::cout << rollout.name << '\n';
      print(table_of(rollout), std::cout);
      print_notes(rollout, std::cout);
    }
    if (renderer) write_picture(rollout, options, *renderer);
  }
  if (options.json) std::cout << json.dump() << '\n';
  return all_agree ? ExitCode::Same : ExitCode::Different;
}

}  // namespace contactscope::app
