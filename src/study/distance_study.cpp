#include "geometry/primitives.h"
#include "query/closest_points.h"
#include "query/minkowski_difference.h"
#include "query/tolerance.h"
#include "query/v_clip.h"
#include "query/voronoi_region.h"
#include "study/random_cases.h"
#include "study/study.h"

namespace contactscope {
namespace {

constexpr int kVertices[] = {8, 16, 32, 64, 128};
constexpr int kSeparatedPairs = 40, kDistanceRepetitions = 5, kDrumPairs = 1000;

struct SeparatedHulls : OverlappingHulls {
  SeparatedHulls(std::mt19937_64& engine, int vertices)
      : OverlappingHulls(overlapping_hulls(engine, vertices)) {
    const double gap = uniform(engine, 0.02, 0.5) * size;
    b_in_a.position += (gap - deepest.separation) * deepest.normal;
  }
};

/// A distance in metres, and the number of steps to it.
struct Stepped {
  double distance, steps;
};

/// The least distance of a vertex of `b` from a face of `a` that it is over.
double over_faces(const Hull<double>& a, const Hull<double>& b, const Pose<double>& b_in_a) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3d& vertex : b.vertices) {
    const Vec3d point = b_in_a.transform(vertex);
    for (int face = 0; face < a.face_count(); ++face)
      if (const double height = at(a.planes, face).distance(point);
          height >= 0 && height < least && outside_side(a, face, point) < 0)
        least = height;
  }
  return least;
}

/// Every vertex against every face and edge against edge, as in the lecture's search.
Stepped all_pairs(const SeparatedHulls& c) {
  double least = std::min(over_faces(c.a, c.b, c.b_in_a),
                          over_faces(c.b, c.a, relative_pose(c.b_in_a, Pose<double>())));
  for (int i = 0; i < 2 * c.a.edge_count(); i += 2)
    for (int j = 0; j < 2 * c.b.edge_count(); j += 2)
      least = std::min(least, closest_of_segments<double>(c.a.origin(i), c.a.target(i),
                                                          c.b_in_a.transform(c.b.origin(j)),
                                                          c.b_in_a.transform(c.b.target(j)))
                                  .distance);
  const auto features = [](const Hull<double>& hull) {
    return double(hull.vertex_count() + hull.edge_count() + hull.face_count());
  };
  return {least, features(c.a) * features(c.b)};
}

struct DistanceSearch {
  const char* name;
  Stepped (*find)(const SeparatedHulls& pair);
};
constexpr DistanceSearch kSearches[] = {
    {"all pairs of features", &all_pairs},
    {"V-Clip",
     [](const SeparatedHulls& c) -> Stepped {
       const VClipResult<double> found = v_clip(c.a, c.b, c.b_in_a);
       return {found.distance, found.steps + 1.0};
     }},
    {"GJK",
     [](const SeparatedHulls& c) -> Stepped {
       const GjkResult<double> found = gjk(support_set(c.a), support_set(c.b), c.b_in_a);
       return {found.distance, double(found.iterations)};
     }},
};

/// By how much each next point of GJK is nearer along the search, in units, up to the end or the cap;
/// as in gjk.cpp, or without its tolerances for steps and for faces of a simplex.
std::vector<float> gains(const MinkowskiDifference<float>& difference, bool has_tolerances) {
  const float scale = has_tolerances ? difference.scale() : 0;
  std::array<Vec3f, 4> points = {
      difference.point(difference.support_against(difference.between_middles()))};
  NearestOnSimplex<float> nearest;
  nearest_on_simplex(points, 1, scale, nearest);
  std::vector<float> result;
  while (count_of(result) < kMaxGjkIterations && nearest.count < 4) {
    const Vec3f direction = nearest.direction.normalized();
    const Vec3f point = difference.point(difference.support_against(direction));
    float& gain = result.emplace_back(std::numeric_limits<float>::infinity());
    const auto count = static_cast<std::size_t>(nearest.count);
    for (std::size_t i = 0; i < count; ++i) gain = std::min(gain, direction.dot(points[i] - point));
    if (!(gain > tie_tolerance(scale))) break;
    points[count] = point;
    nearest_on_simplex(points, nearest.count + 1, scale, nearest);
    for (std::size_t i = 0; i < static_cast<std::size_t>(nearest.count); ++i)
      points[i] = points[static_cast<std::size_t>(nearest.kept[i])];
  }
  return result;
}

/// Two drums face to face, as in scenario query/gjk_limits: many points of their difference are nearly
/// in one plane. The drawn pair is the first that only the cap ends without tolerances.
trace::Study study_gains(const StudyOptions& options) {
  std::vector<trace::Study> results = results_of(
      "distance", "float", "step of GJK", "",
      {{"gains", "How much nearer GJK's next point is", "gain of a step / size of the pair"}},
      trace::StudyForm::Curves);
  const Hull<float> drum = hull_cast<float>(make_cylinder(0.5, 0.2, 16));
  const SupportSet<float> set = support_set(drum);
  std::mt19937_64 engine(options.seed);
  std::array<std::vector<float>, 2> drawn;  // with tolerances, without
  std::array<int, 2> capped{};
  float scale = 1;
  for (int i = 0; i < kDrumPairs; ++i) {
    const Vec3d axis(uniform(engine, -1, 1), 0, uniform(engine, -1, 1));
    const Quatd turn = Eigen::AngleAxisd(1.7e-4, axis.normalized()) *
                       Eigen::AngleAxisd(uniform(engine, -3, 3), Vec3d::UnitY());
    const Vec3d place(uniform(engine, -0.3, 0.3), 0.5, uniform(engine, -0.3, 0.3));
    const MinkowskiDifference<float> difference(set, set, Pose<double>{turn, place}.cast<float>());
    const std::array both = {gains(difference, true), gains(difference, false)};
    for (std::size_t k : {0, 1}) capped[k] += count_of(both[k]) == kMaxGjkIterations;
    if (capped[1] == 1 && drawn[1].empty()) drawn = both, scale = difference.scale();
  }
  for (const std::size_t k : {0, 1}) {
    trace::StudySeries& line = results[0].series.emplace_back(
        trace::StudySeries{k == 0 ? "with tolerances" : "without tolerances", {}});
    for (const float gain : drawn[k])
      line.points.push_back({count_of(line.points) + 1.0, gain, {}, {}, 0, kDrumPairs});
    if (!line.points.empty()) line.points.back().failed = capped[k];
  }
  const double tolerance = double(tie_tolerance(scale)), cap = kMaxGjkIterations;
  const auto reference = [&](const char* name, double from, double low, double high) {
    trace::StudySeries& line = results[0].series.emplace_back(trace::StudySeries{name, {}});
    for (const auto& [step, gain] : {std::pair(from, low), std::pair(cap, high)})
      line.points.push_back({step, gain, {}, {}});
  };
  reference("tolerance", 1, tolerance, tolerance);
  reference("cap", cap, 1e-9, 1);
  return results[0];
}

}  // namespace

/// "pairs": how many pairs of features V-Clip compares for the distance of two random hulls, how
/// many steps GJK takes, and how many pairs there are. A case fails if its distance is not that of
/// all pairs. "gains": by how much GJK's next point is nearer, step by step, for a pair that never
/// ends without tolerances. Failed are the pairs, of a thousand such, that only the cap ends.
std::vector<trace::Study> study_distance(const StudyOptions& options,
                                         const StudyProgress& progress) {
  const StudyGrid grid(options, kSearches, kVertices, kSeparatedPairs, kDistanceRepetitions);
  std::vector<trace::Study> results = results_of(
      "distance", "double", "vertices of each hull",
      "all pairs of features, " + std::to_string(grid.cases) + " separated pairs a point" +
          options.seeded(),
      {{"pairs", "Steps to the distance of two hulls", "compared pairs of features, or steps"}},
      trace::StudyForm::Curves);
  std::vector<std::vector<SeparatedHulls>> pairs(grid.parameters.size());
  std::mt19937_64 engine(options.seed);
  measure_grid(
      grid, results, progress,
      [&](std::size_t p) {
        for (int i = 0; i < grid.cases; ++i) pairs[p].emplace_back(engine, grid.parameters[p]);
      },
      [&](std::size_t m, std::size_t p, Measurement& measured) {
        for (const SeparatedHulls& pair : pairs[p]) {
          const Stepped found = kSearches[m].find(pair);
          measured.errors[0].add(found.steps);
          measured.failed +=
              std::abs(found.distance - all_pairs(pair).distance) > 1e-12 * pair.size;
        }
      },
      [&](std::size_t m, std::size_t p, std::size_t i) {
        return kSearches[m].find(pairs[p][i]).distance;
      });
  results.push_back(study_gains(options));
  return results;
}

}  // namespace contactscope
