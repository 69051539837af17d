#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/at.h"
#include "query/triangle_overlap.h"
#include "study/plain_triangle_test.h"
#include "study/random_cases.h"
#include "study/study.h"
#include "study/triangle_answers.h"

namespace contactscope {
namespace {

// Units in the last place, of the largest coordinates.
constexpr int kDistances[] = {1, 4, 16, 64, 256, 1024, 4096, 16384, 65536, 262144, 1048576};
constexpr int kTrianglePairs = 20000;
constexpr int kTriangleRepetitions = 5;

/// Corners as integer multiples of a unit, exact in float.
using GridVec = std::array<std::int64_t, 3>;
using GridTriangle = std::array<GridVec, 3>;
constexpr std::int64_t kReach = 1 << 22;  // largest corner coordinate of the first triangle, units

/// Two triangles near one plane, and whether they share a point.
struct NearlyCoplanar {
  GridTriangle a, b;
  bool overlap;
};

// Whether two triangles share a point, in integers: an edge of one meets the other. Shares no code
// with the tested method, which compares intervals on the line of both planes. Determinants of
// differences below 2^26 fit into 128 bits.

__extension__ using Wide = __int128;

/// The sign of (b - a) x (c - a) . (d - a).
int grid_orient(const GridVec& a, const GridVec& b, const GridVec& c, const GridVec& d) {
  const auto offset = [&a](const GridVec& to, std::size_t k) { return Wide(to[k] - a[k]); };
  const Wide volume = (offset(b, 1) * offset(c, 2) - offset(b, 2) * offset(c, 1)) * offset(d, 0) +
                      (offset(b, 2) * offset(c, 0) - offset(b, 0) * offset(c, 2)) * offset(d, 1) +
                      (offset(b, 0) * offset(c, 1) - offset(b, 1) * offset(c, 0)) * offset(d, 2);
  return (volume > 0) - (volume < 0);
}

/// The sign of (b - a) x (c - a), seen along an axis.
int grid_orient(const GridVec& a, const GridVec& b, const GridVec& c, std::size_t axis) {
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  const Wide area = Wide(b[u] - a[u]) * Wide(c[v] - a[v]) - Wide(b[v] - a[v]) * Wide(c[u] - a[u]);
  return (area > 0) - (area < 0);
}

/// For four points in one plane that is not parallel to `axis`.
bool grid_segments_meet(const GridVec& p, const GridVec& q, const GridVec& r, const GridVec& s,
                        std::size_t axis) {
  const int r_side = grid_orient(p, q, r, axis), s_side = grid_orient(p, q, s, axis);
  const int p_side = grid_orient(r, s, p, axis), q_side = grid_orient(r, s, q, axis);
  if (r_side * s_side > 0 || p_side * q_side > 0) return false;
  if (r_side != 0 || s_side != 0) return true;
  for (std::size_t k = 0; k < 3; ++k) {  // collinear
    const auto [low, high] = std::minmax(p[k], q[k]);
    if (std::max(r[k], s[k]) < low || high < std::min(r[k], s[k])) return false;
  }
  return true;
}

bool grid_segment_meets(const GridVec& p, const GridVec& q, const GridTriangle& t) {
  const int p_side = grid_orient(t[0], t[1], t[2], p), q_side = grid_orient(t[0], t[1], t[2], q);
  if (p_side * q_side > 0) return false;
  if (p_side != 0 || q_side != 0) {
    int least = 1, most = -1;
    for (std::size_t k = 0; k < 3; ++k) {
      const int side = grid_orient(p, q, t[k], t[(k + 1) % 3]);
      least = std::min(least, side);
      most = std::max(most, side);
    }
    return least >= 0 || most <= 0;
  }
  std::size_t axis = 0;
  while (axis < 2 && grid_orient(t[0], t[1], t[2], axis) == 0) ++axis;
  const int front = grid_orient(t[0], t[1], t[2], axis);
  bool inside = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const GridVec &from = t[k], &to = t[(k + 1) % 3];
    if (grid_segments_meet(p, q, from, to, axis)) return true;
    inside = inside && grid_orient(from, to, p, axis) * front >= 0;
  }
  return inside;
}

bool grid_overlap(const GridTriangle& a, const GridTriangle& b) {
  for (std::size_t k = 0; k < 3; ++k)
    if (grid_segment_meets(a[k], a[(k + 1) % 3], b) || grid_segment_meets(b[k], b[(k + 1) % 3], a))
      return true;
  return false;
}

bool has_area(const GridTriangle& t) {
  return grid_orient(t[0], t[1], t[2], std::size_t{0}) != 0 ||
         grid_orient(t[0], t[1], t[2], std::size_t{1}) != 0 ||
         grid_orient(t[0], t[1], t[2], std::size_t{2}) != 0;
}

/// The first triangle is random, of about 2^22 units; the corners of the second are near its plane,
/// up to `distance` units to either side.
NearlyCoplanar nearly_coplanar(std::mt19937_64& engine, double distance) {
  const auto nearest = [](double number) {
    return static_cast<std::int64_t>(std::llround(number));
  };
  while (true) {
    NearlyCoplanar pair;
    for (GridVec& corner : pair.a)
      for (std::int64_t& number : corner) number = nearest(uniform(engine, -1, 1) * kReach);
    const auto vec = [](const GridVec& v) {
      return Vec3d(static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2]));
    };
    const Vec3d origin = vec(pair.a[0]), u = vec(pair.a[1]) - origin, v = vec(pair.a[2]) - origin;
    const Vec3d normal = u.cross(v).normalized();
    for (GridVec& corner : pair.b) {
      const double along_u = uniform(engine, -0.5, 1.2), along_v = uniform(engine, -0.5, 1.2);
      const double off = distance * uniform(engine, -1, 1);
      const Vec3d place = origin + along_u * u + along_v * v + off * normal;
      for (std::size_t k = 0; k < 3; ++k) corner[k] = nearest(place[static_cast<int>(k)]);
    }
    if (!has_area(pair.a) || !has_area(pair.b)) continue;
    pair.overlap = grid_overlap(pair.a, pair.b);
    return pair;
  }
}

/// A pair in metres.
template <class S>
struct Metric {
  Triangle<S> a, b;

  Metric(const NearlyCoplanar& pair, double unit)
      : a(scaled(pair.a, unit)), b(scaled(pair.b, unit)) {}

  static Triangle<S> scaled(const GridTriangle& t, double unit) {
    Triangle<S> made;
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t k = 0; k < 3; ++k)
        made[c][static_cast<int>(k)] = static_cast<S>(static_cast<double>(t[c][k]) * unit);
    return made;
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

template <class S>
bool plain(const std::vector<Metric<S>>& pairs, std::size_t i, double epsilon) {
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

}  // namespace

/// Pairs of triangles, one with its corners within a few units in the last place of the other's
/// plane: share of wrong answers to whether they share a point, at three sizes. The reference uses
/// integers, from which the corners are made. Also a map of one corner's last bits, see
/// triangle_answers.h.
std::vector<trace::Study> study_triangles(const StudyOptions& options,
                                          const StudyProgress& progress) {
  const StudyGrid grid(options, kTriangleMethods, kDistances, kTrianglePairs, kTriangleRepetitions);
  std::vector<trace::Study> results = results_of(
      "triangle_triangle", "float", "units in the last place",
      "every edge against the other triangle in whole numbers, " + std::to_string(grid.cases) +
          " pairs a point, seed " + std::to_string(options.seed),
      {{"wrong", "Triangles near one plane: how often a test is wrong, and what never is",
        "share of wrong answers", "", 0.5 / grid.cases}});
  results[0].form = trace::StudyForm::Curves;
  std::vector<std::vector<NearlyCoplanar>> pairs;
  for (const TriangleSize& size : kTriangleSizes) {
    const double unit = std::ldexp(1.0, size.exponent) / static_cast<double>(kReach);
    std::mt19937_64 engine(options.seed);
    std::vector<MetricPairs> metric(grid.parameters.size());
    const std::size_t first = results[0].series.size();
    measure_grid(
        grid, results, progress,
        [&](std::size_t p) {
          if (pairs.size() <= p) {  // the same at each size
            pairs.emplace_back();
            for (int i = 0; i < grid.cases; ++i)
              pairs[p].push_back(nearly_coplanar(engine, grid.parameters[p]));
          }
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
    for (std::size_t s = first; s < results[0].series.size(); ++s) {
      trace::StudySeries& series = results[0].series[s];
      series.panel = std::string("triangles ") + size.panel;
      series.parameter = "units in the last place off one plane, " + series.panel;
      // A share has no worst; zero errors are drawn as half a pair.
      for (trace::StudyPoint& point : series.points)
        point.error = point.error_worst = std::max(*point.error, results[0].resolution);
    }
  }
  results.push_back(triangle_answers());
  return results;
}

}  // namespace contactscope
