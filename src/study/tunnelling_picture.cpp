#include <algorithm>
#include <string_view>

#include "core/at.h"
#include "study/picture.h"

namespace contactscope {
namespace {

using namespace record;

constexpr double kUsualSpeed = 10;  // m/s
constexpr const char* kAtEnds = "tested at ends of steps";
constexpr const char* kWithMargin = "with a speculative margin of 2 cm";
const std::vector<std::string> kSwept = {"swept bounding sphere", "conservative advancement",
                                         "time of impact"};

std::string result_of(const trace::Study& measured, trace::Study& study) {
  const auto at_usual = [&](const char* method) {
    return percent(error_at(series_of(measured, method, "spheres, a wall of 1 cm"), kUsualSpeed));
  };
  double swept = 0;
  for (const trace::StudySeries& series : measured.series)
    if (std::ranges::find(kSwept, series.method) != kSwept.end())
      for (const trace::StudyPoint& point : series.points)
        swept = std::max(swept, point.error.value_or(0));
  for (const auto& [method, name] :
       {Named{"discrete", kAtEnds}, Named{"speculative margin of 2 cm", kWithMargin}})
    mark(study, name, "", kUsualSpeed, at_usual(method.c_str()));
  return "At " + number(kUsualSpeed) + " m/s " + at_usual("discrete") +
         " of the spheres pass a wall of 1 cm; of those that are swept " +
         (swept > 0 ? "up to " + percent(swept) : "none");
}

}  // namespace

trace::Study picture_tunnelling(const trace::Study& measured) {
  trace::Study study = measured;
  keep_methods(study, {{"discrete", kAtEnds},
                       {"speculative margin of 2 cm", kWithMargin},
                       {kSwept[0], kSwept[0]},
                       {kSwept[1], kSwept[1]},
                       {kSwept[2], kSwept[2]}});
  const Named boxes = {"boxes, a wall of 1 cm", "Boxes of about 8 cm"};
  const Named rods = {"spinning rods, a wall of 1 cm", "Spinning rods of 62 cm"};
  // For passing, boxes and rods look the same; tables contain them.
  if (study.measure == "passed")
    keep_panels(study, {{"spheres, a wall of 1 cm", ""}});
  else
    keep_panels(study, {{"spheres, a wall of 1 cm", "Spheres of 10 cm"}, boxes, rods});
  for (trace::StudySeries& series : study.series) series.parameter = "m/s";
  if (study.measure != "passed") return study;
  join_equal(study);
  study.unit = trace::kShare;
  // Explain why some pass that are found in the wall at the end of a step.
  study.shown =
      "Up: share of spheres 10 cm wide that pass, at 60 steps a second. A sphere found in the wall "
      "with its middle beyond is pushed out there: it has passed";
  for (trace::StudySeries& series : study.series)
    if (series.method == listed(kSwept)) series.method = "swept, in three ways";
  // Here all bullets are spheres.
  constexpr std::string_view kBullet = "bullet", kSphere = "sphere";
  for (std::size_t i = 0; (i = study.reference.find(kBullet, i)) != std::string::npos;
       i += kSphere.size())
    study.reference.replace(i, kBullet.size(), kSphere);
  report(study, [&] { return result_of(measured, study); });
  return study;
}

}  // namespace contactscope
