#pragma once

#include <vector>

#include "trace/study.h"

namespace contactscope {

/// Times of one method, nanoseconds a call, one a repetition.
class PassTimes {
 public:
  /// Times `calls` calls of `call(i)`, i = 0 .. calls - 1. What `call` returns is used, so that the
  /// compiler cannot leave it out.
  template <class Call>
  void measure(int calls, const Call& call) {
    double used = 0;
    const double begin = now();
    for (int i = 0; i < calls; ++i) used += call(i);
    add((now() - begin) / calls, used);
  }

  /// At least one repetition was measured.
  trace::Nanoseconds summary() const;

 private:
  static double now();  // nanoseconds on a clock that never runs backwards
  void add(double nanoseconds, double used);

  std::vector<double> times_;
  volatile double sink_ = 0;
};

}  // namespace contactscope
