#include <algorithm>

#include "core/at.h"
#include "study/picture.h"

namespace contactscope {
namespace {

using namespace record;

constexpr double kUsualPoints = 8;
const std::vector<Named> kOwn = {{"optimal_deepest", "best four with the deepest"},
                                 {"area_deepest", "greedy with the deepest"},
                                 {"optimal", "best four by area alone"},
                                 {"coherent", "near the last frame's choice"},
                                 {"area", "greedy, by area"}};
// Drawn in grey: reducers of engines.
const std::vector<Named> kOfEngines = {{"bullet", "Bullet"}, {"ode", "ODE"},   {"physx", "PhysX"},
                                       {"box3d", "Box3D"},   {"jolt", "Jolt"}, {"mjx", "MJX"}};
// The first ones of each list always keep the deepest point. The others drop it to gain area, so
// compare only the first ones; tables contain all.
constexpr std::size_t kOwnWithDeepest = 2, kEnginesWithDeepest = 3;

std::vector<Named> first_of(const std::vector<Named>& named, std::size_t count) {
  return {named.begin(), named.begin() + static_cast<std::ptrdiff_t>(count)};
}

}  // namespace

trace::Study picture_reducers(const trace::Study& measured) {
  trace::Study study = measured;
  const bool is_of_area = study.measure == "area", is_flat = study.measure == "flat";
  std::vector<Named> all = first_of(kOwn, is_of_area ? kOwnWithDeepest : kOwn.size());
  const std::vector<Named> engines =
      first_of(kOfEngines, is_of_area ? kEnginesWithDeepest : kOfEngines.size());
  all.insert(all.end(), engines.begin(), engines.end());
  keep_methods(study, all);
  // One number of points, so that a method is one marker; tables contain the others and the worst.
  for (trace::StudySeries& series : study.series) {
    series.quiet = std::ranges::find(kOwn, series.method, &Named::second) == kOwn.end();
    std::erase_if(series.points, [](const auto& point) { return point.parameter != kUsualPoints; });
    for (trace::StudyPoint& point : series.points) point.error_worst.reset();
  }
  show_least_times(study);
  study.shown = "Four points kept of eight. Grey: as engines choose.";
  if (!is_of_area && !is_flat) return study;
  study.shown =
      is_flat ? "Four points kept of eight that are equally deep. Grey: as engines choose."
              : "All keep the deepest of eight points and three more. Grey: as engines choose.";
  drop_resolution(study);
  study.unit = trace::kShare;
  study.error = "share of the area that is lost";
  report(study, [&] {
    const auto lost = [&](const char* method) {
      return error_at(series_of(measured, method), kUsualPoints);
    };
    const auto of = [&](const Named& engine) { return lost(engine.first.c_str()); };
    std::vector<Named> by_loss = engines;
    std::ranges::stable_sort(by_loss, {}, of);
    std::vector<std::string> names;
    for (const Named& engine : by_loss) names.push_back(engine.second);
    const double least = of(by_loss.front()), most = of(by_loss.back());
    const double own = error_at(series_of(study, kOwn[0].second), kUsualPoints);
    for (trace::StudySeries& series : study.series) {
      const std::string record = series.method + ": " + percent(error_at(series, kUsualPoints));
      if (series.method != kOwn[0].second) {
        series.method = record;
        continue;
      }
      mark(study, series.method, "", kUsualPoints, record);
      series.method.clear();  // the mark contains it
    }
    const std::string best = is_flat ? "Where all points are equally deep, the default loses "
                                     : "The best four points with the deepest lose ";
    return best + percent(own) + " of the area, the choices of " + listed(names) + " " +
           percent(least) + " to " + percent(most);
  });
  return study;
}

}  // namespace contactscope
