#include "study/limits_study.h"

#include <gmock/gmock.h>

#include <set>

#include "study/study.h"

namespace contactscope {
namespace {

using testing::ElementsAre;

const std::vector<trace::Study>& small_study() {
  static const std::vector<trace::Study> studies = [] {
    StudyOptions options;
    options.cases = 2;
    options.repetitions = 1;
    return study_limits(options, [](int, int, const std::string&) {});
  }();
  return studies;
}

TEST(LimitsStudy, HasCurvesAndMaps) {
  std::vector<std::string> measures;
  for (const trace::Study& study : small_study()) {
    measures.push_back(study.measure);
    EXPECT_EQ(study.study, "stability");
    EXPECT_EQ(study.form, measures.size() == 1 ? trace::StudyForm::Curves : trace::StudyForm::Map);
  }
  EXPECT_THAT(measures,
              ElementsAre("sweeps", "pairs", "tilt_scale", "distance_overlap", "aspect_angle"));
}

TEST(LimitsStudy, ASeriesASweepAndScalar) {
  const trace::Study& sweeps = small_study().front();
  std::set<std::pair<std::string, std::string>> seen;
  for (const trace::StudySeries& series : sweeps.series) {
    EXPECT_TRUE(seen.emplace(series.panel, series.method).second);
    double before = 0;
    for (const trace::StudyPoint& point : series.points) {
      EXPECT_GT(point.parameter, before);
      before = point.parameter;
      EXPECT_GT(point.nanoseconds.min, 0);
    }
  }
  for (const LimitSweep& sweep : limit_sweeps()) {
    for (const char* method : {"float", "double", "float, unrounded", "double, unrounded"}) {
      EXPECT_TRUE(seen.contains({sweep.name, method})) << sweep.name << ' ' << method;
    }
  }
}

TEST(LimitsStudy, EveryMapIsFullAndItsRowsGrow) {
  for (std::size_t i = 1; i < small_study().size(); ++i) {
    const trace::Study& map = small_study()[i];
    const trace::StudySeries* before = nullptr;
    for (const trace::StudySeries& series : map.series) {
      if (before != nullptr && before->panel == series.panel) {
        EXPECT_EQ(series.points.size(), before->points.size());
        EXPECT_GT(series.row.value_or(1), before->row.value_or(0));
      }
      before = &series;
    }
    EXPECT_EQ(map.series.front().row.has_value(), map.measure != "pairs");
  }
}

TEST(LimitsStudy, ProgressEndsWithItsTotal) {
  StudyOptions options;
  options.cases = 1;
  options.repetitions = 1;
  int last = 0, total = -1;
  study_limits(options, [&](int done, int of, const std::string&) {
    EXPECT_EQ(done, last + 1);
    last = done;
    total = of;
  });
  EXPECT_EQ(last, total);
}

TEST(LimitsStudy, TheSameSeedGivesTheSameErrorsForAnyNumberOfThreads) {
  for (const int threads : {1, 3}) {
    StudyOptions options;
    options.cases = 2;
    options.repetitions = 1;
    options.threads = threads;
    const auto studies = study_limits(options, [](int, int, const std::string&) {});
    ASSERT_EQ(studies.size(), small_study().size());
    for (std::size_t i = 0; i < studies.size(); ++i) {
      for (std::size_t s = 0; s < studies[i].series.size(); ++s) {
        const auto& points = studies[i].series[s].points;
        for (std::size_t p = 0; p < points.size(); ++p) {
          EXPECT_EQ(points[p].error_worst, small_study()[i].series[s].points[p].error_worst);
          EXPECT_EQ(points[p].failed, small_study()[i].series[s].points[p].failed);
        }
      }
    }
  }
}

}  // namespace
}  // namespace contactscope
