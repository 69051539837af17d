#pragma once

#include <vector>

#include "geometry/mesh.h"

namespace contactscope::test {

/// Builds OpenVDB's level set of a closed mesh, with a band of three cells on each side, of so many cells
/// along the longest side, and prints a line as field_bench does: milliseconds, bytes, nanoseconds of a
/// query with its trilinear sampler, errors of the distance. One thread builds it. Only a message where it
/// is not installed.
void measure_openvdb(const Mesh<double>& mesh, int cells, const std::vector<Vec3d>& points);

/// The least seconds of several builds on so many threads; infinite where it is not installed.
double seconds_to_build_openvdb(const Mesh<double>& mesh, int cells, int threads);

}  // namespace contactscope::test
