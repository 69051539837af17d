#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>

#include "geometry/hull_builder.h"
#include "round_hull_cases.h"
#include "support/builders.h"

namespace contactscope {
namespace {

using test::about;
using test::at;
using test::kDegree;
using test::Random;
using test::RoundHull;

/// On a box with its top face at y = 0, 2 m by 2 m and 1 m deep.
RoundHull on_box(const Vec3d& from, const Vec3d& to, double radius) {
  return {{from, to}, radius, at(0, 0, 0), make_box(Vec3d(1, 0.5, 1)), at(0, -0.5, 0)};
}

RoundHull moved(RoundHull pair, const Vec3d& by) {
  pair.round_pose.position += by;
  return pair;
}

/// The pair at another place and size; all relations stay.
RoundHull placed(const RoundHull& pair, double size, const Pose<double>& pose) {
  RoundHull result = pair;
  for (Vec3d& point : result.core) point *= size;
  result.radius *= size;
  std::vector<Vec3d> vertices = pair.hull.vertices;
  for (Vec3d& vertex : vertices) vertex *= size;
  result.hull = build_hull(vertices);
  for (Pose<double>* place : {&result.round_pose, &result.hull_pose}) {
    place->position *= size;
    *place = compose(pose, *place);
    place->rotation.normalize();
  }
  return result;
}

std::string ids(const auto& manifold) {
  std::string result;
  for (const auto& point : manifold.points) {
    result += (result.empty() ? "" : ", ") + to_string(point.id);
  }
  return result;
}

template <class S> class CapsuleHull : public testing::Test {
 protected:
  static constexpr double kEpsilon = std::numeric_limits<S>::epsilon();

  static Manifold<S> collide(const RoundHull& pair, double margin = 0) {
    CollideOptions options;
    options.margin = static_cast<S>(margin);
    return test::collide<S>(pair, options);
  }

  static double deepest(const Manifold<S>& manifold) {
    return static_cast<double>(manifold.points[0].separation);
  }
  static Vec3d normal(const Manifold<S>& manifold) {
    return manifold.normal.template cast<double>();
  }
  static Vec3d position(const Manifold<S>& manifold, std::size_t point) {
    return manifold.points[point].position.template cast<double>();
  }
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(CapsuleHull, Scalars);

TYPED_TEST(CapsuleHull, LyingOnAFaceHasTwoPointsShallowAndDeepAlike) {
  for (const double height : {0.09, 0.01, 0.0, -0.01, -0.3}) {
    SCOPED_TRACE(height);
    const auto manifold =
        this->collide(on_box(Vec3d(-0.4, height, 0.2), Vec3d(0.5, height, 0.2), 0.1));
    ASSERT_EQ(manifold.points.size(), 2u);
    EXPECT_EQ(manifold.axis, AxisKind::FaceB);
    EXPECT_EQ(manifold.type, ContactType::EdgeFace);
    EXPECT_EQ(ids(manifold), "a:v0 b:f2, a:v1 b:f2");
    EXPECT_LT((this->normal(manifold) + Vec3d::UnitY()).norm(), 4 * this->kEpsilon);
    for (const auto& point : manifold.points) {
      EXPECT_NEAR(point.separation, height - 0.1, 8 * this->kEpsilon);
    }
    EXPECT_LT((this->position(manifold, 0) - Vec3d(-0.4, 0, 0.2)).norm(), 8 * this->kEpsilon);
    EXPECT_LT((this->position(manifold, 1) - Vec3d(0.5, 0, 0.2)).norm(), 8 * this->kEpsilon);
  }
}

TYPED_TEST(CapsuleHull, OverhangingSegmentIsClippedAtTheSidePlanes) {
  for (const double height : {0.05, -0.05}) {
    SCOPED_TRACE(height);
    const auto manifold =
        this->collide(on_box(Vec3d(-1.5, height, 0.2), Vec3d(0.5, height, 0.2), 0.1));
    ASSERT_EQ(manifold.points.size(), 2u);
    EXPECT_EQ(manifold.type, ContactType::EdgeFace);
    EXPECT_LT((this->position(manifold, 0) - Vec3d(-1, 0, 0.2)).norm(), 16 * this->kEpsilon);
    EXPECT_LT((this->position(manifold, 1) - Vec3d(0.5, 0, 0.2)).norm(), 16 * this->kEpsilon);
    EXPECT_EQ(manifold.points[0].id.first, edge_ref(Owner::A, 0));
    EXPECT_EQ(manifold.points[0].id.second.kind, FeatureKind::Edge);
    EXPECT_EQ(manifold.points[1].id, FeatureId::of(vertex_ref(Owner::A, 1), face_ref(Owner::B, 2)));
  }
}

TYPED_TEST(CapsuleHull, TiltedSegmentHasItsSecondPointWhileThatOverlaps) {
  // The far end is 0.05 above the low one: first within the radius, then outside.
  for (const double low : {0.04, 0.06}) {
    const auto manifold =
        this->collide(on_box(Vec3d(-0.4, low, 0), Vec3d(0.4, low + 0.05, 0), 0.1));
    ASSERT_EQ(manifold.points.size(), low < 0.05 ? 2u : 1u);
    EXPECT_NEAR(this->deepest(manifold), low - 0.1, 8 * this->kEpsilon);
    EXPECT_LT((this->normal(manifold) + Vec3d::UnitY()).norm(), 4 * this->kEpsilon);
    EXPECT_EQ(manifold.points[0].id, FeatureId::of(vertex_ref(Owner::A, 0), face_ref(Owner::B, 2)));
  }
  const RoundHull high = on_box(Vec3d(-0.4, 0.06, 0), Vec3d(0.4, 0.11, 0), 0.1);
  EXPECT_EQ(this->collide(high).type, ContactType::PointFace);
  EXPECT_EQ(this->collide(high, 0.02).points.size(), 2u);  // separation 0.01, within the margin
}

TYPED_TEST(CapsuleHull, AcrossAnEdgeTouchesInOnePointWithTheNormalOfBoth) {
  // A box with an edge up along x at y = 0, and a segment along z that passes over it.
  for (const double height : {0.07, -0.03}) {
    SCOPED_TRACE(height);
    const double half = 0.5;
    const RoundHull pair{{Vec3d(0.1, height, -1), Vec3d(0.1, height, 1)},
                         0.1,
                         at(0, 0, 0),
                         make_box(Vec3d(1, half, half)),
                         {about(Vec3d::UnitX(), 45 * kDegree), Vec3d(0, -half * std::sqrt(2), 0)}};
    const auto manifold = this->collide(pair);
    ASSERT_EQ(manifold.points.size(), 1u);
    EXPECT_EQ(manifold.axis, height > 0 ? AxisKind::ClosestPoints : AxisKind::EdgeEdge);
    EXPECT_EQ(manifold.type, ContactType::EdgeEdge);
    EXPECT_EQ(manifold.points[0].id.first, edge_ref(Owner::A, 0));
    EXPECT_EQ(manifold.points[0].id.second.kind, FeatureKind::Edge);
    EXPECT_LT((this->normal(manifold) + Vec3d::UnitY()).norm(), 8 * this->kEpsilon);
    EXPECT_NEAR(this->deepest(manifold), height - 0.1, 8 * this->kEpsilon);
    // On the hull's edge if shallow, midway between both edges if deep.
    const Vec3d place(0.1, std::min(0.5 * height, 0.0), 0);
    EXPECT_LT((this->position(manifold, 0) - place).norm(), 16 * this->kEpsilon);
  }
}

TYPED_TEST(CapsuleHull, AlongAnEdgeHasTwoPointsOutsideOfEveryFacesPrism) {
  // Rolling off the box's edge x = 1: the normal leans, the stretch along the edge stays.
  for (const double angle : {0.0, 1e-3, 10.0, 45.0, 80.0, 90.0}) {
    SCOPED_TRACE(angle);
    const Vec3d outward(std::sin(angle * kDegree), std::cos(angle * kDegree), 0);
    const Vec3d middle = Vec3d(1, 0, 0) + 0.08 * outward;
    const auto manifold =
        this->collide(on_box(middle - 0.6 * Vec3d::UnitZ(), middle + 0.6 * Vec3d::UnitZ(), 0.1));
    ASSERT_EQ(manifold.points.size(), 2u);
    EXPECT_LT((this->normal(manifold) + outward).norm(), 256 * this->kEpsilon);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_NEAR(manifold.points[i].separation, -0.02, 16 * this->kEpsilon);
      EXPECT_NEAR(this->position(manifold, i).x(), 1, 32 * this->kEpsilon);
      EXPECT_NEAR(std::abs(this->position(manifold, i).z()), 0.6, 32 * this->kEpsilon);
    }
    if (angle == 1e-3) continue;  // on the side plane up to rounding, or off it
    const bool leans = angle > 0 && angle < 90;
    EXPECT_EQ(manifold.type, leans ? ContactType::EdgeEdge : ContactType::EdgeFace);
  }
}

// The segment is nearest to a vertex and lies along an edge that falls away from it by two degrees.
// The far point is on the edge, and less deep by the drop of the edge there.
TYPED_TEST(CapsuleHull, AlongAnEdgeThatFallsAwayTheFarPointIsLessDeep) {
  const double turn = 2 * kDegree, sine = std::sin(turn), cosine = std::cos(turn);
  const double half = std::sqrt(0.5);
  const Vec3d vertex(1, 0, 1), out(sine, half * cosine, half * cosine);
  const Vec3d along(cosine, -half * sine, -half * sine);
  const Vec3d over = vertex + 0.05 * out;
  const auto manifold = this->collide(on_box(over - 1.5 * along, over + 0.5 * along, 0.15));
  ASSERT_EQ(manifold.points.size(), 2u);
  EXPECT_LT((this->normal(manifold) + out).norm(), 32 * this->kEpsilon);
  EXPECT_NEAR(this->deepest(manifold), 0.05 - 0.15, 16 * this->kEpsilon);
  const double place = 1 + 0.05 * sine - 1.5 * cosine;  // below the segment's end, on the edge
  EXPECT_NEAR(manifold.points[1].separation, 0.05 + (1 - place) * sine - 0.15, 32 * this->kEpsilon);
  const Vec3d off = this->position(manifold, 1) - Vec3d(place, 0, 1);
  EXPECT_LT(std::hypot(off.y(), off.z()),
            2e-3);  // the segment leans out of the plane of edge and normal
}

TYPED_TEST(CapsuleHull, EndOverAVertexIsPointOnPoint) {
  const Vec3d outward = Vec3d(1, 1, 1).normalized();
  const Vec3d end = Vec3d(1, 0, 1) + 0.05 * outward;
  const auto manifold = this->collide(on_box(end, end + outward, 0.1));
  ASSERT_EQ(manifold.points.size(), 1u);
  EXPECT_EQ(manifold.type, ContactType::PointPoint);
  EXPECT_EQ(manifold.points[0].id, FeatureId::of(vertex_ref(Owner::A, 0), vertex_ref(Owner::B, 7)));
  EXPECT_LT((this->normal(manifold) + outward).norm(), 64 * this->kEpsilon);
  EXPECT_NEAR(this->deepest(manifold), -0.05, 16 * this->kEpsilon);
}

TYPED_TEST(CapsuleHull, WithoutLengthIsASphere) {
  Random random(5);
  for (int i = 0; i < 500; ++i) {
    RoundHull sphere = test::random_round_hull(random, true, 100);
    RoundHull capsule = sphere;
    capsule.core = {sphere.core[0], sphere.core[0]};
    const auto one = this->collide(sphere);
    const auto two = this->collide(capsule);
    ASSERT_EQ(one.points.size(), two.points.size());
    if (one.points.empty()) continue;
    const double rounding = 32 * (this->kEpsilon * sphere.scale() + test::unevenness(sphere.hull));
    ASSERT_NEAR(one.points[0].separation, two.points[0].separation, rounding);
  }
}

TYPED_TEST(CapsuleHull, HasTheSameContactInEverySizeAndPlace) {
  Random random(6);
  const RoundHull pairs[] = {
      on_box(Vec3d(-1.5, 0.05, 0.2), Vec3d(0.5, 0.05, 0.3), 0.1),
      on_box(Vec3d(-1.5, -0.05, 0.2), Vec3d(0.5, -0.05, 0.3), 0.1),
      on_box(Vec3d(0.8, 0.3, 0), Vec3d(1.4, -0.2, 0.1), 0.1),
      on_box(Vec3d(1.03, 0.05, -0.7), Vec3d(1.03, 0.05, 0.4), 0.1),
  };
  for (const RoundHull& pair : pairs) {
    const auto reference = this->collide(pair);
    for (int i = 0; i < 50; ++i) {
      const double size = random.decade(-4, 4);
      const RoundHull other = placed(pair, size, random.pose(size));
      const auto manifold = this->collide(other);
      const double rounding = 64 * this->kEpsilon;
      ASSERT_EQ(manifold.points.size(), reference.points.size());
      const Vec3d turned = other.hull_pose.rotate(this->normal(reference));
      ASSERT_LT((this->normal(manifold) - turned).norm(), 32 * rounding);
      for (std::size_t p = 0; p < reference.points.size(); ++p) {
        ASSERT_NEAR(manifold.points[p].separation / size, reference.points[p].separation, rounding);
        ASSERT_EQ(manifold.points[p].id.first, reference.points[p].id.first);
      }
    }
  }
}

/// Limit on the rotation of a normal in a step.
enum class Turn {
  None,
  // The core's closest point to the hull moves by no more than the core does. So the direction
  // between both turns by no more than the step over their distance. No limit in overlap.
  AsTheCoreMoves,
};

/// Change of the second point's separation; nullopt unless both have the same second point.
template <class S>
std::optional<double> change_of_second(const Manifold<S>& last, const Manifold<S>& now) {
  if (now.points.size() < 2 || last.points.size() < 2) return std::nullopt;
  if (now.points[1].id != last.points[1].id) return std::nullopt;
  return std::abs(static_cast<double>(now.points[1].separation - last.points[1].separation));
}

/// Moves the capsule down through the surface in small steps. No depth may change by more than the
/// step; the second point may also change as the normal turns. Counts the second points.
template <class S>
void expect_no_jump(const RoundHull& start, double step, int steps, Turn turn, int& seconds) {
  const double epsilon = std::numeric_limits<S>::epsilon();
  const double rounding = 32 * epsilon * start.scale();
  const double length = (start.core.back() - start.core.front()).norm();
  Manifold<S> last;
  int seen = 0;
  for (int i = 0; i < steps; ++i) {
    SCOPED_TRACE("step " + std::to_string(i));
    const Manifold<S> now = test::collide<S>(moved(start, Vec3d(0, -step * i, 0)));
    if (now.points.empty()) {
      ASSERT_EQ(seen, 0) << "contact lost";
      continue;
    }
    if (seen++ > 0) {
      const double depth = now.points[0].separation - last.points[0].separation;
      ASSERT_LE(std::abs(depth), step + rounding);
      const double turned = (now.normal - last.normal).norm();
      if (turn == Turn::None) {
        ASSERT_LE(turned, 64 * epsilon);
      } else {
        const double offset =
            now.points[0].separation + last.points[0].separation + 2 * start.radius;
        const double inner =
            start.radius + std::min(now.points[0].separation, last.points[0].separation);
        if (inner > 0) {
          ASSERT_LE(turned, 2 * (step + rounding) / offset + 64 * epsilon);
        }
      }
      // At a point that a side cuts off, the side's slope may matter more than the step.
      const bool is_cut = now.points.size() > 1 && now.points[1].id.first.kind == FeatureKind::Edge;
      const std::optional<double> second =
          turn == Turn::AsTheCoreMoves && is_cut ? std::nullopt : change_of_second(last, now);
      seconds += second.has_value() ? 1 : 0;
      ASSERT_LE(second.value_or(0), step + length * turned + rounding);
    }
    last = now;
  }
  ASSERT_GT(seen, steps / 2);
}

TYPED_TEST(CapsuleHull, SinksThroughAFaceWithoutAJump) {
  using S = TypeParam;
  for (const double tilt : {0.0, 1e-7, 1e-4, 0.01, 0.3, 1.2}) {
    SCOPED_TRACE(tilt);
    const Vec3d half(0.4 * std::cos(tilt), 0.4 * std::sin(tilt), 0);
    // From a separation of 1 cm above the surface to a depth of 20 cm; and again in steps of a
    // micrometre from 1 mm above the height at which the segment itself enters.
    const RoundHull high =
        on_box(Vec3d(0, 0.11 + half.y(), 0.1) - half, Vec3d(0, 0.11 + half.y(), 0.1) + half, 0.1);
    int seconds = 0;
    expect_no_jump<S>(high, 1e-3, 210, Turn::None, seconds);
    expect_no_jump<S>(moved(high, Vec3d(0, -0.109, 0)), 1e-6, 2000, Turn::None, seconds);
    EXPECT_GT(seconds, tilt < 0.1 ? 2000 : -1);
  }
}

TYPED_TEST(CapsuleHull, SinksOverhangingAFaceWithoutAJump) {
  using S = TypeParam;
  for (const double tilt : {0.0, 1e-6, 1e-3, 0.049, 0.051, 0.3}) {
    SCOPED_TRACE(tilt);
    // The lower end is beyond the side x = -1: an edge of the box carries the segment.
    const Vec3d along(std::cos(tilt), std::sin(tilt), 0);
    const Vec3d over_edge(-1, 0.101, 0.1);
    const RoundHull high = on_box(over_edge - 0.3 * along, over_edge + 0.9 * along, 0.1);
    int seconds = 0;
    expect_no_jump<S>(high, 1e-3, 150, Turn::None, seconds);
    expect_no_jump<S>(moved(high, Vec3d(0, -0.1, 0)), 1e-6, 2000, Turn::None, seconds);
    EXPECT_GT(seconds, tilt < 0.05 ? 2000 : -1);
  }
}

TYPED_TEST(CapsuleHull, SinksAcrossAnEdgeWithoutAJump) {
  using S = TypeParam;
  for (const double yaw : {90.0, 30.0, 5.0, 1.0}) {
    SCOPED_TRACE(yaw);
    const Vec3d along = about(Vec3d::UnitY(), yaw * kDegree) * Vec3d::UnitX();
    const double half = 0.5;
    const Vec3d middle(0.1, 0.101, 0);
    const RoundHull high{{middle - 0.5 * along, middle + 0.5 * along},
                         0.1,
                         at(0, 0, 0),
                         make_box(Vec3d(1, half, half)),
                         {about(Vec3d::UnitX(), 45 * kDegree), Vec3d(0, -half * std::sqrt(2), 0)}};
    // Deep down, along the edge, the shortest exit would be sideways through a face; not at 5 mm.
    int seconds = 0;
    expect_no_jump<S>(high, 1e-4, 1050, Turn::None, seconds);
    expect_no_jump<S>(moved(high, Vec3d(0, -0.1, 0)), 1e-6, 2000, Turn::None, seconds);
  }
}

TYPED_TEST(CapsuleHull, SlowNothingJumpsWhereAnEndPassesAnEdgeOrAVertex) {
  using S = TypeParam;
  Random random(7);
  int seconds = 0;
  for (int i = 0; i < 40; ++i) {
    // In and out again past the box's edge x = 1 or its corner, at any slant. The normal must turn
    // there, but while the core is outside it turns no faster than the core moves.
    const Vec3d target(1, 0, i % 2 == 0 ? 0.3 : 1);
    const Vec3d end = target + random.level(0.002, 0.05);
    const Vec3d other =
        end + 0.5 * Vec3d(random.uniform(-1, 1), random.uniform(0, 1), random.uniform(-1, 1));
    expect_no_jump<S>(on_box(end, other, 0.1), 1e-4, 1000, Turn::AsTheCoreMoves, seconds);
  }
  EXPECT_GT(seconds, 100);
}

TYPED_TEST(CapsuleHull, SecondPointComesAndGoesWithoutMovingTheFirst) {
  // Turned about z over the box's edge x = -1, from level to steep, shallow and deep.
  for (const double height : {0.06, -0.02}) {
    SCOPED_TRACE(height);
    double last = 0;
    Vec3d last_normal = Vec3d::Zero();
    int twos = 0, ones = 0;
    for (int i = 0; i <= 1000; ++i) {
      SCOPED_TRACE(i);
      const double tilt = 0.2 * i / 1000;
      const Vec3d along(std::cos(tilt), std::sin(tilt), 0);
      const Vec3d over_edge(-1, height, 0.1);
      const auto manifold =
          this->collide(on_box(over_edge - 0.3 * along, over_edge + 0.3 * along, 0.1));
      ASSERT_GE(manifold.points.size(), 1u);
      ++(manifold.points.size() == 2 ? twos : ones);
      if (i > 1) {
        ASSERT_LE(std::abs(this->deepest(manifold) - last), 0.3 * 0.0002 + 64 * this->kEpsilon);
        ASSERT_LE((this->normal(manifold) - last_normal).norm(), 0.0002 + 64 * this->kEpsilon);
      }
      last = this->deepest(manifold);
      last_normal = this->normal(manifold);
    }
    EXPECT_GT(twos, 200);
    EXPECT_GT(ones, 200);
  }
}

TYPED_TEST(CapsuleHull, OverAnEdgeTheIdStaysWhenTheAxisChanges) {
  // Rocking by a thousandth to both sides: either the face is best, or the edge below the low end.
  FeatureId ids_seen[2];
  for (const double tilt : {-1e-3, 1e-3}) {
    const Vec3d along(std::cos(tilt), std::sin(tilt), 0);
    const Vec3d over_edge(-1, 0.05, 0.1);
    const auto manifold =
        this->collide(on_box(over_edge - 0.3 * along, over_edge + 0.9 * along, 0.1));
    ASSERT_EQ(manifold.points.size(), 2u);
    ids_seen[tilt > 0 ? 0 : 1] = manifold.points[tilt > 0 ? 0 : 1].id;
  }
  EXPECT_EQ(ids_seen[0], ids_seen[1]);
  EXPECT_EQ(ids_seen[0].second.kind, FeatureKind::Edge);
}

TYPED_TEST(CapsuleHull, TouchingAnEdgeOrAVertexOnlyFallsBackOrIsSkipped) {
  using S = TypeParam;
  // The end lies exactly on the edge x = 1; the other segment only touches the corner.
  const RoundHull on_edge = on_box(Vec3d(1, 0, 0.25), Vec3d(1.5, 0.5, 0.25), 0.125);
  const RoundHull on_vertex = on_box(Vec3d(0.5, 0.5, 1), Vec3d(1.5, -0.5, 1.0), 0.125);
  for (const RoundHull& pair : {on_edge, on_vertex}) {
    const Manifold<S> manifold = test::collide<S>(pair);
    ASSERT_EQ(manifold.points.size(), 1u);
    EXPECT_NEAR(manifold.points[0].separation, -0.125, 32 * this->kEpsilon);
    EXPECT_GE(test::core_separation_along(this->normal(manifold), pair), -32 * this->kEpsilon);
  }
  CollideOptions skip;
  skip.degenerate = Degenerate::Skip;
  EXPECT_TRUE(test::collide<S>(on_edge, skip).points.empty());
}

}  // namespace
}  // namespace contactscope
