#include "app/cli/verbs.h"

#include <algorithm>
#include <cctype>

#include "scenario/nearest_word.h"

namespace contactscope::app {

// Each is defined in the file of its name.
Verb render_verb(), trace_verb(), check_verb(), explore_verb(), study_verb(), doctor_verb(),
    list_verb(), lint_verb(), versus_verb(), find_verb(), diff_verb(), shrink_verb(), review_verb(),
    show_verb(), merge_verb();

/// main.cpp turns `help render` into `render --help`.
Verb help_verb() {
  return {"help", "Print the options of a verb, with examples; or the verbs",
          [](const Options&) { return ExitCode::Same; },
          "Examples:\n"
          "  contactscope help check\n"
          "Exit codes: 0 done, 2 there is no such verb."};
}

const std::vector<Verb>& verbs() {
  static const std::vector<Verb> all = {render_verb(), trace_verb(),   check_verb(),  review_verb(),
                                        show_verb(),   explore_verb(), study_verb(),  lint_verb(),
                                        find_verb(),   diff_verb(),    versus_verb(), shrink_verb(),
                                        doctor_verb(), list_verb(),    merge_verb(),  help_verb()};
  return all;
}

std::vector<std::string> option_names(const Verb& verb) {
  std::vector<std::string> names = {"--help"};
  for (const Option* option : options_of(verb.name))
    if (!option->is_argument()) names.push_back(option->name());
  return names;
}

namespace {

bool has_option(const Verb& verb, const std::string& option) {
  return option == "-h" || std::ranges::count(option_names(verb), option) > 0;
}

/// "--out" for "--out=DIR", "-h"; empty for arguments that are not options, such as "-1".
std::string option_name(const std::string& argument) {
  const bool longer = argument.starts_with("--");
  const std::size_t first = longer ? 2 : 1;
  if (!argument.starts_with('-') || argument.size() <= first) return {};
  if (std::isalpha(static_cast<unsigned char>(argument[first])) == 0) return {};
  return longer ? argument.substr(0, argument.find('=')) : argument;
}

[[noreturn]] void refuse_verb(const std::string& word) {
  const std::vector<std::string_view> names = names_in(verbs());
  if (!option_name(word).empty())
    throw UsageError("'" + word + "' is before the verb; write contactscope VERB " + word +
                     ", where VERB is one of " + quoted_list(names));
  throw UsageError("'" + word + "' is not a verb; " + did_you_mean(word, names) + "there is " +
                   quoted_list(names));
}

[[noreturn]] void refuse_option(const std::string& option, const Verb& verb) {
  const std::string what = verb.name + " has no option " + option + "; ";
  std::vector<std::string_view> others;
  for (const Verb& other : verbs())
    if (has_option(other, option)) others.push_back(other.name);
  std::vector<std::string> names = option_names(verb);
  names.insert(names.begin() + 1, "-h");
  const std::vector<std::string_view> known(names.begin(), names.end());
  const std::string near = nearest(option, known);
  if (!near.empty()) throw UsageError(what + "did you mean " + near + "?");
  if (!others.empty())
    throw UsageError(what + "it is an option of " + quoted_list(others) + "; leave it out here");
  throw UsageError(what + "it has " + quoted_list(known));
}

}  // namespace

void check_usage(const std::vector<std::string>& arguments) {
  if (arguments.empty()) return;
  const std::string& word = arguments.front();
  const auto verb = std::ranges::find(verbs(), word, &Verb::name);
  if (verb == verbs().end()) {
    if (word != "--help" && word != "-h" && word != "--version") refuse_verb(word);
    return;
  }
  for (std::size_t i = 1; i < arguments.size(); ++i) {
    if (arguments[i] == "--") return;  // the rest is positional
    const std::string option = option_name(arguments[i]);
    if (!option.empty() && !has_option(*verb, option)) refuse_option(option, *verb);
  }
}

}  // namespace contactscope::app
