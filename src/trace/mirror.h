#pragma once

#include "trace/pair.h"

namespace contactscope::trace {

/// The same facts told of the same two shapes in the other order: a and b trade places, with
/// everything that is of one of them; what points from a to b is negated, ids and names of axes are
/// of the other shape. Twice is the identity.
void mirror(Pair& pair);

}  // namespace contactscope::trace
