#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace contactscope::app {

/// The heads of a table, then its rows: as many cells in each.
using Table = std::vector<std::vector<std::string>>;

/// Prints a table for people: columns as wide as what they hold, the first to the left, numbers to
/// the right. A byte counts as a column: cells are ASCII.
void print(const Table& table, std::ostream& out);

/// As printf does it.
std::string spelled(const char* format, double value);

}  // namespace contactscope::app
