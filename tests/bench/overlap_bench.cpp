// Time per pair of oriented boxes in float on one core, over a million pairs (a tenth are
// parallel), and wrong answers of each test. Bullet (GImpact) and FCL test the same pairs if
// installed. All tests take turns, so that other load on the machine affects them equally.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "bench/overlap_pairs.h"
#include "query/overlap.h"

namespace {

using namespace contactscope;  // NOLINT(google-build-using-namespace): a program of its own
using bench::BoxPair;

constexpr int kPairs = 1000000;
constexpr int kPasses = 11;

struct EngineRun {
  std::string name;
  bench::OverlapPass pass;  // results of all pairs
  std::vector<double> times{};
};

bench::OverlapPass ours(const ObbTest<float>& test) {
  return [test](const std::vector<BoxPair>& pairs, std::vector<char>& answers) {
    for (std::size_t i = 0; i < pairs.size(); ++i)
      answers[i] = overlaps(pairs[i].a, pairs[i].b, Comparison<float>::inclusive(), test) ? 1 : 0;
  };
}

}  // namespace

int main() {
  const std::vector<BoxPair> pairs = bench::overlap_pairs(kPairs);
  std::vector<EngineRun> engine_runs = {{"guarded", ours({})},
                                        {"fifteen, none skipped", ours({ObbAxes::Fifteen, 0})},
                                        {"fifteen, 1e-6 skipped", ours({ObbAxes::Fifteen, 1e-6F})},
                                        {"fifteen, 1e-3 skipped", ours({ObbAxes::Fifteen, 1e-3F})},
                                        {"faces", ours({ObbAxes::Faces, 0})}};
  for (auto& [name, pass] : bench::peer_passes(pairs)) engine_runs.push_back({name, pass});

  std::vector<char> answers(pairs.size());
  for (int pass = 0; pass < kPasses; ++pass) {
    for (EngineRun& engine_run : engine_runs) {
      const auto begin = std::chrono::steady_clock::now();
      engine_run.pass(pairs, answers);
      const std::chrono::duration<double, std::nano> time =
          std::chrono::steady_clock::now() - begin;
      engine_run.times.push_back(time.count() / kPairs);
    }
  }

  int overlapping = 0;
  for (const BoxPair& pair : pairs) overlapping += pair.gap <= 0 ? 1 : 0;
  std::printf("%d pairs, %d overlap\n%-24s%10s%10s%10s%16s%10s\n", kPairs, overlapping, "", "ns",
              "median", "missed", "by up to, m", "phantom");
  for (EngineRun& engine_run : engine_runs) {
    engine_run.pass(pairs, answers);
    int missed = 0, phantom = 0;
    double deepest = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (pairs[i].gap <= 0 && answers[i] == 0) {
        ++missed;
        deepest = std::max(deepest, -pairs[i].gap);
      }
      phantom += pairs[i].gap > pairs[i].rounding && answers[i] != 0 ? 1 : 0;
    }
    std::sort(engine_run.times.begin(), engine_run.times.end());
    std::printf("%-24s%10.1f%10.1f%10d%16.2g%10d\n", engine_run.name.c_str(),
                engine_run.times.front(), engine_run.times[kPasses / 2], missed, deepest, phantom);
  }
  return 0;
}
