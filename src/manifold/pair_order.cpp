#include "manifold/pair_order.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "manifold/recorder.h"
#include "trace/pair.h"

namespace contactscope {

std::string pair_kind(ShapeKind a, ShapeKind b) {
  return std::string(to_string(a)) + "-" + to_string(b);
}

void begin_record(ShapeKind a, ShapeKind b, bool traded, trace::Pair& record) {
  if (traded) std::swap(record.a, record.b);
  record.kind = pair_kind(a, b);
  record.state = "separated";
}

template <class S>
void record_manifolds(std::span<const Manifold<S>> manifolds, trace::Pair& record, bool traded) {
  record.state = manifolds.empty() ? "separated" : "touching";
  if (!manifolds.empty()) record.separation = std::numeric_limits<double>::infinity();
  for (const Manifold<S>& manifold : manifolds) {
    trace::Manifold& told = record.manifolds.emplace_back();
    told.normal = manifold.normal.template cast<double>();
    told.axis = to_string(manifold.axis);
    told.type = to_string(manifold.type);
    if (manifold.triangle >= 0) told.triangle = manifold.triangle;
    told.points.reserve(manifold.points.size());
    for (const ContactPoint<S>& point : manifold.points) {
      told.points.push_back(trace_point(point));
      // Of several manifolds, a mesh's, the deepest point stands for the pair.
      record.separation = std::min(record.separation, told.points.back().separation);
    }
  }
  if (traded) trace::mirror(record);
}

template <class S>
FlippedOptions<S>::FlippedOptions(const CollideOptions<S>& given) : options(given) {
  for (const FeatureId& id : given.reduction.previous) previous.push_back(id.flipped());
  options.reduction.previous = previous;
}

#define CONTACTSCOPE_INSTANTIATE(S)  \
  template struct FlippedOptions<S>; \
  template void record_manifolds(std::span<const Manifold<S>>, trace::Pair&, bool);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
