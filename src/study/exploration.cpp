#include "study/exploration.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "core/at.h"
#include "reduce/polygon_area.h"
#include "reduce/reducer.h"
#include "scenario/run.h"
#include "study/study.h"
#include "trace/find.h"

namespace contactscope {
namespace {

/// Names of both shapes, the label, the triangle of a mesh or -1, and how many manifolds of these stand before it.
using ManifoldName = std::tuple<std::string, std::string, std::string, int, int>;

/// The scenario without reduction, each pair of shapes once for each setting but the reducer. What
/// then stands for several pairs goes by no label of one of them, unless it needs one.
Scenario unreduced(const Scenario& scenario) {
  Scenario result = scenario;
  result.pairs.clear();
  result.pipeline.reducer = "none";  // of patches
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

using Points = std::vector<trace::Point>;

/// How many ids came or went.
int changed(const Points& before, const Points& now) {
  const auto missing = [](const Points& from, const Points& in) {
    return std::ranges::count_if(from, [&](const trace::Point& point) {
      return std::ranges::find(in, point.id, &trace::Point::id) == in.end();
    });
  };
  return static_cast<int>(missing(before, now) + missing(now, before));
}

/// The largest way of a point of `some` to where `others` have its id, or else to the nearest.
double farthest_way(const Points& some, const Points& others) {
  double most = 0;
  for (const trace::Point& place : some) {
    const auto way = [&](const trace::Point& other) {
      return (place.position - other.position).norm();
    };
    const auto same = std::ranges::find(others, place.id, &trace::Point::id);
    most =
        std::max(most, same != others.end() ? way(*same) : std::ranges::min(mapped(others, way)));
  }
  return most;
}

Vec3d middle_of(const Points& places) {
  Vec3d sum = Vec3d::Zero();
  for (const trace::Point& place : places) sum += place.position;
  return sum / static_cast<double>(places.size());
}

/// How far a manifold moved from one frame to the next, in metres: the largest move of any of its
/// points, or of their middle if that is more. A point that bears the same id in both moves between
/// its two places; one that came is as far as the nearest place before, one that went as the
/// nearest place after. So four points that give way to four others about the same middle have
/// moved, and an id that is spelled anew at the same place has not. 0 where either frame has no
/// points.
double patch_move(const Points& before, const Points& now) {
  if (before.empty() || now.empty()) return 0;
  return std::max({farthest_way(before, now), farthest_way(now, before),
                   (middle_of(now) - middle_of(before)).norm()});
}

/// How far any surface point of a shape moved between two poses, in metres, of those looked at: its
/// vertices and, as a plane has none and a sphere's is its centre, what it has now at `contacts`
/// (world). Exactly 0 where the pose is the same.
double surface_move(const trace::Shape& shape, const Pose<double>& before, const Pose<double>& now,
                    const Points& contacts) {
  // There and back through the local frame would leave rounding.
  if (before.position == now.position && before.rotation.coeffs() == now.rotation.coeffs())
    return 0;
  double most = 0;
  for (const Vec3d& vertex : shape.vertices)
    most = std::max(most, (now.transform(vertex) - before.transform(vertex)).norm());
  for (const trace::Point& point : contacts) {
    const Vec3d then = before.transform(now.inverse_transform(point.position));
    most = std::max(most, (point.position - then).norm());
  }
  return most;
}

/// Answers for the manifolds of one pair, or of one triangle of a mesh, frame after frame.
template <class S>
class Explorer {
 public:
  Explorer(const std::vector<std::string>& names, int max_points)
      : names_(names), reducers_(mapped(names, find_reducer)), max_points_(max_points) {}

  /// All but whether the centre of mass is supported, which takes all manifolds of a pair.
  void answer(bool measure_time, trace::Exploration& result) {
    // What was kept is forgotten after a frame in which the shapes did not touch.
    if (result.frame != last_frame_ + 1) memories_.assign(names_.size(), {});
    last_frame_ = result.frame;
    std::vector<ContactPoint<double>> exact;
    std::vector<ContactPoint<S>> points;
    for (const trace::Point& point : result.points) {
      const FeatureId id = id_of(point.id);
      exact.push_back({point.position, point.separation, id});
      // Exact: the trace holds what was computed in S.
      points.push_back({point.position.cast<S>(), static_cast<S>(point.separation), id});
    }
    const auto previous = mapped(memories_, [&](const Points& kept) {
      return mapped(kept, [&](const trace::Point& point) { return id_of(point.id); });
    });
    const Vec3<S> normal = result.normal.cast<S>();
    const auto run = [&](const ReducerInfo* reducer, std::span<const FeatureId> before) {
      ReduceOptions options;
      options.max_points = max_points_;
      options.previous = before;
      return reduce<S>(reducer, points, normal, options);
    };

    for (std::size_t i = 0; i < names_.size(); ++i) {
      const KeptIndices kept = run(reducers_[i], previous[i]);
      // `none` keeps more than max_points: it is measured against itself.
      trace::ReducerAnswer& answer = result.reducers.emplace_back(
          measure_reduction(exact, result.normal, {kept.begin(), kept.size()},
                            std::max(max_points_, count_of(kept))));
      answer.name = names_[i];
      const Points now = mapped(kept, [&](int index) { return at(result.points, index); });
      const Points before = std::exchange(memories_[i], now);
      if (before.empty()) continue;
      answer.ids_changed = changed(before, now);
      answer.patch_moved = patch_move(before, now);
    }
    const std::vector<Vec3d> places = mapped(exact, &ContactPoint<double>::position);
    result.best_area = best_convex_area(places, result.normal, max_points_);
    const KeptIndices best = run(find_reducer("optimal"), {});
    result.best.assign(best.begin(), best.end());
    if (!measure_time || count_of(points) <= max_points_) return;
    constexpr int kRounds = 41;
    constexpr int kCalls = 24;
    std::vector<PassTimes> times(names_.size());
    for (int round = 0; round < kRounds; ++round) {
      for (std::size_t i = 0; i < names_.size(); ++i) {
        times[i].measure(kCalls, [&](int) {
          return static_cast<double>(run(reducers_[i], previous[i]).size());
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
  /// Ids of the trace as ids that a reducer can compare: any spelling has its own, in all frames.
  FeatureId id_of(const std::string& spelled) {
    const auto number = static_cast<std::uint32_t>(ids_.size());
    const std::uint32_t edge = ids_.emplace(spelled, number).first->second;
    return FeatureId::of({Owner::A, edge}, {Owner::B, edge});
  }

  const std::vector<std::string>& names_;
  std::vector<const ReducerInfo*> reducers_;
  std::vector<Points> memories_;  // what each kept in the last frame
  int max_points_;
  int last_frame_ = -2;
  std::map<std::string, std::uint32_t> ids_;
};

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

/// Explorations of frame after frame, whose manifolds have all points.
template <class S>
class Explorations {
 public:
  Explorations(const trace::Header& header, const std::string& scenario,
               const ExploreOptions& options)
      : header_(header), scenario_(scenario), options_(options), names_(options.reducers) {
    if (!names_.empty()) return;
    for (const ReducerInfo& info : reducers())
      if (info.name != "none") names_.push_back(info.name);
  }

  /// `max_points(i)`: of pair i of the frame.
  template <class MaxPoints>
  void add(const trace::Frame& frame, const MaxPoints& max_points) {
    for (int i = 0; i < count_of(frame.pairs); ++i) {
      const trace::Pair& pair = at(frame.pairs, i);
      const std::size_t first = result_.size();
      std::map<int, int> places;  // of the next manifold of a triangle
      for (const trace::Manifold& manifold : pair.manifolds)
        if (!manifold.points.empty())
          add_manifold(frame, pair, manifold, places[manifold.triangle.value_or(-1)]++,
                       max_points(i));
      if (result_.size() == first) continue;
      if (!knows(pair.a) || !knows(pair.b)) {  // a patch without bodies bears no weight
        for (trace::Exploration& exploration : std::span(result_).subspan(first))
          for (trace::ReducerAnswer& answer : exploration.reducers)
            answer.supports_center_of_mass.reset();
        continue;
      }
      // The body that is higher up rests on the other one.
      const Vec3d up = header_.up == "z" ? Vec3d::UnitZ() : Vec3d::UnitY();
      const Vec3d a = center(frame, pair.a), b = center(frame, pair.b);
      find_supported(up, a.dot(up) > b.dot(up) ? a : b, std::span(result_).subspan(first));
    }
    before_ = frame;
  }
  std::vector<trace::Exploration> take() { return std::move(result_); }

 private:
  bool knows(const std::string& name) const {
    return std::ranges::find(header_.shapes, name, &trace::Shape::name) != header_.shapes.end();
  }
  const trace::Shape& shape(const std::string& name) const {
    return *std::ranges::find(header_.shapes, name, &trace::Shape::name);
  }
  Vec3d center(const trace::Frame& frame, const std::string& name) const {
    return trace::find_pose(frame, name)->transform(shape(name).center_of_mass);
  }

  void add_manifold(const trace::Frame& frame, const trace::Pair& pair,
                    const trace::Manifold& manifold, int place, int max_points) {
    trace::Exploration exploration{.scenario = scenario_,
                                   .frame = frame.frame,
                                   .a = pair.a,
                                   .b = pair.b,
                                   .label = pair.label,
                                   .triangle = manifold.triangle,
                                   .points = manifold.points,
                                   .normal = manifold.normal};
    for (const std::string& name : {pair.a, pair.b}) {
      const Pose<double>* const then = trace::find_pose(before_, name);
      if (then == nullptr) continue;
      exploration.bodies_moved = std::max(
          exploration.bodies_moved,
          surface_move(shape(name), *then, *trace::find_pose(frame, name), manifold.points));
    }
    const ManifoldName name(pair.a, pair.b, pair.label, manifold.triangle.value_or(-1), place);
    explorers_.try_emplace(name, names_, max_points)
        .first->second.answer(options_.measure_time, exploration);
    result_.push_back(std::move(exploration));
  }

  const trace::Header& header_;
  const std::string& scenario_;
  const ExploreOptions& options_;
  std::vector<std::string> names_;
  std::map<ManifoldName, Explorer<S>> explorers_;
  trace::Frame before_;
  std::vector<trace::Exploration> result_;
};

template <class S>
std::vector<trace::Exploration> explore_in(const Scenario& scenario, int last_frame,
                                           const ExploreOptions& options) {
  const Scenario source = unreduced(scenario);
  Runner runner(source);
  const trace::Header header = runner.header();
  Explorations<S> explorations(header, scenario.name, options);
  for (int f = 0; f <= last_frame; ++f)
    explorations.add(runner.frame_unrecorded(f), [&](int pair) {
      return source.patches.empty() ? at(source.pairs, pair).pipeline.max_points
                                    : source.pipeline.max_points;
    });
  return explorations.take();
}

/// An engine that keeps points from frames before may tell one contact as several manifolds, each with the normal of its
/// frame (Bullet): those whose normals differ by less than this are reduced together.
constexpr double kSameNormal = 0.996;  // cosine of 5 degrees

std::vector<trace::Manifold> joined(const std::vector<trace::Manifold>& manifolds) {
  std::vector<trace::Manifold> all;
  std::vector<Vec3d> sums;  // of normals, one a point
  for (const trace::Manifold& manifold : manifolds) {
    const Vec3d weight = static_cast<double>(manifold.points.size()) * manifold.normal;
    const auto same = std::ranges::find_if(all, [&](const trace::Manifold& other) {
      return other.triangle == manifold.triangle && other.normal.dot(manifold.normal) > kSameNormal;
    });
    if (same == all.end()) {
      all.push_back(manifold);
      sums.push_back(weight);
      continue;
    }
    same->points.insert(same->points.end(), manifold.points.begin(), manifold.points.end());
    Vec3d& sum = at(sums, static_cast<int>(same - all.begin()));
    sum += weight;
    same->normal = sum.normalized();
  }
  return all;
}

template <class S>
std::vector<trace::Exploration> explore_in(const trace::Trace& trace,
                                           const ExploreOptions& options) {
  Explorations<S> explorations(trace.header, trace.header.scenario, options);
  for (trace::Frame frame : trace.frames) {
    for (trace::Pair& pair : frame.pairs) {
      pair.manifolds = joined(pair.manifolds);
      if (pair.reduction && pair.manifolds.size() == 1)
        pair.manifolds.front().points = pair.reduction->points;
    }
    explorations.add(frame, [](int) { return ReduceOptions{}.max_points; });
  }
  return explorations.take();
}

}  // namespace

std::vector<trace::Exploration> explore(const Scenario& scenario, int last_frame,
                                        const ExploreOptions& options) {
  return scenario.scalar == Scalar::Double ? explore_in<double>(scenario, last_frame, options)
                                           : explore_in<float>(scenario, last_frame, options);
}

std::vector<trace::Exploration> explore(const trace::Trace& trace, const ExploreOptions& options) {
  return trace.header.scalar == "double" ? explore_in<double>(trace, options)
                                         : explore_in<float>(trace, options);
}

}  // namespace contactscope
