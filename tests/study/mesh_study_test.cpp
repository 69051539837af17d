#include <gmock/gmock.h>

#include <algorithm>

#include "core/at.h"
#include "study/study.h"

namespace contactscope {
namespace {

std::vector<trace::Study> quick(RunStudy* run, int cases, int frames) {
  StudyOptions options;
  options.cases = cases;
  options.repetitions = 1;
  options.frames = frames;
  return run(options, [](int, int, const auto&) {});
}

const trace::StudySeries& line_of(const trace::Study& study, const std::string& panel,
                                  const std::string& method) {
  return *std::ranges::find_if(study.series, [&](const trace::StudySeries& series) {
    return series.method == method && series.panel == panel;
  });
}

TEST(TriangleStudy, TheExactTestIsNeverWrongAndAnEpsilonIsRightAtNoMoreThanItsOwnSize) {
  const std::vector<trace::Study> studies = quick(&study_triangles, 1500, 0);
  ASSERT_EQ(studies.size(), 1u);
  const trace::Study& study = studies[0];
  ASSERT_EQ(study.series.size(), 15u);
  const double none = study.resolution;
  for (const char* panel : {"triangles of 0.12 mm", "triangles of 1 m", "triangles of 8 km"}) {
    for (const trace::StudyPoint& point : line_of(study, panel, "exact").points)
      EXPECT_EQ(point.error, none) << panel << ", " << point.parameter;
    // Within a few units of one plane the sign of a float volume is a coin toss.
    EXPECT_GT(*line_of(study, panel, "float").points[0].error, 0.01) << panel;
    EXPECT_LT(*line_of(study, panel, "double").points[0].error,
              *line_of(study, panel, "float").points[0].error);
  }
  // A micrometre is a hundredth of such a triangle: whole gaps are called overlaps.
  const auto last = [&](const char* panel, const char* method) {
    return *line_of(study, panel, method).points.back().error;
  };
  EXPECT_GT(last("triangles of 0.12 mm", "float, epsilon 1e-6 m"),
            2 * last("triangles of 8 km", "float, epsilon 1e-6 m"));
}

TEST(MeshStudy, RefittedTreesGetWorseRebuiltOnesDoNotAndAutoStaysNear) {
  const std::vector<trace::Study> studies = quick(&study_meshes, 1, 12);
  ASSERT_EQ(studies.size(), 3u);
  for (const trace::StudySeries& series : joined(studies, &trace::Study::series)) {
    ASSERT_GE(series.points.size(), 5u);
    for (const trace::StudyPoint& point : series.points) {
      EXPECT_EQ(point.failed, 0) << series.method << " " << point.parameter;
      EXPECT_GT(*point.error, 0);
    }
  }
  const char* const kCost = "boxes that a small query is expected to test";
  const auto worst = [&](const char* method) {
    return *std::ranges::max(line_of(studies[1], kCost, method).points, {},
                             [](const trace::StudyPoint& point) { return *point.error; })
                .error;
  };
  EXPECT_GT(worst("refit"), 1.3 * worst("rebuild"));
  EXPECT_LT(worst("auto"), 1.31 * worst("rebuild"));
  // The slower, the more of a front stays: nearly all that is spared is what is above it.
  const char* const kMoving =
      "node pairs compared, micrometres a frame, one ball moves in the other";
  const auto& coherent = line_of(studies[1], kMoving, "coherent").points;
  const auto& from_roots = line_of(studies[1], kMoving, "from roots").points;
  EXPECT_LT(*coherent[0].error, 0.8 * *from_roots[0].error);
  EXPECT_LT(*coherent[3].error, 1.1 * *from_roots[3].error);
}

}  // namespace
}  // namespace contactscope
