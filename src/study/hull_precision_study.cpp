#include "study/hull_precision_study.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "geometry/hull_builder.h"
#include "manifold/collide_hull_hull.h"
#include "manifold/recorder.h"
#include "query/sat.h"
#include "study/all_edge_pairs.h"
#include "study/depth_oracle.h"
#include "study/errors.h"
#include "study/pass_times.h"
#include "study/uniform.h"

namespace contactscope {
namespace {

constexpr int kVertexCounts[] = {8, 16, 32, 64};
// The slowest method takes milliseconds a pair.
constexpr int kCases = 100;
constexpr int kRepetitions = 7;
constexpr int kSteps = 8;  // of the motion that a cache has seen

Vec3d unit_vector(std::mt19937_64& engine) {
  const double z = uniform(engine, -1, 1);
  const double turn = uniform(engine, 0, 2 * std::numbers::pi);
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(turn), r * std::sin(turn), z};
}

Hull<double> ellipsoid_hull(std::mt19937_64& engine, int vertices, double size) {
  const Quatd turn = uniform_rotation(engine);
  Vec3d axes;
  for (int i = 0; i < 3; ++i) axes[i] = size * uniform(engine, 0.5, 1);
  std::vector<Vec3d> points;
  for (int i = 0; i < vertices; ++i) {
    const Vec3d on_sphere = unit_vector(engine);
    points.push_back(turn * Vec3d(axes.cwiseProduct(on_sphere)));
  }
  return build_hull(points);
}

/// Where B was `back` steps before its pose, on a way that is drawn for the pair: a step is 0.02%
/// of the hulls' size and half a milliradian.
Pose<double> earlier(const OverlappingHulls& hulls, int back) {
  const Quatd turn(Eigen::AngleAxisd(5e-4 * back, hulls.turn_axis));
  return {(turn * hulls.b_in_a.rotation).normalized(),
          hulls.b_in_a.position + 2e-4 * hulls.size * back * hulls.way};
}

/// A pair as one scalar sees it.
template <class S>
struct Case {
  Hull<S> a, b;
  Pose<S> b_in_a;
  PairCache<S> cache;  // that the steps up to this pose have left

  explicit Case(const OverlappingHulls& hulls)
      : a(hull_cast<S>(hulls.a)), b(hull_cast<S>(hulls.b)), b_in_a(hulls.b_in_a.cast<S>()) {
    for (int back = kSteps; back > 0; --back) {
      collide_hull_hull(a, Pose<S>(), b, earlier(hulls, back).cast<S>(), CollideOptions<S>(),
                        cache);
    }
  }
};

/// What a method found. With a normal: the separation along that, which need not be the least.
struct Found {
  double separation = 0;
  std::optional<Vec3d> normal{};
};

template <class S>
Found walked(const Case<S>& c) {
  const HullPair<S> pair(c.a, c.b, c.b_in_a);
  const SatResult<S> result = sat(pair, S(0), Preference::None);
  return {static_cast<double>(
      result.separation(result.status == SatStatus::Separated ? result.chosen : result.deepest))};
}

template <class S>
Found asked(const Case<S>& c) {
  return {static_cast<double>(separation_by_minkowski_faces(HullPair<S>(c.a, c.b, c.b_in_a)))};
}

template <class S>
Found all_pairs(const Case<S>& c) {
  return {static_cast<double>(separation_by_all_edge_pairs(HullPair<S>(c.a, c.b, c.b_in_a)))};
}

template <class S>
Found contact(const Case<S>& c, Preference preference) {
  Contact<S> result;
  NoRecorder<S> recorder;
  CollideOptions<S> options;
  options.preference = preference;
  const double separation =
      static_cast<double>(collide_hull_hull(c.a, c.b, c.b_in_a, options, result, recorder));
  if (preference == Preference::None) return {separation};
  return {separation, result.normal.template cast<double>()};
}

template <class S>
Found cached_contact(const Case<S>& c) {
  PairCache<S> cache = c.cache;
  Contact<S> result;
  NoRecorder<S> recorder;
  const double separation = static_cast<double>(
      collide_hull_hull(c.a, c.b, c.b_in_a, CollideOptions<S>(), cache, result, recorder));
  return {separation, result.normal.template cast<double>()};
}

/// The cases of one size of hull, in both scalars.
struct Cases {
  std::vector<OverlappingHulls> exact;
  std::vector<Case<float>> as_float;
  std::vector<Case<double>> as_double;

  int count() const { return static_cast<int>(exact.size()); }
};

Cases make_cases(std::mt19937_64& engine, int vertices, int count) {
  Cases cases;
  for (int i = 0; i < count; ++i) {
    cases.exact.push_back(overlapping_hulls(engine, vertices));
    cases.as_float.emplace_back(cases.exact.back());
    cases.as_double.emplace_back(cases.exact.back());
  }
  return cases;
}

struct Method {
  const char* name;
  Found (*find)(const Cases& cases, std::size_t index);
};

constexpr Method kMethods[] = {
    {"float, walked arcs", [](const Cases& c, std::size_t i) { return walked(c.as_float[i]); }},
    {"float, every pair asked", [](const Cases& c, std::size_t i) { return asked(c.as_float[i]); }},
    {"float, every pair measured",
     [](const Cases& c, std::size_t i) { return all_pairs(c.as_float[i]); }},
    {"float, contact",
     [](const Cases& c, std::size_t i) { return contact(c.as_float[i], Preference::None); }},
    {"float, coherent contact",
     [](const Cases& c, std::size_t i) { return contact(c.as_float[i], Preference::Relative); }},
    {"float, the same with a cache",
     [](const Cases& c, std::size_t i) { return cached_contact(c.as_float[i]); }},
    {"double, walked arcs", [](const Cases& c, std::size_t i) { return walked(c.as_double[i]); }},
    {"double, every pair asked",
     [](const Cases& c, std::size_t i) { return asked(c.as_double[i]); }},
    {"double, every pair measured",
     [](const Cases& c, std::size_t i) { return all_pairs(c.as_double[i]); }},
    {"double, contact",
     [](const Cases& c, std::size_t i) { return contact(c.as_double[i], Preference::None); }},
    {"double, coherent contact",
     [](const Cases& c, std::size_t i) { return contact(c.as_double[i], Preference::Relative); }},
    {"double, the same with a cache",
     [](const Cases& c, std::size_t i) { return cached_contact(c.as_double[i]); }},
};

struct Cell {
  Errors errors;
  int failed = 0;
  PassTimes times;
};

void judge_all(const Method& method, const Cases& cases, Cell& cell) {
  for (std::size_t i = 0; i < cases.exact.size(); ++i) {
    const OverlappingHulls& exact = cases.exact[i];
    const Found found = method.find(cases, i);
    if (!(found.separation < 0)) {
      ++cell.failed;
      continue;
    }
    const double wanted = found.normal
                              ? separation_along(exact.a, exact.b, exact.b_in_a, *found.normal)
                              : exact.separation;
    cell.errors.add(std::abs(found.separation - wanted) / exact.size);
  }
}

}  // namespace

OverlappingHulls overlapping_hulls(std::mt19937_64& engine, int vertices) {
  for (;;) {
    OverlappingHulls hulls;
    hulls.size = std::pow(10.0, uniform(engine, -3, 3));
    hulls.a = ellipsoid_hull(engine, vertices, hulls.size);
    hulls.b = ellipsoid_hull(engine, vertices, hulls.size);
    hulls.b_in_a.rotation = uniform_rotation(engine);
    hulls.way = unit_vector(engine);
    hulls.turn_axis = unit_vector(engine);
    const Vec3d direction = unit_vector(engine);
    const double overlap = hulls.size * uniform(engine, 0.01, 0.1);
    double reach_a = 0, reach_b = 0;
    for (const Vec3d& v : hulls.a.vertices) reach_a = std::max(reach_a, direction.dot(v));
    for (const Vec3d& v : hulls.b.vertices) {
      reach_b = std::max(reach_b, -direction.dot(hulls.b_in_a.rotate(v)));
    }
    hulls.b_in_a.position = (reach_a + reach_b - overlap) * direction;
    hulls.separation = oracle_separation(hulls.a, hulls.b, hulls.b_in_a);
    // A kiss is no overlap: what float makes of it is chance.
    if (hulls.separation < -1e-3 * hulls.size) return hulls;
  }
}

std::vector<trace::Study> study_hull_precision(const StudyOptions& options,
                                               const StudyProgress& progress) {
  const int count = options.cases.value_or(kCases);
  const int repetitions = options.repetitions.value_or(kRepetitions);
  const std::size_t methods = std::size(kMethods), sizes = std::size(kVertexCounts);
  std::vector<std::vector<Cell>> cells(methods, std::vector<Cell>(sizes));
  std::vector<Cases> cases;

  const int steps = static_cast<int>(sizes) + repetitions;
  int done = 0;
  std::mt19937_64 engine(options.seed);
  for (std::size_t size = 0; size < sizes; ++size) {
    cases.push_back(make_cases(engine, kVertexCounts[size], count));
    for (std::size_t m = 0; m < methods; ++m) judge_all(kMethods[m], cases[size], cells[m][size]);
    progress(++done, steps, "errors of " + std::to_string(kVertexCounts[size]) + " vertices");
  }
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    for (std::size_t size = 0; size < sizes; ++size) {
      for (std::size_t turn = 0; turn < methods; ++turn) {
        const std::size_t m = (turn + static_cast<std::size_t>(repetition)) % methods;
        cells[m][size].times.measure(count, [&](int i) {
          return kMethods[m].find(cases[size], static_cast<std::size_t>(i)).separation;
        });
      }
    }
    progress(++done, steps, "times");
  }

  trace::Study study;
  study.study = "hull_precision";
  study.measure = "depth";
  study.title = "The depth of two hulls: precision and run time of the separating axis test";
  study.context = study_context("float and double");
  study.reference = "extended precision, " + std::to_string(count) +
                    " overlapping pairs of 1 mm to 1 km a point, seed " +
                    std::to_string(options.seed);
  study.error = "error of the depth / size of the hulls";
  study.parameter = "vertices";
  for (std::size_t m = 0; m < methods; ++m) {
    trace::StudySeries series{kMethods[m].name, {}};
    for (std::size_t size = 0; size < sizes; ++size) {
      const Cell& cell = cells[m][size];
      series.points.push_back(
          study_point(kVertexCounts[size], cell.errors, cell.times, cell.failed, count));
    }
    study.series.push_back(std::move(series));
  }
  return {std::move(study)};
}

}  // namespace contactscope
