#pragma once

#include <algorithm>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/at.h"
#include "reduce/polygon_area.h"
#include "reduce/reducer.h"
#include "study/exploration.h"
#include "study/study.h"

namespace contactscope {

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
/// replacing four points by four others with the same centroid counts as movement, and renaming an
/// id in place does not. 0 if either frame has no points.
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
