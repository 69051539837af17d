#include "find/pair_quantities.h"

#include <algorithm>

#include "core/at.h"
#include "trace/find.h"

namespace contactscope::find {
namespace {

std::string ids_of(const trace::Pair& pair) {
  std::string ids;
  for (const trace::Manifold& manifold : pair.manifolds)
    for (const trace::Point& point : manifold.points) ids += (ids.empty() ? "" : ", ") + point.id;
  return ids;
}

/// A text of the first manifold; empty without one.
template <std::string trace::Manifold::*kMember>
Value text_of(const trace::Pair& pair) {
  return pair.manifolds.empty() ? std::string() : pair.manifolds.front().*kMember;
}

template <int kAxis>
Value normal_of(const trace::Pair& pair) {
  return pair.manifolds.empty() ? kUnknown : pair.manifolds.front().normal[kAxis];
}

}  // namespace

double overlap_of(const trace::Pair& pair) {
  const trace::Point* const deepest = trace::deepest_point(pair);
  return deepest == nullptr ? 0 : std::max(0.0, -deepest->separation);
}

double impulse_of(const trace::Pair& pair) {
  double sum = 0;
  for (const trace::Manifold& manifold : pair.manifolds)
    for (const trace::Point& point : manifold.points)
      if (point.impulse) sum += point.impulse->normal;
  return sum;
}

int point_count(const trace::Pair& pair) {
  int count = 0;
  for (const trace::Manifold& manifold : pair.manifolds) count += count_of(manifold.points);
  return count;
}

const std::vector<PairQuantity>& pair_quantities() {
  using trace::Manifold;
  using trace::Pair;
  static const std::vector<PairQuantity> all = {
      {{"points", Unit::Count}, [](const Pair& pair) { return Value(double(point_count(pair))); }},
      {{"manifolds", Unit::Count},
       [](const Pair& pair) { return Value(double(pair.manifolds.size())); }},
      {{"separation", Unit::Metres}, [](const Pair& pair) { return Value(pair.separation); }},
      {{"overlap", Unit::Metres}, [](const Pair& pair) { return Value(overlap_of(pair)); }},
      {{"touching", Unit::Count},
       [](const Pair& pair) { return Value(double(pair.state == "touching")); }},
      {{"impulse", Unit::NewtonSeconds}, [](const Pair& pair) { return Value(impulse_of(pair)); }},
      {{"axis", Unit::Text}, &text_of<&Manifold::axis>},
      {{"type", Unit::Text}, &text_of<&Manifold::type>},
      {{"ids", Unit::Text}, [](const Pair& pair) { return Value(ids_of(pair)); }},
      {{"normal_x", Unit::Count}, &normal_of<0>},
      {{"normal_y", Unit::Count}, &normal_of<1>},
      {{"normal_z", Unit::Count}, &normal_of<2>}};
  return all;
}

}  // namespace contactscope::find
