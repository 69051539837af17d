#pragma once

#include <string>

#include "trace/study.h"

/// Plots of studies. The title is the result, with numbers read from the study itself, so they
/// match its run. Methods have readable names, and unimportant series are omitted; files and tables
/// keep every number.
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

}  // namespace record
}  // namespace contactscope
