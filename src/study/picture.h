#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "trace/study.h"

/// Plots of studies. The title is the result, with numbers read from the study itself, so they
/// match its run. Methods have readable names, and unimportant series are omitted; files and tables
/// keep every number.
namespace contactscope {

/// Converts a measured study into the one to draw. If data for the title is missing, the study
/// keeps its title.
using StudyPicture = trace::Study(const trace::Study& measured);

// Each is in the file of its name, for all measures of its study.
StudyPicture picture_reducers, picture_overlap, picture_broad_phase, picture_meshes,
    picture_triangles, picture_time_of_impact, picture_tunnelling, picture_distance_field,
    picture_solver, picture_limits, picture_flip_distance;

namespace record {

/// The series of a method in a panel. Throws std::out_of_range if there is none.
const trace::StudySeries& series_of(const trace::Study& study, const std::string& method,
                                    const std::string& panel = {});
/// Its point at a parameter. Throws likewise.
const trace::StudyPoint& point_at(const trace::StudySeries& series, double parameter);
/// Its error there. Throws likewise, also if all cases failed.
double error_at(const trace::StudySeries& series, double parameter);

/// A method of a study, and its name in the picture.
using Named = std::pair<std::string, std::string>;
/// Keeps only these methods, in this order; their colours are as in the full study.
void keep_methods(trace::Study& study, const std::vector<Named>& named);
/// Keeps only these panels, by the same names, in this order.
void keep_panels(trace::Study& study, const std::vector<Named>& named);
/// Merges series with equal points in every panel into one, "these and those", at the position of
/// the first.
void join_equal(trace::Study& study);
/// Draws a ring with this label around a point in the title. Uses the current names of series and
/// panels; does nothing if the point is missing.
void mark(trace::Study& study, const std::string& method, const std::string& panel,
          double parameter, const std::string& words);
/// Calls change(point) for every point of a study.
template <class Change> void each_point(trace::Study& study, const Change& change) {
  for (trace::StudySeries& series : study.series)
    for (trace::StudyPoint& point : series.points) change(point);
}
/// Names the parameter of all series.
void name_parameter(trace::Study& study, const std::string& name);
/// Leaves the worst errors to the tables.
void drop_worst(trace::Study& study);
/// Multiplies errors, as to show metres in millimetres.
void scale_errors(trace::Study& study, double factor);
/// A point's mean error; 0 if all cases failed.
inline double error_of(const trace::StudyPoint& point) { return point.error.value_or(0); }
/// The largest mean error of a series, 0 without points.
double largest_error(const trace::StudySeries& series);
/// Uses the minimum of each time, which other programs disturb least.
void show_least_times(trace::Study& study);
/// Sets errors within the resolution to zero.
void drop_resolution(trace::Study& study);

/// Sets the title to `result()`. If the study lacks a number for it, the title stays.
template <class Result> void report(trace::Study& study, const Result& result) {
  try {
    study.title = result();
  } catch (const std::out_of_range&) {
  } catch (const std::bad_optional_access&) {
  }
}

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
/// "spheres, boxes and rods".
std::string listed(const std::vector<std::string>& names);

}  // namespace record
}  // namespace contactscope
