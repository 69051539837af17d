#include "app/studio.h"

#include "app/interrupt.h"
#include "draw/illustrate.h"
#include "gl/context.h"
#include "gl/rasterizer.h"
#include "overlay/panels.h"

namespace contactscope::app {

struct Studio::Impl {
  gl::Backend backend;
  Ledger& ledger;
  std::unique_ptr<gl::Context> context;
  std::unique_ptr<gl::Rasterizer> rasterizer;
  int width = 0, height = 0;

  gl::Rasterizer& canvas(int w, int h) {
    if (!context) {
      const Timed timed(ledger, "open OpenGL");
      context = gl::open_context(backend);
      ledger.note("OpenGL through " + context->route());
    }
    if (!rasterizer || w != width || h != height) {
      const Timed timed(ledger, "make a canvas");
      rasterizer = std::make_unique<gl::Rasterizer>(*context, w, h);
      width = w;
      height = h;
    }
    return *rasterizer;
  }
};

Studio::Studio(gl::Backend backend, Ledger& ledger)
    : impl_(new Impl{backend, ledger, nullptr, nullptr, 0, 0}) {}

Studio::~Studio() = default;

void Studio::render(const draw::Staging& staging, const std::vector<trace::Frame>& frames,
                    const std::vector<std::size_t>& which, const std::vector<double>& nanoseconds,
                    const std::function<void(std::size_t, Image)>& sink) {
  Ledger& ledger = impl_->ledger;
  const int width = staging.layout.width;
  const int height = staging.layout.height;
  gl::Rasterizer& canvas = impl_->canvas(width, height);

  // A fresh Dear ImGui for each sequence: its windows remember earlier frames.
  std::optional<overlay::PanelColumn> panels;
  if (!staging.view.panels.empty()) {
    const Timed timed(ledger, "start Dear ImGui");
    panels.emplace(staging, frames);
  }
  for (const std::size_t index : which) {
    stop_if_interrupted();
    draw::Drawing drawing;
    {
      const Timed timed(ledger, "illustrate");
      drawing = draw::illustrate(staging, frames[index]);
    }
    if (panels) {
      const Timed timed(ledger, "panels");
      draw::PanelMoment moment{index, {}};
      if (index < nanoseconds.size()) moment.pipeline_nanoseconds = nanoseconds[index];
      for (const std::string& what : panels->add(moment, drawing)) {
        ledger.left_out(staging.header->scenario + ": " + what + ", for " + std::to_string(width) +
                        "x" + std::to_string(height) + " has no room; a larger --size has");
      }
    }
    {
      const Timed timed(ledger, "paint");
      canvas.begin(drawing.background);
      canvas.paint(drawing);
    }
    Image image;
    {
      const Timed timed(ledger, "read back");
      image = canvas.read();
    }
    sink(index, std::move(image));
  }
}

Image Studio::paint(const draw::Drawing& drawing) {
  stop_if_interrupted();
  gl::Rasterizer& canvas = impl_->canvas(drawing.width, drawing.height);
  {
    const Timed timed(impl_->ledger, "paint");
    canvas.begin(drawing.background);
    canvas.paint(drawing);
  }
  const Timed timed(impl_->ledger, "read back");
  return canvas.read();
}

}  // namespace contactscope::app
