#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "round_hull_cases.h"
#include "support/builders.h"

namespace contactscope {
namespace {

using test::about;
using test::at;
using test::Random;
using test::RoundHull;

/// A sphere about `center` and a cube of side 1 about the origin.
RoundHull in_cube(const Vec3d& center, double radius) {
  return {{Vec3d::Zero()},
          radius,
          at(center.x(), center.y(), center.z()),
          test::cube(0.5),
          at(0, 0, 0)};
}

template <class S> class SphereHull : public testing::Test {
 protected:
  static constexpr double kEpsilon = std::numeric_limits<S>::epsilon();

  static ContactPoint<S> only_point(const Manifold<S>& manifold) {
    EXPECT_EQ(manifold.points.size(), 1u);
    return manifold.points[0];
  }
  static Vec3d normal(const Manifold<S>& manifold) {
    return manifold.normal.template cast<double>();
  }
  /// The record of the pair.
  static trace::Pair recorded(const RoundHull& pair, Degenerate answer, Manifolds<S>& manifolds) {
    CollideOptions options;
    options.degenerate = answer;
    trace::Pair record;
    collide<S>(Sphere<S>{static_cast<S>(pair.radius)}, pair.round_pose.cast<S>(),
               hull_cast<S>(pair.hull), pair.hull_pose.cast<S>(), options, manifolds, nullptr,
               &record);
    return record;
  }
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(SphereHull, Scalars);

TYPED_TEST(SphereHull, OutsideTouchesTheClosestPointOfFaceEdgeOrVertex) {
  struct Case {
    Vec3d closest, outward;
    ContactType type;
    FeatureKind feature;
  };
  const Case cases[] = {
      {{0.1, 0.5, -0.2}, {0, 1, 0}, ContactType::PointFace, FeatureKind::Face},
      {{0.5, 0.5, -0.2}, {3, 4, 0}, ContactType::PointEdge, FeatureKind::Edge},
      {{0.5, -0.5, 0.5}, {2, -1, 2}, ContactType::PointPoint, FeatureKind::Vertex},
  };
  for (const Case& one : cases) {
    const Vec3d outward = one.outward.normalized();
    const auto manifold = test::collide<TypeParam>(in_cube(one.closest + 0.07 * outward, 0.1));
    const auto point = this->only_point(manifold);
    EXPECT_EQ(manifold.axis, AxisKind::ClosestPoints);
    EXPECT_EQ(manifold.type, one.type);
    EXPECT_EQ(point.id.first, vertex_ref(Owner::A, 0));
    EXPECT_EQ(point.id.second.kind, one.feature);
    EXPECT_NEAR(point.separation, -0.03, 8 * this->kEpsilon);
    EXPECT_LT((this->normal(manifold) + outward).norm(), 32 * this->kEpsilon);
    EXPECT_LT((point.position.template cast<double>() - one.closest).norm(), 8 * this->kEpsilon);
  }
}

TYPED_TEST(SphereHull, InsideIsProjectedOntoTheFaceOfLeastPenetration) {
  const auto manifold = test::collide<TypeParam>(in_cube(Vec3d(0.1, -0.2, 0.3), 0.1));
  const auto point = this->only_point(manifold);
  EXPECT_EQ(manifold.axis, AxisKind::FaceB);
  EXPECT_EQ(manifold.type, ContactType::PointFace);
  EXPECT_EQ(point.id, FeatureId::of(vertex_ref(Owner::A, 0), face_ref(Owner::B, 4)));
  EXPECT_EQ(this->normal(manifold), Vec3d(0, 0, -1));
  EXPECT_NEAR(point.separation, -0.3, 4 * this->kEpsilon);
  EXPECT_LT((point.position.template cast<double>() - Vec3d(0.1, -0.2, 0.5)).norm(),
            4 * this->kEpsilon);
}

TYPED_TEST(SphereHull, TheMarginKeepsAGap) {
  CollideOptions options;
  const RoundHull pair = in_cube(Vec3d(0.7, 0.7, 0), std::hypot(0.2, 0.2) - 0.01);
  EXPECT_TRUE(test::collide<TypeParam>(pair, options).points.empty());
  options.margin = TypeParam(0.02);
  EXPECT_NEAR(this->only_point(test::collide<TypeParam>(pair, options)).separation, 0.01,
              8 * this->kEpsilon);
}

TYPED_TEST(SphereHull, CentrePassesThroughAFaceWithoutAJump) {
  using S = TypeParam;
  Random random(1);
  for (int i = 0; i < 50; ++i) {
    const Hull<double> hull = test::random_hull(random, 4 + random.index(40), 1, 3);
    const Pose<double> pose = random.pose(2);
    const std::vector<int> loop = face_vertices(hull, random.index(hull.face_count()));
    Vec3d middle = Vec3d::Zero();
    for (const int vertex : loop) middle += hull.vertices[static_cast<std::size_t>(vertex)];
    middle /= static_cast<double>(loop.size());
    const auto& plane = hull.planes[static_cast<std::size_t>(
        hull.half_edges[static_cast<std::size_t>(
                            hull.vertex_edges[static_cast<std::size_t>(loop[0])])]
            .face)];
    RoundHull pair{{Vec3d::Zero()}, 0.3, {}, hull, pose};
    const double rounding = 32 * (this->kEpsilon * pair.scale() + test::unevenness(hull));

    // At a slant through the middle of a face, from far outside the rounding to far inside.
    const Vec3d slant = (plane.normal + 0.5 * random.unit_vector()).normalized();
    const double step = 1e-6;
    Manifold<S> last;
    for (int k = -200; k <= 200; ++k) {
      pair.round_pose.position = pose.transform(middle - k * step * slant);
      const Manifold<S> now = test::collide<S>(pair);
      ASSERT_EQ(now.points.size(), 1u);
      if (k > -200) {
        ASSERT_LE(std::abs(static_cast<double>(now.points[0].separation) -
                           static_cast<double>(last.points[0].separation)),
                  step + rounding);
        ASSERT_LE((now.normal - last.normal).norm(), S(16 * this->kEpsilon));
        ASSERT_EQ(now.points[0].id, last.points[0].id);
      }
      last = now;
    }
  }
}

TYPED_TEST(SphereHull, CentreOnAFaceHasTheFacesNormalAndIsNotDegenerate) {
  Manifolds<TypeParam> manifolds;
  const trace::Pair record =
      this->recorded(in_cube(Vec3d(0.25, 0.125, 0.5), 0.25), Degenerate::Skip, manifolds);
  ASSERT_EQ(manifolds.size(), 1u);
  EXPECT_FALSE(record.degenerate.has_value());
  EXPECT_EQ(this->normal(manifolds[0]), Vec3d(0, 0, -1));
  EXPECT_EQ(this->only_point(manifolds[0]).separation, TypeParam(-0.25));
}

TYPED_TEST(SphereHull, CentreOnAnEdgeOrAVertexFallsBackToTheEarliestFace) {
  struct Case {
    Vec3d center;
    const char* geometry;
    double depth;
  };
  const Case cases[] = {
      {{0.5, 0.5, 0.125}, "centre on an edge or a vertex", 0},
      {{0.5, -0.5, -0.5}, "centre on an edge or a vertex", 0},
      {{0, 0, 0}, "centre as near to several faces", 0.5},
      {{0.25, 0, 0.25}, "centre as near to several faces", 0.25},
  };
  for (const Case& one : cases) {
    SCOPED_TRACE(one.center.transpose());
    Manifolds<TypeParam> manifolds;
    const RoundHull pair = in_cube(one.center, 0.25);
    const trace::Pair record = this->recorded(pair, Degenerate::Fallback, manifolds);
    ASSERT_TRUE(record.degenerate.has_value());
    EXPECT_EQ(record.degenerate->geometry, one.geometry);
    EXPECT_EQ(record.degenerate->answer, "fallback");
    ASSERT_EQ(manifolds.size(), 1u);
    EXPECT_EQ(this->normal(manifolds[0]), Vec3d(-1, 0, 0));  // face 0 is +x
    EXPECT_EQ(this->only_point(manifolds[0]).separation, TypeParam(-0.25 - one.depth));

    const trace::Pair skipped = this->recorded(pair, Degenerate::Skip, manifolds);
    EXPECT_EQ(skipped.degenerate->answer, "skip");
    EXPECT_TRUE(manifolds.empty());
    EXPECT_EQ(skipped.state, "separated");
  }
}

TYPED_TEST(SphereHull, CentreOnAnEdgeOrAVertexHasANormalInItsVoronoiConeInEveryPose) {
  using S = TypeParam;
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const double size = random.decade(-4, 4);
    const Hull<double> hull = test::random_hull(random, 4 + random.index(40), size, 10);
    const Pose<double> pose = random.pose(size);
    const bool on_vertex = random.chance(0.5);
    const int half_edge = random.index(2 * hull.edge_count());
    const double along = on_vertex ? 0 : random.uniform(0.05, 0.95);
    const Vec3d place =
        hull.origin(half_edge) + along * (hull.target(half_edge) - hull.origin(half_edge));
    const RoundHull pair{
        {Vec3d::Zero()}, 0.1 * size, {random.rotation(), pose.transform(place)}, hull, pose};
    const Manifold<S> manifold = test::collide<S>(pair);
    const auto point = this->only_point(manifold);
    const double rounding = this->kEpsilon * pair.scale() + test::unevenness(hull);
    ASSERT_NEAR(point.separation, -0.1 * size, 32 * rounding);
    // In the cone: no vertex of the hull is beyond the plane through the centre.
    ASSERT_GE(test::core_separation_along(this->normal(manifold), pair), -64 * rounding);
  }
}

}  // namespace
}  // namespace contactscope
