#include <algorithm>
#include <span>

#include "core/at.h"
#include "reduce/reducer.h"
#include "study/exploration.h"
#include "study/random_cases.h"
#include "study/study.h"

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
  const ReducerInfo* reducer;
  bool remembers = false;
};

/// Who goes by the frame before has two lines: with a frame before, and without one.
std::vector<Method> methods() {
  std::vector<Method> list;
  for (const ReducerInfo& info : reducers()) {
    const ReducerInfo* reducer = find_reducer(info.name);
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

/// A manifold to reduce, and before it the frames that led to it, the oldest first.
using Frames = std::vector<ContactPolygon>;
struct Case {
  Frames frames;
  Frames flat;         // the same, levelled()
  double largest = 0;  // metres: no coordinate of them is larger
};

Case make_case(std::mt19937_64& engine, std::mt19937_64& motion, int count) {
  Case made{{elliptical_polygon(engine, count)}, {}};
  for (int i = 0; i < kFramesBefore; ++i)
    made.frames.push_back(neighbouring_frame(made.frames.back(), kMoveOfFrame, motion));
  std::ranges::reverse(made.frames);
  return made;
}

/// By another generator, so that the other cases stay the same.
void add_flat(Case& made, std::mt19937_64& engine) {
  for (const ContactPolygon& frame : made.frames) {
    made.flat.push_back(levelled(frame, engine));
    for (const ContactPoint<float>& point : frame.points)
      made.largest = std::max(made.largest, static_cast<double>(point.position.norm()));
  }
}

/// What a method that remembers kept in the last of the frames before.
std::vector<FeatureId> remembered(const Method& method, const Frames& frames, double scale) {
  std::vector<FeatureId> ids;
  for (const ContactPolygon& frame : std::span(frames).first(kFramesBefore)) {
    ReduceOptions options = reduce_options(0);
    options.scale = scale;
    options.previous = ids;
    const KeptIndices kept = reduce<float>(method.reducer, frame.points, frame.normal, options);
    ids = mapped(kept, [&](int i) { return at(frame.points, i).id; });
  }
  return ids;
}

trace::ReducerAnswer judge(const KeptIndices& kept, const ContactPolygon& polygon) {
  const auto points = mapped(polygon.points, [](const ContactPoint<float>& point) {
    return ContactPoint<double>{point.position.cast<double>(), point.separation, point.id};
  });
  const Vec3d normal = polygon.normal.cast<double>().normalized();
  return measure_reduction(points, normal, {kept.begin(), kept.size()}, kKept);
}

}  // namespace

/// Every registered reducer but "none", on 5, 6, 8, 12, 16 and 32 points of elliptical polygons
/// (random_cases.h) in float, four points kept. Three results from the same runs, and one, "flat", from the
/// same polygons where all points are equally deep but for rounding (levelled()):
///
/// A reducer that goes by the frame before (coherent) has two lines: one that has seen eight frames
/// before, each a hundredth of the patch away from the next (neighbouring_frame()), and "..., first
/// frame", where it is given no ids.
///
/// "area": 1 - area / area of the best four points, in [0, 1]. The best is the longest chain of
/// corners of the hull, by dynamic programming in double (best_convex_area()), exact but for
/// rounding. What float takes for the larger of two can be smaller by its own rounding, some 1e-7
/// of the area. "wrench": the largest shortfall of the resisted moment (exploration.h), in
/// [0, 2]. "flat": as "area". "deepest": the share of the polygons whose deepest point was lost, in
/// [0, 1]; it has no worst. A call has failed when it kept no area at all; its errors count, as the largest there
/// are.
std::vector<trace::Study> study_reducers(const StudyOptions& options,
                                         const StudyProgress& progress) {
  const std::vector<Method> all = methods();
  const StudyGrid grid(options, all, kPointCounts, kCases, kRepetitions);

  const std::string cases_spelled = std::to_string(grid.cases) +
                                    " elliptical polygons a point, seed " +
                                    std::to_string(options.seed);
  std::vector<trace::Study> results =
      results_of("reducers", "float", "points", "all points, " + cases_spelled,
                 {{"area", "What each reducer loses of the contact area",
                   "lost area, 1 − area / best", "", kResolution},
                  {"wrench", "What each reducer loses of the resisted moment",
                   "lost moment arm / patch radius, worst axis", "", kResolution},
                  {"deepest", "How often each reducer loses the deepest point",
                   "share of the patches whose deepest point is lost"},
                  {"flat", "What each reducer loses of the contact area where faces lie flat",
                   "lost area of equally deep points, 1 − area / best", "", kResolution}});
  for (const std::size_t of_area : {0U, 3U})
    results[of_area].reference = "the largest quadrilateral, exact in double, " + cases_spelled;

  std::vector<std::vector<Case>> cases(grid.parameters.size());
  using Memory = std::vector<std::vector<FeatureId>>;  // of each case
  std::vector<std::vector<Memory>> memory(all.size(), std::vector<Memory>(cases.size()));
  std::mt19937_64 engine(options.seed);
  // Of their own: the polygons are the same whatever moves and levels them.
  std::mt19937_64 motion(~options.seed), level(options.seed ^ 0x666c6174);
  const auto without_rounding = [](double error) { return error < kRounding ? 0 : error; };
  const auto reduced = [&](std::size_t m, std::size_t p, std::size_t i) {
    ReduceOptions reduce_by = reduce_options(static_cast<int>(i));
    if (all[m].remembers) reduce_by.previous = memory[m][p][i];
    const ContactPolygon& polygon = cases[p][i].frames.back();
    return reduce<float>(all[m].reducer, polygon.points, polygon.normal, reduce_by);
  };
  const auto lost_of_flat = [&](const Method& method, const Case& made, std::size_t i) {
    ReduceOptions reduce_by = reduce_options(static_cast<int>(i));
    reduce_by.scale = made.largest;
    std::vector<FeatureId> before;
    if (method.remembers) before = remembered(method, made.flat, made.largest);
    reduce_by.previous = before;
    const ContactPolygon& polygon = made.flat.back();
    const KeptIndices kept =
        reduce<float>(method.reducer, polygon.points, polygon.normal, reduce_by);
    return without_rounding(1 - judge(kept, polygon).area_ratio);
  };
  measure_grid(
      grid, results, progress,
      [&](std::size_t p) {
        for (int i = 0; i < grid.cases; ++i) {
          cases[p].push_back(make_case(engine, motion, kPointCounts[p]));
          add_flat(cases[p].back(), level);
        }
      },
      // Who keeps no area has failed, and the error of that is all there is to lose.
      [&](std::size_t m, std::size_t p, Measurement& measured) {
        for (std::size_t i = 0; i < cases[p].size(); ++i) {
          const Frames& frames = cases[p][i].frames;
          if (all[m].remembers) memory[m][p].push_back(remembered(all[m], frames, 0));
          const trace::ReducerAnswer quality = judge(reduced(m, p, i), frames.back());
          measured.failed += quality.area > 0 ? 0 : 1;
          measured.errors[0].add(without_rounding(1 - quality.area_ratio));
          measured.errors[1].add(without_rounding(quality.wrench_error));
          measured.errors[2].add(quality.deepest_kept ? 0 : 1);
          measured.errors[3].add(lost_of_flat(all[m], cases[p][i], i));
        }
      },
      [&](std::size_t m, std::size_t p, std::size_t i) {
        const KeptIndices kept = reduced(m, p, i);
        return kept.empty() ? 0.0 : static_cast<double>(kept.back());
      });
  for (trace::StudySeries& series : results[2].series) {
    for (trace::StudyPoint& point : series.points) point.error_worst.reset();  // a share has none
  }
  return results;
}

}  // namespace contactscope
