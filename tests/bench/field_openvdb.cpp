#include "bench/field_openvdb.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/MeshToVolume.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "bench/field_judge.h"

namespace contactscope::test {
namespace {

using VdbClock = std::chrono::steady_clock;

double vdb_seconds_since(VdbClock::time_point start) {
  return std::chrono::duration<double>(VdbClock::now() - start).count();
}

struct VdbMesh {
  std::vector<openvdb::Vec3s> vertices;
  std::vector<openvdb::Vec3I> triangles;
};

VdbMesh vdb_mesh(const Mesh<double>& mesh) {
  VdbMesh copy;
  for (const Vec3d& vertex : mesh.vertices)
    copy.vertices.emplace_back(vertex.x(), vertex.y(), vertex.z());
  for (const auto& [a, b, c] : mesh.triangles) copy.triangles.emplace_back(a, b, c);
  return copy;
}

constexpr float kBand = 3;

/// The minimum seconds of several builds on `threads` threads.
double least_seconds(const VdbMesh& mesh, double cell, int threads, openvdb::FloatGrid::Ptr& grid) {
  openvdb::initialize();
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  const auto transform = openvdb::math::Transform::createLinearTransform(cell);
  double least = 1e9;
  for (int round = 0; round < 5; ++round) {
    const auto start = VdbClock::now();
    grid = openvdb::tools::meshToLevelSet<openvdb::FloatGrid>(*transform, mesh.vertices,
                                                              mesh.triangles, kBand);
    least = std::min(least, vdb_seconds_since(start));
  }
  return least;
}

double vdb_cell(const Mesh<double>& mesh, int cells) {
  return mesh.tree.bounds().extent().maxCoeff() / cells;
}

}  // namespace

double seconds_to_build_openvdb(const Mesh<double>& mesh, int cells, int threads) {
  openvdb::FloatGrid::Ptr grid;
  return least_seconds(vdb_mesh(mesh), vdb_cell(mesh, cells), threads, grid);
}

void measure_openvdb(const Mesh<double>& mesh, int cells, const std::vector<Vec3d>& points) {
  const double cell = vdb_cell(mesh, cells);
  openvdb::FloatGrid::Ptr grid;
  const double build = least_seconds(vdb_mesh(mesh), cell, 1, grid);
  // With an accessor, which remembers the last point's position in the tree.
  const auto accessor = grid->getConstAccessor();
  const openvdb::tools::GridSampler<openvdb::FloatGrid::ConstAccessor, openvdb::tools::BoxSampler>
      sampler(accessor, grid->transform());
  const auto sample = [&](const Vec3d& p) -> double {
    return double{sampler.wsSample(openvdb::Vec3R(p.x(), p.y(), p.z()))};
  };
  double query = 1e9, sum = 0;
  for (int round = 0; round < 5; ++round) {
    const auto start = VdbClock::now();
    for (const Vec3d& point : points) sum += sample(point);
    query = std::min(query, vdb_seconds_since(start) * 1e9 / static_cast<double>(points.size()));
  }
  // Only points whose eight nodes are in the band: a level set holds no distances beyond it.
  FieldJudge judge(mesh);
  std::vector<double> errors;
  for (std::size_t i = 0; i < points.size() && errors.size() < 20000; ++i) {
    const double found = sample(points[i]);
    if (std::abs(found) > (double{kBand} - 1.8) * cell) continue;
    judge.look_at(points[i], 0);
    errors.push_back(std::abs(found - judge.distance(points[i])));
  }
  std::ranges::sort(errors);
  const auto quantile = [&](double share) {
    return 1e3 * errors[static_cast<std::size_t>(share * static_cast<double>(errors.size() - 1))];
  };
  std::printf("OpenVDB           band 3: build %6.1f ms %6.2f MB  query %5.1f ns", 1e3 * build,
              1e-6 * static_cast<double>(grid->memUsage()), sum == 0.123 ? 0 : query);
  std::printf("  error %.4f %.4f %.4f mm\n", quantile(0.5), quantile(0.99), quantile(1));
}

}  // namespace contactscope::test
