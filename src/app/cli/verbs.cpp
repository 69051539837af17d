#include "app/cli/verbs.h"

#include "core/key_table.h"

namespace contactscope::app {

// Each is defined in the file of its name.
Verb render_verb(), trace_verb(), check_verb(), explore_verb(), study_verb(), doctor_verb(),
    list_verb(), lint_verb(), versus_verb(), find_verb(), diff_verb(), shrink_verb(), review_verb(),
    show_verb(), why_verb(), import_verb();

/// main.cpp turns `help render` into `render --help`.
Verb help_verb() {
  return {"help",
          "Print the options of a verb, with examples; the verbs; or the keys of a scenario",
          [](const Options&) { return ExitCode::Same; }};
}

/// manual/help.txt, embedded by the build.
std::string_view help_texts();

const std::vector<Verb>& verbs() {
  static const std::vector<Verb> all = [] {
    std::vector<Verb> list = {
        render_verb(), trace_verb(),  check_verb(),  review_verb(), show_verb(), explore_verb(),
        study_verb(),  lint_verb(),   find_verb(),   why_verb(),    diff_verb(), versus_verb(),
        shrink_verb(), import_verb(), doctor_verb(), list_verb(),   help_verb()};
    for (Verb& verb : list) {
      const std::string heading = "## " + verb.name + "\n";
      const std::string_view rest =
          help_texts().substr(help_texts().find(heading) + heading.size());
      verb.footer = rest.substr(0, std::min(rest.find("\n\n## "), rest.size() - 1));
    }
    return list;
  }();
  return all;
}

namespace {

/// "--help", and the options of a verb.
std::vector<std::string> option_names(const Verb& verb) {
  std::vector<std::string> names = {"--help"};
  for (const Option* option : options_of(verb.name))
    if (!option->is_argument()) names.push_back(option->name());
  return names;
}

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
  throw UsageError((word.empty() ? "give a verb; " : "'" + word + "' is not a verb; ") +
                   near_or_all(word, names));
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

template <class Number> void check_number(const Option& option, const std::string& text) {
  const std::optional<Number> number = number_in<Number>(text);
  const auto [low, high] = std::pair(option.values.min, option.values.max);
  std::ostringstream limits;
  limits.precision(10);
  if (low < high) limits << "; it may be " << low << " to " << high;
  const char* const kind =
      std::is_integral_v<Number> ? "' is not a whole number" : "' is not a number";
  const bool has_unit =
      number_in<double>(text.substr(0, text.find_first_not_of("+-.0123456789"))).has_value();
  if (!number && has_unit && option.value == "METRES")
    limits << "; write metres without the unit, as 0.001 for 1 mm";
  if (!number) throw UsageError(option.name() + " '" + text + kind + limits.str());
  const auto value = static_cast<double>(*number);
  if (low < high && !(value >= low && value <= high))
    throw UsageError(option.name() + " is " + text + limits.str());
}

/// Checks the text of an option or argument: a number, or one of its words.
void check_value(const Option& option, const std::string& text) {
  if (option.values.is_closed)
    word_in(option.name(), text, {option.values.words.begin(), option.values.words.end()});
  std::visit(
      [&](auto to) {
        using To = decltype(to);
        if constexpr (std::is_same_v<To, int Options::*> ||
                      std::is_same_v<To, std::optional<int> Options::*>)
          check_number<int>(option, text);
        else if constexpr (std::is_same_v<To, std::uint64_t Options::*>)
          check_number<std::uint64_t>(option, text);
        else if constexpr (std::is_same_v<To, double Options::*> ||
                           std::is_same_v<To, std::optional<double> Options::*>)
          check_number<double>(option, text);
      },
      option.to);
}

/// Checks the arguments that are not options: their number, and the words of those that have some.
void check_positional(const Verb& verb, const std::vector<std::string>& given) {
  std::size_t next = 0;
  for (const Option* option : options_of(verb.name)) {
    if (!option->is_argument()) continue;
    if (next < given.size())
      check_value(*option, given[next++]);
    else if (option->is_required())
      throw UsageError(verb.name + " needs " + option->name() + ": " +
                       std::string(option->help, 0, std::string_view(option->help).find("; see")));
    if (option->repeats()) return;
  }
  if (next < given.size())
    throw UsageError(
        verb.name + (next == 0 ? " takes no argument" : " takes only one argument") + ", and '" +
        given[next] + "' is one more; leave it out" +
        (next == 0 ? "" : ", run the verb once for each, or name shapes by --pair=A,B"));
}

}  // namespace

void check_usage(const std::vector<std::string>& arguments) {
  if (arguments.empty()) refuse_verb("");
  const std::string& word = arguments.front();
  const auto verb = std::ranges::find(verbs(), word, &Verb::name);
  if (verb == verbs().end()) {
    if (word != "--help" && word != "-h" && word != "--version") refuse_verb(word);
    return;
  }
  std::vector<std::string> positional;
  bool is_help = false;
  for (std::size_t i = 1; i < arguments.size(); ++i) {
    if (arguments[i] == "--") {
      positional.insert(positional.end(), arguments.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                        arguments.end());
      break;
    }
    const std::string name = option_name(arguments[i]);
    if (name.empty()) {
      positional.push_back(arguments[i]);
      continue;
    }
    if (!has_option(*verb, name)) refuse_option(name, *verb);
    const std::vector<const Option*> options = options_of(verb->name);
    const auto option = std::ranges::find(options, name, &Option::name);
    is_help = is_help || option == options.end();
    if (option == options.end() || !(*option)->takes_value()) continue;
    const std::size_t equals = arguments[i].find('=');
    const bool is_next = equals == std::string::npos;
    if (is_next && (++i == arguments.size() || has_option(*verb, option_name(arguments[i]))))
      throw UsageError(name + " needs a value; write " + name + " " + (*option)->value);
    const std::string value = is_next ? arguments[i] : arguments[i].substr(equals + 1);
    if (!std::holds_alternative<std::vector<double> Options::*>((*option)->to)) {
      check_value(**option, value);
      continue;
    }
    std::string with_commas = value;
    while (i + 1 < arguments.size() && number_in<double>(arguments[i + 1]))
      with_commas += "," + arguments[++i];
    if (with_commas != value)
      throw UsageError("the numbers of " + name + " have commas between them; write " + name + " " +
                       with_commas);
    std::istringstream parts(value);
    for (std::string part; std::getline(parts, part, ',');)
      if (!number_in<double>(part))
        throw UsageError(name + " '" + value + "': '" + part + "' is not a number; write " + name +
                         " " + (*option)->value);
  }
  if (!is_help) check_positional(*verb, positional);
}

}  // namespace contactscope::app
