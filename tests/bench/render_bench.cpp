// Time per stage of a picture at 1280x720, and the pictures per second of `render`: pipeline,
// illustrate, paint and read back (llvmpipe paints only when the pixels are read), panels, encode.

#include <benchmark/benchmark.h>

#include <filesystem>

#include "app/cli/progress.h"
#include "app/render/renderer.h"
#include "draw/staging.h"
#include "gl/context.h"
#include "gl/rasterizer.h"
#include "image/png.h"
#include "overlay/panels.h"
#include "scenario/run.h"
#include "scenario/scenario.h"
#include "vector/svg.h"

namespace contactscope {
namespace {

constexpr int kWidth = 1280;
constexpr int kHeight = 720;

struct Prepared {
  Scenario scenario;
  trace::Header header = Runner(scenario).header();
  std::vector<trace::Frame> frames;
  draw::Staging staging;

  explicit Prepared(const char* name)
      : scenario(load_scenario(std::string(CONTACTSCOPE_SOURCE_DIR "/scenarios/") + name)),
        frames(run_all(scenario)),
        staging(staged(header, frames, scenario)) {}

 private:
  static std::vector<trace::Frame> run_all(const Scenario& scenario) {
    std::vector<trace::Frame> frames;
    Runner runner(scenario);
    for (int f = 0; f < scenario.frames; ++f) frames.push_back(runner.frame(f));
    return frames;
  }
  static draw::Staging staged(const trace::Header& header, const std::vector<trace::Frame>& frames,
                              const Scenario& scenario) {
    return draw::stage(header, frames, scenario.views.front(), kWidth, kHeight);
  }
};

const Prepared& prepared() {
  static const Prepared instance("hull/face_contact.toml");
  return instance;
}

// Ten thousand triangles; most of them hide others.
const Prepared& prepared_terrain() {
  static const Prepared instance("mesh/hull_on_terrain.toml");
  return instance;
}

void pipeline(benchmark::State& state) {
  const Runner start(prepared().scenario);
  Runner runner = start;
  int frame = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(runner.frame(frame));
    frame = (frame + 1) % prepared().scenario.frames;
    if (frame == 0) runner = start;
  }
}
BENCHMARK(pipeline)->Unit(benchmark::kMillisecond);

void illustrate(benchmark::State& state, const Prepared& (*scene)()) {
  std::size_t frame = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(draw::illustrate(scene().staging, scene().frames[frame]));
    frame = (frame + 1) % scene().frames.size();
  }
}
BENCHMARK_CAPTURE(illustrate, two_boxes, prepared)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(illustrate, ten_thousand_triangles, prepared_terrain)
    ->Unit(benchmark::kMillisecond);

void paint_and_read_back(benchmark::State& state) {
  const auto context = gl::open_context(gl::Backend::Auto);
  gl::Rasterizer canvas(*context, kWidth, kHeight);
  const draw::Drawing drawing = draw::illustrate(prepared().staging, prepared().frames.back());
  for (auto _ : state) {
    canvas.paint(drawing);
    benchmark::DoNotOptimize(canvas.read());
  }
}
BENCHMARK(paint_and_read_back)->Unit(benchmark::kMillisecond)->UseRealTime();

void panels(benchmark::State& state) {
  const auto context = gl::open_context(gl::Backend::Auto);
  gl::Rasterizer canvas(*context, kWidth, kHeight);
  overlay::PanelColumn column(prepared().staging, prepared().frames);
  for (auto _ : state) {
    draw::Drawing drawing;
    column.add({prepared().frames.size() - 1, {}}, drawing);
    canvas.paint(drawing);
  }
}
BENCHMARK(panels)->Unit(benchmark::kMillisecond)->UseRealTime();

// One picture of a sequence: an earlier picture has already made the font's subset.
void svg(benchmark::State& state, const Prepared& (*scene)()) {
  const draw::Drawing drawing = draw::illustrate(scene().staging, scene().frames.back());
  vector::FontFaces faces;
  std::size_t bytes = 0;
  for (auto _ : state) {
    const std::string text = vector::svg_of(drawing, {.fonts = &faces});
    bytes = text.size();
  }
  state.counters["kB"] = static_cast<double>(bytes) / 1000;
}
BENCHMARK_CAPTURE(svg, two_boxes, prepared)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(svg, ten_thousand_triangles, prepared_terrain)->Unit(benchmark::kMillisecond);

void svg_with_a_new_font(benchmark::State& state) {
  const draw::Drawing drawing = draw::illustrate(prepared().staging, prepared().frames.back());
  for (auto _ : state) benchmark::DoNotOptimize(vector::svg_of(drawing));
}
BENCHMARK(svg_with_a_new_font)->Unit(benchmark::kMillisecond);

void pdf(benchmark::State& state) {
  const draw::Drawing drawing = draw::illustrate(prepared().staging, prepared().frames.back());
  for (auto _ : state) benchmark::DoNotOptimize(vector::pdf_of(drawing));
}
BENCHMARK(pdf)->Unit(benchmark::kMillisecond);

Image picture() {
  Image result;
  app::RunLog log;
  app::Renderer renderer(gl::Backend::Auto, log);
  app::Sequence sequence{prepared().header, prepared().frames};
  renderer.render(prepared().staging, sequence, {sequence.frames.back().frame},
                  [&](const trace::Frame&, Image image) { result = std::move(image); });
  return result;
}

void encode(benchmark::State& state) {
  const Image image = picture();
  for (auto _ : state) benchmark::DoNotOptimize(encode_png(image));
}
BENCHMARK(encode)->Unit(benchmark::kMillisecond);

// All of `render` after its start: one sequence, written to files.
void pictures_a_second(benchmark::State& state) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / "contactscope_render_bench";
  std::filesystem::create_directories(folder);
  app::RunLog log;
  app::Renderer renderer(gl::Backend::Auto, log);
  app::Sequence sequence{prepared().header, prepared().frames};
  const std::vector<int> numbers = mapped(sequence.frames, &trace::Frame::frame);
  for (auto _ : state) {
    app::EncoderPool encoders(0);
    renderer.render(prepared().staging, sequence, numbers,
                    [&](const trace::Frame& frame, Image image) {
                      encoders.submit((folder / (std::to_string(frame.frame) + ".png")).string(),
                                      std::move(image));
                    });
    encoders.finish();
  }
  state.counters["pictures"] = benchmark::Counter(
      static_cast<double>(state.iterations()) * static_cast<double>(numbers.size()),
      benchmark::Counter::kIsRate);
  std::filesystem::remove_all(folder);
}
BENCHMARK(pictures_a_second)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace contactscope

BENCHMARK_MAIN();
