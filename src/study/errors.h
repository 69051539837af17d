#pragma once

#include <algorithm>

#include "study/pass_times.h"
#include "trace/study.h"

namespace contactscope {

/// Mean and worst error over the cases that did not fail.
class Errors {
 public:
  void add(double error) {
    sum_ += error;
    worst_ = std::max(worst_, error);
    ++count_;
  }
  /// Leaves both empty where nothing was added.
  void write(trace::StudyPoint& point) const {
    point.error.reset();
    point.error_worst.reset();
    if (count_ == 0) return;
    point.error = sum_ / count_;
    point.error_worst = worst_;
  }

 private:
  double sum_ = 0;
  double worst_ = 0;
  int count_ = 0;
};

/// What one method measured at one parameter; `failed` of `of` cases have no error.
inline trace::StudyPoint study_point(double parameter, const Errors& errors, const PassTimes& times,
                                     int failed, int of) {
  trace::StudyPoint point;
  point.parameter = parameter;
  point.nanoseconds = times.summary();
  point.failed = failed;
  point.of = of;
  errors.write(point);
  return point;
}

}  // namespace contactscope
