#include <map>
#include <set>
#include <sstream>

#include "app/cli/verbs.h"
#include "core/at.h"

namespace contactscope::app {
namespace {

using Kind = OptionValues::Kind;

// Scenario names come from the program, which knows the folder.
constexpr const char* kNames = "contactscope list scenarios 2>/dev/null | sed 's/  .*//'";

std::string spaced(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

/// Single-quotes a string for a shell; `quote` is the escaped quote.
std::string quoted(const std::string& text, const std::string& quote) {
  std::string escaped = "'";
  for (const char c : text) escaped += c == '\'' ? quote : std::string(1, c);
  return escaped + "'";
}

/// Puts a backslash before each character of `special`.
std::string escaped(const std::string& text, std::string_view special) {
  std::string all;
  for (const char c : text) {
    if (special.find(c) != std::string_view::npos) all += '\\';
    all += c == '\n' ? ' ' : c;
  }
  return all;
}

/// The first argument of a verb; null if it takes none.
const Option* argument_of(const Verb& verb) {
  for (const Option* option : options_of(verb.name))
    if (option->is_argument()) return option;
  return nullptr;
}

/// Completion of a value in each shell; % stands for the words.
struct Snippets {
  std::string bash;  // sets COMPREPLY
  std::string zsh;   // action of _arguments
  std::string fish;  // end of a `complete` line
};

Snippets snippets_of(const OptionValues& values) {
  static const std::string names = kNames;
  static const std::map<Kind, Snippets> all = {
      {Kind::Free, {"", " ", " -x"}},
      {Kind::Words, {"COMPREPLY=($(compgen -W '%' -- \"$cur\"))", "(%)", " -x -a '%'"}},
      {Kind::List,
       {"_contactscope_list '%'", "_values -s , word %",
        R"fish( -x -a "(__fish_complete_list , 'string split \' \' \'%\'')")fish"}},
      {Kind::Scenario,
       {"_contactscope_words < <(" + names + "; compgen -f -- \"$cur\")", "_contactscope_scenarios",
        " -a \"(" + names + ")\""}},
      {Kind::File, {"COMPREPLY=($(compgen -f -- \"$cur\"))", "_files", " -r -F"}},
      {Kind::Folder,
       {"COMPREPLY=($(compgen -d -- \"$cur\"))", "_files -/",
        " -x -a '(__fish_complete_directories)'"}},
  };
  Snippets snippets = all.at(values.kind);
  if (values.words.empty()) return snippets;
  for (std::string* snippet : {&snippets.bash, &snippets.zsh, &snippets.fish})
    snippet->replace(snippet->find('%'), 1, spaced(values.words));
  return snippets;
}

}  // namespace

std::string bash_completion() {
  std::ostringstream out;
  out << R"(# bash completion of contactscope; made by contactscope --manual bash

# Words with commas between them: keep the text before the last comma.
_contactscope_list() {
  local before=
  case $cur in *,*) before=${cur%,*}, ;; esac
  COMPREPLY=($(compgen -P "$before" -W "$1" -- "${cur##*,}"))
  compopt -o nospace 2>/dev/null || true
}

# Lines of the standard input that begin with the typed text. Not by compgen -W, which would run a name such as $(this).
_contactscope_words() {
  local word
  while IFS= read -r word; do
    [[ $word == "$cur"* ]] || continue
    [[ $word == *[!A-Za-z0-9_./+@%:,=~-]* ]] && word=$(printf %q "$word")
    COMPREPLY+=("$word")
  done
}

_contactscope() {
  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD - 1]} verb=${COMP_WORDS[1]}
  # --option=value is three words to bash.
  if [ "$cur" = = ]; then cur=; elif [ "$prev" = = ]; then prev=${COMP_WORDS[COMP_CWORD - 2]}; fi
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W ')"
      << spaced(mapped(verbs(), &Verb::name)) << R"( --help --version --manual' -- "$cur"))
    return
  fi
  case $prev in
    --manual) COMPREPLY=($(compgen -W 'man bash zsh fish' -- "$cur")); return ;;
)";
  std::set<std::string> done;
  for (const Option& option : option_table()) {
    if (option.is_argument() || !option.takes_value() || !done.insert(option.name()).second)
      continue;
    const std::string reply = snippets_of(option.values).bash;
    out << "    " << option.name() << ") " << reply << (reply.empty() ? "" : "; ") << "return ;;\n";
  }
  out << "  esac\n  case $cur in\n    -*)\n      case $verb in\n";
  for (const Verb& verb : verbs())
    out << "        " << verb.name << ") COMPREPLY=($(compgen -W '" << spaced(option_names(verb))
        << "' -- \"$cur\")) ;;\n";
  out << "      esac\n      return ;;\n  esac\n  case $verb in\n";
  for (const Verb& verb : verbs()) {
    const Option* const argument = argument_of(verb);
    const std::string reply = argument ? snippets_of(argument->values).bash : "";
    if (!reply.empty()) out << "    " << verb.name << ") " << reply << " ;;\n";
  }
  out << "  esac\n}\ncomplete -o bashdefault -F _contactscope contactscope\n";
  return out.str();
}

std::string zsh_completion() {
  constexpr std::string_view kSpecial = "[]:\\";
  std::ostringstream out;
  out << "#compdef contactscope\n# zsh completion of contactscope; made by contactscope --manual "
         "zsh\n\n_contactscope_scenarios() {\n  local -a names\n  names=(${(f)\"$("
      << kNames << ")\"})\n  compadd -a names\n  _files\n}\n\n_contactscope() {\n"
      << "  local -a verbs\n  verbs=(\n";
  for (const Verb& verb : verbs())
    out << "    " << quoted(verb.name + ":" + escaped(verb.summary, ":\\"), "'\\''") << '\n';
  out << "  )\n  if (( CURRENT == 2 )); then\n    _describe verb verbs\n"
         "    compadd -- --help --version --manual\n    return\n  fi\n"
         "  local verb=$words[2]\n  shift words\n  (( CURRENT-- ))\n  case $verb in\n"
         "    --manual) compadd man bash zsh fish ;;\n";
  for (const Verb& verb : verbs()) {
    out << "    " << verb.name << ")\n      _arguments '--help[Print the options]'";
    for (const Option* option : options_of(verb.name)) {
      const std::string action = snippets_of(option->values).zsh;
      std::string spec;
      if (option->is_argument()) {
        spec = (option->repeats() ? "*:" : ":") + option->name() + ":" + action;
      } else {
        spec = option->name() + (option->takes_value() ? "=" : "") + "[" +
               escaped(option->description(), kSpecial) + "]";
        if (option->takes_value()) spec += ":" + option->name().substr(2) + ":" + action;
      }
      out << " \\\n        " << quoted(spec, "'\\''");
    }
    out << " ;;\n";
  }
  out << "  esac\n}\n_contactscope \"$@\"\n";
  return out.str();
}

std::string fish_completion() {
  std::ostringstream out;
  const std::string begin = "complete -c contactscope ";
  out << "# fish completion of contactscope; made by contactscope --manual fish\n"
      << begin << "-f\n"
      << begin << "-n __fish_use_subcommand -l help -d 'Print the options'\n"
      << begin << "-n __fish_use_subcommand -l version\n"
      << begin << "-n __fish_use_subcommand -l manual -x -a 'man bash zsh fish'\n";
  for (const Verb& verb : verbs()) {
    out << begin << "-n __fish_use_subcommand -a " << verb.name << " -d "
        << quoted(verb.summary, "\\'") << '\n';
    const std::string here = begin + "-n '__fish_seen_subcommand_from " + verb.name + "' ";
    out << here << "-l help -d 'Print the options'\n";
    for (const Option* option : options_of(verb.name)) {
      const std::string values =
          option->takes_value() ? snippets_of(option->values).fish : std::string();
      if (!option->is_argument())
        out << here << "-l " << option->name().substr(2) << " -d "
            << quoted(escaped(option->description(), "\\"), "\\'") << values << '\n';
      else if (option->values.kind == Kind::Scenario)
        out << here << "-F" << values << '\n';
      else
        out << here << (values == " -x" ? " -F" : values) << '\n';
    }
  }
  return out.str();
}

}  // namespace contactscope::app
