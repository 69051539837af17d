#include <algorithm>
#include <cmath>

#include "core/at.h"
#include "study/picture.h"

namespace contactscope {
namespace {

using namespace told;

constexpr double kUsualSubsteps = 8;
constexpr const char* kSubsteps = "More sub-steps, an iteration each";
const std::vector<Named> kWarm = {{"soft, warm", "soft contacts"},
                                  {"projection, warm", "projection"},
                                  {"baumgarte, warm", "Baumgarte"}};

constexpr const char* kColdPanel = ", no warm starting";

trace::Study picture_curves(const trace::Study& measured) {
  trace::Study study = measured;
  keep_methods(study, kWarm);  // tables have those without warm starting
  if (study.measure == "jitter") keep_panels(study, {{kSubsteps, kSubsteps}});
  // Those of one panel stand together.
  std::ranges::stable_sort(study.series, std::ranges::less(), &trace::StudySeries::panel);
  study.failed = "fell";
  study.shown = "Up: mean " + study.error +
                ". Along a line: 1 to 64 sub-steps. Band: the least to the greatest time.";
  if (study.measure != "jitter") return study;
  tell(study, [&] {
    const auto speed = [&](const char* method) {
      return error_at(series_of(measured, method, kSubsteps), kUsualSubsteps);
    };
    double rivals = std::min(speed("projection, warm"), speed("baumgarte, warm"));
    const auto at_usual = [](trace::StudySeries& series) -> trace::StudyPoint* {
      for (trace::StudyPoint& point : series.points)
        if (series.panel == kSubsteps && point.parameter == kUsualSubsteps && point.error)
          return &point;
      return nullptr;
    };
    for (trace::StudySeries& series : study.series)
      if (const auto* point = at_usual(series); point && series.method != kWarm[0].second)
        rivals = std::min(rivals, *point->error);
    const std::string sub_steps = number(kUsualSubsteps) + " sub-steps";
    const auto spelled = [](double metres) { return number(1000 * metres) + " mm/s"; };
    mark(study, kWarm[0].second, kSubsteps, kUsualSubsteps,
         sub_steps + ": " + spelled(speed("soft, warm")));
    for (trace::StudySeries& series : study.series)
      if (auto* point = at_usual(series); point && series.method != kWarm[0].second)
        point->mark =
            (*point->error == rivals ? sub_steps + ": " : std::string()) + spelled(*point->error);
    return "With " + sub_steps + " ten boxes on soft contacts move at " +
           spelled(speed("soft, warm")) + ", with projection or Baumgarte at " + spelled(rivals) +
           " or more";
  });
  return study;
}

/// The largest ratio at which every stack of a panel stands, up to it; 0 where even equal boxes fall.
double held_by_all(const trace::Study& study, const std::string& panel) {
  double least = 1e300;
  for (const trace::StudySeries& series : study.series) {
    if (series.panel != panel) continue;
    double held = 0;
    for (const trace::StudyPoint& point : series.points) {
      if (point.failed > 0) break;
      held = point.parameter;
    }
    least = std::min(least, held);
  }
  if (least == 1e300) throw std::out_of_range(panel);
  return least;
}

trace::Study picture_map(const trace::Study& measured) {
  trace::Study study = measured;
  for (trace::StudySeries& series : study.series) {
    std::string& panel = series.panel;
    const bool is_cold = panel.find("cold") != std::string::npos;
    const std::string method = panel.substr(0, panel.find(','));
    panel = method == "soft" ? "Soft contacts" : method == "baumgarte" ? "Baumgarte" : "Projection";
    if (is_cold) panel += kColdPanel;
    series.parameter = "mass of the top / others";
  }
  study.shown = "Colour: " + study.error + ", at 16 sweeps a frame";
  study.failed = "fell";
  if (study.measure != "map") return study;
  // Without warm starting all hold less; tables have them.
  std::erase_if(study.series, [](const trace::StudySeries& series) {
    return series.panel.ends_with(kColdPanel);
  });
  tell(study, [&] {
    double most = 0;  // at which anything stands
    for (const trace::StudySeries& series : measured.series)
      for (const trace::StudyPoint& point : series.points)
        if (point.failed < point.of) most = std::max(most, point.parameter);
    for (trace::StudySeries& series : study.series) {
      const double by_all = held_by_all(study, series.panel);
      for (trace::StudyPoint& point : series.points) {
        if (point.parameter <= by_all) point.mark = number(by_all) + " ×";
      }
      // Beyond the next decade all fall.
      std::erase_if(series.points,
                    [&](const auto& point) { return point.parameter > 10.01 * most; });
    }
    const auto held = [&](const char* panel) { return number(held_by_all(measured, panel)); };
    const std::string baumgarte = held("baumgarte, warm: 16 sweeps");
    const std::string projection = held("projection, warm: 8 + 8");
    return "Soft contacts carry " + held("soft, warm: 4 × (2 + 2)") +
           " times the mass at every height, Baumgarte and projection " + baumgarte +
           (projection == baumgarte ? "" : " and " + projection);
  });
  return study;
}

}  // namespace

trace::Study picture_solver(const trace::Study& measured) {
  return measured.form == trace::StudyForm::Map ? picture_map(measured) : picture_curves(measured);
}

}  // namespace contactscope
