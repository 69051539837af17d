#include <algorithm>

#include "core/at.h"
#include "study/picture.h"

namespace contactscope {
namespace {

using namespace told;

constexpr double kUsualWay = 10;  // metres in the step

std::string result_of(const trace::Study& measured, trace::Study& study) {
  const auto at_usual = [&](const char* method) -> const trace::StudyPoint& {
    return point_at(series_of(measured, method, "rotating"), kUsualWay);
  };
  const trace::StudyPoint &own = at_usual("time of impact"), &sampled = at_usual("64 samples");
  if (!own.error || !sampled.error) throw std::out_of_range("all failed");
  const auto told_of = [&](const char* method, const trace::StudyPoint& point) {
    for (trace::StudySeries& series : study.series)
      if (series.method.starts_with(method))
        mark(study, series.method, "", kUsualWay, power(*point.error));
  };
  told_of("search", own);
  told_of("64 samples", sampled);
  const std::string missed =
      sampled.failed == 0 ? ""
                          : " (" + count(sampled.failed) + " of " + count(sampled.of) + " missed)";
  return "At " + number(kUsualWay) + " m a step a search for the impact is off by " +
         power(*own.error) + " of the step, 64 samples by " + power(*sampled.error) + missed;
}

/// The least and the most that a query took.
std::string times_of(const trace::StudySeries& series) {
  const auto time = [](const trace::StudyPoint& point) { return point.nanoseconds.min; };
  const auto [least, most] = std::ranges::minmax(series.points, {}, time);
  return number(time(least) / 1000) + "–" + number(time(most) / 1000) + " µs";
}

}  // namespace

trace::Study picture_time_of_impact(const trace::Study& measured) {
  trace::Study study = measured;
  // Conservative advancement is as close, in twice the time, and eight samples miss most of the fast ones: tables
  // have them.
  keep_methods(study, {{"time of impact", "search for the time of impact"},
                       {"64 samples", "64 samples of the step"}});
  // Those that do not turn are as far off, in less time: tables have them.
  keep_panels(study, {{"rotating", ""}});
  for (trace::StudySeries& series : study.series)
    series.parameter = "metres that a hull goes in the step";
  if (study.measure != "error") {
    study.unit = trace::kShare;
    return study;
  }
  // Times hardly depend on the way: the names of the lines have them.
  for (trace::StudySeries& series : study.series) {
    if (!series.points.empty()) series.method += ": " + times_of(series);
    for (trace::StudyPoint& point : series.points) point.error_worst.reset();  // tables have it
  }
  study.form = trace::StudyForm::Curves;
  study.failed = "hits missed";
  study.shown =
      "Up: mean error of the time of impact, as a fraction of the step, of hulls that turn by up "
      "to "
      "2 rad. Times are of a query.";
  tell(study, [&] { return result_of(measured, study); });
  return study;
}

}  // namespace contactscope
