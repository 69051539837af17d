#include "reduce/reducer.h"

#include <algorithm>
#include <iterator>
#include <type_traits>

#include "core/at.h"
#include "core/pack.h"

namespace contactscope {

// The reducers of a file: the talk's, those that look at no geometry, engines' ways, the optimal ones.
std::vector<ReducerInfo> area_reducers(), extremes_reducers(), simple_reducers(), engine_reducers(),
    optimal_reducers(), coherent_reducers();

const std::vector<ReducerInfo>& reducers() {
  static const std::vector<ReducerInfo> all = [] {
    std::vector<ReducerInfo> listed;
    for (const auto family : {&area_reducers, &extremes_reducers, &simple_reducers,
                              &engine_reducers, &optimal_reducers, &coherent_reducers}) {
      std::ranges::copy(family(), std::back_inserter(listed));
    }
    listed.push_back({"none", "keeps every point", nullptr, nullptr});
    return listed;
  }();
  return all;
}

template <class S>
Reducer<S> find_reducer(std::string_view name) {
  for (const ReducerInfo& info : reducers()) {
    if (name != info.name) continue;
    if constexpr (std::is_same_v<S, float>) return info.in_float;
    if constexpr (std::is_same_v<S, double>) return info.in_double;
  }
  return nullptr;
}

namespace {

template <class S>
bool all_finite(ContactPoints<S> points, const Vec3<S>& normal) {
  // Zero times anything finite is zero, times anything else is not.
  const S zero = S(0);
  lanes::Pack<S> sum = {};
  for (const ContactPoint<S>& point : points) {
    for (int i = 0; i < 4; i += lanes::kWidth<S>) sum += zero * lanes::load(point, i);
  }
  S total = zero * normal.x() + zero * normal.y() + zero * normal.z();
  for (int lane = 0; lane < lanes::kWidth<S>; ++lane) total += sum[lane];
  return total == zero;
}

}  // namespace

template <class S>
Reduction reduce(Reducer<S> reducer, ContactPoints<S> points, const Vec3<S>& normal,
                 const ReduceOptions& options) {
  if (!all_finite(points, normal)) return {{}, ReduceStatus::NotFinite};
  if (reducer != nullptr && count_of(points) > options.max_points) {
    return {reducer(points, normal, options), ReduceStatus::Reduced};
  }
  Reduction all;
  for (int i = 0; i < count_of(points); ++i) all.kept.push_back(i);
  return all;
}

template decltype(reduce<float>) reduce<float>;
template decltype(reduce<double>) reduce<double>;
template decltype(find_reducer<float>) find_reducer<float>;
template decltype(find_reducer<double>) find_reducer<double>;

}  // namespace contactscope
