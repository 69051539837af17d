#include "reduce/reducer.h"

#include <type_traits>

#include "core/at.h"
#include "core/pack.h"

namespace contactscope {

// Each is in the file of its name.
ReducerInfo area_reducer(), area_deepest_reducer(), distance_reducer(), extremes_reducer(),
    deepest_reducer(), first_reducer(), random_reducer(), box3d_reducer(), box3d_mesh_reducer(),
    jolt_reducer(), bullet_reducer(), ode_reducer(), physx_reducer(), physx_cluster_reducer(),
    newton_reducer(), mjx_reducer(), optimal_reducer(), optimal_deepest_reducer(),
    coherent_reducer();

const std::vector<ReducerInfo>& reducers() {
  static const std::vector<ReducerInfo> all = {
      area_reducer(),       area_deepest_reducer(),
      distance_reducer(),   extremes_reducer(),
      deepest_reducer(),    first_reducer(),
      random_reducer(),     box3d_reducer(),
      box3d_mesh_reducer(), jolt_reducer(),
      bullet_reducer(),     ode_reducer(),
      physx_reducer(),      physx_cluster_reducer(),
      newton_reducer(),     mjx_reducer(),
      optimal_reducer(),    optimal_deepest_reducer(),
      coherent_reducer(),   {"none", "keeps every point", nullptr, nullptr}};
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

#define CONTACTSCOPE_INSTANTIATE(S)                                                              \
  template Reduction reduce(Reducer<S>, ContactPoints<S>, const Vec3<S>&, const ReduceOptions&); \
  template Reducer<S> find_reducer(std::string_view);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
