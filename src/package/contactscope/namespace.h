#pragma once

/// Programs write contactscope::NAME. The namespace of the package avoids clashes with internal
/// types of the library that have the same names.
namespace contactscope::package {}

#ifndef CONTACTSCOPE_INSIDE  // defined when the package itself is built
namespace contactscope {
using namespace package;
}
#endif
