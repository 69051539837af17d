// Continuous collision: nanoseconds per query, missed impacts, hits reported for shapes that
// already overlapped, and errors of the times. Cases: two hulls of 32 vertices, a sphere and a
// triangle, moving vertices, edges and faces, sheets that deform. Compared with the other libraries
// that are installed.
//
//   impact_bench [queries [repetitions]]
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "continuous/feature_pair.h"
#include "continuous/impact_with_mesh.h"
#include "continuous/portal_cast.h"
#include "study/impact_cases.h"
#include "study/study.h"
#ifdef CONTACTSCOPE_PEERS
#include "peers/impact_peer.h"
#endif

namespace {

using namespace contactscope;  // NOLINT(google-build-using-namespace): a program of its own

void print_time(const char* name, const PassTimes& times) {
  const trace::Nanoseconds spent = times.summary();
  std::printf("  %-34s %8.0f ns (least %.0f)", name, spent.median, spent.min);
}

void bench_hulls(const char* title, const ImpactMotion& motion, int queries, int repetitions) {
  std::mt19937_64 engine(7);
  std::vector<ImpactCase> cases;
  for (int i = 0; i < queries; ++i) cases.push_back(random_impact_case(engine, 32, motion));
  std::printf("\nhulls of 32 vertices, %s, %d queries\n", title, queries);
  std::vector<ImpactFinderInfo> infos = own_impact_finders();
#ifdef CONTACTSCOPE_PEERS
  for (const ImpactFinderInfo& peer : peers::impact_peers()) infos.push_back(peer);
#endif
  std::erase_if(infos, [&](const auto& info) { return motion.turn > 0 && !info.knows_rotation; });
  std::vector<std::unique_ptr<ImpactFinder>> finders;
  for (const ImpactFinderInfo& info : infos) finders.push_back(info.make(cases));
  std::vector<PassTimes> times(infos.size());
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    for (std::size_t f = 0; f < infos.size(); ++f)
      times[f].measure(queries, [&](int i) { return finders[f]->find(i).time; });
  }
  for (std::size_t f = 0; f < infos.size(); ++f) {
    print_time(infos[f].name.c_str(), times[f]);
    const ImpactTally tally = judge_impacts(*finders[f], cases);
    std::printf("  hits %d, missed %d, inside %d, invented %d, off by %.1e (99 %%) %.1e (all)\n",
                tally.hits, tally.missed, tally.inside, tally.invented, tally.error_of(0.99),
                tally.error_of(1));
  }
}

void bench_swept(int queries, int repetitions) {
  test::Random random(8);
  struct Query {
    Vec3f start, offset;
    float radius;
    std::array<Vec3f, 3> triangle;
  };
  for (const double away : {0.0, 1000.0}) {
    std::vector<Query> cases;
    for (int i = 0; i < queries; ++i) {
      const Vec3d origin = away * random.unit_vector();
      Query query;
      for (Vec3f& corner : query.triangle) corner = (origin + random.vector(-1, 1)).cast<float>();
      const double radius = random.uniform(0.05, 0.5);
      const Vec3d start = 4 * random.unit_vector();
      const Vec3d aim = random.vector(-1, 1);
      query.radius = static_cast<float>(radius);
      query.start = (origin + start).cast<float>();
      query.offset = (1.5 * (aim - start)).cast<float>();
      cases.push_back(query);
    }
    std::printf("\nswept against a triangle, %g m from the origin, float\n", away);
    const auto bench = [&](const char* name, const auto& time_of) {
      PassTimes times;
      for (int repetition = 0; repetition < repetitions; ++repetition)
        times.measure(queries, [&](int i) { return time_of(cases[static_cast<std::size_t>(i)]); });
      print_time(name, times);
      std::printf("\n");
    };
    bench("sphere", [](const Query& query) {
      return sweep_sphere_triangle(query.start, query.offset, query.radius, query.triangle).time;
    });
  }
}

void bench_features(const char* title, int queries, int repetitions,
                    const std::function<test::FeaturePair<double>(test::Random&)>& make) {
  test::Random random(9);
  std::vector<test::FeaturePair<double>> pairs;
  for (int i = 0; i < queries; ++i) pairs.push_back(make(random));
  PassTimes times;
  double worst = 0;
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    times.measure(queries,
                  [&](int i) { return pairs[static_cast<std::size_t>(i)].impact().begin; });
  }
  int counts[4] = {}, most_steps = 0;
  double steps = 0;
  for (const auto& pair : pairs) {
    // Minimum of three, to exclude a slow moment of the machine.
    double own = 1e12;
    FeatureImpact impact;
    for (int k = 0; k < 3; ++k) {
      PassTimes one;
      one.measure(1, [&](int) { return (impact = pair.impact()).begin; });
      own = std::min(own, one.summary().min);
    }
    worst = std::max(worst, own);
    ++counts[static_cast<int>(impact.status)];
    steps += impact.steps;
    most_steps = std::max(most_steps, impact.steps);
  }
  std::printf("\nvertex and face, edge and edge, %s, %d pairs\n", title, queries);
  print_time("moving features", times);
  std::printf(
      "  worst %.1f us; separated %d, hit %d, near %d, overlapping %d; steps %.2f, at most %d\n",
      worst / 1000, counts[0], counts[1], counts[2], counts[3], steps / queries, most_steps);
}

/// A square of one metre in 22 by 22 quads, turned about the vertical, with other waves at the end.
struct Sheet {
  Sheet(test::Random& random, double height, double fall) {
    constexpr int kQuads = 22;
    const auto wavy = [](const Vec3d& phase, const Vec3d& number, double x, double y) {
      return 0.05 * std::sin(number.x() * x + phase.x()) * std::cos(number.y() * y + phase.y());
    };
    const Vec3d phase = random.vector(0, 6), number = random.vector(4, 12);
    const double angle = random.uniform(0, 6);
    const Vec3d along(std::cos(angle), std::sin(angle), 0), across(-along.y(), along.x(), 0);
    std::vector<Vec3d> vertices;
    for (int j = 0; j <= kQuads; ++j) {
      for (int i = 0; i <= kQuads; ++i) {
        Vec3d vertex = (static_cast<double>(i) / kQuads - 0.5) * along +
                       (static_cast<double>(j) / kQuads - 0.5) * across;
        vertex.z() = height + wavy(phase, number, vertex.x(), vertex.y());
        vertices.push_back(vertex);
      }
    }
    std::vector<std::array<int, 3>> triangles;
    for (int j = 0; j < kQuads; ++j) {
      for (int i = 0; i < kQuads; ++i) {
        const int corner = j * (kQuads + 1) + i, above = corner + kQuads + 1;
        triangles.push_back({corner, corner + 1, above + 1});
        triangles.push_back({corner, above + 1, above});
      }
    }
    start = build_mesh(vertices, triangles);
    const Vec3d phase_after = random.vector(0, 6), number_after = random.vector(4, 12);
    for (const Vec3d& vertex : start.vertices) {
      const double wave = wavy(phase_after, number_after, vertex.x(), vertex.y());
      end.emplace_back(vertex.x(), vertex.y(), height - fall + wave);
    }
  }

  Mesh<double> start;
  std::vector<Vec3d> end;
};

void bench_sheets(int queries, int repetitions) {
  test::Random random(10);
  std::vector<std::pair<Sheet, Sheet>> pairs;
  for (int i = 0; i < queries; ++i) {
    const Sheet lower(random, 0, 0);
    const double fall = random.uniform(0.05, 0.6);
    pairs.emplace_back(lower, Sheet(random, 0.25, fall));
  }
  const auto impact = [&](int i) {
    const auto& [lower, upper] = at(pairs, i);
    return impact_of_meshes<double>({lower.start, lower.end}, {upper.start, upper.end});
  };
  PassTimes times;
  for (int repetition = 0; repetition < repetitions; ++repetition)
    times.measure(queries, [&](int i) { return impact(i).impact.begin; });
  int counts[4] = {};
  double triangle_pairs = 0, feature_pairs = 0;
  for (int i = 0; i < queries; ++i) {
    const MeshImpact found = impact(i);
    ++counts[static_cast<int>(found.impact.status)];
    triangle_pairs += static_cast<double>(found.counts.triangle_pairs);
    feature_pairs += static_cast<double>(found.counts.feature_pairs);
  }
  std::printf("\nsheets of %d triangles that deform, %d pairs\n",
              pairs.front().first.start.triangle_count(), queries);
  print_time("moving meshes", times);
  std::printf(
      "  separated %d, hit %d, near %d, overlapping %d; triangle pairs %.0f, feature pairs %.0f\n",
      counts[0], counts[1], counts[2], counts[3], triangle_pairs / queries,
      feature_pairs / queries);
}

}  // namespace

int main(int argc, char** argv) {
  const int queries = argc > 1 ? std::atoi(argv[1]) : 2048;
  const int repetitions = argc > 2 ? std::atoi(argv[2]) : 15;
  if (queries < 1 || repetitions < 1) {
    std::fprintf(stderr, "usage: impact_bench [queries [repetitions]]\n");
    return 2;
  }
  bench_hulls("translating", {10, 0, 0}, queries, repetitions);
  bench_hulls("rotating", {10, 2, 0}, queries, repetitions);
  bench_swept(10 * queries, repetitions);
  bench_features("near each other", 10 * queries, repetitions, [](test::Random& random) {
    return test::random_feature_pair(random, random.decade(-4, 4));
  });
  bench_features("hits by construction", 10 * queries, repetitions, [](test::Random& random) {
    double time;
    return test::exact_feature_hit(random, random.chance(0.5), time);
  });
  bench_sheets(std::max(queries / 32, 1), repetitions);
  return 0;
}
