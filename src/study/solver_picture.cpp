#include <algorithm>

#include "core/at.h"
#include "study/picture.h"
#include "study/solver_energy.h"

namespace contactscope {
namespace {

using namespace record;

constexpr double kUsualSubsteps = 8;
constexpr const char* kSubsteps = "More sub-steps, an iteration each";
const std::vector<Named> kWarm = {{"soft, warm", "soft contacts"},
                                  {"projection, warm", "projection"},
                                  {"baumgarte, warm", "Baumgarte"}};

constexpr const char* kColdPanel = ", no warm starting";

/// "the static solution; a call is a frame; 336 stacks, ...; seed 1" without the middle part.
std::string short_reference(const std::string& reference) {
  const std::size_t first = reference.find(';'), last = reference.rfind(';');
  return first == std::string::npos ? reference
                                    : reference.substr(0, first) + reference.substr(last);
}

/// Speed over the number of sub-steps, from the first at which every stack stands.
void show_jitter(const trace::Study& measured, trace::Study& study) {
  keep_panels(study, {{kSubsteps, ""}});
  double last_fall = 0;
  each_point(study, [&](const trace::StudyPoint& point) {
    if (point.failed > 0) last_fall = std::max(last_fall, point.parameter);
  });
  name_parameter(study, "sub-steps of a frame, an iteration each");
  for (trace::StudySeries& series : study.series)
    std::erase_if(series.points, [&](const auto& point) { return point.parameter <= last_fall; });
  drop_worst(study);
  scale_errors(study, 1000);
  study.form = trace::StudyForm::Curves;
  study.shown = "Up: mean speed of the fastest box in the third second, mm/s";
  report(study, [&] {
    const auto speed = [&](const char* method) {
      return error_at(series_of(measured, method, kSubsteps), kUsualSubsteps);
    };
    const auto spelled = [](double metres) { return number(1000 * metres) + " mm/s"; };
    const double soft = speed("soft, warm"), projection = speed("projection, warm"),
                 baumgarte = speed("baumgarte, warm");
    // Show the steadier of the two others; tables contain both.
    const double slower = std::min(projection, baumgarte);
    const std::string rival = kWarm[projection < baumgarte ? 1 : 2].second;
    std::erase_if(study.series, [&](const trace::StudySeries& series) {
      return series.method != kWarm[0].second && series.method != rival;
    });
    mark(study, kWarm[0].second, "", kUsualSubsteps, spelled(soft));
    mark(study, rival, "", kUsualSubsteps, spelled(slower));
    return "With " + number(kUsualSubsteps) + " sub-steps a resting stack of ten moves at " +
           spelled(soft) + " on soft contacts, at " + spelled(slower) + " with " + rival;
  });
}

trace::Study picture_curves(const trace::Study& measured) {
  trace::Study study = measured;
  keep_methods(study, kWarm);  // tables contain the ones without warm starting
  study.reference = short_reference(study.reference);
  if (study.measure == "jitter") {
    show_jitter(measured, study);
    return study;
  }
  // Group series by panel.
  std::ranges::stable_sort(study.series, std::ranges::less(), &trace::StudySeries::panel);
  study.failed = "fell";
  study.shown = "Up: mean " + study.error +
                ". Along a line: 1 to 64 sub-steps. Band: the least to the greatest time.";
  return study;
}

/// The largest ratio up to which every stack of a panel stands; 0 if even equal boxes fall.
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
  }
  name_parameter(study, "mass of the top / others");
  study.shown = "Colour: " + study.error + ", at 16 sweeps a frame";
  study.failed = "fell";
  study.reference = short_reference(study.reference);
  if (study.measure != "map") return study;
  study.unit = trace::kShare;
  study.shown = "Colour: share of the stacks that fall, at 16 sweeps a frame";
  // Without warm starting all hold less; tables contain them.
  std::erase_if(study.series, [](const trace::StudySeries& series) {
    return series.panel.ends_with(kColdPanel);
  });
  report(study, [&] {
    double most = 0;  // largest ratio at which any stack stands
    for (const trace::StudySeries& series : measured.series)
      for (const trace::StudyPoint& point : series.points)
        if (point.failed < point.of) most = std::max(most, point.parameter);
    for (trace::StudySeries& series : study.series) {
      const double by_all = held_by_all(study, series.panel);
      for (trace::StudyPoint& point : series.points) {
        if (point.parameter <= by_all) point.mark = number(by_all) + " ×";
      }
      // All fall beyond this.
      std::erase_if(series.points,
                    [&](const auto& point) { return point.parameter > 1.01 * most; });
    }
    const auto held = [&](const char* panel) { return number(held_by_all(measured, panel)); };
    const std::string baumgarte = held("baumgarte, warm: 16 sweeps");
    const std::string projection = held("projection, warm: 8 + 8");
    return "Soft contacts carry a top box " + held("soft, warm: 4 × (2 + 2)") +
           " times as heavy at every height, Baumgarte and projection " + baumgarte +
           (projection == baumgarte ? "" : " and " + projection);
  });
  return study;
}

trace::Study picture_energy(const trace::Study& measured) {
  trace::Study study = measured;
  const double most = 0.01;
  bool holds = true;
  for (trace::StudySeries& series : study.series) {
    const bool all_kept = series.method == kAllPushKept;
    for (trace::StudyPoint& point : series.points) {
      point.error = point.error_worst;
      point.error_worst.reset();
      holds = holds && (all_kept || point.error.value_or(1) <= most);
    }
  }
  study.shown = "Up: energy gained, of that at the start; the worst of twenty scenes";
  report(study, [&] {
    return holds ? std::string(
                       "No position correction adds more than 1 % of energy in any of twenty ") +
                       "scenes; Baumgarte would, if all of its push were kept"
                 : std::string("A position correction adds more than 1 % of energy");
  });
  return study;
}

}  // namespace

trace::Study picture_solver(const trace::Study& measured) {
  if (measured.measure == "energy") return picture_energy(measured);
  return measured.form == trace::StudyForm::Map ? picture_map(measured) : picture_curves(measured);
}

}  // namespace contactscope
