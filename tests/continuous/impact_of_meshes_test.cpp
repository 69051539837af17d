#include "continuous/impact_with_mesh.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <vector>

#include "query/mesh_overlap.h"
#include "support/random_geometry.h"
#include "support/sphere_mesh.h"

namespace contactscope {
namespace {

using test::Random;

/// A mesh that deforms in a step.
struct Deforming {
  Mesh<double> start;
  std::vector<Vec3d> end;
};

/// A moving wavy sphere, crumpled by a fraction of its radius, or triangles scattered about a ball.
Deforming random_deforming(Random& random, double size, const Vec3d& place, const Vec3d& offset) {
  std::vector<Vec3d> vertices;
  std::vector<std::array<int, 3>> triangles;
  if (random.chance(0.5)) {
    const auto sphere = test::sphere_mesh(size, 6, 3, 0.2);
    vertices = sphere.vertices;
    triangles = sphere.triangles;
  } else {
    for (int i = 0; i < 16; ++i) {
      const Vec3d middle = size * random.uniform(0.5, 1) * random.unit_vector();
      for (int k = 0; k < 3; ++k) vertices.emplace_back(middle + 0.4 * size * random.vector(-1, 1));
      triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
  }
  const Quatd rotation = random.rotation();
  for (Vec3d& vertex : vertices) vertex = rotation * vertex + place;
  Deforming result;
  result.start = build_mesh(vertices, triangles);
  const double crumpled = random.uniform(0, 0.4) * size;
  for (const Vec3d& vertex : result.start.vertices)
    result.end.emplace_back(vertex + offset + crumpled * random.vector(-1, 1));
  return result;
}

template <class S> struct RoundedMesh {
  explicit RoundedMesh(const Deforming& exact)
      : start(mesh_cast<S>(exact.start)), end(cast_each<Vec3<S>>(exact.end)) {}
  MovingMesh<S> moving() const { return {start, end}; }
  /// For the oracle.
  Mesh<double> at_time(double time) const {
    std::vector<Vec3d> vertices = cast_each<Vec3d>(start.vertices);
    for (std::size_t i = 0; i < end.size(); ++i)
      vertices[i] += time * (end[i].template cast<double>() - vertices[i]);
    return build_mesh(vertices, start.triangles);
  }

  Mesh<S> start;
  std::vector<Vec3<S>> end;
};

/// Every corner against every triangle, and every side against every side.
template <class S> double first_of_all_features(const RoundedMesh<S>& a, const RoundedMesh<S>& b) {
  const auto corner = [](const RoundedMesh<S>& mesh, int t, int k) -> MovingCorner<S> {
    const int vertex = at(at(mesh.start.triangles, t), k % 3);
    return {at(mesh.start.vertices, vertex), at(mesh.end, vertex)};
  };
  double first = 2;
  const auto offer = [&](const FeatureImpact& impact) {
    if (impact.status != FeatureStatus::Separated) first = std::min(first, impact.begin);
  };
  for (int s = 0; s < a.start.triangle_count(); ++s) {
    const MovingFace<S> face_a = {corner(a, s, 0), corner(a, s, 1), corner(a, s, 2)};
    for (int t = 0; t < b.start.triangle_count(); ++t) {
      const MovingFace<S> face_b = {corner(b, t, 0), corner(b, t, 1), corner(b, t, 2)};
      for (int i = 0; i < 3; ++i) {
        offer(impact_of_vertex_face(corner(a, s, i), face_b));
        offer(impact_of_vertex_face(corner(b, t, i), face_a));
        for (int k = 0; k < 3; ++k) {
          offer(impact_of_edges<S>({corner(a, s, i), corner(a, s, i + 1)},
                                   {corner(b, t, k), corner(b, t, k + 1)}));
        }
      }
    }
  }
  return first;
}

template <class S> void are_met_as_their_features_are() {
  Random random(41);
  int hits = 0, separated = 0, overlapping = 0;
  for (int i = 0; i < 100; ++i) {
    const double size = random.decade(-4, 4);
    const Vec3d place = size * random.uniform(1.5, 4) * random.unit_vector();
    const Vec3d offset = random.uniform(0.3, 2) * (1.5 * size * random.vector(-1, 1) - place);
    const Deforming exact_a = random_deforming(random, size, Vec3d::Zero(), Vec3d::Zero());
    const Deforming exact_b = random_deforming(random, size, place, offset);
    const RoundedMesh<S> a(exact_a), b(exact_b);
    const MeshImpact found = impact_of_meshes(a.moving(), b.moving());
    if (found.impact.status == FeatureStatus::Overlapping) {
      EXPECT_TRUE(mesh_overlap(a.start, b.start, Pose<S>()).overlapping());
      ++overlapping;
      continue;
    }
    EXPECT_FALSE(mesh_overlap(a.start, b.start, Pose<S>()).overlapping());
    const double first = first_of_all_features(a, b);
    if (found.impact.status == FeatureStatus::Separated) {
      EXPECT_EQ(first, 2) << i;
      EXPECT_EQ(found.triangle_a, -1);
      ++separated;
    } else {
      ++hits;
      EXPECT_EQ(found.impact.status, FeatureStatus::Hit) << i;
      // An edge with the opposite direction rounds differently.
      EXPECT_NEAR(found.impact.begin, first, 1e-12) << i;
      EXPECT_GE(found.triangle_a, 0);
      EXPECT_GE(found.triangle_b, 0);
      EXPECT_LT(found.counts.triangle_pairs,
                a.start.triangle_count() * b.start.triangle_count() / 4);
    }
    // By exact triangles: separated before, and intersecting right after.
    const auto overlap_at = [&](double time) {
      return mesh_overlap(a.at_time(time), b.at_time(time), Pose<double>()).overlapping();
    };
    for (int k = 0; k <= 20; ++k) {
      EXPECT_FALSE(overlap_at(found.impact.begin * (1 - 1e-6) * k / 20)) << i;
    }
    if (found.impact.status != FeatureStatus::Hit) continue;
    EXPECT_TRUE(overlap_at(std::min(found.impact.end + 1e-7, 1.0))) << i;
  }
  EXPECT_GT(hits, 40);
  EXPECT_GT(separated, 8);
}

TEST(ImpactOfMeshes, SlowAreMetAsTheirFeaturesAre) {
  are_met_as_their_features_are<double>();
  are_met_as_their_features_are<float>();
}

TEST(ImpactOfMeshes, ACubeFallsOnACube) {
  const Mesh<double> below = test::cube_mesh(0.5);
  std::vector<Vec3d> end = below.vertices, above = below.vertices, above_end;
  for (Vec3d& vertex : above) {
    vertex += Vec3d(0.3, 0.2, 2);
    above_end.emplace_back(vertex - Vec3d(0, 0, 4));
  }
  const Mesh<double> falling = build_mesh(above, below.triangles);
  const MeshImpact found = impact_of_meshes<double>({below, end}, {falling, above_end});
  ASSERT_NE(found.impact.status, FeatureStatus::Separated);
  EXPECT_NEAR(found.impact.begin, 0.25, 1e-12);
  EXPECT_LE(found.impact.begin, 0.25);
  EXPECT_NEAR(found.impact.normal.z(), 1, 1e-9);  // from below to above
  // It is at its final place from the start and stays: an overlap at time 0.
  const MeshImpact stays = impact_of_meshes<double>({below, end}, {below, end});
  EXPECT_EQ(stays.impact.status, FeatureStatus::Overlapping);
  EXPECT_EQ(stays.impact.begin, 0);
  EXPECT_GE(stays.triangle_a, 0);
}

/// Two triangles at one edge that share no vertex, so the edge can open: each has its own.
TEST(ImpactOfMeshes, ASeamThatOpensHasTwoEdges) {
  const std::vector<Vec3d> sheet = {Vec3d(-1, 0, 0), Vec3d(1, 0, 0),  Vec3d(0, 1, 0),
                                    Vec3d(1, 0, 0),  Vec3d(-1, 0, 0), Vec3d(0, -1, 0)};
  const std::vector<std::array<int, 3>> triangles = {{0, 1, 2}, {3, 4, 5}};
  const Mesh<double> open = build_mesh(sheet, triangles);
  ASSERT_EQ(open.neighbour(0, 0), 1);
  // The second moves up to a rod that lies across its seam, the first down.
  std::vector<Vec3d> end = sheet;
  for (std::size_t i = 0; i < 6; ++i) end[i].z() += i < 3 ? -1 : 1;
  const std::vector<Vec3d> rod = {Vec3d(0, -0.1, 0.5), Vec3d(0, 3, 0.5), Vec3d(0, 3, 3)};
  const Mesh<double> blade = build_mesh(rod, {{0, 1, 2}});
  const MeshImpact found = impact_of_meshes<double>({open, end}, {blade, rod});
  ASSERT_NE(found.impact.status, FeatureStatus::Separated);
  EXPECT_NEAR(found.impact.begin, 0.5, 1e-12);
  EXPECT_EQ(found.triangle_a, 1);
}

}  // namespace
}  // namespace contactscope
