// contactscope-field-openvdb: OpenVDB as a peer of the study `distance_field`, on one thread.
// src/study/peers.h documents its input and output.
#include <openvdb/openvdb.h>
#include <openvdb/tools/GridOperators.h>
#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/MeshToVolume.h>
#include <openvdb/version.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <string>
#include <vector>

namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

template <class Vector> std::vector<Vector> read_list(std::istream& in) {
  std::string word;
  std::size_t count = 0;
  in >> word >> count;
  std::vector<Vector> list(count);
  for (Vector& entry : list) in >> entry[0] >> entry[1] >> entry[2];
  return list;
}

}  // namespace

int main() {
  std::string word;
  int cells = 0, band = 0, repetitions = 0;
  std::cin >> word >> cells >> word >> band >> word >> repetitions;
  const auto vertices = read_list<openvdb::Vec3s>(std::cin);
  const auto triangles = read_list<openvdb::Vec3I>(std::cin);
  const auto points = read_list<openvdb::Vec3R>(std::cin);
  if (!std::cin || vertices.empty() || triangles.empty()) {
    std::cerr << "the request is torn\n";
    return 2;
  }
  openvdb::Vec3s lower = vertices.front(), upper = lower;
  for (const openvdb::Vec3s& vertex : vertices) {
    lower = openvdb::math::minComponent(lower, vertex);
    upper = openvdb::math::maxComponent(upper, vertex);
  }
  openvdb::initialize();
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const openvdb::Vec3s extent = upper - lower;
  const double cell = double{std::max({extent[0], extent[1], extent[2]})} / cells;
  const auto transform = openvdb::math::Transform::createLinearTransform(cell);
  openvdb::FloatGrid::Ptr grid;
  double build = 1e12;
  for (int i = 0; i < std::min(repetitions, 3); ++i) {
    const auto start = Clock::now();
    grid = openvdb::tools::meshToLevelSet<openvdb::FloatGrid>(*transform, vertices, triangles,
                                                              static_cast<float>(band));
    build = std::min(build, milliseconds_since(start));
  }
  const openvdb::Vec3SGrid::Ptr slopes = openvdb::tools::gradient(*grid);
  const auto accessor = grid->getConstAccessor();
  const openvdb::tools::GridSampler<openvdb::FloatGrid::ConstAccessor, openvdb::tools::BoxSampler>
      distance(accessor, grid->transform());
  const auto slope_accessor = slopes->getConstAccessor();
  const openvdb::tools::GridSampler<openvdb::Vec3SGrid::ConstAccessor, openvdb::tools::BoxSampler>
      gradient(slope_accessor, slopes->transform());

  std::cout.precision(17);
  std::cout << "name OpenVDB " << OPENVDB_LIBRARY_VERSION_STRING << ", trilinear\nbuild " << build
            << " bytes " << grid->memUsage() << " nanoseconds " << repetitions << '\n';
  double sum = 0;
  for (int i = 0; i < repetitions; ++i) {
    const auto start = Clock::now();
    for (const openvdb::Vec3R& point : points) sum += double{distance.wsSample(point)};
    std::cout << milliseconds_since(start) * 1e6 / static_cast<double>(points.size()) << '\n';
  }
  if (sum == 0.123) std::cerr << sum;  // keeps the compiler from removing the sums
  for (const openvdb::Vec3R& point : points) {
    const openvdb::Vec3s along = gradient.wsSample(point);
    std::cout << double{distance.wsSample(point)} << ' ' << along[0] << ' ' << along[1] << ' '
              << along[2] << '\n';
  }
  return 0;
}
