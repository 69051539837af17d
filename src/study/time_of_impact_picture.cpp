#include <algorithm>

#include "core/at.h"
#include "study/picture.h"

namespace contactscope {
namespace {

using namespace told;

constexpr double kUsualWay = 10;  // metres in the step
constexpr const char* kTurning = "Turning by up to 2 rad";

std::string result_of(const trace::Study& measured, trace::Study& study) {
  const auto at_usual = [&](const char* method) -> const trace::StudyPoint& {
    return point_at(series_of(measured, method, "rotating"), kUsualWay);
  };
  const trace::StudyPoint &own = at_usual("time of impact"), &sampled = at_usual("64 samples");
  if (!own.error || !sampled.error) throw std::out_of_range("all failed");
  const std::string way = number(kUsualWay) + " m: ";
  mark(study, "time of impact", kTurning, kUsualWay,
       way + power(*own.error) + ", " + duration(own.nanoseconds.min));
  mark(study, "64 samples", kTurning, kUsualWay,
       way + power(*sampled.error) + ", " + duration(sampled.nanoseconds.min));
  return "The time of impact is off by " + power(*own.error) +
         " of the step, that of 64 samples by " + power(*sampled.error);
}

}  // namespace

trace::Study picture_time_of_impact(const trace::Study& measured) {
  trace::Study study = measured;
  keep_methods(study, {{"time of impact", "time of impact"},
                       {"advancement", "conservative advancement"},
                       {"8 samples", "8 samples"},
                       {"64 samples", "64 samples"}});
  // Those that do not turn are as far off, in less time: tables have them.
  keep_panels(study, {{"rotating", kTurning}});
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
