#include "find/finder.h"

#include <algorithm>

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

}  // namespace

const Vocabulary& vocabulary() {
  static const Vocabulary known{
      {pair_quantities().begin(), pair_quantities().end()}, {"previous"}, {}};
  return known;
}

Finder::Finder(Expression expression) : expression_(std::move(expression)) {
  for (const Expression::Fact& fact : expression_.facts()) {
    wants_poses_ = wants_poses_ || fact.quantity == "motion" || fact.quantity == "turn";
    wants_ids_ = wants_ids_ || fact.quantity.starts_with("ids");
    wants_manifolds_ = wants_manifolds_ || fact.quantity == "axis" || fact.quantity == "type" ||
                       (fact.quantity.starts_with("normal_") && fact.quantity != "normal_turn");
  }
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
  if (!before_) return hits;
  for (const trace::Pair& pair : before_->frame.pairs)
    if (const std::string name = name_of(pair); !now_->pairs.contains(name))
      try_pair(absent(pair), &pair, contacts_[name], hits);
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

}  // namespace contactscope::find
