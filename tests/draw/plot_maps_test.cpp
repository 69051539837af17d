#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "draw/charts/plot.h"
#include "draw/drawn_texts.h"
#include "draw/scene/camera.h"
#include "draw/scene/palette.h"
#include "image/font.h"

namespace contactscope::draw {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

constexpr std::pair<int, int> kSizes[] = {{1280, 720}, {640, 360}};

/// As large as the study of stability becomes.
trace::Study study_of(trace::StudyForm form) {
  trace::Study study;
  study.study = "stability";
  study.title = "Where float and double run out";
  study.context = {"Some processor", "GCC 12", "Release", "2026-01-02T03:04:05Z", "both"};
  study.reference = "all axes in extended precision";
  study.error = "error / size";
  study.parameter = "parameter";
  study.form = form;
  return study;
}

std::vector<trace::StudyPoint> points(double slope, int failed_from = 1000) {
  std::vector<trace::StudyPoint> list;
  for (int i = 0; i < 21; ++i) {
    const double parameter = std::pow(10.0, -9 + 0.5 * i);
    trace::StudyPoint point{parameter, 1e-7, 1e-16 * std::pow(10.0, slope * i), {2, 1, 3}, 0, 40};
    if (i >= failed_from) point.failed = i + 1 < 21 ? 3 : 40;
    if (point.failed == point.of) point.error = point.error_worst = std::nullopt;
    list.push_back(point);
  }
  return list;
}

trace::Study curves() {
  trace::Study study = study_of(trace::StudyForm::Curves);
  study.signal = "overlap";
  for (const char* panel : {"tilt", "scale", "distance", "aspect", "angle", "kiss"}) {
    const std::string parameter = std::string("the ") + panel + " of it (m)";
    study.series.push_back({"float", points(0.4), panel, parameter});
    study.series.push_back({"double", points(0), panel, parameter});
    study.series.push_back({"float, unrounded", points(0.5, 12), panel, parameter});
    study.series.push_back({"double, unrounded", points(0.1), panel, parameter});
    study.series.push_back({"overlap", points(0.2), panel, parameter});
  }
  return study;
}

trace::Study numbered_map() {
  trace::Study study = study_of(trace::StudyForm::Map);
  study.row = "overlap, 1 = coincident";
  for (const char* panel : {"float", "double", "float, unrounded", "double, unrounded"}) {
    for (int row = 0; row < 25; ++row) {
      study.series.push_back(
          {panel, points(0.02 * row, 30 - row), panel, "distance (m)", std::pow(10.0, -6 + row)});
    }
  }
  return study;
}

trace::Study named_map() {
  trace::Study study = study_of(trace::StudyForm::Map);
  study.row = "kind of pair";
  for (const char* panel : {"float: a", "float: b", "float: c", "double: a", "double: b"}) {
    for (int row = 0; row < 12; ++row) {
      study.series.push_back({"capsule on capsule " + std::to_string(row), points(1), panel, "m"});
    }
  }
  return study;
}

trace::Study answers() {
  trace::Study study = study_of(trace::StudyForm::Answers);
  study.row = "units along y";
  for (const char* panel : {"float", "double", "exact"}) {
    for (int j = -6; j < 6; ++j) {
      trace::StudySeries& row = study.series.emplace_back(
          trace::StudySeries{panel, {}, panel, "units along x", double(j)});
      for (int i = -6; i < 6; ++i)
        row.points.push_back({double(i), i == j ? 1.0 : i > j ? 0.0 : 2.0, {}, {}, 0, 1});
    }
  }
  return study;
}

template <class T> std::vector<T> all_of(const Drawing& drawing) {
  std::vector<T> list;
  for (const Primitive& primitive : drawing.primitives) {
    if (const auto* one = std::get_if<T>(&primitive)) list.push_back(*one);
  }
  return list;
}

Rect box_of(const Text& text) {
  const FontWeight weight = text.weight == Weight::Bold ? FontWeight::Bold : FontWeight::Regular;
  const double width = text_width(text.text, text.size, weight);
  const double share = text.align == Align::Left ? 0 : text.align == Align::Center ? 0.5 : 1;
  return {text.at.x - share * width, text.at.y - 0.62 * text.size, width, 0.7 * text.size};
}

bool overlap(const Rect& a, const Rect& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

void expect_legible(const Drawing& drawing) {
  const std::vector<Text> all = all_of<Text>(drawing);
  ASSERT_GT(all.size(), 10u);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Rect box = box_of(all[i]);
    EXPECT_GE(box.x, 0) << all[i].text;
    EXPECT_GE(box.y, 0) << all[i].text;
    EXPECT_LE(box.x + box.width, drawing.width) << all[i].text;
    EXPECT_LE(box.y + box.height, drawing.height) << all[i].text;
    EXPECT_GE(all[i].size, 9.9f) << all[i].text;
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_FALSE(overlap(box, box_of(all[k]))) << all[i].text << " on " << all[k].text;
    }
  }
}

TEST(PlotCurves, TextIsOnTheCanvasWithoutOverlap) {
  for (const auto& [width, height] : kSizes) expect_legible(plot_curves(curves(), width, height));
}

TEST(PlotMap, TextIsOnTheCanvasWithoutOverlap) {
  for (const auto& [width, height] : kSizes) {
    expect_legible(plot_map(numbered_map(), width, height));
    expect_legible(plot_map(named_map(), width, height));
  }
}

TEST(PlotCurves, NamesEveryPanelAndCountsItsFailures) {
  const std::vector<std::string> all = words(plot_curves(curves(), 1280, 720));
  for (const char* panel : {"the tilt of it (m)", "the kiss of it (m)"}) {
    EXPECT_THAT(all, Contains(panel));
  }
  EXPECT_EQ(std::ranges::count(all, "64 of 840"), 6);
  EXPECT_THAT(all, Contains("float, unrounded"));
  EXPECT_THAT(all, Contains(HasSubstr("all axes in extended precision")));
}

TEST(PlotCurves, WithoutFailuresNoneAreExplainedAndTheCurvesHaveTheirRoom) {
  trace::Study study = curves();
  EXPECT_THAT(words(plot_curves(study, 1280, 720)), Contains("failures, of all cases"));
  const auto highest = [&] {
    float top = 1e9f;
    for (const Disc& disc : all_of<Disc>(plot_curves(study, 1280, 720)))
      if (disc.center.y > 110) top = std::min(top, disc.center.y);  // below the legend
    return top;
  };
  const float with_failures = highest();
  for (trace::StudySeries& series : study.series)
    for (trace::StudyPoint& point : series.points) point.failed = 0;
  EXPECT_THAT(words(plot_curves(study, 1280, 720)), Not(Contains("failures, of all cases")));
  EXPECT_LT(highest(), with_failures - 10);
}

/// Number of rings around marked points.
int rings_in(const Drawing& drawing) {
  return static_cast<int>(std::ranges::count_if(all_of<Disc>(drawing), [](const Disc& disc) {
    return disc.inner > 6 && disc.color.r == kText.r && disc.color.g == kText.g;
  }));
}

TEST(PlotCurves, AMarkedPointHasARingAndItsWords) {
  trace::Study study = curves();
  EXPECT_EQ(rings_in(plot_curves(study, 1280, 720)), 0);
  study.series[0].points[5].mark = "2.5 mm";
  study.series[6].points[20].mark = "at the end";
  const Drawing drawing = plot_curves(study, 1280, 720);
  EXPECT_EQ(rings_in(drawing), 2);
  EXPECT_THAT(words(drawing), testing::IsSupersetOf({"2.5 mm", "at the end"}));
  expect_legible(drawing);
}

TEST(PlotCurves, SharesThatAreFarFromZeroHaveAnAxisOfTheirOwn) {
  trace::Study study = study_of(trace::StudyForm::Curves);
  study.unit = trace::kShare;
  trace::StudySeries& line = study.series.emplace_back();
  line.method = "about as long";
  for (const double share : {0.91, 1.0, 1.06})
    line.points.push_back({100 * share, share, share, {}, 0, 1});
  EXPECT_THAT(words(plot_curves(study, 1280, 720)), Not(Contains("0 %")));
  line.points.front().error = line.points.front().error_worst = 0.3;
  EXPECT_THAT(words(plot_curves(study, 1280, 720)), Contains("0 %"));
}

TEST(PlotMap, MarkedCellsHaveOneBorderAndTheirWordsOnce) {
  trace::Study study = named_map();
  const auto borders = [](const Drawing& drawing) {
    return std::ranges::count_if(all_of<Stroke>(drawing), [](const Stroke& stroke) {
      return stroke.color.r == kText.r && stroke.width > 2.5f && stroke.width < 2.7f;
    });
  };
  EXPECT_EQ(borders(plot_map(study, 1280, 720)), 0);
  for (std::size_t row = 0; row < 12; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      study.series[row].points[column].mark = "10 ×";
  const Drawing drawing = plot_map(study, 1280, 720);
  EXPECT_EQ(borders(drawing), 4) << "a rectangle is one outline";
  EXPECT_EQ(std::ranges::count(words(drawing), "10 ×"), 1);
  study.series[0].points[3].mark = "10 ×";
  EXPECT_EQ(borders(plot_map(study, 1280, 720)), 2 * 12 + 2 * 3 + 2);
}

TEST(PlotCurves, AMethodHasTheColourThatTheOtherPlotsOfItsStudyGiveIt) {
  const Drawing drawing = plot(curves(), 1280, 720);
  const auto strokes_like = [&](const Color& color) {
    return std::ranges::count_if(drawing.primitives, [&](const Primitive& primitive) {
      const auto* stroke = std::get_if<Stroke>(&primitive);
      return stroke != nullptr && stroke->color.r == color.r && stroke->color.g == color.g &&
             stroke->color.b == color.b;
    });
  };
  EXPECT_GT(strokes_like(method_style(0).color), 100) << "float, first of its study";
  EXPECT_GT(strokes_like(method_style(1).color), 100) << "double";
  EXPECT_EQ(strokes_like(method_style(2).color), 0) << "the others are variants of these";
}

TEST(PlotCurves, NamesOfOptionsAreReadAsWords) {
  trace::Study study = curves();
  for (trace::StudySeries& series : study.series)
    if (series.method == "double") series.method = "sweep_and_prune";
  const std::vector<std::string> all = words(plot(study, 1280, 720));
  EXPECT_THAT(all, Contains("sweep and prune"));
  EXPECT_THAT(all, Not(Contains(HasSubstr("_"))));
}

TEST(PlotCurves, FramesAreEvenlySpaced) {
  trace::Study study = study_of(trace::StudyForm::Curves);
  trace::StudySeries& line = study.series.emplace_back();
  line.method = "frames";
  for (int frame = 1; frame <= 50; ++frame)
    line.points.push_back({static_cast<double>(frame), 1.0 + frame, 1.0 + frame, {}, 0, 1});
  const Drawing drawing = plot_curves(study, 1280, 720);
  std::vector<float> places;
  for (const Disc& disc : all_of<Disc>(drawing))
    if (disc.center.y > 110) places.push_back(disc.center.x);  // below the legend
  ASSERT_EQ(places.size(), 50u);
  for (std::size_t i = 1; i < 50; ++i)
    EXPECT_NEAR(places[i] - places[i - 1], (places[49] - places[0]) / 49, 0.01);
  EXPECT_THAT(words(drawing), testing::IsSupersetOf({"10", "20", "40"}));
  expect_legible(drawing);
}

TEST(PlotCurves, LinesAtTheSamePlacesAreSeenAroundEachOther) {
  trace::Study study = study_of(trace::StudyForm::Curves);
  for (const char* method : {"some", "none", "none either"}) {
    trace::StudySeries& line = study.series.emplace_back();
    line.method = method;
    const double share = line.method == "some" ? 0.1 : 0.0;
    for (const double parameter : {1.0, 10.0, 100.0})
      line.points.push_back({parameter, share, share, {}, 0, 1});
  }
  const Drawing drawing = plot_curves(study, 1280, 720);
  std::set<float> sizes, heights;
  for (const Disc& disc : all_of<Disc>(drawing)) {
    if (disc.center.y < 110) continue;  // the legend
    sizes.insert(disc.outer);
    heights.insert(disc.center.y);
  }
  EXPECT_EQ(heights.size(), 2u);
  ASSERT_EQ(sizes.size(), 2u);
  EXPECT_GT(*sizes.rbegin() - *sizes.begin(), 1.5);
  EXPECT_THAT(words(drawing), Contains("0"));
  expect_legible(drawing);
}

TEST(PlotCurves, SharesAreInPercentOnALinearAxisFromZero) {
  trace::Study study = study_of(trace::StudyForm::Curves);
  study.unit = trace::kShare;
  trace::StudySeries& line = study.series.emplace_back();
  line.method = "half";
  for (const double share : {0.25, 0.5, 1.0})
    line.points.push_back({100 * share, share, share, {}, 0, 1});
  const Drawing drawing = plot_curves(study, 1280, 720);
  EXPECT_THAT(words(drawing), testing::IsSupersetOf({"0 %", "20 %", "100 %", "half"}));
  std::vector<float> heights;
  for (const Disc& disc : all_of<Disc>(drawing)) heights.push_back(disc.center.y);
  ASSERT_EQ(heights.size(), 3u);
  EXPECT_NEAR(heights[1] - heights[2], 2 * (heights[0] - heights[1]), 0.1);
  expect_legible(drawing);
}

TEST(PlotCurves, LinesOfAFewPanelsAreNamedOnceAndLinesOfManyInALegend) {
  trace::Study study = study_of(trace::StudyForm::Curves);
  for (const char* panel : {"left", "middle", "right"}) {
    study.series.push_back({"rising", points(0.4), panel, "m"});
    study.series.push_back({"flat", points(0), panel, "m"});
  }
  const auto times_named = [&] {
    return std::ranges::count(words(plot_curves(study, 1280, 720)), "rising");
  };
  EXPECT_EQ(times_named(), 1);
  for (const auto& [width, height] : kSizes) expect_legible(plot_curves(study, width, height));
  study.series[5].method = "flatter";
  EXPECT_EQ(times_named(), 3) << "these are not the same lines";
  for (const auto& [width, height] : kSizes) expect_legible(plot_curves(study, width, height));
  study.series.push_back({"rising", points(0.4), "one more", "m"});
  EXPECT_EQ(times_named(), 1) << "in the legend";
}

TEST(PlotCurves, QuietSeriesAreGreyAndALookIsKept) {
  trace::Study study = study_of(trace::StudyForm::Curves);
  study.series.push_back({"quiet", points(0.4)});
  study.series.push_back({"third", points(0)});
  study.series[0].quiet = true;
  study.series[1].look = 2;
  const Drawing drawing = plot_curves(study, 1280, 720);
  const auto strokes_like = [&](const Color& color) {
    return std::ranges::count_if(all_of<Stroke>(drawing), [&](const Stroke& stroke) {
      return stroke.color.r == color.r && stroke.color.g == color.g && stroke.color.b == color.b;
    });
  };
  EXPECT_EQ(strokes_like(method_style(0).color), 0);
  EXPECT_EQ(strokes_like(method_style(1).color), 0);
  EXPECT_GT(strokes_like(method_style(2).color), 15);
}

TEST(PlotCurves, AnAxisOfOneDecadeHasTwoLabelsAndMore) {
  trace::Study study = study_of(trace::StudyForm::Curves);
  trace::StudySeries& line = study.series.emplace_back();
  line.method = "within a decade";
  for (const double error : {0.3, 0.7, 1.8})
    line.points.push_back({100 * error, error, error, {}, 0, 1});
  EXPECT_THAT(words(plot_curves(study, 1280, 720)),
              testing::IsSupersetOf({"0.5", "1", "30", "70", "180"}))
      << "few points have ticks of their own";
  for (trace::StudyPoint& point : line.points) point.parameter *= 1000;
  study.series.push_back({"another", line.points, "", "of the second panel"});
  const Drawing drawing = plot_curves(study, 1280, 720);
  EXPECT_THAT(words(drawing), testing::IsSupersetOf({"5 × 10⁴", "10⁵"}));
  expect_legible(drawing);
}

TEST(PlotCurves, ASingleValueAPointIsNotCalledTheLargest) {
  trace::Study study = curves();
  EXPECT_THAT(words(plot_curves(study, 1280, 720)), Contains("Largest error / size"));
  for (trace::StudySeries& series : study.series)
    for (trace::StudyPoint& point : series.points) point.error_worst = point.error;
  study.error = "milliseconds, median";
  EXPECT_THAT(words(plot_curves(study, 1280, 720)), Contains("Milliseconds, median"));
}

TEST(PlotCurves, OneHeightIsOneErrorInEveryPanelOfARow) {
  // The dots of "double", a flat line, are at one height in the three panels of the upper row.
  std::multiset<float> heights;
  for (const Disc& disc : all_of<Disc>(plot_curves(curves(), 1280, 720))) {
    heights.insert(std::round(disc.center.y * 8) / 8);
  }
  std::size_t most = 0;
  for (const float height : heights) most = std::max(most, heights.count(height));
  EXPECT_GE(most, 3u * 21u);
}

TEST(PlotMap, ACellForEachPointAndACrossWhereSomeFailed) {
  trace::Study map = study_of(trace::StudyForm::Map);
  map.row = "row";
  map.series.push_back({"m", points(0), "one", "p", 1.0});
  const auto count = [&] {
    const Drawing drawing = plot_map(map, 1280, 720);
    return std::pair{all_of<Fill>(drawing).size(), all_of<Stroke>(drawing).size()};
  };
  const auto [fills, strokes] = count();
  EXPECT_EQ(fills, 21u + 1u);  // and the only decade of the legend
  map.series[0].points[4].failed = 1;
  EXPECT_EQ(count(), std::pair(fills, strokes + 2));
  map.series[0].points[4].error = map.series[0].points[4].error_worst = std::nullopt;
  // If all failed, hatching replaces the colour and the cross.
  EXPECT_EQ(count().first, fills - 1);
  EXPECT_GT(count().second, strokes + 10);
}

TEST(PlotMap, SharesAreColouredByFailuresAloneAndNameTheirSteps) {
  trace::Study map = study_of(trace::StudyForm::Map);
  map.row = "row";
  map.unit = trace::kShare;
  map.series.push_back({"m", points(0), "one", "p", 1.0});
  const auto shade_of = [&](std::size_t cell) {
    const std::vector<Fill> fills = all_of<Fill>(plot_map(map, 1280, 720));
    return fills[fills.size() - 21 + cell].color.r;
  };
  for (trace::StudyPoint& point : map.series[0].points) point.failed = 0;
  const float none = shade_of(4);
  map.series[0].points[4].failed = 4;
  const float some = shade_of(4);
  map.series[0].points[4].failed = 40;
  EXPECT_LT(some, none - 0.1f);
  EXPECT_LT(shade_of(4), some - 0.1f);
  map.series[0].points[5].error_worst = 1e6;
  EXPECT_EQ(shade_of(5), none) << "how large an error is does not count";
  map.series[0].points[6].failed = 4;
  const std::vector<std::string> all = words(plot_map(map, 1280, 720));
  EXPECT_THAT(all, testing::IsSupersetOf({"none", "≤ 10 %", "all"}));
  EXPECT_THAT(all, Not(Contains("≤ 50 %"))) << "nothing in the map is of that";
  EXPECT_THAT(all, Not(Contains("some cases failed")));
}

TEST(PlotCurves, NamedFailuresAreLabelledAtTheirCrossesWithoutALegend) {
  trace::Study study = study_of(trace::StudyForm::Curves);
  study.series.push_back({"rising", points(0.4, 18)});
  EXPECT_THAT(words(plot_curves(study, 1280, 720)), Contains("failures, of all cases"));
  study.failed = "hits missed";
  const std::vector<std::string> all = words(plot_curves(study, 1280, 720));
  EXPECT_THAT(all, Not(Contains("failures, of all cases")));
  EXPECT_THAT(all, Contains("rising: 46 of 840 hits missed"));
}

TEST(PlotCurves, OneDiagramHasLargerLettersThanMany) {
  const auto tick_size = [](const Drawing& drawing) {
    for (const Text& text : all_of<Text>(drawing))
      if (text.text == "10⁻⁸") return text.size;
    return 0.0f;
  };
  trace::Study one = study_of(trace::StudyForm::Curves);
  one.series.push_back({"rising", points(0.4)});
  EXPECT_GT(tick_size(plot_curves(curves(), 1280, 720)), 10);
  EXPECT_GT(tick_size(plot_curves(one, 1280, 720)),
            1.2f * tick_size(plot_curves(curves(), 1280, 720)));
}

TEST(PlotCurves, TimesThatAddUpAreOnALinearAxisInMilliseconds) {
  trace::Study study = study_of(trace::StudyForm::Curves);
  study.unit = trace::kSum;
  trace::StudySeries& line = study.series.emplace_back();
  line.method = "frames so far";
  for (const double sum : {20.0, 60.0, 100.0}) line.points.push_back({sum, sum, sum, {}, 0, 1});
  EXPECT_THAT(words(plot_curves(study, 1280, 720)),
              testing::IsSupersetOf({"0 ms", "40 ms", "100 ms"}));
}

TEST(PlotAnswers, TextIsOnTheCanvasWithoutOverlap) {
  for (const auto& [width, height] : kSizes) expect_legible(plot_answers(answers(), width, height));
}

TEST(PlotAnswers, EachAnswerHasAColourAndWrongOnesASquare) {
  trace::Study study = answers();
  const Drawing right = plot_answers(study, 1280, 720);
  EXPECT_EQ(std::ranges::count(words(right), "0 of 144 wrong"), 3);
  // A row of a panel has at most three runs of one colour; the legend has four boxes.
  EXPECT_EQ(all_of<Fill>(right).size(), 3u * (3 * 12 - 2) + 4);
  study.series[7].points[2].failed = 1;
  study.series[7].points[9].failed = 1;
  const Drawing wrong = plot_answers(study, 1280, 720);
  EXPECT_EQ(std::ranges::count(words(wrong), "0 of 144 wrong"), 2);
  EXPECT_EQ(std::ranges::count(words(wrong), "2 of 144 wrong"), 1);
  EXPECT_EQ(all_of<Fill>(wrong).size(), all_of<Fill>(right).size() + 2);
  // A changed answer changes a colour: a single one splits a run into three.
  study.series[7].points[9].error = 2;
  EXPECT_EQ(all_of<Fill>(plot_answers(study, 1280, 720)).size(), all_of<Fill>(wrong).size() + 2);
}

TEST(PlotMap, WorseIsDarker) {
  trace::Study map = study_of(trace::StudyForm::Map);
  map.row = "row";
  map.series.push_back({"m", points(0), "one", "p", 1.0});
  for (std::size_t i = 0; i < 21; ++i) {
    map.series[0].points[i].error_worst = std::pow(10.0, 0.5 * static_cast<double>(i));
  }
  const std::vector<Fill> fills = all_of<Fill>(plot_map(map, 1280, 720));
  ASSERT_GE(fills.size(), 21u);
  const auto lightness = [](const Fill& fill) {
    return 0.2126f * fill.color.r + 0.7152f * fill.color.g + 0.0722f * fill.color.b;
  };
  const std::size_t first = fills.size() - 21;
  for (std::size_t i = first + 1; i < fills.size(); ++i) {
    EXPECT_LE(lightness(fills[i]), lightness(fills[i - 1]));
  }
  EXPECT_LT(lightness(fills.back()), 0.2f * lightness(fills[first]));
}

}  // namespace
}  // namespace contactscope::draw
