#pragma once

#include <optional>
#include <string>
#include <vector>

/// What a study measured: error against run time, a series a method. FORMATS.md, "Study", gives the
/// JSON. Facts alone, so that a plot can be drawn from a stored file as well.
namespace contactscope::trace {

/// First words of every results.json.
inline constexpr const char* kStudySchema = "contactscope.study/1";

/// Where and when a study ran; times mean nothing without it.
struct StudyContext {
  std::string cpu;
  std::string compiler;
  std::string build_type;
  std::string date;    // UTC, ISO 8601
  std::string scalar;  // of the methods that name none: "float" or "double"
};

/// Time of one call in nanoseconds: over repetitions of passes over all cases.
struct Nanoseconds {
  double median = 0;
  double min = 0;
  double max = 0;
};

/// One method at one parameter. Errors are over the cases that did not fail; no error where all
/// failed, for a failure is no number.
struct StudyPoint {
  double parameter = 0;
  std::optional<double> error;        // mean
  std::optional<double> error_worst;  // largest
  Nanoseconds nanoseconds;
  int failed = 0;
  int of = 0;  // cases
};

struct StudySeries {
  std::string method;
  std::vector<StudyPoint> points;  // by growing parameter
  std::string panel{};             // series of one panel are drawn together; empty: there is one
  std::string parameter{};         // what the parameter is in this panel
  std::optional<double> row{};     // of a map: its place along the other axis
};

/// How a study is drawn.
enum class StudyForm {
  WorkPrecision,  // error against run time, a line a method
  Curves,         // error against the parameter, small multiples
  Map,            // a cell for each parameter and row, coloured by the decade of its worst error
};

/// "work_precision", "curves", "map".
constexpr const char* to_string(StudyForm form) {
  constexpr const char* kNames[] = {"work_precision", "curves", "map"};
  return kNames[static_cast<int>(form)];
}

struct Study {
  std::string study;    // "reducers", as the command line names it
  std::string measure;  // "area": which of the study's errors this is
  std::string title;    // for a reader
  StudyContext context;
  std::string reference;  // what the error is measured against
  std::string error;      // name of the error
  std::string unit;       // "m"; empty for a ratio
  double resolution = 0;  // errors up to this one cannot be told from rounding
  std::string parameter;  // "points": what the parameter counts
  std::vector<StudySeries> series;
  StudyForm form = StudyForm::WorkPrecision;
  std::string row{};     // of a map: what its rows stand for; rows without a number are methods
  std::string signal{};  // the series that is no error, but the size of what the errors spoil
};

/// Whether its series belong to panels: curves and maps always do.
bool has_panels(const Study& study);

/// The whole of results.json, indented, with a newline at its end. Numbers read back to the same
/// double. Throws std::domain_error that names the key where a number is not finite.
///
/// Beyond FORMATS.md: "measure", "title", "unit", "resolution", "parameter"; "scalar" in the
/// context, and "error_worst" beside each "error". Both errors are null where every case failed.
/// Studies with panels have "form", "row" and "signal", and their series "panel", "parameter" and
/// "row".
std::string to_json(const Study& study);

/// The same on one line, without the newline.
std::string to_json_line(const Study& study);

/// The same facts as CSV (RFC 4180, but with plain newlines): a header line, then a line a point;
/// what holds of the whole study is repeated in every line, so that files can be joined. An error
/// is empty where every case failed. Studies with panels have three columns more. Throws as to_json()
/// does.
std::string to_csv(const Study& study);

}  // namespace contactscope::trace
