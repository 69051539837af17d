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

}  // namespace contactscope::app
