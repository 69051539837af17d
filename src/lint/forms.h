#pragma once

#include "lint/reading.h"
#include "trace/shape.h"

namespace contactscope::lint {

/// Whether it is a shape of which a form says anything.
bool takes(const trace::Shape& shape, Form form);

/// The shape as that has it.
trace::Shape reformed(trace::Shape shape, Form form);

}  // namespace contactscope::lint
