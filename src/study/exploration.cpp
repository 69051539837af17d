#include "study/exploration.h"

#include "scenario/run.h"
#include "trace/find.h"

namespace contactscope {
namespace {

/// Both shapes, the label, the mesh triangle or -1, and the number of earlier manifolds of these.
using ManifoldName = std::tuple<std::string, std::string, std::string, int, int>;

/// The scenario without reduction; pairs that differ only in the reducer are merged. A merged pair
/// loses its label unless other pairs have the same shapes.
Scenario unreduced(const Scenario& scenario) {
  Scenario result = scenario;
  result.pairs.clear();
  result.pipeline.reducer = "none";  // for patches
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
  for (ScenarioPair& pair : result.pairs)
    if (std::ranges::count_if(result.pairs, same_shapes(pair)) == 1 &&
        std::ranges::count_if(scenario.pairs, same_shapes(pair)) > 1)
      pair.label.clear();
  return result;
}

/// Largest movement of a shape's surface between two poses, metres: of its vertices and, for planes
/// and spheres, of its current points at `contacts` (world). Exactly 0 for equal poses.
double surface_move(const trace::Shape& shape, const Pose<double>& before, const Pose<double>& now,
                    const std::vector<trace::Point>& contacts) {
  // Transforming to the local frame and back would add rounding.
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

/// The weight acts straight down, whatever the normal, and is supported by the kept points of all
/// manifolds of the pair together: a single floor triangle supports few boxes.
void find_supported(const Vec3d& up, const Vec3d& load, std::span<trace::Exploration> manifolds) {
  std::vector<ContactPoint<double>> points;
  for (const trace::Exploration& manifold : manifolds)
    for (const trace::Point& point : manifold.points)
      points.push_back({point.position, point.separation, FeatureId()});
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

/// Explorations of consecutive frames, whose manifolds have all points. Manifolds with the same
/// name are explored in order, different names in parallel once all frames are there.
template <class S> class Explorations {
 public:
  Explorations(const trace::Header& header, const std::string& scenario,
               const ExploreOptions& options)
      : header_(header), scenario_(scenario), options_(options), names_(options.reducers) {
    if (!names_.empty()) return;
    for (const ReducerInfo& info : reducers())
      if (info.name != "none") names_.push_back(info.name);
  }

  /// `max_points(i)`: limit for pair i of the frame.
  template <class MaxPoints> void add(const trace::Frame& frame, const MaxPoints& max_points) {
    for (int i = 0; i < count_of(frame.pairs); ++i) {
      const trace::Pair& pair = at(frame.pairs, i);
      const std::size_t first = result_.size();
      std::map<int, int> places;  // index of the next manifold on a triangle
      for (const trace::Manifold& manifold : pair.manifolds)
        if (!manifold.points.empty())
          add_manifold(frame, pair, manifold, places[manifold.triangle.value_or(-1)]++,
                       max_points(i));
      if (result_.size() == first) continue;
      resting_.push_back({first, result_.size() - first});
      if (!knows(pair.a) || !knows(pair.b)) continue;  // a patch without bodies bears no weight
      // The higher body rests on the other one.
      const Vec3d a = center(frame, pair.a), b = center(frame, pair.b);
      resting_.back().load = a.dot(up()) > b.dot(up()) ? a : b;
    }
    before_ = frame;
  }

  std::vector<trace::Exploration> explored() {
    std::vector<Line*> lines;
    for (auto& [name, line] : lines_) lines.push_back(&line);
    std::vector<typename Explorer<S>::Memory> memories(result_.size());
    std::mutex labelled;
    Workers workers(options_.threads > 0 ? options_.threads : hardware_threads());
    workers.for_each(count_of(lines), [&](int i, int) {
      Line& line = *at(lines, i);
      for (const std::size_t place : line.places)
        memories[place] = line.explorer.answer(result_[place]);
      const std::lock_guard lock(labelled);
      report("manifolds", count_of(lines));
    });
    workers.for_each(count_of(resting_), [&](int i, int) { rest(at(resting_, i)); });
    if (options_.measure_time) {
      for (Line* line : lines) {
        for (const std::size_t place : line->places)
          if (line->explorer.has_times(result_[place]))
            line->explorer.measure_time(result_[place], memories[place]);
        report("timed manifolds", count_of(lines));
      }
    }
    return std::move(result_);
  }

  void report(const char* what, int total) const {
    if (options_.progress) options_.progress(what, total);
  }

 private:
  /// The manifolds with one name, as indices into the result.
  struct Line {
    Explorer<S> explorer;
    std::vector<std::size_t> places{};
  };
  /// The manifolds of a pair in a frame, and the centre of mass of the upper body, if known.
  struct Resting {
    std::size_t first, count;
    std::optional<Vec3d> load{};
  };

  void rest(const Resting& resting) {
    const auto manifolds = std::span(result_).subspan(resting.first, resting.count);
    if (resting.load) return find_supported(up(), *resting.load, manifolds);
    for (trace::Exploration& exploration : manifolds)
      for (trace::ReducerAnswer& answer : exploration.reducers)
        answer.supports_center_of_mass.reset();
  }
  Vec3d up() const { return header_.up == "z" ? Vec3d::UnitZ() : Vec3d::UnitY(); }
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
    lines_.try_emplace(name, Line{Explorer<S>(names_, max_points)})
        .first->second.places.push_back(result_.size());
    result_.push_back(std::move(exploration));
  }

  const trace::Header& header_;
  const std::string& scenario_;
  const ExploreOptions& options_;
  std::vector<std::string> names_;
  std::map<ManifoldName, Line> lines_;
  std::vector<Resting> resting_;
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
  for (int f = 0; f <= last_frame; ++f) {
    explorations.add(runner.frame_unrecorded(f), [&](int pair) {
      return source.patches.empty() ? at(source.pairs, pair).pipeline.max_points
                                    : source.pipeline.max_points;
    });
    explorations.report("frames", last_frame + 1);
  }
  return explorations.explored();
}

/// Engines that keep points may report one contact as several manifolds, each with its frame's
/// normal (Bullet). Manifolds whose normals differ by less than this are merged.
constexpr double kSameNormal = 0.996;  // cosine of 5 degrees

std::vector<trace::Manifold> joined(const std::vector<trace::Manifold>& manifolds) {
  std::vector<trace::Manifold> all;
  std::vector<Vec3d> sums;  // of normals, one per point
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
  return explorations.explored();
}

/// The median; 0 of none.
double middle_of(std::vector<double> numbers) {
  std::ranges::sort(numbers);
  return numbers.empty() ? 0 : numbers[numbers.size() / 2];
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

std::vector<ReducerSummary> summarize(const std::vector<trace::Exploration>& explorations) {
  std::vector<ReducerSummary> rows;
  if (explorations.empty()) return rows;
  for (std::size_t i = 0; i < explorations.front().reducers.size(); ++i) {
    ReducerSummary row;
    row.name = explorations.front().reducers[i].name;
    row.mean_area_ratio = row.deepest_kept = 0;
    std::vector<double> medians, quarters, least;
    const double share = 1.0 / static_cast<double>(explorations.size());
    for (const trace::Exploration& exploration : explorations) {
      const trace::ReducerAnswer& answer = exploration.reducers[i];
      row.mean_area_ratio += share * answer.area_ratio;
      row.worst_area_ratio = std::min(row.worst_area_ratio, answer.area_ratio);
      row.mean_wrench_error += share * answer.wrench_error;
      row.worst_wrench_error = std::max(row.worst_wrench_error, answer.wrench_error);
      row.worst_depth_error = std::max(row.worst_depth_error, answer.depth_error);
      row.deepest_kept += answer.deepest_kept ? share : 0;
      if (answer.supports_center_of_mass)
        row.supported = row.supported.value_or(0) + (*answer.supports_center_of_mass ? share : 0);
      row.ids_changed += answer.ids_changed;
      if (answer.patch_moved > 0 || exploration.bodies_moved > 0) {
        const double moves = exploration.bodies_moved > 0
                                 ? answer.patch_moved / exploration.bodies_moved
                                 : std::numeric_limits<double>::infinity();
        row.moves = std::max(row.moves.value_or(0), moves);
      }
      if (answer.median) medians.push_back(*answer.median);
      if (answer.quarter) quarters.push_back(*answer.quarter);
      if (answer.min) least.push_back(*answer.min);
    }
    row.median = middle_of(std::move(medians));
    row.quarter = middle_of(std::move(quarters));
    if (!least.empty()) row.min = std::ranges::min(least);
    rows.push_back(row);
  }
  std::ranges::sort(rows, [](const ReducerSummary& a, const ReducerSummary& b) {
    return std::tuple(-a.mean_area_ratio, a.mean_wrench_error, a.name) <
           std::tuple(-b.mean_area_ratio, b.mean_wrench_error, b.name);
  });
  return rows;
}

}  // namespace contactscope
