#include <sstream>

#include "app/cli/verbs.h"
#include "scenario/keys.h"
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

}  // namespace contactscope::app
