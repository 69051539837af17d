#pragma once

#include <chrono>
#include <iosfwd>
#include <string>
#include <vector>

namespace contactscope::app {

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
