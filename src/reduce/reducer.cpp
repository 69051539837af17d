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

}  // namespace

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

template Reducer<float> find_reducer(std::string_view);
template Reducer<double> find_reducer(std::string_view);

}  // namespace contactscope
