#pragma once

#include <array>

#include "query/triangle_overlap.h"
#include "trace/study.h"

namespace contactscope {

/// Two triangles, the second with its first corner at (1/2 + i u, 1/2 + j u, 0) m, where u is the
/// distance of two numbers in the scalar from 1/2 on; -64 <= i, j <= 64. The first one lies in the
/// plane x - y + z = 0, with corners that use all digits of the scalar, and has that corner well inside where i = j: there they touch. Both others of
/// the second's corners are on the side to which x grows; so the triangles are apart where i > j and
/// cut through each other where i < j. Every coordinate is exact.
template <class S>
std::array<Triangle<S>, 2> nearly_touching(int i, int j);

/// A map of what three tests answer of these: plain signs in float and in double, and the exact one.
/// After the maps of Kettner, Mehlhorn, Pion, Schirra and Yap 2008, "Classroom examples of robustness
/// problems in geometric computations", of which the point on a line is a corner on a plane here.
trace::Study triangle_answers();

}  // namespace contactscope
