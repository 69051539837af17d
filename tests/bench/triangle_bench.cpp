// Time of a million triangle-triangle tests in milliseconds, which equals nanoseconds per test.
// "random" has corners anywhere in one cube; "mix" is 92 % of those, 7 % coplanar or touching, 1 %
// nearly coplanar. Compared with CGAL's exact predicates, if installed.
#include <benchmark/benchmark.h>

#include <vector>

#include "support/random_triangles.h"
#ifdef CONTACTSCOPE_HAS_CGAL
#include "peers/cgal.h"
#endif

namespace {

using namespace contactscope;  // NOLINT(google-build-using-namespace): a program of its own

constexpr int kPairs = 1'000'000;

template <class S> struct Pair { Triangle<S> a, b; };

/// Float coordinates for either scalar, so that all tests answer the same question. CGAL rejects
/// pairs without an area, so they are left out.
template <class S> const std::vector<Pair<S>>& pairs(bool mix) {
  static std::vector<Pair<S>> made[2];
  std::vector<Pair<S>>& list = made[mix ? 1 : 0];
  test::Random random(41);
  list.reserve(kPairs);
  while (list.size() < kPairs) {
    const test::TrianglePairs how = mix ? test::draw_from_mix(random) : test::TrianglePairs::Random;
    const auto [a, b] = test::random_triangle_pair(random, how, 1, Vec3d::Zero(), true);
    if (!is_degenerate(a) && !is_degenerate(b))
      list.push_back({test::rounded<S>(a), test::rounded<S>(b)});
  }
  return list;
}

template <class S, class Test> void measure(benchmark::State& state, bool mix, const Test& test) {
  const std::vector<Pair<S>>& list = pairs<S>(mix);
  int overlapping = 0;
  for (auto _ : state) {
    overlapping = 0;
    for (const Pair<S>& pair : list) overlapping += test(pair.a, pair.b) ? 1 : 0;
    benchmark::DoNotOptimize(overlapping);
  }
  state.counters["overlapping"] = overlapping;
}

template <class S, class Test> void add(const std::string& name, const Test& test) {
  for (const bool mix : {false, true}) {
    benchmark::RegisterBenchmark((name + (mix ? "/mix" : "/random")).c_str(),
                                 [=](benchmark::State& state) { measure<S>(state, mix, test); })
        ->Unit(benchmark::kMillisecond);
  }
}

constexpr auto kKind = [](const auto& a, const auto& b) {
  return triangle_overlap_kind(a, b) != TriangleOverlapKind::None;
};
constexpr auto kSegment = [](const auto& a, const auto& b) {
  const auto overlap = triangle_overlap(a, b);
  benchmark::DoNotOptimize(overlap.segment);
  return overlap.kind != TriangleOverlapKind::None;
};

}  // namespace

int main(int argc, char** argv) {
  add<float>("kind/float", kKind);
  add<double>("kind/double", kKind);
  add<float>("segment/float", kSegment);
#ifdef CONTACTSCOPE_HAS_CGAL
  add<double>("cgal/double",
              [](const auto& a, const auto& b) { return peers::cgal_overlaps(a, b); });
#endif
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
