#pragma once

#include <random>
#include <vector>

#include "core/vec3.h"

/// Seeded point sets for building hulls in tests. Extent about 1, around the origin.
namespace contactscope::test {

using Points = std::vector<Vec3d>;
using Generator = std::mt19937_64;

Points in_ball(Generator& random, int count);
Points on_sphere(Generator& random, int count);
Points gaussian(Generator& random, int count);
/// Uniform in a box of these half extents.
Points in_box(Generator& random, int count, const Vec3d& half_extents);
/// The nodes of a cubic lattice with `cells` cells a side: coplanar and collinear throughout.
Points box_grid(int cells);
/// Corners of a prism over a regular polygon, radius 0.5, half height 0.5.
Points prism(int segments);
/// A latitude-longitude sphere, as modelling programs make it: poles, rings, planar quads.
Points globe(int rings, int segments);

Mat3<double> random_rotation(Generator& random);
/// Rotates, scales, then moves each point.
Points transformed(const Points& points, const Mat3<double>& rotation, double scale,
                   const Vec3d& offset);
/// Rounds each coordinate to float.
Points rounded_to_float(const Points& points);
/// Rounds each coordinate to decimal text with this many digits after the point.
Points rounded_to_decimals(const Points& points, int digits);
/// Removes repeated points; the order stays.
Points without_repeats(const Points& points);

}  // namespace contactscope::test
