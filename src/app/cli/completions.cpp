#include <algorithm>

#include "app/cli/verbs.h"
#include "scenario/scenario.h"

namespace contactscope::app {
namespace {

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
