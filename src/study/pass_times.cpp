#include "study/pass_times.h"

#include <algorithm>
#include <chrono>

namespace contactscope {

double PassTimes::now() {
  const std::chrono::duration<double, std::nano> time =
      std::chrono::steady_clock::now().time_since_epoch();
  return time.count();
}

void PassTimes::add(double nanoseconds, double used) {
  times_.push_back(nanoseconds);
  sink_ = used;
}

trace::Nanoseconds PassTimes::summary() const {
  std::vector<double> sorted = times_;
  std::ranges::sort(sorted);
  const std::size_t middle = sorted.size() / 2;
  const double median =
      sorted.size() % 2 == 1 ? sorted[middle] : 0.5 * (sorted[middle - 1] + sorted[middle]);
  return {median, sorted.front(), sorted.back()};
}

}  // namespace contactscope
