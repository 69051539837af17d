#include <algorithm>
#include <functional>

#include "core/at.h"
#include "study/picture.h"

namespace contactscope {
namespace {

using namespace record;

constexpr double kRod = 10;  // length over width

/// Over length by width instead of time; tables contain times.
trace::Study picture_bounds(const trace::Study& measured) {
  trace::Study study = measured;
  keep_methods(study, {{"sphere", "bounding sphere"},
                       {"AABB", "axis-aligned box"},
                       {"OBB, six axes", "oriented box, six face normals"},
                       {"OBB, fifteen axes", "oriented box, fifteen axes"}});
  for (trace::StudySeries& series : study.series)
    series.parameter = "length of the boxes / their width";
  study.form = trace::StudyForm::Curves;
  study.unit = trace::kShare;
  study.shown =
      "Up: of the pairs that a bound lets through, the share that is apart. Rods: " + number(kRod) +
      " times as long as wide";
  report(study, [&] {
    const auto at_rod = [&](const char* method) {
      return percent(error_at(series_of(measured, method), kRod));
    };
    for (trace::StudySeries& series : study.series)
      for (trace::StudyPoint& point : series.points)
        if (point.parameter == kRod && point.error && series.method.starts_with("axis-aligned"))
          point.mark = "rods: " + percent(*point.error);
    return at_rod("AABB") + " of the rods that axis-aligned boxes let through are apart; " +
           (error_at(series_of(measured, "OBB, fifteen axes"), kRod) > 0
                ? "of those of fifteen axes " + at_rod("OBB, fifteen axes")
                : "fifteen axes let none of them through");
  });
  return study;
}

constexpr const char* kGuarded = "no threshold, each gap judged by its own rounding error";

/// Marks the worst float error of both kinds.
std::string result_of_thresholds(const trace::Study& measured, trace::Study& study) {
  for (trace::StudySeries& series : study.series) {
    if (series.method.starts_with(kGuarded) || series.points.empty()) continue;
    // Use the last of equal ones, where the line turns.
    const auto error = [](const trace::StudyPoint& point) { return point.error_worst.value_or(0); };
    const double most = error(*std::ranges::max_element(series.points, {}, error));
    trace::StudyPoint* worst = nullptr;
    for (trace::StudyPoint& point : series.points)
      if (error(point) == most) worst = &point;
    if (most > 0) worst->mark = number(most) + " mm";
  }
  double missed = 0, closed = 0;
  for (const trace::StudySeries& series : measured.series) {
    double worst = 0;
    for (const trace::StudyPoint& point : series.points)
      if (point.error_worst > measured.resolution) worst = std::max(worst, *point.error_worst);
    if (series.method == "float")
      (series.panel == "overlaps called apart" ? missed : closed) = worst;
  }
  return "In float a small threshold misses overlaps of up to " + number(1000 * missed) +
         " mm, a large one closes gaps of up to " + number(1000 * closed) + " mm";
}

bool is_right(const trace::StudySeries& series) {
  return std::ranges::all_of(series.points, [](const trace::StudyPoint& point) {
    return point.error_worst.value_or(0) == 0;
  });
}

trace::Study picture_thresholds(const trace::Study& measured) {
  trace::Study study = measured;
  drop_resolution(study);
  // Double looks the same at smaller thresholds; tables contain it.
  keep_methods(study, {{"float", "float"}, {"float, guarded", kGuarded}});
  std::ranges::stable_sort(study.series, std::ranges::greater(), &trace::StudySeries::panel);
  const auto is_guarded = [](const trace::StudySeries& series) {
    return series.method == kGuarded;
  };
  // Drawn on top; if both kinds are always right, one line of zeros suffices.
  const auto guarded =
      std::stable_partition(study.series.begin(), study.series.end(), std::not_fn(is_guarded));
  const bool never_wrong = std::all_of(guarded, study.series.end(), is_right);
  if (never_wrong && guarded != study.series.end())
    study.series.erase(guarded + 1, study.series.end());
  for (trace::StudySeries& series : study.series) {
    series.look = is_guarded(series) ? 2 : series.panel == "overlaps called apart" ? 0 : 1;
    if (!is_guarded(series))
      series.method = series.panel;
    else if (never_wrong)
      series.method += ": never wrong";
    series.panel.clear();
    series.parameter = "threshold: edges at an angle with a smaller sine give no axis";
  }
  if (study.measure == "threshold") {
    for (trace::StudySeries& series : study.series)
      for (trace::StudyPoint& point : series.points)
        for (std::optional<double>* error : {&point.error, &point.error_worst})
          if (*error) **error *= 1000;  // millimetres
    study.shown =
        "Up: the deepest overlap that is called apart, the widest gap that is called an overlap, "
        "mm";
    report(study, [&] { return result_of_thresholds(measured, study); });
  } else {
    study.unit = trace::kShare;
  }
  return study;
}

}  // namespace

trace::Study picture_overlap(const trace::Study& measured) {
  return measured.measure == "false_positives" ? picture_bounds(measured)
                                               : picture_thresholds(measured);
}

}  // namespace contactscope
