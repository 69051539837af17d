#pragma once

#include <memory>
#include <variant>
#include <vector>

#include "bench/workload.h"
#include "geometry/mesh.h"
#include "peers/round_pair.h"
#include "support/pair_case.h"

/// Shapes on a mesh of 10,000 triangles, with an oracle: every nearby triangle is treated as a flat
/// hull, so the oracles of convex shapes apply.
namespace contactscope::peers {

struct OnMesh {
  std::shared_ptr<const Shape<double>> shape;
  std::shared_ptr<const Shape<double>> mesh;
  Pose<double> pose;
  Pose<double> mesh_pose;

  const Mesh<double>& the_mesh() const { return std::get<Mesh<double>>(*mesh); }
};

/// Pairs of W7, every other one lifted off by 5 to 20 mm.
std::vector<OnMesh> hulls_on_mesh(bench::Workload workload, int count);

/// Spheres or capsules of radius 0.25 on the same grid, over the middle or an edge of a triangle: 1
/// to 10 mm deep, every other one 1 to 10 mm separated.
std::vector<OnMesh> rounds_on_mesh(ShapeKind kind, int count);

struct WithTriangle {
  std::variant<test::PairCase<double>, RoundPair> pair;
  double separation = 0;          // metres, by exhaustion
  Vec3d normal = Vec3d::UnitY();  // of least overlap; only for hulls
};

/// Triangles within a few centimetres, the deepest first; at least one.
std::vector<WithTriangle> triangles_near(const OnMesh& pair);

}  // namespace contactscope::peers
