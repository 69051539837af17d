#pragma once

#include "trace/field.h"

/// Measurements of a study: error against run time, one series per method. README.md, "Study",
/// gives the JSON. Contains only facts, so that plots can be drawn from stored files.
namespace contactscope::trace {

/// Value of "schema" in every results.json.
inline constexpr const char* kStudySchema = "contactscope.study/1";

/// Machine, build and date of a study; times mean nothing without them.
struct StudyContext {
  std::string cpu;
  std::string compiler;
  std::string build_type;
  std::string date;    // UTC, ISO 8601
  std::string scalar;  // for methods that name none: "float" or "double"

  static constexpr auto fields() {
    using C = StudyContext;
    return field::list(field::exact<&C::cpu>, field::exact<&C::compiler>,
                       field::exact<&C::build_type>, field::exact<&C::date>,
                       field::exact<&C::scalar>);
  }
};

/// Time of one call in nanoseconds, over repeated passes over all cases.
struct Nanoseconds {
  double median = 0;
  double min = 0;
  double max = 0;

  static constexpr auto fields() {
    using N = Nanoseconds;
    return field::list(field::exact<&N::median>, field::exact<&N::min>, field::exact<&N::max>);
  }
};

/// One method at one parameter. Errors are over the cases that did not fail; empty if all failed.
struct StudyPoint {
  double parameter = 0;
  std::optional<double> error;        // mean
  std::optional<double> error_worst;  // largest
  Nanoseconds nanoseconds;
  int failed = 0;
  int of = 0;  // cases
  // Only for pictures, not in files:
  std::string mark{};  // the title mentions this point: draws a ring with this label

  static constexpr auto fields() {
    using P = StudyPoint;
    return field::list(field::exact<&P::parameter>, field::exact<&P::error>.or_null(),
                       field::exact<&P::error_worst>.or_null(), field::fact<&P::nanoseconds>,
                       field::exact<&P::failed>, field::exact<&P::of>);
  }
};

struct StudySeries {
  std::string method;
  std::vector<StudyPoint> points;  // by increasing parameter
  std::string panel{};             // series of one panel are drawn together; empty: only one panel
  std::string parameter{};         // meaning of the parameter in this panel
  std::optional<double> row{};     // for a map: position along the other axis
  // Only for pictures, not in files:
  std::optional<int> look{};  // drawn in the style of this method number; empty: its own
  bool quiet = false;         // thin and grey: a reference for the other series

  static constexpr auto fields() {
    using S = StudySeries;
    return field::list(field::exact<&S::method>, field::exact<&S::panel>,
                       field::exact<&S::parameter>, field::exact<&S::row>.or_null(),
                       field::facts<&S::points>);
  }
};

/// How a study is drawn.
enum class StudyForm {
  WorkPrecision,  // error against run time, one line per method
  Curves,         // error against the parameter, small multiples
  Map,            // a cell per parameter and row, coloured by the decade of its worst error
  Answers,        // likewise, coloured by the answer for two shapes, which is stored as the error:
                  // 0 separated, 1 touching, 2 crossing; failed if the answer is wrong
  Features,       // likewise, coloured by what makes the contact of two hulls: 0 nothing, 1 a face
                  // of A, 2 a face of B, 3 two edges
  Bars,           // a bar per line, as long as the error of its only point; pictures only
};

/// Whether a study is drawn as cells.
constexpr bool has_cells(StudyForm form) {
  return form == StudyForm::Map || form == StudyForm::Answers || form == StudyForm::Features;
}

/// "work_precision", "curves", "map", "answers", "features", "bars".
constexpr const char* to_string(StudyForm form) {
  constexpr const char* kNames[] = {"work_precision", "curves",   "map",
                                    "answers",        "features", "bars"};
  return kNames[static_cast<int>(form)];
}

struct Study {
  std::string study;    // "reducers", as on the command line
  std::string measure;  // "area": which of the study's errors this is
  std::string title;
  StudyContext context;
  std::string reference;  // what the error is measured against
  std::string error;      // name of the error
  std::string unit;       // "m"; empty for a ratio. Pictures also use the units below
  double resolution = 0;  // errors up to this one are rounding noise
  std::string parameter;  // "points": meaning of the parameter
  std::vector<StudySeries> series;
  StudyForm form = StudyForm::WorkPrecision;
  std::string row{};     // for a map: meaning of its rows; rows without a number are methods
  std::string signal{};  // name of the series that is not an error but the signal's size
  // Only for pictures, not in files:
  std::string shown{};   // how to read it; empty: default text for the form
  std::string failed{};  // what happened to failed cases: "lost"; empty: "failed"
  bool other_cases =
      false;  // each parameter has its own cases: compare points only at equal parameters

  static constexpr auto fields() {
    using S = Study;
    return field::list(field::exact<&S::study>, field::exact<&S::measure>, field::exact<&S::title>,
                       field::fact<&S::context>, field::exact<&S::reference>,
                       field::exact<&S::error>, field::exact<&S::unit>,
                       field::exact<&S::resolution>, field::exact<&S::parameter>,
                       field::exact<&S::form>, field::exact<&S::row>, field::exact<&S::signal>,
                       field::facts<&S::series>);
  }
};

/// Units on a linear axis from zero: shares of 1 in percent, multiples, and milliseconds that add
/// up. Maps colour shares of failed cases; work precision has shares on its logarithmic axis.
inline constexpr const char* kShare = "share";
inline constexpr const char* kTimes = "times";
inline constexpr const char* kSum = "milliseconds in all";
inline constexpr const char* kMicroseconds = "microseconds";

/// Whether the series belong to panels; curves and maps always do.
bool has_panels(const Study& study);

/// The complete results.json, indented, with a final newline. Numbers round-trip to the same
/// double. Both errors are null if every case failed. Studies without panels have no "form", "row"
/// and "signal", their series no "panel", "parameter" and "row". Throws std::domain_error with the
/// key if a number is not finite.
std::string to_json(const Study& study);

/// to_json() on one line, without the newline.
std::string to_json_line(const Study& study);

/// The same facts as CSV (RFC 4180, but with plain newlines): a header line, then one line per
/// point. Facts of the whole study are repeated in every line, so that files can be concatenated.
/// An error is empty if every case failed. Studies with panels have three more columns. Throws as
/// to_json() does.
std::string to_csv(const Study& study);

}  // namespace contactscope::trace
