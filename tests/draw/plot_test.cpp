#include "draw/charts/plot.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "drawn_texts.h"
#include "image/font.h"

namespace contactscope::draw {
namespace {

using testing::Contains;
using testing::Each;
using testing::HasSubstr;
using testing::Not;

trace::StudyPoint point(double parameter, double error, double nanoseconds) {
  return {parameter, error, 4 * error, {nanoseconds, 0.9 * nanoseconds, 1.3 * nanoseconds}, 0, 100};
}

/// As crowded as a study of reducers becomes: many lines close to each other, one exact method, one
/// that sometimes fails and one that always fails.
trace::Study crowded(int methods = 18) {
  trace::Study study;
  study.study = "reducers";
  study.title = "What each reducer loses";
  study.context = {"Some processor", "GCC 12", "Release", "2026-01-02T03:04:05Z", "float"};
  study.reference = "the best";
  study.error = "lost area";
  study.parameter = "points";
  for (int m = 0; m < methods; ++m) {
    trace::StudySeries series{"method " + std::to_string(m), {}};
    for (const double n : {5.0, 8.0, 16.0}) {
      series.points.push_back(point(n, 0.02 * (1 + 0.15 * m), 20 * n * (1 + 0.1 * (m * 7 % 5))));
    }
    study.series.push_back(series);
  }
  study.series.push_back({"exact", {point(5, 0, 300), point(8, 0, 400), point(16, 0, 800)}});
  study.series.push_back({"fails twice", {point(5, 0.3, 100), point(8, 0.3, 150)}});
  study.series.back().points[1].failed = 2;
  study.series.push_back({"never_works", {{5, {}, {}, {90, 80, 100}, 100, 100}}});
  return study;
}

/// Bounds of the letters: from the height of capitals to a little below the baseline.
Rect box_of(const Text& text) {
  const FontWeight weight = text.weight == Weight::Bold ? FontWeight::Bold : FontWeight::Regular;
  const double width = text_width(text.text, text.size, weight);
  const double share = text.align == Align::Left ? 0 : text.align == Align::Center ? 0.5 : 1;
  return {text.at.x - share * width, text.at.y - 0.62 * text.size, width, 0.75 * text.size};
}

bool overlap(const Rect& a, const Rect& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

TEST(Plot, TextIsOnTheCanvasWithoutOverlapAtFullAndHalfSize) {
  for (const auto& [width, height] : {std::pair{1280, 720}, {640, 360}}) {
    const std::vector<Text> all = drawn_texts(plot(crowded(), width, height));
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Rect box = box_of(all[i]);
      EXPECT_GE(box.x, 0) << all[i].text;
      EXPECT_GE(box.y, 0) << all[i].text;
      EXPECT_LE(box.x + box.width, width) << all[i].text;
      EXPECT_LE(box.y + box.height, height) << all[i].text;
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_FALSE(overlap(box, box_of(all[j])))
            << width << ": " << all[i].text << " on " << all[j].text;
      }
    }
  }
}

TEST(Plot, WordsOfAMarkedPointStandOnNothingElse) {
  trace::Study study = crowded();
  study.series[3].points[1].mark = "8 points: 2.9 %";
  study.series[18].points[0].mark = "none lost";
  const std::vector<Text> all = drawn_texts(plot(study, 1280, 720));
  for (const char* marked : {"8 points: 2.9 %", "none lost"}) {
    const auto found = std::ranges::find(all, marked, &Text::text);
    ASSERT_NE(found, all.end()) << marked;
    for (const Text& other : all)
      EXPECT_TRUE(&other == &*found || !overlap(box_of(*found), box_of(other))) << other.text;
  }
}

TEST(Plot, EveryMethodIsLabelledInBothPanels) {
  const std::vector<std::string> all = words(plot(crowded(), 1280, 720));
  for (const trace::StudySeries& series : crowded().series) {
    if (series.method == "never_works") continue;  // has no line to label
    EXPECT_EQ(std::ranges::count(all, series.method), 2) << series.method;
  }
}

TEST(Plot, ShowsTitleAxesDecadesContextAndBetterDirection) {
  const std::vector<std::string> all = words(plot(crowded(), 1280, 720));
  for (const char* text : {"What each reducer loses", "lost area,", "mean", "worst", "0", "0.1",
                           "100 ns", "1 µs", "better", "time of a call, median"}) {
    EXPECT_THAT(all, Contains(text));
  }
  EXPECT_THAT(all, Contains("Some processor · GCC 12 · Release · float · 2026-01-02"));
  EXPECT_THAT(all, Contains(HasSubstr("the best")));
  EXPECT_THAT(all, Contains(HasSubstr("5, 8, 16 points")));
}

TEST(Plot, FailuresAreCountedAlsoOfAMethodThatNeverWorks) {
  const std::vector<std::string> all = words(plot(crowded(), 1280, 720));
  EXPECT_THAT(all, Contains("failed"));
  EXPECT_THAT(all, Contains("fails twice: 2 of 200"));
  EXPECT_THAT(all, Contains("never works: 100 of 100"));
}

TEST(Plot, WithoutFailuresOrZerosThereIsNoRowForThem) {
  trace::Study study = crowded();
  study.series.resize(18);
  const std::vector<std::string> all = words(plot(study, 1280, 720));
  EXPECT_THAT(all, Not(Contains("failed")));
  EXPECT_THAT(all, Not(Contains("0")));
}

TEST(Plot, WithoutWorstErrorsThereIsOnePanel) {
  trace::Study study = crowded();
  for (trace::StudySeries& series : study.series) {
    for (trace::StudyPoint& p : series.points) p.error_worst.reset();
  }
  const std::vector<std::string> all = words(plot(study, 1280, 720));
  EXPECT_EQ(std::ranges::count(all, "exact"), 1);
  EXPECT_THAT(all, Not(Contains("worst")));
}

/// The crowded study as two panels, the second one ten times as slow.
trace::Study panelled() {
  trace::Study study = crowded(3);
  std::vector<trace::StudySeries> slow = study.series;
  for (trace::StudySeries& series : study.series) series.panel = "swift";
  for (trace::StudySeries& series : slow) {
    series.panel = "slow";
    for (trace::StudyPoint& p : series.points) {
      for (double* time : {&p.nanoseconds.min, &p.nanoseconds.median, &p.nanoseconds.max})
        *time *= 10;
    }
    study.series.push_back(series);
  }
  return study;
}

TEST(Plot, PanelsHaveTheirNamesTheirLinesAndTheirFailures) {
  const std::vector<std::string> all = words(plot(panelled(), 1280, 720));
  for (const char* text : {"swift", "slow"}) EXPECT_EQ(std::ranges::count(all, text), 1) << text;
  for (const char* text : {"method 0", "exact", "never works: 100 of 100"})
    EXPECT_EQ(std::ranges::count(all, text), 2) << text;
  EXPECT_THAT(all, Contains(HasSubstr("mean lost area")));
}

TEST(PlotGeometry, APanelHasTheTimeAxisOfTheWhole) {
  const trace::Study whole = panelled();
  trace::Study swift = whole, slow = whole;
  std::erase_if(swift.series, [](const auto& series) { return series.panel != "swift"; });
  std::erase_if(slow.series, [](const auto& series) { return series.panel != "slow"; });
  const Rect area{50, 40, 500, 400};
  const PlotGeometry left = plot_geometry(swift, ErrorKind::Mean, area, 1, whole);
  const PlotGeometry right = plot_geometry(slow, ErrorKind::Mean, area, 1, whole);
  EXPECT_EQ(left.x.at(500), right.x.at(500));
  EXPECT_LT(left.courses[0].points[0].x + 20, right.courses[0].points[0].x);
  EXPECT_EQ(left.courses[0].points[0].y, right.courses[0].points[0].y);
}

TEST(Plot, AStudyWithNothingInItIsStillAPicture) {
  trace::Study study;
  study.title = "Empty";
  EXPECT_THAT(words(plot(study, 1280, 720)), Contains("Empty"));
  study.series = {{"broken", {{5, {}, {}, {1, 1, 1}, 3, 3}}}};
  EXPECT_THAT(words(plot(study, 640, 360)), Contains("broken: 3 of 3"));
}

TEST(PlotGeometry, ZerosFailuresAndTheRestHaveRowsOfTheirOwn) {
  const PlotGeometry geometry =
      plot_geometry(crowded(), ErrorKind::Mean, {50, 40, 500, 400}, 1, crowded());
  EXPECT_GT(geometry.failures_end, 40);
  EXPECT_LT(geometry.zeros_begin, 440);
  for (const Course& course : geometry.courses) {
    for (const Point2& at : course.points) {
      EXPECT_GT(at.x, 50);
      EXPECT_LT(at.x, 550);
      const bool zero = course.method == "exact";
      EXPECT_GT(at.y, zero ? geometry.zeros_begin : geometry.failures_end) << course.method;
      EXPECT_LT(at.y, zero ? 440 : geometry.zeros_begin) << course.method;
    }
    if (!course.failures.empty()) {
      EXPECT_GT(course.failure_row, 40) << course.method;
      EXPECT_LT(course.failure_row, geometry.failures_end) << course.method;
    }
  }
  const Course& never = geometry.courses.back();
  EXPECT_EQ(never.failures.size(), 1u);
  EXPECT_TRUE(never.points.empty());
}

TEST(PlotGeometry, ErrorsWithinTheResolutionAreInTheLabelledRowOfZeros) {
  trace::Study study = crowded();
  study.resolution = 1e-6;
  study.series[18].points[0].error = 0.9e-6;
  const PlotGeometry geometry = plot_geometry(study, ErrorKind::Mean, {0, 0, 500, 400}, 1, study);
  EXPECT_EQ(geometry.zeros_label, "≤ 10⁻⁶");
  EXPECT_GT(geometry.courses[18].points[0].y, geometry.zeros_begin);
  EXPECT_EQ(plot_geometry(crowded(), ErrorKind::Mean, {0, 0, 500, 400}, 1, crowded()).zeros_label,
            "0");
}

TEST(PlotGeometry, FasterIsToTheLeftAndCloserIsLower) {
  trace::Study study = crowded(0);
  study.series = {{"fast", {point(5, 0.5, 10)}}, {"close", {point(5, 0.01, 1000)}}};
  const PlotGeometry geometry = plot_geometry(study, ErrorKind::Mean, {0, 0, 500, 400}, 1, study);
  EXPECT_LT(geometry.courses[0].points[0].x, geometry.courses[1].points[0].x);
  EXPECT_LT(geometry.courses[0].points[0].y, geometry.courses[1].points[0].y);
  for (const Course& course : geometry.courses) {
    EXPECT_LT(course.spread[0][0], course.points[0].x);
    EXPECT_GT(course.spread[0][1], course.points[0].x);
  }
}

TEST(OnFront, HoldsTheBestAtEachParameter) {
  trace::Study study;
  study.series = {{"fast", {point(5, 0.5, 10)}},
                  {"close", {point(5, 0.01, 1000)}},
                  {"beaten", {point(5, 0.6, 20)}},
                  {"alone_at_its_parameter", {point(9, 0.9, 5000)}},
                  {"only_failures", {{5, {}, {}, {1, 1, 1}, 3, 3}}}};
  EXPECT_THAT(on_front(study, ErrorKind::Mean),
              testing::ElementsAre(true, true, false, true, false));
  // In panels the parameter is a method's effort: slow and inaccurate points lose at any effort.
  for (trace::StudySeries& series : study.series) series.panel = "iterations";
  EXPECT_THAT(on_front(study, ErrorKind::Mean),
              testing::ElementsAre(true, true, false, false, false));
}

TEST(MethodStyle, NoTwoOfManyLookTheSameAndNeighboursDifferInColourAndMarker) {
  for (std::size_t i = 0; i < 40; ++i) {
    const MethodStyle one = method_style(i);
    for (std::size_t j = 0; j < i; ++j) {
      const MethodStyle other = method_style(j);
      const bool same_color = one.color.r == other.color.r && one.color.g == other.color.g &&
                              one.color.b == other.color.b;
      EXPECT_FALSE(same_color && one.marker == other.marker) << i << " and " << j;
      if (j + 1 == i) {
        EXPECT_FALSE(same_color || one.marker == other.marker) << i << " and " << j;
      }
    }
  }
}

}  // namespace
}  // namespace contactscope::draw
