#pragma once

#include <cstdint>
#include <random>

namespace contactscope {

/// Uniform in [low, high), the same with every standard library: the engine is specified to the
/// bit, the standard distributions are not.
inline double uniform(std::mt19937_64& engine, double low, double high) {
  return low + (high - low) * static_cast<double>(engine() >> 11) * 0x1p-53;
}

}  // namespace contactscope
