#pragma once

#include "scenario/scenario.h"
#include "study/study.h"
#include "trace/exploration.h"
#include "trace/json.h"

namespace contactscope {

/// Quality of a reduction by any method: all of an answer except its name, the support of the
/// centre of mass, and values that need several frames or a clock. `kept` are indices into
/// `points`, which lie in a plane with unit `normal`.
///
/// wrench_error: about an axis in the plane through the centroid of all points, the torque that a
/// unit force along the normal can resist is the patch's reach across that axis, in metres. This is
/// the largest loss of reach over all axes (the distance of the farthest point from the kept
/// polygon), as a fraction of the patch's radius. 0 for one point.
///
/// depth_error, metres: largest difference of a depth from the plane fitted to the kept depths.
trace::ReducerAnswer measure_reduction(std::span<const ContactPoint<double>> points,
                                       const Vec3d& normal, std::span<const int> kept,
                                       int max_points);

/// Whether a point, seen along unit `normal`, is in the convex hull of the kept points: a load
/// through it tips nothing. Points within rounding of the edge count as inside.
bool supports(std::span<const ContactPoint<double>> points, const Vec3d& normal,
              std::span<const int> kept, const Vec3d& place);

struct ExploreOptions {
  std::vector<std::string> reducers;  // names; empty: all in the list
  bool measure_time = true;
  int threads = 0;  // for untimed work; 0: one per hardware thread. Does not affect results
  /// Called for each of `total` steps, from any thread, never concurrently; may throw to stop.
  std::function<void(const std::string& what, int total)> progress{};
};

/// Runs every reducer on the unreduced manifolds of frames 0 to `last_frame` of a scenario, in its
/// scalar, with each pair's max_points. One entry per frame and touching pair, per triangle for a
/// mesh, frames in order; reducers in the given order, each with its own result in the previous
/// frame. Pairs that differ only in the reducer are explored once, without label unless other pairs
/// have the same shapes. The upper body's weight is supported by the kept points of all manifolds.
///
/// Times are of single calls with input in cache, all reducers in turn.
std::vector<trace::Exploration> explore(const Scenario& scenario, int last_frame,
                                        const ExploreOptions& options);

/// The same for a trace, with four points of those before a recorded reduction, or else reported.
std::vector<trace::Exploration> explore(const trace::Trace& trace, const ExploreOptions& options);

/// One row of the table, over all frames and pairs.
struct ReducerSummary {
  std::string name;
  double mean_area_ratio = 1;
  double worst_area_ratio = 1;
  double mean_wrench_error = 0;
  double worst_wrench_error = 0;
  double worst_depth_error = 0;  // metres
  double deepest_kept = 1;       // share of the frames
  /// Share of the frames in which the centre of mass is supported; empty without bodies.
  std::optional<double> supported{};
  int ids_changed = 0;  // over the sequence
  /// Largest ratio of the patch's movement between frames to the bodies' movement. Infinite if a
  /// patch moved on resting bodies, empty if nothing ever moved.
  std::optional<double> moves;
  double median = 0;   // nanoseconds, over the frames; 0 if not measured
  double quarter = 0;  // the median of the upper quartiles
  double min = 0;
};

/// Smallest error first: by mean area ratio, then by wrench error, then by name.
std::vector<ReducerSummary> summarize(const std::vector<trace::Exploration>& explorations);

namespace explorer_detail {

using Points = std::vector<trace::Point>;

/// Number of ids that appeared or disappeared.
inline int changed(const Points& before, const Points& now) {
  const auto missing = [](const Points& from, const Points& in) {
    return std::ranges::count_if(from, [&](const trace::Point& point) {
      return std::ranges::find(in, point.id, &trace::Point::id) == in.end();
    });
  };
  return static_cast<int>(missing(before, now) + missing(now, before));
}

/// The largest distance of a point of `some` to the one with its id in `others`, or the nearest.
inline double largest_distance(const Points& some, const Points& others) {
  double most = 0;
  for (const trace::Point& place : some) {
    const auto distance = [&](const trace::Point& other) {
      return (place.position - other.position).norm();
    };
    const auto same = std::ranges::find(others, place.id, &trace::Point::id);
    most = std::max(
        most, same != others.end() ? distance(*same) : std::ranges::min(mapped(others, distance)));
  }
  return most;
}

inline Vec3d middle_of(const Points& places) {
  Vec3d sum = Vec3d::Zero();
  for (const trace::Point& place : places) sum += place.position;
  return sum / static_cast<double>(places.size());
}

/// Movement of a manifold between two frames, in metres: the largest movement of a point, or of the
/// centroid if that is larger. Points with the same id move between their two positions. A new
/// point moves from the nearest earlier position, a removed one to the nearest later one. So
/// renaming an id in place does not count. 0 if either frame has no points.
inline double patch_move(const Points& before, const Points& now) {
  if (before.empty() || now.empty()) return 0;
  return std::max({largest_distance(before, now), largest_distance(now, before),
                   (middle_of(now) - middle_of(before)).norm()});
}

}  // namespace explorer_detail

/// Results for the manifolds of one pair, or of one triangle of a mesh, frame by frame.
template <class S> class Explorer {
  using Points = explorer_detail::Points;

 public:
  /// For each reducer, the ids that it kept in the previous frame.
  using Memory = std::vector<std::vector<FeatureId>>;

  Explorer(const std::vector<std::string>& names, int max_points)
      : names_(names), reducers_(mapped(names, find_reducer)), max_points_(max_points) {}

  /// Computes all except times and the support of the centre of mass, which needs all manifolds of
  /// the pair. Returns what the reducers got from the previous frame.
  Memory answer(trace::Exploration& result) {
    // Kept points are dropped after a frame without contact.
    if (result.frame != last_frame_ + 1) memories_.assign(names_.size(), {});
    last_frame_ = result.frame;
    std::vector<ContactPoint<double>> exact;
    for (const trace::Point& point : result.points)
      exact.push_back({point.position, point.separation, id_of(point.id)});
    const Memory previous = mapped(memories_, [&](const Points& kept) {
      return mapped(kept, [&](const trace::Point& point) { return id_of(point.id); });
    });
    const Input input = input_of(result);

    for (std::size_t i = 0; i < names_.size(); ++i) {
      const KeptIndices kept = run(reducers_[i], input, previous[i]);
      // `none` keeps more than max_points: compare it with itself.
      trace::ReducerAnswer& answer = result.reducers.emplace_back(
          measure_reduction(exact, result.normal, {kept.begin(), kept.size()},
                            std::max(max_points_, count_of(kept))));
      answer.name = names_[i];
      const Points now = mapped(kept, [&](int index) { return at(result.points, index); });
      const Points before = std::exchange(memories_[i], now);
      if (before.empty()) continue;
      answer.ids_changed = explorer_detail::changed(before, now);
      answer.patch_moved = explorer_detail::patch_move(before, now);
    }
    const std::vector<Vec3d> places = mapped(exact, &ContactPoint<double>::position);
    result.best_area = best_convex_area(places, result.normal, max_points_);
    const KeptIndices best = run(find_reducer("optimal"), input, {});
    result.best.assign(best.begin(), best.end());
    return previous;
  }

  bool has_times(const trace::Exploration& result) const {
    return count_of(result.points) > max_points_;
  }

  void measure_time(trace::Exploration& result, const Memory& previous) {
    constexpr int kRounds = 41;
    constexpr int kCalls = 24;
    const Input input = input_of(result);
    std::vector<PassTimes> times(names_.size());
    for (int round = 0; round < kRounds; ++round) {
      for (std::size_t i = 0; i < names_.size(); ++i) {
        times[i].measure(kCalls, [&](int) {
          return static_cast<double>(run(reducers_[i], input, previous[i]).size());
        });
      }
    }
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const std::vector<double> sorted = times[i].sorted();
      result.reducers[i].min = sorted.front();
      result.reducers[i].median = sorted[kRounds / 2];
      result.reducers[i].quarter = sorted[kRounds * 3 / 4];
    }
  }

 private:
  struct Input {
    std::vector<ContactPoint<S>> points;
    Vec3<S> normal;
  };

  /// Exact: the trace contains values computed in S.
  Input input_of(const trace::Exploration& manifold) {
    return {mapped(manifold.points,
                   [&](const trace::Point& point) {
                     return ContactPoint<S>{point.position.cast<S>(),
                                            static_cast<S>(point.separation), id_of(point.id)};
                   }),
            manifold.normal.cast<S>()};
  }
  KeptIndices run(const ReducerInfo* reducer, const Input& input,
                  std::span<const FeatureId> before) const {
    ReduceOptions options;
    options.max_points = max_points_;
    options.previous = before;
    return reduce<S>(reducer, input.points, input.normal, options);
  }

  /// Converts ids of the trace to comparable ids: each spelling gets its own, for all frames.
  FeatureId id_of(const std::string& spelled) {
    const auto number = static_cast<std::uint32_t>(ids_.size());
    const std::uint32_t edge = ids_.emplace(spelled, number).first->second;
    return FeatureId::of({Owner::A, edge}, {Owner::B, edge});
  }

  const std::vector<std::string>& names_;
  std::vector<const ReducerInfo*> reducers_;
  std::vector<Points> memories_;  // points that each reducer kept in the previous frame
  int max_points_;
  int last_frame_ = -2;
  std::map<std::string, std::uint32_t> ids_;
};

}  // namespace contactscope
