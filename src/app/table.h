#pragma once

#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "trace/study.h"

namespace contactscope::app {

/// The heads of a table, then its rows: as many cells in each.
using Table = std::vector<std::vector<std::string>>;

/// Prints a table for people: columns as wide as what they hold, the first to the left, numbers to
/// the right.
void print(const Table& table, std::ostream& out);

/// Columns that UTF-8 text takes on a terminal: two of East Asian characters and pictures, none of accents that stand
/// on the character before.
std::size_t columns_of(std::string_view text);

/// As printf does it.
std::string spelled(const char* format, double value);

/// A length in metres, in millimetres of three digits, without the unit.
inline std::string millimetres(double length) {
  return spelled("%.3g", 1000 * length);
}

/// What a study measured, for people: errors and times of all methods at all parameters. Of curves a
/// table a panel, at whole decades of the parameter, with the failures behind the errors; of maps only
/// how many cells have failures, for the files hold the cells.
void print_tables(const std::vector<trace::Study>& results, std::ostream& out);

}  // namespace contactscope::app
