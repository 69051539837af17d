#include "reduce/steps.h"

namespace contactscope {
namespace {

/// The alternative of Gregorius 2015, "Contact Point Reduction: AABB (1)" to "(3)": the extreme
/// points along two axes in the contact plane. The axes follow the world's, so that the choice
/// changes when the same patch turns: a diamond on its corner loses two of four points when its
/// long diagonal lies at 45 degrees to them. Steps: an orthonormal basis (u, v) of the plane from
/// the world axis that the normal leans on least; lowest and highest along u, then along v. Points
/// that are extreme along both count once.
template <class S>
KeptIndices reduce_to_extremes(ContactPoints<S> points, const Vec3<S>& normal,
                               const ReduceOptions& options) {
  const Vec3<S> u = any_perpendicular(normal);
  const Vec3<S> v = normal.cross(u);
  KeptIndices choices;
  for (const Vec3<S>& axis : {u, v}) {
    steps::add_once(choices, steps::support_point(points, Vec3<S>(-axis)));
    steps::add_once(choices, steps::support_point(points, axis));
  }
  return steps::first_of(choices, options);
}

}  // namespace

ReducerInfo extremes_reducer() {
  return {"extremes", "extremes along two axes of the plane", &reduce_to_extremes<float>,
          &reduce_to_extremes<double>};
}

}  // namespace contactscope
