#pragma once

#include "app/cli/trace_file.h"
#include "view/view.h"

namespace contactscope::app {

/// Frames to draw and their common data. A scenario keeps all frames; a trace too long for memory
/// keeps a sample that represents the others for camera fitting and curves.
struct Sequence {
  trace::Header header;
  std::vector<trace::Frame> frames;   // in memory, one of each `every`
  std::vector<double> nanoseconds{};  // measured pipeline time per frame; empty unless requested
  std::vector<int> numbers{};         // for a trace: numbers of all frames, in order
  std::string path{};                 // of a trace's file
  std::size_t every = 1;
  bool ids_are_made = false;          // see trace::name_points()
  std::shared_ptr<TraceFile> file{};  // for a long trace: source of the other frames
  std::function<void(trace::Frame&)>
      trim{};  // applies --pair and --shapes to a frame; empty without them
  /// During each(), of a long trace: the frame that was shown last, and one read before the shown
  /// one.
  std::optional<trace::Frame> last{}, before{};
  /// One of these two by its number; nullptr if it is neither.
  const trace::Frame* recent(int number) const;

  /// A pair in every frame of a long trace; empty for others. Throws InputError.
  PairHistory history(const std::string& a, const std::string& b) const;

  /// Shows each frame of `wanted` (increasing) by its index in `frames`. A frame that is not in
  /// memory temporarily replaces the sampled one. `with_before`: reads also the frame before each.
  /// Throws InputError.
  void each(const std::vector<int>& wanted, const std::function<void(std::size_t)>& show,
            bool with_before = false);
};

/// Amount of a trace to keep in memory.
enum class Hold {
  Whole,
  Sample,  // a sample of a long trace
};

/// Reads a trace. A long one is sampled to `budget` bytes of text: the first and last frame, and
/// from each interval between them the frame with the deepest overlap, so that curves keep their
/// peaks. Points without engine ids get ids from geometry. Truncated files are reported. Throws
/// InputError.
Sequence read_sequence(const std::string& path, Hold hold, std::size_t budget = 16 << 20);

}  // namespace contactscope::app
