// Time of every reducer in float on one core, through reduce(), over convex polygons on ellipses:
// contact points as clipping leaves them. Repetitions of all reducers and sizes are interleaved at
// random, so that other load on the machine affects all of them equally. It prints the minimum and
// the median of a call. "..., kept" is a reducer that uses the previous frame, given its own result
// from there: its cost while nothing changes.
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

/// Corners at random angles on a random ellipse, half of the patches counter-clockwise, in a random
/// pose, with the depth of a tilted plane.
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

struct Row {
  std::string name;
  std::string reducer;
  bool remembers;  // receives its own previous selection
};

std::vector<Row> rows() {
  std::vector<Row> list;
  for (const ReducerInfo& info : reducers()) {
    list.push_back({info.name, info.name, false});
    if (info.remembers) list.push_back({info.name + ", kept", info.name, true});
  }
  return list;
}

std::vector<FeatureId> kept_ids(const ReducerInfo* reducer, const Patch& patch) {
  std::vector<FeatureId> ids;
  for (const int index : reduce<float>(reducer, patch.points, patch.normal, {})) {
    ids.push_back(patch.points[static_cast<std::size_t>(index)].id);
  }
  return ids;
}

void run(benchmark::State& state, const Row& row, int size) {
  const ReducerInfo* reducer = find_reducer(row.reducer);
  const std::vector<Patch>& list = patches(size);
  std::vector<std::vector<FeatureId>> previous(list.size());
  if (row.remembers) {
    for (std::size_t i = 0; i < list.size(); ++i) previous[i] = kept_ids(reducer, list[i]);
  }
  for (auto _ : state) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      ReduceOptions options;
      options.previous = previous[i];
      KeptIndices reduction = reduce<float>(reducer, list[i].points, list[i].normal, options);
      benchmark::DoNotOptimize(reduction);
    }
  }
}

std::string name_of(const Row& row, int size) { return row.name + "/" + std::to_string(size); }

/// Collects the nanoseconds per call of every repetition and prints only the table.
class SummaryReporter : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context& context) override {
    PrintBasicContext(&GetErrorStream(), context);
    return true;
  }

  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration) continue;
      times_[run.run_name.function_name].push_back(run.cpu_accumulated_time * 1e9 /
                                                   static_cast<double>(run.iterations) / kPatches);
    }
  }

  void Finalize() override {
    std::printf("ns: least / median");
    for (const int size : kSizes) std::printf("%16s", ("n = " + std::to_string(size)).c_str());
    std::printf("\n");
    for (const Row& row : rows()) {
      std::printf("%-18s", row.name.c_str());
      for (const int size : kSizes) {
        std::vector<double>& times = times_[name_of(row, size)];
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
  // Defaults come first, so that the command line wins.
  std::string interleave = "--benchmark_enable_random_interleaving=true";
  std::string repetitions = "--benchmark_repetitions=9";
  std::string time = "--benchmark_min_time=0.005";
  std::vector<char*> arguments = {argv[0], interleave.data(), repetitions.data(), time.data()};
  arguments.insert(arguments.end(), argv + 1, argv + argc);
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;

  for (const Row& row : rows()) {
    for (const int size : kSizes) {
      benchmark::RegisterBenchmark(name_of(row, size).c_str(),
                                   [row, size](benchmark::State& state) { run(state, row, size); });
    }
  }
  SummaryReporter summary;
  benchmark::RunSpecifiedBenchmarks(&summary);
  return 0;
}
