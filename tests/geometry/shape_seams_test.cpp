#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/hull_builder.h"
#include "geometry/mesh_seams.h"
#include "geometry/primitives.h"
#include "support/cases.h"
#include "support/tiled_floor.h"

namespace contactscope::test {
namespace {

/// The tiles of a floor as hulls of this height below it, or as meshes.
std::vector<Shape<double>> parts_of(const TiledFloor& floor, double height) {
  std::vector<Shape<double>> parts;
  for (int tile = 0; tile < floor.tile_count(); ++tile) {
    std::vector<Vec3d> points;
    for (int i = 0; i < 4; ++i)
      points.push_back(floor.vertices[static_cast<std::size_t>(4 * tile + i)]);
    if (height == 0) {
      parts.emplace_back(build_mesh(points, {{0, 1, 2}, {0, 2, 3}}));
      continue;
    }
    for (int i = 0; i < 4; ++i)
      points.push_back(points[static_cast<std::size_t>(i)] - height * Vec3d::UnitY());
    parts.emplace_back(build_hull(points));
  }
  return parts;
}

/// The parts, each with an own frame, in the frame `by` of the floor.
std::vector<Pose<double>> spread(Random& random, std::vector<Shape<double>>& parts,
                                 const Pose<double>& by, double size) {
  std::vector<Pose<double>> poses;
  for (Shape<double>& part : parts) {
    const Vec3d origin = random.vector(-size, size);
    part = seen_from(part, origin);
    poses.push_back(compose(by, {Quatd::Identity(), origin}));
  }
  return poses;
}

std::vector<std::size_t> joined(std::vector<Shape<double>>& parts,
                                const std::vector<Pose<double>>& poses) {
  std::vector<PlacedSurface> placed;
  for (std::size_t i = 0; i < parts.size(); ++i) placed.push_back({&parts[i], poses[i]});
  return join_seams(placed);
}

/// In the floor's plane: how far a point is from the middle, in half sides of the square.
double outwards(const Vec3d& point, double size) {
  return std::max(std::abs(point.x()), std::abs(point.z())) / size;
}

// The outline of the square is the oracle.
TEST(ShapeSeams, InnerFacesOfAFloorOfHullsAreCoveredAndItsTopContinues) {
  Random random(3720);
  int covered = 0, continued = 0, ended = 0;
  for (const double size : {1e-4, 1.0, 1e4}) {
    for (int i = 0; i < test::cases(20); ++i) {
      const TiledFloor floor(random, size, 0);
      std::vector<Shape<double>> parts = parts_of(floor, size);
      const Pose<double> by = random.pose(size);
      const std::vector<Pose<double>> poses = spread(random, parts, by, size);
      EXPECT_EQ(joined(parts, poses).size(), parts.size());
      for (std::size_t k = 0; k < parts.size(); ++k) {
        const auto& hull = std::get<Hull<double>>(parts[k]);
        const auto in_floor = [&](const Vec3d& point) -> Vec3d {
          return by.inverse_transform(poses[k].transform(point));
        };
        ASSERT_EQ(hull.seams.covered.size(), hull.planes.size());
        for (int face = 0; face < hull.face_count(); ++face) {
          Vec3d middle = Vec3d::Zero();
          for (const int vertex : face_vertices(hull, face))
            middle += 0.25 * in_floor(at(hull.vertices, vertex));
          const bool is_side = std::abs(at(hull.planes, face).normal.y()) < 0.5;
          const bool is_inner = is_side && outwards(middle, size) < 0.999;
          EXPECT_EQ(at(hull.seams.covered, face), is_inner ? 1 : 0);
          covered += is_inner ? 1 : 0;
          if (is_side) continue;
          for (const int edge : hull.around_face(face)) {
            const Vec3d between = in_floor(0.5 * (hull.origin(edge) + hull.target(edge)));
            const Vec3d& beyond = at(hull.seams.beyond, edge);
            const bool goes_on = outwards(between, size) < 0.999;
            const Vec3d expected = goes_on ? at(hull.planes, face).normal : Vec3d::Zero();
            EXPECT_LT((beyond - expected).norm(), 1e-9);
            ++(goes_on ? continued : ended);
          }
        }
      }
    }
  }
  EXPECT_GT(covered, 1000 / test::kOneIn);
  EXPECT_GT(continued, 1000 / test::kOneIn);
  EXPECT_GT(ended, 500 / test::kOneIn);
}

TEST(ShapeSeams, MeshesContinueEachOtherAtInnerEdges) {
  Random random(3721);
  int across = 0;
  for (const double size : {1e-4, 1.0, 1e4}) {
    for (int i = 0; i < test::cases(20); ++i) {
      const TiledFloor floor(random, size, 1e-7 * size);
      std::vector<Shape<double>> parts = parts_of(floor, 0);
      const Pose<double> by = random.pose(size);
      const std::vector<Pose<double>> poses = spread(random, parts, by, size);
      joined(parts, poses);
      for (std::size_t k = 0; k < parts.size(); ++k) {
        const auto& mesh = std::get<Mesh<double>>(parts[k]);
        for (int t = 0; t < 2; ++t) {
          for (int edge = 0; edge < 3; ++edge) {
            const int beyond = mesh.beyond(t, edge);
            const Vec3d between = by.inverse_transform(
                poses[k].transform(0.5 * (mesh.corner(t, edge) + mesh.corner(t, (edge + 1) % 3))));
            ASSERT_EQ(beyond<0, outwards(between, size)> 0.999);
            if (beyond < mesh.triangle_count()) continue;
            ++across;
            EXPECT_LT((mesh.normal(beyond) - mesh.normal(t)).norm(), 1e-5);
            EXPECT_EQ(mesh.edge_class(t, edge), EdgeClass::Internal);
            EXPECT_EQ(mesh.region(beyond), beyond);
          }
        }
        EXPECT_EQ(mesh.region(0), 0);
        EXPECT_EQ(mesh_cast<float>(mesh).normals.size(), mesh.normals.size());
      }
    }
  }
  EXPECT_GT(across, 1000 / test::kOneIn);
}

TEST(ShapeSeams, FacesThatAreCoveredInPartAreNotCovered) {
  std::vector<Shape<double>> parts = {make_box({1, 1, 1}), make_box({1, 0.5, 1}),
                                      make_box({1, 0.499, 1})};
  const Pose<double> left, below{Quatd::Identity(), {2, -0.5, 0}};
  const auto covered_by = [&](std::vector<std::size_t> which, const std::vector<Pose<double>>& at) {
    std::vector<Shape<double>> some;
    for (const std::size_t i : which) some.push_back(parts[i]);
    joined(some, at);
    const auto& seams = std::get<Hull<double>>(some[0]).seams;
    return std::ranges::count(seams.covered, 1);
  };
  const Pose<double> above{Quatd::Identity(), {2, 0.5, 0}};
  EXPECT_EQ(covered_by({0, 1}, {left, below}), 0);
  EXPECT_EQ(covered_by({0, 1, 1}, {left, below, above}), 1);
  EXPECT_EQ(covered_by({0, 2, 1}, {left, below, above}), 0);  // a gap of 2 mm
  // A gap between the shapes that is wider than a seam.
  EXPECT_EQ(covered_by({0, 0}, {left, {Quatd::Identity(), {2 + 1e-8, 0, 0}}}), 1);
  EXPECT_EQ(covered_by({0, 0}, {left, {Quatd::Identity(), {2 + 1e-4, 0, 0}}}), 0);
}

// Far from the origin of the world the same gaps count.
TEST(ShapeSeams, AGapIsMeasuredByTheShapeAndNotByItsPlace) {
  for (const double far : {0.0, 1e4}) {
    for (const double gap : {1e-8, 1e-4}) {
      std::vector<Shape<double>> parts = {make_box({1, 1, 1}), make_box({1, 1, 1})};
      joined(parts, {{Quatd::Identity(), {far, 0, 0}}, {Quatd::Identity(), {far + 2 + gap, 0, 0}}});
      const auto& seams = std::get<Hull<double>>(parts[0]).seams;
      EXPECT_EQ(std::ranges::count(seams.covered, 1), gap < 1e-6 ? 1 : 0) << far << ", " << gap;
    }
  }
}

// A wall with its face in the plane of a floor's side stands on it: its lower face covers the floor
// there, and does not continue it.
TEST(ShapeSeams, AWallOnARimEndsNoFloor) {
  std::vector<Shape<double>> parts = {make_box({1, 0.1, 1}), make_box({0.1, 1, 1})};
  joined(parts, {{Quatd::Identity(), {0, -0.1, 0}}, {Quatd::Identity(), {0.9, 1, 0}}});
  const auto& floor = std::get<Hull<double>>(parts[0]);
  int continued = 0;
  for (int edge = 0; edge < count_of(floor.half_edges); ++edge) {
    const Vec3d& beyond = at(floor.seams.beyond, edge);
    if (beyond.isZero(0)) continue;
    ++continued;
    EXPECT_EQ(beyond, Vec3d::UnitX());  // the sides of both
  }
  EXPECT_EQ(continued, 1);
  EXPECT_EQ(std::ranges::count(std::get<Hull<double>>(parts[1]).seams.covered, 1), 1);
}

}  // namespace
}  // namespace contactscope::test
