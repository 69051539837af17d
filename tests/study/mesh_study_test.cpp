#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <string>

#include "study/plain_triangle_test.h"
#include "study/study.h"
#include "study_lines.h"
#include "support/exact_triangles.h"

namespace contactscope {
namespace {

using test::line_of;

std::vector<trace::Study> quick(RunStudy* run, int cases, int frames) {
  StudyOptions options;
  options.cases = cases;
  options.repetitions = 1;
  options.frames = frames;
  return run(options, [](int, int, const auto&) {});
}

TEST(TriangleStudy, TheExactTestIsNeverWrongAndAnEpsilonIsRightAtNoMoreThanItsOwnSize) {
  const std::vector<trace::Study> studies = quick(&study_triangles, 1500, 0);
  ASSERT_EQ(studies.size(), 2u);
  const trace::Study& study = studies[0];
  ASSERT_EQ(study.series.size(), 15u);
  const double none = study.resolution;
  for (const char* panel : {"triangles of 0.12 mm", "triangles of 1 m", "triangles of 8 km"}) {
    for (const trace::StudyPoint& point : line_of(study, panel, "exact").points)
      EXPECT_EQ(point.error, none) << panel << ", " << point.parameter;
    // Within a few units of one plane, the sign of a float volume is a coin toss.
    EXPECT_GT(*line_of(study, panel, "float").points[0].error, 0.01) << panel;
    EXPECT_LT(*line_of(study, panel, "double").points[0].error,
              *line_of(study, panel, "float").points[0].error);
  }
  // A micrometre is a hundredth of such a triangle: whole separations are reported as overlaps.
  const auto last = [&](const char* panel, const char* method) {
    return *line_of(study, panel, method).points.back().error;
  };
  EXPECT_GT(last("triangles of 0.12 mm", "float, epsilon 1e-6 m"),
            2 * last("triangles of 8 km", "float, epsilon 1e-6 m"));
}

template <class S> Triangle<double> in_double(const Triangle<S>& triangle) {
  return {triangle[0].template cast<double>(), triangle[1].template cast<double>(),
          triangle[2].template cast<double>()};
}

template <class S> void expect_exact_answers() {
  using enum TriangleOverlapKind;
  for (int i = -24; i < 24; i += 3) {
    for (int j = -24; j < 24; j += 3) {
      const auto [a, b] = nearly_touching<S>(i, j);
      const TriangleOverlapKind expected = i == j ? Touching : i > j ? None : Proper;
      EXPECT_EQ(test::exact_triangle_overlap(in_double(a), in_double(b)).kind, expected);
      EXPECT_EQ(triangle_overlap_kind(a, b), expected);
    }
  }
}

TEST(TriangleStudy, ACornerMovedByLastBitsIsWhereTheMapHasIt) {
  expect_exact_answers<float>();
  expect_exact_answers<double>();
}

TEST(TriangleStudy, TheMapMarksWhatPlainSignsGetWrong) {
  const trace::Study map = triangle_answers();
  ASSERT_EQ(map.series.size(), 3u * 48u);
  std::map<std::string, int> wrong;
  for (const trace::StudySeries& row : map.series) {
    ASSERT_EQ(row.points.size(), 48u);
    for (const trace::StudyPoint& point : row.points) {
      const double right = point.parameter == *row.row ? 1 : point.parameter > *row.row ? 0 : 2;
      EXPECT_EQ(point.failed, point.error == right ? 0 : 1);
      wrong[row.panel] += point.failed;
    }
  }
  EXPECT_GT(wrong["float"], 200);
  EXPECT_GT(wrong["double"], 200);
  EXPECT_EQ(wrong["exact"], 0);
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
  // With slower motion, more of a front persists: nearly everything above it is saved.
  const char* const kMoving =
      "node pairs compared, micrometres a frame, one ball moves in the other";
  const auto& coherent = line_of(studies[1], kMoving, "coherent").points;
  const auto& from_roots = line_of(studies[1], kMoving, "from roots").points;
  EXPECT_LT(*coherent[0].error, 0.8 * *from_roots[0].error);
  EXPECT_LT(*coherent[3].error, 1.1 * *from_roots[3].error);
}

}  // namespace
}  // namespace contactscope
