#include "app/manual.h"

#include <sstream>

#include "app/formats/format.h"
#include "app/verbs.h"
#include "core/at.h"
#include "draw/scene/theme.h"
#include "reduce/reducer.h"
#include "scenario/nearest_word.h"
#include "study/study.h"
#include "view/layers.h"

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

void print_argument(const ManualArgument& argument, std::ostream& out) {
  out << ".TP\n.B " << roff(argument.name);
  if (argument.is_option() && argument.takes_value) out << " \\fIVALUE\\fR";
  out << '\n' << roff(argument.help);
  const Completion completion = completion_of(argument);
  const bool is_named = argument.help.find(',') != std::string::npos;
  if (!completion.words.empty() && !is_named) {
    const char* before = argument.help.empty() ? "one of " : "; one of ";
    for (const std::string& word : completion.words) {
      out << before << roff(word);
      before = ", ";
    }
  }
  if (!argument.otherwise.empty()) out << " (default: " << roff(argument.otherwise) << ')';
  out << '\n';
}

void print_verb(const ManualVerb& verb, std::ostream& out) {
  out << ".SS \"contactscope " << roff(verb.name);
  for (const ManualArgument& argument : verb.arguments) {
    if (argument.is_option()) continue;
    const std::string shown = argument.name + (argument.repeats ? "..." : "");
    out << ' ' << roff(argument.is_optional ? "[" + shown + "]" : shown);
  }
  out << " [OPTIONS]\"\n" << roff(verb.summary) << ".\n";
  for (const ManualArgument& argument : verb.arguments) print_argument(argument, out);
  if (!verb.footer.empty()) out << ".PP\n.nf\n" << roff(verb.footer) << "\n.fi\n";
}

constexpr const char* kEnd = R"(.SH EXIT STATUS
.TP
.B 0
the same, or done
.TP
.B 1
a difference, an unmet expectation or a wrong claim
.TP
.B 2
trouble: a bad file, wrong usage, or no way to OpenGL
.SH ENVIRONMENT
.TP
.B CONTACTSCOPE_BACKEND
auto, egl or osmesa, where \-\-backend does not say
.TP
.B CI
true or 1: check writes no snapshot
.SH FILES
.TP
.I scenarios/*/*.toml
scenarios, by the names that \(lqcontactscope list scenarios\(rq prints
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

}  // namespace

Completion completion_of(const ManualArgument& argument) {
  using Kind = Completion::Kind;
  const std::string& name = argument.name;
  const auto words = [](const auto& names) {
    return mapped(names, [](const auto& word) { return std::string(word); });
  };
  const auto or_none = [](std::vector<std::string> names) {
    names.insert(names.begin(), "none");
    return names;
  };
  if (name == "--reducer") return {Kind::Words, words(names_in(reducers()))};
  if (name == "--layers") return {Kind::List, or_none(words(kLayerNames))};
  if (name == "--panels") return {Kind::List, or_none(words(kPanelNames))};
  if (name == "--format") return {Kind::List, words(names_in(formats()))};
  if (name == "--backend") return {Kind::Words, {"auto", "egl", "osmesa"}};
  if (name == "--theme") return {Kind::Words, words(draw::kThemeNames)};
  if (name == "--background") return {Kind::Words, {"transparent", "white"}};
  if (name == "--words" || name == "--font" || name == "--junit" || name == "--markdown")
    return {Kind::File};
  if (name == "--pictures") return {Kind::Words, {"auto", "blocks", "sixel", "kitty", "none"}};
  if (name == "NAME") return {Kind::Words, words(names_in(studies()))};
  if (name == "WHAT") return {Kind::Words, kListed};
  if (name == "SCENARIO") return {Kind::Scenario};
  if (name == "FILE" || name == "--view") return {Kind::File};
  if (name == "--out" || name == "--snapshots" || name == "--scenarios" || name == "DIR")
    return {Kind::Folder};
  return {};
}

std::string man_page(const std::string& version, const std::vector<ManualVerb>& verbs) {
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
  for (const ManualVerb& verb : verbs) print_verb(verb, out);
  out << kEnd;
  return out.str();
}

std::string manual(const std::string& what, const std::string& version,
                   const std::vector<ManualVerb>& verbs) {
  if (what == "man") return man_page(version, verbs);
  if (what == "bash") return bash_completion(verbs);
  if (what == "zsh") return zsh_completion(verbs);
  if (what == "fish") return fish_completion(verbs);
  throw UsageError("--manual '" + what + "' is not known; it is man, bash, zsh or fish");
}

}  // namespace contactscope::app
