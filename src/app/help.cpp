#include "app/verbs.h"

namespace contactscope::app {

/// `help render` is `render --help`, which main.cpp makes of it: only the parser knows what each option takes.
Verb help_verb() {
  return {"help",
          "Print what a verb takes, with examples; or the verbs",
          [](const Options&) { return ExitCode::Same; },
          "[VERB]",
          {{"VERB", "One of those that contactscope --help lists"}}};
}

}  // namespace contactscope::app
