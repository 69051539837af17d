#include "app/usage.h"

#include <algorithm>
#include <cctype>

#include "app/options.h"
#include "scenario/nearest_word.h"

namespace contactscope::app {
namespace {

/// "--out" of "--out=DIR", "-h"; empty of what is no option, as "-1".
std::string option_name(const std::string& argument) {
  const bool longer = argument.starts_with("--");
  const std::size_t first = longer ? 2 : 1;
  if (!argument.starts_with('-') || argument.size() <= first) return {};
  if (std::isalpha(static_cast<unsigned char>(argument[first])) == 0) return {};
  return longer ? argument.substr(0, argument.find('=')) : argument;
}

[[noreturn]] void refuse_verb(const std::string& word, const std::vector<VerbOptions>& verbs) {
  std::vector<std::string_view> names;
  for (const VerbOptions& verb : verbs) names.push_back(verb.verb);
  if (!option_name(word).empty())
    throw UsageError("'" + word + "' stands before the verb; write contactscope VERB " + word +
                     ", where VERB is one of " + quoted_list(names));
  const std::string near = nearest(word, names);
  throw UsageError("'" + word + "' is no verb; " +
                   (near.empty() ? "" : "did you mean '" + near + "'? ") + "there is " +
                   quoted_list(names));
}

[[noreturn]] void refuse_option(const std::string& option, const VerbOptions& verb,
                                const std::vector<VerbOptions>& verbs) {
  const std::string what = verb.verb + " has no option " + option + "; ";
  std::vector<std::string_view> others;
  for (const VerbOptions& other : verbs) {
    if (std::ranges::find(other.options, option) != other.options.end())
      others.push_back(other.verb);
  }
  const std::vector<std::string_view> known(verb.options.begin(), verb.options.end());
  const std::string near = nearest(option, known);
  if (!near.empty()) throw UsageError(what + "did you mean " + near + "?");
  if (!others.empty())
    throw UsageError(what + "it is one of " + quoted_list(others) + ", leave it out here");
  throw UsageError(what + "it has " + quoted_list(known));
}

}  // namespace

void check_usage(const std::vector<VerbOptions>& verbs, const std::vector<std::string>& arguments) {
  if (arguments.empty()) return;
  const auto verb = std::ranges::find(verbs, arguments.front(), &VerbOptions::verb);
  if (verb == verbs.end()) {
    const std::string& word = arguments.front();
    if (word != "--help" && word != "-h" && word != "--version") refuse_verb(word, verbs);
    return;
  }
  for (std::size_t i = 1; i < arguments.size(); ++i) {
    if (arguments[i] == "--") return;  // all after it is positional
    const std::string option = option_name(arguments[i]);
    if (option.empty() || std::ranges::find(verb->options, option) != verb->options.end()) continue;
    refuse_option(option, *verb, verbs);
  }
}

}  // namespace contactscope::app
