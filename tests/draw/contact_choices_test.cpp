#include "draw/insets/contact_cells.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "draw/contact_cells_sample.h"
#include "draw/scene/quantity.h"

namespace contactscope::draw {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsSupersetOf;

/// The octagon with the steps that chose its four points.
std::vector<ContactMoment> chosen() {
  std::vector<ContactMoment> moments = moments_of(1, 1);
  ContactCell& cell = moments[0].cells[0];
  cell.choices.resize(4);
  cell.choices[0].rule = "support";
  cell.choices[0].direction = Vec3d(0.6, 0, 0.8);
  cell.choices[1].rule = "farthest";
  cell.choices[2].rule = "triangle";
  cell.choices[3].rule = "outside";
  for (int q = 0; q < 8; ++q) {
    if (q == 1) continue;
    cell.choices[1].measures.push_back({q, trace::kNoEdge, 1.234 + q});
    if (q == 5) continue;
    cell.choices[2].measures.push_back({q, {{1, 5}}, q % 2 ? 0.5 : -0.25});
    if (q == 3) continue;
    cell.choices[3].measures.push_back({q, {{1, 3}}, q == 0 ? -0.5 : -0.1});
  }
  cell.choices[3].measures.push_back({0, {{3, 5}}, 0.75});
  cell.choices[3].measures.push_back({0, {{5, 1}}, 0.25});
  return moments;
}

TEST(ContactCells, LabelsOfAChoiceDoNotOverlap) {
  for (const auto& [width, height] : {std::pair{640, 360}, {1280, 720}}) {
    for (int choices = 1; choices <= 4; ++choices) {
      const Drawing drawing = drawn(chosen(), 0, width, height, choices);
      expect_on_canvas(drawing, std::to_string(choices) + " choices");
      const std::vector<Text> list = all<Text>(drawing);
      for (std::size_t i = 0; i < list.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
          const Rect a = box_of(list[i]);
          const Rect b = box_of(list[j]);
          EXPECT_FALSE(a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height &&
                       b.y < a.y + a.height)
              << width << " wide, " << choices << " choices: " << list[i].text << " on "
              << list[j].text;
        }
      }
    }
  }
}

TEST(ContactCells, TheThirdChoiceShowsAreasAcrossTheEdgeAsNegativeWhateverTheWinding) {
  std::vector<ContactMoment> moments = chosen();
  for (const bool turned : {false, true}) {
    EXPECT_THAT(words(drawn(moments, 0, 1280, 720, 3)),
                IsSupersetOf({"+0.5000 m²", "−0.2500 m², clockwise"}))
        << turned;
    for (trace::Measure& measure : moments[0].cells[0].choices[2].measures)
      measure.value = -measure.value;
  }
}

TEST(ContactCells, AThirdPointAloneHasItsCrossProduct) {
  std::vector<ContactMoment> moments = chosen();
  moments[0].cells.resize(1);
  for (const bool turned : {false, true}) {
    EXPECT_THAT(words(drawn(moments, 0, 1280, 720, 3)),
                IsSupersetOf({"½ n · (e × f) = +0.5000 m²", "e", "f"}))
        << turned;
    for (trace::Measure& measure : moments[0].cells[0].choices[2].measures)
      measure.value = -measure.value;
  }
}

TEST(ContactCells, AChoiceShowsWhatEachCandidateWasWorth) {
  EXPECT_THAT(words(drawn(chosen(), 0, 1280, 720, 1)), Contains("fixed direction"));
  const std::vector<std::string> second = words(drawn(chosen(), 0, 1280, 720, 2));
  EXPECT_EQ(std::ranges::count_if(second, [](const std::string& s) { return s.ends_with(" m"); }),
            7);
  const std::vector<std::string> third = words(drawn(chosen(), 0, 1280, 720, 3));
  EXPECT_THAT(third, IsSupersetOf({"+0.5000 m²", "−0.2500 m², clockwise", "largest triangle"}));
  EXPECT_EQ(
      std::ranges::count_if(third, [](const std::string& s) { return s.find("²") != s.npos; }), 6);
  const std::vector<std::string> fourth = words(drawn(chosen(), 0, 1280, 720, 4));
  // The chosen point's area outside one edge, and another's; areas inside other edges do not count.
  EXPECT_THAT(fourth, IsSupersetOf({"0.5000 m²", "0.1000 m² (−0.05)"}));
  EXPECT_THAT(fourth, testing::Not(Contains("0.7500 m²")));
  // Rings of the choices so far, the legend's, and the normal's out of the page.
  for (int choices = 1; choices <= 4; ++choices) {
    EXPECT_EQ(rings(drawn(chosen(), 0, 1280, 720, choices)).size(),
              static_cast<std::size_t>(choices == 3 ? 5 : choices + 1));
  }
}

// The shares solve: the fourth point is the weighted mean of the other three.
TEST(ContactCells, TheFourthChoiceShowsItsBarycentricCoordinates) {
  const std::vector<trace::Point> points = octagon();
  Mat3<double> corners;
  const std::vector<int> kept = chosen()[0].cells[0].kept;
  for (int k = 0; k < 3; ++k) {
    const Vec3d& corner =
        points[static_cast<std::size_t>(kept[static_cast<std::size_t>(k)])].position;
    corners.col(k) = Vec3d(corner.x(), 1, corner.z());
  }
  const Vec3d& fourth = points[static_cast<std::size_t>(kept[3])].position;
  const Vec3d weights = corners.inverse() * Vec3d(fourth.x(), 1, fourth.z());
  ASSERT_LT(weights.minCoeff(), 0);
  const auto signed_share = [](double share) {
    return (share > 0 ? "+" : "") + spell_number(share, 3);
  };
  EXPECT_THAT(
      words(drawn(chosen(), 0, 1920, 720, 4)),
      IsSupersetOf({signed_share(weights[0]), signed_share(weights[1]), signed_share(weights[2]),
                    std::string("outside: added"), std::string("inside: skipped")}));
}

TEST(ContactCells, TheLegendOfAChoiceListsItsMarks) {
  const auto record = [](int choices) { return words(drawn(chosen(), 0, 1280, 720, choices)); };
  EXPECT_THAT(record(4), IsSupersetOf({"added outside", "triangle so far"}));
  EXPECT_THAT(record(2), testing::Not(Contains("added outside")));
  std::vector<ContactMoment> by_distance = chosen();
  by_distance[0].cells[0].choices[3].rule = "distance";
  const std::vector<std::string> said = words(drawn(by_distance, 0, 1280, 720, 4));
  // The distance and the area it adds: 500 mm from the line 1-3, the area from the positions.
  const auto along = [](const trace::Point& p) { return p.position; };
  const std::vector<trace::Point> p = octagon();
  const double area = 0.5 * (along(p[3]) - along(p[1])).cross(along(p[0]) - along(p[1])).norm();
  EXPECT_THAT(said, IsSupersetOf({std::string("0.500 m"), spell_area(area),
                                  std::string("distance to the edge")}));
}

TEST(ContactCells, AFifthChoiceStandsOutsideOfTheFourBeforeIt) {
  std::vector<ContactMoment> moments = chosen();
  ContactCell& cell = moments[0].cells[0];
  cell.kept.push_back(2);
  cell.choices.push_back({"outside", Vec3d::Zero(), {{2, {{1, 3}}, -0.25}, {4, {{3, 5}}, -0.125}}});
  const std::vector<std::string> said = words(drawn(moments, 0, 1280, 720, 5));
  EXPECT_THAT(
      said, IsSupersetOf({"kept area", "added outside", "deepest", "0.2500 m²", "0.1250 m²", "5"}));
  EXPECT_THAT(said, testing::Not(Contains("triangle so far")));
}

TEST(ContactCells, MoreChoicesThanWereMadeShowTheLast) {
  EXPECT_EQ(rings(drawn(chosen(), 0, 1280, 720, 64)).size(), 4u + 1);
}

TEST(Explored, HasACellForEachReducerInOrder) {
  trace::Exploration exploration;
  exploration.frame = 7;
  exploration.a = "crate";
  exploration.b = "floor";
  exploration.points = octagon();
  exploration.normal = Vec3d::UnitY();
  exploration.best = {0, 2, 4, 6};
  for (const char* name : {"area", "first"}) {
    trace::ReducerAnswer answer;
    answer.name = name;
    answer.kept = {3, 1};
    exploration.reducers.push_back(answer);
  }
  exploration.reducers[1].deepest_kept = true;
  exploration.reducers[1].supports_center_of_mass = true;
  const std::vector<ContactMoment> moments = explored({exploration}, {"first", "area"});
  ASSERT_EQ(moments.size(), 1u);
  EXPECT_EQ(moments[0].frame, 7);
  EXPECT_THAT(moments[0].caption, HasSubstr("crate and floor"));
  ASSERT_EQ(moments[0].cells.size(), 2u);
  EXPECT_EQ(moments[0].cells[0].name, "first");
  EXPECT_EQ(moments[0].cells[1].name, "area");
  EXPECT_THAT(moments[0].cells[1].kept, testing::ElementsAre(3, 1));
  EXPECT_EQ(moments[0].cells[0].points.size(), 8u);
  EXPECT_FALSE(moments[0].cells[0].rows.back().strong);
  EXPECT_TRUE(moments[0].cells[1].rows.back().strong);
}

TEST(Reduced, HasACellForEachPairThatIsReducedInAnyFrame) {
  trace::Pair touching{"crate", "floor", "", "hull-hull", "touching", -0.01, {}, {}, {}, {}};
  touching.manifolds.push_back({Vec3d::UnitY(), "face_a", {}, {}});
  touching.reduction = trace::Reduction{"area", octagon(), {1, 5, 3, 0}, 1, 2, {0, 2, 4, 6}, {}};
  trace::Pair separation{"crate", "floor", "", "hull-hull", "separated", 1, {}, {}, {}, {}};
  trace::Pair labelled = touching;
  labelled.label = "by hand";
  std::vector<trace::Frame> frames(2);
  frames[0].frame = 4;
  frames[0].pairs = {separation, labelled};
  frames[1].frame = 5;
  frames[1].pairs = {touching, labelled};
  const std::vector<ContactMoment> moments = reduced(frames);
  ASSERT_EQ(moments.size(), 2u);
  EXPECT_EQ(moments[1].frame, 5);
  for (const ContactMoment& moment : moments) {
    ASSERT_EQ(moment.cells.size(), 2u);
    EXPECT_EQ(moment.cells[0].name, "by hand");
    EXPECT_EQ(moment.cells[1].name, "area");
  }
  EXPECT_TRUE(moments[0].cells[1].points.empty());
  EXPECT_EQ(moments[1].cells[1].points.size(), 8u);
  EXPECT_EQ(moments[1].cells[1].best.size(), 4u);
}

}  // namespace
}  // namespace contactscope::draw
