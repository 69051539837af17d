#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace contactscope::app {

/// A table for people: columns as wide as what they hold, the first to the left, numbers to the
/// right. A byte counts as a column: cells are ASCII.
class Table {
 public:
  explicit Table(std::vector<std::string> heads) : rows_{std::move(heads)} {}

  /// As many cells as there are heads.
  void add(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }

  void print(std::ostream& out) const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

/// As printf does it.
std::string spelled(const char* format, double value);

}  // namespace contactscope::app
