#pragma once

#include <vector>

#include "geometry/mesh.h"

namespace contactscope::test {

/// Builds OpenVDB's level set of a closed mesh with `cells` cells along the longest side and a band
/// of three cells on each side, on one thread. Prints a line as field_bench does: milliseconds,
/// bytes, nanoseconds of a query with its trilinear sampler, errors of the distance. Without
/// OpenVDB it only prints a message.
void measure_openvdb(const Mesh<double>& mesh, int cells, const std::vector<Vec3d>& points);

/// The minimum seconds of several builds on `threads` threads; infinite without OpenVDB.
double seconds_to_build_openvdb(const Mesh<double>& mesh, int cells, int threads);

}  // namespace contactscope::test
