#include "package/contactscope/reduce.h"

#include <stdexcept>

#include "core/at.h"
#include "package/facts.h"
#include "reduce/reducer.h"

namespace contactscope::package {
namespace {

template <class S>
std::vector<int> kept_in(const Manifold& manifold, const ReducerInfo* reducer,
                         const ReduceOptions& options) {
  std::vector<contactscope::ContactPoint<S>> points;
  for (const ContactPoint& point : manifold.points) {
    // Ids are opaque here. Reducers that use ids get no points of an earlier frame.
    const FeatureRef number = vertex_ref(Owner::A, count_of(points));
    points.push_back({to_inside(point.position).cast<S>(), static_cast<S>(point.separation),
                      FeatureId::of(number, number)});
  }
  contactscope::ReduceOptions inside;
  inside.max_points = options.max_points;
  inside.seed = options.seed;
  const contactscope::Vec3<S> normal = to_inside(manifold.normal).cast<S>();
  const KeptIndices kept =
      contactscope::reduce<S>(reducer, contactscope::ContactPoints<S>(points), normal, inside);
  return {kept.begin(), kept.end()};
}

}  // namespace

std::vector<Reducer> reducers() {
  return mapped(contactscope::reducers(), [](const ReducerInfo& info) {
    return Reducer{info.name, info.summary};
  });
}

std::vector<int> reduce(const Manifold& manifold, const std::string& reducer,
                        const ReduceOptions& options) {
  const ReducerInfo* const found = find_reducer(reducer);
  if (found == nullptr && reducer != "none")
    refuse("reducer", reducer, mapped(contactscope::reducers(), [](const ReducerInfo& info) {
             return std::string_view(info.name);
           }));
  if (options.max_points < 1) throw std::invalid_argument("max_points is less than 1");
  if (manifold.points.size() > kMaxManifoldPoints)
    throw std::invalid_argument("a manifold has at most " + std::to_string(kMaxManifoldPoints) +
                                " points, this one " + std::to_string(manifold.points.size()));
  if (options.scalar == Scalar::Float) return kept_in<float>(manifold, found, options);
  return kept_in<double>(manifold, found, options);
}

}  // namespace contactscope::package
