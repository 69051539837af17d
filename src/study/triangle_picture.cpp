#include <algorithm>
#include <map>

#include "core/at.h"
#include "study/picture.h"

namespace contactscope {
namespace {

using namespace record;

/// The first of equal worst points.
trace::StudyPoint& worst_of(trace::Study& study, const std::string& method) {
  trace::StudyPoint* worst = nullptr;
  for (trace::StudySeries& series : study.series)
    if (series.method == method)
      for (trace::StudyPoint& point : series.points)
        if (worst == nullptr || point.error.value_or(0) > worst->error.value_or(0)) worst = &point;
  if (worst == nullptr) throw std::out_of_range(method);
  return *worst;
}

std::string share_of(double share) {
  return share > 0 ? percent(share) : "none";
}

constexpr const char* kUsualSize = "triangles of 1 m";
constexpr const char* kEpsilon = "float with an epsilon of 1 µm";

/// Lines end at the first parameter at which every method is almost always right.
void end_where_all_are_right(trace::Study& study) {
  constexpr double kAlmostNone = 1e-3;
  std::map<double, double> most;  // share of wrong answers, by parameter
  for (const trace::StudySeries& series : study.series)
    for (const trace::StudyPoint& point : series.points)
      most[point.parameter] = std::max(most[point.parameter], point.error.value_or(0));
  const auto end =
      std::ranges::find_if(most, [](const auto& one) { return one.second < kAlmostNone; });
  if (end == most.end()) return;
  for (trace::StudySeries& series : study.series)
    std::erase_if(series.points, [&](const auto& point) { return point.parameter > end->first; });
}

trace::Study picture_wrong(const trace::Study& measured) {
  trace::Study study = measured;
  drop_resolution(study);
  trace::Study judged = study;
  keep_panels(judged, {{kUsualSize, ""}});
  keep_methods(study, {{"float", "float"},
                       {"float, epsilon 1e-6 m", kEpsilon},
                       {"double", "double"},
                       {"exact", "exact"}});
  // An epsilon only fits one size; tables contain the others.
  keep_panels(study, {{kUsualSize, ""}});
  end_where_all_are_right(study);
  join_equal(study);
  for (trace::StudySeries& series : study.series)
    series.parameter = "units in the last place off the plane";
  study.unit = trace::kShare;
  study.shown = "Up: share of wrong answers to whether two triangles of 1 m share a point";
  report(study, [&] {
    const auto most = [&](trace::Study& whose, const char* method) {
      trace::StudyPoint& worst = worst_of(whose, method);
      return worst.mark = share_of(worst.error.value_or(0));
    };
    const std::string in_double = most(judged, "double"), exact = most(judged, "exact");
    const std::string in_float = most(study, "float"), guarded = most(study, kEpsilon);
    // The names of the lines contain the shared value.
    for (trace::StudySeries& series : study.series)
      if (in_double == exact && series.method == "double and exact") series.method += ": " + exact;
    return "Float gets up to " + in_float +
           " of nearly coplanar triangles wrong, float with an epsilon of 1 µm up to " + guarded;
  });
  return study;
}

trace::Study picture_answers(const trace::Study& measured) {
  trace::Study study = measured;
  double corners = 0;
  const auto wrong_in = [&](const char* panel) {
    double wrong = 0;
    corners = 0;
    for (const trace::StudySeries& series : measured.series) {
      if (series.panel != panel) continue;
      for (const trace::StudyPoint& point : series.points) wrong += point.failed, corners += 1;
    }
    return wrong > 0 ? count(wrong) : std::string("none");
  };
  const std::string in_float = wrong_in("float"), in_double = wrong_in("double"),
                    exact = wrong_in("exact");
  study.title = "Of " + count(corners) + " places of a corner at a plane float gets " + in_float +
                " wrong, double " + in_double + ", the exact test " + exact;
  for (trace::StudySeries& series : study.series)
    series.panel[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(series.panel[0])));
  study.shown =
      "Colour: the answer for a triangle, a corner of which is moved by its last bits; on the "
      "diagonal it touches the plane, above it crosses";
  return study;
}

}  // namespace

trace::Study picture_triangles(const trace::Study& measured) {
  return measured.form == trace::StudyForm::Answers ? picture_answers(measured)
                                                    : picture_wrong(measured);
}

}  // namespace contactscope
