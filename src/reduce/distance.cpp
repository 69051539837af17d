#include "reduce/distance.h"

#include "reduce/area.h"
#include "reduce/grow.h"

namespace contactscope {

/// Gregorius 2015, "Contact Point Reduction: 4th Point (5)". A distance from an edge is the signed
/// area over the length of the edge. The rest as in `area`.
template <class S>
KeptIndices reduce_by_distance(std::span<const ContactPoint<S>> points, const Vec3<S>& normal,
                               const ReduceOptions& options) {
  return steps::grow_from<steps::Added::Distance>(
      points, normal, steps::support_point(points, fixed_direction(normal)),
      steps::OnALine::ExchangeFirst, options.max_points);
}

template KeptIndices reduce_by_distance(std::span<const ContactPoint<float>>, const Vec3<float>&,
                                        const ReduceOptions&);
template KeptIndices reduce_by_distance(std::span<const ContactPoint<double>>, const Vec3<double>&,
                                        const ReduceOptions&);

}  // namespace contactscope
