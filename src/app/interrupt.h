#pragma once

#include <stdexcept>

namespace contactscope::app {

/// Somebody asked the program to stop (SIGINT, SIGTERM, SIGHUP).
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted; what was written is whole") {}
};

/// From now on a request to stop is only noted, so that files under way are finished.
void note_interrupts();

/// Throws Interrupted when a request was noted.
void stop_if_interrupted();

}  // namespace contactscope::app
