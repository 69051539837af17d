#include <algorithm>

#include "core/at.h"
#include "study/picture.h"

namespace contactscope {
namespace {

using namespace record;

constexpr double kUsualDistance = 10;  // metres in the step
constexpr double kPercent = 100;       // of one
constexpr const char* kSampled = "64 samples of the step";

std::string result_of(const trace::Study& measured, trace::Study& study) {
  const auto at_usual = [&](const char* method) -> const trace::StudyPoint& {
    return point_at(series_of(measured, method, "rotating"), kUsualDistance);
  };
  const trace::StudyPoint &own = at_usual("time of impact"), &sampled = at_usual("64 samples");
  if (!own.error || !sampled.error) throw std::out_of_range("all failed");
  const auto record_of = [&](const char* method, const trace::StudyPoint& point) {
    for (trace::StudySeries& series : study.series)
      if (series.method.starts_with(method))
        mark(study, series.method, "", kUsualDistance, "off by " + percent(*point.error));
  };
  record_of("search", own);
  record_of("64 samples", sampled);
  return "Over " + number(kUsualDistance) +
         " m in a step a search for the time of impact is off by " + percent(*own.error) +
         " of the step, 64 samples by " + percent(*sampled.error);
}

/// Text for the most hits that a line misses at a point; empty if it misses none. Its means exclude
/// them.
std::string take_missed(trace::StudySeries& series) {
  const auto most = std::ranges::max_element(series.points, {}, &trace::StudyPoint::failed);
  if (most == series.points.end() || most->failed == 0) return "";
  const std::string words = " Up to " + count(most->failed) + " of " + count(most->of) +
                            " hits are missed by " + series.method + ", and left out here.";
  for (trace::StudyPoint& point : series.points) point.failed = 0;
  return words;
}

}  // namespace

trace::Study picture_time_of_impact(const trace::Study& measured) {
  trace::Study study = measured;
  // Conservative advancement is as accurate in twice the time, and eight samples miss most fast
  // hits; tables contain both, and all times.
  keep_methods(study,
               {{"time of impact", "search for the time of impact"}, {"64 samples", kSampled}});
  // Hulls without rotation have the same errors in less time; tables contain them.
  keep_panels(study, {{"rotating", ""}});
  for (trace::StudySeries& series : study.series)
    series.parameter = "metres that a hull goes in the step";
  if (study.measure != "error") {
    study.unit = trace::kShare;
    return study;
  }
  study.shown =
      "Up: mean error of the time of impact, in % of the step, of hulls that turn by up to 2 rad.";
  study.resolution *= kPercent;
  for (trace::StudySeries& series : study.series) {
    if (series.method == kSampled) series.look = 1;  // distinct from the blue of the search
    study.shown += take_missed(series);
    for (trace::StudyPoint& point : series.points) {
      point.error_worst.reset();  // tables contain it
      if (point.error) *point.error *= kPercent;
    }
  }
  study.form = trace::StudyForm::Curves;
  report(study, [&] { return result_of(measured, study); });
  return study;
}

}  // namespace contactscope
