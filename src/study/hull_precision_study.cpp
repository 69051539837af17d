#include "manifold/collide_pairs.h"
#include "study/random_cases.h"
#include "study/study.h"

namespace contactscope {
namespace {

constexpr int kVertexCounts[] = {8, 16, 32, 64};
constexpr int kCases = 100;
constexpr int kRepetitions = 7;
constexpr int kSteps = 8;  // of the motion before, which fills the cache

/// Pose of B `back` steps of 0.02% of the size and half a milliradian earlier on its random path.
Pose<double> earlier(const OverlappingHulls& hulls, int back) {
  const Quatd turn(Eigen::AngleAxisd(5e-4 * back, hulls.turn_axis));
  return {(turn * hulls.b_in_a.rotation).normalized(),
          hulls.b_in_a.position + 2e-4 * hulls.size * back * hulls.offset};
}

/// Fills the cache by running the steps before this pose.
template <class S> void move_there(const OverlappingHulls& hulls, RoundedHulls<S>& rounded) {
  for (int back = kSteps; back > 0; --back)
    collide_hull_hull(rounded.a, Pose<S>(), rounded.b, earlier(hulls, back).cast<S>(),
                      CollideOptions(), &rounded.cache);
}

/// Result of a method. If it has a normal, the separation is along it and need not be the least.
struct Found {
  double separation = 0;
  std::optional<Vec3d> normal{};
};

template <Preference preference, bool cached, class S> Found contact(const RoundedHulls<S>& c) {
  PairCache<S> cache;
  if (cached) cache = c.cache;
  Contact<S> result;
  CollideOptions options;
  options.preference = preference;
  const double separation = static_cast<double>(collide_hull_hull<S>(
      c.a, c.b, c.b_in_a, options, cached ? &cache : nullptr, result, nullptr));
  if (preference == Preference::None) return {separation};
  return {separation, result.normal.template cast<double>()};
}

/// The separating axis test of the talk: every face, and every pair of edges by IsMinkowskiFace.
/// Source: Gregorius, "The Separating Axis Test between Convex Polyhedra", GDC 2013.
template <class S> Found test_all_pairs(const RoundedHulls<S>& c) {
  const HullPair<S> pair(c.a, c.b, c.b_in_a);
  FaceSeparations<S> of_a(pair.a), of_b(pair.b);
  S most = std::max(query_faces(pair.a, pair.b, S(0), of_a).separation,
                    query_faces(pair.b, pair.a, S(0), of_b).separation);
  const auto normals = [](const PlacedHull<S>& hull, int edge) {
    return std::pair(hull.normal(hull.half_edge(edge).face),
                     hull.normal(hull.half_edge(edge + 1).face));
  };
  for (int i = 0; i < 2 * c.a.edge_count(); i += 2) {
    const auto [a, b] = normals(pair.a, i);
    const Vec3<S> along_a = pair.a.direction(i), from = pair.a.origin(i);
    for (int j = 0; j < 2 * c.b.edge_count(); j += 2) {
      const auto [minus_c, minus_d] = normals(pair.b, j);
      const Vec3<S> along_b = pair.b.direction(j);
      const S cba = -minus_c.dot(along_a), dba = -minus_d.dot(along_a), adc = a.dot(along_b),
              bdc = b.dot(along_b);
      if (!(cba * dba < S(0) && adc * bdc < S(0) && cba * bdc > S(0))) continue;
      const Vec3<S> normal = along_a.cross(along_b).normalized();
      const S sign = normal.dot(a + b) < S(0) ? S(-1) : S(1);
      most = std::max(most, sign * normal.dot(pair.b.origin(j) - from));
    }
  }
  return {static_cast<double>(most)};
}

/// A method in one scalar; the other function is null.
struct Method {
  std::string name;
  Found (*in_float)(const RoundedHulls<float>&);
  Found (*in_double)(const RoundedHulls<double>&);

  Found find(const HullCases& cases, std::size_t i) const {
    return in_float != nullptr ? in_float(cases.in_float[i]) : in_double(cases.in_double[i]);
  }
};

std::vector<Method> methods() {
  const auto tested = [](const auto& c) -> Found {
    const auto result = sat(HullPair(c.a, c.b, c.b_in_a), {}, Preference::None);
    const bool separated = result.status == SatStatus::Separated;
    return {static_cast<double>(result.separation(separated ? result.chosen : result.deepest))};
  };
  constexpr auto kDeepest = Preference::None, kCoherent = Preference::Relative;
  const Method in_both[] = {
      {"separating axis test", tested, tested},
      {"contact", contact<kDeepest, false>, contact<kDeepest, false>},
      {"coherent contact", contact<kCoherent, false>, contact<kCoherent, false>},
      {"the same with a cache", contact<kCoherent, true>, contact<kCoherent, true>},
  };
  std::vector<Method> list;
  for (const Method& method : in_both)
    list.push_back({"float, " + method.name, method.in_float, nullptr});
  for (const Method& method : in_both)
    list.push_back({"double, " + method.name, nullptr, method.in_double});
  list.push_back({"float, all pairs of edges", test_all_pairs<float>, nullptr});
  return list;
}

void judge_all(const Method& method, const HullCases& cases, Measurement& measured) {
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

/// The times of a study as its errors, in microseconds.
trace::Study times_of(trace::Study study) {
  study.measure = "time";
  study.title = "Time of a contact of two hulls, by their vertices";
  study.error = "least time of a call";
  study.unit = "µs";
  study.form = trace::StudyForm::Curves;
  record::each_point(study, [](trace::StudyPoint& point) {
    point.error_worst = point.error = point.nanoseconds.min / 1000;
  });
  return study;
}

}  // namespace

/// Depth by the separating axis test, in float and in double, for hulls of 8, 16, 32 and 64
/// vertices, as in sat(). Also whole contacts by collide_hull_hull(): without the preference for
/// coherent features; and with it, from scratch and with the cache left by the pair's motion.
///
/// The error is |separation - oracle| over the size of the hulls. Coherent contacts may prefer a
/// slightly deeper axis, so the oracle measures the axis that they chose. Float errors include rounding of the input. A call fails if it finds no overlap. "time" and "axes": the least time of a call.
std::vector<trace::Study> study_hull_precision(const StudyOptions& options,
                                               const StudyProgress& progress) {
  const std::vector<Method> all = methods();
  const StudyGrid grid(options, all, kVertexCounts, kCases, kRepetitions);
  std::vector<trace::Study> results = results_of(
      "hull_precision", "float and double", "vertices",
      "extended precision, " + std::to_string(grid.cases) +
          " overlapping pairs of 1 mm to 1 km a point" + options.seeded(),
      {{"depth", "The depth of two hulls: precision and run time of the separating axis test",
        "error of the depth / size of the hulls"}});
  std::vector<HullCases> cases(grid.parameters.size());
  std::mt19937_64 engine(options.seed);
  measure_grid(
      grid, results, progress,
      [&](std::size_t size) {
        for (int i = 0; i < grid.cases; ++i) {
          const OverlappingHulls hulls = overlapping_hulls(engine, kVertexCounts[size]);
          cases[size].add(hulls);
          move_there(hulls, cases[size].in_float.back());
          move_there(hulls, cases[size].in_double.back());
        }
      },
      [&](std::size_t m, std::size_t size, Measurement& measured) {
        judge_all(all[m], cases[size], measured);
      },
      [&](std::size_t m, std::size_t size, std::size_t i) {
        return all[m].find(cases[size], i).separation;
      });
  results.push_back(times_of(results[0]));
  results.push_back(results[1]);
  results[2].measure = "axes";
  return results;
}

}  // namespace contactscope
