#pragma once

#include <string>

#include "support/random_geometry.h"

namespace contactscope::test {

/// Copies the text with one to three damages, as an editor, a merge or a bad disk causes them:
/// bytes lost, doubled, swapped, invented, or taken from `other`, which must not be empty.
std::string damaged(std::string text, const std::string& other, Random& random);

}  // namespace contactscope::test
