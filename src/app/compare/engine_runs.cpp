#include "app/compare/engine_runs.h"

#include "app/cli/faults.h"
#include "app/cli/progress.h"
#include "scenario/run.h"
#include "versus/request.h"

namespace contactscope::app {
namespace {

constexpr int kMaxNotes = 5;  // lines of an engine's messages

/// Reads the frames before the first error; ignores shapes.
trace::Trace read_answer(std::string text, const std::string& name, std::string& failure) {
  trace::Trace answer;
  try {
    TraceFile file(std::make_unique<std::istringstream>(std::move(text)), name);
    answer.header = file.header();
    while (std::optional<trace::Frame> frame = file.next()) {
      frame->shapes.clear();
      answer.frames.push_back(std::move(*frame));
    }
  } catch (const InputError& error) {
    if (failure.empty()) failure = error.what();
  }
  return answer.frames.empty() ? trace::Trace{} : answer;
}

/// This program, and all engines that are found.
std::vector<std::string> known_engines() {
  std::vector<std::string> engines = versus::engines_found(versus::own_folders());
  engines.insert(engines.begin(), kOwn);
  return engines;
}

}  // namespace

std::vector<std::string> requested_engines(const Options& options) {
  return options.engines.empty() ? known_engines() : options.engines;
}

std::map<std::string, std::string> programs_of(const std::vector<std::string>& engines) {
  std::map<std::string, std::string> programs;
  for (const std::string& name : engines) {
    if (name == kOwn) continue;
    const std::optional<std::string> program = versus::find_engine(name, versus::own_folders());
    if (!program) {
      const std::vector<std::string> known = known_engines();
      const std::vector<std::string_view> views(known.begin(), known.end());
      throw UsageError("--engines '" + name + "': there is no program contactscope-engine-" + name +
                       " next to contactscope or in $PATH; there are " + quoted_list(views));
    }
    programs[name] = *program;
  }
  return programs;
}

versus::EngineRun run_engine(const std::string& name, const std::string& program,
                             const std::string& question, const trace::Trace& request,
                             double limit) {
  versus::EngineRun engine_run{name, "", "", "", "", {}};
  versus::Answer answer = versus::run_program(program, {question}, versus::to_text(request), limit);
  engine_run.failure = answer.failure;
  engine_run.notes = answer.said;
  if (question == "rollout" && answer.exit_code == versus::kNoRollout) {
    const std::string reason = versus::last_line(answer.said);
    engine_run.refusal = reason.empty() ? "no rollout" : reason;
    return engine_run;
  }
  // Drop the incomplete line of a crashed program.
  if (!answer.failure.empty() && !answer.out.empty())
    answer.out.erase(answer.out.find_last_of('\n') + 1);
  if (answer.failure.empty() || !answer.out.empty())
    engine_run.trace = read_answer(answer.out, name + "'s answer", engine_run.failure);
  engine_run.engine = engine_run.trace.header.engine;
  engine_run.version = engine_run.trace.header.version;
  // The shapes are those of the request, whatever the engine wrote.
  engine_run.trace.header.shapes = request.header.shapes;
  const std::size_t requested = request.frames.size(), record = engine_run.trace.frames.size();
  if (engine_run.failure.empty() && record < requested)
    engine_run.failure =
        "it answered " + std::to_string(record) + " of " + std::to_string(requested) + " frames";
  return engine_run;
}

trace::Trace run_frames(const Scenario& scenario, const std::vector<int>& frames,
                        const trace::Stages& stages) {
  Runner runner(scenario, stages);
  trace::Trace whole{runner.header(), {}};
  for (const int frame : frames) {
    stop_if_interrupted();
    whole.frames.push_back(runner.frame(frame));
  }
  return whole;
}

void print_words(const versus::EngineRun& engine_run, std::ostream& out) {
  std::istringstream lines(engine_run.notes);
  int left = kMaxNotes;
  for (std::string line; std::getline(lines, line) && left-- > 0;)
    out << engine_run.name << " prints: " << line << '\n';
}

nlohmann::ordered_json engine_json(const versus::EngineRun& engine_run,
                                   const std::string& failure) {
  nlohmann::ordered_json json{{"name", engine_run.name}};
  const auto add = [&](const char* key, const std::string& text) {
    if (!text.empty()) json[key] = text;
  };
  add("engine", engine_run.engine);
  add("version", engine_run.version);
  add("no_rollout", engine_run.refusal);
  add("failure", failure);
  if (engine_run.refusal.empty()) add("said", engine_run.notes);
  return json;
}

nlohmann::ordered_json findings_json(const std::vector<lint::Finding>& findings) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const lint::Finding& finding : findings) json.push_back(to_json(finding));
  return json;
}

}  // namespace contactscope::app
