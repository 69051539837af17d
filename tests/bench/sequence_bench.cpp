// Cost of a picture in a long sequence, or in a scene of many pairs: boxes in rows on a floor.
// `stage` covers a whole sequence, and its counter is the time per frame. `illustrate` and
// `picture` cover one frame; neither may grow with the number of others.

#include <benchmark/benchmark.h>

#include <cmath>

#include "app/cli/progress.h"
#include "app/render/renderer.h"
#include "draw/staging.h"

namespace contactscope {
namespace {

constexpr int kWidth = 1280;
constexpr int kHeight = 720;

trace::Shape box(const std::string& name, const Vec3d& h) {
  trace::Shape shape;
  shape.name = name;
  shape.type = "box";
  for (int i = 0; i < 8; ++i) {
    shape.vertices.emplace_back((i & 1) != 0 ? h.x() : -h.x(), (i & 2) != 0 ? h.y() : -h.y(),
                                (i & 4) != 0 ? h.z() : -h.z());
  }
  shape.faces = {{1, 3, 7, 5}, {0, 4, 6, 2}, {2, 6, 7, 3},
                 {0, 1, 5, 4}, {4, 5, 7, 6}, {0, 2, 3, 1}};
  return shape;
}

trace::Pair pair_on_floor(const std::string& name, const Vec3d& at) {
  trace::Pair pair;
  pair.a = "floor";
  pair.b = name;
  pair.kind = "hull-hull";
  pair.state = "touching";
  pair.separation = -0.005;
  trace::Manifold manifold;
  manifold.normal = Vec3d::UnitY();
  manifold.axis = "face_a";
  manifold.type = "face-face";
  for (const auto& [x, z] : {std::pair{-0.4, -0.4}, {0.4, -0.4}, {0.4, 0.4}, {-0.4, 0.4}}) {
    trace::Point point;
    point.position = {at.x() + x, 0, at.z() + z};
    point.separation = -0.005;
    point.id = "b:e0 b:e1";
    point.impulse = trace::Impulse{1.0, {0.1, 0, 0}, 0.9};
    manifold.points.push_back(point);
  }
  pair.manifolds = {manifold};
  return pair;
}

/// A row of boxes that slide over a floor for a number of frames.
struct Boxes {
  trace::Header header;
  std::vector<trace::Frame> frames;
  View view;

  Boxes(int pairs, int count) {
    const int side = static_cast<int>(std::ceil(std::sqrt(pairs)));
    header.title = "Boxes on a floor";
    header.up = "y";
    header.frames = count;
    header.shapes = {box("floor", {1.0 * side, 0.2, 1.0 * side})};
    for (int i = 0; i < pairs; ++i)
      header.shapes.push_back(box("box_" + std::to_string(i), {0.4, 0.4, 0.4}));
    for (int f = 0; f < count; ++f) frames.push_back(frame(f, pairs, side));
    view.layers = {Layer::Shapes, Layer::Contacts, Layer::Normals, Layer::Impulses,
                   Layer::Velocities};
    view.panels = {Panel::Summary, Panel::Plots};
  }

 private:
  trace::Frame frame(int f, int pairs, int side) const {
    trace::Frame frame;
    frame.frame = f;
    frame.time = f / 60.0;
    Pose<double> floor;
    floor.position = {0, -0.2, 0};
    frame.poses = {{"floor", floor}};
    trace::Solver& solver = frame.solver.emplace();
    for (int i = 0; i < pairs; ++i) {
      Pose<double> pose;
      pose.position = {2.0 * (i % side) - side + 0.3 * std::sin(0.01 * f), 0.395,
                       2.0 * (i / side) - side};
      const std::string& name = header.shapes[static_cast<std::size_t>(i) + 1].name;
      frame.poses.emplace_back(name, pose);
      frame.pairs.push_back(pair_on_floor(name, pose.position));
      trace::Body& body = solver.bodies.emplace_back();
      body.name = name;
      body.mass = 1;
      body.center_of_mass = pose.position;
      body.velocity = {0.18 * std::cos(0.01 * f), 0, 0};
    }
    return frame;
  }
};

Boxes boxes_of(const benchmark::State& state) {
  return {static_cast<int>(state.range(0)), static_cast<int>(state.range(1))};
}

draw::Staging staged(const Boxes& boxes) {
  return draw::stage(boxes.header, boxes.frames, boxes.view, kWidth, kHeight);
}

void sizes(benchmark::internal::Benchmark* bench) {
  for (const int frames : {1, 120, 1000, 4000}) bench->Args({12, frames});
  for (const int frames : {1, 120, 1000}) bench->Args({400, frames});
  bench->ArgNames({"pairs", "frames"})->Unit(benchmark::kMillisecond)->UseRealTime();
}

void stage(benchmark::State& state) {
  const Boxes boxes = boxes_of(state);
  for (auto _ : state) benchmark::DoNotOptimize(staged(boxes));
  state.counters["seconds_a_frame"] =
      benchmark::Counter(static_cast<double>(state.iterations() * state.range(1)),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(stage)->Apply(sizes);

void illustrate(benchmark::State& state) {
  const Boxes boxes = boxes_of(state);
  const draw::Staging staging = staged(boxes);
  for (auto _ : state) benchmark::DoNotOptimize(draw::illustrate(staging, boxes.frames.back()));
}
BENCHMARK(illustrate)->Apply(sizes);

// With panels, painted and read back.
void picture(benchmark::State& state) {
  const Boxes boxes = boxes_of(state);
  const draw::Staging staging = staged(boxes);
  app::RunLog log;
  app::Renderer renderer(gl::Backend::Auto, log);
  app::Sequence sequence{boxes.header, boxes.frames};
  const std::vector<int> last = {sequence.frames.back().frame};
  for (auto _ : state) {
    renderer.render(staging, sequence, last, [](const trace::Frame&, const Image& image) {
      benchmark::DoNotOptimize(image.rgb.data());
    });
  }
}
BENCHMARK(picture)->Apply(sizes);

}  // namespace
}  // namespace contactscope

BENCHMARK_MAIN();
