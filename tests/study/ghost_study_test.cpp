#include <gtest/gtest.h>

#include <set>
#include <string>

#include "study/study.h"

namespace contactscope {
namespace {

// Right is nothing, but for wide cracks: at most 1 mm up and a thousandth slower.
TEST(GhostStudy, NothingIsThrownOrSlowedByOneSurface) {
  const std::set<std::string> right = {"half-space",     "one mesh",    "cracks of 1 nm",
                                       "cracks of 1 µm", "T-junctions", "two meshes",
                                       "boxes"};
  const auto results = study_ghosts({}, [](int, int, const std::string&) {});
  ASSERT_EQ(results.size(), 2u);
  int slides = 0;
  for (std::size_t measure = 0; measure < 2; ++measure) {
    for (const trace::StudySeries& series : results[measure].series) {
      for (const trace::StudyPoint& point : series.points) {
        ASSERT_TRUE(point.error);
        EXPECT_GE(*point.error, 0);
        // Vertices up to 0.2 mm above each other, and contacts may lean by a degree.
        if (series.method == "cracks of 0.1 mm, welded") {
          EXPECT_LT(*point.error, 0.01) << series.panel << " at " << point.parameter;
        }
        if (!right.contains(series.method)) continue;
        EXPECT_LT(*point.error, 0.001) << results[measure].measure << ": " << series.panel << " on "
                                       << series.method << " at " << point.parameter;
        ++slides;
      }
    }
  }
  EXPECT_EQ(slides, 2 * 4 * 7 * 4);  // shapes, floors, speeds
}

}  // namespace
}  // namespace contactscope
