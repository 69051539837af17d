#include <algorithm>

#include "core/at.h"
#include "study/picture.h"

namespace contactscope {
namespace {

using namespace record;

constexpr const char* kPanel = "Made from nothing in each step";

/// Time of each method for the largest number of boxes, the fastest first. Added to the names of
/// lines that reach it.
std::string result_of(const trace::Study& measured, trace::Study& study) {
  const trace::StudySeries& columns = series_of(measured, "columns", "from nothing");
  const trace::StudyPoint& most = columns.points.back();
  const auto of = [&](const char* method) {
    return point_at(series_of(measured, method, "from nothing"), most.parameter).nanoseconds.median;
  };
  const std::string result = "To find all pairs of " + count(most.parameter) +
                             " boxes a sweep in columns takes " + duration(of("columns")) +
                             ", a grid " + duration(of("grid")) + ", a tree " +
                             duration(of("tree"));
  for (trace::StudySeries& series : study.series)
    if (!series.points.empty() && series.points.back().parameter == most.parameter)
      series.method += ": " + duration(series.points.back().nanoseconds.median);
  // Explain why other lines end earlier.
  std::vector<std::string> slow;
  double given = 0;
  for (const trace::StudySeries& series : study.series)
    if (!series.points.empty() && series.points.back().parameter < most.parameter) {
      slow.push_back(series.method);
      given = std::max(given, series.points.back().parameter);
    }
  if (!slow.empty()) study.shown += "; " + listed(slow) + " were given at most " + count(given);
  return result;
}

}  // namespace

trace::Study picture_broad_phase(const trace::Study& measured) {
  trace::Study study = measured;
  keep_panels(study, {{"from nothing", kPanel}});  // tables contain the other scenes
  for (trace::StudySeries& series : study.series) {
    std::ranges::replace(series.method, '_', ' ');
    if (series.method == "sweep and prune") series.method = "sweep & prune";
    if (series.method == "columns") series.method = "sweep in columns";
    if (series.method == "tree") series.method = "tree of boxes";
    series.parameter = "boxes";
  }
  if (study.measure != "time") return study;
  study.shown = "Up: milliseconds to find all pairs of boxes that overlap, median of the steps";
  if (!measured.series.empty()) report(study, [&] { return result_of(measured, study); });
  return study;
}

}  // namespace contactscope
