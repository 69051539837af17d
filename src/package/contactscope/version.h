#pragma once

#include "namespace.h"

/// Semantic version of the package: while the first number is 0, the second one counts changes that
/// break programs. The build reads it from here.
#define CONTACTSCOPE_VERSION_MAJOR 0
#define CONTACTSCOPE_VERSION_MINOR 1
#define CONTACTSCOPE_VERSION_PATCH 0

namespace contactscope::package {

/// Version of the library that is linked, "0.1.0"; the macros are those of the headers.
const char* version();

/// What traces are written as, and the one that is read: "contactscope.trace/1". A number of its own:
/// keys are added under it, and none is renamed.
const char* trace_schema();

}  // namespace contactscope::package
