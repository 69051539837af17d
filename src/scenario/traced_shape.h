#pragma once

#include "geometry/shape.h"
#include "scenario/scenario.h"
#include "trace/trace.h"

namespace contactscope {

/// A shape of a scenario as a trace has it, with the vertices that the pipeline sees.
template <class S>
trace::Shape traced_shape(const ScenarioShape& shape, const Shape<S>& rounded);

}  // namespace contactscope
