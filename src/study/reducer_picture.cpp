#include <algorithm>

#include "core/at.h"
#include "study/picture.h"

namespace contactscope {
namespace {

using namespace told;

constexpr double kUsualPoints = 8;
const std::vector<Named> kOwn = {{"optimal", "best four by area alone"},
                                 {"optimal_deepest", "best four with the deepest point"},
                                 {"coherent", "near the last frame's choice"},
                                 {"area", "greedy, by area"}};
// Grey: what engines do.
const std::vector<Named> kOfEngines = {{"box3d", "Box3D"}, {"jolt", "Jolt"},   {"bullet", "Bullet"},
                                       {"ode", "ODE"},     {"physx", "PhysX"}, {"mjx", "MJX"}};

}  // namespace

trace::Study picture_reducers(const trace::Study& measured) {
  trace::Study study = measured;
  std::vector<Named> all = kOwn;
  all.insert(all.end(), kOfEngines.begin(), kOfEngines.end());
  keep_methods(study, all);
  // One number of points, so that a method is one marker: tables have the others, and the worst.
  for (trace::StudySeries& series : study.series) {
    series.quiet = std::ranges::find(kOwn, series.method, &Named::second) == kOwn.end();
    std::erase_if(series.points, [](const auto& point) { return point.parameter != kUsualPoints; });
    for (trace::StudyPoint& point : series.points) point.error_worst.reset();
  }
  show_least_times(study);
  study.shown =
      "Four points kept of eight; without the deepest a contact tells too small an overlap. Grey: "
      "as engines choose.";
  if (study.measure != "area") return study;
  drop_resolution(study);
  study.unit = trace::kShare;
  study.error = "share of the area that is lost,";
  tell(study, [&] {
    const auto lost = [&](const char* method) {
      return error_at(series_of(measured, method), kUsualPoints);
    };
    const auto of = [&](const Named& engine) { return lost(engine.first.c_str()); };
    const Named& closest = *std::ranges::min_element(kOfEngines, {}, of);
    const Named& farthest = *std::ranges::max_element(kOfEngines, {}, of);
    const double least = of(closest), most = of(farthest), own = lost("optimal_deepest");
    mark(study, kOwn[1].second, "", kUsualPoints, percent(own));
    for (trace::StudySeries& series : study.series) {
      const double share = error_at(series, kUsualPoints);
      if (series.method != kOwn[1].second)
        series.method += share > 0 ? ": " + percent(share) : ": nothing";
    }
    return "To keep the deepest of eight points costs " + percent(own) +
           " of the area; engines' ways cost " + percent(least) + " to " + percent(most);
  });
  return study;
}

}  // namespace contactscope
