#pragma once

#include <chrono>

#include "core/standard.h"

/// Progress of a run, and for --verbose a log of its stages.
namespace contactscope::app {

/// Progress bar on stderr; hidden with --quiet or if stderr is not a terminal.
class Progress {
 public:
  Progress(int total, bool quiet);
  ~Progress();
  Progress& operator=(Progress&&) = delete;

  void advance(const std::string& what);
  /// Clears the bar before other output.
  void clear() const;

 private:
  int total_;
  int done_ = 0;
  bool shown_;
};

/// From now on SIGINT, SIGTERM and SIGHUP are only noted, so that files in progress are completed.
void note_interrupts();

/// The user stopped the program with a signal.
class Interrupted : public std::runtime_error {
 public:
  explicit Interrupted(int signal)
      : std::runtime_error("interrupted; all files that were written are complete"),
        signal_(signal) {}
  /// Shell convention for a program ended by a signal: 130 after Ctrl-C.
  int exit_code() const { return 128 + signal_; }

 private:
  int signal_;
};

/// Throws Interrupted if a signal was noted.
void stop_if_interrupted();

/// Stages of a run with their times, and omitted work, for --verbose.
class RunLog {
 public:
  /// Adds to the time of a stage; `count` is the number of calls.
  void add(const std::string& stage, std::chrono::nanoseconds time, int count = 1);
  /// Work that a scene did not need, and why.
  void left_out(const std::string& what);
  void note(const std::string& text);
  void print(std::ostream& out, const std::string& heading) const;

 private:
  struct Entry {
    std::string stage;
    std::chrono::nanoseconds time{};
    int count = 0;
  };
  std::vector<Entry> entries_;
  std::vector<std::string> notes_;
  std::vector<std::string> left_out_;
};

/// Adds the time of its lifetime to a stage.
class Timed {
 public:
  Timed(RunLog& log, std::string stage)
      : log_(log), stage_(std::move(stage)), begin_(std::chrono::steady_clock::now()) {}
  ~Timed() { log_.add(stage_, std::chrono::steady_clock::now() - begin_); }
  Timed& operator=(Timed&&) = delete;

 private:
  RunLog& log_;
  std::string stage_;
  std::chrono::steady_clock::time_point begin_;
};

}  // namespace contactscope::app
