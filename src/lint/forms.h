#pragma once

#include "lint/reading.h"
#include "trace/shape.h"

namespace contactscope::lint {

/// Whether a form applies to a shape.
bool takes(const trace::Shape& shape, Form form);

/// The shape with the form applied.
trace::Shape reformed(trace::Shape shape, Form form);

}  // namespace contactscope::lint
