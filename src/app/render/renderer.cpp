#include "app/render/renderer.h"

#include "overlay/panels.h"
#include "scenario/run.h"

namespace contactscope::app {
namespace {

// Pipeline time without recording: the minimum of several runs of a runner's next frame.
double measure(const Runner& before, int frame) {
  constexpr int kRuns = 25;
  double best = std::numeric_limits<double>::max();
  for (int i = 0; i < kRuns; ++i) {
    Runner runner = before;
    const auto begin = std::chrono::steady_clock::now();
    runner.frame_unrecorded(frame);
    const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - begin;
    best = std::min(best, time.count());
  }
  return best;
}

struct TimedDrawing {
  draw::Drawing drawing;
  std::chrono::nanoseconds time;
};

template <class Draw> TimedDrawing timed_drawing(const Draw& draw) {
  const auto begin = std::chrono::steady_clock::now();
  draw::Drawing drawing = draw();
  return {std::move(drawing), std::chrono::steady_clock::now() - begin};
}

}  // namespace

Sequence run_sequence(const Scenario& scenario, const trace::Stages& stages, bool timing,
                      RunLog& log) {
  const Timed timed(log, "pipeline");
  Sequence sequence;
  Runner runner(scenario, stages);
  sequence.header = runner.header();
  for (int frame = 0; frame < scenario.frames; ++frame) {
    if (timing) sequence.nanoseconds.push_back(measure(runner, frame));
    sequence.frames.push_back(runner.frame(frame));
  }
  return sequence;
}

std::optional<draw::FittedFrames> fitted_frames(Sequence& sequence,
                                                const std::vector<int>& numbers) {
  if (sequence.numbers.empty()) return std::nullopt;
  constexpr std::size_t kMax = 16;  // frames of a heap are large
  std::vector<int> chosen = numbers;
  if (chosen.size() > kMax) {
    chosen.clear();
    for (std::size_t i = 0; i < kMax; ++i)
      chosen.push_back(numbers[i * (numbers.size() - 1) / (kMax - 1)]);
  }
  draw::FittedFrames fitted{{}, chosen.size() == numbers.size()};
  sequence.each(chosen,
                [&](std::size_t index) { fitted.frames.push_back(sequence.frames[index]); });
  return fitted;
}

gl::Context& Renderer::context() {
  if (!context_) {
    const Timed timed(log_, "open OpenGL");
    context_ = gl::open_context(backend_);
    log_.note("OpenGL through " + context_->route());
  }
  return *context_;
}

gl::Rasterizer& Renderer::canvas(int width, int height) {
  gl::Context& open = context();
  if (!rasterizer_ || width != width_ || height != height_) {
    const Timed timed(log_, "make a canvas");
    rasterizer_ = std::make_unique<gl::Rasterizer>(open, width, height);
    width_ = width;
    height_ = height;
  }
  return *rasterizer_;
}

void Renderer::each_drawing(const draw::Staging& staging, Sequence& sequence,
                            const std::vector<int>& numbers,
                            const std::function<void(const trace::Frame&, draw::Drawing)>& sink) {
  const int width = staging.layout.width;
  const int height = staging.layout.height;
  // New Dear ImGui windows for each sequence, because they remember earlier frames.
  std::optional<overlay::PanelColumn> panels;
  const auto start_panels = [&] {
    if (staging.view.panels.empty()) return;
    if (panels) return panels->renew(staging, sequence.frames);
    const Timed timed(log_, "start Dear ImGui");
    panels.emplace(staging, sequence.frames);
  };
  std::optional<draw::Drawing> shown;  // of a long trace: the drawing of the last frame
  // Draws the panels meanwhile.
  const auto complete = [&](std::size_t index, std::future<TimedDrawing>& next) {
    draw::Drawing column;
    if (panels) {
      const Timed timed(log_, "panels");
      draw::PanelMoment moment{index, sequence.recent(sequence.frames[index].frame - 1)};
      if (index < sequence.nanoseconds.size())
        moment.pipeline_nanoseconds = sequence.nanoseconds[index];
      for (const std::string& what : panels->add(moment, column)) {
        log_.left_out(staging.header->scenario + ": " + what + ", because " +
                      std::to_string(width) + "x" + std::to_string(height) +
                      " has no room for it; use a larger --size");
      }
    }
    TimedDrawing drawn = next.get();
    log_.add("illustrate", drawn.time);
    drawn.drawing.append(column);
    finish(staging.style, drawn.drawing);
    return std::move(drawn.drawing);
  };

  if (sequence.file) {
    // Paints each frame while another thread draws the next one.
    const auto sink_last = [&] {
      if (shown) sink(*sequence.last, std::move(*shown));
    };
    const auto show = [&](std::size_t index) {
      stop_if_interrupted();
      const trace::Frame& frame = sequence.frames[index];
      std::future<TimedDrawing> next = std::async(std::launch::async, [&] {
        return timed_drawing([&] {
          return staging.cells
                     ? draw::illustrate(draw::stage(sequence.header, sequence.frames, staging.view,
                                                    width, height, staging.style),
                                        frame)
                     : draw::illustrate(staging, frame);
        });
      });
      sink_last();
      // The frame was read just now, so panels that scanned all frames have not seen it.
      start_panels();
      shown = complete(index, next);
    };
    sequence.each(numbers, show, staging.view.shows(Panel::Worst));
    sink_last();
    return;
  }
  start_panels();
  std::vector<std::size_t> places;
  sequence.each(numbers, [&](std::size_t index) { places.push_back(index); });
  // Draws each frame while the previous one is painted and read back, which leaves a core idle.
  const auto begin = [&](std::size_t i) {
    return std::async(i == 0 ? std::launch::deferred : std::launch::async, [&, i] {
      return timed_drawing([&] { return draw::illustrate(staging, sequence.frames[places[i]]); });
    });
  };
  std::future<TimedDrawing> next;
  if (!places.empty()) next = begin(0);
  for (std::size_t i = 0; i < places.size(); ++i) {
    stop_if_interrupted();
    draw::Drawing drawing = complete(places[i], next);
    if (i + 1 < places.size()) next = begin(i + 1);
    sink(sequence.frames[places[i]], std::move(drawing));
  }
}

void Renderer::render(const draw::Staging& staging, Sequence& sequence,
                      const std::vector<int>& numbers,
                      const std::function<void(const trace::Frame&, Image)>& sink) {
  open(staging.layout.width, staging.layout.height);
  each_drawing(staging, sequence, numbers, [&](const trace::Frame& frame, draw::Drawing drawing) {
    sink(frame, paint(drawing));
  });
}

void Renderer::finish(const draw::FigureStyle& style, draw::Drawing& drawing) {
  draw::finish(style, drawing);
  missing_glyphs_.look(drawing);
}

Image Renderer::paint(const draw::Drawing& drawing) {
  stop_if_interrupted();
  gl::Rasterizer& rasterizer = canvas(drawing.width, drawing.height);
  {
    const Timed timed(log_, "paint");
    rasterizer.paint(drawing);
  }
  const Timed timed(log_, "read back");
  return rasterizer.read();
}

}  // namespace contactscope::app
