#pragma once

/// Programs write contactscope::NAME of all that this package has. It stands in a namespace of its own
/// because the library has types of the same names inside, which are others.
namespace contactscope::package {}

#ifndef CONTACTSCOPE_INSIDE  // set where the package itself is built
namespace contactscope {
using namespace package;
}
#endif
