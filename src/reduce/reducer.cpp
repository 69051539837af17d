#include "reduce/reducer.h"

#include "core/pack.h"
#include "reduce/area.h"
#include "reduce/area_deepest.h"
#include "reduce/box3d.h"
#include "reduce/box3d_mesh.h"
#include "reduce/bullet.h"
#include "reduce/coherent.h"
#include "reduce/deepest.h"
#include "reduce/distance.h"
#include "reduce/extremes.h"
#include "reduce/first.h"
#include "reduce/jolt.h"
#include "reduce/mjx.h"
#include "reduce/newton.h"
#include "reduce/ode.h"
#include "reduce/optimal.h"
#include "reduce/optimal_deepest.h"
#include "reduce/physx.h"
#include "reduce/physx_cluster.h"
#include "reduce/random.h"

namespace contactscope {
namespace {

template <class S>
struct Entry {
  const char* name;
  const char* summary;
  Reducer<S> reducer;  // nullptr keeps every point
  bool remembers = false;
};

/// Every reducer has one line here and a file of its own.
template <class S>
constexpr Entry<S> kReducers[] = {
    {"area", "a support point, the farthest, the largest triangle, the most area outside it",
     &reduce_by_area<S>},
    {"area_deepest", "as area, but the deepest first", &reduce_by_area_from_deepest<S>},
    {"distance", "as area, but the fourth is farthest from an edge", &reduce_by_distance<S>},
    {"extremes", "extremes along two axes of the plane", &reduce_to_extremes<S>},
    {"deepest", "the deepest", &reduce_to_deepest<S>},
    {"first", "the first, in the order of clipping", &reduce_to_first<S>},
    {"random", "any, by the seed", &reduce_at_random<S>},
    {"box3d", "far and deep, farthest, largest triangle, most area, near ties to the earlier",
     &reduce_like_box3d<S>},
    {"box3d_mesh", "the farthest pair, largest triangle, most area", &reduce_like_box3d_mesh<S>},
    {"jolt", "twice distance times depth, then both sides", &reduce_like_jolt<S>},
    {"bullet", "one by one, the deepest protected, largest area", &reduce_like_bullet<S>},
    {"ode", "the deepest, then every 90 degrees", &reduce_like_ode<S>},
    {"physx", "the deepest, farthest, then both sides", &reduce_like_physx<S>},
    {"physx_cluster", "the deepest of each of four clusters", &reduce_like_physx_cluster<S>},
    {"newton", "the diameter, then both sides", &reduce_like_newton<S>},
    {"mjx", "the first, farthest from it, from the line, from the edges", &reduce_like_mjx<S>},
    {"optimal", "the largest area", &reduce_to_optimal<S>},
    {"optimal_deepest", "the largest area of those with the deepest",
     &reduce_to_optimal_deepest<S>},
    {"coherent", "those of the last frame while deep and large enough, else nearly optimal",
     &reduce_coherently<S>, true},
    {"none", "keeps every point", nullptr},
};

template <class S>
bool all_finite(std::span<const ContactPoint<S>> points, const Vec3<S>& normal) {
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
Reduction reduce(Reducer<S> reducer, std::span<const ContactPoint<S>> points, const Vec3<S>& normal,
                 const ReduceOptions& options) {
  if (!all_finite(points, normal)) return {{}, ReduceStatus::NotFinite};
  if (reducer != nullptr && static_cast<int>(points.size()) > options.max_points) {
    return {reducer(points, normal, options), ReduceStatus::Reduced};
  }
  Reduction all;
  for (int i = 0; i < static_cast<int>(points.size()); ++i) all.kept.push_back(i);
  return all;
}

template <class S>
Reducer<S> find_reducer(std::string_view name) {
  for (const Entry<S>& entry : kReducers<S>) {
    if (name == entry.name) return entry.reducer;
  }
  return nullptr;
}

const std::vector<ReducerInfo>& reducers() {
  static const std::vector<ReducerInfo> infos = [] {
    std::vector<ReducerInfo> list;
    for (const Entry<double>& entry : kReducers<double>)
      list.push_back({entry.name, entry.summary, entry.remembers});
    return list;
  }();
  return infos;
}

template Reduction reduce(Reducer<float>, std::span<const ContactPoint<float>>, const Vec3<float>&,
                          const ReduceOptions&);
template Reduction reduce(Reducer<double>, std::span<const ContactPoint<double>>,
                          const Vec3<double>&, const ReduceOptions&);
template Reducer<float> find_reducer(std::string_view);
template Reducer<double> find_reducer(std::string_view);

}  // namespace contactscope
