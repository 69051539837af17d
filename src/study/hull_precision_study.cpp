#include <cmath>
#include <optional>

#include "manifold/collide_pairs.h"
#include "query/sat.h"
#include "study/all_edge_pairs.h"
#include "study/measurement.h"
#include "study/overlapping_hulls.h"

namespace contactscope {
namespace {

constexpr int kVertexCounts[] = {8, 16, 32, 64};
// The slowest method takes milliseconds a pair.
constexpr int kCases = 100;
constexpr int kRepetitions = 7;
constexpr int kSteps = 8;  // of the motion that a cache has seen

/// Where B was `back` steps before its pose, on a way that is drawn for the pair: a step is 0.02%
/// of the hulls' size and half a milliradian.
Pose<double> earlier(const OverlappingHulls& hulls, int back) {
  const Quatd turn(Eigen::AngleAxisd(5e-4 * back, hulls.turn_axis));
  return {(turn * hulls.b_in_a.rotation).normalized(),
          hulls.b_in_a.position + 2e-4 * hulls.size * back * hulls.way};
}

/// A pair as one scalar sees it.
template <class S>
struct Case : RoundedHulls<S> {
  PairCache<S> cache;  // that the steps up to this pose have left

  explicit Case(const OverlappingHulls& hulls) : RoundedHulls<S>(hulls) {
    for (int back = kSteps; back > 0; --back) {
      collide_hull_hull(this->a, Pose<S>(), this->b, earlier(hulls, back).cast<S>(),
                        CollideOptions<S>(), &cache);
    }
  }
};
using Cases = HullCases<Case>;

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

template <class S, Preference preference>
Found contact(const Case<S>& c) {
  Contact<S> result;
  CollideOptions<S> options;
  options.preference = preference;
  const double separation = static_cast<double>(
      collide_hull_hull<S>(c.a, c.b, c.b_in_a, options, nullptr, result, nullptr));
  if (preference == Preference::None) return {separation};
  return {separation, result.normal.template cast<double>()};
}

template <class S>
Found cached_contact(const Case<S>& c) {
  PairCache<S> cache = c.cache;
  Contact<S> result;
  const double separation = static_cast<double>(
      collide_hull_hull<S>(c.a, c.b, c.b_in_a, CollideOptions<S>(), &cache, result, nullptr));
  return {separation, result.normal.template cast<double>()};
}

template <class S, Found (*method)(const Case<S>&)>
Found found(const Cases& cases, std::size_t i) {
  return method(cases.in<S>(i));
}

struct Method {
  const char* name;
  Found (*find)(const Cases& cases, std::size_t index);
};

constexpr Method kMethods[] = {
    {"float, walked arcs", &found<float, walked>},
    {"float, every pair asked", &found<float, asked>},
    {"float, every pair measured", &found<float, all_pairs>},
    {"float, contact", &found<float, contact<float, Preference::None>>},
    {"float, coherent contact", &found<float, contact<float, Preference::Relative>>},
    {"float, the same with a cache", &found<float, cached_contact>},
    {"double, walked arcs", &found<double, walked>},
    {"double, every pair asked", &found<double, asked>},
    {"double, every pair measured", &found<double, all_pairs>},
    {"double, contact", &found<double, contact<double, Preference::None>>},
    {"double, coherent contact", &found<double, contact<double, Preference::Relative>>},
    {"double, the same with a cache", &found<double, cached_contact>},
};

void judge_all(const Method& method, const Cases& cases, Measurement& measured) {
  for (std::size_t i = 0; i < cases.exact.size(); ++i) {
    const OverlappingHulls& exact = cases.exact[i];
    const Found found = method.find(cases, i);
    if (!(found.separation < 0)) {
      ++measured.failed;
      continue;
    }
    const double wanted = found.normal ? SeparationOracle(Shape<double>(exact.a), Pose<double>(),
                                                          Shape<double>(exact.b), exact.b_in_a)
                                             .separation_along(*found.normal, -1)
                                       : exact.deepest.separation;
    measured.errors[0].add(std::abs(found.separation - wanted) / exact.size);
  }
}

}  // namespace

/// The depth that the separating axis test finds, in float and in double, for hulls of 8, 16, 32
/// and 64 vertices: walking the Gauss map as sat() does, asking every pair of edges whether it
/// makes a Minkowski face, and measuring every pair by support points. Beside them whole contacts
/// by collide_hull_hull(): of the deepest axis, without the preference for coherent features; and
/// with it, anew and with the cache that the pair's motion up to its pose has left (only coherent
/// features are cached).
///
/// The error is |separation - oracle| over the size of the hulls. Coherent contacts may prefer an
/// axis that is a little deeper, which is no error: of them the oracle measures the axis that they
/// took. For float the error includes what rounding the input to float costs. A call has failed when it
/// finds no overlap.
std::vector<trace::Study> study_hull_precision(const StudyOptions& options,
                                               const StudyProgress& progress) {
  const StudyGrid grid(options, kMethods, kVertexCounts, kCases, kRepetitions);
  trace::Study study;
  study.study = "hull_precision";
  study.measure = "depth";
  study.title = "The depth of two hulls: precision and run time of the separating axis test";
  study.context = study_context("float and double");
  study.reference = "extended precision, " + std::to_string(grid.cases) +
                    " overlapping pairs of 1 mm to 1 km a point, seed " +
                    std::to_string(options.seed);
  study.error = "error of the depth / size of the hulls";
  study.parameter = "vertices";
  std::vector<trace::Study> results{study};
  std::vector<Cases> cases(grid.parameters.size());
  std::mt19937_64 engine(options.seed);
  measure_grid(
      grid, results, progress,
      [&](std::size_t size) {
        for (int i = 0; i < grid.cases; ++i)
          cases[size].add(overlapping_hulls(engine, kVertexCounts[size]));
      },
      [&](std::size_t m, std::size_t size, Measurement& measured) {
        judge_all(kMethods[m], cases[size], measured);
      },
      [&](std::size_t m, std::size_t size, std::size_t i) {
        return kMethods[m].find(cases[size], i).separation;
      });
  return results;
}

}  // namespace contactscope
