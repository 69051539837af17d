#include "reduce/grow.h"

namespace contactscope {
namespace {

/// `area` with the deepest point as the first, which is therefore always kept. Gregorius 2015,
/// "Contact Point Reduction: 1st Point": with continuous collision "we want to start with the
/// deepest point and guarantee it is in our reduced contact set". Of points on one line come back
/// the deepest and the two extremes.
template <class S>
KeptIndices reduce_by_area_from_deepest(ContactPoints<S> points, const Vec3<S>& normal,
                                        const ReduceOptions& options) {
  if (options.choices != nullptr) [[unlikely]]
    options.choices->deepest();
  return steps::grow_from<steps::Added::Area>(points, normal, steps::deepest_point(points),
                                              steps::OnALine::KeepFirst, options);
}

}  // namespace

ReducerInfo area_deepest_reducer() {
  return {"area_deepest", "as area, but the deepest first", &reduce_by_area_from_deepest<float>,
          &reduce_by_area_from_deepest<double>};
}

}  // namespace contactscope
