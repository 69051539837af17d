#include <gtest/gtest.h>

#include "manifold/placed_shapes.h"
#include "support/builders.h"
#include "support/random_geometry.h"

namespace contactscope {
namespace {

/// Separation of a segment from a hull along a direction, from the hull to the segment.
double along(const Hull<double>& hull, const Vec3d (&ends)[2], const Vec3d& direction) {
  double most = -1e300;
  for (const Vec3d& vertex : hull.vertices) most = std::max(most, direction.dot(vertex));
  return std::min(direction.dot(ends[0]), direction.dot(ends[1])) - most;
}

// Gregorius 2015, "Capsule vs Hull: Deep Penetration": faces, and the segment with each edge.
TEST(CapsuleAxes, TheRecordHasTheLeastOverlapOfAllAxesByBruteForce) {
  test::Random random(8);
  int by_face = 0, by_edge = 0;
  for (int i = 0; i < 400; ++i) {
    const Hull<double> hull = test::random_hull(random, 20, 1, 1.5);
    const Vec3d ends[2] = {random.uniform(0, 1) * random.unit_vector(),
                           random.uniform(0.2, 1.2) * random.unit_vector()};
    double faces = -1e300, edges = -1e300;
    for (const Plane<double>& plane : hull.planes)
      faces = std::max(faces, along(hull, ends, plane.normal));
    for (int edge = 0; edge < count_of(hull.half_edges); edge += 2) {
      const Vec3d of_edge = hull.target(edge) - hull.origin(edge);
      const Vec3d across = of_edge.cross(ends[1] - ends[0]).normalized();
      for (const Vec3d& direction : {across, Vec3d(-across)})
        edges = std::max(edges, along(hull, ends, direction));
    }
    if (std::max(faces, edges) > -1e-3) continue;  // only a segment in the hull has this record
    const Pose<double> pose = random.pose(3);
    const trace::Pair record = test::record_of<double>(
        {Shape<double>(Capsule<double>{{ends[0], ends[1]}, 0.1}), pose, Shape<double>(hull), pose});
    ASSERT_TRUE(record.sat && record.sat->face_b && record.sat->edge) << i;
    EXPECT_NEAR(record.sat->face_b->separation, faces, 1e-12);
    EXPECT_NEAR(std::max(record.sat->edge->separation, faces), std::max(edges, faces), 1e-9) << i;
    const bool is_face = record.sat->chosen == "face_b";
    EXPECT_EQ(is_face, faces >= edges - 1e-9) << i << ": " << faces << ", " << edges;
    ++(is_face ? by_face : by_edge);
    // The capsule's normal points into the hull, against the axis of the record's face.
    const Vec3d& chosen = is_face ? record.sat->face_b->normal : record.sat->edge->normal;
    EXPECT_LT((chosen - record.manifolds.at(0).normal).norm(), 1e-9) << i;
  }
  EXPECT_GT(by_face, 20);
  EXPECT_GT(by_edge, 20);
}

TEST(CapsuleAxes, ASegmentOutsideHasNoRecordOfThem) {
  const trace::Pair record = test::record_of<float>({test::upright_capsule(0.5, 0.3),
                                                     test::at(0, 1.2, 0),
                                                     Shape<double>(make_box(Vec3d(0.5, 0.5, 0.5))),
                                                     {}});
  EXPECT_EQ(record.state, "touching");
  EXPECT_FALSE(record.sat);
}

}  // namespace
}  // namespace contactscope
