#include "find/finder.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "core/at.h"
#include "core/spell.h"
#include "trace/find.h"

namespace contactscope::find {
namespace {

using trace::impulse_of;
using trace::Manifold;
using trace::overlap_of;
using trace::Pair;
using M = PairMoment;

double points_of(const Pair& pair) {
  return double(joined(pair.manifolds, &Manifold::points).size());
}

double manifolds_of(const Pair& pair) { return double(pair.manifolds.size()); }

double touching(const Pair& pair) { return double(pair.state == "touching"); }

template <auto kOf> Value of_now(const M& m) { return kOf(*m.now); }
template <auto kOf, bool kGain = false> Value change_of(const M& m) {
  const double change = kOf(*m.now) - kOf(*m.before);
  return kGain ? std::max(0.0, change) : change;
}
Value loss_of_points(const M& m) { return std::max(0.0, points_of(*m.before) - points_of(*m.now)); }

std::string ids_of(const Pair& pair) {
  const auto id_of = [](const trace::Point& point) { return point.id; };
  return separated(joined(pair.manifolds, &Manifold::points), ", ", id_of);
}

/// A text of the manifold; empty without one.
template <std::string Manifold::*kMember> Value text_of(const M& m) {
  return m.now->manifolds.empty() ? std::string() : m.now->manifolds[m.manifold].*kMember;
}

template <int kAxis> Value normal_of(const M& m) {
  return m.now->manifolds.empty() ? kUnknown : m.now->manifolds[m.manifold].normal[kAxis];
}

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

/// Largest turn of a normal, each from the nearest one in the frame before. Unknown without a
/// contact in both.
Value normal_turn(const M& m) {
  if (m.before->manifolds.empty() || m.now->manifolds.empty()) return kUnknown;
  double most = 0;
  for (const Manifold& now : m.now->manifolds) {
    double least = std::numbers::pi;
    for (const Manifold& old : m.before->manifolds)
      least = std::min(least,
                       std::atan2(old.normal.cross(now.normal).norm(), old.normal.dot(now.normal)));
    most = std::max(most, least);
  }
  return degrees(most);
}

/// Number of ids of one pair that the other does not have.
Value ids_only_in(const Pair& one, const Pair& other) {
  const std::multiset<std::string> ids = trace::point_ids(one), others = trace::point_ids(other);
  std::vector<std::string> only;
  std::ranges::set_difference(ids, others, std::back_inserter(only));
  return double(only.size());
}

double motion_between(const Pose<double>& from, const Pose<double>& to) {
  return (to.position - from.position).norm();
}
double turn_between(const Pose<double>& from, const Pose<double>& to) {
  const Quatd turn = to.rotation * from.rotation.conjugate();
  return degrees(2 * std::atan2(turn.vec().norm(), std::abs(turn.w())));
}

/// The larger change of the two shapes.
template <auto kChange> Value of_poses(const M& m) {
  double most = kUnknown;
  for (std::size_t i : {0u, 1u})
    if (m.poses[i] && m.poses_before[i])
      most = std::fmax(most, kChange(*m.poses_before[i], *m.poses[i]));
  return most;
}

}  // namespace

const std::vector<PairQuantity>& pair_quantities() {
  constexpr bool kChange = true;
  static const std::vector<PairQuantity> all = {
      {{"points", Unit::Count}, &of_now<points_of>},
      {{"manifolds", Unit::Count}, &of_now<manifolds_of>},
      {{"separation", Unit::Metres}, [](const M& m) -> Value { return m.now->separation; }},
      {{"overlap", Unit::Metres}, &of_now<overlap_of>},
      {{"touching", Unit::Count}, &of_now<touching>},
      {{"impulse", Unit::NewtonSeconds}, &of_now<impulse_of>},
      {{"axis", Unit::Text}, &text_of<&Manifold::axis>},
      {{"type", Unit::Text}, &text_of<&Manifold::type>},
      {{"ids", Unit::Text}, [](const M& m) -> Value { return ids_of(*m.now); }},
      {{"normal_x", Unit::Count}, &normal_of<0>},
      {{"normal_y", Unit::Count}, &normal_of<1>},
      {{"normal_z", Unit::Count}, &normal_of<2>},
      {{"frame", Unit::Count}, [](const M& m) -> Value { return double(m.frame->frame); }},
      {{"time", Unit::Seconds}, [](const M& m) -> Value { return m.frame->time; }},
      {{"a", Unit::Text}, [](const M& m) -> Value { return m.now->a; }},
      {{"b", Unit::Text}, [](const M& m) -> Value { return m.now->b; }},
      {{"label", Unit::Text}, [](const M& m) -> Value { return m.now->label; }},
      {{"age", Unit::Count}, [](const M& m) -> Value { return m.age; }},
      {{"away", Unit::Count}, [](const M& m) -> Value { return m.away; }},
      {{"normal_turn", Unit::Degrees, kChange}, &normal_turn},
      {{"overlap_change", Unit::Metres, kChange}, &change_of<overlap_of>},
      {{"impulse_change", Unit::NewtonSeconds, kChange}, &change_of<impulse_of>},
      {{"points_gained", Unit::Count, kChange}, &change_of<points_of, true>},
      {{"points_lost", Unit::Count, kChange}, &loss_of_points},
      {{"ids_gained", Unit::Count, kChange},
       [](const M& m) { return ids_only_in(*m.now, *m.before); }},
      {{"ids_lost", Unit::Count, kChange},
       [](const M& m) { return ids_only_in(*m.before, *m.now); }},
      {{"motion", Unit::Metres, kChange}, &of_poses<motion_between>},
      {{"turn", Unit::Degrees, kChange}, &of_poses<turn_between>}};
  return all;
}

Value value_of(const PairMoment& moment, const std::string& quantity) {
  const auto found = std::ranges::find(pair_quantities(), quantity, &PairQuantity::name);
  return found->is_change && moment.before == nullptr ? kUnknown : found->of(moment);
}

}  // namespace contactscope::find
