#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "app/options.h"
#include "app/usage.h"
#include "app/verbs.h"
#include "core/input_error.h"

namespace contactscope::app {
namespace {

struct Command {
  Options options;
  std::string size, frames, update = "never", backend;
  std::vector<std::string> layers, panels;
};

void add_common(CLI::App& verb, Command& command) {
  verb.add_option("--scenarios", command.options.scenario_root,
                  "Folder where scenario names are looked up")
      ->capture_default_str();
  verb.add_flag("--quiet", command.options.quiet, "Print results and errors only");
  verb.add_flag("--verbose", command.options.verbose,
                "Say what ran, how long it took, and what was left out");
}

void add_selection(CLI::App& verb, Command& command) {
  verb.add_option("--frames", command.frames, "Frames A:B[:STEP], B inclusive");
  verb.add_option("--reducer", command.options.reducer, "Reducer for every pair");
}

void add_rendering(CLI::App& verb, Command& command) {
  verb.add_option("--out", command.options.out, "Folder to write to")->capture_default_str();
  verb.add_option("--backend", command.backend,
                  "auto, egl or osmesa; default: $CONTACTSCOPE_BACKEND, else auto");
  verb.add_option("--view", command.options.view, "Only this view");
  verb.add_option("--jobs", command.options.jobs, "Encoder threads; 0: one a processor")
      ->check(CLI::Range(0, 256));
}

void finish(Command& command) {
  Options& options = command.options;
  if (!command.size.empty()) options.size = parse_size(command.size);
  if (!command.frames.empty()) options.frames = parse_frame_range(command.frames);
  options.layers = parse_layers(command.layers);
  options.panels = parse_panels(command.panels);
  if (options.out.empty()) throw UsageError("--out is empty; name a folder");
  options.update = parse_update(command.update);
}

// Only for verbs that draw: a bad variable must not stop the others.
void choose_backend(Command& command) {
  const char* variable = std::getenv("CONTACTSCOPE_BACKEND");
  if (!command.backend.empty()) {
    command.options.backend = parse_backend("--backend", command.backend);
  } else if (variable != nullptr && *variable != '\0') {
    command.options.backend = parse_backend("$CONTACTSCOPE_BACKEND", variable);
  }
}

std::vector<VerbOptions> verbs_of(CLI::App& program) {
  std::vector<VerbOptions> verbs;
  for (CLI::App* verb : program.get_subcommands({})) {
    VerbOptions& entry = verbs.emplace_back();
    entry.verb = verb->get_name();
    for (const CLI::Option* option : verb->get_options()) {
      for (const std::string& name : option->get_lnames()) entry.options.push_back("--" + name);
      for (const std::string& name : option->get_snames()) entry.options.push_back("-" + name);
    }
  }
  return verbs;
}

/// What was printed must have arrived, help and version too.
void flush_output() {
  std::cout.flush();
  if (!std::cout) throw UsageError("standard output could not be written; is the disk full?");
}

int run(int argc, char** argv) {
  CLI::App program("Draws and checks contact manifolds of physics engines, without a display.",
                   "contactscope");
  program.require_subcommand(1);
  program.set_version_flag("--version", std::string("contactscope ") + CONTACTSCOPE_VERSION);
  Command command;
  Options& options = command.options;

  CLI::App* render_verb = program.add_subcommand("render", "Write PNG sequences");
  render_verb
      ->add_option("SCENARIO", options.scenarios,
                   "Files, folders, or names as hull/face_contact; a trace (*.jsonl) is drawn too")
      ->required();
  render_verb->add_option("--size", command.size, "WxH, default 1280x720");
  render_verb
      ->add_option("--layers", command.layers,
                   "Layers to draw instead of the views' own, as shapes,contacts; or none")
      ->delimiter(',');
  render_verb
      ->add_option("--panels", command.panels,
                   "Panels to draw instead of the views' own, as summary,contact_plane; or none")
      ->delimiter(',');
  render_verb->add_flag("--timing", options.timing,
                        "Show the measured time of the pipeline in the summary panel");
  render_verb->add_flag("--json", options.json, "Print the paths of the pictures as JSON");
  add_selection(*render_verb, command);
  add_rendering(*render_verb, command);
  add_common(*render_verb, command);

  CLI::App* trace_verb =
      program.add_subcommand("trace", "Print the pipeline's facts as JSON lines");
  trace_verb->add_option("SCENARIO", options.scenarios, "A file or a name")
      ->required()
      ->expected(1);
  trace_verb->add_flag("--json", options.json, "Accepted; a trace is always JSON lines");
  add_selection(*trace_verb, command);
  add_common(*trace_verb, command);

  CLI::App* check_verb = program.add_subcommand("check", "Compare with the stored snapshots");
  check_verb->add_option("SCENARIO", options.scenarios, "Default: all scenarios");
  check_verb->add_option("--snapshots", options.snapshot_root, "Folder of the stored snapshots")
      ->capture_default_str();
  // A flag that may carry a value: a scenario that follows a bare --update is not taken for it.
  check_verb->add_flag("--update{failed}", command.update,
                       "Rewrite what failed, or with --update=all everything");
  check_verb->add_flag("--json", options.json, "Print the verdicts as JSON");
  add_rendering(*check_verb, command);
  add_common(*check_verb, command);

  CLI::App* explore_verb =
      program.add_subcommand("explore", "Compare all reducers on a scenario's manifolds");
  explore_verb->footer(
      "area: of the best that as many points can span. lost arm: how much shorter the lever of "
      "the\n"
      "kept points is than that of all, about the worst axis, as a share of the patch's radius "
      "(130 %\n"
      "when they are all on one side). depth error: of the plane through the kept depths. weight "
      "held:\n"
      "plumb below the centre of mass is the kept patch. ids changed: those that came or went.\n"
      "patch/bodies: the largest move of a kept point, or of their middle, from frame to frame "
      "over the\n"
      "largest move of the bodies' surfaces; inf where the bodies are at rest, - where nothing "
      "moves.\n"
      "ns: the median, the least, and the upper quartile of a call.");
  explore_verb->add_option("SCENARIO", options.scenarios, "A file or a name")
      ->required()
      ->expected(1);
  explore_verb->add_option("--size", command.size,
                           "WxH, default 1280x720, and 1280x1440 for more than 9 reducers");
  explore_verb->add_flag("--table", options.tables_only, "Write no pictures, and open no OpenGL");
  explore_verb->add_flag("--json", options.json, "Print JSON lines, one a frame and pair");
  add_selection(*explore_verb, command);
  add_rendering(*explore_verb, command);
  add_common(*explore_verb, command);

  CLI::App* study_verb =
      program.add_subcommand("study", "Measure error against run time: plot, CSV and JSON");
  study_verb->add_option("NAME", options.study, "A name that `list studies` prints")->required();
  study_verb->add_option("--size", command.size,
                         "WxH, default 1280x720, and 1280x1440 for plots of more than 9 methods");
  study_verb->add_option("--cases", options.cases, "Cases a point of a line, default: the study's")
      ->check(CLI::Range(1, 1000000));
  study_verb->add_option("--seed", options.seed, "Of the random cases")->capture_default_str();
  study_verb->add_flag("--table", options.tables_only, "Write no plots, and open no OpenGL");
  study_verb->add_flag("--json", options.json, "Print the results as JSON too, one a line");
  study_verb->add_option("--out", options.out, "Folder to write to")->capture_default_str();
  study_verb->add_option("--backend", command.backend,
                         "auto, egl or osmesa; default: $CONTACTSCOPE_BACKEND, else auto");
  add_common(*study_verb, command);

  CLI::App* doctor_verb = program.add_subcommand("doctor", "Say what each route to OpenGL answers");
  doctor_verb->add_option("FILE", options.scenarios,
                          "Scenarios and traces to look through as well: what they hold, or what "
                          "is wrong with them");
  doctor_verb->add_flag("--json", options.json, "Print as JSON");
  add_common(*doctor_verb, command);

  CLI::App* list_verb = program.add_subcommand("list", "List what a scenario may name");
  list_verb->add_option("WHAT", options.what, "scenarios, reducers, layers, panels or studies")
      ->check(CLI::IsMember({"scenarios", "reducers", "layers", "panels", "studies"}));
  list_verb->add_flag("--json", options.json, "Print as JSON");
  add_common(*list_verb, command);

  check_usage(verbs_of(program), {argv + std::min(argc, 1), argv + argc});
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // Help and version come through here too, with code 0.
    if (program.exit(error) != 0) return static_cast<int>(ExitCode::Trouble);
    flush_output();
    return static_cast<int>(ExitCode::Same);
  }
  finish(command);
  if (*render_verb || *check_verb || *explore_verb || *study_verb) choose_backend(command);
  ExitCode code = ExitCode::Same;
  if (*render_verb) code = render(options);
  if (*trace_verb) code = trace(options);
  if (*check_verb) code = check(options);
  if (*explore_verb) code = explore(options);
  if (*study_verb) code = study(options);
  if (*doctor_verb) code = doctor(options);
  if (*list_verb) code = list(options);
  flush_output();
  return static_cast<int>(code);
}

}  // namespace
}  // namespace contactscope::app

int main(int argc, char** argv) {
  using contactscope::InputError;
  try {
    return contactscope::app::run(argc, argv);
  } catch (const InputError& error) {
    std::cerr << error.what() << '\n';  // begins with the file, so that editors can jump to it
  } catch (const std::filesystem::filesystem_error& error) {
    std::cerr << "contactscope: " << error.path1().string() << ": " << error.code().message()
              << "; nothing torn is left, name a folder that can be written\n";
  } catch (const std::exception& error) {
    std::cerr << "contactscope: " << error.what() << '\n';
  }
  return static_cast<int>(contactscope::app::ExitCode::Trouble);
}
