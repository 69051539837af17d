#include "query/voronoi_region.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/primitives.h"
#include "query/fast/point_faces.h"
#include "support/brute_force_distance.h"
#include "support/random_geometry.h"

namespace contactscope {
namespace {

using test::Random;

/// The region of a point outside, searched from the face that is farthest below it.
template <class S>
std::optional<HullFeature> region_from_face(const Hull<S>& hull, const Vec3<S>& point, S scale) {
  const int face = PointFaces<S>(hull, point).nearest(S(0));
  const int side = outside_side(hull, face, point);
  if (side < 0) return std::nullopt;
  return voronoi_region(hull, side, point, scale);
}

template <class S>
double distance_to(const Hull<S>& hull, const HullFeature& feature, const Vec3<S>& point) {
  const Vec3d p = point.template cast<double>();
  if (feature.kind == FeatureKind::Vertex)
    return (p - at(hull.vertices, feature.index).template cast<double>()).norm();
  const Vec3d origin = hull.origin(feature.index).template cast<double>();
  const Vec3d along = hull.target(feature.index).template cast<double>() - origin;
  const double foot = along.dot(p - origin) / along.squaredNorm();
  EXPECT_GE(foot, 0);
  EXPECT_LE(foot, 1);
  return (p - origin - foot * along).norm();
}

template <class S> void expect_nearest_features(std::uint64_t seed) {
  Random random(seed);
  int edges = 0, vertices = 0;
  for (int i = 0; i < 4000; ++i) {
    const double size = random.decade(-4, 4);
    const Hull<S> hull = hull_cast<S>(
        random.chance(0.2) ? test::random_box(random, size, 10)
                           : test::random_hull(random, 4 + random.index(40), size, 10));
    const double height = random.decade(-3, 0.5);
    const Vec3d start =
        random.chance(0.5)
            ? Vec3d(at(hull.vertices, random.index(hull.vertex_count())).template cast<double>())
            : Vec3d(0.5 * (hull.origin(2 * random.index(hull.edge_count())) + hull.vertices[0])
                              .template cast<double>());
    const Vec3<S> point = (start + size * height * random.unit_vector()).template cast<S>();
    const S scale = static_cast<S>(size * (2 + height));
    if (!(PointFaces<S>(hull, point).largest() > S(1e-3) * scale)) continue;
    const std::optional<HullFeature> region = region_from_face(hull, point, scale);
    if (!region) continue;
    (region->kind == FeatureKind::Edge ? edges : vertices) += 1;
    const double distance = static_cast<double>(
        test::brute_force_distance(test::features_of_point(point.template cast<double>(), {}),
                                   test::features_of(hull_cast<double>(hull), {}))
            .distance);
    // Faces of a hull in S are planar only within rounding.
    const double rounding = 64 * std::numeric_limits<S>::epsilon() * static_cast<double>(scale);
    ASSERT_NEAR(distance_to(hull, *region, point), distance, rounding) << "point " << i;
  }
  EXPECT_GT(edges, 400);
  EXPECT_GT(vertices, 400);
}

TEST(VoronoiRegion, SlowHoldsThePointsToWhichItsFeatureIsNearestInFloat) {
  expect_nearest_features<float>(11);
}
TEST(VoronoiRegion, SlowHoldsThePointsToWhichItsFeatureIsNearestInDouble) {
  expect_nearest_features<double>(12);
}

TEST(VoronoiRegion, BoxRegionsAreOutsideEdgesAndBeyondCorners) {
  const Hull<double> box = make_box(Vec3d(1, 2, 3));
  const auto edge = region_from_face(box, Vec3d(1.5, 2.2, 1), 5.0);
  ASSERT_TRUE(edge);
  ASSERT_EQ(edge->kind, FeatureKind::Edge);
  for (const Vec3d& end : {box.origin(edge->index), box.target(edge->index)}) {
    EXPECT_EQ(end.x(), 1);
    EXPECT_EQ(end.y(), 2);
  }
  const auto corner = region_from_face(box, Vec3d(-1.5, 2.2, -3.1), 5.0);
  ASSERT_TRUE(corner);
  ASSERT_EQ(corner->kind, FeatureKind::Vertex);
  EXPECT_EQ(at(box.vertices, corner->index), Vec3d(-1, 2, -3));
  EXPECT_FALSE(region_from_face(box, Vec3d(0.5, 2.2, 1), 5.0)) << "over a face";
}

/// The search starts from an edge on the far side of the hull.
TEST(VoronoiRegion, IsFoundFromFarAway) {
  const Hull<double> cylinder = make_cylinder(1, 0.5, 12);
  const int bottom = at(cylinder.face_edges, 1);
  const Vec3d above(1.2, 0.9, 0.01);
  const auto near = region_from_face(cylinder, above, 3.0);
  ASSERT_TRUE(near);
  int found = 0;
  for (const int edge : cylinder.around_face(1)) {
    const auto region = voronoi_region(cylinder, edge, above, 3.0);
    if (!region) continue;  // too many steps
    ++found;
    EXPECT_EQ(region->kind, near->kind);
    EXPECT_EQ(region->index / 2, near->index / 2);
  }
  EXPECT_GT(found, 0) << bottom;
}

/// On borders, rounding would decide, so no region is returned.
TEST(VoronoiRegion, IsNobodysOnItsBorders) {
  const Hull<double> box = make_box(Vec3d(1, 1, 1));
  EXPECT_FALSE(region_from_face(box, Vec3d(1 + 1e-15, 1.5, 0), 2.0)) << "face and edge";
  EXPECT_FALSE(region_from_face(box, Vec3d(1.5, 1.5, 1), 2.0)) << "edge and corner";
}

}  // namespace
}  // namespace contactscope
