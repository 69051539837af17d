#pragma once

#include <random>

#include "core/vec3.h"

namespace contactscope {

/// In [low, high), the same with every standard library: the engine is specified to the bit, the
/// standard distributions are not.
double uniform(std::mt19937_64& engine, double low, double high);

/// Shoemake, "Uniform Random Rotations", Graphics Gems III, 1992.
Quatd uniform_rotation(std::mt19937_64& engine);

}  // namespace contactscope
