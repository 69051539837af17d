#include <CLI/CLI.hpp>
#include <iostream>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "app/cli/progress.h"
#include "app/render/figure_canvas.h"

namespace contactscope::app {
namespace {

/// Adds an option with its target. Texts with a reader go nowhere yet: read_texts() reads them when
/// the command line is known to be complete.
CLI::Option* add_targeted(CLI::App& verb, const Option& option, Options& to) {
  static std::string text;
  static std::vector<std::string> texts;
  const std::string name = option.name();
  if (!option.values.implied.empty())
    return verb.add_flag(name + "{" + option.values.implied + "}", text);
  return std::visit(
      [&](auto target) {
        using To = decltype(target);
        if constexpr (std::is_same_v<To, bool Options::*>) {
          return verb.add_flag(name, to.*target);
        } else if constexpr (std::is_same_v<To, Reader>) {
          return option.repeats() ? verb.add_option(name, texts) : verb.add_option(name, text);
        } else {
          return verb.add_option(name, to.*target);
        }
      },
      option.to);
}

void add(CLI::App& verb, const Option& option, Options& to) {
  CLI::Option* const added = add_targeted(verb, option, to)->description(option.description());
  if (!option.value.empty()) added->option_text(option.value);
  if (!option.is_argument() && option.repeats()) added->allow_extra_args(false)->delimiter(',');
  if (option.is_required()) added->required();
  if (option.is_required() && !option.repeats()) added->expected(1)->allow_extra_args(false);
}

/// Text of an option on the command line, several values with commas between them; nullopt if it is
/// not given. An empty text is none, an empty list is one of an empty name.
std::optional<std::string> text_of(const CLI::App& verb, const Option& option) {
  const CLI::Option& parsed = *verb.get_option(option.name());
  if (parsed.count() == 0) return std::nullopt;
  if (option.repeats()) return CLI::detail::join(parsed.results(), ",");
  const auto text = parsed.as<std::string>();
  return text.empty() ? std::nullopt : std::optional(text);
}

void read_texts(const CLI::App& verb, Options& to) {
  for (const Option* option : options_of(verb.get_name())) {
    const auto* const reader = std::get_if<Reader>(&option->to);
    if (reader == nullptr) continue;
    if (const std::optional<std::string> text = text_of(verb, *option))
      (*reader)(to, option->name(), *text);
    else if (option->name() == "--backend")
      use_backend_of_environment(to);  // only for verbs that draw
  }
}

/// The recorded options that are given, in command line form.
std::string given_options(const CLI::App& verb) {
  std::string all;
  for (const Option* option : options_of(verb.get_name())) {
    const std::string name = option->name();
    if (option->is_argument() || !option->is_recorded || verb.count(name) == 0) continue;
    all += " " + name;
    const std::string& implied = option->values.implied;
    if (!implied.empty() && text_of(verb, *option) != implied)
      all += "=" + text_of(verb, *option).value_or("");
    if (!option->takes_value()) continue;
    const std::string values = CLI::detail::join(verb.get_option(name)->results(), ",");
    // A value with a leading dash looks like an option, unless it is a number.
    const bool is_dashed = values.size() > 1 && values[0] == '-' && values[1] != '.' &&
                           (values[1] < '0' || values[1] > '9');
    all += (is_dashed ? "=" : " ") + for_shell(values);
  }
  return all;
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

ExitCode run(int argc, char** argv) {
  CLI::App program("Draws and checks contact manifolds of physics engines, without a display.",
                   "contactscope");
  program.require_subcommand(1);
  program.set_version_flag("--version", std::string("contactscope ") + CONTACTSCOPE_VERSION);
  program.footer(
      "Exit codes: 0 done, no difference; 1 a difference, an unmet expectation or a wrong claim; 2 "
      "an "
      "error,\nsuch as a bad file, wrong usage or no OpenGL; 130 stopped by Ctrl-C.\n"
      "contactscope help VERB prints its options, with examples; contactscope help scenario all "
      "keys of a "
      "scenario.\n"
      "contactscope --manual man, bash, zsh or fish prints the man page or the completions of a "
      "shell.");
  Options options;
  for (const Verb& verb : verbs()) {
    CLI::App& subcommand = *program.add_subcommand(verb.name, verb.summary);
    subcommand.footer(verb.footer);
    for (const Option* option : options_of(verb.name)) add(subcommand, *option, options);
  }
  std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
  const std::string first = arguments.empty() ? "" : arguments.front();
  if (first == "--manual" || first == "--complete") {
    std::cout << (first == "--manual" ? manual(argc > 2 ? argv[2] : "", CONTACTSCOPE_VERSION)
                                      : completions({arguments.begin() + 1, arguments.end()}));
    return ExitCode::Same;
  }

  std::string format;  // keys, after the help of a verb
  if (arguments.size() == 2 && arguments[0] == "help") format = reference(arguments[1]);
  if (arguments.size() == 2 && arguments[1] == "scenario" && !format.empty()) {
    std::cout << format;
    return ExitCode::Same;
  }
  request_help(arguments);
  check_usage(arguments);
  try {
    std::ranges::reverse(arguments);  // CLI11 expects them reversed
    program.parse(arguments);
  } catch (const CLI::ParseError& error) {
    // Help and version also arrive here, with code 0.
    if (error.get_exit_code() != 0) throw UsageError(error.what());
    program.exit(error);
    std::cout << format;
    return ExitCode::Same;
  }
  const CLI::App& chosen = *program.get_subcommands().front();
  read_texts(chosen, options);
  finish(options);
  options.given = given_options(chosen);
  return std::ranges::find(verbs(), chosen.get_name(), &Verb::name)->run(options);
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
    const contactscope::app::ExitCode code = contactscope::app::run(argc, argv);
    contactscope::app::flush_output();
    return static_cast<int>(code);
  } catch (const contactscope::app::Interrupted& interrupted) {
    std::cerr << "contactscope: " << interrupted.what() << '\n';
    return interrupted.exit_code();
  } catch (const InputError& error) {
    std::cerr << error.what() << '\n';  // starts with the file name, so that editors can jump to it
  } catch (const std::filesystem::filesystem_error& error) {
    std::cerr << "contactscope: " << error.path1().string() << ": " << error.code().message()
              << "; no incomplete file is left. Give a folder that can be written\n";
  } catch (const std::exception& error) {
    std::cerr << "contactscope: " << error.what() << '\n';
  }
  return static_cast<int>(contactscope::app::ExitCode::Trouble);
}
