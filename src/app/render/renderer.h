#pragma once

#include <deque>
#include <future>

#include "app/cli/progress.h"
#include "app/cli/sequence.h"
#include "app/cli/verbs.h"
#include "draw/staging.h"
#include "gl/rasterizer.h"
#include "image/png.h"
#include "scenario/scenario.h"

namespace contactscope::app {

/// Runs the pipeline over all frames and records `stages`.
Sequence run_sequence(const Scenario& scenario, const trace::Stages& stages, bool timing,
                      RunLog& log);

/// Frames for fitting the camera of a trace: those that are drawn, at most a sample of them. Nothing
/// for a scenario.
std::optional<draw::FittedFrames> fitted_frames(Sequence& sequence,
                                                const std::vector<int>& numbers);

/// Turns drawings into pictures. OpenGL is opened with the first picture, so a run without pictures
/// does not need it.
class Renderer {
 public:
  Renderer(gl::Backend backend, RunLog& log) : backend_(backend), log_(log) {}

  /// Opens OpenGL early for pictures of this size, so that a machine without it fails before any
  /// work.
  void open(int width, int height) { canvas(width, height); }

  /// Draws the given frames of a staged sequence, with panels, and passes each drawing to `sink`.
  /// Opens no OpenGL, but Dear ImGui for panels. The summary panel shows measured pipeline times.
  /// If the sequence is all in memory, another thread draws the next frame meanwhile; `sink` is
  /// always called on the caller's thread.
  void each_drawing(const draw::Staging& staging, Sequence& sequence,
                    const std::vector<int>& numbers,
                    const std::function<void(const trace::Frame&, draw::Drawing)>& sink);

  /// each_drawing(), then paints each drawing.
  void render(const draw::Staging& staging, Sequence& sequence, const std::vector<int>& numbers,
              const std::function<void(const trace::Frame&, Image)>& sink);

  /// Applies the remaining settings of a style to a complete drawing.
  void finish(const draw::FigureStyle& style, draw::Drawing& drawing);
  /// Characters without a glyph in all drawings so far.
  const MissingGlyphs& missing_glyphs() const { return missing_glyphs_; }

  /// Paints one drawing in its own size.
  Image paint(const draw::Drawing& drawing);

 private:
  gl::Context& context();
  gl::Rasterizer& canvas(int width, int height);

  gl::Backend backend_;
  RunLog& log_;
  MissingGlyphs missing_glyphs_;
  std::unique_ptr<gl::Context> context_;
  std::unique_ptr<gl::Rasterizer> rasterizer_;
  int width_ = 0, height_ = 0;  // of the rasterizer
};

/// Writes files on its own threads while the caller renders the next picture. Pictures never queue,
/// so memory stays small if encoding is slower. The destructor waits for running tasks but drops
/// errors; call finish() first.
class EncoderPool {
 public:
  /// `jobs` threads; 0: one less than the number of processors, at least one.
  explicit EncoderPool(int jobs)
      : threads_(jobs > 0
                     ? jobs
                     : std::max(1, static_cast<int>(std::thread::hardware_concurrency()) - 1)) {}

  /// Starts writing a picture; blocks while all threads are busy. Throws the error of an earlier
  /// picture.
  void submit(std::string path, Image image) {
    submit([path = std::move(path), image = std::move(image)] { write_png(path, image); });
  }
  /// Runs `write` for a file of any format.
  void submit(std::function<void()> write) {
    if (count_of(running_) == threads_) wait_for_first();
    auto timed = [write = std::move(write)] {
      const auto begin = std::chrono::steady_clock::now();
      write();
      return std::chrono::steady_clock::now() - begin;
    };
    running_.push_back(std::async(std::launch::async, std::move(timed)));
  }
  /// Waits until all is written. Throws the first error.
  void finish() {
    while (!running_.empty()) wait_for_first();
  }
  /// Total encoding and writing time of all threads for finished pictures.
  std::chrono::nanoseconds busy() const { return busy_; }
  int threads() const { return threads_; }

 private:
  void wait_for_first() {
    std::future<std::chrono::nanoseconds> first = std::move(running_.front());
    running_.pop_front();
    busy_ += first.get();
  }

  int threads_;
  std::deque<std::future<std::chrono::nanoseconds>> running_;
  std::chrono::nanoseconds busy_{};
};

}  // namespace contactscope::app
