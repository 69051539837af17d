#include <gtest/gtest.h>

#include "geometry/primitives.h"
#include "manifold/placed_shapes.h"
#include "support/builders.h"
#include "support/cases.h"
#include "support/random_geometry.h"
#include "trace/json.h"

namespace contactscope {
namespace {

using test::PlacedShapes;

/// The stages of one triangle, without its number, as JSON.
std::string stages_of(trace::Pair record) {
  if (record.sat && record.sat->face_b) record.sat->face_b->face = 0;
  if (record.sat && record.sat->edge) record.sat->edge->b %= 3;
  if (record.clip)
    for (trace::ClipFace* const face : {&record.clip->reference, &record.clip->incident})
      if (face->shape == "b") face->face = 0;
  trace::Pair stages;
  stages.sat = record.sat;
  stages.clip = record.clip;
  trace::Frame frame;
  frame.pairs = {stages};
  return trace::to_json_line(frame);
}

/// A grid with rough heights, in random size and place.
Mesh<double> rough_grid(test::Random& random, double size) {
  Mesh<double> grid = make_grid(4 * size, 4 * size, 4, 4, 0);
  for (Vec3d& vertex : grid.vertices) vertex.y() = random.uniform(-0.2, 0.2) * size;
  return build_mesh(grid.vertices, grid.triangles);
}

/// The oracle is the pipeline for a mesh that has this triangle alone.
template <class S> void expect_stages_of_each_triangle(int seed) {
  test::Random random(seed);
  int touching = 0, clipped = 0;
  for (int i = 0; i < test::cases(60); ++i) {
    const double size = random.decade(-4, 4);
    const Mesh<double> mesh = rough_grid(random, size);
    const bool is_hull = random.uniform(0, 1) < 0.7;
    const Shape<double> shape = is_hull
                                    ? Shape<double>(test::random_hull(random, 12, size, 2))
                                    : Shape<double>(test::upright_capsule(0.4 * size, 0.3 * size));
    PlacedShapes pair{shape, {random.rotation(), Vec3d(0, 0.5 * size, 0)}, mesh, {}};
    CollideOptions options;
    options.internal_edges = false;
    const trace::Pair whole = test::record_of<S>(pair, options);
    const int picked = whole.triangle.value_or(-1);
    double deepest = 0;
    for (const int triangle : whole.tree->candidates) {
      options.recorded_triangle = triangle;
      pair.b = mesh;
      const trace::Pair of_one = test::record_of<S>(pair, options);
      if (of_one.sat || of_one.clip) {
        EXPECT_EQ(of_one.triangle, triangle);
      }
      pair.b = build_mesh(mesh.vertices, {{mesh.triangles[std::size_t(triangle)]}});
      options.recorded_triangle = -1;
      const trace::Pair alone = test::record_of<S>(pair, options);
      EXPECT_EQ(stages_of(of_one), stages_of(alone)) << "case " << i << ", triangle " << triangle;
      clipped += of_one.clip.has_value();
      if (alone.manifolds.empty()) continue;
      deepest = std::min(deepest, alone.separation);
      if (triangle == picked) {
        EXPECT_EQ(alone.separation, whole.separation) << "case " << i;
      }
    }
    if (whole.manifolds.empty()) continue;
    ++touching;
    EXPECT_EQ(whole.separation, deepest) << "case " << i;
  }
  EXPECT_GT(touching, test::cases(60) / 3);
  EXPECT_GT(clipped, touching);
}

TEST(MeshStages, ARecordHasThoseOfTheChosenTriangleOrOfTheDeepest) {
  expect_stages_of_each_triangle<double>(1);
  expect_stages_of_each_triangle<float>(2);
}

/// Where another face takes the place of an internal edge, the clipping is that of the contact.
TEST(MeshStages, ClippingIsThatOfTheContactThatWasMade) {
  const Mesh<double> floor = make_grid(4, 4, 8, 8, 0);
  PlacedShapes pair{Shape<double>(test::cube(0.3)), test::at(0.1, 0.29, 0.07), floor, {}};
  CollideOptions options;
  options.mesh_manifolds = MeshManifolds::Triangle;
  const trace::Pair whole = test::record_of<double>(pair, options);
  ASSERT_GT(whole.manifolds.size(), 3u);
  for (const trace::Manifold& manifold : whole.manifolds) {
    options.recorded_triangle = *manifold.triangle;
    const trace::Pair record = test::record_of<double>(pair, options);
    ASSERT_TRUE(record.clip) << *manifold.triangle;
    EXPECT_EQ(record.clip->reference.shape, "b");
    EXPECT_EQ(record.clip->reference.face, *manifold.triangle);
    EXPECT_NEAR(std::abs(record.clip->reference.normal.dot(manifold.normal)), 1, 1e-12);
    for (const trace::Point& point : manifold.points) {
      double nearest = 1;
      for (const Vec3d& corner : record.clip->steps.back().polygon) {
        const Vec3d offset = corner - point.position;
        nearest = std::min(nearest, (offset - offset.y() * Vec3d::UnitY()).norm());
      }
      EXPECT_LT(nearest, 1e-12) << "a corner of the clip polygon";
    }
  }
  options.recorded_triangle = 0;
  EXPECT_FALSE(test::record_of<double>(pair, options).clip) << "it is not near";
}

}  // namespace
}  // namespace contactscope
