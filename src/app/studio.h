#pragma once

#include <algorithm>
#include <chrono>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/progress.h"
#include "app/sequence.h"
#include "app/verbs.h"
#include "core/at.h"
#include "draw/scene/drawing.h"
#include "draw/staging.h"
#include "gl/rasterizer.h"
#include "image/image.h"
#include "image/png.h"
#include "scenario/scenario.h"
#include "trace/trace.h"

namespace contactscope::app {

/// Runs the pipeline over all frames and records `stages`.
Sequence run_sequence(const Scenario& scenario, const trace::Stages& stages, bool timing,
                      Ledger& ledger);

/// Turns drawings into pictures. OpenGL is opened with the first one, so that a run without
/// pictures does not.
class Studio {
 public:
  Studio(gl::Backend backend, Ledger& ledger) : backend_(backend), ledger_(ledger) {}

  /// Opens OpenGL for pictures of this size, which the first of them would do otherwise: a machine
  /// without it says so before anything is made.
  void open(int width, int height) { canvas(width, height); }

  /// Which route, driver and version draw; opens OpenGL.
  std::string driver();

  /// The first half of pictures: draws the frames of a staged sequence whose numbers are given, panels
  /// included, and hands each drawing to `sink`. Opens no OpenGL; Dear ImGui where the view has panels.
  /// Measured pipeline times go to the summary panel. Of a sequence that is held whole another thread draws the
  /// next frame while `sink` has this one; `sink` is always called in the caller's.
  void each_drawing(const draw::Staging& staging, Sequence& sequence,
                    const std::vector<int>& numbers,
                    const std::function<void(const trace::Frame&, draw::Drawing)>& sink);

  /// Both halves: each_drawing(), and each of them painted.
  void render(const draw::Staging& staging, Sequence& sequence, const std::vector<int>& numbers,
              const std::function<void(const trace::Frame&, Image)>& sink);

  /// Does what a style leaves to do with a complete drawing.
  void finish(const draw::FigureStyle& style, draw::Drawing& drawing);
  /// Characters of all drawings so far that no font has.
  const MissingGlyphs& missing_glyphs() const { return missing_glyphs_; }

  /// A drawing by itself, as large as it says.
  Image paint(const draw::Drawing& drawing);

 private:
  gl::Context& context();
  gl::Rasterizer& canvas(int width, int height);

  gl::Backend backend_;
  Ledger& ledger_;
  MissingGlyphs missing_glyphs_;
  std::unique_ptr<gl::Context> context_;
  std::unique_ptr<gl::Rasterizer> rasterizer_;
  int width_ = 0, height_ = 0;  // of the rasterizer
};

/// Writes files on threads of its own, while the caller renders the next picture. No picture waits
/// for a thread, so that memory stays small when encoding is the slower part. Its end waits for what
/// is under way; errors are lost there, so call finish() first.
class EncoderPool {
 public:
  /// `jobs` threads; 0 means one less than there are processors, at least one.
  explicit EncoderPool(int jobs)
      : threads_(jobs > 0
                     ? jobs
                     : std::max(1, static_cast<int>(std::thread::hardware_concurrency()) - 1)) {}

  /// Begins to write a picture; blocks while every thread has one. Throws the error of an earlier
  /// picture.
  void submit(std::string path, Image image) {
    submit([path = std::move(path), image = std::move(image)] { write_png(path, image); });
  }
  /// The same of a file of any format, that `write` makes.
  void submit(std::function<void()> write) {
    if (count_of(under_way_) == threads_) wait_for_first();
    auto timed = [write = std::move(write)] {
      const auto begin = std::chrono::steady_clock::now();
      write();
      return std::chrono::steady_clock::now() - begin;
    };
    under_way_.push_back(std::async(std::launch::async, std::move(timed)));
  }
  /// Waits until all is written. Throws the first error.
  void finish() {
    while (!under_way_.empty()) wait_for_first();
  }
  /// Time that the threads spent encoding and writing, summed over the pictures that are finished.
  std::chrono::nanoseconds busy() const { return busy_; }
  int threads() const { return threads_; }

 private:
  void wait_for_first() {
    std::future<std::chrono::nanoseconds> first = std::move(under_way_.front());
    under_way_.pop_front();
    busy_ += first.get();
  }

  int threads_;
  std::deque<std::future<std::chrono::nanoseconds>> under_way_;
  std::chrono::nanoseconds busy_{};
};

}  // namespace contactscope::app
