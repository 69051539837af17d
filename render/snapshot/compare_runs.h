#pragma once

#include "snapshot/compare_trace.h"
#include "trace/read_trace.h"

/// Two runs of one scene: by two versions of an engine, on two machines, in two scalars.
namespace contactscope::snapshot {

/// How far two runs are from each other in a frame.
struct RunDistance {
  int frame = 0;
  double time = 0;      // seconds
  double metres = 0;    // largest displacement of a shape's origin
  std::string shape{};  // whose
};

struct RunComparison {
  std::vector<std::string> notes{};      // words of the headers: "scalar float -> double"
  std::optional<Parting> header{};       // the first difference of the headers
  std::optional<Parting> setting{};      // that of the solver's settings, if frames begin with it
  std::optional<Parting> parting{};      // that of other facts of frames; rounding is none
  std::size_t more_pairs = 0;            // that differ in its frame
  std::string a{}, b{};                  // its shapes, if it is in a pair
  std::array<trace::Frame, 2> frames{};  // of both runs there; numbers within rounding are equal
  std::vector<RunDistance> distances{};  // of the frames in both
  int equal = 0;                         // of these, frames with the same text
  std::optional<int> rounding{};         // the first one that differs by rounding alone
  std::array<int, 2> alone{};            // frames that only one of them has

  bool differ() const { return header || setting || parting; }
};

/// Compares frame by frame. Frames match by number, shapes by name, pairs by their shapes in any
/// order; the order of a frame's shapes and pairs does not count. Numbers compare within the
/// rounding of the coarser scalar. Frames with the same text are not parsed; after the parting and
/// the frames in which its consequences are looked for, only poses are. Memory does not depend on
/// the number of frames, but for `distances`. Of several pairs that differ in the stage of the
/// parting, it names the one that differs most. Throws InputError.
RunComparison compare_runs(trace::TraceReader& a, trace::TraceReader& b, Workers& workers);

}  // namespace contactscope::snapshot
