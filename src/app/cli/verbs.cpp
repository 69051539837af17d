#include "app/cli/verbs.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <sstream>

#include "scenario/nearest_word.h"

namespace contactscope::app {

// Each is defined in the file of its name.
Verb render_verb(), trace_verb(), check_verb(), explore_verb(), study_verb(), doctor_verb(),
    list_verb(), lint_verb(), versus_verb(), shrink_verb(), review_verb(), show_verb(),
    merge_verb(), help_verb();

namespace {

/// Examples below the options of a verb that has none of its own.
const char* examples_of(const std::string& verb) {
  if (verb == "render")
    return "Examples:\n"
           "  contactscope render hull/face_contact\n"
           "  contactscope render hull/face_contact --format svg,pdf --frames 12\n"
           "  contactscope render run.jsonl --pair crate,floor --camera 4,2,4,0,0,0,30\n"
           "Exit codes: 0 done, 2 trouble.";
  if (verb == "trace")
    return "Examples:\n"
           "  contactscope trace hull/face_contact | jq .pairs\n"
           "Exit codes: 0 done, 2 trouble.";
  if (verb == "explore")
    return "Examples:\n"
           "  contactscope explore hull/eight_points_to_four\n"
           "  contactscope explore run.jsonl --table\n"
           "Exit codes: 0 done, 2 trouble.";
  if (verb == "study")
    return "Examples:\n"
           "  contactscope study reducers --cases 100 --seed 2\n"
           "  contactscope study stability --cases 100000000 --shard 1/64 --out soak\n"
           "  contactscope list studies\n"
           "Exit codes: 0 done, 1 a pair of --shard has a wrong answer, 2 trouble.";
  if (verb == "lint")
    return "Examples:\n"
           "  contactscope lint run.jsonl\n"
           "Exit codes: 0 nothing is wrong, 1 a claim is, 2 trouble.";
  if (verb == "versus")
    return "Examples:\n"
           "  contactscope versus round --engines contactscope,bullet\n"
           "  contactscope versus solver/stack_of_ten --rollout\n"
           "Exit codes: 0 every engine is right, 1 one is not, 2 trouble.";
  if (verb == "doctor")
    return "Examples:\n"
           "  contactscope doctor\n"
           "  contactscope doctor run.jsonl\n"
           "Exit codes: 0 pictures can be drawn and nothing is wrong, 1 something is, 2 trouble.";
  if (verb == "list")
    return "Examples:\n"
           "  contactscope list scenarios\n"
           "Exit codes: 0 done, 2 trouble.";
  if (verb == "review")
    return "Examples:\n"
           "  contactscope review\n"
           "  contactscope review --list | grep ^changed\n"
           "  contactscope review --from decisions.json\n"
           "Exit codes: 0 nothing fails any more, 1 something does, 2 trouble.";
  if (verb == "merge")
    return "Examples:\n"
           "  contactscope merge shards --out out --junit junit.xml\n"
           "  contactscope merge soak\n"
           "Exit codes: 0 the same, 1 something is not, 2 trouble, such as a part that is missing.";
  if (verb == "help")
    return "Examples:\n"
           "  contactscope help check\n"
           "Exit codes: 0 done, 2 there is no such verb.";
  return "";
}

std::vector<Verb> with_examples(std::vector<Verb> verbs) {
  for (Verb& verb : verbs) {
    if (verb.footer.find("Examples:") != std::string::npos) continue;
    verb.footer += (verb.footer.empty() ? "" : "\n\n") + std::string(examples_of(verb.name));
  }
  return verbs;
}

}  // namespace

const std::vector<Verb>& verbs() {
  static const std::vector<Verb> all =
      with_examples({render_verb(), trace_verb(), check_verb(), review_verb(), show_verb(),
                     explore_verb(), study_verb(), lint_verb(), versus_verb(), shrink_verb(),
                     doctor_verb(), list_verb(), merge_verb(), help_verb()});
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
    if (arguments[i] == "--") return;  // the rest is positional
    const std::string option = option_name(arguments[i]);
    if (!option.empty() && !has_option(*verb, option)) refuse_option(option, *verb);
  }
}

}  // namespace contactscope::app
