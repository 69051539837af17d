// Time of one pair through the contact pipeline, in float on one core, for the workloads of
// workload.h: without a recorder compiled in ("bare"), with one that nobody uses ("unrecorded"),
// and recording ("recorded"). Repetitions of all variants are interleaved at random and the minimum
// counts, so that what else the machine does falls on all of them and drops out.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "bench/passes.h"
#include "bench/workload.h"

namespace {

using contactscope::bench::kPairsPerWorkload;
using contactscope::bench::kWorkloads;

constexpr const char* kWorkloadNames[kWorkloads] = {"W1_box_face", "W2_box_edge", "W3_box_random",
                                                    "W4_hull32"};

struct Variant {
  const char* name;
  double (*pass)(int workload);
};

constexpr Variant kVariants[] = {
    {"bare", &contactscope_bare::bench::pass_unrecorded},
    {"unrecorded", &contactscope::bench::pass_unrecorded},
    {"recorded", &contactscope::bench::pass_recorded},
};

std::string name_of(int workload, const Variant& variant) {
  return std::string(kWorkloadNames[workload]) + "/" + variant.name;
}

void run(benchmark::State& state, int workload, const Variant& variant) {
  variant.pass(workload);  // makes the pairs
  for (auto _ : state) {
    double sum = variant.pass(workload);
    benchmark::DoNotOptimize(sum);
  }
}

/// Collects the least nanoseconds a pair of every benchmark and prints nothing but the table.
class SummaryReporter : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context& context) override {
    PrintBasicContext(&GetErrorStream(), context);
    return true;
  }

  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
      const double nanoseconds =
          run.cpu_accumulated_time * 1e9 / static_cast<double>(run.iterations) / kPairsPerWorkload;
      const auto [found, inserted] = least_.emplace(run.run_name.function_name, nanoseconds);
      if (!inserted) found->second = std::min(found->second, nanoseconds);
    }
  }

  void Finalize() override {
    std::printf("%-15s", "ns per pair");
    for (const Variant& variant : kVariants) std::printf("%12s", variant.name);
    std::printf("%18s\n", "unrecorded/bare");
    for (int workload = 0; workload < kWorkloads; ++workload) {
      std::printf("%-15s", kWorkloadNames[workload]);
      double times[std::size(kVariants)];
      for (std::size_t i = 0; i < std::size(kVariants); ++i) {
        const auto found = least_.find(name_of(workload, kVariants[i]));
        times[i] = found == least_.end() ? std::numeric_limits<double>::quiet_NaN() : found->second;
        std::printf("%12.0f", times[i]);
      }
      std::printf("%18.3f\n", times[1] / times[0]);
    }
  }

 private:
  std::map<std::string, double> least_;
};

}  // namespace

int main(int argc, char** argv) {
  // Defaults first, so that the command line wins.
  std::string interleave = "--benchmark_enable_random_interleaving=true";
  std::string repetitions = "--benchmark_repetitions=20";
  std::string time = "--benchmark_min_time=0.02";
  std::vector<char*> arguments = {argv[0], interleave.data(), repetitions.data(), time.data()};
  arguments.insert(arguments.end(), argv + 1, argv + argc);
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;

  for (int workload = 0; workload < kWorkloads; ++workload) {
    for (const Variant& variant : kVariants) {
      benchmark::RegisterBenchmark(
          name_of(workload, variant).c_str(),
          [workload, variant](benchmark::State& state) { run(state, workload, variant); });
    }
  }
  SummaryReporter summary;
  benchmark::RunSpecifiedBenchmarks(&summary);
  return 0;
}
