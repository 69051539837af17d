#include "manifold/clip.h"

#include <gtest/gtest.h>

#include "support/builders.h"

namespace contactscope {
namespace {

constexpr EdgeKey b_edge(int edge) { return edge_key(Owner::B, 2 * edge); }

/// A square with corners (+-1, 0, +-1), counter-clockwise seen from above, edges B 0 to 3.
ClipPolygon<double> square() {
  ClipPolygon<double> polygon;
  const Vec3d corners[] = {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}};
  for (int i = 0; i < 4; ++i) {
    polygon.push_back({corners[i], b_edge(i), Crossing::of(b_edge((i + 3) % 4), b_edge(i))});
  }
  return polygon;
}

constexpr EdgeKey kSide = edge_key(Owner::A, 14);

TEST(Clip, CutsASquareInHalfAndNamesTheCrossings) {
  ClipPolygon<double> result;
  ASSERT_TRUE(clip(square(), {Vec3d::UnitX(), 0.25}, kSide, 1e-12, result));
  ASSERT_EQ(result.size(), 4u);
  EXPECT_EQ(result[1].position, Vec3d(0.25, 0, 1));
  EXPECT_EQ(result[1].crossing, Crossing::of(b_edge(0), kSide));
  EXPECT_EQ(result[1].leaving, kSide);
  EXPECT_EQ(result[2].position, Vec3d(0.25, 0, -1));
  EXPECT_EQ(result[2].crossing, Crossing::of(b_edge(2), kSide));
  EXPECT_EQ(result[2].leaving, b_edge(2));
  EXPECT_EQ(result[0].crossing, square()[0].crossing);
  EXPECT_EQ(result[3].crossing, square()[3].crossing);
}

TEST(Clip, LeavesAPolygonAloneThatIsInsideOrOnThePlane) {
  ClipPolygon<double> result;
  EXPECT_FALSE(clip(square(), {Vec3d::UnitX(), 2.0}, kSide, 1e-12, result));
  EXPECT_FALSE(clip(square(), {Vec3d::UnitX(), 1.0}, kSide, 1e-12, result));
  EXPECT_FALSE(clip(square(), {Vec3d::UnitX(), 1.0 - 1e-13}, kSide, 1e-12, result));
}

TEST(Clip, LeavesNothingOfAPolygonOutside) {
  ClipPolygon<double> result;
  ASSERT_TRUE(clip(square(), {Vec3d::UnitX(), -2.0}, kSide, 1e-12, result));
  EXPECT_TRUE(result.empty());
  ASSERT_TRUE(clip(ClipPolygon<double>(result), {Vec3d::UnitX(), 1.0}, kSide, 1e-12, result) ==
              false);
}

TEST(Clip, ThroughTwoCornersAddsNoDuplicateCorners) {
  // The plane runs along a diagonal: the corners on it stay, nothing is added.
  const Vec3d diagonal = Vec3d(1, 0, 1).normalized();
  ClipPolygon<double> result;
  ASSERT_TRUE(clip(square(), {diagonal, 1e-14}, kSide, 1e-12, result));
  ASSERT_EQ(result.size(), 3u);
  EXPECT_EQ(result[0].crossing, square()[0].crossing);
  EXPECT_EQ(result[0].leaving, kSide);
  EXPECT_EQ(result[1].crossing, square()[2].crossing);
  EXPECT_EQ(result[2].crossing, square()[3].crossing);
}

TEST(Clip, TwoPlanesThatMeetInsideMakeACornerOfTheReferenceFace) {
  ClipPolygon<double> once;
  ClipPolygon<double> twice;
  const EdgeKey other_side = edge_key(Owner::A, 16);
  ASSERT_TRUE(clip(square(), {Vec3d::UnitX(), 0.5}, kSide, 1e-12, once));
  ASSERT_TRUE(clip(once, {-Vec3d::UnitZ(), 0.5}, other_side, 1e-12, twice));
  bool found = false;
  for (const ClipVertex<double>& vertex : twice) {
    if (vertex.crossing == Crossing::of(kSide, other_side)) {
      found = true;
      EXPECT_EQ(vertex.position, Vec3d(0.5, 0, -0.5));
    }
  }
  EXPECT_TRUE(found);
}

TEST(Clip, KeysHoldEdgesInTheOrderOfTheirIds) {
  const FeatureRef edges[] = {
      {Owner::A, 0}, {Owner::A, 7}, {Owner::A, 70000}, {Owner::B, 0}, {Owner::B, 9}};
  for (const FeatureRef& one : edges) {
    for (const FeatureRef& two : edges) {
      const EdgeKey one_key = edge_key(one.owner, 2 * static_cast<int>(one.index));
      const EdgeKey two_key = edge_key(two.owner, 2 * static_cast<int>(two.index) + 1);
      EXPECT_EQ(edge_ref(one_key), one);
      EXPECT_EQ(Crossing::of(one_key, two_key).id(), FeatureId::of(one, two));
    }
  }
}

TEST(Clip, SidePlanesPointOutAndHoldTheirEdge) {
  const Hull<double> hull = make_cylinder(1, 0.5, 7);
  const PlacedHull<double> placed(hull);
  for (int edge = 0; edge < 2 * hull.edge_count(); ++edge) {
    const Plane<double> side = side_plane(placed, edge);
    EXPECT_NEAR(side.normal.norm(), 1, 1e-14);
    EXPECT_NEAR(side.distance(hull.origin(edge)), 0, 1e-14);
    EXPECT_NEAR(side.distance(hull.target(edge)), 0, 1e-14);
    for (const int vertex : face_vertices(hull, placed.half_edge(edge).face)) {
      EXPECT_LT(side.distance(hull.vertices[static_cast<std::size_t>(vertex)]), 1e-14);
    }
  }
}

TEST(Clip, FacePolygonIsTheFacesLoopWithTheEdgesThatMeet) {
  const Hull<double> hull = make_cylinder(1, 0.5, 5);
  const PlacedHull<double> placed(hull);
  for (int face = 0; face < hull.face_count(); ++face) {
    ClipPolygon<double> polygon;
    face_polygon(placed, Owner::B, face, polygon);
    const std::vector<int> loop = face_vertices(hull, face);
    ASSERT_EQ(polygon.size(), loop.size());
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const ClipVertex<double>& before = polygon[(i + loop.size() - 1) % loop.size()];
      EXPECT_EQ(polygon[i].position, hull.vertices[static_cast<std::size_t>(loop[i])]);
      EXPECT_EQ(polygon[i].crossing, Crossing::of(before.leaving, polygon[i].leaving));
    }
  }
}

}  // namespace
}  // namespace contactscope
