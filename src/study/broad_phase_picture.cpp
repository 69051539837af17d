#include <algorithm>

#include "core/at.h"
#include "study/picture.h"

namespace contactscope {
namespace {

using namespace told;

/// How long each takes for the most boxes that any is given, the fastest first. Marks them.
std::string result_of(const trace::Study& measured, trace::Study& study) {
  const trace::StudySeries& columns = series_of(measured, "columns", "from nothing");
  const trace::StudyPoint& most = columns.points.back();
  const auto of = [&](const char* method) {
    return point_at(series_of(measured, method, "from nothing"), most.parameter).nanoseconds.median;
  };
  const double own = most.nanoseconds.median;
  mark(study, "columns", "From nothing", most.parameter, duration(own));
  for (const char* method : {"grid", "tree"})
    mark(study, method, "From nothing", most.parameter, number(of(method) / own) + " ×");
  return count(most.parameter) + " boxes: columns find all pairs in " + duration(own) +
         ", a grid takes " + number(of("grid") / own) + " times as long, a tree " +
         number(of("tree") / own) + " times";
}

}  // namespace

trace::Study picture_broad_phase(const trace::Study& measured) {
  trace::Study study = measured;
  keep_panels(study, {{"from nothing", "From nothing"},
                      {"from nothing, three decades of sizes", "Three decades of sizes"},
                      {"all move by 1 %", "All move by 1 % of their size"}});
  for (trace::StudySeries& series : study.series) {
    std::ranges::replace(series.method, '_', ' ');
    series.parameter = "boxes";
  }
  if (study.measure != "time") return study;
  study.shown = "Up: milliseconds to find all pairs of boxes that overlap, median of the steps";
  if (!measured.series.empty()) tell(study, [&] { return result_of(measured, study); });
  return study;
}

}  // namespace contactscope
