#pragma once

#include "lint/claims.h"
#include "trace/json.h"

/// An engine is a program `contactscope-engine-NAME`: it reads a trace without contacts and writes
/// the same frames with its contacts. See src/versus/README.md.
namespace contactscope::versus {

/// Keeps the pairs to query engines for: the first of several with different settings of this
/// program, and no pair with a query other than for contacts.
void keep_queried_pairs(trace::Frame& frame);

/// A request to an engine: the shapes, poses and pairs of a trace without contacts.
trace::Trace request_of(const trace::Trace& whole);

/// This program's contacts for a request, in double with default settings.
trace::Trace own_contacts(const trace::Trace& request);

/// As JSON lines.
std::string to_text(const trace::Trace& trace);

/// Ground truth of a pair in a frame, independent of engines.
struct Truth {
  std::string a, b;
  /// Metres between the shapes, negative: least overlap. Empty if unknown, as for two meshes.
  std::optional<double> separation;
  double tolerance = 0;  // metres: within it of touching, either answer is right
  /// Contact patch of two convex shapes before reduction, m^2; 0 for a point or a line.
  double area = 0;
  bool touches() const { return separation && *separation < -tolerance; }
  bool is_separated() const { return separation && *separation > tolerance; }
};

/// For each pair of a frame, in order.
std::vector<Truth> truths_of(const lint::Solids& solids, const trace::Frame& frame);

/// Area of a manifold's points, seen along its normal.
double area_of(const trace::Manifold& manifold);

/// Output of a program, or why it failed.
struct Answer {
  std::string out;
  std::string said;                // its standard error
  std::string failure;             // "it was stopped after 10 s"; empty: it exited with status 0
  std::optional<int> exit_code{};  // if it exited by itself
};

/// Exit status of a program that does not step, or not this scene; its last line is the reason.
inline constexpr int kNoRollout = 3;

/// The line that names an error, as interpreters print it first; else the last line with text.
std::string last_line(const std::string& text);

/// Runs a program with these arguments and this standard input. It is killed after `limit_seconds`
/// or `limit_bytes` of output; the failure contains the rest of its standard error. Throws
/// std::system_error if no process can be started.
Answer run_program(const std::string& program, const std::vector<std::string>& arguments,
                   const std::string& input, double limit_seconds,
                   std::size_t limit_bytes = std::size_t{1} << 30);

/// The path of a program in one of `folders`, else in $PATH. Empty if not found.
std::optional<std::string> find_program(const std::string& name,
                                        const std::vector<std::string>& folders);

/// The path of `contactscope-engine-NAME`.
std::optional<std::string> find_engine(const std::string& name,
                                       const std::vector<std::string>& folders);

/// Folders of the engines built with this program: its own, and `engines` in it.
std::vector<std::string> own_folders();

/// Names of all engines found, sorted.
std::vector<std::string> engines_found(const std::vector<std::string>& folders);

}  // namespace contactscope::versus
