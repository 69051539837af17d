#include "study/reducer_study.h"

#include <algorithm>
#include <vector>

#include "reduce/reducer.h"
#include "study/elliptical_polygon.h"
#include "study/errors.h"
#include "study/pass_times.h"
#include "study/reduction_quality.h"

namespace contactscope {
namespace {

constexpr int kPointCounts[] = {5, 6, 8, 12, 16, 32};
constexpr int kKept = 4;
constexpr int kCases = 2000;
constexpr int kRepetitions = 25;
// Areas and distances are computed in double from coordinates within 6 m and patches of 0.02 m and
// more; what is smaller than this is their rounding.
constexpr double kRounding = 1e-12;
// Float coordinates of that size are off by some 1e-7 m: of two choices that differ by less, a
// method cannot know the better one.
constexpr double kResolution = 1e-6;

// The frames that a reducer with a memory has seen before, and how far apart they are: what a body
// does that comes to rest. See neighbouring_frame().
constexpr int kFramesBefore = 8;
constexpr double kMoveOfFrame = 0.01;

struct Method {
  std::string name;
  Reducer<float> reducer;
  bool remembers = false;
};

/// Who goes by the frame before has two lines: with a frame before, and without one.
std::vector<Method> methods() {
  std::vector<Method> list;
  for (const ReducerInfo& info : reducers()) {
    const Reducer<float> reducer = find_reducer<float>(info.name);
    if (reducer == nullptr) continue;  // "none" is no method
    list.push_back({info.name, reducer, info.remembers});
    if (info.remembers) list.push_back({info.name + ", first frame", reducer});
  }
  return list;
}

ReduceOptions reduce_options(int index) {
  ReduceOptions options;
  options.max_points = kKept;
  options.seed = static_cast<std::uint64_t>(index) + 1;
  return options;
}

/// A manifold to reduce, and the frames that led to it, the oldest first.
struct Case {
  ContactPolygon polygon;
  std::vector<ContactPolygon> before;
};

Case make_case(std::mt19937_64& engine, std::mt19937_64& motion, int count) {
  Case result;
  result.polygon = elliptical_polygon(engine, count);
  const ContactPolygon* next = &result.polygon;
  for (int i = 0; i < kFramesBefore; ++i) {
    result.before.push_back(neighbouring_frame(*next, kMoveOfFrame, motion));
    next = &result.before.back();
  }
  std::ranges::reverse(result.before);
  return result;
}

/// What a method that remembers kept in the last of the frames before.
std::vector<FeatureId> remembered(const Method& method, const Case& one) {
  std::vector<FeatureId> ids;
  for (const ContactPolygon& frame : one.before) {
    ReduceOptions options = reduce_options(0);
    options.previous = ids;
    const Reduction reduction = reduce<float>(method.reducer, frame.points, frame.normal, options);
    std::vector<FeatureId> kept;
    for (const int i : reduction.kept) kept.push_back(frame.points[static_cast<std::size_t>(i)].id);
    ids = std::move(kept);
  }
  return ids;
}

/// One method at one number of points: what it remembers of each case, errors by each measure, and
/// times.
struct Cell {
  std::vector<std::vector<FeatureId>> memory;  // empty for those without
  Errors area, wrench, deepest;
  int failed = 0;
  PassTimes times;
};

Reduction reduced(const Method& method, const std::vector<Case>& cases, const Cell& cell,
                  int index) {
  const auto i = static_cast<std::size_t>(index);
  ReduceOptions options = reduce_options(index);
  if (method.remembers) options.previous = cell.memory[i];
  return reduce<float>(method.reducer, cases[i].polygon.points, cases[i].polygon.normal, options);
}

ReductionQuality judge(const Reduction& reduction, const ContactPolygon& polygon) {
  std::vector<ContactPoint<double>> points;
  for (const ContactPoint<float>& point : polygon.points) {
    points.push_back({point.position.cast<double>(), point.separation, point.id});
  }
  const Vec3d normal = polygon.normal.cast<double>().normalized();
  return measure_reduction(points, normal, {reduction.kept.begin(), reduction.kept.size()}, kKept);
}

double without_rounding(double error) {
  return error < kRounding ? 0 : error;
}

/// Who keeps no area has failed, and the error of that is all there is to lose.
void judge_all(const Method& method, const std::vector<Case>& cases, Cell& cell) {
  for (int i = 0; i < static_cast<int>(cases.size()); ++i) {
    const Case& one = cases[static_cast<std::size_t>(i)];
    if (method.remembers) cell.memory.push_back(remembered(method, one));
    const ReductionQuality quality = judge(reduced(method, cases, cell, i), one.polygon);
    if (!(quality.area > 0)) ++cell.failed;
    cell.area.add(without_rounding(1 - quality.area_ratio));
    cell.wrench.add(without_rounding(quality.wrench_error));
    cell.deepest.add(quality.deepest_kept ? 0 : 1);
  }
}

void time_pass(const Method& method, const std::vector<Case>& cases, Cell& cell) {
  cell.times.measure(static_cast<int>(cases.size()), [&](int i) {
    const Reduction reduction = reduced(method, cases, cell, i);
    return reduction.kept.empty() ? 0.0 : static_cast<double>(reduction.kept.back());
  });
}

std::string cases_spelled(const StudyOptions& options, int count) {
  return std::to_string(count) + " elliptical polygons a point, seed " +
         std::to_string(options.seed);
}

trace::Study described(const StudyOptions& options, int count) {
  trace::Study study;
  study.study = "reducers";
  study.context = study_context("float");
  study.parameter = "points";
  study.resolution = kResolution;
  study.reference = "the largest quadrilateral, exact in double, " + cases_spelled(options, count);
  return study;
}

}  // namespace

std::vector<trace::Study> study_reducers(const StudyOptions& options,
                                         const StudyProgress& progress) {
  const int count = options.cases.value_or(kCases);
  const int repetitions = options.repetitions.value_or(kRepetitions);
  const std::vector<Method> all = methods();
  const std::size_t counts = std::size(kPointCounts);
  std::vector<std::vector<Case>> cases(counts);
  std::vector<std::vector<Cell>> cells(all.size(), std::vector<Cell>(counts));

  const int steps = static_cast<int>(counts) + repetitions;
  int done = 0;
  std::mt19937_64 engine(options.seed);
  std::mt19937_64 motion(~options.seed);  // its own: the polygons are the same whatever moves them
  for (std::size_t c = 0; c < counts; ++c) {
    for (int i = 0; i < count; ++i) {
      cases[c].push_back(make_case(engine, motion, kPointCounts[c]));
    }
    for (std::size_t m = 0; m < all.size(); ++m) judge_all(all[m], cases[c], cells[m][c]);
    for (Case& one : cases[c]) one.before.clear();
    progress(++done, steps, "errors of " + std::to_string(kPointCounts[c]) + " points");
  }
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    for (std::size_t c = 0; c < counts; ++c) {
      for (std::size_t turn = 0; turn < all.size(); ++turn) {
        const std::size_t m = (turn + static_cast<std::size_t>(repetition)) % all.size();
        time_pass(all[m], cases[c], cells[m][c]);
      }
    }
    progress(++done, steps, "times");
  }

  trace::Study area = described(options, count);
  area.measure = "area";
  area.title = "What each reducer loses of the contact area";
  area.error = "lost area, 1 − area / best";
  trace::Study wrench = described(options, count);
  wrench.measure = "wrench";
  wrench.title = "What each reducer loses of the resisted moment";
  wrench.error = "lost moment arm / patch radius, worst axis";
  wrench.reference = "all points, " + cases_spelled(options, count);
  trace::Study deepest = described(options, count);
  deepest.measure = "deepest";
  deepest.title = "How often each reducer loses the deepest point";
  deepest.error = "share of the patches whose deepest point is lost";
  deepest.reference = wrench.reference;
  deepest.resolution = 0;  // counted
  for (std::size_t m = 0; m < all.size(); ++m) {
    for (trace::Study* study : {&area, &wrench, &deepest})
      study->series.push_back({all[m].name, {}});
    for (std::size_t c = 0; c < counts; ++c) {
      const Cell& cell = cells[m][c];
      const auto point = [&](const Errors& errors) {
        return study_point(kPointCounts[c], errors, cell.times, cell.failed, count);
      };
      area.series.back().points.push_back(point(cell.area));
      wrench.series.back().points.push_back(point(cell.wrench));
      deepest.series.back().points.push_back(point(cell.deepest));
      deepest.series.back().points.back().error_worst.reset();  // a share has none
    }
  }
  return {std::move(area), std::move(wrench), std::move(deepest)};
}

}  // namespace contactscope
