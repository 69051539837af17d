// Time of a step of ten thousand bodies at rest on one core: two thousand stacks of five crates on
// a floor. `awake` is before they sleep, and the cost of every step without sleeping; `asleep` is
// after that; `one_awake` keeps one of the stacks awake.

#include <benchmark/benchmark.h>

#include <string>

#include "scenario/run.h"

namespace contactscope {
namespace {

constexpr int kSide = 50, kRows = 40, kHigh = 5;
constexpr int kSettled = 240;  // frames until they sleep, if they may

std::string crate(const std::string& name, double x, double y, double z, const std::string& more) {
  const auto number = [](double value) { return std::to_string(value); };
  return "[shapes." + name + "]\ntype = \"box\"\nhalf_extents = [0.5, 0.5, 0.5]\nposition = [" +
         number(x) + ", " + number(y) + ", " + number(z) +
         "]\nmotion = { dynamic = true, mass = 1" + more + " }\n";
}

/// With `spins`, a ball spins in place on top of the first stack, where nothing brakes it.
Scenario stacks(bool may_sleep, bool spins) {
  std::string text =
      "title = \"Ten thousand at rest\"\n[time]\nframes = 100000\n[world]\nbroad_phase = \"tree\"\n"
      "[solver]\nsubsteps = 4\n" +
      std::string(may_sleep ? "sleep_after = 0.5\n" : "") +
      "[shapes.floor]\ntype = \"plane\"\nnormal = [0, 1, 0]\noffset = 0\n";
  for (int i = 0; i < kSide * kRows; ++i)
    for (int k = 0; k < kHigh; ++k)
      text += crate("crate_" + std::to_string(i) + "_" + std::to_string(k), 2.0 * (i % kSide),
                    0.5 + k, 2.0 * (i / kSide), "");
  if (spins)
    text +=
        "[shapes.top]\ntype = \"sphere\"\nradius = 0.3\nposition = [0, 5.3, 0]\nfriction = 0\n"
        "motion = { dynamic = true, mass = 1, angular_velocity = [0, 9, 0] }\n";
  return parse_scenario(text, "bench/rest.toml");
}

void step(benchmark::State& state, bool may_sleep, bool spins, int from) {
  const Scenario scenario = stacks(may_sleep, spins);
  Runner runner(scenario, trace::Stages::none());
  runner.frame_unrecorded(from);
  int frame = from;
  for (auto _ : state) runner.advance(++frame);
  const trace::Frame last = runner.frame(frame + 1);
  double asleep = 0;
  for (const trace::Body& body : last.solver->bodies) asleep += body.asleep == true;
  state.counters["bodies"] = static_cast<double>(last.solver->bodies.size());
  state.counters["asleep"] = asleep;
}
BENCHMARK_CAPTURE(step, awake, false, false, 10)->Unit(benchmark::kMillisecond)->Iterations(20);
BENCHMARK_CAPTURE(step, asleep, true, false, kSettled)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(500);
BENCHMARK_CAPTURE(step, one_awake, true, true, kSettled)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(500);

}  // namespace
}  // namespace contactscope

BENCHMARK_MAIN();
