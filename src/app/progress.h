#pragma once

#include <chrono>
#include <iosfwd>
#include <stdexcept>
#include <string>
#include <vector>

/// What a run tells of itself: how far it is, and for --verbose what ran.
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

/// Somebody asked to stop.
class Interrupted : public std::runtime_error {
 public:
  explicit Interrupted(int signal)
      : std::runtime_error("interrupted; what was written is whole"), signal_(signal) {}
  /// As a shell has it of a program that a signal ended: 130 after Ctrl-C.
  int exit_code() const { return 128 + signal_; }

 private:
  int signal_;
};

/// Throws Interrupted when a request was noted.
void stop_if_interrupted();

/// What ran, how long it took, and what was left out, for --verbose.
class Ledger {
 public:
  /// Adds to the time of a stage; `count` is how many times it ran.
  void add(const std::string& stage, std::chrono::nanoseconds time, int count = 1);
  /// Something that a scene did not need, and why.
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

/// Adds the time between its making and its end to a stage.
class Timed {
 public:
  Timed(Ledger& ledger, std::string stage)
      : ledger_(ledger), stage_(std::move(stage)), begin_(std::chrono::steady_clock::now()) {}
  ~Timed() { ledger_.add(stage_, std::chrono::steady_clock::now() - begin_); }
  Timed(const Timed&) = delete;
  Timed& operator=(const Timed&) = delete;

 private:
  Ledger& ledger_;
  std::string stage_;
  std::chrono::steady_clock::time_point begin_;
};

}  // namespace contactscope::app
