#pragma once

#include <cstddef>

namespace contactscope::bench {

/// Steps of a moving pair, forwards and backwards: 0, 1, ... count - 1, ... 1, 0, ...
class StepCounter {
 public:
  std::size_t next(std::size_t count) {
    if (count < 2) return 0;
    const std::size_t period = 2 * (count - 1);
    const std::size_t at = passes_++ % period;
    return at < count ? at : period - at;
  }

 private:
  std::size_t passes_ = 0;
};

}  // namespace contactscope::bench
