#include "app/contenders.h"

#include <sstream>

#include "app/trace_file.h"
#include "core/input_error.h"
#include "scenario/nearest_word.h"
#include "versus/engine.h"
#include "versus/request.h"

namespace contactscope::app {
namespace {

constexpr int kMostNotes = 5;  // lines of an engine's messages

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

std::vector<std::string> engines_asked(const Options& options) {
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
                       " beside contactscope or in $PATH; found are " + quoted_list(views));
    }
    programs[name] = *program;
  }
  return programs;
}

versus::Contender ask(const std::string& name, const std::string& program,
                      const std::string& question, const trace::Trace& request, double limit) {
  versus::Contender contender{name, "", "", "", "", {}};
  versus::Answer answer = versus::run_program(program, {question}, versus::to_text(request), limit);
  contender.failure = answer.failure;
  contender.notes = answer.said;
  if (question == "rollout" && answer.exit_code == versus::kNoRollout) {
    contender.refusal = last_words(answer.said);
    return contender;
  }
  // Drop the incomplete line of a crashed program.
  if (!answer.failure.empty() && !answer.out.empty())
    answer.out.erase(answer.out.find_last_of('\n') + 1);
  if (answer.failure.empty() || !answer.out.empty())
    contender.trace = read_answer(answer.out, name + "'s answer", contender.failure);
  contender.engine = contender.trace.header.engine;
  contender.version = contender.trace.header.version;
  // The shapes are those of the request, whatever the engine wrote.
  contender.trace.header.shapes = request.header.shapes;
  const std::size_t asked = request.frames.size(), told = contender.trace.frames.size();
  if (contender.failure.empty() && told < asked)
    contender.failure =
        "it answered " + std::to_string(told) + " of " + std::to_string(asked) + " frames";
  return contender;
}

void print_words(const versus::Contender& contender, std::ostream& out) {
  std::istringstream lines(contender.notes);
  int left = kMostNotes;
  for (std::string line; std::getline(lines, line) && left-- > 0;)
    out << contender.name << " says: " << line << '\n';
}

}  // namespace contactscope::app
