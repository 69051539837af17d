#include "reduce/reducer.h"

#include "reduce/area.h"

namespace contactscope {
namespace {

template <class S>
struct Entry {
  const char* name;
  const char* summary;
  Reducer<S> reducer;  // nullptr keeps every point
};

/// Every reducer has one line here and a file of its own.
template <class S>
constexpr Entry<S> kReducers[] = {
    {"area", "a support point, the farthest, the largest triangle, the most area outside it",
     &reduce_by_area<S>},
    {"none", "keeps every point", nullptr},
};

template <class S>
bool all_finite(std::span<const ContactPoint<S>> points, const Vec3<S>& normal) {
  // Zero times anything finite is zero, times anything else is not.
  S zeros = (S(0) * normal).sum();
  for (const ContactPoint<S>& point : points) {
    zeros += (S(0) * point.position).sum() + S(0) * point.separation;
  }
  return zeros == S(0);
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
      list.push_back({entry.name, entry.summary});
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
