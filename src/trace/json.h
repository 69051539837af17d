#pragma once

#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "trace/trace.h"

namespace contactscope::trace {

/// First words of every header line; a reader refuses any other.
inline constexpr const char* kSchema = "contactscope.trace/1";

/// One line of JSON without the newline, as FORMATS.md, "Trace", lays it out; keys in that order.
/// Numbers read back to the same double, -0.0 too. JSON has no spelling for nan and infinity: they
/// throw std::domain_error that names the key.
///
/// Beyond FORMATS.md: the header has "title", "source" and, for each shape, "type", "vertices",
/// "faces" (vertex indices, counter-clockwise from outside), "edges" (two vertex indices; ids such
/// as "a:e3" count in this list) and "center_of_mass", in its local frame. A pair has "label" where
/// one is set. The axes in "sat" have "normal" (from a to b), face axes the "support" vertex of the
/// other shape, edge axes the closest points "point_a" and "point_b"; "sat" has "preference".
/// "reduction" has "best", the points that span the best area, and where the method chooses step by
/// step "choices", one a kept point: the "rule", the "direction" of a support point, and what each
/// candidate was worth ("measures": "point", the "edge" it was held against, "value"). Contact
/// points have an "impulse" where the solver gave one; "sat" has "edge_pairs" where all crossing
/// pairs were recorded; "penetration", "minkowski", "incremental" and "stability" of a pair and
/// "solver" of a frame are laid out as trace.h declares them, in its order and by its names, with
/// the bodies of a solver by name and a persistent point's own keys among those of its point.
std::string to_json_line(const Header& header);
std::string to_json_line(const Frame& frame);

/// A whole trace.
struct Trace {
  Header header;
  std::vector<Frame> frames;
};

/// Reads JSON lines back. `name` is the file's name for messages. Throws core's InputError with
/// line and column when a line is no JSON, the schema differs, a key is missing or has the wrong
/// type, or an index points nowhere; for anything but broken JSON the message names the place in
/// the line and the column is 1. Keys that are not known are passed over, so that traces of other
/// engines may carry more; the keys beyond FORMATS.md may be missing (then empty or zero, and a
/// shape's edges come from its faces). Lines of white space are skipped.
Trace read_trace(std::istream& in, const std::string& name);

}  // namespace contactscope::trace
