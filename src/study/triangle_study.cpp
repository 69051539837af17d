#include "study/plain_triangle_test.h"
#include "study/random_cases.h"
#include "study/study.h"

namespace contactscope {
namespace {

// Units in the last place, of the largest coordinates.
constexpr int kDistances[] = {1, 4, 16, 64, 256, 1024, 4096, 16384, 65536, 262144, 1048576};
constexpr int kTrianglePairs = 20000;
constexpr int kTriangleRepetitions = 5;

/// Two triangles near one plane, corners whole multiples of a unit, and whether they share a point.
struct NearlyCoplanar {
  Triangle<std::int64_t> a, b;
  bool overlap;
};
constexpr std::int64_t kReach = 1 << 22;  // largest corner coordinate of the first triangle, units

bool has_area(const Triangle<std::int64_t>& t) {
  return !(t[1] - t[0]).cross(t[2] - t[0]).isZero(0);
}

/// The first triangle is random, of about 2^22 units; the corners of the second are near its plane,
/// up to `distance` units to either side.
NearlyCoplanar nearly_coplanar(std::mt19937_64& engine, double distance) {
  const auto nearest = [](double number) {
    return static_cast<std::int64_t>(std::llround(number));
  };
  while (true) {
    NearlyCoplanar pair;
    for (auto& corner : pair.a)
      for (int k = 0; k < 3; ++k) corner[k] = nearest(uniform(engine, -1, 1) * kReach);
    const Vec3d origin = pair.a[0].cast<double>();
    const Vec3d u = pair.a[1].cast<double>() - origin, v = pair.a[2].cast<double>() - origin;
    const Vec3d normal = u.cross(v).normalized();
    for (auto& corner : pair.b) {
      const double along_u = uniform(engine, -0.5, 1.2), along_v = uniform(engine, -0.5, 1.2);
      const double off = distance * uniform(engine, -1, 1);
      const Vec3d place = origin + along_u * u + along_v * v + off * normal;
      for (int k = 0; k < 3; ++k) corner[k] = nearest(place[k]);
    }
    if (!has_area(pair.a) || !has_area(pair.b)) continue;
    pair.overlap = PlainTriangleTest<std::int64_t>().overlap(pair.a, pair.b);
    return pair;
  }
}

/// A pair in metres.
template <class S> struct Metric {
  Triangle<S> a, b;

  Metric(const NearlyCoplanar& pair, double unit)
      : a(scaled(pair.a, unit)), b(scaled(pair.b, unit)) {}

  static Triangle<S> scaled(const Triangle<std::int64_t>& t, double unit) {
    const auto corner = [&](std::size_t i) -> Vec3<S> {
      return (t[i].template cast<double>() * unit).template cast<S>();
    };
    return {corner(0), corner(1), corner(2)};
  }
};

struct MetricPairs {
  std::vector<Metric<float>> in_float;
  std::vector<Metric<double>> in_double;
};

struct TriangleMethod {
  const char* name;
  bool (*overlap)(const MetricPairs& pairs, std::size_t index);
};

template <class S> bool plain(const std::vector<Metric<S>>& pairs, std::size_t i, double epsilon) {
  return PlainTriangleTest<S>(static_cast<S>(epsilon)).overlap(pairs[i].a, pairs[i].b);
}

const TriangleMethod kTriangleMethods[] = {
    {"float", [](const MetricPairs& pairs, std::size_t i) { return plain(pairs.in_float, i, 0); }},
    {"float, epsilon 1e-6 m",
     [](const MetricPairs& pairs, std::size_t i) { return plain(pairs.in_float, i, 1e-6); }},
    {"double",
     [](const MetricPairs& pairs, std::size_t i) { return plain(pairs.in_double, i, 0); }},
    {"double, epsilon 1e-9 m",
     [](const MetricPairs& pairs, std::size_t i) { return plain(pairs.in_double, i, 1e-9); }},
    {"exact",
     [](const MetricPairs& pairs, std::size_t i) {
       const Metric<float>& pair = pairs.in_float[i];
       return triangle_overlap_kind(pair.a, pair.b) != TriangleOverlapKind::None;
     }},
};

/// Powers of two, so that integers stay exact: size of the largest triangles, metres.
struct TriangleSize {
  const char* panel;
  int exponent;
};
constexpr TriangleSize kTriangleSizes[] = {{"of 0.12 mm", -13}, {"of 1 m", 0}, {"of 8 km", 13}};

constexpr int kFirstUnit = -24, kLastUnit = 23;

TriangleOverlapKind right_answer(int i, int j) {
  if (i == j) return TriangleOverlapKind::Touching;
  return i > j ? TriangleOverlapKind::None : TriangleOverlapKind::Proper;
}

template <class S> TriangleOverlapKind plain_answer(int i, int j) {
  const auto [a, b] = nearly_touching<S>(i, j);
  return PlainTriangleTest<S>(0).kind(a, b);
}

TriangleOverlapKind exact_answer(int i, int j) {
  const auto [a, b] = nearly_touching<double>(i, j);
  return triangle_overlap_kind(a, b);
}

struct AnsweringTest {
  const char* panel;
  const char* unit;
  TriangleOverlapKind (*answer)(int i, int j);
};

constexpr AnsweringTest kAnsweringTests[] = {{"float", "2⁻²⁴ m", &plain_answer<float>},
                                             {"double", "2⁻⁵³ m", &plain_answer<double>},
                                             {"exact", "2⁻⁵³ m", &exact_answer}};

/// Rounds a number below 32 to a fixed number of digits, so that differences are exact.
template <class S> S in_all_digits(double number) {
  constexpr int kDigits = std::numeric_limits<S>::digits - 5;
  return static_cast<S>(std::ldexp(std::nearbyint(std::ldexp(number, kDigits)), -kDigits));
}

}  // namespace

template <class S> std::array<Triangle<S>, 2> nearly_touching(int i, int j) {
  constexpr S kUnit = std::numeric_limits<S>::epsilon() / 2;
  const auto corner = [](double x, double y) {
    const S exact_x = in_all_digits<S>(x), exact_y = in_all_digits<S>(y);
    return Vec3<S>(exact_x, exact_y, exact_y - exact_x);
  };
  const Triangle<S> a = {corner(12.1389726, 14.6127341), corner(-17.2056147, -5.3371983),
                         corner(-3.4117366, -20.5721198)};
  const Vec3<S> moved(S(0.5) + static_cast<S>(i) * kUnit, S(0.5) + static_cast<S>(j) * kUnit, 0);
  return {a, Triangle<S>{moved, Vec3<S>{S(1.5), S(-2.25), 9}, Vec3<S>{7, -3, 5}}};
}

trace::Study triangle_answers() {
  trace::Study study =
      results_of(
          "triangle_triangle", "float and double", "",
          "the side of the plane in whole numbers of these units",
          {{"last_bits", "A corner on a triangle, moved by its last bits: what a test answers",
            "answer"}})
          .front();
  study.form = trace::StudyForm::Answers;
  study.row = "units along y";
  for (const AnsweringTest& test : kAnsweringTests) {
    const std::string parameter = std::string("units of ") + test.unit + " along x";
    for (int j = kFirstUnit; j <= kLastUnit; ++j) {
      trace::StudySeries& row = study.series.emplace_back(
          trace::StudySeries{test.panel, {}, test.panel, parameter, double(j)});
      for (int i = kFirstUnit; i <= kLastUnit; ++i) {
        const TriangleOverlapKind answer = test.answer(i, j);
        const double record = static_cast<double>(answer);
        row.points.push_back(
            {double(i), record, std::nullopt, {}, answer == right_answer(i, j) ? 0 : 1, 1});
      }
    }
  }
  return study;
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(nearly_touching);

/// Pairs of triangles, one with its corners within a few units in the last place of the other's
/// plane: share of wrong answers to whether they share a point, at three sizes. The reference uses
/// integers. Also a map of one corner's last bits, see plain_triangle_test.h.
std::vector<trace::Study> study_triangles(const StudyOptions& options,
                                          const StudyProgress& progress) {
  StudyGrid grid(options, kTriangleMethods, kDistances, kTrianglePairs, kTriangleRepetitions);
  std::vector<trace::Study> results = results_of(
      "triangle_triangle", "float", "units in the last place",
      "every edge against the other triangle in whole numbers, " + std::to_string(grid.cases) +
          " pairs a point" + options.seeded(),
      {{"wrong", "Triangles near one plane: how often a test is wrong, and what never is",
        "share of wrong answers", "", 0.5 / grid.cases}},
      trace::StudyForm::Curves);
  std::vector<std::vector<NearlyCoplanar>> pairs(grid.parameters.size());
  std::mt19937_64 engine(options.seed);
  for (std::size_t p = 0; p < pairs.size(); ++p)
    for (int i = 0; i < grid.cases; ++i)
      pairs[p].push_back(nearly_coplanar(engine, grid.parameters[p]));
  for (const TriangleSize& size : kTriangleSizes) {
    const double unit = std::ldexp(1.0, size.exponent) / static_cast<double>(kReach);
    std::vector<MetricPairs> metric(grid.parameters.size());
    grid.panel = std::string("triangles ") + size.panel;
    grid.axis = "units in the last place off one plane, " + grid.panel;
    measure_grid(
        grid, results, progress,
        [&](std::size_t p) {
          for (const NearlyCoplanar& pair : pairs[p]) {
            metric[p].in_float.emplace_back(pair, unit);
            metric[p].in_double.emplace_back(pair, unit);
          }
        },
        [&](std::size_t m, std::size_t p, Measurement& measured) {
          for (std::size_t i = 0; i < pairs[p].size(); ++i)
            measured.errors[0].add(
                kTriangleMethods[m].overlap(metric[p], i) == pairs[p][i].overlap ? 0 : 1);
        },
        [&](std::size_t m, std::size_t p, std::size_t i) {
          return kTriangleMethods[m].overlap(metric[p], i) ? 1.0 : 0.0;
        });
  }
  finish_share(results[0], results[0].resolution);
  results.push_back(triangle_answers());
  return results;
}

}  // namespace contactscope
