#include <algorithm>
#include <string_view>

#include "core/at.h"
#include "study/picture.h"

namespace contactscope {
namespace {

using namespace record;

constexpr double kKilometre = 1000;
constexpr const char* kDistance = "distance";
constexpr std::string_view kAsMeant = ", unrounded";  // the geometry before rounding

trace::Study picture_sweeps(const trace::Study& measured) {
  trace::Study study = measured;
  // Compared with the unrounded geometry; tables contain the loss by arithmetic alone.
  std::erase_if(study.series, [](const trace::StudySeries& series) {
    return !series.method.ends_with(kAsMeant);
  });
  // Errors grow with distance, not with size; tables contain the other sweeps.
  keep_panels(study, {{kDistance, ""}});
  double first_lost = 1e300;
  for (trace::StudySeries& series : study.series) {
    series.method.resize(series.method.size() - kAsMeant.size());
    series.parameter = "m from the origin";
    for (const trace::StudyPoint& point : series.points)
      if (point.failed > 0) first_lost = std::min(first_lost, point.parameter);
  }
  // From there on only found contacts would count; the map of overlaps shows the lost ones.
  for (trace::StudySeries& series : study.series)
    std::erase_if(series.points, [&](const auto& point) { return point.parameter >= first_lost; });
  study.signal.clear();
  study.reference = study.reference.substr(0, study.reference.find(';'));
  study.shown =
      "Up: largest error of a contact over the size of its shapes, whose poses float or double "
      "rounds; both axes logarithmic";
  report(study, [&] {
    const auto far = [&](const char* scalar) {
      const trace::StudySeries& series =
          series_of(measured, std::string(scalar) + std::string(kAsMeant), kDistance);
      const std::string off = power(point_at(series, kKilometre).error_worst.value());
      mark(study, scalar, "", kKilometre, "1 km: " + off);
      return off;
    };
    const std::string in_float = far("float");
    return "1 km from the origin a contact is off by " + in_float +
           " of its shapes' size in float, by " + far("double") + " in double";
  });
  return study;
}

/// The deepest overlap, relative to the size, that is lost at a distance; 0 if none.
double lost_at(const trace::Study& study, const char* panel, double distance) {
  double lost = 0;
  for (const trace::StudySeries& series : study.series)
    if (series.panel == panel && series.row && point_at(series, distance).failed > 0)
      lost = std::max(lost, *series.row);
  return lost;
}

/// The smallest distance at which an overlap is lost; 0 if none.
double nearest_loss(const trace::Study& study, const char* panel) {
  double nearest = 0;
  for (const trace::StudySeries& series : study.series)
    for (const trace::StudyPoint& point : series.points)
      if (series.panel == panel && point.failed > 0 && (nearest == 0 || point.parameter < nearest))
        nearest = point.parameter;
  return nearest;
}

trace::Study picture_map(const trace::Study& measured) {
  trace::Study study = measured;
  if (study.measure != "distance_overlap") return study;
  keep_panels(study, {{"float, unrounded", "Float"}, {"double, unrounded", "Double"}});
  for (trace::StudySeries& series : study.series) series.parameter = "distance from the origin, m";
  study.row.clear();  // the subtitle has it
  // Tables contain the errors of found contacts.
  study.unit = trace::kShare;
  study.shown =
      "Up: overlap / size of the shapes. Colour: share of the contacts that are lost, not found or "
      "off by half of their depth.";
  report(study, [&] {
    const double in_float = lost_at(measured, "float, unrounded", kKilometre);
    const double in_double = nearest_loss(measured, "double, unrounded");
    for (trace::StudySeries& series : study.series)
      for (trace::StudyPoint& point : series.points) {
        if (series.panel == "Float" && point.parameter == kKilometre && series.row == in_float)
          point.mark = "1 km: " + power(in_float);
        if (series.panel == "Double" && point.parameter == in_double && point.failed > 0)
          point.mark = count(in_double / kKilometre) + " km";
      }
    return "1 km from the origin float loses some overlaps of " + power(in_float) +
           " of the size; double loses none" +
           (in_double > 0 ? " nearer than " + count(in_double / 1000) + " km" : "");
  });
  return study;
}

}  // namespace

trace::Study picture_limits(const trace::Study& measured) {
  return measured.form == trace::StudyForm::Curves ? picture_sweeps(measured)
                                                   : picture_map(measured);
}

}  // namespace contactscope
