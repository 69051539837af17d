#include "study/picture.h"

#include "core/spell.h"

namespace contactscope::record {
namespace {

using trace::StudyPoint, trace::StudySeries;

std::string percent_or(double share, const std::string& none) {
  return share > 0 ? percent(share) : none;
}

/// "up to 3 %", or "none".
std::string up_to(double share) { return share > 0 ? "up to " + percent(share) : "none"; }

/// Divides each error by that of `base` at the same parameter.
void divide_by(StudySeries& series, const StudySeries& base) {
  for (StudyPoint& point : series.points) {
    const double by = error_at(base, point.parameter);
    if (point.error) point.error_worst = point.error = *point.error / by;
  }
}

}  // namespace

double first_failure(const StudySeries& line, double start) {
  for (const StudyPoint& point : line.points)
    if (point.failed > 0) start = std::min(start, point.parameter);
  return start;
}

std::string result_of_thresholds(Picture& plot) {
  std::ranges::stable_sort(plot.lines, std::ranges::greater(), &StudySeries::panel);
  const auto is_guarded = [](const StudySeries& line) { return line.method == kGuarded; };
  const auto worst = [](const StudyPoint& point) { return point.error_worst.value_or(0); };
  // Drawn on top; if both kinds are always right, one line of zeros suffices.
  const auto guarded =
      std::stable_partition(plot.lines.begin(), plot.lines.end(), std::not_fn(is_guarded));
  const bool never_wrong = std::all_of(guarded, plot.lines.end(), [&](const StudySeries& line) {
    return std::ranges::all_of(line.points, [&](const auto& point) { return worst(point) == 0; });
  });
  if (never_wrong && guarded != plot.lines.end()) plot.lines.erase(guarded + 1, plot.lines.end());
  double missed = 0, closed = 0;
  for (StudySeries& line : plot.lines) {
    const bool is_missed = line.panel.starts_with("overlaps");
    line.look = is_guarded(line) ? 2 : is_missed ? 0 : 1;
    const std::string kind = std::exchange(line.panel, "");
    if (is_guarded(line)) {
      if (never_wrong) line.method += ": never wrong";
      continue;
    }
    line.method = kind;
    // The last of equal ones, where the line turns.
    const auto most = std::ranges::max_element(line.points.rbegin(), line.points.rend(), {}, worst);
    if (most == line.points.rend() || worst(*most) == 0) continue;
    (is_missed ? missed : closed) = worst(*most);
    if (plot.measured.measure == "threshold") most->mark = number(worst(*most)) + " mm";
  }
  if (plot.measured.measure != "threshold") return {};
  return "In float a small threshold misses overlaps of up to " + number(missed) +
         " mm, a large one closes gaps of up to " + number(closed) + " mm";
}

/// For the largest number of boxes; added to the names of lines that reach it.
std::string result_of_broad_phases(Picture& plot) {
  const std::string& panel = plot.row.panels.front().from;
  const StudySeries& columns = series_of(plot.measured, "columns", panel);
  if (columns.points.empty()) return {};
  const double most = columns.points.back().parameter;
  const auto time_of = [&](const char* method) {
    return duration(point_at(series_of(plot.measured, method, panel), most).nanoseconds.median);
  };
  const std::string result = "To find all pairs of " + count(most) +
                             " boxes a sweep in columns takes " + time_of("columns") + ", a grid " +
                             time_of("grid") + ", a tree " + time_of("tree");
  // Explain why other lines end earlier.
  std::vector<std::string> slow;
  double given = 0;
  for (StudySeries& line : plot.lines) {
    if (line.points.empty()) continue;
    const StudyPoint& last = line.points.back();
    if (last.parameter == most) line.method += ": " + duration(last.nanoseconds.median);
    if (last.parameter >= most) continue;
    slow.push_back(line.method);
    given = std::max(given, last.parameter);
  }
  if (!slow.empty())
    plot.drawn.shown += "; " + listed(slow) + " were given at most " + count(given);
  return result;
}

std::string result_of_updates(Picture& plot) {
  plot.drawn.reference.clear();  // for results; these are times
  std::map<std::string, std::string> total;
  for (StudySeries& line : plot.lines) {
    const std::string panel = line.panel;
    line.panel.clear();
    plot.drawn.shown = "Up: time of all frames so far, in which a ball of " +
                       panel.substr(0, panel.find(' ')) +
                       " triangles is twisted, its tree brought up to date and queried";
    double sum = 0;
    for (StudyPoint& point : line.points) point.error = point.error_worst = sum += error_of(point);
    total[line.method] = duration(1e6 * sum, 3);
    line.method += ": " + total[line.method];
  }
  if (total.size() < plot.row.methods.size()) return {};
  return count(double(plot.lines.front().points.size())) + " frames take " +
         total["always rebuilt"] + " with a tree rebuilt in each, " +
         total["rebuilt where needed"] + " rebuilt where needed, " + total["only refitted"] +
         " only refitted";
}

std::string result_of_refitting(Picture& plot) {
  plot.drawn.reference.clear();  // for results; these are counts
  const StudySeries rebuilt = series_of(plot.drawn, "always rebuilt");
  double refitted = 0, automatic = 0;
  for (StudySeries& line : plot.lines) {
    divide_by(line, rebuilt);
    if (line.points.empty()) continue;
    if (line.method == "only refitted") {
      refitted = error_of(line.points.back());
      line.points.back().mark = number(refitted) + " ×";
    }
    if (line.method == "rebuilt where needed") {
      StudyPoint& most = *std::ranges::max_element(line.points, {}, error_of);
      automatic = error_of(most);
      most.mark = number(automatic, 3) + " ×";
    }
  }
  if (refitted == 0) return {};
  return "A tree that is only refitted ends at " + number(refitted) +
         " times the node pairs of one rebuilt; rebuilt where needed it stays within " +
         number(automatic, 3);
}

std::string result_of_coherence(Picture& plot) {
  plot.drawn.reference.clear();  // for results; these are times
  double least = 1e9, most = 0;
  for (StudySeries& line : plot.lines) {
    divide_by(line, series_of(plot.measured, "from roots", line.panel));
    line.method = std::exchange(line.panel, "");
    line.look = static_cast<int>(&line - plot.lines.data());
    for (const StudyPoint& point : line.points) {
      least = std::min(least, point.error.value_or(least));
      most = std::max(most, error_of(point));
    }
  }
  if (most == 0) return {};
  return "To begin where the last frame's query ended takes " + percent(least) + " to " +
         percent(most) + " of the time from the roots";
}

std::string result_near_plane(Picture& plot) {
  // Lines end at the first parameter at which every method is almost always right.
  constexpr double kAlmostNone = 1e-3;
  std::map<double, double> wrong;  // the largest share, by parameter
  each_point(plot.drawn, [&](const StudyPoint& point) {
    wrong[point.parameter] = std::max(wrong[point.parameter], error_of(point));
  });
  const auto end = std::ranges::find_if(wrong, [](auto& one) { return one.second < kAlmostNone; });
  if (end != wrong.end())
    plot.drop_points([&](const StudyPoint& point) { return point.parameter > end->first; });
  plot.join_equal();
  const auto mark_worst = [&](const char* method) {
    for (StudySeries& line : plot.lines) {
      if (line.method != method || line.points.empty()) continue;
      StudyPoint& worst = *std::ranges::max_element(line.points, {}, error_of);
      return worst.mark = percent_or(error_of(worst), "none");
    }
    throw std::out_of_range(method);
  };
  const std::string in_float = mark_worst("float");
  const std::string guarded = mark_worst("float with an epsilon of 1 µm");
  const std::string joined = "double and exact";
  plot.add_to_name(joined, percent_or(largest_error(plot.drawn, {joined}), "none"));
  return "Float gets up to " + in_float +
         " of nearly coplanar triangles wrong, float with an epsilon of 1 µm up to " + guarded;
}

std::string result_of_last_bits(Picture& plot) {
  std::map<std::string, std::size_t> corners, wrong;  // by panel
  for (const StudySeries& line : plot.lines) {
    corners[line.panel] += line.points.size();
    for (const StudyPoint& point : line.points)
      wrong[line.panel] += static_cast<std::size_t>(point.failed);
  }
  const auto wrong_in = [&](const char* panel) {
    return wrong[panel] > 0 ? count(double(wrong[panel])) : "none";
  };
  return "Of " + count(double(corners["Exact"])) + " places of a corner at a plane float gets " +
         wrong_in("Float") + " wrong, double " + wrong_in("Double") + ", the exact test " +
         wrong_in("Exact");
}

std::string result_of_phase(Picture& plot) {
  const auto by_edges = [&](const std::string& panel) {
    double edges = 0, touching = 0;
    for (const StudySeries& line : plot.lines)
      for (const StudyPoint& point : line.points) {
        if (line.panel != panel) continue;
        edges += point.error == 3;
        touching += point.error != 0;
      }
    return percent(edges / touching);
  };
  return "Two edges make the contact in " + by_edges("No preference") +
         " of the poses that touch, in " + by_edges("Faces preferred") + " if faces are preferred";
}

std::string result_of_impacts(Picture& plot) {
  // Means exclude missed hits.
  for (StudySeries& line : plot.lines) {
    const auto most = std::ranges::max_element(line.points, {}, &StudyPoint::failed);
    if (most == line.points.end() || most->failed == 0) continue;
    plot.drawn.shown += " Up to " + count(most->failed) + " of " + count(most->of) +
                        " hits are missed by " + line.method + ", and left out here.";
    for (StudyPoint& point : line.points) point.failed = 0;
  }
  const std::string own = plot.share("time of impact"), sampled = plot.share("64 samples");
  plot.mark("time of impact", "off by " + own);
  plot.mark("64 samples", "off by " + sampled);
  return "Over 10 m in a step a search for the time of impact is off by " + own +
         " of the step, 64 samples by " + sampled;
}

std::string result_of_bullets(Picture& plot) {
  plot.join_equal();
  const std::vector<std::string> swept = {"swept bounding sphere", "conservative advancement",
                                          "time of impact"};
  for (StudySeries& line : plot.lines)
    if (line.method == listed(swept)) line.method = "swept, in three ways";
  // Here all bullets are spheres.
  constexpr std::string_view kBullet = "bullet", kSphere = "sphere";
  std::string& reference = plot.drawn.reference;
  for (std::size_t i = 0; (i = reference.find(kBullet, i)) != std::string::npos;)
    reference.replace(i, kBullet.size(), kSphere);
  plot.mark("speculative margin of 2 cm", plot.share("speculative margin of 2 cm"));
  return "At 10 m/s " + plot.mark("discrete", plot.share("discrete")) +
         " of the spheres pass a wall of 1 cm; of those that are swept " +
         up_to(largest_error(plot.measured, swept));
}

std::string result_of_fields(Picture& plot) {
  const auto closer = [&](const char* method) {
    return number(plot.error("trilinear") / plot.error(method)) + " ×";
  };
  const auto slower = [&](const char* method) {
    return number(plot.point(method).nanoseconds.min / plot.point("trilinear").nanoseconds.min) +
           " ×";
  };
  constexpr const char* kExact = "cubic with exact cells";
  for (const char* method : {"cubic", kExact})
    plot.mark_with_name(method,
                        closer(method) + " as close as trilinear, " + slower(method) + " the time");
  return "A cubic field with exact cells is " + closer(kExact) +
         " as close as a trilinear one, in " + slower(kExact) + " the time";
}

std::string result_of_building(Picture& plot) {
  plot.drawn.reference.clear();  // it describes errors
  double slowest = 0;
  for (StudySeries& line : plot.lines) {
    const double time = 1e6 * error_at(line, plot.row.options.at);
    line.method += ": " + duration(time);
    slowest = std::max(slowest, time);
  }
  if (slowest == 0) return {};
  return "A field of " + number(plot.row.options.at, 3) + " cells takes up to " +
         duration(slowest) + " to build";
}

std::string result_of_points(Picture& plot) {
  for (StudySeries& line : plot.lines) {
    line.method += std::exchange(line.panel, "");
    line.look = static_cast<int>(&line - plot.lines.data()) + 2;
  }
  // The worst depth of the conservative search.
  StudySeries searched;
  for (const StudySeries& series : plot.measured.series) {
    if (series.method != "conservative") continue;
    if (searched.points.empty()) searched.points = series.points;
    for (StudyPoint& point : searched.points)
      for (const StudyPoint& other : series.points)
        if (other.parameter == point.parameter && other.error > point.error) point = other;
  }
  if (!searched.points.empty())
    plot.lines.push_back(
        {"conservative search: any depth", searched.points, "", plot.row.parameter, {}, 1});
  const std::string missed = plot.share("sampled");
  plot.mark("at points: 1/100 of a cell deep", missed);
  return "Points one cell apart miss " + missed +
         " of the shallowest overlaps, a conservative search " +
         up_to(largest_error(plot.measured, {"conservative"}));
}

std::string result_of_plate(Picture& plot) {
  plot.join_equal();
  for (StudySeries& line : plot.lines)
    if (line.method.find(" and ") != std::string::npos) line.method = "with exact cells";
  const auto lost = [&](const char* method) { return percent_or(plot.error(method), "nothing"); };
  const std::string exact = lost("cubic with exact cells");
  plot.mark("trilinear", lost("trilinear"));
  plot.mark("cubic", lost("cubic"));
  if (exact == "nothing")
    plot.add_to_name("with exact cells", exact);
  else
    plot.mark("with exact cells", exact);
  return "Of a plate a quarter of a cell thick a trilinear field loses " + lost("trilinear") +
         ", a cubic one " + lost("cubic") + ", with exact cells " + exact;
}

std::string result_of_depths(Picture& plot) {
  const auto time = [&](const char* method) {
    return duration(plot.point(method).nanoseconds.min);
  };
  const char *const sat = "double, SAT", *const epa = "double, EPA by tolerance",
                    *const mpr = "double, MPR by tolerance", *const samples = "double, sampling";
  for (const char* const exact : {sat, epa})
    plot.mark_with_name(exact, time(exact) + ", to rounding");
  for (const char* const rough : {mpr, samples})
    plot.mark_with_name(rough, time(rough) + ", " + plot.share(rough) + " off");
  return "SAT and EPA find the depth to rounding in " + time(sat) + " and " + time(epa) +
         "; MPR takes " + time(mpr) + ", and is " + plot.share(mpr) + " off";
}

std::string result_of_distance(Picture& plot) {
  plot.drawn.signal.clear();
  // Beyond it only found contacts would count; the map of overlaps shows the lost ones.
  double lost = 1e300;
  for (const StudySeries& line : plot.lines) lost = first_failure(line, lost);
  plot.drop_points([&](const StudyPoint& point) { return point.parameter >= lost; });
  const auto off = [&](const char* method) {
    if (const auto& worst = plot.point(method).error_worst) return power(*worst);
    throw std::out_of_range("no contact is found");
  };
  const std::string in_float = off("float, unrounded");
  plot.mark("float, unrounded", "1 km: " + in_float);
  const std::string in_double = off("double, unrounded");
  plot.mark("double, unrounded", "1 km: " + in_double);
  return "1 km from the origin a contact is off by " + in_float +
         " of its shapes' size in float, by " + in_double + " in double";
}

std::string result_of_overlaps(Picture& plot) {
  plot.drawn.row.clear();  // the subtitle has it
  constexpr double kKilometre = 1000, kNone = 1e300;
  double deepest = 0;      // that float loses at 1 km, relative to the size
  double nearest = kNone;  // distance at which double loses one
  for (const StudySeries& line : plot.lines) {
    if (line.panel == "Double") nearest = first_failure(line, nearest);
    if (line.panel == "Float" && line.row && point_at(line, kKilometre).failed > 0)
      deepest = std::max(deepest, *line.row);
  }
  const std::string nearest_km = count(nearest == kNone ? 0 : nearest / kKilometre) + " km";
  for (StudySeries& line : plot.lines)
    for (StudyPoint& point : line.points) {
      if (line.panel == "Float" && point.parameter == kKilometre && line.row == deepest)
        point.mark = "1 km: " + power(deepest);
      if (line.panel == "Double" && point.parameter == nearest && point.failed > 0)
        point.mark = nearest_km;
    }
  return "1 km from the origin float loses some overlaps of " + power(deepest) +
         " of the size; double loses none" + (nearest == kNone ? "" : " nearer than " + nearest_km);
}

}  // namespace contactscope::record
