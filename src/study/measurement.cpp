#include "study/measurement.h"

#include <chrono>

namespace contactscope {

void Errors::write(trace::StudyPoint& point) const {
  if (count_ == 0) return;
  point.error = sum_ / count_;
  point.error_worst = worst_;
}

double PassTimes::now() {
  const std::chrono::duration<double, std::nano> time =
      std::chrono::steady_clock::now().time_since_epoch();
  return time.count();
}

trace::Nanoseconds PassTimes::summary() const {
  std::vector<double> sorted = times_;
  std::ranges::sort(sorted);
  const std::size_t middle = sorted.size() / 2;
  const double median =
      sorted.size() % 2 == 1 ? sorted[middle] : 0.5 * (sorted[middle - 1] + sorted[middle]);
  return {median, sorted.front(), sorted.back()};
}

trace::StudyPoint Measurement::point(double parameter, std::size_t measure) const {
  trace::StudyPoint result;
  result.parameter = parameter;
  result.nanoseconds = times.summary();
  result.failed = failed;
  result.of = of;
  errors[measure].write(result);
  return result;
}

trace::Study by_measure(trace::Study study, const char* measure, const char* title,
                        const char* error) {
  study.measure = measure;
  study.title = title;
  study.error = error;
  return study;
}

void begin_series(std::vector<trace::Study>& results, const trace::StudySeries& series) {
  for (trace::Study& study : results) study.series.push_back(series);
}

void add_point(std::vector<trace::Study>& results, double parameter, const Measurement& measured) {
  for (std::size_t i = 0; i < results.size(); ++i)
    results[i].series.back().points.push_back(measured.point(parameter, i));
}

}  // namespace contactscope
