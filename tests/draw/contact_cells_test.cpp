#include "draw/insets/contact_cells.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "draw/contact_cells_sample.h"

namespace contactscope::draw {
namespace {

using testing::Contains;
using testing::IsSupersetOf;
using testing::Not;

TEST(ContactCells, SlowStayOnTheCanvasAtEverySize) {
  for (const auto& [width, height] : {std::pair{320, 180}, {640, 360}, {1280, 720}}) {
    for (const int cells : {1, 2, 18}) {
      for (const int frames : {1, 60}) {
        const std::vector<ContactMoment> moments = moments_of(cells, frames);
        const ContactCells picture("A crate on a floor", "Gregorius 2015", "y", moments, 0, width,
                                   height);
        for (const int frame : {0, frames - 1}) {
          const Drawing drawing = picture.frame(frame);
          EXPECT_EQ(drawing.width, width);
          EXPECT_EQ(drawing.height, height);
          expect_on_canvas(drawing, std::to_string(width) + " wide, " + std::to_string(cells) +
                                        " cells, " + std::to_string(frames) + " frames");
          EXPECT_GE(rings(drawing).size(), 4u * static_cast<std::size_t>(cells));
        }
      }
    }
  }
}

TEST(ContactCells, TextsDoNotOverlap) {
  for (const auto& [width, height] : {std::pair{640, 360}, {1280, 720}}) {
    for (const int cells : {2, 18}) {
      const std::vector<Text> list = all<Text>(drawn(moments_of(cells, 60), 30, width, height));
      for (std::size_t i = 0; i < list.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
          const Rect a = box_of(list[i]);
          const Rect b = box_of(list[j]);
          EXPECT_FALSE(a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height &&
                       b.y < a.y + a.height)
              << width << " wide, " << cells << " cells: " << list[i].text << " on "
              << list[j].text;
        }
      }
    }
  }
}

/// Twelve points on a slanted ellipse eight times as long as wide, with crowded tips.
std::vector<trace::Point> sliver() {
  std::vector<trace::Point> points;
  for (int i = 0; i < 12; ++i) {
    const double angle = 0.2 + i * 0.5235987755982988;
    const double u = std::cos(angle), v = 0.125 * std::sin(angle);
    points.push_back({Vec3d(0.707 * (u - v), 0, 0.707 * (u + v)), -0.001 * (i + 1),
                      "a:e" + std::to_string(i) + " b:e1"});
  }
  return points;
}

TEST(ContactCells, SlowDigitsOfANarrowPatchAreOnNoPointAndNoDigit) {
  for (const int frames : {1, 40}) {
    ContactMoment moment = moments_of(19, 1).front();
    for (ContactCell& cell : moment.cells) cell.points = sliver();
    for (ContactCell& cell : moment.cells) cell.kept = {0, 6, 11, 5};
    std::vector<ContactMoment> moments;
    for (int f = 0; f < frames; ++f) {
      moments.push_back(moment);
      moments.back().frame = f;
    }
    const Drawing drawing = drawn(moments, 0, 1280, 1440);
    std::vector<Rect> digits;
    for (const Text& text : all<Text>(drawing))
      if (text.text.size() == 1) digits.push_back(box_of(text));
    EXPECT_GE(digits.size(), 3u * 19);
    for (std::size_t i = 0; i < digits.size(); ++i) {
      const Rect& a = digits[i];
      for (std::size_t j = 0; j < i; ++j) {
        const Rect& b = digits[j];
        EXPECT_FALSE(a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height &&
                     b.y < a.y + a.height);
      }
      for (const Disc& ring : rings(drawing)) {
        const double x = std::clamp<double>(ring.center.x, a.x, a.x + a.width);
        const double y = std::clamp<double>(ring.center.y, a.y, a.y + a.height);
        EXPECT_GT(std::hypot(x - ring.center.x, y - ring.center.y), ring.outer - 1);
      }
    }
  }
}

TEST(ContactCells, MarksShrinkWherePointsAreCrowded) {
  ContactMoment wide, narrow;
  wide.cells = {cell_of("area", octagon())};
  narrow = moments_of(12, 1).front();
  for (ContactCell& cell : narrow.cells) cell.points = sliver();
  const double full = rings(drawn({wide}, 0)).front().outer;
  const double small = rings(drawn({narrow}, 0)).front().outer;
  EXPECT_LT(small, 0.8 * full);
  EXPECT_GE(small, 0.55 / 1.5 * full) << "those of a single cell are larger";
}

/// Number of squares of axis-parallel lines about a point.
int squares_about(const Drawing& drawing, const Point2& at) {
  int sides = 0;
  for (const Stroke& s : all<Stroke>(drawing)) {
    const double mx = 0.5 * (s.from.x + s.to.x) - at.x, my = 0.5 * (s.from.y + s.to.y) - at.y;
    const double length = std::hypot(s.to.x - s.from.x, s.to.y - s.from.y);
    const bool straight = std::abs(s.to.x - s.from.x) < 0.01 || std::abs(s.to.y - s.from.y) < 0.01;
    if (straight && length > 5 && std::abs(std::hypot(mx, my) - 0.5 * length) < 0.1) ++sides;
  }
  return sides / 8;  // four sides and their halo
}

TEST(ContactCells, TheDeepestIsMarkedKeptOrNotUnlessThePatchIsLevel) {
  ContactMoment moment;
  moment.cells = {cell_of("area", octagon())};
  const Disc first = rings(drawn({moment}, 0)).front();  // of point 1: kept
  moment.cells[0].points[1].separation = -0.1;
  EXPECT_EQ(squares_about(drawn({moment}, 0), first.center), 1);
  EXPECT_THAT(words(drawn({moment}, 0)), Contains("deepest"));
  moment.cells[0].kept = {2, 5, 3, 0};
  EXPECT_EQ(squares_about(drawn({moment}, 0), first.center), 1);
  for (trace::Point& point : moment.cells[0].points) point.separation = -0.01;
  EXPECT_EQ(squares_about(drawn({moment}, 0), first.center), 0);
  EXPECT_THAT(words(drawn({moment}, 0)), Not(Contains("deepest")));
}

TEST(ContactCells, AllPointsThatTieForTheDeepestAreMarked) {
  ContactMoment moment;
  moment.cells = {cell_of("area", octagon())};
  moment.cells[0].kept = {1, 4, 3, 0};
  const std::vector<Disc> kept = rings(drawn({moment}, 0));
  moment.cells[0].points[1].separation = -0.1;
  moment.cells[0].points[4].separation = -0.1 + 1e-8;  // less than float resolves there
  const Drawing drawing = drawn({moment}, 0);
  EXPECT_EQ(squares_about(drawing, kept[0].center), 1);
  EXPECT_EQ(squares_about(drawing, kept[1].center), 1);
  EXPECT_EQ(squares_about(drawing, kept[2].center), 0);
  moment.cells[0].points[4].separation = -0.09;
  EXPECT_EQ(squares_about(drawn({moment}, 0), kept[1].center), 0);
}

TEST(ContactCells, ExtremesHaveTheirBoxAndTheLegendListsAllAreas) {
  ContactMoment moment;
  moment.cells = {cell_of("extremes", octagon())};
  EXPECT_THAT(words(drawn({moment}, 0)), Contains("kept area, hatched: lost"));
  EXPECT_THAT(words(drawn({moment}, 0)), Not(Contains("box along the axes")));
  for (const Vec3d& direction :
       {Vec3d(-1, 0, 0), Vec3d(1, 0, 0), Vec3d(0, 0, -1), Vec3d(0, 0, 1)}) {
    trace::Choice choice;
    choice.rule = "support";
    choice.direction = direction;
    moment.cells[0].choices.push_back(choice);
  }
  EXPECT_THAT(words(drawn({moment}, 0)), IsSupersetOf({"box along the axes", "x", "z"}));
}

TEST(ContactCells, StripsExplainWhenAndHowOrangeIsUsed) {
  std::vector<ContactMoment> moments = moments_of(1, 30);
  EXPECT_THAT(words(drawn(moments, 15)), Contains("points over time, orange: kept"));
  EXPECT_THAT(words(drawn(moments, 15)), Not(Contains("now"))) << "the moments have no time";
  for (ContactMoment& moment : moments) moment.time = 0.1 * moment.frame;
  EXPECT_THAT(words(drawn(moments, 15)), IsSupersetOf({"0", "now", "2.90 s"}));
  EXPECT_THAT(words(drawn(moments, 0)), Not(Contains("now"))) << "there is no room for it there";
}

TEST(ContactCells, AScenarioWithoutWordsForTheStripHasNone) {
  const auto bars = [](const FigureStyle& style) {
    return all<Fill>(ContactCells("Title", "Source", "y", moments_of(1, 30), 0, 1280, 720, style)
                         .frame(0))
        .size();
  };
  Words none;
  none.replace("points over time, orange: kept", "");
  FigureStyle style;
  style.words = std::make_shared<const Words>(none);
  EXPECT_LT(bars(style), bars({}));
}

TEST(ContactCells, StripsTakeTheRoomThatAFlatPatchLeaves) {
  std::vector<ContactMoment> moments = moments_of(1, 30);
  for (ContactMoment& moment : moments)
    for (trace::Point& point : moment.cells[0].points) point.position.z() *= 0.2;
  const auto highest_bar = [](const Drawing& drawing) {
    float most = 0;
    for (const Fill& fill : all<Fill>(drawing)) {
      const Point2* p = fill.polygon.data();
      if (fill.polygon.size() == 4 && p[0].y == p[1].y && p[1].x == p[2].x && p[2].y == p[3].y &&
          p[1].x - p[0].x > 100) {
        most = std::max(most, p[2].y - p[1].y);
      }
    }
    return most;
  };
  EXPECT_GT(highest_bar(drawn(moments, 0)), 5);
}

TEST(ContactCells, SlowHaveRowsThatAreLegibleOrNone) {
  for (const auto& [width, height] :
       {std::pair{160, 90}, {320, 180}, {480, 270}, {640, 360}, {960, 540}, {1280, 720}}) {
    for (const int cells : {1, 2, 3, 7, 12, 19, 40}) {
      for (const int frames : {1, 60}) {
        const std::vector<ContactMoment> moments = moments_of(cells, frames);
        const ContactCells picture("Title", "Source", "y", moments, 0, width, height);
        std::vector<std::string> rows;
        for (const Text& text : all<Text>(picture.frame(0))) {
          for (const char* part : {"area", "mom", "deepest l", "lost,", "1234"}) {
            if (text.text.starts_with(part)) rows.push_back(text.text);
          }
        }
        // All cells alike, and nothing cut off.
        const auto count = [&](const char* row) { return std::ranges::count(rows, row); };
        const auto each = static_cast<long>(cells);
        const std::string where = std::to_string(width) + " wide, " + std::to_string(cells) +
                                  " cells, " + std::to_string(frames) + " frames";
        const std::vector<std::string> out = picture.left_out();
        if (std::ranges::count(out, "the numbers") > 0) {
          EXPECT_TRUE(rows.empty()) << where;
        } else if (std::ranges::count(out, "all numbers but the first") > 0) {
          EXPECT_EQ(count("area 99.954 %"), each) << where;
          EXPECT_EQ(rows.size(), static_cast<std::size_t>(cells)) << where;
        } else if (std::ranges::count(out, "parts of the numbers") > 0) {
          EXPECT_EQ(count("area 99.954 %"), each) << where;
          EXPECT_EQ(count("mom. −12 %"), each) << where;
          EXPECT_EQ(count("lost, tips over"), each) << where;
          EXPECT_EQ(rows.size(), 3 * static_cast<std::size_t>(cells)) << where;
        } else {
          const bool has_ends = std::ranges::count(out, "the numbers on the right") == 0;
          EXPECT_EQ(count("area 99.954 %"), each) << where;
          EXPECT_EQ(count("moments −12.3 %"), each) << where;
          EXPECT_EQ(count("deepest lost, tips over"), each) << where;
          EXPECT_EQ(count("1234 ns"), has_ends ? each : 0) << where;
        }
        if (width >= 1280 && cells <= 19) {
          EXPECT_THAT(out, testing::IsEmpty()) << where;
        }
        EXPECT_EQ(std::ranges::count(words(picture.frame(0)), "kept area, hatched: lost") == 0,
                  std::ranges::count(out, "the legend") > 0)
            << where;
      }
    }
  }
}

TEST(ContactCells, HaveARingForEachKeptPointAndItsNumber) {
  const std::vector<ContactMoment> moments = moments_of(3, 1);
  const Drawing drawing = drawn(moments, 0);
  // One more in the legend.
  EXPECT_EQ(rings(drawing).size(), 3u * 4 + 1);
  const std::vector<std::string> said = words(drawing);
  for (const char* digit : {"1", "2", "3", "4"}) {
    EXPECT_EQ(std::ranges::count(said, digit), 3) << digit;
  }
  EXPECT_THAT(said, Not(Contains("5")));
  EXPECT_THAT(said,
              IsSupersetOf({"reducer_0", "reducer_2", "A crate on a floor", "area 99.954 %",
                            "1234 ns", "deepest lost, tips over", "kept area, hatched: lost"}));
}

TEST(ContactCells, AllPointsKeptAreRingedWithoutNumbers) {
  std::vector<trace::Point> four = octagon();
  four.resize(4);
  ContactMoment moment;
  moment.cells = {cell_of("area", four)};
  const Drawing drawing = drawn({moment}, 0);
  EXPECT_EQ(rings(drawing).size(), 4u + 1);
  EXPECT_THAT(words(drawing), Not(Contains("1")));
  EXPECT_THAT(words(drawing), Not(Contains("lost area")));
}

TEST(ContactCells, ShowAPointAtTheSamePlaceInAllCellsAndFrames) {
  std::vector<ContactMoment> moments = moments_of(6, 1);
  moments.push_back(moments_of(6, 1).front());
  moments[1].frame = 1;
  // In the second frame every cell loses a point that it did not keep; the others stay.
  for (ContactCell& cell : moments[1].cells) {
    cell.points.pop_back();
    cell.best.clear();
  }
  const std::vector<Disc> now = rings(drawn(moments, 0));
  const std::vector<Disc> then = rings(drawn(moments, 1));
  ASSERT_EQ(now.size(), 6u * 4 + 1);
  ASSERT_EQ(then.size(), now.size());
  for (std::size_t i = 0; i < now.size(); ++i) {
    EXPECT_EQ(now[i].center.x, then[i].center.x);
    EXPECT_EQ(now[i].center.y, then[i].center.y);
  }
  for (std::size_t cell = 1; cell < 6; ++cell) {
    const float dx = now[4 * cell].center.x - now[0].center.x;
    const float dy = now[4 * cell].center.y - now[0].center.y;
    EXPECT_GT(std::hypot(dx, dy), 50);
    for (std::size_t k = 1; k < 4; ++k) {
      EXPECT_NEAR(now[4 * cell + k].center.x - now[k].center.x, dx, 1e-3);
      EXPECT_NEAR(now[4 * cell + k].center.y - now[k].center.y, dy, 1e-3);
    }
  }
}

TEST(ContactCells, AreMapsSeenFromAboveAtOneScale) {
  ContactMoment moment;
  std::vector<trace::Point> places;
  for (const Vec3d& p : {Vec3d(0, 0, 0), Vec3d(3, 0, 0), Vec3d(0, 0, -1)}) {
    places.push_back({p, -0.01, "a:e" + std::to_string(places.size())});
  }
  moment.cells = {cell_of("area", places)};
  for (const double sign : {1.0, -1.0}) {  // for either order of the bodies
    moment.cells[0].normal = sign * Vec3d::UnitY();
    const std::vector<Disc> discs = rings(drawn({moment}, 0));
    ASSERT_GE(discs.size(), 3u);
    EXPECT_GT(discs[1].center.x, discs[0].center.x + 50);
    EXPECT_NEAR(discs[1].center.y, discs[0].center.y, 1e-3);
    EXPECT_NEAR(discs[2].center.x, discs[0].center.x, 1e-3);
    EXPECT_NEAR(discs[0].center.y - discs[2].center.y, (discs[1].center.x - discs[0].center.x) / 3,
                0.01);
  }
}

TEST(ContactCells, DistantPatchesAreEachCentredInTheirCell) {
  // The same octagon here, ten metres aside, and on a wall: x stays to the right.
  const auto moved = [](double shift, bool upright) {
    std::vector<trace::Point> points = octagon();
    for (trace::Point& point : points) {
      const Vec3d p = point.position;
      point.position = Vec3d(p.x() + shift, upright ? -p.z() : 3.0, upright ? 7.0 : p.z());
    }
    return points;
  };
  ContactMoment gap;
  gap.cells = {cell_of("here", moved(0, false)), cell_of("aside", moved(10, false)),
               cell_of("upright", moved(-4, true))};
  gap.cells[2].normal = Vec3d::UnitZ();
  ContactMoment together;
  together.cells = {cell_of("here", octagon()), cell_of("aside", octagon()),
                    cell_of("upright", octagon())};
  for (const auto& [width, height] : {std::pair{640, 360}, {1280, 720}}) {
    const std::vector<Disc> found = rings(drawn({gap}, 0, width, height));
    const std::vector<Disc> expected = rings(drawn({together}, 0, width, height));
    ASSERT_GE(found.size(), 3u * 4);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_NEAR(found[i].center.x, expected[i].center.x, 1e-3) << i;
      EXPECT_NEAR(found[i].center.y, expected[i].center.y, 1e-3) << i;
    }
  }
}

TEST(ContactCells, ACellWithoutContactHasANote) {
  std::vector<ContactMoment> moments = moments_of(2, 2);
  moments[1].cells[0].points.clear();
  moments[1].cells[0].kept.clear();
  moments[1].cells[0].best.clear();
  EXPECT_THAT(words(drawn(moments, 0)), Not(Contains("no contact in this frame")));
  const Drawing drawing = drawn(moments, 1);
  EXPECT_EQ(std::ranges::count(words(drawing), "no contact in this frame"), 1);
  EXPECT_EQ(rings(drawing).size(), 4u + 1);
  expect_on_canvas(drawing, "one without contact");
}

TEST(ContactCells, WithoutContactThereIsANote) {
  std::vector<trace::Frame> frames(3);
  for (int f = 0; f < 3; ++f) frames[static_cast<std::size_t>(f)].frame = f;
  frames[0].pairs.push_back({"crate", "floor", "", "hull-hull", "separated", 1, {}, {}, {}, {}});
  for (const int choices : {0, 3}) {
    for (const auto& [width, height] : {std::pair{320, 180}, {1280, 720}}) {
      const Drawing drawing = drawn(reduced(frames), 1, width, height, choices);
      expect_on_canvas(drawing, "nothing touches");
      EXPECT_THAT(words(drawing), Contains("nothing is reduced as one patch here:"));
      for (const Text& text : all<Text>(drawing)) {
        if (text.text.starts_with("nothing")) {
          EXPECT_NEAR(text.at.x, width / 2.0, 1);
        }
      }
      EXPECT_TRUE(rings(drawing).empty());
    }
  }
}

TEST(ContactCells, CoincidentAndCollinearPointsHavePlaces) {
  for (const Vec3d& step : {Vec3d(0, 0, 0), Vec3d(0.1, 0, 0), Vec3d(0, 0, 0.2),
                            Vec3d(1e-9, 0, -1e-9), Vec3d(0.1, 0, 0.1)}) {
    ContactMoment moment;
    std::vector<trace::Point> points;
    for (int i = 0; i < 8; ++i) {
      points.push_back({Vec3d(5, 1, 2) + i * step, -0.01, "a:e" + std::to_string(i)});
    }
    moment.cells = {cell_of("one", points), cell_of("two", points)};
    for (const int choices : {0, 1, 2, 3, 4}) {
      for (const auto& [width, height] : {std::pair{320, 180}, {1280, 720}}) {
        expect_on_canvas(drawn({moment}, 0, width, height, choices),
                         std::to_string(choices) + " choices");
      }
    }
  }
}

}  // namespace
}  // namespace contactscope::draw
