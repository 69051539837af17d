#include "app/verbs.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <sstream>

#include "scenario/nearest_word.h"

namespace contactscope::app {

// Each is in the file of its name.
Verb render_verb(), trace_verb(), check_verb(), explore_verb(), study_verb(), doctor_verb(),
    list_verb(), lint_verb(), versus_verb();

const std::vector<Verb>& verbs() {
  static const std::vector<Verb> all = {render_verb(),  trace_verb(),  check_verb(),
                                        explore_verb(), study_verb(),  lint_verb(),
                                        versus_verb(),  doctor_verb(), list_verb()};
  return all;
}

std::vector<std::string> arguments_of(const Verb& verb) {
  std::istringstream words(verb.arguments + " --scenarios --quiet --verbose");
  return {std::istream_iterator<std::string>(words), {}};
}

namespace {

std::vector<std::string> options_of(const Verb& verb) {
  std::vector<std::string> names = {"--help", "-h"};
  for (const std::string& word : arguments_of(verb))
    if (word.starts_with('-')) names.push_back(word);
  return names;
}

bool has_option(const Verb& verb, const std::string& option) {
  return std::ranges::count(options_of(verb), option) > 0;
}

/// "--out" of "--out=DIR", "-h"; empty of what is no option, as "-1".
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
    throw UsageError("'" + word + "' stands before the verb; write contactscope VERB " + word +
                     ", where VERB is one of " + quoted_list(names));
  throw UsageError("'" + word + "' is no verb; " + did_you_mean(word, names) + "there is " +
                   quoted_list(names));
}

[[noreturn]] void refuse_option(const std::string& option, const Verb& verb) {
  const std::string what = verb.name + " has no option " + option + "; ";
  std::vector<std::string_view> others;
  for (const Verb& other : verbs())
    if (has_option(other, option)) others.push_back(other.name);
  const std::vector<std::string> names = options_of(verb);
  const std::vector<std::string_view> known(names.begin(), names.end());
  const std::string near = nearest(option, known);
  if (!near.empty()) throw UsageError(what + "did you mean " + near + "?");
  if (!others.empty())
    throw UsageError(what + "it is one of " + quoted_list(others) + ", leave it out here");
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
    if (arguments[i] == "--") return;  // all after it is positional
    const std::string option = option_name(arguments[i]);
    if (!option.empty() && !has_option(*verb, option)) refuse_option(option, *verb);
  }
}

}  // namespace contactscope::app
