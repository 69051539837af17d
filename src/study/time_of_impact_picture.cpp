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
  const std::string turning = "Turning by up to 2 rad", way = number(kUsualWay) + " m: ";
  mark(study, "time of impact", turning, kUsualWay,
       way + power(*own.error) + ", " + duration(own.nanoseconds.min));
  mark(study, "64 samples", turning, kUsualWay,
       way + power(*sampled.error) + ", " + duration(sampled.nanoseconds.min));
  return "The time of impact is off by " + power(*own.error) + " of the step, in " +
         duration(own.nanoseconds.min) + "; 64 samples are off " +
         number(*sampled.error / *own.error) + " times as far, in " +
         number(sampled.nanoseconds.min / own.nanoseconds.min) + " times the time";
}

}  // namespace

trace::Study picture_time_of_impact(const trace::Study& measured) {
  trace::Study study = measured;
  keep_methods(study, {{"time of impact", "time of impact"},
                       {"advancement", "conservative advancement"},
                       {"8 samples", "8 samples"},
                       {"64 samples", "64 samples"}});
  keep_panels(study, {{"translating", "Translating"}, {"rotating", "Turning by up to 2 rad"}});
  for (trace::StudySeries& series : study.series) series.parameter = "metres in the step";
  if (study.measure != "error") {
    study.unit = trace::kShare;
    return study;
  }
  show_least_times(study);
  study.parameter = "m in the step";
  study.other_cases = true;
  study.shown =
      "Up: mean error, as a fraction of the step. Along a line: 1, 3, 10 and 100 m in the step. "
      "Crosses: hits that were missed.";
  tell(study, [&] { return result_of(measured, study); });
  return study;
}

}  // namespace contactscope
