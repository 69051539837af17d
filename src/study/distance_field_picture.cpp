#include <algorithm>

#include "core/at.h"
#include "study/picture.h"

namespace contactscope {
namespace {

using namespace record;

constexpr const char* kByCells = "by cells";
constexpr double kUsualCells = 64;
constexpr double kMicrometres = 1e6;  // per metre
const std::vector<Named> kFields = {
    {"trilinear", "trilinear"},
    {"cubic", "cubic"},
    {"trilinear with exact cells", "trilinear, exact cells"},
    {"cubic with exact cells where needed", "cubic, some cells exact"},
    {"cubic with exact cells", "cubic, exact cells"}};

/// Includes another library if it took part.
std::vector<Named> all_fields(const trace::Study& study) {
  std::vector<Named> named = kFields;
  for (const trace::StudySeries& series : study.series) {
    if (std::ranges::find(named, series.method, &Named::first) != named.end()) continue;
    // "OpenVDB 10.0.1, trilinear"
    const std::size_t comma = series.method.find(',');
    named.emplace_back(series.method,
                       series.method.substr(0, series.method.find(' ')) +
                           (comma == std::string::npos ? "" : series.method.substr(comma)));
  }
  return named;
}

/// By its name in pictures.
bool is_peer(const std::string& field) {
  return std::ranges::find(kFields, field, &Named::second) == kFields.end();
}

trace::Study picture_errors(const trace::Study& measured) {
  trace::Study study = measured;
  std::vector<Named> named = all_fields(measured);
  // Tables contain the others, which lie between these.
  std::erase_if(named, [](const Named& field) {
    return field.second == "trilinear, exact cells" || field.second == "cubic, some cells exact";
  });
  keep_methods(study, named);
  keep_panels(study, {{kByCells, ""}});
  name_parameter(study, "cells");
  const bool is_length = study.unit == "m";
  if (is_length) {
    study.unit = "µm";
    study.resolution *= kMicrometres;
    scale_errors(study, kMicrometres);
  }
  drop_worst(study);
  for (trace::StudySeries& series : study.series) {
    series.quiet = is_peer(series.method);
    // One size, so that a field is one marker; tables contain the others and the worst.
    std::erase_if(series.points, [](const auto& point) { return point.parameter != kUsualCells; });
  }
  show_least_times(study);
  // "..., by band in its box" describes other panels.
  const std::size_t begin = study.reference.find(", by band"),
                    seed = study.reference.rfind(", seed");
  if (begin != std::string::npos && seed != std::string::npos && begin < seed)
    study.reference.erase(begin, seed - begin);
  study.shown =
      "Fields of " + number(kUsualCells) +
      " cells along the longest side, asked within 2 cm of the surface of a ball 1 m wide. Exact "
      "cells ask their triangles";
  if (study.measure != "distance") return study;
  report(study, [&] {
    const auto at_usual = [&](const char* method) -> const trace::StudyPoint& {
      return point_at(series_of(measured, method, kByCells), kUsualCells);
    };
    const trace::StudyPoint& base = at_usual("trilinear");
    const auto ratio = [&](double over, double under) { return number(over / under) + " ×"; };
    const auto error_ratio = [&](const trace::StudyPoint& other) {
      return ratio(base.error.value(), other.error.value());
    };
    const auto slower = [&](const trace::StudyPoint& other) {
      return ratio(other.nanoseconds.min, base.nanoseconds.min);
    };
    const trace::StudyPoint &cubic = at_usual("cubic"), &exact = at_usual("cubic with exact cells");
    // The mark contains the name.
    const auto compare = [&](const std::string& name, const trace::StudyPoint& other) {
      mark(study, name, "", kUsualCells,
           name + ": " + error_ratio(other) + " as close as trilinear, " + slower(other) +
               " the time");
      for (trace::StudySeries& series : study.series)
        if (series.method == name) series.method.clear();
    };
    compare("cubic", cubic);
    compare("cubic, exact cells", exact);
    return "A cubic field with exact cells is " + error_ratio(exact) +
           " as close as a trilinear one, in " + slower(exact) + " the time";
  });
  return study;
}

trace::Study picture_build(const trace::Study& measured) {
  trace::Study study = measured;
  keep_methods(study, all_fields(measured));
  keep_panels(study, {{kByCells, ""}});
  name_parameter(study, "cells along the longest side");
  // "all triangles in long double, 2000 points within 2 cm of a wavy ball, by band": the mesh.
  const std::size_t begin = study.reference.find(" of a "), end = study.reference.find(", by band");
  const bool is_named = begin != std::string::npos && end != std::string::npos && begin < end;
  study.shown =
      "Up: milliseconds to build" +
      (is_named ? " the field" + study.reference.substr(begin, end - begin) : std::string()) +
      ", on one thread";
  if (study.measure != "build") {
    study.shown = "Up: megabytes";
    return study;
  }
  report(study, [&] {
    const double most = 128;
    double slowest = 0, peer = 0;
    std::string slow_name;
    for (const trace::StudySeries& series : study.series) {
      const double time = 1e6 * error_at(series, most);
      if (is_peer(series.method))
        peer = time;
      else if (time > slowest)
        slowest = time, slow_name = series.method;
    }
    // Other kinds are faster, so only tables contain them, except the peer's kind.
    std::erase_if(study.series, [&](const trace::StudySeries& series) {
      return !is_peer(series.method) && series.method != slow_name &&
             series.method != kFields.front().second;
    });
    for (trace::StudySeries& series : study.series) {
      series.method += ": " + duration(1e6 * error_at(series, most));
    }
    study.reference.clear();  // it describes errors
    const std::string field = "field of " + number(most, 3) + " cells";
    if (peer == 0) return "A " + field + " takes up to " + duration(slowest) + " to build";
    return "OpenVDB takes " + duration(peer) + " to build a " + field +
           ", contactscope's slowest kind " + duration(slowest);
  });
  return study;
}

/// The worst result of a method over all its panels, at each parameter.
trace::StudySeries worst_of_panels(const trace::Study& study, const std::string& method) {
  trace::StudySeries worst;
  for (const trace::StudySeries& series : study.series) {
    if (series.method != method) continue;
    if (worst.points.empty()) worst = series;
    for (trace::StudyPoint& point : worst.points)
      for (const trace::StudyPoint& other : series.points)
        if (other.parameter == point.parameter && other.error > point.error) point = other;
  }
  return worst;
}

trace::Study picture_missed(const trace::Study& measured) {
  trace::Study study = measured;
  study.series.clear();
  const std::string points = "at points: ";
  const std::string shallowest = points + "1/100 of a cell deep";
  for (const auto& [panel, depth] :
       {Named{"0.01 cells deep", "1/100 of a cell deep"},
        Named{"0.1 cells deep", "1/10 of a cell deep"}, Named{"1 cell deep", "one cell deep"}}) {
    for (const trace::StudySeries& series : measured.series) {
      if (series.method != "sampled" || series.panel != panel) continue;
      trace::StudySeries& line = study.series.emplace_back(series);
      line.method = points + depth;
      line.look = static_cast<int>(study.series.size()) + 1;
    }
  }
  const trace::StudySeries searched = worst_of_panels(measured, "conservative");
  const double conservative = largest_error(searched);
  if (!searched.points.empty()) {
    trace::StudySeries& line = study.series.emplace_back(searched);
    line.method = "conservative search: any depth";
    line.look = 1;
  }
  for (trace::StudySeries& series : study.series) series.panel.clear();
  name_parameter(study, "cells from point to point");
  study.unit = trace::kShare;
  study.shown =
      "A cube overlaps a ball, whose distance field is asked at points of the cube's faces; "
      "conservative: faces are halved until a bound decides. Up: share missed";
  report(study, [&] {
    const double usual = 1;
    const double missed = error_at(series_of(measured, "sampled", "0.01 cells deep"), usual);
    mark(study, shallowest, "", usual, percent(missed));
    return "Points one cell apart miss " + percent(missed) + " of the shallowest overlaps, " +
           "a conservative search " +
           (conservative > 0 ? "up to " + percent(conservative) : "none");
  });
  return study;
}

trace::Study picture_plate(const trace::Study& measured) {
  trace::Study study = measured;
  keep_methods(study, kFields);
  join_equal(study);
  for (trace::StudySeries& series : study.series) {
    series.panel.clear();
    series.parameter = "thickness of the plate, cells";
    if (series.method.find(" and ") != std::string::npos) series.method = "with exact cells";
  }
  study.unit = trace::kShare;
  study.shown =
      "Up: share of a plate's middle that a field calls outside. Exact cells ask their triangles";
  report(study, [&] {
    const double quarter = 0.25;
    const char* const kPlate = "a plate beside a wall";
    const auto lost = [&](const char* method) {
      const double share = error_at(series_of(measured, method, kPlate), quarter);
      return share > 0 ? percent(share) : std::string("nothing");
    };
    const std::string exact = lost("cubic with exact cells");
    mark(study, "trilinear", "", quarter, lost("trilinear"));
    mark(study, "cubic", "", quarter, lost("cubic"));
    for (trace::StudySeries& series : study.series)
      if (series.method == "with exact cells" && exact == "nothing") series.method += ": " + exact;
    if (exact != "nothing") mark(study, "with exact cells", "", quarter, exact);
    return "Of a plate a quarter of a cell thick a trilinear field loses " + lost("trilinear") +
           ", a cubic one " + lost("cubic") + ", with exact cells " + exact;
  });
  return study;
}

}  // namespace

trace::Study picture_distance_field(const trace::Study& measured) {
  const std::string& measure = measured.measure;
  if (measure == "missed") return picture_missed(measured);
  if (measure == "plate") return picture_plate(measured);
  return measured.form == trace::StudyForm::Curves ? picture_build(measured)
                                                   : picture_errors(measured);
}

}  // namespace contactscope
