#include "study/uniform.h"

#include <cmath>
#include <numbers>

namespace contactscope {

double uniform(std::mt19937_64& engine, double low, double high) {
  return low + (high - low) * static_cast<double>(engine() >> 11) * 0x1p-53;
}

Quatd uniform_rotation(std::mt19937_64& engine) {
  const double share = uniform(engine, 0, 1);
  const double first = uniform(engine, 0, 2 * std::numbers::pi);
  const double second = uniform(engine, 0, 2 * std::numbers::pi);
  const double a = std::sqrt(1 - share);
  const double b = std::sqrt(share);
  return Quatd(b * std::cos(second), a * std::sin(first), a * std::cos(first),
               b * std::sin(second));
}

}  // namespace contactscope
