#include "reduce/reducer.h"

#include "reduce/steps.h"

namespace contactscope {

// The reducers of each file: the talk's, those without geometry, engines', the optimal ones.
std::vector<ReducerInfo> area_reducers(), extremes_reducers(), simple_reducers(), engine_reducers(),
    optimal_reducers(), coherent_reducers();

const std::vector<ReducerInfo>& reducers() {
  static const std::vector<ReducerInfo> all = [] {
    std::vector<ReducerInfo> listed;
    for (const auto family : {&area_reducers, &extremes_reducers, &simple_reducers,
                              &engine_reducers, &optimal_reducers, &coherent_reducers})
      std::ranges::copy(family(), std::back_inserter(listed));
    listed.push_back({"none", "keeps every point", nullptr, nullptr});
    return listed;
  }();
  return all;
}

const ReducerInfo* find_reducer(std::string_view name) {
  const auto found = std::ranges::find(reducers(), name, &ReducerInfo::name);
  return found == reducers().end() || found->in_float == nullptr ? nullptr : &*found;
}

template <class S>
KeptIndices reduce(const ReducerInfo* reducer, ContactPoints<S> points, const Vec3<S>& normal,
                   const ReduceOptions& options) {
  if (!all_finite(points, normal)) return {};
  if (reducer == nullptr || count_of(points) <= options.max_points)
    return steps::numbers_up_to(count_of(points));
  if constexpr (std::is_same_v<S, float>) return reducer->in_float(points, normal, options);
  if constexpr (std::is_same_v<S, double>) return reducer->in_double(points, normal, options);
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(reduce);

}  // namespace contactscope
