#include "reduce/extremes.h"

#include "reduce/steps.h"

namespace contactscope {

/// Gregorius 2015, "Contact Point Reduction: AABB (1)" to "(3)". Steps: an orthonormal basis (u, v)
/// of the plane from the world axis that the normal leans on least; lowest and highest along u,
/// then along v. Points that are extreme along both count once.
template <class S>
KeptIndices reduce_to_extremes(std::span<const ContactPoint<S>> points, const Vec3<S>& normal,
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

template KeptIndices reduce_to_extremes(std::span<const ContactPoint<float>>, const Vec3<float>&,
                                        const ReduceOptions&);
template KeptIndices reduce_to_extremes(std::span<const ContactPoint<double>>, const Vec3<double>&,
                                        const ReduceOptions&);

}  // namespace contactscope
