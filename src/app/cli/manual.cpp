#include <algorithm>
#include <sstream>

#include "app/cli/verbs.h"
#include "scenario/keys.h"
#include "scenario/scenario.h"
#include "trace/reference.h"

namespace contactscope::app {
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
  if (!words.empty() && option.help.find(words.back()) == std::string::npos) {
    const char* before = "; one of ";
    for (const std::string& word : words) {
      out << before << roff(word);
      before = ", ";
    }
  }
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

constexpr const char* kEnd = R"(.SH EXIT STATUS
.TP
.B 0
done, no difference
.TP
.B 1
a difference, an unmet expectation or a wrong claim
.TP
.B 2
an error: a bad file, wrong usage, or no OpenGL
.SH ENVIRONMENT
.TP
.B CONTACTSCOPE_BACKEND
auto, egl or osmesa; \-\-backend overrides it
.TP
.B CI
true or 1: check writes no snapshots
.SH FILES
.TP
.I scenarios/*/*.toml
scenarios; \(lqcontactscope list scenarios\(rq prints their names
.TP
.I *.jsonl
traces of this program or of other engines; see src/trace/README.md of its sources
.SH EXAMPLES
.nf
contactscope render hull/face_contact
contactscope render run.jsonl \-\-pair crate,floor \-\-panels summary,plots
contactscope lint run.jsonl
contactscope check
.fi
)";

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

constexpr const char* kBash =
    R"bash(# bash completion of contactscope; made by contactscope --manual bash

_contactscope() {
  local cur=${COMP_WORDS[COMP_CWORD]} word
  if [ "$cur" = = ]; then cur=; fi
  COMPREPLY=()
  while IFS= read -r word; do
    word=${word%%$'\t'*}
    case $word in
      :files) COMPREPLY+=($(compgen -f -- "$cur")) ;;
      :folders) COMPREPLY+=($(compgen -d -- "$cur")) ;;
      :nospace) compopt -o nospace 2>/dev/null || true ;;
      "$cur"*)
        [[ $word == *[!A-Za-z0-9_./+@%:,=~-]* ]] && word=$(printf %q "$word")
        COMPREPLY+=("$word") ;;
    esac
  done < <(contactscope --complete "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null)
}
complete -o bashdefault -F _contactscope contactscope
)bash";

constexpr const char* kZsh = R"zsh(#compdef contactscope
# zsh completion of contactscope; made by contactscope --manual zsh

local line
local -a found space
for line in ${(f)"$(contactscope --complete "${(@Q)words[2,CURRENT]}" 2>/dev/null)"}; do
  case $line in
    :files) _files ;;
    :folders) _files -/ ;;
    :nospace) space=(-S '') ;;
    *) found+=("${${line//:/\\:}/$'\t'/:}") ;;
  esac
done
_describe contactscope found $space
)zsh";

constexpr const char* kFish =
    R"fish(# fish completion of contactscope; made by contactscope --manual fish

function __contactscope_complete
    set -l typed (commandline -ct)
    set -l words (commandline -opc)
    for line in (contactscope --complete $words[2..-1] "$typed" 2>/dev/null)
        switch $line
            case :files
                __fish_complete_path "$typed"
            case :folders
                __fish_complete_directories "$typed"
            case :nospace
            case '*'
                echo $line
        end
    end
end
complete -c contactscope -f -a '(__contactscope_complete)'
)fish";

}  // namespace

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
  out << kEnd;
  return out.str();
}

std::string manual(const std::string& what, const std::string& version) {
  if (what == "man") return man_page(version);
  if (const std::string script = completion_script(what); !script.empty()) return script;
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

std::string completion_script(const std::string& shell) {
  if (shell == "bash") return kBash;
  if (shell == "zsh") return kZsh;
  return shell == "fish" ? kFish : "";
}

}  // namespace contactscope::app
