#include "app/compare/engine_runs.h"

#include <sstream>

#include "app/cli/trace_file.h"
#include "core/input_error.h"
#include "scenario/nearest_word.h"
#include "versus/engine.h"
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

/// The reason that a program gives for not stepping.
std::string last_words(const std::string& said) {
  std::istringstream lines(said);
  std::string last = "no rollout";
  for (std::string line; std::getline(lines, line);)
    if (line.find_first_not_of(" \t\r") != std::string::npos) last = line;
  return last;
}

}  // namespace

std::vector<std::string> requested_engines(const Options& options) {
  if (!options.engines.empty()) return options.engines;
  std::vector<std::string> engines = versus::engines_found(versus::own_folders());
  engines.insert(engines.begin(), kOwn);
  return engines;
}

std::map<std::string, std::string> programs_of(const std::vector<std::string>& engines) {
  std::map<std::string, std::string> programs;
  for (const std::string& name : engines) {
    if (name == kOwn) continue;
    const std::optional<std::string> program = versus::find_engine(name, versus::own_folders());
    if (!program) {
      std::vector<std::string> known = versus::engines_found(versus::own_folders());
      known.insert(known.begin(), kOwn);
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
    engine_run.refusal = last_words(answer.said);
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

void print_words(const versus::EngineRun& engine_run, std::ostream& out) {
  std::istringstream lines(engine_run.notes);
  int left = kMaxNotes;
  for (std::string line; std::getline(lines, line) && left-- > 0;)
    out << engine_run.name << " prints: " << line << '\n';
}

}  // namespace contactscope::app
