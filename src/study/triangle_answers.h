#pragma once

#include <array>

#include "query/triangle_overlap.h"
#include "trace/study.h"

namespace contactscope {

/// Two triangles, the second with its first corner at (1/2 + i u, 1/2 + j u, 0) m, where u is the
/// spacing of the scalar's numbers from 1/2 on; -64 <= i, j <= 64. The first one lies in the plane
/// x - y + z = 0, and its corners use all digits of the scalar. For i = j that corner is well
/// inside it, and they touch. The other corners of the second one are on the side of larger x, so
/// the triangles are separated for i > j and cross for i < j. Every coordinate is exact.
template <class S>
std::array<Triangle<S>, 2> nearly_touching(int i, int j);

/// A map of the answers of three tests for these: plain signs in float and in double, and the exact
/// test. After Kettner, Mehlhorn, Pion, Schirra and Yap 2008, "Classroom examples of robustness
/// problems in geometric computations"; their point on a line is a corner on a plane here.
trace::Study triangle_answers();

}  // namespace contactscope
