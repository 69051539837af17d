#include <cstdio>
#include <limits>

#include "bench/field_openvdb.h"

namespace contactscope::test {

void measure_openvdb(const Mesh<double>& /*mesh*/, int /*cells*/,
                     const std::vector<Vec3d>& /*points*/) {
  std::printf("OpenVDB is not installed (apt-get install libopenvdb-dev)\n");
}

double seconds_to_build_openvdb(const Mesh<double>& /*mesh*/, int /*cells*/, int /*threads*/) {
  return std::numeric_limits<double>::infinity();
}

}  // namespace contactscope::test
