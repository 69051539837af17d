#include <cstdio>

#include "bench/field_openvdb.h"

namespace contactscope::test {

void measure_openvdb(const Mesh<double>& /*mesh*/, int /*cells*/,
                     const std::vector<Vec3d>& /*points*/) {
  std::printf("OpenVDB is not installed (apt-get install libopenvdb-dev)\n");
}

}  // namespace contactscope::test
