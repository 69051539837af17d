#include "study/picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/study.h"

namespace contactscope {
namespace {

using testing::HasSubstr;

trace::StudySeries line(const std::string& method, const std::vector<double>& errors,
                        const std::string& panel = {}) {
  trace::StudySeries series{method, {}, panel};
  double parameter = 1;
  for (const double error : errors) {
    series.points.push_back({parameter, error, error, {100 * parameter, 90, 120}, 0, 10});
    parameter *= 2;
  }
  return series;
}

TEST(ReportInput, NumbersHaveTwoDigitsAndNoExponent) {
  EXPECT_EQ(record::number(0), "0");
  EXPECT_EQ(record::number(3.456), "3.5");
  EXPECT_EQ(record::number(9.96), "10");
  EXPECT_EQ(record::number(-843), "−840");
  EXPECT_EQ(record::number(1.354, 3), "1.35");
  EXPECT_EQ(record::number(0.00012), "0.00012");
  EXPECT_EQ(record::percent(0.8123), "81 %");
  EXPECT_EQ(record::percent(0.0686), "6.9 %");
  EXPECT_EQ(record::percent(1), "100 %");
  EXPECT_EQ(record::count(1e6), "1,000,000");
  EXPECT_EQ(record::percent(0.575), "58 %");
  EXPECT_EQ(record::percent(0.685), "69 %");
  EXPECT_EQ(record::length(0.00008), "80 µm");
  EXPECT_EQ(record::length(0.69), "69 cm");
  EXPECT_EQ(record::duration(5.57e9), "5.6 s");
  EXPECT_EQ(record::power(1e-5), "10⁻⁵");
  EXPECT_EQ(record::power(5.4e-5), "5.4 × 10⁻⁵");
  EXPECT_EQ(record::power(0.02), "0.02");
}

TEST(ReportInput, KeptMethodsHaveNamesAndTheLooksOfTheWholeStudy) {
  trace::Study study;
  study.series = {line("a", {1}), line("b", {2}), line("c", {3})};
  const record::PictureRow row{.methods = {{"c", "third"}, {"a", "first", record::kQuiet}}};
  study = record::drawn_by(row, study);
  ASSERT_EQ(study.series.size(), 2u);
  EXPECT_EQ(study.series[0].method, "third");
  EXPECT_EQ(study.series[0].look, 2);
  EXPECT_EQ(study.series[1].method, "first");
  EXPECT_EQ(study.series[1].look, 0);
  EXPECT_FALSE(study.series[0].quiet);
  EXPECT_TRUE(study.series[1].quiet);
}

TEST(ReportInput, ARowChangesWhatItNamesAndLeavesTheRest) {
  trace::Study study;
  study.title = "measured";
  study.error = "way";
  study.unit = "m";
  study.resolution = 0.25;
  study.reference = "a; many; and seed 1";
  study.series = {line("peer 1.2", {0.125, 0.5}, "p"), line("own", {1, 2}, "p"),
                  line("own", {3, 4}, "q")};
  const record::PictureRow row{
      .methods = {{"peer*", "peer"}, {"own", "own"}},
      .panels = {{"p", ""}},
      .parameter = "frames",
      .unit = "mm",
      .shown = "Up: {error}",
      .options = {.drop_resolution = true, .scale = 1000, .left_out = {";", ";"}}};
  const trace::Study drawn = record::drawn_by(row, study);
  EXPECT_EQ(drawn.title, "measured");
  EXPECT_EQ(drawn.error, "way");
  EXPECT_EQ(drawn.unit, "mm");
  EXPECT_EQ(drawn.shown, "Up: way");
  EXPECT_EQ(drawn.reference, "a; and seed 1");
  EXPECT_EQ(drawn.resolution, 250);
  ASSERT_EQ(drawn.series.size(), 2u);
  EXPECT_EQ(drawn.series[0].method, "peer");
  EXPECT_EQ(drawn.series[0].parameter, "frames");
  EXPECT_EQ(drawn.series[0].points[0].error, 0) << "within the resolution";
  EXPECT_EQ(drawn.series[0].points[1].error, 500);
  EXPECT_EQ(drawn.series[1].points[1].error_worst, 2000);
}

TEST(ReportInput, LinesAreJoinedWhereTheyAreOneInEveryPanel) {
  trace::Study study;
  study.series = {line("some", {0.1, 0.2}, "p"), line("none", {0, 0}, "p"),
                  line("neither", {0, 0}, "p"),  line("some", {0, 0}, "q"),
                  line("none", {0, 0}, "q"),     line("neither", {0, 0}, "q")};
  const record::PictureRow row{.result = [](record::Picture& plot) {
    plot.join_equal();
    return std::string();
  }};
  study = record::drawn_by(row, study);
  ASSERT_EQ(study.series.size(), 4u);
  EXPECT_EQ(study.series[0].method, "some");
  EXPECT_EQ(study.series[1].method, "none and neither");
}

TEST(Picture, TheTitleIsTheResultOfTheRun) {
  trace::Study study;
  study.study = "tunnelling";
  study.measure = "passed";
  study.title = "Bullets that pass a wall";
  for (const char* method : {"discrete", "speculative margin of 2 cm", "swept bounding sphere",
                             "conservative advancement", "time of impact"})
    study.series.push_back(line(method, {0, 0}, "spheres, a wall of 1 cm"));
  study.series[0].points[1] = {10, 0.4, 0.4, {}, 0, 10};
  study.series[1].points[1] = {10, 0.3, 0.3, {}, 0, 10};
  EXPECT_EQ(picture_of(study).title,
            "At 10 m/s 40 % of the spheres pass a wall of 1 cm; of those that are swept none");
  const trace::Study record = picture_of(study);
  EXPECT_EQ(record.series[0].points[1].mark, "40 %");
  EXPECT_EQ(record.series[1].points[1].mark, "30 %");
  EXPECT_EQ(record.series[0].points[0].mark, "") << "the title does not speak of it";
  study.series[3].points[1].error = 0.01;
  EXPECT_THAT(picture_of(study).title, HasSubstr("swept up to 1 %"));
}

TEST(Picture, TheSmallestFlipDistanceIsShownWithItsUnit) {
  trace::Study study;
  study.study = "flip_distance";
  study.measure = "way";
  study.error = "smallest way";
  study.unit = "m";
  study.series = {line("crate-floor", {0.01, 0.004}, "hull/one"),
                  line("lid-crate", {0.02, 0.002}, "hull/two")};
  const trace::Study record = picture_of(study);
  EXPECT_EQ(record.title,
            "At the least a way of 2 mm gives lid-crate other points, in frame 2 of hull/two");
  EXPECT_EQ(record.series[1].points[1].mark, "2 mm");
  EXPECT_THAT(record.shown, HasSubstr(", mm"));
  EXPECT_EQ(record.series[0].points[1].error, 4);
  study.measure = "last_places";
  study.unit = "";
  for (trace::StudySeries& series : study.series)
    for (trace::StudyPoint& point : series.points) *point.error *= 1e3;
  EXPECT_THAT(picture_of(study).title, HasSubstr("2 last places of a coordinate"));
}

TEST(Picture, TimesAreDividedByThoseOfTheSamePanel) {
  trace::Study study;
  study.study = "mesh_mesh";
  study.measure = "motion";
  study.series = {line("from roots", {4, 4}, "beside"), line("coherent", {1, 5}, "beside"),
                  line("from roots", {8, 8}, "inside"), line("coherent", {6, 4}, "inside")};
  const trace::Study record = picture_of(study);
  EXPECT_THAT(record.title, HasSubstr("takes 25 % to 130 % of the time"));
  ASSERT_EQ(record.series.size(), 2u);
  EXPECT_EQ(record.series[1].method, "inside");
  EXPECT_EQ(record.series[1].points[0].error, 0.75);
  EXPECT_NE(record.series[0].look, record.series[1].look);
}

TEST(Picture, TheSlowestFieldIsInTheTitleAndEachTimeAtItsLine) {
  trace::Study study;
  study.study = "distance_field";
  study.measure = "build";
  study.series = {line("trilinear", {2}, "by cells"), line("cubic", {250}, "by cells")};
  for (trace::StudySeries& series : study.series) series.points[0].parameter = 128;
  const trace::Study record = picture_of(study);
  EXPECT_EQ(record.title, "A field of 128 cells takes up to 250 ms to build");
  EXPECT_EQ(record.series[0].method, "trilinear: 2 ms");
}

TEST(Picture, AStudyWithoutNumbersKeepsItsTitle) {
  for (const StudyInfo& info : studies()) {
    for (const char* measure : {"area", "passed", "error", "map", "jitter", "time", "wrong"}) {
      trace::Study study;
      study.study = info.name;
      study.measure = measure;
      study.title = "What it measures";
      EXPECT_EQ(picture_of(study).title, "What it measures") << info.name << ", " << measure;
    }
  }
}

}  // namespace
}  // namespace contactscope
