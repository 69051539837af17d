#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "snapshot/stage.h"
#include "trace/read_trace.h"

/// Two runs of one scene: by two versions of an engine, on two machines, in two scalars.
namespace contactscope::snapshot {

/// The first difference of two runs that is more than rounding.
struct Parting {
  int frame = -1;         // number; -1: the headers differ
  std::string subject{};  // "crate-floor", or a shape; empty: the whole frame
  std::string a{}, b{};   // the shapes of a pair; empty for other subjects
  Stage stage = Stage::Setup;
  std::string what{};                    // "point 2 moved 1.3 mm along x"
  std::string chain{};                   // the same, and what followed
  std::array<trace::Frame, 2> frames{};  // of both runs; as they were read
};

/// How far two runs are from each other in a frame.
struct RunDistance {
  int frame = 0;
  double time = 0;      // seconds
  double metres = 0;    // largest displacement of a corner of a shape's box
  std::string shape{};  // whose
};

struct RunComparison {
  std::array<trace::Header, 2> headers{};  // with the shapes of all frames that were read
  std::vector<std::string>
      notes{};  // differences that no run need differ by: "scalar float -> double"
  std::optional<Parting> parting{};
  std::vector<RunDistance> distances{};  // of the frames in both
  int equal = 0;                         // frames with the same text, of these
  std::optional<int> rounding{};         // the first frame that differs by rounding alone
  std::array<int, 2> alone{};            // frames that only one of them has
};

/// Compares frame by frame. Frames match by number, shapes by name, pairs by their shapes in any
/// order; the order of a frame's shapes and pairs does not count. Numbers compare within the
/// rounding of the coarser scalar, as compare_traces() says. Frames with the same text are not
/// parsed; after the parting and the frames in which its consequences are looked for, only poses
/// are. Memory does not depend on the number of frames, but for `distances`. Throws InputError.
RunComparison compare_runs(trace::TraceReader& a, trace::TraceReader& b, Workers& workers);

}  // namespace contactscope::snapshot
