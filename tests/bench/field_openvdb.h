#pragma once

#include <vector>

#include "geometry/mesh.h"

namespace contactscope::test {

/// Builds OpenVDB's level set of a closed mesh, with a band of three cells on each side, of so many cells
/// along the longest side, and prints a line as field_bench does: milliseconds, bytes, nanoseconds of a
/// query with its trilinear sampler, errors of the distance. Only a message where it is not installed.
void measure_openvdb(const Mesh<double>& mesh, int cells, const std::vector<Vec3d>& points);

}  // namespace contactscope::test
