// Time of every reducer in float on one core, through reduce(), over convex polygons on ellipses:
// contact points as clipping leaves them. Repetitions of all reducers and sizes are interleaved at
// random, so that what else the machine does falls on all of them; the minimum and the median of a
// call are printed.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "reduce/reducer.h"
#include "support/random_geometry.h"

namespace {

using namespace contactscope;  // NOLINT(google-build-using-namespace): a program of its own

constexpr int kSizes[] = {5, 6, 8, 12, 16, 32};
constexpr int kPatches = 1024;

struct Patch {
  std::vector<ContactPoint<float>> points;
  Vec3f normal;
};

/// Corners at random angles on a random ellipse, half of them counter-clockwise, in a random pose,
/// as deep as a tilted plane.
Patch random_patch(test::Random& random, int size) {
  std::vector<double> angles;
  for (int i = 0; i < size; ++i) angles.push_back(random.uniform(0, 2 * std::numbers::pi));
  std::sort(angles.begin(), angles.end());
  if (random.chance(0.5)) std::reverse(angles.begin(), angles.end());
  const double flat = random.uniform(0.3, 1);
  const Pose<double> pose = random.pose(5);
  const double tilt = random.uniform(-0.01, 0.01);
  Patch patch;
  patch.normal = pose.rotate(Vec3d::UnitZ()).cast<float>();
  for (const double angle : angles) {
    const Vec3d local(0.5 * std::cos(angle), 0.5 * flat * std::sin(angle), 0);
    const auto edge = static_cast<std::uint32_t>(patch.points.size());
    patch.points.push_back({pose.transform(local).cast<float>(),
                            static_cast<float>(-0.01 + tilt * (local.x() + local.y())),
                            FeatureId::of({Owner::A, edge}, {Owner::B, edge})});
  }
  return patch;
}

const std::vector<Patch>& patches(int size) {
  static std::map<int, std::vector<Patch>> made;
  std::vector<Patch>& list = made[size];
  if (list.empty()) {
    test::Random random(static_cast<std::uint64_t>(size));
    for (int i = 0; i < kPatches; ++i) list.push_back(random_patch(random, size));
  }
  return list;
}

void run(benchmark::State& state, const std::string& name, int size) {
  const Reducer<float> reducer = find_reducer<float>(name);
  const std::vector<Patch>& list = patches(size);
  const ReduceOptions options;
  for (auto _ : state) {
    for (const Patch& patch : list) {
      Reduction reduction = reduce<float>(reducer, patch.points, patch.normal, options);
      benchmark::DoNotOptimize(reduction);
    }
  }
}

std::string name_of(const std::string& reducer, int size) {
  return reducer + "/" + std::to_string(size);
}

/// Collects the nanoseconds a call of every repetition and prints nothing but the table.
class SummaryReporter : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context& context) override {
    PrintBasicContext(&GetErrorStream(), context);
    return true;
  }

  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
      times_[run.run_name.function_name].push_back(run.cpu_accumulated_time * 1e9 /
                                                   static_cast<double>(run.iterations) / kPatches);
    }
  }

  void Finalize() override {
    std::printf("ns: least / median");
    for (const int size : kSizes) std::printf("%16s", ("n = " + std::to_string(size)).c_str());
    std::printf("\n");
    for (const ReducerInfo& info : reducers()) {
      std::printf("%-18s", info.name.c_str());
      for (const int size : kSizes) {
        std::vector<double>& times = times_[name_of(info.name, size)];
        std::sort(times.begin(), times.end());
        if (times.empty()) {
          std::printf("%16s", "-");
        } else {
          std::printf("%8.0f /%6.0f", times.front(), times[times.size() / 2]);
        }
      }
      std::printf("\n");
    }
  }

 private:
  std::map<std::string, std::vector<double>> times_;
};

}  // namespace

int main(int argc, char** argv) {
  // Defaults first, so that the command line wins.
  std::string interleave = "--benchmark_enable_random_interleaving=true";
  std::string repetitions = "--benchmark_repetitions=9";
  std::string time = "--benchmark_min_time=0.005";
  std::vector<char*> arguments = {argv[0], interleave.data(), repetitions.data(), time.data()};
  arguments.insert(arguments.end(), argv + 1, argv + argc);
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;

  for (const ReducerInfo& info : reducers()) {
    for (const int size : kSizes) {
      benchmark::RegisterBenchmark(
          name_of(info.name, size).c_str(),
          [name = info.name, size](benchmark::State& state) { run(state, name, size); });
    }
  }
  SummaryReporter summary;
  benchmark::RunSpecifiedBenchmarks(&summary);
  return 0;
}
