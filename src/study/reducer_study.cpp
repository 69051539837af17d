#include "study/exploration.h"
#include "study/random_cases.h"

namespace contactscope {
namespace {

constexpr int kPointCounts[] = {5, 6, 8, 12, 16, 32};
constexpr int kKept = 4;
constexpr int kCases = 2000;
constexpr int kRepetitions = 25;
// In double, from coordinates within 6 m, for patches of 0.02 m or more: less is rounding.
constexpr double kRounding = 1e-12;
// Such float coordinates have errors of some 1e-7 m: choices that differ by less are equal.
constexpr double kResolution = 1e-6;

// Frames that a reducer with memory has seen, and their spacing: a body that comes to rest.
constexpr int kFramesBefore = 8;
constexpr double kMoveOfFrame = 0.01;

struct Method {
  std::string name;
  const ReducerInfo* reducer;
  bool remembers = false;
};

/// Reducers that use the previous frame have two lines: with an earlier frame, and without.
std::vector<Method> methods() {
  std::vector<Method> list;
  for (const ReducerInfo& info : reducers()) {
    const ReducerInfo* reducer = find_reducer(info.name);
    if (reducer == nullptr) continue;  // "none" does not reduce
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

/// A manifold to reduce, preceded by earlier frames, the oldest first.
using Frames = std::vector<ContactPolygon>;
struct Case {
  Frames frames;
  Frames flat;         // levelled() frames
  double largest = 0;  // metres: largest coordinate
};

Case make_case(std::mt19937_64& engine, std::mt19937_64& motion, int count) {
  Case made{{elliptical_polygon(engine, count)}, {}};
  for (int i = 0; i < kFramesBefore; ++i)
    made.frames.push_back(neighbouring_frame(made.frames.back(), kMoveOfFrame, motion));
  std::ranges::reverse(made.frames);
  return made;
}

/// Uses another generator, so that the other cases stay the same.
void add_flat(Case& made, std::mt19937_64& engine) {
  for (const ContactPolygon& frame : made.frames) {
    made.flat.push_back(levelled(frame, engine));
    for (const ContactPoint<float>& point : frame.points)
      made.largest = std::max(made.largest, static_cast<double>(point.position.norm()));
  }
}

KeptIndices reduced(const Method& method, const ContactPolygon& polygon, std::size_t index,
                    double scale, std::span<const FeatureId> previous) {
  ReduceOptions options = reduce_options(static_cast<int>(index));
  options.scale = scale;
  options.previous = previous;
  return reduce<float>(method.reducer, polygon.points, polygon.normal, options);
}

/// Ids that a reducer with memory kept in the last of the earlier frames.
std::vector<FeatureId> remembered(const Method& method, const Frames& frames, double scale) {
  std::vector<FeatureId> ids;
  if (!method.remembers) return ids;
  for (const ContactPolygon& frame : std::span(frames).first(kFramesBefore))
    ids = mapped(reduced(method, frame, 0, scale, ids),
                 [&](int i) { return at(frame.points, i).id; });
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

/// Every registered reducer except "none", on 5, 6, 8, 12, 16 and 32 points of elliptical polygons
/// (random_cases.h) in float, keeping four points. Three results from the same runs; a fourth,
/// "flat", from the same polygons with all points equally deep up to rounding (levelled()).
///
/// A reducer that uses the previous frame (coherent) has two lines: after eight frames, each a
/// hundredth of the patch from the next, and "..., first frame", without ids.
///
/// "area": 1 - area / area of the best four points, in [0, 1]. The best polygon is found by dynamic
/// programming in double over the corners of the hull (best_convex_area()), exact up to rounding.
/// Float may misjudge the larger of two areas by its rounding, some 1e-7 of the area. "wrench": the
/// largest shortfall of the resisted moment (exploration.h), in [0, 2]. "flat": as "area".
/// "deepest": share of polygons whose deepest point was lost, in [0, 1]; it has no worst. A call
/// fails if it keeps no area; it still counts, with the maximum error.
std::vector<trace::Study> study_reducers(const StudyOptions& options,
                                         const StudyProgress& progress) {
  const std::vector<Method> all = methods();
  const StudyGrid grid(options, all, kPointCounts, kCases, kRepetitions);

  const std::string cases_spelled =
      std::to_string(grid.cases) + " elliptical polygons a point" + options.seeded();
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
  using Memory = std::vector<std::vector<FeatureId>>;  // per case
  std::vector<std::vector<Memory>> memory(all.size(), std::vector<Memory>(cases.size()));
  std::mt19937_64 engine(options.seed);
  // Separate generators, so that the polygons do not depend on motion and levelling.
  std::mt19937_64 motion(~options.seed), level(options.seed ^ 0x666c6174);
  const auto without_rounding = [](double error) { return error < kRounding ? 0 : error; };
  const auto kept_of = [&](std::size_t m, std::size_t p, std::size_t i) {
    return reduced(all[m], cases[p][i].frames.back(), i, 0, memory[m][p][i]);
  };
  const auto lost_of_flat = [&](const Method& method, const Case& made, std::size_t i) {
    const ContactPolygon& polygon = made.flat.back();
    const KeptIndices kept =
        reduced(method, polygon, i, made.largest, remembered(method, made.flat, made.largest));
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
      // Without area a call fails, with the maximum error.
      [&](std::size_t m, std::size_t p, Measurement& measured) {
        for (std::size_t i = 0; i < cases[p].size(); ++i) {
          const Frames& frames = cases[p][i].frames;
          memory[m][p].push_back(remembered(all[m], frames, 0));
          const trace::ReducerAnswer quality = judge(kept_of(m, p, i), frames.back());
          measured.failed += quality.area > 0 ? 0 : 1;
          measured.errors[0].add(without_rounding(1 - quality.area_ratio));
          measured.errors[1].add(without_rounding(quality.wrench_error));
          measured.errors[2].add(quality.deepest_kept ? 0 : 1);
          measured.errors[3].add(lost_of_flat(all[m], cases[p][i], i));
        }
      },
      [&](std::size_t m, std::size_t p, std::size_t i) {
        const KeptIndices kept = kept_of(m, p, i);
        return kept.empty() ? 0.0 : static_cast<double>(kept.back());
      });
  record::drop_worst(results[2]);  // a share has none
  return results;
}

}  // namespace contactscope
