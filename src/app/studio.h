#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "app/ledger.h"
#include "app/options.h"
#include "draw/scene/drawing.h"
#include "draw/staging.h"
#include "gl/rasterizer.h"
#include "image/image.h"
#include "trace/trace.h"

namespace contactscope::app {

/// Turns sequences into pictures. OpenGL is opened with the first picture, Dear ImGui with the
/// first view that has panels, so that a run without pictures opens neither.
class Studio {
 public:
  Studio(gl::Backend backend, Ledger& ledger) : backend_(backend), ledger_(ledger) {}

  /// Renders the frames of a staged sequence whose indices are given and hands each picture to
  /// `sink` with its index. `nanoseconds` holds measured pipeline times for the summary panel, one
  /// a frame, or is empty.
  void render(const draw::Staging& staging, const std::vector<trace::Frame>& frames,
              const std::vector<std::size_t>& which, const std::vector<double>& nanoseconds,
              const std::function<void(std::size_t, Image)>& sink);

  /// A drawing by itself, as large as it says.
  Image paint(const draw::Drawing& drawing);

 private:
  gl::Rasterizer& canvas(int width, int height);

  gl::Backend backend_;
  Ledger& ledger_;
  std::unique_ptr<gl::Context> context_;
  std::unique_ptr<gl::Rasterizer> rasterizer_;
  int width_ = 0, height_ = 0;  // of the rasterizer
};

}  // namespace contactscope::app
