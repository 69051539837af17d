#include <sstream>

#include "app/cli/manual.h"

namespace contactscope::app {
namespace {

using Kind = Completion::Kind;

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

/// The positional argument; each verb has at most one.
const ManualArgument* positional(const ManualVerb& verb) {
  for (const ManualArgument& argument : verb.arguments)
    if (!argument.is_option()) return &argument;
  return nullptr;
}

std::vector<std::string> options_of(const ManualVerb& verb) {
  std::vector<std::string> options = {"--help"};
  for (const ManualArgument& argument : verb.arguments)
    if (argument.is_option()) options.push_back(argument.name);
  return options;
}

std::vector<std::string> names_of_verbs(const std::vector<ManualVerb>& verbs) {
  std::vector<std::string> names;
  for (const ManualVerb& verb : verbs) names.push_back(verb.name);
  return names;
}

/// Options of all verbs, each once.
std::vector<ManualArgument> all_options(const std::vector<ManualVerb>& verbs) {
  std::vector<ManualArgument> all;
  for (const ManualVerb& verb : verbs)
    for (const ManualArgument& argument : verb.arguments) {
      bool is_known = !argument.is_option();
      for (const ManualArgument& known : all) is_known = is_known || known.name == argument.name;
      if (!is_known) all.push_back(argument);
    }
  return all;
}

/// A line of bash that sets COMPREPLY; empty if there is nothing to complete.
std::string bash_reply(const Completion& completion) {
  switch (completion.kind) {
    case Kind::Words:
      return "COMPREPLY=($(compgen -W '" + spaced(completion.words) + "' -- \"$cur\"))";
    case Kind::List:
      return "_contactscope_list '" + spaced(completion.words) + "'";
    case Kind::Scenario:
      return std::string("_contactscope_words < <(") + kNames + "; compgen -f -- \"$cur\")";
    case Kind::File:
      return "COMPREPLY=($(compgen -f -- \"$cur\"))";
    case Kind::Folder:
      return "COMPREPLY=($(compgen -d -- \"$cur\"))";
    case Kind::Free:
      break;
  }
  return {};
}

/// Action of zsh's _arguments for a value.
std::string zsh_action(const Completion& completion) {
  switch (completion.kind) {
    case Kind::Words:
      return "(" + spaced(completion.words) + ")";
    case Kind::List:
      return "_values -s , word " + spaced(completion.words);
    case Kind::Scenario:
      return "_contactscope_scenarios";
    case Kind::File:
      return "_files";
    case Kind::Folder:
      return "_files -/";
    case Kind::Free:
      break;
  }
  return " ";
}

/// End of a fish `complete` line.
std::string fish_values(const Completion& completion) {
  switch (completion.kind) {
    case Kind::Words:
      return " -x -a " + quoted(spaced(completion.words), "\\'");
    case Kind::List:
      return " -x -a \"(__fish_complete_list , 'string split \\' \\' \\'" +
             spaced(completion.words) + "\\'')\"";
    case Kind::Scenario:
      return std::string(" -a \"(") + kNames + ")\"";
    case Kind::File:
      return " -r -F";
    case Kind::Folder:
      return " -x -a '(__fish_complete_directories)'";
    case Kind::Free:
      break;
  }
  return " -x";
}

}  // namespace

std::string bash_completion(const std::vector<ManualVerb>& verbs) {
  std::ostringstream out;
  out << R"(# bash completion of contactscope; made by contactscope --manual bash

# Words with commas between them: what stands before the last comma stays.
_contactscope_list() {
  local before=
  case $cur in *,*) before=${cur%,*}, ;; esac
  COMPREPLY=($(compgen -P "$before" -W "$1" -- "${cur##*,}"))
  compopt -o nospace 2>/dev/null || true
}

# Lines of the standard input that begin with what is typed. Not by compgen -W, which would run a name such as $(this).
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
      << spaced(names_of_verbs(verbs)) << R"( --help --version --manual' -- "$cur"))
    return
  fi
  case $prev in
    --manual) COMPREPLY=($(compgen -W 'man bash zsh fish' -- "$cur")); return ;;
)";
  for (const ManualArgument& option : all_options(verbs)) {
    if (!option.takes_value) continue;
    const std::string reply = bash_reply(completion_of(option));
    out << "    " << option.name << ") " << reply << (reply.empty() ? "" : "; ") << "return ;;\n";
  }
  out << "  esac\n  case $cur in\n    -*)\n      case $verb in\n";
  for (const ManualVerb& verb : verbs)
    out << "        " << verb.name << ") COMPREPLY=($(compgen -W '" << spaced(options_of(verb))
        << "' -- \"$cur\")) ;;\n";
  out << "      esac\n      return ;;\n  esac\n  case $verb in\n";
  for (const ManualVerb& verb : verbs) {
    const ManualArgument* const argument = positional(verb);
    const std::string reply = argument ? bash_reply(completion_of(*argument)) : "";
    if (!reply.empty()) out << "    " << verb.name << ") " << reply << " ;;\n";
  }
  out << "  esac\n}\ncomplete -o bashdefault -F _contactscope contactscope\n";
  return out.str();
}

std::string zsh_completion(const std::vector<ManualVerb>& verbs) {
  constexpr std::string_view kSpecial = "[]:\\";
  std::ostringstream out;
  out << "#compdef contactscope\n# zsh completion of contactscope; made by contactscope --manual "
         "zsh\n\n_contactscope_scenarios() {\n  local -a names\n  names=(${(f)\"$("
      << kNames << ")\"})\n  compadd -a names\n  _files\n}\n\n_contactscope() {\n"
      << "  local -a verbs\n  verbs=(\n";
  for (const ManualVerb& verb : verbs)
    out << "    " << quoted(verb.name + ":" + escaped(verb.summary, ":\\"), "'\\''") << '\n';
  out << "  )\n  if (( CURRENT == 2 )); then\n    _describe verb verbs\n"
         "    compadd -- --help --version --manual\n    return\n  fi\n"
         "  local verb=$words[2]\n  shift words\n  (( CURRENT-- ))\n  case $verb in\n"
         "    --manual) compadd man bash zsh fish ;;\n";
  for (const ManualVerb& verb : verbs) {
    out << "    " << verb.name << ")\n      _arguments '--help[Say what there is]'";
    for (const ManualArgument& argument : verb.arguments) {
      std::string spec;
      if (argument.is_option()) {
        spec = argument.name + (argument.takes_value ? "=" : "") + "[" +
               escaped(argument.help, kSpecial) + "]";
        if (argument.takes_value)
          spec += ":" + argument.name.substr(2) + ":" + zsh_action(completion_of(argument));
      } else {
        spec = (argument.repeats ? "*:" : ":") + argument.name + ":" +
               zsh_action(completion_of(argument));
      }
      out << " \\\n        " << quoted(spec, "'\\''");
    }
    out << " ;;\n";
  }
  out << "  esac\n}\n_contactscope \"$@\"\n";
  return out.str();
}

std::string fish_completion(const std::vector<ManualVerb>& verbs) {
  std::ostringstream out;
  const std::string begin = "complete -c contactscope ";
  out << "# fish completion of contactscope; made by contactscope --manual fish\n"
      << begin << "-f\n"
      << begin << "-n __fish_use_subcommand -l help -d 'Say what there is'\n"
      << begin << "-n __fish_use_subcommand -l version\n"
      << begin << "-n __fish_use_subcommand -l manual -x -a 'man bash zsh fish'\n";
  for (const ManualVerb& verb : verbs) {
    out << begin << "-n __fish_use_subcommand -a " << verb.name << " -d "
        << quoted(verb.summary, "\\'") << '\n';
    const std::string here = begin + "-n '__fish_seen_subcommand_from " + verb.name + "' ";
    out << here << "-l help -d 'Say what there is'\n";
    for (const ManualArgument& argument : verb.arguments) {
      const std::string values =
          argument.takes_value ? fish_values(completion_of(argument)) : std::string();
      if (argument.is_option())
        out << here << "-l " << argument.name.substr(2) << " -d "
            << quoted(escaped(argument.help, "\\"), "\\'") << values << '\n';
      else if (completion_of(argument).kind == Kind::Scenario)
        out << here << "-F" << values << '\n';
      else
        out << here << (values == " -x" ? " -F" : values) << '\n';
    }
  }
  return out.str();
}

}  // namespace contactscope::app
