#include "study/exploration.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "core/at.h"
#include "reduce/polygon_area.h"
#include "reduce/reducer.h"
#include "scenario/run.h"
#include "study/measurement.h"
#include "study/patch_motion.h"
#include "study/reduction_quality.h"

namespace contactscope {
namespace {

/// Names of both shapes, the label, and the triangle of a mesh or -1.
using ManifoldName = std::tuple<std::string, std::string, std::string, int>;

ManifoldName manifold_name(const trace::Exploration& exploration) {
  return {exploration.a, exploration.b, exploration.label, exploration.triangle.value_or(-1)};
}

/// The scenario without reduction, each pair of shapes once for each setting but the reducer. What
/// then stands for several pairs goes by no label of one of them, unless it needs one.
Scenario unreduced(const Scenario& scenario) {
  Scenario result = scenario;
  result.pairs.clear();
  const auto same_shapes = [](const ScenarioPair& pair) {
    return [&](const ScenarioPair& other) { return other.a == pair.a && other.b == pair.b; };
  };
  for (ScenarioPair pair : scenario.pairs) {
    pair.pipeline.reducer = "none";
    const bool is_known = std::ranges::any_of(result.pairs, [&](const ScenarioPair& other) {
      return same_shapes(pair)(other) && other.pipeline == pair.pipeline;
    });
    if (!is_known) result.pairs.push_back(pair);
  }
  for (ScenarioPair& pair : result.pairs) {
    if (std::ranges::count_if(result.pairs, same_shapes(pair)) == 1 &&
        std::ranges::count_if(scenario.pairs, same_shapes(pair)) > 1)
      pair.label.clear();
  }
  return result;
}

/// Ids of the trace as ids that a reducer can compare: any spelling has its own, in all frames.
class Ids {
 public:
  FeatureId of(const std::string& spelled) {
    const auto number = static_cast<std::uint32_t>(known_.size());
    const std::uint32_t edge = known_.emplace(spelled, number).first->second;
    return FeatureId::of({Owner::A, edge}, {Owner::B, edge});
  }

 private:
  std::map<std::string, std::uint32_t> known_;
};

/// What a reducer kept in the last frame.
struct Memory {
  std::vector<FeatureId> ids;
  std::vector<trace::Point> points;
};

int changed(const std::vector<FeatureId>& before, const std::vector<FeatureId>& now) {
  const auto missing = [](const std::vector<FeatureId>& from, const std::vector<FeatureId>& in) {
    return std::ranges::count_if(
        from, [&](const FeatureId& id) { return std::ranges::find(in, id) == in.end(); });
  };
  return static_cast<int>(missing(before, now) + missing(now, before));
}

/// Answers for the manifolds of one pair, or of one triangle of a mesh, frame after frame.
template <class S>
class Explorer {
 public:
  Explorer(const std::vector<std::string>& names, int max_points)
      : names_(names), max_points_(max_points) {
    for (const std::string& name : names) reducers_.push_back(find_reducer<S>(name));
  }

  /// All but whether the centre of mass is supported, which takes all manifolds of a pair.
  void answer(int frame, const trace::Manifold& manifold, bool measure_time,
              trace::Exploration& result) {
    // What was kept is forgotten after a frame in which the shapes did not touch.
    if (frame != last_frame_ + 1) memories_.assign(names_.size(), {});
    last_frame_ = frame;
    std::vector<ContactPoint<double>> exact;
    std::vector<ContactPoint<S>> points;
    std::vector<Vec3d> places;
    for (const trace::Point& point : manifold.points) {
      const FeatureId id = ids_.of(point.id);
      places.push_back(point.position);
      exact.push_back({point.position, point.separation, id});
      // Exact: the trace holds what was computed in S.
      points.push_back({point.position.cast<S>(), static_cast<S>(point.separation), id});
    }
    const Vec3<S> normal = manifold.normal.cast<S>();
    const auto run = [&](Reducer<S> reducer, std::span<const FeatureId> previous) {
      ReduceOptions options;
      options.max_points = max_points_;
      options.previous = previous;
      return reduce<S>(reducer, points, normal, options).kept;
    };

    std::vector<Memory> memories;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const KeptIndices kept = run(reducers_[i], memories_[i].ids);
      Memory& now = memories.emplace_back();
      for (const int index : kept) {
        now.ids.push_back(at(points, index).id);
        now.points.push_back(at(manifold.points, index));
      }
      trace::ReducerAnswer& answer = result.reducers.emplace_back();
      answer.name = names_[i];
      answer.kept.assign(kept.begin(), kept.end());
      // `none` keeps more than max_points: it is measured against itself.
      const ReductionQuality quality = measure_reduction(exact, manifold.normal, answer.kept,
                                                         std::max(max_points_, count_of(kept)));
      answer.area = quality.area;
      answer.area_ratio = quality.area_ratio;
      answer.deepest_kept = quality.deepest_kept;
      answer.wrench_error = quality.wrench_error;
      answer.depth_error = quality.depth_error;
      if (memories_[i].ids.empty()) continue;
      answer.ids_changed = changed(memories_[i].ids, now.ids);
      answer.patch_moved = patch_move(memories_[i].points, now.points);
    }
    result.best_area = best_convex_area(places, manifold.normal, max_points_);
    const KeptIndices best = run(find_reducer<S>("optimal"), {});
    result.best.assign(best.begin(), best.end());
    if (measure_time && count_of(points) > max_points_) time_all(run, result);
    memories_ = std::move(memories);
  }

 private:
  template <class Run>
  void time_all(const Run& run, trace::Exploration& result) const {
    constexpr int kRounds = 41;
    constexpr int kCalls = 24;
    std::vector<PassTimes> times(names_.size());
    for (int round = 0; round < kRounds; ++round) {
      for (std::size_t i = 0; i < names_.size(); ++i) {
        times[i].measure(kCalls, [&](int) {
          return static_cast<double>(run(reducers_[i], memories_[i].ids).size());
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

  const std::vector<std::string>& names_;
  std::vector<Reducer<S>> reducers_;
  std::vector<Memory> memories_;
  int max_points_;
  int last_frame_ = -2;
  Ids ids_;
};

const Pose<double>& pose_of(const trace::Frame& frame, const std::string& shape) {
  return std::ranges::find(frame.poses, shape, &std::pair<std::string, Pose<double>>::first)
      ->second;
}

Vec3d up_of(const trace::Header& header) {
  return header.up == "z" ? Vec3d::UnitZ() : Vec3d::UnitY();
}

const trace::Shape& shape_of(const trace::Header& header, const std::string& name) {
  return *std::ranges::find(header.shapes, name, &trace::Shape::name);
}

/// The centre of mass, in the world, of the body of a pair that is higher up: the one that rests.
Vec3d resting_center(const trace::Header& header, const trace::Frame& frame,
                     const trace::Pair& pair) {
  const auto center = [&](const std::string& name) -> Vec3d {
    return pose_of(frame, name).transform(shape_of(header, name).center_of_mass);
  };
  const Vec3d a = center(pair.a);
  const Vec3d b = center(pair.b);
  return a.dot(up_of(header)) > b.dot(up_of(header)) ? a : b;
}

double bodies_move(const trace::Header& header, const trace::Frame& before, const trace::Frame& now,
                   const trace::Pair& pair, const std::vector<trace::Point>& points) {
  double most = 0;
  for (const std::string& name : {pair.a, pair.b}) {
    most = std::max(most, surface_move(shape_of(header, name), pose_of(before, name),
                                       pose_of(now, name), points));
  }
  return most;
}

/// A weight goes straight down, whichever way the contact leans, and rests on what is kept of all
/// the pair's manifolds together: a triangle of a floor alone holds few boxes.
void find_supported(const Vec3d& up, const Vec3d& load, std::span<trace::Exploration> manifolds) {
  std::vector<ContactPoint<double>> points;
  for (const trace::Exploration& manifold : manifolds) {
    for (const trace::Point& point : manifold.points)
      points.push_back({point.position, point.separation, FeatureId()});
  }
  for (std::size_t i = 0; i < manifolds.front().reducers.size(); ++i) {
    std::vector<int> kept;
    int first = 0;
    for (const trace::Exploration& manifold : manifolds) {
      for (const int index : manifold.reducers[i].kept) kept.push_back(first + index);
      first += static_cast<int>(manifold.points.size());
    }
    const bool supported = supports(points, up, kept, load);
    for (trace::Exploration& manifold : manifolds)
      manifold.reducers[i].supports_center_of_mass = supported;
  }
}

template <class S>
std::vector<trace::Exploration> explore_in(const Scenario& scenario, int last_frame,
                                           const std::vector<std::string>& names,
                                           bool measure_time) {
  const Scenario source = unreduced(scenario);
  Runner runner(source);
  const trace::Header header = runner.header();
  std::map<ManifoldName, Explorer<S>> explorers;
  std::vector<trace::Exploration> result;
  trace::Frame before;
  for (int f = 0; f <= last_frame; ++f) {
    const trace::Frame frame = runner.frame_unrecorded(f);
    for (std::size_t i = 0; i < frame.pairs.size(); ++i) {
      const trace::Pair& pair = frame.pairs[i];
      const std::size_t first = result.size();
      for (const trace::Manifold& manifold : pair.manifolds) {
        if (manifold.points.empty()) continue;
        trace::Exploration exploration;
        exploration.scenario = scenario.name;
        exploration.frame = f;
        exploration.a = pair.a;
        exploration.b = pair.b;
        exploration.label = pair.label;
        exploration.triangle = manifold.triangle;
        exploration.points = manifold.points;
        exploration.normal = manifold.normal;
        if (f > 0)
          exploration.bodies_moved = bodies_move(header, before, frame, pair, manifold.points);
        explorers
            .try_emplace(manifold_name(exploration), names, source.pairs[i].pipeline.max_points)
            .first->second.answer(f, manifold, measure_time, exploration);
        result.push_back(std::move(exploration));
      }
      if (result.size() > first) {
        find_supported(up_of(header), resting_center(header, frame, pair),
                       std::span(result).subspan(first));
      }
    }
    before = frame;
  }
  return result;
}

}  // namespace

std::vector<trace::Exploration> explore(const Scenario& scenario, int last_frame,
                                        const ExploreOptions& options) {
  std::vector<std::string> names = options.reducers;
  if (names.empty()) {
    for (const ReducerInfo& info : reducers()) {
      if (info.name != "none") names.push_back(info.name);
    }
  }
  return scenario.scalar == Scalar::Double
             ? explore_in<double>(scenario, last_frame, names, options.measure_time)
             : explore_in<float>(scenario, last_frame, names, options.measure_time);
}

}  // namespace contactscope
