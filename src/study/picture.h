#pragma once

#include "trace/study.h"

/// Plots of studies. The title is the result, with numbers read from the study itself. Methods have
/// readable names, and unimportant series are omitted; files and tables keep every number.
namespace contactscope {

/// Converts a measured study into the one to draw, by its row in pictures.cpp; without a row it is
/// drawn unchanged. If data for the title is missing, the study keeps its title.
trace::Study picture_of(const trace::Study& measured);

namespace record {

/// Calls change(point) for every point of a study.
template <class Change> void each_point(trace::Study& study, const Change& change) {
  for (trace::StudySeries& series : study.series)
    for (trace::StudyPoint& point : series.points) change(point);
}
/// Leaves the worst errors to the tables.
void drop_worst(trace::Study& study);
/// Multiplies errors, as to show metres in millimetres.
void scale_errors(trace::Study& study, double factor);

/// "81 %", "6.9 %", "0.02 %".
std::string percent(double share);
/// Two significant digits: "3.5", "14", "840".
std::string number(double value, int digits = 2);
/// "9,024".
std::string count(double value);
/// "0.1 mm", "69 cm", "2 µm".
std::string length(double metres, int digits = 2);
/// "640 ns", "1.1 µs", "5.6 s".
std::string duration(double nanoseconds, int digits = 2);
/// "10⁻⁵", or "0.001" if that is as short.
std::string power(double value);

inline constexpr bool kQuiet = true;

/// A method or panel of a study, and its name in the picture. "from*": all that begin like it.
struct Kept {
  std::string from, to;
  bool quiet = false;         // thin and grey: a reference for the others
  std::optional<int> look{};  // in the style of this method number; empty: as in the full study
};

struct PictureOptions {
  double at = 0;                 // parameter of the points in the title
  bool only_at = false;          // draws only these: mean error and least time, one marker a method
  bool drop_worst = false;       // leaves the worst errors to the tables
  bool drop_resolution = false;  // errors within the resolution are zero
  double scale = 1;              // of errors, as to show metres in millimetres
  std::optional<trace::StudyForm> form{};
  std::string error{}, failed{};
  // Leaves text out of the reference, from the first of one to the last of the other.
  std::pair<std::string, std::string> left_out{};
};

class Picture;

/// How a measure of a study is drawn. What is empty stays as measured.
struct PictureRow {
  std::string study{}, measure{};         // no measure: all without a row above
  std::vector<Kept> methods{}, panels{};  // only these, in this order; tables contain the others
  std::string parameter{}, unit{};
  std::string shown{};  // "{error}": the name of the error
  PictureOptions options{};
  // Finishes the picture and returns its title; "", or std::out_of_range: it stays as measured.
  std::string (*result)(Picture&) = nullptr;
};

/// A measured study, drawn by its row. Throws std::out_of_range for a number that is missing.
class Picture {
 public:
  const PictureRow& row;
  const trace::Study& measured;
  trace::Study drawn;
  std::vector<trace::StudySeries>& lines = drawn.series;

  /// All but the result.
  Picture(const PictureRow& of, const trace::Study& study);
  Picture& operator=(Picture&&) = delete;

  /// The measured point that the title mentions, in the first panel of the row.
  const trace::StudyPoint& point(const std::string& method) const;
  double error(const std::string& method) const;
  std::string share(const std::string& method) const { return percent(error(method)); }
  /// Draws a ring with these words around that point, if it is drawn. Returns the words.
  std::string mark(const std::string& method, const std::string& words);
  /// Adds ": words" to the name of a line.
  void add_to_name(const std::string& method, const std::string& words);
  /// Likewise, and moves the name to that point.
  void mark_with_name(const std::string& method, const std::string& words);

  /// Merges methods with equal points in every panel into one, "these and those", at the position
  /// of the first.
  void join_equal();
  /// Removes the points for which `is_beyond(point)`.
  template <class Test> void drop_points(const Test& is_beyond) {
    for (trace::StudySeries& line : lines) std::erase_if(line.points, is_beyond);
  }

 private:
  const std::string& name_of(const std::string& method) const;
};

/// With its title.
trace::Study drawn_by(const PictureRow& row, const trace::Study& measured);

/// The series of a method in a panel, or in any.
const trace::StudySeries& series_of(const trace::Study& study, std::string_view method,
                                    std::optional<std::string_view> panel = {});
const trace::StudyPoint& point_at(const trace::StudySeries& series, double parameter);
/// Also throws if all cases failed.
double error_at(const trace::StudySeries& series, double parameter);
/// The smallest parameter at which a case failed; `start` if all are smaller, or none.
double first_failure(const trace::StudySeries& line, double start);
/// A point's mean error; 0 if all cases failed.
inline double error_of(const trace::StudyPoint& point) { return point.error.value_or(0); }
/// The largest mean error of all series of these methods; 0 without points.
double largest_error(const trace::Study& study, const std::vector<std::string>& methods);

inline constexpr const char* kGuarded = "no threshold, each gap judged by its own rounding error";

/// Results of plots that are too long for their row in pictures.cpp.
using PictureResult = std::string(Picture& plot);
PictureResult result_of_thresholds, result_of_broad_phases, result_of_updates, result_of_refitting,
    result_of_coherence, result_near_plane, result_of_last_bits, result_of_phase, result_of_impacts,
    result_of_bullets, result_of_fields, result_of_building, result_of_points, result_of_plate,
    result_of_jitter, result_of_max_points, result_of_ratios, result_of_energy, result_of_distance,
    result_of_overlaps, result_of_depths, result_of_trees, result_of_box_path, result_of_precision,
    result_of_pairs, result_of_gains, result_of_axes;

}  // namespace record
}  // namespace contactscope
