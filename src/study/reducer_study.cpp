#include "study/reducer_study.h"

#include <algorithm>
#include <optional>

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

struct Method {
  std::string name;
  Reducer<float> reducer;
};

std::vector<Method> methods() {
  std::vector<Method> list;
  for (const ReducerInfo& info : reducers()) {
    const Reducer<float> reducer = find_reducer<float>(info.name);
    if (reducer != nullptr) list.push_back({info.name, reducer});  // "none" is no method
  }
  return list;
}

ReduceOptions reduce_options(int index) {
  ReduceOptions options;
  options.max_points = kKept;
  options.seed = static_cast<std::uint64_t>(index) + 1;
  return options;
}

Reduction reduced(const Method& method, const std::vector<ContactPolygon>& cases, int index) {
  const ContactPolygon& polygon = cases[static_cast<std::size_t>(index)];
  return reduce<float>(method.reducer, polygon.points, polygon.normal, reduce_options(index));
}

/// One method at one number of points: errors by each measure, and times.
struct Cell {
  Errors area, wrench, deepest;
  int failed = 0;
  PassTimes times;
};

std::optional<ReductionQuality> judge(const Method& method,
                                      const std::vector<ContactPolygon>& cases, int index) {
  const Reduction reduction = reduced(method, cases, index);
  if (reduction.status != ReduceStatus::Reduced || reduction.kept.empty()) return std::nullopt;
  const ContactPolygon& polygon = cases[static_cast<std::size_t>(index)];
  std::vector<ContactPoint<double>> points;
  for (const ContactPoint<float>& point : polygon.points) {
    points.push_back({point.position.cast<double>(), point.separation, point.id});
  }
  const Vec3d normal = polygon.normal.cast<double>().normalized();
  const ReductionQuality quality =
      measure_reduction(points, normal, {reduction.kept.begin(), reduction.kept.size()}, kKept);
  if (!(quality.area > 0)) return std::nullopt;
  return quality;
}

double without_rounding(double error) {
  return error < kRounding ? 0 : error;
}

void judge_all(const Method& method, const std::vector<ContactPolygon>& cases, Cell& cell) {
  for (int i = 0; i < static_cast<int>(cases.size()); ++i) {
    const std::optional<ReductionQuality> quality = judge(method, cases, i);
    if (!quality) {
      ++cell.failed;
      continue;
    }
    cell.area.add(without_rounding(1 - quality->area_ratio));
    cell.wrench.add(without_rounding(quality->wrench_error));
    cell.deepest.add(quality->deepest_kept ? 0 : 1);
  }
}

void time_pass(const Method& method, const std::vector<ContactPolygon>& cases, Cell& cell) {
  cell.times.measure(static_cast<int>(cases.size()), [&](int i) {
    const Reduction reduction = reduced(method, cases, i);
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
  study.reference = "all subsets of four points, " + cases_spelled(options, count);
  return study;
}

}  // namespace

std::vector<trace::Study> study_reducers(const StudyOptions& options,
                                         const StudyProgress& progress) {
  const int count = options.cases.value_or(kCases);
  const int repetitions = options.repetitions.value_or(kRepetitions);
  const std::vector<Method> all = methods();
  const std::size_t counts = std::size(kPointCounts);
  std::vector<std::vector<ContactPolygon>> cases(counts);
  std::vector<std::vector<Cell>> cells(all.size(), std::vector<Cell>(counts));

  const int steps = static_cast<int>(counts) + repetitions;
  int done = 0;
  std::mt19937_64 engine(options.seed);
  for (std::size_t c = 0; c < counts; ++c) {
    for (int i = 0; i < count; ++i) {
      cases[c].push_back(elliptical_polygon(engine, kPointCounts[c]));
    }
    for (std::size_t m = 0; m < all.size(); ++m) judge_all(all[m], cases[c], cells[m][c]);
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
