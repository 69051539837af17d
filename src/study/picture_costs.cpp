#include "core/spell.h"
#include "study/picture.h"

/// Pictures of what a choice saves and costs.
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

}  // namespace contactscope::record
