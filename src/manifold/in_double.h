#pragma once

#include "core/pose.h"
#include "geometry/shape.h"
#include "manifold/collide_options.h"

/// Pairs that single precision cannot hold together. A crate of 2 cm on a floor of 20 km: a corner of
/// the floor is rounded by a millimetre, and so is what clipping makes of it, however close to the
/// crate. Such a pair is worked on in double from what float holds of it, and the result is rounded
/// once, in the world. Tolerances that look away from the far corners would not do: the numbers
/// themselves are lost.
namespace contactscope {

/// Whether the pair is one of these: four roundings of the larger shape are more than what the
/// preference for an axis grants at a kiss, 0.2% of the smaller one (tolerance.h). That is where one is
/// some four thousand times the other. Never of planes, which have no corners, nor of meshes, which
/// are too large to be copied; nor with a reducer that is not one of reducers().
bool belongs_in_double(const Shape<float>& a, const Shape<float>& b, Reducer<float> reducer);

/// The same numbers; the rotation made unit to double's precision, so that a long lever keeps its
/// length. Shapes that belong_in_double only.
Shape<double> in_double(const Shape<float>& shape);
Pose<double> in_double(const Pose<float>& pose);
CollideOptions<double> in_double(const CollideOptions<float>& options);

/// Every number rounded once.
Manifold<float> in_float(const Manifold<double>& manifold);

}  // namespace contactscope
