#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "app/trace_file.h"
#include "trace/trace.h"

namespace contactscope::app {

/// The frames that pictures are of, with what they have in common: of a scenario all; of a trace that is too long to be
/// held, some, which stand for the others where a camera is fitted or a curve is drawn.
struct Sequence {
  trace::Header header;
  std::vector<trace::Frame> frames;  // those that are held, one of each `every`
  std::vector<double>
      nanoseconds{};           // measured pipeline time of each frame; empty unless asked for
  std::vector<int> numbers{};  // of a trace: those of all frames, in order
  std::size_t every = 1;
  std::shared_ptr<TraceFile> file{};  // of a long one: where the others are read from
  std::function<void(trace::Frame&)>
      trim{};  // what --pair and --shapes leave of one, where they leave out any

  /// Shows each frame that is named, `numbers` rising: with its place among those that are held, where it stands in
  /// for the held one as long as it is shown. Throws InputError.
  void each(const std::vector<int>& wanted, const std::function<void(std::size_t)>& show);
};

/// How much of a trace is wanted at once.
enum class Hold {
  Whole,
  Sample,  // what fits, of a long one
};

/// A trace as a sequence. Of a long one those frames are held that are as much text as `budget` says, in bytes: the
/// first, the last, and of each so many between them the one with the deepest overlap, so that no curve loses its
/// peaks. Points of engines that tell no ids get some that are made up from geometry. Torn files are told of. Throws
/// InputError.
Sequence read_sequence(const std::string& path, Hold hold, std::size_t budget = 16 << 20);

}  // namespace contactscope::app
