#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trace/field.h"

/// What a study measured: error against run time, a series a method. README.md, "Study", gives the
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

  static constexpr auto fields() {
    using C = StudyContext;
    return field::list(field::exact("cpu", &C::cpu), field::exact("compiler", &C::compiler),
                       field::exact("build_type", &C::build_type), field::exact("date", &C::date),
                       field::exact("scalar", &C::scalar));
  }
};

/// Time of one call in nanoseconds: over repetitions of passes over all cases.
struct Nanoseconds {
  double median = 0;
  double min = 0;
  double max = 0;

  static constexpr auto fields() {
    using N = Nanoseconds;
    return field::list(field::exact("median", &N::median), field::exact("min", &N::min),
                       field::exact("max", &N::max));
  }
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
  // Of a picture alone, in no file:
  std::string mark{};  // the title speaks of this point: it has a ring, with this beside it

  static constexpr auto fields() {
    using P = StudyPoint;
    return field::list(field::exact("parameter", &P::parameter),
                       field::exact("error", &P::error).or_null(),
                       field::exact("error_worst", &P::error_worst).or_null(),
                       field::fact("nanoseconds", &P::nanoseconds),
                       field::exact("failed", &P::failed), field::exact("of", &P::of));
  }
};

struct StudySeries {
  std::string method;
  std::vector<StudyPoint> points;  // by growing parameter
  std::string panel{};             // series of one panel are drawn together; empty: there is one
  std::string parameter{};         // what the parameter is in this panel
  std::optional<double> row{};     // of a map: its place along the other axis
  // Of a picture alone, in no file:
  std::optional<int> look{};  // drawn as the method of this number; empty: as its own
  bool quiet = false;         // grey and thin: there for the others to be held against

  static constexpr auto fields() {
    using S = StudySeries;
    return field::list(field::exact("method", &S::method), field::exact("panel", &S::panel),
                       field::exact("parameter", &S::parameter),
                       field::exact("row", &S::row).or_null(), field::facts("points", &S::points));
  }
};

/// How a study is drawn.
enum class StudyForm {
  WorkPrecision,  // error against run time, a line a method
  Curves,         // error against the parameter, small multiples
  Map,            // a cell for each parameter and row, coloured by the decade of its worst error
  Answers,        // a cell likewise, coloured by what two shapes were called there, for which the
                  // error stands: 0 apart, 1 touching, 2 crossing; failed where that is wrong
};

/// "work_precision", "curves", "map", "answers".
constexpr const char* to_string(StudyForm form) {
  constexpr const char* kNames[] = {"work_precision", "curves", "map", "answers"};
  return kNames[static_cast<int>(form)];
}

struct Study {
  std::string study;    // "reducers", as the command line names it
  std::string measure;  // "area": which of the study's errors this is
  std::string title;    // for a reader
  StudyContext context;
  std::string reference;  // what the error is measured against
  std::string error;      // name of the error
  std::string unit;       // "m"; empty for a ratio. Of a picture also kShare, kTimes and kSum
  double resolution = 0;  // errors up to this one cannot be told from rounding
  std::string parameter;  // "points": what the parameter counts
  std::vector<StudySeries> series;
  StudyForm form = StudyForm::WorkPrecision;
  std::string row{};     // of a map: what its rows stand for; rows without a number are methods
  std::string signal{};  // the series that is no error, but the size of what the errors spoil
  // Of a picture alone, in no file:
  std::string shown{};   // how to read it; empty: what its form says of itself
  std::string failed{};  // what befell the cases that failed: "lost"; empty: "failed"
  bool other_cases =
      false;  // a parameter makes cases of its own: points are held against those of the same one

  static constexpr auto fields() {
    using S = Study;
    return field::list(field::exact("study", &S::study), field::exact("measure", &S::measure),
                       field::exact("title", &S::title), field::fact("context", &S::context),
                       field::exact("reference", &S::reference), field::exact("error", &S::error),
                       field::exact("unit", &S::unit), field::exact("resolution", &S::resolution),
                       field::exact("parameter", &S::parameter), field::exact("form", &S::form),
                       field::exact("row", &S::row), field::exact("signal", &S::signal),
                       field::facts("series", &S::series));
  }
};

/// Units of what is drawn on a linear axis from zero: shares of 1, in percent, multiples, and milliseconds that
/// add up. Maps colour shares of cases that failed; work precision has shares on its logarithmic axis.
inline constexpr const char* kShare = "share";
inline constexpr const char* kTimes = "times";
inline constexpr const char* kSum = "milliseconds in all";

/// Whether its series belong to panels: curves and maps always do.
bool has_panels(const Study& study);

/// The whole of results.json, indented, with a newline at its end. Numbers read back to the same
/// double. Both errors are null where every case failed. Studies without panels have no "form",
/// "row" and "signal", their series no "panel", "parameter" and "row". Throws std::domain_error that
/// names the key where a number is not finite.
std::string to_json(const Study& study);

/// The same on one line, without the newline.
std::string to_json_line(const Study& study);

/// The same facts as CSV (RFC 4180, but with plain newlines): a header line, then a line a point;
/// what holds of the whole study is repeated in every line, so that files can be joined. An error
/// is empty where every case failed. Studies with panels have three columns more. Throws as to_json()
/// does.
std::string to_csv(const Study& study);

}  // namespace contactscope::trace
