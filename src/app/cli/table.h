#pragma once

#include "core/spell.h"
#include "trace/study.h"

namespace contactscope::app {

/// Headings, then rows with the same number of cells.
using Table = std::vector<std::vector<std::string>>;

/// Prints aligned columns: the first left-aligned, numbers right-aligned.
void print(const Table& table, std::ostream& out);

/// Terminal columns of UTF-8 text: two for East Asian characters and pictographs, none for
/// combining accents.
std::size_t columns_of(std::string_view text);

/// Metres as millimetres with three digits, without the unit.
inline std::string millimetres(double length) { return printed("%.3g", 1000 * length); }

/// Prints the results of studies: errors and times of all methods. Curves get one table per panel
/// at whole decades of the parameter, with failures after errors. Maps get only the number of cells
/// with failures; the files have the cells.
void print_tables(const std::vector<trace::Study>& results, std::ostream& out);

}  // namespace contactscope::app
