#pragma once

#include "core/view.h"

namespace contactscope::scenario_file {

/// The view of a file that names none: fitted, with the default layers and no panels.
View default_view();

}  // namespace contactscope::scenario_file
