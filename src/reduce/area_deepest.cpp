#include "reduce/area_deepest.h"

#include "reduce/grow.h"

namespace contactscope {

/// Gregorius 2015, "Contact Point Reduction: 1st Point": with continuous collision "we want to
/// start with the deepest point and guarantee it is in our reduced contact set". The rest as in
/// `area`.
template <class S>
KeptIndices reduce_by_area_from_deepest(std::span<const ContactPoint<S>> points,
                                        const Vec3<S>& normal, const ReduceOptions& options) {
  return steps::grow_from<steps::Added::Area>(points, normal, steps::deepest_point(points),
                                              steps::OnALine::KeepFirst, options.max_points);
}

template KeptIndices reduce_by_area_from_deepest(std::span<const ContactPoint<float>>,
                                                 const Vec3<float>&, const ReduceOptions&);
template KeptIndices reduce_by_area_from_deepest(std::span<const ContactPoint<double>>,
                                                 const Vec3<double>&, const ReduceOptions&);

}  // namespace contactscope
