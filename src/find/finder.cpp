#include "find/finder.h"

#include "core/spell.h"
#include "trace/find.h"

namespace contactscope::find {
namespace {

std::string name_of(const trace::Pair& pair) { return pair.a + '\n' + pair.b + '\n' + pair.label; }

/// The pair in a frame in which it is not.
trace::Pair absent(const trace::Pair& pair) {
  trace::Pair none;
  none.a = pair.a;
  none.b = pair.b;
  none.label = pair.label;
  none.separation = kUnknown;
  return none;
}

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

const Vocabulary& vocabulary() {
  static const Vocabulary known{
      {pair_quantities().begin(), pair_quantities().end()}, {"previous"}, {"lint"}, lint::causes()};
  return known;
}

Finder::Finder(Expression expression) : expression_(std::move(expression)) {
  for (const Expression::Fact& fact : expression_.facts()) {
    wants_poses_ = wants_poses_ || fact.quantity == "motion" || fact.quantity == "turn";
    wants_ids_ = wants_ids_ || fact.quantity.starts_with("ids");
    wants_lint_ = wants_lint_ || fact.side == "lint";
    wants_manifolds_ = wants_manifolds_ || fact.quantity == "axis" || fact.quantity == "type" ||
                       (fact.quantity.starts_with("normal_") && fact.quantity != "normal_turn");
  }
}

std::vector<std::string> Finder::take(const std::vector<lint::Finding>& findings) {
  std::vector<std::string> below;
  for (const lint::Finding& finding : findings) {
    const bool is_wanted = std::ranges::any_of(expression_.facts(), [&](auto& fact) {
      return fact.side == "lint" && fact.quantity == finding.cause;
    });
    if (is_wanted && !finding.below.empty())
      below.push_back("lint." + finding.cause + " leaves out " + std::to_string(finding.count) +
                      " below the threshold of " + finding.below + "; --strict includes them");
    for (const lint::Mark& mark : finding.marks)
      if (lint::is_reported(finding) && !mark.a.empty())
        named_[mark.frame][std::minmax(mark.a, mark.b)].push_back(finding.cause);
  }
  return below;
}

double Finder::findings_about(const trace::Pair& pair, const std::string& cause) const {
  const auto frame = named_.find(now_->frame.frame);
  if (frame == named_.end()) return 0;
  double count = 0;
  for (const auto& [a, b] : {std::pair(pair.a, pair.b), {"", pair.a}, {"", pair.b}})
    if (const auto found = frame->second.find(std::minmax(a, b)); found != frame->second.end())
      count += cause.empty() ? double(found->second.size())
                             : double(std::ranges::count(found->second, cause));
  return count;
}

std::vector<Hit> Finder::next(trace::Frame frame) {
  before_ = std::move(now_);
  now_.emplace().frame = std::move(frame);
  ++place_;
  for (const auto& [name, pose] : now_->frame.poses)
    if (wants_poses_) now_->poses.emplace(name, &pose);
  std::vector<Hit> hits;
  for (const trace::Pair& pair : now_->frame.pairs) {
    const std::string name = name_of(pair);
    now_->pairs.emplace(name, &pair);
    Contact& contact = contacts_[name];
    if (!pair.manifolds.empty()) {
      const bool begins = contact.last < 0 || contact.last < place_ - 1;
      if (begins && contact.last >= 0) contact.away = place_ - 1 - contact.last;
      if (begins) contact.first = place_;
      contact.last = place_;
    }
    if (!before_) {
      try_pair(pair, nullptr, contact, hits);
    } else {
      const auto found = before_->pairs.find(name);
      const trace::Pair none = absent(pair);
      try_pair(pair, found == before_->pairs.end() ? &none : found->second, contact, hits);
    }
  }
  const auto try_absent = [&](const trace::Pair& pair, const trace::Pair* before) {
    const std::string name = name_of(pair);
    if (!now_->pairs.contains(name)) try_pair(absent(pair), before, contacts_[name], hits);
  };
  for (std::size_t i = 0; before_ && i < before_->frame.pairs.size(); ++i)
    try_absent(before_->frame.pairs[i], &before_->frame.pairs[i]);
  if (!named_.contains(now_->frame.frame)) return hits;
  Named rest = named_[now_->frame.frame];
  for (const Moment* moment : {&*now_, before_ ? &*before_ : nullptr})
    for (std::size_t i = 0; moment != nullptr && i < moment->frame.pairs.size(); ++i)
      rest.erase(std::minmax(moment->frame.pairs[i].a, moment->frame.pairs[i].b));
  for (const auto& [names, causes] : rest) {
    trace::Pair pair;
    pair.a = names.first, pair.b = names.second;
    const trace::Pair none = absent(pair);
    if (!pair.a.empty()) try_absent(pair, before_ ? &none : nullptr);
  }
  return hits;
}

void Finder::try_pair(const trace::Pair& now, const trace::Pair* before, const Contact& contact,
                      std::vector<Hit>& hits) const {
  PairMoment moment{&now, before, &now_->frame};
  const bool touches = contact.last == place_;
  if (touches) moment.age = place_ - contact.first;
  if (touches && contact.away >= 0) moment.away = contact.away;
  if (!touches && contact.last >= 0) moment.away = place_ - contact.last;
  for (std::size_t i = 0; i < 2 && wants_poses_ && before_; ++i) {
    const std::string& name = i == 0 ? now.a : now.b;
    const auto pose = now_->poses.find(name), old = before_->poses.find(name);
    if (pose != now_->poses.end()) moment.poses[i] = pose->second;
    if (old != before_->poses.end()) moment.poses_before[i] = old->second;
  }
  const auto look_up = [&](const std::string& side, const std::string& quantity) {
    if (side.empty()) return value_of(moment, quantity);
    if (side == "lint") return Value(findings_about(now, quantity));
    if (before == nullptr) return Value(kUnknown);
    PairMoment then{before, nullptr, &before_->frame};
    // The manifold whose normal is nearest.
    for (std::size_t m = 0; m < before->manifolds.size() && !now.manifolds.empty(); ++m) {
      const Vec3d& normal = now.manifolds[moment.manifold].normal;
      if (before->manifolds[m].normal.dot(normal) >
          before->manifolds[then.manifold].normal.dot(normal))
        then.manifold = m;
    }
    return value_of(then, quantity);
  };
  while (!expression_.holds(look_up))
    if (!wants_manifolds_ || ++moment.manifold >= now.manifolds.size()) return;
  Hit& hit =
      hits.emplace_back(Hit{now_->frame.frame, now_->frame.time, now.a, now.b, now.label, {}});
  for (const Expression::Fact& fact : expression_.facts())
    hit.values.push_back(look_up(fact.side, fact.quantity));
}

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
