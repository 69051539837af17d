#pragma once

#include <string>

namespace contactscope::app {

/// A progress bar on standard error, shown only where that is a terminal and nobody asked for
/// quiet.
class Progress {
 public:
  Progress(int total, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void advance(const std::string& what);
  /// Takes the bar off the line, before something else is printed.
  void clear() const;

 private:
  int total_;
  int done_ = 0;
  bool shown_;
};

/// From now on a request to stop (SIGINT, SIGTERM, SIGHUP) is only noted, so that files under way
/// are finished.
void note_interrupts();

/// Throws std::runtime_error when a request was noted.
void stop_if_interrupted();

}  // namespace contactscope::app
