#include "core/spell.h"
#include "study/picture.h"
#include "study/solver_stack.h"

/// Pictures of what a choice saves and costs, and of the solver.
namespace contactscope::record {
namespace {

using trace::StudyPoint, trace::StudySeries;

/// Draws each line's point as two bars: its time, all in one unit and before its mark, and its error in words.
void show_bars(Picture& plot, const std::string& time, const std::string& error,
               std::string spell(const StudyPoint&)) {
  std::vector<StudySeries> bars = plot.lines;
  double most = 0;
  for (StudySeries& bar : bars) {
    StudyPoint& point = bar.points.front();
    point.error = point.nanoseconds.min;
    most = std::max(most, *point.error);
    bar.panel = time;
  }
  const auto [unit, name] = most < 1e6 ? std::pair(1e3, " µs") : std::pair(1e6, " ms");
  for (StudySeries& bar : bars)
    bar.points.front().mark.insert(0, number(*bar.points.front().error / unit, 3) + name);
  for (StudySeries& line : plot.lines) {
    line.panel = error;
    line.points.front().mark = spell(line.points.front());
    bars.push_back(line);
  }
  plot.lines = std::move(bars);
  plot.drawn.form = trace::StudyForm::Bars;
}

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

std::string result_of_box_path(Picture& plot) {
  const char *const any = "by the path of any hulls", *const own = "by the path of boxes";
  double least = 1e300, most = 0;
  for (const StudyPoint& slow : series_of(plot.measured, any).points) {
    const double ratio = error_of(slow) / error_at(series_of(plot.measured, own), slow.parameter);
    least = std::min(least, ratio), most = std::max(most, ratio);
  }
  const double saved = plot.error(any) - plot.error(own);
  plot.mark(any, duration(plot.error(any)));
  plot.mark(
      own, duration(plot.error(own)) + ": saves " + duration(saved) + ", costs a second code path");
  StudySeries& goal = plot.lines.emplace_back(plot.lines.back());
  goal.method = plot.drawn.signal = "goal";
  goal.points.front().mark = "goal: as fast as the special path";
  plot.drawn.form = trace::StudyForm::Bars;
  return "Goal missed: as a general hull a box takes " + number(least) + " to " + number(most) +
         " times as long as by a special path";
}

std::string result_of_trees(Picture& plot) {
  const char *const aligned = "axis-aligned boxes (AABBs)",
                    *const oriented = "oriented boxes (OBBs)",
                    *const planes = "k-DOPs (k = 18 planes)";
  const auto time = [&](const char* volume) { return plot.point(volume).nanoseconds.min; };
  const std::string fewer = number(plot.error(aligned) / plot.error(oriented));
  const std::string faster = percent(time(oriented) / time(aligned));
  const auto is_middle = [](double low, double value, double high) {
    return low < value && value < high;
  };
  const bool is_between =
      is_middle(plot.error(oriented), plot.error(planes), plot.error(aligned)) &&
      is_middle(time(oriented), time(planes), time(aligned));
  show_bars(plot, "time of a query", "volumes that it compares",
            [](const StudyPoint& point) { return count(*point.error); });
  return "Trees of OBBs compare 1/" + fewer + " of the volumes that trees of AABBs do, in " +
         faster + " of the time" + (is_between ? "; 18-DOPs are between" : "");
}

std::string result_of_precision(Picture& plot) {
  const char *const in_float = "float, separating axis test", *const in_double =
                                                                  "double, separating axis test";
  const double slower =
      plot.point(in_double).nanoseconds.min / plot.point(in_float).nanoseconds.min;
  const double closer = plot.error(in_float) / plot.error(in_double);
  show_bars(plot, "least time of a call", "error of the depth / size of the hulls",
            [](const StudyPoint& point) { return power(*point.error); });
  return "Double takes " + number(slower) + " times the time of float, and finds the depth " +
         power(closer) + " times as exactly";
}

std::string result_of_axes(Picture& plot) {
  StudySeries pairs{"pairs of edges", {}, "", "", {}, {}, true};
  // A hull of n vertices on an ellipsoid has 3 n - 6 edges.
  for (const StudyPoint& point : plot.lines.at(0).points) {
    const double edges = 3 * point.parameter - 6;
    pairs.points.push_back({point.parameter, edges * edges, {}, {}});
  }
  plot.lines.push_back(pairs);
  for (StudySeries& line : plot.lines) {
    const double first = *line.points.front().error;
    for (StudyPoint& point : line.points) *point.error /= first;
    line.points.back().mark = printed("%.3g ×", *line.points.back().error);
  }
  plot.lines[1].method = "a walk finds the pairs that matter";
  const auto spelled = [&](std::size_t line) { return plot.lines[line].points.back().mark; };
  return "With " + spelled(2) + " the pairs of edges the test takes " + spelled(0) +
         " the time; only " + spelled(1) + " if a walk finds the pairs that matter";
}

std::string result_of_max_points(Picture& plot) {
  const std::string& whole = plot.row.methods.front().from;
  const StudySeries line = plot.lines.at(0), measured = series_of(plot.measured, whole),
                    contacts = series_of(plot.measured, whole + ", contacts alone");
  const auto solver = [&](double points) {
    return point_at(measured, points).nanoseconds.min - point_at(contacts, points).nanoseconds.min;
  };
  plot.lines.clear();
  for (StudyPoint point : line.points) {  // tables contain the numbers between
    if (!std::has_single_bit(static_cast<unsigned>(point.parameter))) continue;
    point.nanoseconds.min = solver(point.parameter);
    plot.lines.push_back({counted(std::size_t(point.parameter), "point"), {point}, "", "", {}, 0});
  }
  show_bars(plot, "cost: time of the solver in a frame",
            "instability: speed of boxes that should rest", [](const StudyPoint& point) {
              return point.error ? number(std::round(100 * *point.error) / 100) + " mm/s"
                                 : "the stack falls";
            });
  return "4 points instead of 8: the solver is " + number(solver(8) / solver(4)) +
         " times as fast and the stack " +
         (error_at(measured, 4) < 0.01 ? "still stands" : "moves") + "; on one point it falls";
}

std::string result_of_pairs(Picture& plot) {
  each_point(plot.drawn, [](StudyPoint& point) { point.error = point.nanoseconds.min / 1000; });
  const auto time = [&](const char* method) {
    return plot.mark(method, duration(plot.point(method).nanoseconds.min));
  };
  const std::string all = time("all pairs of features"), walked = time("V-Clip");
  return "The distance of two hulls of 128 vertices: GJK takes " + time("GJK") + ", V-Clip " +
         walked + ", a search of all pairs " + all;
}

std::string result_of_gains(Picture& plot) {
  StudySeries &without = plot.lines.at(0), &with = plot.lines.at(1);
  const std::string ends = count(with.points.at(0).parameter + double(with.points.size()) - 1);
  with.points.back().mark = "ends at step " + ends;
  return "Points near one plane: without tolerances GJK cycles until its cap of " +
         count(double(without.points.size())) + " steps, with them it ends at step " + ends;
}

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
