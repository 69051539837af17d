#include "query/penetration.h"
#include "study/peers.h"
#include "study/study.h"

namespace contactscope {
namespace {

constexpr int kEfforts[] = {1, 2, 3, 4, 5, 6};
constexpr int kDepthVertices = 32;
constexpr int kDepthCases = 200;
constexpr int kDepthRepetitions = 7;

HullCases make_deep_cases(std::uint64_t seed, int count) {
  std::mt19937_64 engine(seed);
  HullCases cases;
  for (int i = 0; i < count; ++i) {
    OverlappingHulls hulls = overlapping_hulls(engine, kDepthVertices);
    if (i % 2 == 1) {
      const Vec3d between = hulls.b_in_a.transform(hulls.b.centroid) - hulls.a.centroid;
      hulls.b_in_a.position -= uniform(engine, 0.5, 1.0) * between;
      hulls.deepest = oracle_axis(hulls.a, hulls.b, hulls.b_in_a);
    }
    cases.add(hulls);
  }
  return cases;
}

/// The option that increases with effort.
enum class Effort { Same, Tolerance, Iterations, Directions, DirectionsInOneRound };

/// `effort` counts from 0.
template <class S> PenetrationOptions<S> options_at(Effort kind, std::size_t effort) {
  constexpr double kTolerances[] = {1e-1, 1e-2, 1e-3,
                                    1e-4, 1e-5, 0};  // the last is limited by rounding
  PenetrationOptions<S> options;
  if (kind == Effort::Tolerance) options.tolerance = static_cast<S>(kTolerances[effort]);
  if (kind == Effort::Iterations) options.max_iterations = 2 << effort;
  if (kind == Effort::DirectionsInOneRound) options.max_iterations = 1;
  options.samples = 8 << (2 * effort);
  return options;
}

struct DepthSeries {
  const char* name;
  bool is_float;
  PenetrationMethod method;
  Effort effort;

  template <class S>
  PenetrationResult<double> find_in(std::size_t at, const RoundedHulls<S>& pair) const {
    const PenetrationResult<S> found = penetration(method, support_set(pair.a), support_set(pair.b),
                                                   pair.b_in_a, options_at<S>(effort, at));
    return {.status = found.status,
            .depth = static_cast<double>(found.depth),
            .normal = found.normal.template cast<double>()};
  }
  PenetrationResult<double> find(std::size_t at, const HullCases& cases, std::size_t i) const {
    return is_float ? find_in(at, cases.in_float[i]) : find_in(at, cases.in_double[i]);
  }
};

constexpr DepthSeries kDepthSeries[] = {
    {"float, SAT", true, PenetrationMethod::Sat, Effort::Same},
    {"float, EPA by tolerance", true, PenetrationMethod::Epa, Effort::Tolerance},
    {"float, MPR by tolerance", true, PenetrationMethod::Mpr, Effort::Tolerance},
    {"float, sampling", true, PenetrationMethod::Sampling, Effort::Directions},
    {"double, SAT", false, PenetrationMethod::Sat, Effort::Same},
    {"double, EPA by tolerance", false, PenetrationMethod::Epa, Effort::Tolerance},
    {"double, EPA by iterations", false, PenetrationMethod::Epa, Effort::Iterations},
    {"double, MPR by tolerance", false, PenetrationMethod::Mpr, Effort::Tolerance},
    {"double, MPR by iterations", false, PenetrationMethod::Mpr, Effort::Iterations},
    {"double, sampling", false, PenetrationMethod::Sampling, Effort::Directions},
    {"double, sampling, one round", false, PenetrationMethod::Sampling,
     Effort::DirectionsInOneRound},
};

double angle_between(const Vec3d& one, const Vec3d& other) {
  return std::atan2(one.cross(other).norm(), one.dot(other));
}

void judge_depths(const DepthSeries& series, std::size_t effort, const HullCases& cases,
                  Measurement& measured) {
  const double epsilon = series.is_float
                             ? static_cast<double>(std::numeric_limits<float>::epsilon())
                             : std::numeric_limits<double>::epsilon();
  for (std::size_t i = 0; i < cases.exact.size(); ++i) {
    const PenetrationResult<double> found = series.find(effort, cases, i);
    const OverlappingHulls& exact = cases.exact[i];
    const double truth = -exact.deepest.separation;
    measured.errors[2].add(found.status == PenetrationStatus::Converged ? 0 : 1);
    // Both hulls reach about their size from their origins; float also rounds the input.
    const bool is_short = found.depth < truth - 64 * epsilon * exact.size;
    if (!has_depth(found.status) || is_short) {
      ++measured.failed;
      continue;
    }
    measured.errors[0].add(std::abs(found.depth - truth) / exact.size);
    measured.errors[1].add(angle_between(found.normal, exact.deepest.normal));
  }
}

/// A peer's depth is judged by its error alone: it may be a lower bound.
void judge_peer(const DepthPeer& peer, const HullCases& cases, Measurement& measured) {
  for (const double time : peer.nanoseconds) measured.times.add(time);
  for (std::size_t i = 0; i < cases.exact.size(); ++i) {
    const OverlappingHulls& exact = cases.exact[i];
    const PeerDepth& found = peer.found[i];
    measured.errors[2].add(found.depth >= 0 ? 0 : 1);
    if (!(found.depth >= 0)) {
      ++measured.failed;
      continue;
    }
    measured.errors[0].add(std::abs(found.depth + exact.deepest.separation) / exact.size);
    measured.errors[1].add(angle_between(found.normal, exact.deepest.normal));
  }
}

}  // namespace

/// Depth and normal of the penetration methods, in float and double, over six efforts, the
/// parameter. EPA and MPR: by tolerance, 0.1 of the pair's length scale, 0.01, ... 1e-5, and the
/// rounding limit, or by maximum iterations, 2, 4, ... 64. Sampling: by the number of directions,
/// 8, 32, ... 8192, with the local search until convergence and with one round of it.
///
/// Cases are those of `study hull_precision` with 32 vertices; in every other one the centroids'
/// distance is at least halved. Two measures against extended precision over all axes: the depth's
/// error over the size, and the angle between the normals in radians (large if two axes are nearly
/// as deep). A third, "unfinished": share of pairs whose status was not Converged.
///
/// The worst error of sampling may grow with the number of directions, since the search about the
/// best one is local and may end at a wrong facet. Without it ("one round") the error decreases.
///
/// A call fails if it finds no depth, or one that is too small by more than rounding: moving by it
/// would not separate the hulls. Reaching the iteration limit is no failure. Bullet and libccd, if
/// their program is found (peers.h), are a point each, at the highest effort.
std::vector<trace::Study> study_penetration(const StudyOptions& options,
                                            const StudyProgress& progress) {
  const StudyGrid grid(options, kDepthSeries, kEfforts, kDepthCases, kDepthRepetitions);
  const HullCases cases = make_deep_cases(options.seed, grid.cases);

  std::vector<trace::Study> results =
      results_of("penetration", "float and double", "effort",
                 "extended precision, " + std::to_string(grid.cases) + " overlapping pairs" +
                     options.seeded() +
                     "; efforts: tolerance 0.1, 0.01, 0.001, 1e-4, 1e-5, 0; 2, 4, 8, 16, 32, 64 "
                     "iterations; 8, "
                     "32, 128, 512, 2048, 8192 directions",
                 {{"depth", "The depth of two hulls by penetration algorithms",
                   "error of the depth / size of the hulls"},
                  {"normal", "The normal of two hulls by penetration algorithms",
                   "angle to the normal of least depth", "rad"},
                  {"unfinished", "How many searches end before they converge",
                   "share of the pairs whose status is not converged", "", 0.5 / grid.cases}});
  measure_grid(
      grid, results, progress, [](std::size_t) {},
      [&](std::size_t s, std::size_t e, Measurement& measured) {
        judge_depths(kDepthSeries[s], e, cases, measured);
      },
      [&](std::size_t s, std::size_t e, std::size_t i) {
        return kDepthSeries[s].find(e, cases, i).depth;
      });
  for (const DepthPeer& peer :
       run_depth_peers(options.peer_folders, cases.exact, grid.repetitions)) {
    add_line(results, {peer.name, {}}, std::array{std::end(kEfforts)[-1]}, [&](int) {
      Measurement measured(results.size(), grid.cases);
      judge_peer(peer, cases, measured);
      return measured;
    });
  }
  record::each_point(results[2], [](trace::StudyPoint& point) {
    point.failed = 0;  // they have a status
  });
  return results;
}

}  // namespace contactscope
