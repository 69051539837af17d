#include <algorithm>

#include "core/at.h"
#include "study/picture.h"

namespace contactscope {
namespace {

using namespace told;

constexpr double kUsualPoints = 8;
const std::vector<Named> kOwn = {{"optimal", "best four"},
                                 {"optimal_deepest", "best four with the deepest"},
                                 {"coherent", "staying with the frame before"},
                                 {"area", "greedy, by area"}};
const std::vector<Named> kRandom = {{"random", "at random"}};
// Grey: what engines do.
const std::vector<Named> kOfEngines = {{"box3d", "Box3D"}, {"jolt", "Jolt"},   {"bullet", "Bullet"},
                                       {"ode", "ODE"},     {"physx", "PhysX"}, {"mjx", "MJX"}};

}  // namespace

trace::Study picture_reducers(const trace::Study& measured) {
  trace::Study study = measured;
  std::vector<Named> all = kOwn;
  all.insert(all.end(), kOfEngines.begin(), kOfEngines.end());
  all.insert(all.end(), kRandom.begin(), kRandom.end());
  keep_methods(study, all);
  for (trace::StudySeries& series : study.series) {
    series.quiet = std::ranges::find(kOwn, series.method, &Named::second) == kOwn.end();
    for (trace::StudyPoint& point : series.points) point.error_worst.reset();  // tables have it
  }
  show_least_times(study);
  study.shown =
      "Four points kept of 5, 6, 8, 12, 16 and 32 along a line. Grey: as engines choose. Thick: "
      "nothing else is both as fast and as close.";
  if (study.measure != "area") return study;
  tell(study, [&] {
    const auto lost = [&](const char* method) {
      return error_at(series_of(measured, method), kUsualPoints);
    };
    const auto of = [&](const Named& engine) { return lost(engine.first.c_str()); };
    const Named& closest = *std::ranges::min_element(kOfEngines, {}, of);
    const Named& farthest = *std::ranges::max_element(kOfEngines, {}, of);
    const double least = of(closest), most = of(farthest), own = lost("optimal_deepest");
    mark(study, kOwn[1].second, "", kUsualPoints, "8 points: " + percent(own));
    mark(study, closest.second, "", kUsualPoints, percent(least));
    mark(study, farthest.second, "", kUsualPoints, percent(most));
    return "Of eight points the best four with the deepest lose " + percent(own) +
           " of the area, engines' ways " + percent(least) + " to " + percent(most);
  });
  return study;
}

}  // namespace contactscope
