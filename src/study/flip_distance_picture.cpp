#include <algorithm>

#include "study/picture.h"

namespace contactscope {
namespace {

using namespace record;

/// "a way of 2 mm", in the measure of the study.
std::string change_of(const trace::Study& study, double smallest) {
  if (study.measure == "way") return "a way of " + length(smallest);
  if (study.measure == "turn") return "a turn of " + power(smallest) + " rad";
  return count(smallest) + " last places of a coordinate";
}

}  // namespace

/// The title contains the smallest change of all, and its point is marked.
trace::Study picture_flip_distance(const trace::Study& measured) {
  trace::Study study = measured;
  trace::StudySeries* pair = nullptr;
  trace::StudyPoint* least = nullptr;
  for (trace::StudySeries& series : study.series)
    for (trace::StudyPoint& point : series.points)
      if (point.error && (least == nullptr || *point.error < *least->error))
        pair = &series, least = &point;
  if (least == nullptr) return study;
  const std::string change = change_of(study, *least->error);
  const bool is_one_scenario = std::ranges::all_of(
      study.series, [&](const trace::StudySeries& one) { return one.panel == pair->panel; });
  study.title = "At the least " + change + " gives " + pair->method + " other points, in frame " +
                count(least->parameter) + (is_one_scenario ? "" : " of " + pair->panel);
  least->mark = study.measure == "way"    ? length(*least->error)
                : study.measure == "turn" ? power(*least->error) + " rad"
                                          : count(*least->error);
  const bool is_distance = study.measure == "way";
  for (trace::StudySeries& series : study.series)
    for (trace::StudyPoint& point : series.points)
      for (std::optional<double>* error : {&point.error, &point.error_worst})
        if (*error && is_distance) **error *= 1000;  // millimetres
  study.shown = "Up: " + study.error + " of the second shape after which a pair has other points" +
                (is_distance          ? ", mm"
                 : study.unit.empty() ? ""
                                      : ", " + study.unit) +
                ". Crosses: nothing changes it";
  return study;
}

}  // namespace contactscope
