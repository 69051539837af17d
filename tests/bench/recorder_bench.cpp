// Cost of the recorder per contact point: a frame of 1000 pairs of four points, written to a file,
// in float and in double; and of a recorder that was not started.
#include <benchmark/benchmark.h>

#include <array>
#include <filesystem>
#include <random>
#include <vector>

#define CONTACTSCOPE_IMPLEMENTATION
#include "recorder/contactscope.h"

namespace {

constexpr int kPairs = 1000, kPoints = 4;

struct Contacts {
  std::vector<std::array<cs_point, kPoints>> points;
  std::array<double, 3> normal{0.6, 0.64, 0.48};
};

/// Numbers with all their digits, as in an engine.
Contacts random_contacts() {
  Contacts contacts;
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> place(-50, 50), depth(-0.01, 0.001);
  for (int i = 0; i < kPairs; ++i) {
    auto& four = contacts.points.emplace_back();
    for (cs_point& point : four) {
      point = cs_point{};
      point.has_sides = point.has_impulse = point.has_id = 1;
      point.separation = depth(engine);
      point.impulse = 100 * depth(engine) * depth(engine);
      point.id = engine();
      for (int k = 0; k < 3; ++k) {
        point.position[k] = point.on_a[k] = place(engine);
        point.on_b[k] = point.on_a[k] + depth(engine);
        point.friction[k] = depth(engine);
      }
    }
  }
  return contacts;
}

void record(benchmark::State& state, bool starts, bool doubles) {
  const Contacts contacts = random_contacts();
  const std::string path =
      (std::filesystem::temp_directory_path() / "recorder_bench.jsonl").string();
  cs_settings settings{};
  settings.doubles = doubles ? 1 : 0;
  cs_recorder* r = nullptr;
  std::vector<int> shapes;
  const auto restart = [&] {
    cs_stop(r);
    r = starts ? cs_start(path.c_str(), "bench/contacts", nullptr, nullptr, &settings) : nullptr;
    shapes.clear();
    for (int i = 0; i <= kPairs; ++i) shapes.push_back(cs_sphere(r, std::to_string(i).c_str(), 1));
  };
  restart();
  int frames = 0;
  for (auto _ : state) {
    if (++frames % 200 == 0) {  // keeps the file from filling the disk
      state.PauseTiming();
      restart();
      state.ResumeTiming();
    }
    cs_begin_frame(r, 0.1 * frames);
    for (std::size_t i = 0; i < kPairs; ++i)
      cs_manifold(r, shapes[i], shapes[i + 1], contacts.normal.data(), -1,
                  contacts.points[i].data(), kPoints);
    cs_end_frame(r);
  }
  cs_stop(r);
  std::filesystem::remove(path);
  state.counters["ns_a_point"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * kPairs * kPoints * 1e-9,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

BENCHMARK_CAPTURE(record, float, true, false);
BENCHMARK_CAPTURE(record, double, true, true);
BENCHMARK_CAPTURE(record, not_started, false, false);

}  // namespace

BENCHMARK_MAIN();
