#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "manifold/dispatch.h"
#include "support/builders.h"

namespace contactscope {
namespace {

using test::kDegree;
using test::PairCase;

template <class S>
Manifold<S> recorded(const PairCase<S>& pair, const CollideOptions& options, trace::Pair& record) {
  record.a = "crate";
  record.b = "floor";
  Manifolds<S> manifolds;
  collide(Shape<S>(pair.a), pair.pose_a, Shape<S>(pair.b), pair.pose_b, options, manifolds, nullptr,
          &record);
  return manifolds.empty() ? Manifold<S>() : manifolds.front();
}

/// Compares bits, so that a zero and a negative zero differ.
template <class T> bool same_bits(const T& one, const T& other) {
  return std::memcmp(&one, &other, sizeof(T)) == 0;
}

template <class S> bool same_bits(const Manifold<S>& one, const Manifold<S>& other) {
  if (!same_bits(one.normal, other.normal) || one.axis != other.axis) return false;
  if (one.points.size() != other.points.size()) return false;
  for (std::size_t i = 0; i < one.points.size(); ++i) {
    if (!same_bits(one.points[i].position, other.points[i].position) ||
        !same_bits(one.points[i].separation, other.points[i].separation) ||
        one.points[i].id != other.points[i].id) {
      return false;
    }
  }
  return true;
}

/// Collides a pair with and without a record; increments `touching` if it touches.
template <class S>
void expect_same_when_watched(const PairCase<S>& pair, const CollideOptions& options,
                              int& touching) {
  trace::Pair record;
  const Manifold<S> watched = recorded(pair, options, record);
  Manifolds<S> unwatched;
  collide(Shape<S>(pair.a), pair.pose_a, Shape<S>(pair.b), pair.pose_b, options, unwatched);
  ASSERT_EQ(unwatched.empty(), watched.points.empty());
  if (!unwatched.empty()) {
    ASSERT_TRUE(same_bits(watched, unwatched[0]));
  }
  ASSERT_EQ(record.state, watched.points.empty() ? "separated" : "touching");
  ASSERT_EQ(record.manifolds.size(), watched.points.empty() ? 0u : 1u);
  touching += watched.points.empty() ? 0 : 1;
}

template <class S> class RecordOfAPair : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(RecordOfAPair, Scalars);

TYPED_TEST(RecordOfAPair, SlowChangesNoBitOfAnyManifold) {
  using S = TypeParam;
  test::Random random(99);
  int touching = 0;
  for (int i = 0; i < 10000; ++i) {
    const PairCase<S> pair = test::random_pair(random).template cast<S>();
    CollideOptions options;
    options.preference = i % 2 == 0 ? Preference::Relative : Preference::None;
    options.reducer = i % 3 == 0 ? nullptr : find_reducer("area");
    options.margin = i % 5 == 0 ? S(0.01) * pair.a.radius : S(0);
    ASSERT_NO_FATAL_FAILURE(expect_same_when_watched(pair, options, touching)) << "pair " << i;
  }
  EXPECT_GT(touching, 3000);
}

/// Without a record, large hulls skip faces and edges by bounds (face_bounds.h).
TYPED_TEST(RecordOfAPair, ChangesNoBitOfHullsThatAreSearchedByBounds) {
  using S = TypeParam;
  test::Random random(98);
  int touching = 0;
  for (int i = 0; i < 600; ++i) {
    PairCase<double> drawn{
        test::random_hull(random, 32, 0.5, 1), {}, test::random_hull(random, 32, 0.5, 1), {}};
    drawn.pose_a = {random.rotation(), random.vector(-5, 5)};
    drawn.pose_b.rotation = random.rotation();
    drawn.pose_b.position =
        drawn.pose_a.position + random.unit_vector() * random.uniform(0.8, 1.02);
    CollideOptions options;
    options.preference = i % 2 == 0 ? Preference::Relative : Preference::None;
    options.reducer = i % 3 == 0 ? nullptr : find_reducer("area");
    options.margin = i % 5 == 0 ? 0.005 : 0;
    ASSERT_NO_FATAL_FAILURE(expect_same_when_watched(drawn.template cast<S>(), options, touching))
        << "pair " << i;
  }
  EXPECT_GT(touching, 200);
  EXPECT_LT(touching, 600);
}

TYPED_TEST(RecordOfAPair, HoldsTheManifoldExactly) {
  using S = TypeParam;
  CollideOptions options;
  options.reducer = find_reducer("area");
  trace::Pair record;
  const Manifold<S> manifold =
      recorded(test::stacked_cubes(30 * kDegree, 0.01).cast<S>(), options, record);
  ASSERT_EQ(record.manifolds.size(), 1u);
  const trace::Manifold& written = record.manifolds[0];
  EXPECT_EQ(written.normal, manifold.normal.template cast<double>());
  EXPECT_EQ(written.axis, "face_a");
  EXPECT_EQ(written.triangle, std::nullopt);
  ASSERT_EQ(written.points.size(), manifold.points.size());
  for (std::size_t i = 0; i < written.points.size(); ++i) {
    EXPECT_EQ(written.points[i].position, manifold.points[i].position.template cast<double>());
    EXPECT_EQ(written.points[i].separation, static_cast<double>(manifold.points[i].separation));
    EXPECT_EQ(written.points[i].id, to_string(manifold.points[i].id));
  }
  EXPECT_EQ(record.separation, test::deepest(manifold));
}

TYPED_TEST(RecordOfAPair, HasTheStagesOfAFaceContact) {
  using S = TypeParam;
  CollideOptions options;
  options.reducer = find_reducer("area");
  trace::Pair record;
  recorded(test::stacked_cubes(45 * kDegree, 0.01).cast<S>(), options, record);
  const double rounding = 16 * std::numeric_limits<S>::epsilon();
  EXPECT_EQ(record.kind, "hull-hull");
  EXPECT_EQ(record.state, "touching");

  ASSERT_TRUE(record.sat.has_value());
  EXPECT_EQ(record.sat->chosen, "face_a");
  EXPECT_EQ(record.sat->preference, "relative");
  ASSERT_TRUE(record.sat->face_a && record.sat->face_b);
  EXPECT_EQ(record.sat->face_a->face, 2);
  EXPECT_NEAR(record.sat->face_a->separation, -0.01, rounding);
  EXPECT_NEAR(record.sat->face_a->support.y(), 0.49, rounding);
  EXPECT_NEAR(record.sat->face_b->normal.y(), 1, rounding);
  EXPECT_NEAR(record.sat->face_b->support.y(), 0.5, rounding);

  ASSERT_TRUE(record.clip.has_value());
  EXPECT_EQ(record.clip->reference.shape, "crate");
  EXPECT_EQ(record.clip->reference.face, 2);
  EXPECT_NEAR(record.clip->reference.normal.y(), 1, rounding);
  EXPECT_EQ(record.clip->reference.polygon.size(), 4u);
  EXPECT_EQ(record.clip->incident.shape, "floor");
  EXPECT_EQ(record.clip->incident.face, 3);
  EXPECT_NEAR(record.clip->incident.normal.y(), -1, rounding);
  EXPECT_EQ(record.clip->incident.polygon.size(), 4u);
  ASSERT_EQ(record.clip->steps.size(), 4u);
  std::size_t corners = 4;
  for (const trace::ClipStep& step : record.clip->steps) {
    EXPECT_NEAR(step.normal.norm(), 1, rounding);
    EXPECT_NEAR(step.normal.y(), 0, rounding);
    EXPECT_EQ(step.polygon.size(), ++corners);  // every side plane cuts one corner off
    for (const Vec3d& corner : step.polygon) {
      EXPECT_LE(step.normal.dot(corner), step.offset + rounding);
    }
  }
  EXPECT_TRUE(record.clip->dropped.empty());

  ASSERT_TRUE(record.reduction.has_value());
  EXPECT_EQ(record.reduction->method, "area");
  EXPECT_EQ(record.reduction->points.size(), 8u);
  ASSERT_EQ(record.reduction->kept.size(), 4u);
  // A regular octagon; the best four of its corners are every other one.
  const double octagon = 2 * (std::numbers::sqrt2 - 1);
  const double circumradius_squared = octagon / (2 * std::numbers::sqrt2);
  EXPECT_NEAR(record.reduction->best_area, 2 * circumradius_squared, rounding);
  EXPECT_LE(record.reduction->area, record.reduction->best_area + 1e-15);
  EXPECT_GT(record.reduction->area, 0.8 * record.reduction->best_area);
}

TYPED_TEST(RecordOfAPair, HasThePointsThatSpanTheBestArea) {
  using S = TypeParam;
  CollideOptions options;
  options.reducer = find_reducer("extremes");
  ASSERT_NE(options.reducer, nullptr);
  trace::Pair record;
  recorded(test::stacked_cubes(30 * kDegree, 0.01).cast<S>(), options, record);
  ASSERT_TRUE(record.reduction.has_value());
  const trace::Reduction& reduction = *record.reduction;
  ASSERT_EQ(reduction.best.size(), 4u);
  // Area of their quadrilateral, by the cross product of its diagonals.
  const auto at = [&](std::size_t k) {
    return reduction.points[static_cast<std::size_t>(reduction.best[k])].position;
  };
  std::vector<Vec3d> ring = {at(0), at(1), at(2), at(3)};
  const Vec3d middle = 0.25 * (ring[0] + ring[1] + ring[2] + ring[3]);
  std::ranges::sort(
      ring, {}, [&](const Vec3d& p) { return std::atan2(p.z() - middle.z(), p.x() - middle.x()); });
  const double area = 0.5 * (ring[2] - ring[0]).cross(ring[3] - ring[1]).norm();
  EXPECT_NEAR(area, reduction.best_area, 1e-6);
  EXPECT_GE(reduction.best_area, reduction.area - 1e-6);
}

TYPED_TEST(RecordOfAPair, SidePlanesAreInTheOrderOfTheReferencePolygon) {
  using S = TypeParam;
  trace::Pair record;
  recorded(test::stacked_cubes(20 * kDegree, 0.01).cast<S>(), {}, record);
  const trace::Polygon& polygon = record.clip->reference.polygon;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const trace::ClipStep& step = record.clip->steps[k];
    const double rounding = 16 * std::numeric_limits<S>::epsilon();
    EXPECT_NEAR(step.normal.dot(polygon[k]), step.offset, rounding);
    EXPECT_NEAR(step.normal.dot(polygon[(k + 1) % polygon.size()]), step.offset, rounding);
  }
}

TYPED_TEST(RecordOfAPair, HasTheDroppedPointsAndWhy) {
  using S = TypeParam;
  PairCase<double> pair = test::stacked_cubes(0, 0);
  pair.pose_b.rotation = test::about(Vec3d::UnitZ(), 5 * kDegree);
  pair.pose_b.position.y() = 1.03;
  trace::Pair record;
  recorded(pair.cast<S>(), {}, record);
  ASSERT_EQ(record.clip->dropped.size(), 2u);
  for (const trace::DroppedPoint& dropped : record.clip->dropped) {
    EXPECT_GT(dropped.position.y(), 0.5);
    EXPECT_EQ(dropped.reason, "above the reference face");
  }
  EXPECT_FALSE(record.reduction.has_value());
}

TYPED_TEST(RecordOfAPair, HasTheBestOfEveryQueryEvenIfEdgesCannotWin) {
  using S = TypeParam;
  // A tilted small cube well inside the face of a large one.
  PairCase<double> pair{test::cube(0.5), test::at(0, 0, 0), test::cube(0.2), test::at(0, 0.69, 0)};
  pair.pose_b.rotation = test::about({1, 0, 1}, 3 * kDegree);
  trace::Pair record;
  recorded(pair.cast<S>(), {}, record);
  ASSERT_TRUE(record.sat->edge.has_value());
  EXPECT_LT(record.sat->edge->separation, record.sat->face_a->separation);
  EXPECT_NEAR(record.sat->edge->normal.norm(), 1, 1e-6);
}

TYPED_TEST(RecordOfAPair, HasTheEdgesOfAnEdgeContact) {
  using S = TypeParam;
  trace::Pair record;
  recorded(test::crossed_edges(1, 0.01).cast<S>(), {}, record);
  EXPECT_EQ(record.sat->chosen, "edge_edge");
  EXPECT_FALSE(record.clip.has_value());
  ASSERT_TRUE(record.sat->edge.has_value());
  const trace::EdgeAxis& edge = *record.sat->edge;
  const double rounding = 32 * std::numeric_limits<S>::epsilon();
  EXPECT_NEAR(edge.separation, -0.01, rounding);
  EXPECT_LT((edge.point_b - edge.point_a - edge.separation * edge.normal).norm(), rounding);
  EXPECT_EQ(record.manifolds[0].points[0].id,
            "a:e" + std::to_string(edge.a) + " b:e" + std::to_string(edge.b));
}

TYPED_TEST(RecordOfAPair, StopsWithTheEarlyOut) {
  using S = TypeParam;
  trace::Pair record;
  recorded(test::stacked_cubes(20 * kDegree, -0.25).cast<S>(), {}, record);
  EXPECT_EQ(record.state, "separated");
  EXPECT_NEAR(record.separation, 0.25, 1e-6);
  EXPECT_TRUE(record.manifolds.empty());
  ASSERT_TRUE(record.sat.has_value());
  EXPECT_EQ(record.sat->chosen, "face_a");
  EXPECT_TRUE(record.sat->face_a.has_value());
  EXPECT_FALSE(record.sat->face_b.has_value());
  EXPECT_FALSE(record.sat->edge.has_value());
  EXPECT_FALSE(record.clip.has_value());
}

}  // namespace
}  // namespace contactscope
