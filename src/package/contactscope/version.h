#pragma once

#include "namespace.h"

/// Semantic version of the package. While the major number is 0, the minor one counts breaking
/// changes. The build reads the version from here.
#define CONTACTSCOPE_VERSION_MAJOR 0
#define CONTACTSCOPE_VERSION_MINOR 1
#define CONTACTSCOPE_VERSION_PATCH 0

namespace contactscope::package {

/// Version of the linked library, "0.1.0"; the macros are the version of the headers.
const char* version();

/// Schema of traces that are written and read: "contactscope.trace/1". It is independent of the
/// version: new keys keep the schema, and keys are never renamed.
const char* trace_schema();

}  // namespace contactscope::package
