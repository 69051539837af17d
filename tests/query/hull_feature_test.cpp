#include "query/hull_feature.h"

#include <gtest/gtest.h>

#include "geometry/primitives.h"
#include "support/random_geometry.h"

namespace contactscope {
namespace {

using test::Random;

constexpr int kTop = 2;  // +y of a box

TEST(FacePrism, PointProjectsIntoAFaceAtAnyHeight) {
  const Hull<double> box = make_box(Vec3d(1, 1, 2));
  for (const double height : {-5.0, 1.0, 1e3}) {
    EXPECT_TRUE(projects_into(box, kTop, Vec3d(0.9, height, -1.9), 0.0));
    EXPECT_TRUE(projects_into(box, kTop, Vec3d(1, height, 2), 0.0));
    EXPECT_FALSE(projects_into(box, kTop, Vec3d(1.01, height, 0), 0.0));
    EXPECT_FALSE(projects_into(box, kTop, Vec3d(0, height, -2.01), 0.0));
  }
  EXPECT_TRUE(projects_into(box, kTop, Vec3d(1.01, 1, 0), 0.02));
}

TEST(FacePrism, SegmentIsCutByTheSidesThatItCrosses) {
  const Hull<double> box = make_box(Vec3d(1, 1, 2));
  const Vec3d ends[2] = {Vec3d(-3, 1.5, 0), Vec3d(0.5, 1.2, 0)};
  const ClippedSegment<double> clipped = clip_to_prism(box, kTop, ends, 1e-12);
  ASSERT_FALSE(clipped.empty());
  EXPECT_NEAR(clipped.parameters[0], 2.0 / 3.5, 1e-15);
  EXPECT_EQ(clipped.parameters[1], 1);
  EXPECT_EQ(box.origin(clipped.edges[0]).x(), -1);
  EXPECT_EQ(box.target(clipped.edges[0]).x(), -1);
  EXPECT_EQ(clipped.edges[1], -1);
}

TEST(FacePrism, SegmentOutsideThePrismLeavesNothing) {
  const Hull<double> box = make_box(Vec3d(1, 1, 2));
  const Vec3d outside[2] = {Vec3d(1.1, 1, -5), Vec3d(1.1, 1, 5)};
  EXPECT_TRUE(clip_to_prism(box, kTop, outside, 1e-12).empty());
  const Vec3d past_a_corner[2] = {Vec3d(0.5, 1, 3), Vec3d(3, 1, 0.5)};
  EXPECT_TRUE(clip_to_prism(box, kTop, past_a_corner, 1e-12).empty());
}

TEST(FacePrism, SegmentInASidePlaneIsKeptWhole) {
  const Hull<double> box = make_box(Vec3d(1, 1, 2));
  const double rounding = 1e-13;
  const Vec3d ends[2] = {Vec3d(1 + rounding, 1, -1), Vec3d(1 - rounding, 1, 1)};
  const ClippedSegment<double> clipped = clip_to_prism(box, kTop, ends, 1e-12);
  EXPECT_EQ(clipped.parameters[0], 0);
  EXPECT_EQ(clipped.parameters[1], 1);
}

TEST(FacePrism, OnlyTheClippedSegmentProjectsIntoTheFace) {
  Random random(1);
  int cuts = 0;
  for (int i = 0; i < 3000; ++i) {
    const double size = random.decade(-4, 4);
    const Hull<double> hull =
        random.chance(0.5) ? random_box(random, size, 10) : random_hull(random, 12, size, 10);
    const int face = random.index(hull.face_count());
    const Vec3d ends[2] = {2 * size * random.unit_vector(), 2 * size * random.unit_vector()};
    const ClippedSegment<double> clipped = clip_to_prism(hull, face, ends, 1e-13 * size);
    for (int k = 0; k <= 20; ++k) {
      const double t = k / 20.0;
      const Vec3d point = ends[0] + t * (ends[1] - ends[0]);
      const bool is_left =
          !clipped.empty() && clipped.parameters[0] <= t && t <= clipped.parameters[1];
      const double doubt = is_left ? 1e-10 * size : -1e-10 * size;
      ASSERT_EQ(projects_into(hull, face, point, doubt), is_left);
    }
    cuts += !clipped.empty() && clipped.edges[0] >= 0 && clipped.edges[1] >= 0 ? 1 : 0;
  }
  EXPECT_GT(cuts, 300);
}

TEST(FacePrism, NextToAnEdgeTheSegmentEndsWithTheEdge) {
  const Hull<double> box = make_box(Vec3d(1, 1, 2));
  int edge = 0;  // the half-edge of the top face along x = 1
  while (box.half_edges[static_cast<std::size_t>(edge)].face != kTop || box.origin(edge).x() != 1 ||
         box.target(edge).x() != 1) {
    ++edge;
  }
  const Vec3d ends[2] = {Vec3d(1.2, 1.2, -4), Vec3d(1.2, 1.2, 1)};
  const ClippedSegment<double> clipped = clip_to_edge(box, edge, ends);
  EXPECT_NEAR(clipped.parameters[0], 0.4, 1e-15);
  EXPECT_EQ(box.origin(clipped.edges[0]).z(), -2);
  EXPECT_EQ(clipped.parameters[1], 1);
  EXPECT_EQ(clipped.edges[1], -1);
  const Vec3d beyond[2] = {Vec3d(1, 1, 3), Vec3d(1, 1, 4)};
  EXPECT_TRUE(clip_to_edge(box, edge, beyond).empty());
}

}  // namespace
}  // namespace contactscope
