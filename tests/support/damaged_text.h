#pragma once

#include <string>

#include "support/random_geometry.h"

namespace contactscope::test {

/// The text with one to three damages, as an editor, a merge or a bad disk makes them: bytes that are lost, doubled,
/// exchanged, made up, or from `other`, which is not empty.
std::string damaged(std::string text, const std::string& other, Random& random);

}  // namespace contactscope::test
