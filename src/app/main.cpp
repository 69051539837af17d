#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <iostream>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "app/cli/catalogue.h"
#include "app/cli/check_arguments.h"
#include "app/cli/manual.h"
#include "app/cli/progress.h"
#include "app/cli/verbs.h"
#include "app/render/formats/format.h"
#include "app/render/origin.h"
#include "core/at.h"
#include "core/input_error.h"
#include "scenario/nearest_word.h"

namespace contactscope::app {
namespace {

// Parses all of `text` as an integer; nullopt if it is not one.
std::optional<int> whole_number(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t at = text.find(separator);
    parts.push_back(text.substr(0, at));
    if (at == std::string_view::npos) return parts;
    text.remove_prefix(at + 1);
  }
}

/// Nullopt if not given; "none" alone is an empty list.
template <class Word, std::size_t N>
std::optional<std::vector<Word>> parse_words(const std::string& option,
                                             const std::vector<std::string>& names,
                                             const std::array<std::string_view, N>& known) {
  if (names.empty()) return std::nullopt;
  if (names == std::vector<std::string>{"none"}) return std::vector<Word>();
  return mapped(names, [&](const std::string& name) {
    if (name == "none") throw UsageError(option + " 'none' stands alone; leave the others out");
    if (const std::optional<Word> word = word_named<Word>(known, name)) return *word;
    const std::vector<std::string_view> all(known.begin(), known.end());
    const std::string near = nearest(name, all);
    throw UsageError(
        option + " '" + name + "' is not known; " +
        (near.empty() ? "there is " + quoted_list(all) : "did you mean '" + near + "'?"));
  });
}

FrameRange parse_frame_range(const std::string& text) {
  const std::vector<std::string_view> parts = split(text, ':');
  std::vector<int> numbers;
  for (const std::string_view part : parts) {
    const std::optional<int> number = whole_number(part);
    if (!number || *number < 0) {
      throw UsageError("--frames '" + text + "' is no range; write A:B or A:B:STEP, as 0:23:4");
    }
    numbers.push_back(*number);
  }
  const FrameRange range{numbers[0], numbers.size() > 1 ? numbers[1] : numbers[0],
                         numbers.size() > 2 ? numbers[2] : 1};
  if (numbers.size() > 3 || range.step < 1 || range.last < range.first) {
    throw UsageError("--frames '" + text +
                     "' is no range; write A:B or A:B:STEP with A <= B and STEP >= 1");
  }
  return range;
}

Size parse_size(const std::string& text) {
  constexpr int kMin = 64, kMax = 8192;  // supported by every OpenGL 3.3 driver
  const auto side = [](std::string_view part) {
    const int pixels = whole_number(part).value_or(0);
    return pixels >= kMin && pixels <= kMax ? pixels : 0;
  };
  const std::vector<std::string_view> parts = split(text, 'x');
  const Size size = parts.size() == 2 ? Size{side(parts[0]), side(parts[1])} : Size{0, 0};
  if (size.width > 0 && size.height > 0) return size;
  throw UsageError("--size '" + text +
                   "' is no size; write WxH with both between 64 and 8192, as 1280x720");
}

/// Metres; 0: fitted.
std::optional<double> parse_orthographic(const std::string& text) {
  if (text.empty()) return std::nullopt;
  if (text == "fitted") return 0;
  double height = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), height);
  if (error == std::errc() && end == text.data() + text.size() && height > 0 && height < 1e9)
    return height;
  throw UsageError("--orthographic=" + text +
                   " is no height; write --orthographic, or metres as --orthographic=1.5");
}

/// `where` is the option or variable with the value.
gl::Backend parse_backend(const std::string& where, const std::string& text) {
  if (text == "auto") return gl::Backend::Auto;
  if (text == "egl") return gl::Backend::Egl;
  if (text == "osmesa") return gl::Backend::Osmesa;
  throw UsageError(where + " '" + text + "' is no route to OpenGL; it is auto, egl or osmesa");
}

struct Command : Options {
  std::string size_text, frames_text, backend_text;
  CheckTexts check;
  std::vector<std::string> layer_names, panel_names;
  std::string orthographic_text;
};

/// Adds an argument to a verb with the target of its value, and a default help text if the verb has
/// none of its own.
CLI::Option* add_named(CLI::App& verb, const std::string& name, const std::string& own_help,
                       Command& to) {
  const auto value = [&](auto& target, const char* help = "") {
    return verb.add_option(name, target, own_help.empty() ? help : own_help);
  };
  const auto value_with_default = [&](auto& target, const char* help) {
    return value(target, help)->capture_default_str();
  };
  const auto flag = [&](bool& target, const char* help = "") {
    return verb.add_flag(name, target, own_help.empty() ? help : own_help);
  };
  if (name == "SCENARIO" || name == "FILE" || name == "KEY" || name == "DIR")
    return value(to.scenarios);
  if (name == "NAME") return value(to.study);
  if (name == "WHAT") return value(to.what)->check(CLI::IsMember(kListed));
  if (name == "--size") return value(to.size_text, "WxH, default 1280x720");
  if (name == "--layers")
    return value(to.layer_names,
                 "Layers to draw instead of the views' own, as shapes,contacts; or none")
        ->allow_extra_args(false)
        ->delimiter(',');
  if (name == "--panels")
    return value(to.panel_names,
                 "Panels to draw instead of the views' own, as summary,contact_plane; or none")
        ->allow_extra_args(false)
        ->delimiter(',');
  if (name == "--format") {
    std::string help = "Formats, as png,apng:";
    for (const Format& format : formats())
      help += (help.ends_with(':') ? " " : "; ") + std::string(format.name) + " (" +
              std::string(format.what) + ")";
    return verb.add_option(name, to.formats, own_help.empty() ? help : own_help)
        ->allow_extra_args(false)
        ->delimiter(',');
  }
  if (name == "--strip")
    return value(to.strip, "One picture of so many of the frames, side by side, with one legend");
  if (name == "--columns")
    return value(to.columns, "Of the cells of --strip or --sheet; default: up to four");
  if (name == "--sheet")
    return flag(to.sheet, "One picture of all scenarios, a thumbnail of each with its name");
  if (name == "--anchors")
    return flag(to.anchors,
                "Beside each picture a JSON of where points, faces and labels are in it");
  if (name == "--fps")
    return value(to.fps, "Pictures a second of an animation, instead of the frames' own times")
        ->check(CLI::Range(0.1, 240.0));
  if (name == "--timing")
    return flag(to.timing, "Show the measured time of the pipeline in the summary panel");
  if (name == "--snapshots")
    return value_with_default(to.snapshot_root, "Folder of the stored snapshots");
  if (name == "VERB") return value(to.what);
  if (CLI::Option* const option = add_check_option(verb, name, to, to.check)) {
    if (!own_help.empty()) option->description(own_help);
    return option;
  }
  if (name == "--table") return flag(to.tables_only, "Write no pictures, and open no OpenGL");
  if (name == "--cases")
    return value(to.cases, "Cases a point of a line, default: the study's")
        ->check(CLI::Range(1, 2000000000));
  if (name == "--seed") return value_with_default(to.seed, "Of the random cases");
  if (name == "--json") return flag(to.json, "Print as JSON");
  if (name == "--frames") return value(to.frames_text, "Frames A:B[:STEP], B inclusive");
  if (name == "--reducer") return value(to.reducer, "Reducer for every pair");
  if (name == "--out") return value_with_default(to.out, "Folder to write to");
  if (name == "--backend")
    return value(to.backend_text, "auto, egl or osmesa; default: $CONTACTSCOPE_BACKEND, else auto");
  if (name == "--view")
    return value(to.view, "Only this view; of a trace FILE.toml, or FILE.toml:NAME, has the views");
  if (name == "--jobs")
    return value(to.jobs, "Encoder threads; 0: one a processor")->check(CLI::Range(0, 256));
  if (name == "--scenarios")
    return value_with_default(to.scenario_root, "Folder where scenario names are looked up");
  if (name == "--pair")
    return value(to.pair, "Show two shapes alone, A,B, and what is between them")
        ->allow_extra_args(false)
        ->delimiter(',');
  if (name == "--shapes")
    return value(to.shapes, "Show these shapes alone, as crate,floor")
        ->allow_extra_args(false)
        ->delimiter(',');
  if (name == "--eye")
    return value(to.eye, "Where the camera stands, X,Y,Z in metres")
        ->allow_extra_args(false)
        ->delimiter(',');
  if (name == "--target")
    return value(to.target, "What it looks at, X,Y,Z in metres")
        ->allow_extra_args(false)
        ->delimiter(',');
  if (name == "--camera")
    return value(to.camera, "Eye, target and field of view at once, as 4,2,4,0,0,0,30")
        ->allow_extra_args(false)
        ->delimiter(',');
  // A flag with optional value, like --update: a scenario that follows is not its value.
  if (name == "--orthographic")
    return verb.add_flag("--orthographic{fitted}", to.orthographic_text,
                         "Without perspective; --orthographic=1.5 shows so many metres of height");
  if (CLI::Option* const option = add_figure_option(verb, name, to.figure)) return option;
  if (name == "--fov")
    return value(to.fov_degrees, "Its field of view, degrees")->check(CLI::Range(1.0, 150.0));
  if (name == "--engines")
    return value(to.engines, "Engines, as contactscope,bullet; default: all that are found")
        ->allow_extra_args(false)
        ->delimiter(',');
  if (name == "--while")
    return value(to.condition, "What has to stay, as 'float.points != double.points'; see below");
  if (name == "--rollout")
    return flag(to.rollout,
                "Let each engine step a dynamic scene by itself, and judge what became of it");
  if (name == "--time-limit")
    return value_with_default(to.time_limit, "Seconds that an engine's program may take")
        ->check(CLI::Range(0.01, 1e6));
  if (name == "--quiet") return flag(to.quiet, "Print results and errors only");
  if (name == "--verbose")
    return flag(to.verbose, "Say what ran, how long it took, and what was left out");
  throw std::logic_error("no verb can take " + name);
}

void add_argument(CLI::App& app, const Verb& verb, std::string word, Command& command) {
  const bool is_optional = word.starts_with('[') || word.starts_with('-');
  const bool is_one = !word.ends_with("...");
  std::erase_if(word, [](char c) { return c == '[' || c == ']' || c == '.'; });
  const auto own = verb.help.find(word);
  CLI::Option* const option =
      add_named(app, word, own == verb.help.end() ? "" : own->second, command);
  if (is_optional) return;
  option->required();
  if (is_one) option->expected(1);
}

/// Default root for scenario names: the installed scenarios replace a missing ./scenarios.
std::string scenario_root(const std::string& named) {
  std::error_code unknown;
  if (named != Options{}.scenario_root || std::filesystem::is_directory(named, unknown))
    return named;
  const std::string installed = installed_scenarios();
  return installed.empty() ? named : installed;
}

void finish(Command& command) {
  command.scenario_root = scenario_root(command.scenario_root);
  if (!command.size_text.empty()) command.size = parse_size(command.size_text);
  command.orthographic_height = parse_orthographic(command.orthographic_text);
  finish_figure(command.figure, command.size.has_value());
  if (!command.frames_text.empty()) command.frames = parse_frame_range(command.frames_text);
  command.layers = parse_words<Layer>("--layers", command.layer_names, kLayerNames);
  command.panels = parse_words<Panel>("--panels", command.panel_names, kPanelNames);
  if (command.out.empty()) throw UsageError("--out is empty; name a folder");
  finish_check(command.check, command);
}

/// The given options in command line form, except those that do not change pictures and those that
/// each picture adds itself.
std::string given_options(const CLI::App& verb) {
  constexpr std::array<std::string_view, 12> kOwn = {
      "--anchors", "--frames", "--format",  "--out",       "--jobs", "--quiet",
      "--verbose", "--json",   "--backend", "--scenarios", "--view", "--shard"};
  std::string all;
  for (const CLI::Option* option : verb.get_options()) {
    if (option->count() == 0 || option->get_lnames().empty()) continue;
    const std::string name = "--" + option->get_lnames().front();
    if (std::ranges::find(kOwn, name) != kOwn.end()) continue;
    all += " " + name;
    if (option->get_expected_max() == 0) continue;
    std::string values;
    for (const std::string& value : option->results())
      values += (values.empty() ? "" : ",") + value;
    // A value with a leading dash looks like an option, unless it is a number.
    const bool is_dashed = values.size() > 1 && values[0] == '-' && values[1] != '.' &&
                           (values[1] < '0' || values[1] > '9');
    all += (is_dashed ? "=" : " ") + for_shell(values);
  }
  return all;
}

// Only for verbs that draw: an invalid variable must not stop the others.
void choose_backend(Command& command) {
  const char* variable = std::getenv("CONTACTSCOPE_BACKEND");
  if (!command.backend_text.empty()) {
    command.backend = parse_backend("--backend", command.backend_text);
  } else if (variable != nullptr && *variable != '\0') {
    command.backend = parse_backend("$CONTACTSCOPE_BACKEND", variable);
  }
}

/// Arguments of a verb, from its help.
ManualVerb manual_of(const Verb& verb, const CLI::App& parsed) {
  ManualVerb manual{verb.name, verb.summary, {}, verb.footer};
  for (const CLI::Option* option : parsed.get_options()) {
    if (option == parsed.get_help_ptr()) continue;
    const bool is_option = !option->get_lnames().empty();
    manual.arguments.push_back(
        {is_option ? "--" + option->get_lnames().front() : option->get_name(),
         option->get_description(), option->get_default_str(), option->get_expected_max() > 0,
         !option->get_required(), option->get_expected_max() > 1});
  }
  return manual;
}

/// Detects failed output, also after help and version.
void flush_output() {
  std::cout.flush();
  if (!std::cout) throw UsageError("standard output could not be written; is the disk full?");
}

/// `help render` becomes `render --help`.
void request_help(std::vector<std::string>& arguments) {
  if (arguments.empty() || arguments.front() != "help") return;
  arguments.erase(arguments.begin());
  if (arguments.size() > 1) arguments.resize(1);
  const bool has_verb = !arguments.empty() && arguments.front() != "--help";
  arguments.resize(has_verb ? 1 : 0);
  arguments.push_back("--help");
}

int run(int argc, char** argv) {
  CLI::App program("Draws and checks contact manifolds of physics engines, without a display.",
                   "contactscope");
  program.require_subcommand(1);
  program.set_version_flag("--version", std::string("contactscope ") + CONTACTSCOPE_VERSION);
  program.footer(
      "Exit codes: 0 the same, or done; 1 a difference, an unmet expectation or a wrong claim; 2 "
      "trouble,\nsuch as a bad file, wrong usage or no way to OpenGL; 130 stopped by Ctrl-C.\n"
      "contactscope help VERB has its options, with examples.\n"
      "contactscope --manual man, bash, zsh or fish prints the man page, or what a shell "
      "completes.");
  Command command;
  std::vector<ManualVerb> manuals;
  for (const Verb& verb : verbs()) {
    CLI::App& subcommand = *program.add_subcommand(verb.name, verb.summary);
    subcommand.footer(verb.footer);
    for (const std::string& word : arguments_of(verb))
      add_argument(subcommand, verb, word, command);
    manuals.push_back(manual_of(verb, subcommand));
  }
  if (argc > 1 && argv[1] == std::string_view("--manual")) {
    std::cout << manual(argc > 2 ? argv[2] : "", CONTACTSCOPE_VERSION, manuals);
    flush_output();
    return static_cast<int>(ExitCode::Same);
  }

  std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
  request_help(arguments);
  check_usage(arguments);
  try {
    std::ranges::reverse(arguments);  // CLI11 expects them reversed
    program.parse(arguments);
  } catch (const CLI::ParseError& error) {
    // Help and version also arrive here, with code 0.
    if (program.exit(error) != 0) return static_cast<int>(ExitCode::Trouble);
    flush_output();
    return static_cast<int>(ExitCode::Same);
  }
  finish(command);
  CLI::App& chosen = *program.get_subcommands().front();
  command.given = given_options(chosen);
  if (chosen.get_option_no_throw("--backend") != nullptr) choose_backend(command);
  const ExitCode code = std::ranges::find(verbs(), chosen.get_name(), &Verb::name)->run(command);
  flush_output();
  return static_cast<int>(code);
}

/// Each picture allocates and frees some megabytes. Returning them to the kernel causes new page
/// faults with every picture, a sixth of its time, so malloc keeps them.
void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int kMegabyte = 1 << 20;
  mallopt(M_MMAP_THRESHOLD, 32 * kMegabyte);  // the maximum
  mallopt(M_TRIM_THRESHOLD, 1024 * kMegabyte);
  mallopt(M_TOP_PAD, 16 * kMegabyte);
#endif
}

}  // namespace
}  // namespace contactscope::app

int main(int argc, char** argv) {
  using contactscope::InputError;
  contactscope::app::keep_freed_memory();
  try {
    return contactscope::app::run(argc, argv);
  } catch (const contactscope::app::Interrupted& interrupted) {
    std::cerr << "contactscope: " << interrupted.what() << '\n';
    return interrupted.exit_code();
  } catch (const InputError& error) {
    std::cerr << error.what() << '\n';  // starts with the file name, so that editors can jump to it
  } catch (const std::filesystem::filesystem_error& error) {
    std::cerr << "contactscope: " << error.path1().string() << ": " << error.code().message()
              << "; nothing torn is left, name a folder that can be written\n";
  } catch (const std::exception& error) {
    std::cerr << "contactscope: " << error.what() << '\n';
  }
  return static_cast<int>(contactscope::app::ExitCode::Trouble);
}
