#include <algorithm>

#include "core/at.h"
#include "study/picture.h"

namespace contactscope {
namespace {

using namespace record;

const std::vector<Named> kTrees = {
    {"rebuild", "always rebuilt"}, {"refit", "only refitted"}, {"auto", "rebuilt where needed"}};

double sum_of(const trace::StudySeries& series) {
  double sum = 0;
  for (const trace::StudyPoint& point : series.points) sum += error_of(point);
  return sum;
}

/// The method's series in any panel.
const trace::StudySeries& any_series_of(const trace::Study& study, const std::string& method) {
  const auto found = std::ranges::find(study.series, method, &trace::StudySeries::method);
  if (found == study.series.end()) throw std::out_of_range(method);
  return *found;
}

/// Divides each error by that of `base` at the same parameter.
void divide_by(trace::StudySeries& series, const trace::StudySeries& base) {
  for (trace::StudyPoint& point : series.points) {
    const double by = error_at(base, point.parameter);
    if (point.error) point.error_worst = point.error = *point.error / by;
  }
}

trace::Study picture_times(const trace::Study& measured) {
  trace::Study study = measured;
  keep_methods(study, kTrees);
  std::string triangles;
  for (trace::StudySeries& series : study.series) {
    triangles = series.panel.substr(0, series.panel.find(' '));
    series.panel.clear();
    double sum = 0;
    for (trace::StudyPoint& point : series.points)
      point.error = point.error_worst = sum += error_of(point);
  }
  name_parameter(study, "frame");
  study.unit = trace::kSum;
  study.shown = "Up: time of all frames so far, in which a ball of " + triangles +
                " triangles is twisted, its tree brought up to date and queried";
  report(study, [&] {
    const trace::StudySeries& rebuilt = any_series_of(measured, "rebuild");
    const auto total = [](const trace::StudySeries& series) {
      return duration(1e6 * sum_of(series), 3);
    };
    for (const Named& tree : kTrees)
      for (trace::StudySeries& series : study.series)
        if (series.method == tree.second)
          series.method += ": " + total(any_series_of(measured, tree.first));
    return count(double(rebuilt.points.size())) + " frames take " + total(rebuilt) +
           " with a tree rebuilt in each, " + total(any_series_of(measured, "auto")) +
           " rebuilt where needed, " + total(any_series_of(measured, "refit")) + " only refitted";
  });
  return study;
}

trace::Study picture_costs(const trace::Study& measured) {
  trace::Study study = measured;
  keep_methods(study, kTrees);
  // Expected box tests per query show the same; tables contain them.
  keep_panels(study, {{"node pairs compared", ""}});
  const trace::Study kept = study;
  double refitted = 0, most_automatic = 0;
  const auto times = [](double ratio, int digits) { return number(ratio, digits) + " ×"; };
  for (trace::StudySeries& series : study.series) {
    divide_by(series, series_of(kept, kTrees[0].second, series.panel));
    series.quiet = series.method == kTrees[0].second;
    if (series.points.empty()) continue;
    if (series.method == kTrees[1].second) {
      refitted = error_of(series.points.back());
      series.points.back().mark = times(refitted, 2);
    }
    if (series.method == kTrees[2].second) {
      trace::StudyPoint& most = *std::ranges::max_element(series.points, {}, error_of);
      most_automatic = error_of(most);
      most.mark = times(most_automatic, 3);
    }
  }
  name_parameter(study, "frame");
  study.unit = trace::kTimes;
  study.shown =
      "Up: node pairs that a query compares, over those with a tree that is rebuilt in each frame";
  if (refitted > 0)
    study.title = "A tree that is only refitted ends at " + number(refitted) +
                  " times the node pairs of one rebuilt; rebuilt where needed it stays within " +
                  number(most_automatic, 3);
  return study;
}

trace::Study picture_motion(const trace::Study& measured) {
  trace::Study study = measured;
  study.series.clear();
  double least = 1e9, most = 0;
  for (const trace::StudySeries& series : measured.series) {
    if (series.method != "coherent") continue;
    trace::StudySeries ratio = series;
    divide_by(ratio, series_of(measured, "from roots", series.panel));
    ratio.method = series.panel.find("beside") != std::string::npos ? "one ball beside the other"
                                                                    : "one ball inside the other";
    ratio.panel.clear();
    ratio.look = static_cast<int>(study.series.size());
    for (trace::StudyPoint& point : ratio.points) {
      point.parameter /= 1000;  // millimetres
      least = std::min(least, *point.error);
      most = std::max(most, *point.error);
    }
    ratio.parameter = "mm that a ball moves in a frame";
    study.series.push_back(ratio);
  }
  if (study.series.empty()) return study;
  each_point(study, [&](trace::StudyPoint& point) {
    if (least < 1 && point.error == least) point.mark = percent(1 - least) + " less";
  });
  // Both lines end close together: put values into their names.
  for (trace::StudySeries& series : study.series) {
    const double last = series.points.empty() ? 1 : series.points.back().error.value_or(1);
    if (last > 1.005) series.method += ": " + percent(last - 1) + " more";
  }
  trace::StudySeries roots = study.series.front();
  for (trace::StudyPoint& point : roots.points) {
    point.error = point.error_worst = 1;
    point.mark.clear();
  }
  roots.method = "from the roots";
  roots.quiet = true;
  roots.look.reset();
  study.series.push_back(roots);
  study.unit = trace::kShare;
  study.shown =
      "Up: time of a query that begins where the last frame's ended, of the time of one from the "
      "roots";
  const std::string saved = least < 1 ? "saves at most " + percent(1 - least) : "saves nothing";
  study.title = "To begin where the last frame's query ended " + saved + " of its time" +
                (most > 1.005 ? ", and costs up to " + percent(most - 1) + " more" : "");
  return study;
}

}  // namespace

trace::Study picture_meshes(const trace::Study& measured) {
  trace::Study study = measured.measure == "time"   ? picture_times(measured)
                       : measured.measure == "cost" ? picture_costs(measured)
                                                    : picture_motion(measured);
  study.reference.clear();  // for results; these are times and counts
  return study;
}

}  // namespace contactscope
