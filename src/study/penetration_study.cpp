#include <array>
#include <cmath>

#include "query/penetration.h"
#include "study/depth_oracle.h"
#include "study/measurement.h"
#include "study/overlapping_hulls.h"
#include "study/uniform.h"

namespace contactscope {
namespace {

constexpr int kDepthVertices = 32;
constexpr int kDepthCases = 200;
constexpr int kDepthRepetitions = 7;

/// A pair as one scalar sees it.
template <class S>
struct DeepPair {
  Hull<S> a, b;
  Pose<S> b_in_a;

  explicit DeepPair(const OverlappingHulls& hulls)
      : a(hull_cast<S>(hulls.a)), b(hull_cast<S>(hulls.b)), b_in_a(hulls.b_in_a.cast<S>()) {}
};

struct DeepCases {
  std::vector<double> sizes;  // metres
  std::vector<OracleAxis> truth;
  std::vector<DeepPair<float>> as_float;
  std::vector<DeepPair<double>> as_double;

  int count() const { return static_cast<int>(sizes.size()); }
  template <class S>
  const DeepPair<S>& at(std::size_t i) const {
    if constexpr (sizeof(S) == sizeof(float)) {
      return as_float[i];
    } else {
      return as_double[i];
    }
  }
};

DeepCases make_deep_cases(std::uint64_t seed, int count) {
  std::mt19937_64 engine(seed);
  DeepCases cases;
  for (int i = 0; i < count; ++i) {
    OverlappingHulls hulls = overlapping_hulls(engine, kDepthVertices);
    if (i % 2 == 1) {
      const Vec3d between = hulls.b_in_a.transform(hulls.b.centroid) - hulls.a.centroid;
      hulls.b_in_a.position -= uniform(engine, 0.5, 1.0) * between;
    }
    cases.sizes.push_back(hulls.size);
    cases.truth.push_back(oracle_axis(hulls.a, hulls.b, hulls.b_in_a));
    cases.as_float.emplace_back(hulls);
    cases.as_double.emplace_back(hulls);
  }
  return cases;
}

/// What the method was given.
struct Effort {
  double parameter = 0;  // 1 is the least
  double tolerance = 0;
  int iterations = 0;
  int samples = 64;
};

struct FoundDepth {
  bool has_depth;
  bool converged;
  double depth;
  Vec3d normal;
};

template <class S>
FoundDepth run_method(PenetrationMethod method, const Effort& effort, const DeepPair<S>& pair) {
  PenetrationOptions<S> options;
  options.tolerance = static_cast<S>(effort.tolerance);
  options.max_iterations = effort.iterations;
  options.samples = effort.samples;
  const PenetrationResult<S> found =
      penetration(method, support_set(pair.a), support_set(pair.b), pair.b_in_a, options);
  return {has_depth(found.status), found.status == PenetrationStatus::Converged,
          static_cast<double>(found.depth), found.normal.template cast<double>()};
}

struct DepthSeries {
  std::string name;
  PenetrationMethod method;
  bool is_float;
  std::vector<Effort> efforts;  // by growing parameter

  FoundDepth run(const Effort& effort, const DeepCases& cases, std::size_t i) const {
    return is_float ? run_method(method, effort, cases.at<float>(i))
                    : run_method(method, effort, cases.at<double>(i));
  }
};

constexpr int kEfforts = 6;

/// One of each effort; every series has as many, so that they make a table.
template <class Make>
std::vector<Effort> efforts(const Make& make) {
  std::vector<Effort> list;
  for (int effort = 1; effort <= kEfforts; ++effort) list.push_back(make(effort));
  return list;
}

/// 0.1 to 1e-5, then what rounding allows.
std::vector<Effort> tolerances() {
  constexpr double kTolerances[kEfforts] = {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 0};
  return efforts([&](int effort) { return Effort{1.0 * effort, kTolerances[effort - 1], 0, 64}; });
}

/// 2 to 64.
std::vector<Effort> iteration_caps() {
  return efforts([](int effort) { return Effort{1.0 * effort, 0, 1 << effort, 64}; });
}

/// 8 to 8192. `rounds` of the search about the best; 0: until it converges.
std::vector<Effort> sample_counts(int rounds) {
  return efforts([&](int effort) { return Effort{1.0 * effort, 0, rounds, 2 << (2 * effort)}; });
}

/// The same each time.
std::vector<Effort> no_choice() {
  return efforts([](int effort) { return Effort{1.0 * effort, 0, 0, 64}; });
}

std::vector<DepthSeries> every_series() {
  using enum PenetrationMethod;
  return {
      {"float, SAT", Sat, true, no_choice()},
      {"float, EPA by tolerance", Epa, true, tolerances()},
      {"float, MPR by tolerance", Mpr, true, tolerances()},
      {"float, sampling", Sampling, true, sample_counts(0)},
      {"double, SAT", Sat, false, no_choice()},
      {"double, EPA by tolerance", Epa, false, tolerances()},
      {"double, EPA by iterations", Epa, false, iteration_caps()},
      {"double, MPR by tolerance", Mpr, false, tolerances()},
      {"double, MPR by iterations", Mpr, false, iteration_caps()},
      {"double, sampling", Sampling, false, sample_counts(0)},
      {"double, sampling, one round", Sampling, false, sample_counts(1)},
  };
}

double angle_between(const Vec3d& one, const Vec3d& other) {
  return std::atan2(one.cross(other).norm(), one.dot(other));
}

void judge_depths(const DepthSeries& series, const Effort& effort, const DeepCases& cases,
                  Measurement& measured) {
  const double epsilon = series.is_float
                             ? static_cast<double>(std::numeric_limits<float>::epsilon())
                             : std::numeric_limits<double>::epsilon();
  for (std::size_t i = 0; i < cases.sizes.size(); ++i) {
    const FoundDepth found = series.run(effort, cases, i);
    const double truth = -cases.truth[i].separation;
    measured.errors[2].add(found.converged ? 0 : 1);
    // Both hulls reach about their size from their frames; float rounds its input as well.
    const bool is_short = found.depth < truth - 64 * epsilon * cases.sizes[i];
    if (!found.has_depth || is_short) {
      ++measured.failed;
      continue;
    }
    measured.errors[0].add(std::abs(found.depth - truth) / cases.sizes[i]);
    measured.errors[1].add(angle_between(found.normal, cases.truth[i].normal));
  }
}

}  // namespace

/// Depth and normal of the penetration methods, in float and in double, over six efforts, the
/// parameter: EPA and MPR by their tolerance, 0.1 of the pair's length scale, 0.01, ... 1e-5, and what
/// rounding allows, or by the cap on their iterations, 2, 4, ... 64; sampling by the number of
/// directions, 8, 32, ... 8192, with the search about the best until it converges and with one round
/// of it. The separating axis test is the same at every effort.
///
/// Cases are those of `study hull_precision` with 32 vertices, every other one pushed together until
/// centroids are half as far apart or less. Two measures against extended precision over all axes:
/// the depth's error over the size of the hulls, and the angle between the normals in radians (where
/// two axes are nearly as deep, a small error of the depth is a large one of the normal). A third,
/// "unfinished", is the share of the pairs on which the status was not Converged.
///
/// The worst error of sampling need not fall with the number of directions: the search about the best
/// one is local, so the worst pair is one whose best direction lies beside a wrong facet, and another
/// number of directions finds another one. Without that search ("one round") it falls throughout.
///
/// A call has failed when it finds no depth, or one that falls short of the true one by more than
/// rounding, so that moving by it would not part the hulls. To end at the cap on iterations is no
/// failure here: that is what is studied.
std::vector<trace::Study> study_penetration(const StudyOptions& options,
                                            const StudyProgress& progress) {
  const std::vector<DepthSeries> list = every_series();
  StudyGrid grid{{},
                 {1, 2, 3, 4, 5, 6},
                 options.cases.value_or(kDepthCases),
                 options.repetitions.value_or(kDepthRepetitions)};
  for (const DepthSeries& series : list) grid.methods.push_back(series.name);
  const DeepCases cases = make_deep_cases(options.seed, grid.cases);

  trace::Study study;
  study.study = "penetration";
  study.context = study_context("float and double");
  study.reference = "extended precision, " + std::to_string(grid.cases) +
                    " overlapping pairs, seed " + std::to_string(options.seed) +
                    "; efforts: tolerance 0.1, 0.01, 0.001, 1e-4, 1e-5, 0; 2, 4, 8, 16, 32, 64 "
                    "iterations; 8, 32, 128, 512, 2048, 8192 directions";
  study.parameter = "effort";
  std::vector<trace::Study> results{
      by_measure(study, "depth", "The depth of two hulls by penetration algorithms",
                 "error of the depth / size of the hulls"),
      by_measure(study, "normal", "The normal of two hulls by penetration algorithms",
                 "angle to the normal of least depth"),
      by_measure(study, "unfinished", "How many searches end before they converge",
                 "share of the pairs whose status is not converged")};
  results[1].unit = "rad";
  results[2].resolution = 0.5 / grid.cases;
  measure_grid(
      grid, results, progress, [](std::size_t) {},
      [&](std::size_t s, std::size_t e, Measurement& measured) {
        judge_depths(list[s], list[s].efforts[e], cases, measured);
      },
      [&](std::size_t s, std::size_t e, std::size_t i) {
        return list[s].run(list[s].efforts[e], cases, i).depth;
      });
  for (trace::StudySeries& series : results[2].series) {
    for (trace::StudyPoint& point : series.points) point.failed = 0;  // they have a status
  }
  return results;
}

}  // namespace contactscope
