#include <gmock/gmock.h>

#include <algorithm>
#include <utility>

#include "draw/charts/plot.h"
#include "draw/charts/rollout_page.h"
#include "draw/drawn_texts.h"
#include "draw/scene/pen.h"

/// Names of lines in charts, and what distinguishes them.
namespace contactscope::draw {
namespace {

using testing::Contains;
using testing::IsSupersetOf;
using testing::Not;

trace::Study curves_of(const std::string& name, const std::vector<double>& errors) {
  trace::Study study;
  study.study = "sample";
  study.form = trace::StudyForm::Curves;
  study.title = "A sample";
  study.parameter = "size";
  trace::StudySeries& line = study.series.emplace_back();
  line.method = name;
  double parameter = 1;
  for (const double error : errors)
    line.points.push_back({parameter *= 10, error, error, {}, 0, 100});
  return study;
}

TEST(ChartNames, ANumberStaysWithItsUnit) {
  const Drawing drawing =
      plot(curves_of("rebuilt in each where needed: 35.3 ms", {1, 2, 3}), 1280, 720);
  EXPECT_THAT(words(drawing), Not(Contains("ms")));
}

TEST(ChartNames, ALineWithoutANameHasNoLabel) {
  trace::Study study = curves_of("named", {1, 2, 3});
  study.series.push_back(study.series.front());
  study.series.back().method = "second";
  const std::size_t named = words(plot(study, 1280, 720)).size();
  study.series.back().method.clear();
  EXPECT_EQ(words(plot(study, 1280, 720)).size(), named - 1);
}

TEST(ChartNames, ZerosStandInARowBelowALogarithmicAxis) {
  const auto lowest = [](const Drawing& drawing) {
    float low = 0, next = 0;
    for (const Primitive& primitive : drawing.primitives)
      if (const auto* disc = std::get_if<Disc>(&primitive)) {
        if (disc->center.y > low)
          next = std::exchange(low, disc->center.y);
        else
          next = std::max(next, disc->center.y);
      }
    return low - next;
  };
  const Drawing some = plot(curves_of("some", {1, 1, 1, 0}), 1280, 720);
  EXPECT_THAT(words(some), Contains("0"));
  EXPECT_GT(lowest(some), 10);
  EXPECT_THAT(words(plot(curves_of("none", {1, 1, 1, 1}), 1280, 720)), Not(Contains("0")));
}

TEST(ChartNames, FailuresAreLabelledAtTheirFirstCross) {
  trace::Study study = curves_of("8 samples: 2 µs", {1, 1, 1, 1});
  study.failed = "hits missed";
  study.series.front().points.back().failed = 7;
  const std::vector<Text> all = drawn_texts(plot(study, 1280, 720));
  const auto record = std::ranges::find(all, "8 samples: 7 of 100 hits missed", &Text::text);
  ASSERT_NE(record, all.end()) << "without the time in the name of the line";
  EXPECT_GT(record->at.x, 400) << "the cross is at the right";
}

TEST(ChartNames, EachCrossHasItsOwnCountWhereThereIsRoom) {
  trace::Study study = curves_of("8 samples", {1, 1, 1, 1});
  study.failed = "hits missed";
  study.series.front().points[2].failed = 3;
  study.series.front().points[3].failed = 7;
  EXPECT_THAT(words(plot(study, 1280, 720)),
              IsSupersetOf({"8 samples: 3 of 100 hits missed", "7 of 100"}));
  study.series.front().points[0].failed = 1;
  EXPECT_THAT(words(plot(study, 1280, 720)), Contains("8 samples: 11 of 400 hits missed"))
      << "before the first there is none";
}

TEST(ChartNames, AMarkedLineOverTimeIsNamedThereAndQuietOnesAllTheSame) {
  const std::vector<double> time = {0, 1, 2, 3};
  trace::Study chart;
  chart.error = "Height";
  chart.unit = "m";
  chart.series.push_back(line_over_time("", time, {1.5, 1.4, 0.5, 0.5}));
  chart.series.back().points[2].mark = "falling 2.00 s";
  for (const char* name : {"one", "two", "three", "four"}) {
    chart.series.push_back(line_over_time(name, time, {1.5, 1.49, 1.49, 1.49}));
    chart.series.back().quiet = true;
  }
  Drawing drawing{.width = 900, .height = 300};
  draw_over_time(chart, {10, 10, 880, 280}, Pen(drawing, 1, kPlotText));
  EXPECT_THAT(words(drawing), IsSupersetOf({"falling 2.00 s", "one", "two", "three", "four"}));
  EXPECT_THAT(words(drawing), IsSupersetOf({"Height, m", "time, s", "0", "0.5", "1.5"}));
}

TEST(ChartNames, ALineThatReachesTooFarOverTimeSaysHowFar) {
  trace::Study chart;
  chart.error = "Energy";
  chart.unit = "J";
  for (const double most : {-2.0, 3.0, 500.0})
    chart.series.push_back(line_over_time("line", {0, 1}, {0, most}));
  Drawing drawing{.width = 900, .height = 300};
  draw_over_time(chart, {10, 10, 880, 280}, Pen(drawing, 1, kPlotText));
  EXPECT_THAT(words(drawing), IsSupersetOf({"line", "line, to 500 J", "−2", "3", "Energy, J"}));
}

}  // namespace
}  // namespace contactscope::draw
