#include "app/cli/verbs.h"

namespace contactscope::app {

/// main.cpp turns `help render` into `render --help`: only the parser knows the options of a verb.
Verb help_verb() {
  return {"help",
          "Print what a verb takes, with examples; or the verbs",
          [](const Options&) { return ExitCode::Same; },
          "[VERB]",
          {{"VERB", "One of those that contactscope --help lists"}}};
}

}  // namespace contactscope::app
