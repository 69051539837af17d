#include "app/cli/verbs.h"
#include "scenario/scenario.h"
#include "trace/json.h"

namespace contactscope::app {

/// The files in manual, embedded by the build.
std::string_view man_page_end();
std::string_view bash_completion();
std::string_view zsh_completion();
std::string_view fish_completion();

namespace {

/// Escapes text for roff: hyphens that can be copied, and no line that looks like a request.
std::string roff(const std::string& text) {
  std::string escaped;
  bool begins_line = true;
  for (const char c : text) {
    if (begins_line && (c == '.' || c == '\'')) escaped += "\\&";
    if (c == '-')
      escaped += "\\-";
    else if (c == '\\')
      escaped += "\\e";
    else
      escaped += c;
    begins_line = c == '\n';
  }
  return escaped;
}

void print_option(const Option& option, std::ostream& out) {
  out << ".TP\n.B " << roff(option.name());
  if (!option.is_argument() && option.takes_value()) out << " \\fI" << roff(option.value) << "\\fR";
  out << '\n' << roff(option.description());
  // The words, unless the help names them.
  const std::vector<std::string>& words = option.values.words;
  if (!words.empty() && option.help.find(words.back()) == std::string::npos)
    out << "; one of " << separated(words, ", ", roff);
  out << '\n';
}

void print_verb(const Verb& verb, std::ostream& out) {
  out << ".SS \"contactscope " << roff(verb.name);
  const std::vector<const Option*> options = options_of(verb.name);
  for (const Option* option : options)
    if (option->is_argument()) out << ' ' << roff(option->usage);
  out << " [OPTIONS]\"\n" << roff(verb.summary) << ".\n";
  for (const Option* option : options) print_option(*option, out);
  if (!verb.footer.empty()) out << ".PP\n.nf\n" << roff(verb.footer) << "\n.fi\n";
}

using Kind = OptionValues::Kind;

std::string line_of(const std::string& word, std::string description) {
  std::ranges::replace(description, '\n', ' ');
  return word + "\t" + description + "\n";
}

/// `before` is the part of the word that stays; lists also keep what is `typed` before the last
/// comma.
std::string values_of(const OptionValues& values, std::string before, const std::string& typed) {
  std::vector<std::string> words = values.words;
  if (values.kind == Kind::List) before += typed.substr(0, typed.rfind(',') + 1);
  if (values.kind == Kind::Scenario) {
    Options options;
    finish(options);  // finds the folder of scenarios
    for (const std::string& file : scenario_files(options.scenario_root))
      words.push_back(scenario_name(file));
  }
  std::string lines;
  for (const std::string& word : words) lines += before + word + "\n";
  if (values.kind == Kind::Scenario || values.kind == Kind::File) lines += ":files\n";
  if (values.kind == Kind::Folder) lines += ":folders\n";
  if (values.kind == Kind::List) lines += ":nospace\n";
  return lines;
}

std::string man_page(const std::string& version) {
  std::ostringstream out;
  out << ".TH CONTACTSCOPE 1 \"\" \"contactscope " << roff(version) << "\" \"User Commands\"\n"
      << ".SH NAME\ncontactscope \\- draw and check contact manifolds of physics engines\n"
      << ".SH SYNOPSIS\n.B contactscope\n.I VERB\n[OPTIONS]\n.br\n.B contactscope\n"
      << "\\-\\-help | \\-\\-version | \\-\\-manual man|bash|zsh|fish\n"
      << ".SH DESCRIPTION\n"
      << "Runs a contact pipeline on scripted scenarios, or takes the trace of another engine, "
         "draws\n"
      << "every stage to PNG sequences without a display, and compares traces and pictures with\n"
      << "stored snapshots. \\-\\-help after a verb lists its options.\n"
      << ".SH VERBS\n";
  for (const Verb& verb : verbs()) print_verb(verb, out);
  out << man_page_end();
  return out.str();
}

}  // namespace

std::string manual(const std::string& what, const std::string& version) {
  if (what == "man") return man_page(version);
  if (what == "bash") return std::string(bash_completion());
  if (what == "zsh") return std::string(zsh_completion());
  if (what == "fish") return std::string(fish_completion());
  throw UsageError("--manual '" + what + "' is not known; it is man, bash, zsh or fish");
}

std::string reference(const std::string& what) {
  if (what == "scenario") {
    return "A scenario is a TOML file, GROUP/IDEA.toml. Its keys:\n\n" +
           printed(scenario_file::key_tables()) +
           "\ncontactscope list prints the names of layers, panels and reducers.\n";
  }
  if (what != "trace") return {};
  return "\nA trace is JSON lines: a header, then one line for each frame. Its keys:\n\n" +
         printed(trace::fact_tables());
}

std::string completions(std::vector<std::string> words) {
  std::string typed = words.empty() ? "" : words.back(), before;
  if (!words.empty()) words.pop_back();
  // --option=value is three words to bash.
  if (typed == "=") typed.clear();
  std::erase(words, "=");
  std::string lines;
  if (words.empty()) {
    for (const Verb& verb : verbs()) lines += line_of(verb.name, verb.summary);
    return lines + "--help\n--version\n--manual\n";
  }
  if (words.back() == "--manual") return "man\nbash\nzsh\nfish\n";
  std::string name = words.back();
  if (const std::size_t end = typed.find('='); typed.starts_with("--") && end != typed.npos) {
    name = typed.substr(0, end);
    before = typed.substr(0, end + 1);
    typed.erase(0, end + 1);
  }
  const std::vector<const Option*> options = options_of(words.front());
  for (const Option* option : options)
    if (option->name() == name && !option->is_argument() && option->takes_value())
      return values_of(option->values, before, typed);
  if (typed.starts_with('-')) {
    for (const Option* option : options)
      if (!option->is_argument()) lines += line_of(option->name(), option->description());
    return lines + line_of("--help", "Print the options");
  }
  for (const Option* option : options) {
    if (!option->is_argument()) continue;
    lines += values_of(option->values, "", typed);
    if (words.size() == 1) break;  // the verb is followed by its first argument
  }
  return lines;
}

}  // namespace contactscope::app
