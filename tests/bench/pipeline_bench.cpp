// Time per pair through the contact pipeline, in float on one core, for the workloads of
// workload.h: "unrecorded", "recorded", without the caches of moving pairs ("cold"), without the
// special paths of boxes, large hulls and capsules ("general"), and through other libraries. All
// variants are interleaved at random, so that other load on the machine affects all of them
// equally; the minimum excludes it, the median shows it.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "bench/passes.h"
#include "bench/variant.h"
#include "bench/workload.h"

namespace {

using contactscope::bench::is_moving;
using contactscope::bench::kPairsPerWorkload;
using contactscope::bench::kWorkloads;
using contactscope::bench::Variant;
using contactscope::bench::Workload;

constexpr const char* kWorkloadNames[kWorkloads] = {
    "W1_box_face",       "W2_box_edge",     "W3_box_random",    "W4_hull32",
    "W5a_capsule_hull",  "W5b_sphere_hull", "W5c_two_capsules", "W6a_box_moving",
    "W6b_hull32_moving", "W7a_box_mesh",    "W7b_hull16_mesh"};

std::vector<Variant> all_variants() {
  const auto always = [](int) { return true; };
  const auto moving = [](int workload) { return is_moving(static_cast<Workload>(workload)); };
  const auto of_mesh = [](int workload) {
    return static_cast<Workload>(workload) >= Workload::BoxMesh;
  };
  const auto with_own_path = [](int workload) {
    const auto of = static_cast<Workload>(workload);
    return of <= Workload::Hull32 || of == Workload::CapsuleCapsule ||
           of == Workload::BoxFaceMoving || of == Workload::BoxMesh;
  };
  std::vector<Variant> result = {
      {"unrecorded", contactscope::bench::pass_unrecorded, always},
      {"recorded", contactscope::bench::pass_recorded, always},
      {"cold", contactscope::bench::pass_cold, moving},
      {"triangle", contactscope::bench::pass_by_triangle, of_mesh},
      {"general", contactscope::bench::pass_general, with_own_path},
  };
  for (Variant& variant : contactscope::bench::peer_variants()) {
    result.push_back(std::move(variant));
  }
  return result;
}

std::string name_of(int workload, const Variant& variant) {
  return std::string(kWorkloadNames[workload]) + "/" + variant.name;
}

void run(benchmark::State& state, int workload, const Variant& variant) {
  variant.pass(workload);  // builds the pairs
  for (auto _ : state) {
    double sum = variant.pass(workload);
    benchmark::DoNotOptimize(sum);
  }
}

/// Collects the nanoseconds per pair of every repetition and prints only the tables.
class SummaryReporter : public benchmark::BenchmarkReporter {
 public:
  explicit SummaryReporter(const std::vector<Variant>& variants) : variants_(variants) {}

  bool ReportContext(const Context& context) override {
    PrintBasicContext(&GetErrorStream(), context);
    return true;
  }

  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration) continue;
      const double nanoseconds =
          run.cpu_accumulated_time * 1e9 / static_cast<double>(run.iterations) / kPairsPerWorkload;
      times_[run.run_name.function_name].push_back(nanoseconds);
    }
  }

  void Finalize() override {
    for (auto& [name, times] : times_) std::sort(times.begin(), times.end());
    print("least ns a pair", [](const std::vector<double>& sorted) { return sorted.front(); });
    print("median", [](const std::vector<double>& sorted) { return sorted[sorted.size() / 2]; });
  }

 private:
  template <class Pick> void print(const char* title, const Pick& pick) const {
    std::printf("\n%-18s", title);
    for (const Variant& variant : variants_) std::printf("%11s", variant.name.c_str());
    std::printf("%21s%19s%17s\n", "recorded/unrecorded", "unrecorded/Bullet", "cold/unrecorded");
    for (int workload = 0; workload < kWorkloads; ++workload) {
      std::map<std::string, double> row;
      for (const Variant& variant : variants_) {
        const auto found = times_.find(name_of(workload, variant));
        if (found != times_.end()) row[variant.name] = pick(found->second);
      }
      if (row.empty()) continue;
      std::printf("%-18s", kWorkloadNames[workload]);
      for (const Variant& variant : variants_) print_cell(11, 0, row, variant.name, {});
      print_cell(21, 2, row, "recorded", "unrecorded");
      print_cell(19, 3, row, "unrecorded", "Bullet");
      print_cell(17, 1, row, "cold", "unrecorded");
      std::printf("\n");
    }
  }

  /// A time, or its ratio to another; a dash if one is missing.
  static void print_cell(int width, int digits, const std::map<std::string, double>& row,
                         const std::string& name, const std::string& over) {
    const auto value = row.find(name);
    const auto divisor = row.find(over);
    if (value == row.end() || (!over.empty() && divisor == row.end())) {
      std::printf("%*s", width, "-");
      return;
    }
    const double shown = over.empty() ? value->second : value->second / divisor->second;
    std::printf("%*.*f", width, digits, shown);
  }

  const std::vector<Variant>& variants_;
  std::map<std::string, std::vector<double>> times_;
};

}  // namespace

int main(int argc, char** argv) {
  // Defaults come first, so that the command line wins.
  std::string interleave = "--benchmark_enable_random_interleaving=true";
  std::string repetitions = "--benchmark_repetitions=20";
  std::string time = "--benchmark_min_time=0.02";
  std::vector<char*> arguments = {argv[0], interleave.data(), repetitions.data(), time.data()};
  arguments.insert(arguments.end(), argv + 1, argv + argc);
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;

  const std::vector<Variant> variants = all_variants();
  for (int workload = 0; workload < kWorkloads; ++workload) {
    for (const Variant& variant : variants) {
      if (!variant.runs(workload)) continue;
      benchmark::RegisterBenchmark(
          name_of(workload, variant).c_str(),
          [workload, &variant](benchmark::State& state) { run(state, workload, variant); });
    }
  }
  SummaryReporter summary(variants);
  benchmark::RunSpecifiedBenchmarks(&summary);
  return 0;
}
