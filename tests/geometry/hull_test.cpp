#include "geometry/hull.h"

#include <gtest/gtest.h>

#include "geometry/hull_builder.h"
#include "geometry/point_sets.h"
#include "geometry/primitives.h"

namespace contactscope::test {
namespace {

TEST(HullCast, RoundsEachNumberOnceAndKeepsTheTopology) {
  Generator random(1);
  const Hull<double> hull = build_hull(in_ball(random, 50));
  const Hull<float> cast = hull_cast<float>(hull);
  ASSERT_EQ(cast.vertex_count(), hull.vertex_count());
  ASSERT_EQ(cast.face_count(), hull.face_count());
  for (std::size_t i = 0; i < hull.vertices.size(); ++i) {
    EXPECT_EQ(cast.vertices[i], Vec3f(hull.vertices[i].cast<float>()));
  }
  for (std::size_t i = 0; i < hull.planes.size(); ++i) {
    EXPECT_EQ(cast.planes[i].normal, Vec3f(hull.planes[i].normal.cast<float>()));
    EXPECT_EQ(cast.planes[i].offset, static_cast<float>(hull.planes[i].offset));
  }
  EXPECT_EQ(cast.radius, static_cast<float>(hull.radius));
  EXPECT_EQ(cast.face_edges, hull.face_edges);
  EXPECT_EQ(cast.vertex_edges, hull.vertex_edges);
  for (int face = 0; face < hull.face_count(); ++face) {
    EXPECT_EQ(face_vertices(cast, face), face_vertices(hull, face));
  }
}

TEST(HullCast, FloatToDoubleAndBackIsTheSame) {
  Generator random(2);
  const Hull<float> hull = hull_cast<float>(build_hull(in_ball(random, 30)));
  const Hull<float> back = hull_cast<float>(hull_cast<double>(hull));
  EXPECT_EQ(back.vertices, hull.vertices);
  EXPECT_EQ(back.centroid, hull.centroid);
}

}  // namespace
}  // namespace contactscope::test
