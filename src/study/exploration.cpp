#include "study/exploration.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <tuple>

#include "reduce/polygon_area.h"
#include "reduce/reducer.h"
#include "scenario/run.h"
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
  for (ScenarioPair pair : scenario.pairs) {
    pair.pipeline.reducer = "none";
    const auto same_shapes = [&](const ScenarioPair& other) {
      return other.a == pair.a && other.b == pair.b;
    };
    const bool is_known = std::ranges::any_of(result.pairs, [&](const ScenarioPair& other) {
      return same_shapes(other) && other.pipeline == pair.pipeline;
    });
    if (!is_known) result.pairs.push_back(pair);
  }
  for (ScenarioPair& pair : result.pairs) {
    const auto of_these = [&](const ScenarioPair& other) {
      return other.a == pair.a && other.b == pair.b;
    };
    if (std::ranges::count_if(result.pairs, of_these) == 1 &&
        std::ranges::count_if(scenario.pairs, of_these) > 1) {
      pair.label.clear();
    }
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
  std::vector<NamedPlace> places;
};

template <class S>
class Explorer {
 public:
  Explorer(const std::vector<std::string>& names, int max_points)
      : names_(names), memories_(names.size()), max_points_(max_points) {
    for (const std::string& name : names) reducers_.push_back(find_reducer<S>(name));
  }

  /// All but whether the centre of mass is supported, which takes all manifolds of a pair.
  void answer(int frame, const trace::Manifold& manifold, bool measure_time,
              trace::Exploration& result) {
    if (frame != last_frame_ + 1) forget();
    last_frame_ = frame;
    set_points(manifold);
    const std::vector<Reduction> reductions = reduce_all();
    for (std::size_t i = 0; i < names_.size(); ++i) {
      result.reducers.push_back(describe(i, reductions[i].kept, manifold));
    }
    result.best_area = best_convex_area(manifold.normal);
    const Reduction best = run(find_reducer<S>("optimal"), {});
    result.best.assign(best.kept.begin(), best.kept.end());
    if (measure_time && points_.size() > static_cast<std::size_t>(max_points_)) time_all(result);
    for (std::size_t i = 0; i < names_.size(); ++i) {
      memories_[i] = {ids_of(reductions[i].kept), places_of(reductions[i].kept, manifold)};
    }
  }

 private:
  /// Forgets what was kept, after a frame in which the shapes did not touch.
  void forget() {
    for (Memory& memory : memories_) memory = {};
  }

  void set_points(const trace::Manifold& manifold) {
    points_.clear();
    exact_.clear();
    for (const trace::Point& point : manifold.points) {
      const FeatureId id = ids_.of(point.id);
      exact_.push_back({point.position, point.separation, id});
      // Exact: the trace holds what was computed in S.
      points_.push_back({point.position.cast<S>(), static_cast<S>(point.separation), id});
    }
    normal_ = manifold.normal.cast<S>();
  }

  Reduction run(Reducer<S> reducer, std::span<const FeatureId> previous) const {
    ReduceOptions options;
    options.max_points = max_points_;
    options.previous = previous;
    return reduce<S>(reducer, points_, normal_, options);
  }

  std::vector<Reduction> reduce_all() const {
    std::vector<Reduction> result;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      result.push_back(run(reducers_[i], memories_[i].ids));
    }
    return result;
  }

  double best_convex_area(const Vec3d& normal) const {
    std::vector<Vec3d> places;
    for (const ContactPoint<double>& point : exact_) places.push_back(point.position);
    return contactscope::best_convex_area(places, normal, max_points_);
  }

  trace::ReducerAnswer describe(std::size_t i, const KeptIndices& kept,
                                const trace::Manifold& manifold) const {
    trace::ReducerAnswer answer;
    answer.name = names_[i];
    answer.kept.assign(kept.begin(), kept.end());
    // `none` keeps more than max_points: it is measured against itself.
    const int allowed = std::max(max_points_, static_cast<int>(kept.size()));
    const ReductionQuality quality =
        measure_reduction(exact_, manifold.normal, answer.kept, allowed);
    answer.area = quality.area;
    answer.area_ratio = quality.area_ratio;
    answer.deepest_kept = quality.deepest_kept;
    answer.wrench_error = quality.wrench_error;
    answer.depth_error = quality.depth_error;
    if (!memories_[i].ids.empty()) {
      answer.ids_changed = changed(memories_[i].ids, ids_of(kept));
      answer.patch_moved = patch_move(memories_[i].places, places_of(kept, manifold));
    }
    return answer;
  }

  std::vector<FeatureId> ids_of(const KeptIndices& kept) const {
    std::vector<FeatureId> ids;
    for (const int index : kept) ids.push_back(exact_[static_cast<std::size_t>(index)].id);
    return ids;
  }

  static std::vector<NamedPlace> places_of(const KeptIndices& kept,
                                           const trace::Manifold& manifold) {
    std::vector<NamedPlace> places;
    for (const int index : kept) {
      const trace::Point& point = manifold.points[static_cast<std::size_t>(index)];
      places.push_back({point.id, point.position});
    }
    return places;
  }

  static int changed(const std::vector<FeatureId>& before, const std::vector<FeatureId>& now) {
    const auto missing = [](const std::vector<FeatureId>& from, const std::vector<FeatureId>& in) {
      return std::ranges::count_if(
          from, [&](const FeatureId& id) { return std::ranges::find(in, id) == in.end(); });
    };
    return static_cast<int>(missing(before, now) + missing(now, before));
  }

  void time_all(trace::Exploration& result) const {
    using Clock = std::chrono::steady_clock;
    constexpr int kRounds = 41;
    constexpr int kCalls = 24;
    std::vector<std::vector<double>> times(names_.size());
    int kept_points = 0;  // printed nowhere, but the compiler cannot know
    for (int round = 0; round < kRounds; ++round) {
      for (std::size_t i = 0; i < names_.size(); ++i) {
        const Clock::time_point begin = Clock::now();
        for (int call = 0; call < kCalls; ++call) {
          kept_points += static_cast<int>(run(reducers_[i], memories_[i].ids).kept.size());
        }
        const std::chrono::duration<double, std::nano> taken = Clock::now() - begin;
        times[i].push_back(taken.count() / kCalls);
      }
    }
    sink_ = kept_points;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      std::ranges::sort(times[i]);
      result.reducers[i].min = times[i].front();
      result.reducers[i].median = times[i][times[i].size() / 2];
      result.reducers[i].quarter = times[i][times[i].size() * 3 / 4];
    }
  }

  const std::vector<std::string>& names_;
  std::vector<Reducer<S>> reducers_;
  std::vector<Memory> memories_;
  int max_points_;
  int last_frame_ = -2;
  Ids ids_;
  std::vector<ContactPoint<S>> points_;
  std::vector<ContactPoint<double>> exact_;
  Vec3<S> normal_ = Vec3<S>::Zero();
  mutable volatile int sink_ = 0;
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
