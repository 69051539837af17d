#include "manifold/fast/box_on_triangles.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <string>

#include "geometry/primitives.h"
#include "geometry/triangle_hull.h"
#include "manifold/collide_pairs.h"
#include "manifold/create_contact.h"
#include "support/cases.h"
#include "support/random_geometry.h"

// The special path of a box on a triangle gives the result of two hulls, bit for bit, or none.
namespace contactscope {
namespace {

using test::Random;

/// Zeros of either sign are equal.
template <class S> void expect_same_bits(S one, S other) {
  one += S(0);
  other += S(0);
  EXPECT_EQ(std::memcmp(&one, &other, sizeof one), 0) << one << " for " << other;
}

template <class S> void expect_same(const Contact<S>& contact, const Contact<S>& expected) {
  ASSERT_EQ(contact.points.size(), expected.points.size());
  if (expected.points.empty()) return;
  EXPECT_EQ(contact.axis, expected.axis);
  EXPECT_EQ(contact.type, expected.type);
  for (int k = 0; k < 3; ++k) expect_same_bits(contact.normal[k], expected.normal[k]);
  for (std::size_t i = 0; i < expected.points.size(); ++i) {
    SCOPED_TRACE("point " + std::to_string(i));
    EXPECT_EQ(to_string(contact.points[i].id), to_string(expected.points[i].id));
    for (int k = 0; k < 3; ++k)
      expect_same_bits(contact.points[i].position[k], expected.points[i].position[k]);
    expect_same_bits(contact.points[i].separation, expected.points[i].separation);
  }
}

/// Number of results, by kind of axis.
struct Done {
  int triangles = 0, by_itself = 0, gap = 0;
  int by[4] = {};
};

template <class S>
void expect_general(const Hull<S>& box, const Mesh<S>& mesh, const Pose<S>& mesh_in_box,
                    const CollideOptions& options, Done& done) {
  const BoxOnTriangles<S> pair(box, mesh, mesh_in_box, options);
  for (int triangle = 0; triangle < mesh.triangle_count(); ++triangle) {
    SCOPED_TRACE("triangle " + std::to_string(triangle));
    TriangleHull<S> flat;
    flat.set(mesh, triangle);
    const Pose<S> placed{mesh_in_box.rotation, mesh_in_box.transform(flat.origin)};
    Recorder<S>* const no_record = nullptr;
    Contact<S> contact, expected;
    ++done.triangles;
    if (pair.collide(triangle, contact)) {
      PairCache<S>* const nothing_kept = nullptr;
      collide_hull_hull(box, flat.hull, placed, options, nothing_kept, expected, no_record,
                        Owner::B);
      ++done.by_itself;
      ++(expected.points.empty() ? done.gap : done.by[static_cast<int>(expected.axis)]);
      ASSERT_NO_FATAL_FAILURE(expect_same(contact, expected));
    } else {
      EXPECT_TRUE(contact.points.empty());
    }
    for (const int face : {0, 1}) {
      SCOPED_TRACE("face " + std::to_string(face));
      Contact<S> on_face, expected_on_face;
      if (!pair.collide_face(triangle, face, on_face)) continue;
      const HullPair<S> hulls(box, flat.hull, placed);
      const Plane<S> plane = hulls.b.plane(face);
      FaceQuery<S> query{face, 0, std::numeric_limits<S>::infinity()};
      for (int vertex = 0; vertex < 8; ++vertex) {
        const S separation = plane.distance(hulls.a.vertices[vertex]);
        if (separation < query.separation) query = {face, vertex, separation};
      }
      create_face_contact(hulls, Owner::B, query, static_cast<S>(options.margin), expected_on_face,
                          no_record);
      ASSERT_NO_FATAL_FAILURE(expect_same(on_face, expected_on_face));
    }
    if (testing::Test::HasFailure()) return;
  }
}

template <class S> class BoxOnTriangle : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(BoxOnTriangle, Scalars);

Hull<double> any_box(Random& random, double size) {
  Vec3d half;
  for (int k = 0; k < 3; ++k) half[k] = size * random.decade(-1, 0);
  return make_box(half);
}

TYPED_TEST(BoxOnTriangle, AnySizeAndPoseMatchesTheGeneralHull) {
  using S = TypeParam;
  Random random(71);
  Done done;
  for (int i = 0; i < test::cases(20000); ++i) {
    SCOPED_TRACE("pair " + std::to_string(i));
    const double size = random.decade(-4, 4);
    const double triangle_size = size * random.decade(-1, 1);
    std::vector<Vec3d> corners;
    for (int k = 0; k < 3; ++k) corners.push_back(triangle_size * random.vector(-1, 1));
    const Mesh<S> mesh = mesh_cast<S>(build_mesh(corners, {{{0, 1, 2}}}));
    const Hull<S> box = hull_cast<S>(any_box(random, size));
    // A point of the triangle somewhere in the box.
    const double s = random.uniform(0, 1), t = random.uniform(0, 1 - s);
    Pose<double> in_box{random.rotation(), Vec3d::Zero()};
    Vec3d place = random.vector(-1.5, 1.5);
    for (int k = 0; k < 3; ++k) place[k] *= static_cast<double>(box.half_extents[k]);
    in_box.position = place - in_box.rotate(Vec3d(corners[0] + s * (corners[1] - corners[0]) +
                                                  t * (corners[2] - corners[0])));
    CollideOptions options;
    if (random.chance(0.3)) options.preference = Preference::None;
    if (random.chance(0.3)) options.margin = 0.1 * size;
    ASSERT_NO_FATAL_FAILURE(expect_general<S>(box, mesh, in_box.cast<S>(), options, done));
    if (testing::Test::HasFailure()) break;
  }
  EXPECT_GT(done.by_itself, 0.9 * done.triangles);
  EXPECT_GT(done.gap, 0.05 * done.triangles);
  for (const AxisKind axis : {AxisKind::FaceA, AxisKind::FaceB, AxisKind::EdgeEdge})
    EXPECT_GT(done.by[static_cast<int>(axis)], 0.05 * done.triangles) << to_string(axis);
}

/// Rotations about one axis of the box by a round angle, exact or approximate, and positions on a
/// lattice: edges that are parallel, corners that lie on faces, faces that are equally deep.
TYPED_TEST(BoxOnTriangle, OnALatticeIsAsForAnyHullOrNotDone) {
  using S = TypeParam;
  Random random(72);
  Done done;
  for (int i = 0; i < test::cases(3000); ++i) {
    SCOPED_TRACE("pair " + std::to_string(i));
    const double size = random.chance(0.5) ? 1 : random.decade(-4, 4);
    const double nudge = random.chance(0.3) ? 0 : random.decade(-9, -1);
    const Mesh<S> grid = mesh_cast<S>(
        make_grid(4 * size, 4 * size, 4, 4, random.chance(0.5) ? 0 : size * random.decade(-6, -1)));
    Vec3d half;
    for (int k = 0; k < 3; ++k) half[k] = size * (1 + random.index(3)) / 2;
    const Hull<S> box = hull_cast<S>(make_box(half));
    const double angle =
        0.25 * static_cast<double>(EIGEN_PI) * random.index(8) + nudge * random.uniform(-1, 1);
    Pose<double> in_box;
    in_box.rotation = Quatd(Eigen::AngleAxisd(angle, Vec3d::Unit(random.index(3)))).normalized();
    for (int k = 0; k < 3; ++k) in_box.position[k] = size * (random.index(9) - 4) / 4;
    in_box.position += nudge * size * random.vector(-1, 1);
    CollideOptions options;
    if (random.chance(0.3)) options.preference = Preference::None;
    if (random.chance(0.3)) options.margin = 0.25 * size;
    ASSERT_NO_FATAL_FAILURE(expect_general<S>(box, grid, in_box.cast<S>(), options, done));
    if (testing::Test::HasFailure()) break;
  }
  EXPECT_GT(done.by_itself, 0.5 * done.triangles);
  for (const AxisKind axis : {AxisKind::FaceA, AxisKind::FaceB, AxisKind::EdgeEdge})
    EXPECT_GT(done.by[static_cast<int>(axis)], 200 / test::kOneIn) << to_string(axis);
}

TYPED_TEST(BoxOnTriangle, APoseThatTurnsNothingRoundIsNotDone) {
  using S = TypeParam;
  const Hull<S> box = hull_cast<S>(make_box(Vec3d(1, 2, 3)));
  const Mesh<S> grid = mesh_cast<S>(make_grid(4, 4, 2, 2, 0));
  Pose<S> pose;
  pose.rotation.w() = S(2);
  Contact<S> contact;
  EXPECT_FALSE(BoxOnTriangles<S>(box, grid, pose, {}).collide(0, contact));
  pose.rotation.w() = std::numeric_limits<S>::quiet_NaN();
  EXPECT_FALSE(BoxOnTriangles<S>(box, grid, pose, {}).collide(0, contact));
  pose = {};
  pose.position.x() = std::numeric_limits<S>::quiet_NaN();
  EXPECT_FALSE(BoxOnTriangles<S>(box, grid, pose, {}).collide(0, contact));
}

}  // namespace
}  // namespace contactscope
