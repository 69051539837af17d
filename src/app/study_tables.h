#pragma once

#include <ostream>
#include <vector>

#include "trace/study.h"

namespace contactscope::app {

/// What a study measured, for people: errors and times of all methods at all parameters. Of curves a
/// table a panel, at whole decades of the parameter, with the failures behind the errors; of maps only
/// how many cells have failures, for the files hold the cells.
void print_tables(const std::vector<trace::Study>& results, std::ostream& out);

}  // namespace contactscope::app
