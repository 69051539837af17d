#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "reduce/reducer.h"
#include "study/exploration.h"
#include "study/random_cases.h"
#include "study/study.h"

namespace contactscope {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

StudyOptions small(std::uint64_t seed = 1) {
  StudyOptions options;
  options.seed = seed;
  options.cases = 30;
  options.repetitions = 3;
  return options;
}

void ignore_progress(int /*done*/, int /*total*/, const std::string& /*what*/) {}

const std::vector<trace::Study>& results() {
  static const std::vector<trace::Study> studies = study_reducers(small(), ignore_progress);
  return studies;
}

std::vector<std::string> methods(const trace::Study& study) {
  std::vector<std::string> names;
  for (const trace::StudySeries& series : study.series) names.push_back(series.method);
  return names;
}

std::vector<std::optional<double>> errors(const trace::Study& study) {
  std::vector<std::optional<double>> list;
  for (const trace::StudySeries& series : study.series) {
    for (const trace::StudyPoint& point : series.points) {
      list.push_back(point.error);
      list.push_back(point.error_worst);
    }
  }
  return list;
}

TEST(ReducerStudy, ErrorsAreTheSameForAnyNumberOfThreads) {
  for (const int threads : {1, 2, 7}) {
    StudyOptions options = small();
    options.threads = threads;
    int steps = 0;
    const std::vector<trace::Study> same =
        study_reducers(options, [&](int done, int total, const std::string&) {
          EXPECT_EQ(done, ++steps);
          EXPECT_LE(done, total);
        });
    EXPECT_EQ(steps, 6 + 3) << "six numbers of points, three passes that are timed";
    ASSERT_EQ(same.size(), results().size());
    for (std::size_t i = 0; i < same.size(); ++i)
      EXPECT_EQ(errors(same[i]), errors(results()[i])) << same[i].measure;
  }
}

TEST(ReducerStudy, HasALineForEveryReducerButNone) {
  std::vector<std::string> wanted;
  for (const ReducerInfo& info : reducers()) {
    if (info.name != "none") wanted.push_back(info.name);
    if (info.remembers) wanted.push_back(info.name + ", first frame");
  }
  ASSERT_EQ(results().size(), 4u);
  EXPECT_EQ(results()[0].measure, "area");
  EXPECT_EQ(results()[1].measure, "wrench");
  EXPECT_EQ(results()[2].measure, "deepest");
  EXPECT_EQ(results()[3].measure, "flat");
  for (const trace::Study& study : results()) EXPECT_EQ(methods(study), wanted);
}

TEST(ReducerStudy, HasAPointForEachNumberOfContacts) {
  for (const trace::Study& study : results()) {
    for (const trace::StudySeries& series : study.series) {
      std::vector<double> parameters;
      for (const trace::StudyPoint& point : series.points) parameters.push_back(point.parameter);
      EXPECT_THAT(parameters, ElementsAre(5, 6, 8, 12, 16, 32)) << series.method;
    }
  }
}

TEST(ReducerStudy, ErrorsAreSharesAndTimesAreInOrder) {
  for (const trace::Study& study : results()) {
    for (const trace::StudySeries& series : study.series) {
      for (const trace::StudyPoint& point : series.points) {
        ASSERT_TRUE(point.error) << series.method;
        EXPECT_GE(*point.error, 0) << series.method;
        ASSERT_EQ(point.error_worst.has_value(), study.measure != "deepest") << series.method;
        const double worst = point.error_worst.value_or(1);
        EXPECT_LE(*point.error, worst) << series.method;
        EXPECT_LE(worst, study.measure == "wrench" ? 2 : 1) << series.method;
        EXPECT_EQ(point.of, 30);
        EXPECT_GT(point.nanoseconds.min, 0);
        EXPECT_LE(point.nanoseconds.min, point.nanoseconds.median);
        EXPECT_LE(point.nanoseconds.median, point.nanoseconds.max);
      }
    }
  }
}

TEST(ReducerStudy, AReducerWithoutAreaHasFailedAndLostAll) {
  int failed = 0;
  for (const trace::StudySeries& series : results()[0].series) {
    for (const trace::StudyPoint& point : series.points) {
      failed += point.failed;
      if (point.failed == 0) continue;
      EXPECT_EQ(point.error_worst, 1) << series.method;
      EXPECT_GE(*point.error, static_cast<double>(point.failed) / point.of) << series.method;
    }
  }
  EXPECT_GT(failed, 0);  // extremes, on narrow oblique patches
}

// coherent.cpp promises 95% of the reference, which is at least half of the best for four points.
// With ids to keep it loses more than without, and both are far from the bound.
TEST(ReducerStudy, CoherentIsMeasuredWithAndWithoutItsMemory) {
  const auto loss = [](const std::string& method) {
    const auto& all = results()[0].series;
    return std::ranges::find(all, method, &trace::StudySeries::method)->points;
  };
  const auto with = loss("coherent"), without = loss("coherent, first frame");
  double sum_with = 0, sum_without = 0;
  for (std::size_t i = 0; i < with.size(); ++i) {
    sum_with += *with[i].error;
    sum_without += *without[i].error;
    EXPECT_LE(*with[i].error_worst, 1 - 0.95 * 0.5);
    EXPECT_LE(*without[i].error_worst, 1 - 0.5);
  }
  EXPECT_GT(sum_with, sum_without);
}

TEST(NeighbouringFrame, HasTheSameIdsALittleAway) {
  std::mt19937_64 engine(8);
  const ContactPolygon now = elliptical_polygon(engine, 12);
  const ContactPolygon then = neighbouring_frame(now, 0.01, engine);
  Vec3f middle = Vec3f::Zero();
  for (const auto& point : now.points) middle += point.position / 12;
  const float long_arm = (now.points[0].position - middle).norm() * 5 + 1;
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(then.points[i].id, now.points[i].id);
    const Vec3f offset = then.points[i].position - now.points[i].position;
    EXPECT_GT(offset.norm(), 0);
    EXPECT_LE(offset.norm(), 0.01f * (now.points[i].position - middle).norm() + 1e-5f);
    EXPECT_NEAR(now.normal.dot(offset), 0, 1e-5f * long_arm);
    EXPECT_NEAR(then.points[i].separation / now.points[i].separation, 1, 0.0101);
  }
}

TEST(ReducerStudy, AreaLosesSomethingAndAnOptimalReducerNothing) {
  for (const trace::StudySeries& series : results()[0].series) {
    double sum = 0;
    for (const trace::StudyPoint& point : series.points) sum += *point.error;
    if (series.method == "area") {
      EXPECT_GT(sum, 0.01);
    }
    // Float may select the second best if two differ by less than its rounding.
    if (series.method == "optimal") {
      EXPECT_LT(sum, 1e-5);
    }
  }
}

/// None of them is the deepest, so area decides: greedy steps may only begin at a poor point.
TEST(ReducerStudy, TheBestFourOfEquallyDeepPointsAreKept) {
  const trace::Study& flat = results()[3];
  for (const trace::StudySeries& series : flat.series) {
    for (const trace::StudyPoint& point : series.points) {
      if (series.method.starts_with("optimal")) {
        EXPECT_LT(*point.error_worst, 2e-4) << series.method;
      }
      if (series.method == "coherent, first frame") {
        EXPECT_LT(*point.error_worst, 2e-4);
      }
      if (series.method == "coherent") {
        EXPECT_LT(*point.error_worst, 0.05 + 2e-4);
      }
      if (series.method == "area_deepest") {
        EXPECT_LT(*point.error, 0.05);
      }
    }
  }
}

TEST(ReducerStudy, OnlyDepthReducersNeverLoseTheDeepest) {
  for (const trace::StudySeries& series : results()[2].series) {
    const std::vector<std::string> always = {
        "area_deepest", "deepest", "bullet", "ode", "physx", "optimal_deepest", "physx_cluster"};
    const bool queries = std::ranges::find(always, series.method) != always.end();
    double sum = 0;
    for (const trace::StudyPoint& point : series.points) sum += *point.error;
    EXPECT_EQ(sum == 0, queries) << series.method << " loses " << sum;
  }
}

TEST(ReducerStudy, SameSeedGivesTheSameErrorsAndAnotherSeedOthers) {
  const std::vector<trace::Study> again = study_reducers(small(), ignore_progress);
  const std::vector<trace::Study> other = study_reducers(small(2), ignore_progress);
  for (std::size_t i = 0; i < results().size(); ++i) {
    EXPECT_EQ(errors(again[i]), errors(results()[i]));
    EXPECT_NE(errors(other[i]), errors(results()[i]));
  }
}

TEST(ReducerStudy, ProgressCountsToItsTotalAndMayStopTheStudy) {
  int last = 0, most = 0;
  study_reducers(small(), [&](int done, int total, const std::string& what) {
    EXPECT_EQ(done, last + 1);
    EXPECT_FALSE(what.empty());
    last = done;
    most = total;
  });
  EXPECT_EQ(last, most);
  EXPECT_THROW(
      study_reducers(small(), [](int, int, const std::string&) { throw std::runtime_error("no"); }),
      std::runtime_error);
}

TEST(StudyContext, NamesProcessorCompilerBuildAndDate) {
  const trace::StudyContext context = study_context("float");
  EXPECT_THAT((std::vector<std::string>{context.cpu, context.compiler, context.build_type}),
              Each(Not("")));
  EXPECT_THAT(context.date, testing::MatchesRegex("20..-..-..T..:..:..Z"));
  EXPECT_EQ(context.scalar, "float");
}

TEST(Studies, AreNamedAndSummarised) {
  ASSERT_FALSE(studies().empty());
  EXPECT_EQ(studies().front().name, "reducers");
  for (const StudyInfo& info : studies()) EXPECT_FALSE(info.summary.empty()) << info.name;
}

/// Shares of the best area, and percent of polygons with the deepest point kept, at 8 and 16
/// points. Measured with the engines' own programs on other elliptical polygons.
struct EngineMeans {
  const char* name;
  double area[2], deepest[2];
};
constexpr EngineMeans kEngineMeans[] = {
    {"box3d", {0.960, 0.943}, {65, 35}},
    {"box3d_mesh", {0.971, 0.976}, {68, 37}},
    {"jolt", {0.916, 0.934}, {76, 46}},
    {"bullet", {0.929, 0.809}, {100, 100}},
    {"ode", {0.943, 0.941}, {100, 100}},
    {"physx", {0.938, 0.950}, {100, 100}},
    {"physx_cluster", {0.854, 0.756}, {100, 100}},
    {"newton", {0.968, 0.976}, {67, 37}},
    {"mjx", {0.828, 0.828}, {62, 38}},
};

// The study's polygons were not chosen to suit the engines: their aspect goes up to 5, their depth
// to twice the mean. The bands are wider than on those of tests/support, where they are 0.03 and 5.
TEST(EllipticalPolygon, ReducersKeepAboutWhatTheirEnginesKeep) {
  constexpr double kAreaBand = 0.08, kDeepestBand = 13;
  constexpr int kPolygons = 1000;
  for (const int column : {0, 1}) {
    std::mt19937_64 engine(11);
    std::vector<double> area(std::size(kEngineMeans)), deepest(std::size(kEngineMeans));
    for (int i = 0; i < kPolygons; ++i) {
      const ContactPolygon polygon = elliptical_polygon(engine, column == 0 ? 8 : 16);
      std::vector<ContactPoint<double>> points;
      for (const ContactPoint<float>& p : polygon.points)
        points.push_back({p.position.cast<double>(), p.separation, p.id});
      const Vec3d normal = polygon.normal.cast<double>().normalized();
      for (std::size_t e = 0; e < area.size(); ++e) {
        const KeptIndices kept =
            reduce<double>(find_reducer(kEngineMeans[e].name), points, normal, {});
        const trace::ReducerAnswer quality =
            measure_reduction(points, normal, {kept.begin(), kept.size()}, 4);
        area[e] += quality.area_ratio / kPolygons;
        deepest[e] += quality.deepest_kept ? 100.0 / kPolygons : 0;
      }
    }
    for (std::size_t e = 0; e < area.size(); ++e) {
      const EngineMeans& means = kEngineMeans[e];
      EXPECT_NEAR(area[e], means.area[column], kAreaBand) << means.name << ", column " << column;
      EXPECT_NEAR(deepest[e], means.deepest[column],
                  means.deepest[column] == 100 ? 1e-9 : kDeepestBand)
          << means.name << ", column " << column;
    }
  }
}

TEST(EllipticalPolygon, IsConvexFlatAndInOrder) {
  std::mt19937_64 engine(7);
  for (int trial = 0; trial < 200; ++trial) {
    const ContactPolygon polygon = elliptical_polygon(engine, 8);
    ASSERT_EQ(polygon.points.size(), 8u);
    const Vec3d normal = polygon.normal.cast<double>();
    EXPECT_NEAR(normal.norm(), 1, 1e-6);
    const auto at = [&](std::size_t i) -> Vec3d {
      return polygon.points[i % 8].position.cast<double>();
    };
    for (std::size_t i = 0; i < 8; ++i) {
      EXPECT_NEAR(normal.dot(at(i) - at(0)), 0, 1e-5);
      const Vec3d ahead = at(i + 1) - at(i);
      const Vec3d after = at(i + 2) - at(i + 1);
      EXPECT_GT(normal.dot(ahead.cross(after)), 0);
      EXPECT_LT(polygon.points[i].separation, 0.001f);
    }
  }
}

}  // namespace
}  // namespace contactscope
