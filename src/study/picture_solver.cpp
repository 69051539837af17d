#include "core/spell.h"
#include "study/picture.h"
#include "study/solver_stack.h"

namespace contactscope::record {
namespace {

using trace::StudyPoint, trace::StudySeries;

/// The largest ratio up to which every stack of a panel stands; 0 if even equal boxes fall.
double held_by_all(const Picture& plot, const std::string& panel) {
  double least = 1e300;
  for (const StudySeries& line : plot.lines) {
    if (line.panel != panel) continue;
    const double lost = first_failure(line, 1e300);
    double held = 0;
    for (const StudyPoint& point : line.points)
      if (point.parameter < lost) held = point.parameter;
    least = std::min(least, held);
  }
  if (least == 1e300) throw std::out_of_range(panel);
  return least;
}

}  // namespace

std::string result_of_jitter(Picture& plot) {
  // From the first number of sub-steps at which every stack stands.
  double last_fall = 0;
  each_point(plot.drawn, [&](const StudyPoint& point) {
    if (point.failed > 0) last_fall = std::max(last_fall, point.parameter);
  });
  plot.drop_points([&](const StudyPoint& point) { return point.parameter <= last_fall; });
  const std::vector<Kept>& methods = plot.row.methods;
  const auto speed = [&](const Kept& method) {
    return number(1000 * plot.error(method.from)) + " mm/s";
  };
  // Show the steadier of the two others; tables contain both.
  const bool is_second = plot.error(methods[1].from) < plot.error(methods[2].from);
  const Kept &soft = methods[0], &rival = methods[is_second ? 1 : 2];
  const std::string at_soft = plot.mark(soft.from, speed(soft));
  std::erase_if(plot.lines, [&](const StudySeries& line) {
    return line.method != soft.to && line.method != rival.to;
  });
  return "With 8 sub-steps a resting stack of ten moves at " + at_soft + " on soft contacts, at " +
         plot.mark(rival.from, speed(rival)) + " with " + rival.to;
}

std::string result_of_ratios(Picture& plot) {
  double most = 0;  // the largest ratio at which any stack stands, with warm starting or without
  for (const StudySeries& series : plot.measured.series)
    for (const StudyPoint& point : series.points)
      if (point.failed < point.of) most = std::max(most, point.parameter);
  const auto held = [&](const char* panel) { return number(held_by_all(plot, panel)); };
  const std::string soft = held("Soft contacts"), baumgarte = held("Baumgarte"),
                    projection = held("Projection");
  for (StudySeries& line : plot.lines) {
    const double by_all = held_by_all(plot, line.panel);
    for (StudyPoint& point : line.points)
      if (point.parameter <= by_all) point.mark = number(by_all) + " ×";
  }
  // All fall beyond this.
  plot.drop_points([&](const StudyPoint& point) { return point.parameter > 1.01 * most; });
  return "Soft contacts carry a top box " + soft +
         " times as heavy at every height, Baumgarte and projection " + baumgarte +
         (projection == baumgarte ? "" : " and " + projection);
}

std::string result_of_energy(Picture& plot) {
  bool holds = true;
  for (StudySeries& line : plot.lines)
    for (StudyPoint& point : line.points) {
      point.error = std::exchange(point.error_worst, {});
      holds = holds && (line.method == kAllPushKept || point.error.value_or(1) <= 0.01);
    }
  return holds ? "No position correction adds more than 1 % of energy in any of twenty scenes; "
                 "Baumgarte would, if all of its push were kept"
               : "A position correction adds more than 1 % of energy";
}

}  // namespace contactscope::record
