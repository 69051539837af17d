#include "study/measurement.h"

#include <chrono>

namespace contactscope {

double PassTimes::now() {
  const std::chrono::duration<double, std::nano> time =
      std::chrono::steady_clock::now().time_since_epoch();
  return time.count();
}

std::vector<double> PassTimes::sorted() const {
  std::vector<double> times = times_;
  std::ranges::sort(times);
  return times;
}

trace::Nanoseconds PassTimes::summary() const {
  const std::vector<double> times = sorted();
  const double median = 0.5 * (times[(times.size() - 1) / 2] + times[times.size() / 2]);
  return {median, times.front(), times.back()};
}

trace::StudyPoint Measurement::point(double parameter, std::size_t measure) const {
  trace::StudyPoint result;
  result.parameter = parameter;
  result.nanoseconds = times.summary();
  result.failed = failed;
  result.of = of;
  const Errors& found = errors[measure];
  if (found.count > 0) {
    result.error = found.sum / found.count;
    result.error_worst = found.worst;
  }
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
