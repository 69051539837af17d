#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "trace/study.h"

/// What a plot of a study tells: its title is the result, with numbers that are read from the study itself, so that
/// they are those of its run; methods have the names that a reader knows, and what teaches nothing is left out.
/// Files and tables keep every number.
namespace contactscope {

/// A study as it is drawn, of one as it was measured. One that lacks what the picture tells of is drawn with
/// the title that it has.
using StudyPicture = trace::Study(const trace::Study& measured);

// Each is in the file of its name, for every measure of its study.
StudyPicture picture_reducers, picture_overlap, picture_broad_phase, picture_meshes,
    picture_triangles, picture_time_of_impact, picture_tunnelling, picture_distance_field,
    picture_solver, picture_limits, picture_flip_distance;

namespace record {

/// The series of a method, in the panel of this name. Throws std::out_of_range where there is none.
const trace::StudySeries& series_of(const trace::Study& study, const std::string& method,
                                    const std::string& panel = {});
/// Its point at a parameter. Throws likewise.
const trace::StudyPoint& point_at(const trace::StudySeries& series, double parameter);
/// Its error there. Throws likewise, also where all cases failed.
double error_at(const trace::StudySeries& series, double parameter);

/// A method of a study, and how a picture calls it.
using Named = std::pair<std::string, std::string>;
/// Keeps these methods alone, in this order, with the looks that they have among all of the study.
void keep_methods(trace::Study& study, const std::vector<Named>& named);
/// Keeps these panels alone, by the same names, in this order.
void keep_panels(trace::Study& study, const std::vector<Named>& named);
/// Series that are at the same places in every panel become one, "these and those", under the name of all.
/// It stands where the first of them stood.
void join_equal(trace::Study& study);
/// The title speaks of this point: it has a ring, with these words beside it. Names are those that series and panels have
/// now; nothing where there is no such point.
void mark(trace::Study& study, const std::string& method, const std::string& panel,
          double parameter, const std::string& words);
/// Every time is the least that was measured, which other programs on the machine disturb least.
void show_least_times(trace::Study& study);
/// Errors up to the resolution are none.
void drop_resolution(trace::Study& study);

/// What `result()` says becomes the title. Where the study lacks a number for it, the title stays.
template <class Result>
void report(trace::Study& study, const Result& result) {
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
/// "10⁻⁵", or "0.001" where that is as short.
std::string power(double value);
/// "spheres, boxes and rods".
std::string listed(const std::vector<std::string>& names);

}  // namespace record
}  // namespace contactscope
