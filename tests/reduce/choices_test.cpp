#include "reduce/choices.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "reduce/plane_points.h"
#include "reduce/steps.h"
#include "support/contact_polygons.h"

namespace contactscope::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const Vec3d kUp = Vec3d::UnitY();

/// The result of a reducer, and the choices that it records.
struct ReportInput {
  std::vector<int> kept;
  std::vector<trace::Choice> made;
};

ReportInput record(const std::string& reducer, const std::vector<ContactPoint<double>>& points,
                   const Vec3d& normal = kUp, int max_points = 4) {
  Choices choices{{points, normal}};
  ReduceOptions options;
  options.max_points = max_points;
  options.choices = &choices;
  const KeptIndices kept = reduce<double>(find_reducer(reducer), points, normal, options);
  return {{kept.begin(), kept.end()}, choices.made};
}

std::vector<trace::Choice> choices(const std::string& reducer,
                                   const std::vector<ContactPoint<double>>& points,
                                   int max_points = 4) {
  return record(reducer, points, kUp, max_points).made;
}

std::vector<std::string> rules(const std::vector<trace::Choice>& made) {
  std::vector<std::string> list;
  for (const trace::Choice& choice : made) list.emplace_back(choice.rule);
  return list;
}

std::vector<double> values(const trace::Choice& choice) {
  std::vector<double> list;
  for (const trace::Measure& measure : choice.measures) list.push_back(measure.value);
  return list;
}

std::vector<int> candidates(const trace::Choice& choice) {
  std::vector<int> list;
  for (const trace::Measure& measure : choice.measures) list.push_back(measure.point);
  return list;
}

/// With integer coordinates: the talk's order is 1 (far right), 0, 2, 4. Depth is largest at 3.
std::vector<ContactPoint<double>> hand_made() {
  return points_at(
      {{-10, 0, 0.1}, {10, 0, 0.2}, {9, -4, 0.3}, {11, -2, 0.6}, {0, 1, 0.5}, {0, 0, 0.4}});
}

TEST(Choices, AHandMadePolygonHasTheRulesInOrder) {
  EXPECT_THAT(rules(choices("area", hand_made())),
              ElementsAre("support", "farthest", "triangle", "outside"));
  EXPECT_THAT(rules(choices("area_deepest", hand_made())),
              ElementsAre("deepest", "farthest", "triangle", "outside"));
  EXPECT_THAT(rules(choices("distance", hand_made())),
              ElementsAre("support", "farthest", "triangle", "distance"));
}

TEST(Choices, AHandMadePolygonIsExact) {
  const std::vector<ContactPoint<double>> points =
      points_at({{0, 0, 1}, {4, 0, 2}, {4, 3, 7}, {0, 3, 3}, {2, 5, 4}, {6, 1, 5}});
  // As if 2, 0, 5 and 3 were kept.
  Choices choices{{points, kUp}};
  choices.deepest();
  choices.farthest(2);
  choices.triangle(2, 0);
  choices.outside(std::vector<int>{2, 5, 0}, 2, 3, false);
  const std::vector<trace::Choice>& made = choices.made;
  ASSERT_EQ(made.size(), 4u);
  EXPECT_THAT(values(made[0]), ElementsAre(1, 2, 7, 3, 4, 5));  // depths
  EXPECT_THAT(candidates(made[1]), ElementsAre(0, 1, 3, 4, 5));
  EXPECT_THAT(values(made[1]), ElementsAre(5, 3, 4, std::sqrt(8), std::sqrt(8)));
  // (q, 2, 0), seen against y: x to the right, z towards the viewer, so a positive area turns from
  // z to x. Point 5 is on the other side of the diagonal than 3 and 4.
  EXPECT_THAT(candidates(made[2]), ElementsAre(1, 3, 4, 5));
  const std::vector<double> triangles = values(made[2]);
  EXPECT_DOUBLE_EQ(std::abs(triangles[0]), 6);
  EXPECT_DOUBLE_EQ(std::abs(triangles[1]), 6);
  EXPECT_DOUBLE_EQ(std::abs(triangles[2]), 7);
  EXPECT_DOUBLE_EQ(std::abs(triangles[3]), 7);
  EXPECT_LT(triangles[0] * triangles[1], 0);
  EXPECT_LT(triangles[2] * triangles[3], 0);
  for (const trace::Measure& measure : made[2].measures) {
    EXPECT_EQ(measure.edge[0], 2);
    EXPECT_EQ(measure.edge[1], 0);
  }
  // Triangle 2 0 5: point 1 is outside 0-5, 4 is outside 2-0, and the chosen 3 lists all edges.
  EXPECT_THAT(candidates(made[3]), ElementsAre(1, 3, 3, 3, 4));
  EXPECT_DOUBLE_EQ(made[3].measures[0].value, -2);
  EXPECT_DOUBLE_EQ(made[3].measures[4].value, -7);
  double sum = 0;
  double least = 0;
  for (std::size_t i = 1; i < 4; ++i) {
    sum += made[3].measures[i].value;
    least = std::min(least, made[3].measures[i].value);
  }
  EXPECT_DOUBLE_EQ(sum, 7);  // the triangle's own area
  EXPECT_DOUBLE_EQ(least, -6);
}

TEST(Choices, ADistanceReducerMeasuresDistancesFromEdges) {
  // 1 0 2 first. Point 4 is 1 m from the long edge; 3 is farther from the short one, but adds less.
  const std::vector<ContactPoint<double>> points =
      points_at({{-10, 0}, {10, 0}, {10, -4}, {11.5, -2}, {0, 1}});
  const auto [kept, made] = record("distance", points);
  ASSERT_EQ(made.size(), 4u);
  double most = 0;
  int farthest = -1;
  for (const trace::Measure& measure : made[3].measures) {
    const Vec3d a = points[static_cast<std::size_t>(measure.edge[0])].position;
    const Vec3d along = points[static_cast<std::size_t>(measure.edge[1])].position - a;
    const Vec3d arm = points[static_cast<std::size_t>(measure.point)].position - a;
    EXPECT_NEAR(std::abs(measure.value),
                (arm - arm.dot(along) / along.squaredNorm() * along).norm(), 1e-12);
    if (-measure.value > most) {
      most = -measure.value;
      farthest = measure.point;
    }
  }
  EXPECT_EQ(farthest, kept[3]);
}

TEST(Choices, StartFromTheFixedDirection) {
  const std::vector<trace::Choice> made = choices("area", hand_made());
  EXPECT_NEAR(made[0].direction.norm(), 1, 1e-15);
  EXPECT_NEAR(made[0].direction.dot(kUp), 0, 1e-15);
  EXPECT_NEAR(made[0].direction.cross(steps::fixed_direction<double>(kUp)).norm(), 0, 1e-15);
  for (std::size_t i = 1; i < made.size(); ++i) EXPECT_TRUE(made[i].direction.isZero());
  EXPECT_TRUE(choices("area_deepest", hand_made())[0].direction.isZero());
}

/// The measure that decides for a point in one step: the largest is best.
double worth(const trace::Choice& choice, int point) {
  const std::string rule = choice.rule;
  double most = -std::numeric_limits<double>::infinity();
  for (const trace::Measure& measure : choice.measures) {
    if (measure.point != point) continue;
    double value = measure.value;
    if (rule == "triangle") value = std::abs(value);
    if (rule == "outside" || rule == "distance") value = -value;
    most = std::max(most, value);
  }
  return most;
}

class ChoicesOf : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Reducers, ChoicesOf, testing::Values("area", "area_deepest", "distance"),
                         [](const auto& test) { return std::string(test.param); });

TEST_P(ChoicesOf, RandomPolygonsAreBestAtEachStepInTheKeptOrder) {
  Random random(11);
  int steps = 0;
  for (int i = 0; i < 400; ++i) {
    const ContactPolygon polygon = random_contact_polygon(random, 5 + random.index(12));
    const double scale = polygon.points.size() * 1e-9;
    const int max_points = 1 + random.index(7);
    const auto [kept, made] = record(GetParam(), polygon.points, polygon.normal, max_points);
    if (kept.size() == polygon.points.size()) {
      EXPECT_THAT(made, IsEmpty());
      continue;
    }
    ASSERT_EQ(made.size(), kept.size());
    for (std::size_t step = 0; step < made.size(); ++step) {
      ++steps;
      const double chosen = worth(made[step], kept[step]);
      for (int q = 0; q < static_cast<int>(polygon.points.size()); ++q) {
        const bool before = std::find(kept.begin(), kept.begin() + step, q) != kept.begin() + step;
        const auto count = std::ranges::count(candidates(made[step]), q);
        if (before) {
          EXPECT_EQ(count, 0) << "kept before step " << step;
        } else {
          EXPECT_GE(count, 1) << step;
          EXPECT_GE(chosen, worth(made[step], q) - scale) << made[step].rule << " of step " << step;
        }
        const bool other = !before && q != kept[step];
        if (step > 2 && other) {
          EXPECT_EQ(count, 1);
        }
      }
      if (step > 2) {
        EXPECT_EQ(std::ranges::count(candidates(made[step]), kept[step]),
                  static_cast<std::ptrdiff_t>(step));
        EXPECT_GT(chosen, 0) << "a point that adds nothing was kept";
      }
    }
  }
  EXPECT_GT(steps, 1000);
}

TEST(Choices, ExtremesAreSupportPointsAlongTwoAxes) {
  // Lowest and highest in x and z, and two that are neither.
  const auto points = points_at({{-2, 0.5}, {3, 0.2}, {0.1, -1}, {0.3, 1.5}, {1, 1}, {-1, -0.5}});
  const auto [kept, made] = record("extremes", points);
  EXPECT_THAT(rules(made), ElementsAre("support", "support", "support", "support"));
  EXPECT_THAT(std::set<int>(kept.begin(), kept.end()), ElementsAre(0, 1, 2, 3));
  for (std::size_t i = 0; i < made.size(); ++i) {
    EXPECT_NEAR(made[i].direction.norm(), 1, 1e-12);
    EXPECT_NEAR(std::abs(made[i].direction.x()) + std::abs(made[i].direction.z()), 1, 1e-12);
    for (const trace::Measure& measure : made[i].measures)
      EXPECT_LE(measure.value, worth(made[i], kept[i])) << i;
  }
  EXPECT_NEAR(made[0].direction.dot(made[1].direction), -1, 1e-12);
  EXPECT_NEAR(made[0].direction.dot(made[2].direction), 0, 1e-12);
}

TEST_P(ChoicesOf, EdgeAreasOfAFourthPointAddUpToTheTriangle) {
  if (GetParam() == std::string("distance")) return;  // measures no areas
  Random random(12);
  for (int i = 0; i < 200; ++i) {
    const ContactPolygon polygon = random_contact_polygon(random, 8);
    const ReportInput record_of = record(GetParam(), polygon.points, polygon.normal);
    const std::vector<int>& kept = record_of.kept;
    const std::vector<trace::Choice>& made = record_of.made;
    if (kept.size() < 4) continue;
    double sum = 0;
    for (const trace::Measure& measure : made[3].measures) {
      if (measure.point == kept[3]) sum += measure.value;
    }
    const auto at = [&](int k) {
      return polygon.points[static_cast<std::size_t>(kept[k])].position;
    };
    const double triangle = 0.5 * (at(1) - at(0)).cross(at(2) - at(0)).norm();
    EXPECT_NEAR(sum, triangle, 1e-9 * (1 + triangle));
  }
}

TEST_P(ChoicesOf, PointsOnALineOrInOnePlaceHaveFiniteMeasures) {
  for (const auto& places : {std::vector<PlanePoint>(6, PlanePoint{1, 2, 0.1}),
                             std::vector<PlanePoint>{{0, 0}, {1, 1}, {2, 2}, {3, 3}, {4, 4, 1}}}) {
    const std::vector<ContactPoint<double>> points = points_at(places);
    const auto [kept, made] = record(GetParam(), points);
    EXPECT_EQ(made.size(), kept.size());
    for (const trace::Choice& choice : made) {
      EXPECT_TRUE(choice.direction.allFinite());
      for (const double value : values(choice)) EXPECT_TRUE(std::isfinite(value)) << choice.rule;
    }
  }
}

TEST(Choices, AreEmptyForOtherReducersAndWhereNothingWasReduced) {
  const std::vector<ContactPoint<double>> points = hand_made();
  for (const ReducerInfo& info : reducers()) {
    const bool steps = info.name == "area" || info.name == "area_deepest" ||
                       info.name == "distance" || info.name == "extremes";
    EXPECT_EQ(choices(info.name, points).empty(), !steps) << info.name;
    EXPECT_THAT(choices(info.name, points, 6), IsEmpty()) << info.name;
    EXPECT_THAT(choices(info.name, {}), IsEmpty()) << info.name;
  }
}

}  // namespace
}  // namespace contactscope::test
