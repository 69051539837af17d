#include "find/finder.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "find/pair_quantities.h"
#include "trace/find.h"

namespace contactscope::find {
namespace {

constexpr const char* kPrevious = "previous";

/// Degrees; zero for equal directions, which acos would miss by rounding.
double angle_between(const Vec3d& one, const Vec3d& other) {
  return std::atan2(one.cross(other).norm(), one.dot(other)) * 180 / std::numbers::pi;
}

/// Largest turn of a normal, each from the nearest one in the frame before. Unknown without a
/// contact in both.
double normal_turn(const trace::Pair& before, const trace::Pair& now) {
  if (before.manifolds.empty() || now.manifolds.empty()) return kUnknown;
  double most = 0;
  for (const trace::Manifold& manifold : now.manifolds) {
    double least = 180;
    for (const trace::Manifold& old : before.manifolds)
      least = std::min(least, angle_between(old.normal, manifold.normal));
    most = std::max(most, least);
  }
  return most;
}

/// Ids of one pair that the other does not have.
double ids_only_in(const trace::Pair& one, const trace::Pair& other) {
  const std::multiset<std::string> ids = trace::point_ids(one), others = trace::point_ids(other);
  std::vector<std::string> only;
  std::ranges::set_difference(ids, others, std::back_inserter(only));
  return double(only.size());
}

}  // namespace

/// A pair in the frame and in the one before; null where it is not there.
struct Finder::Tried {
  const std::string& a;
  const std::string& b;
  const std::string& label;
  const trace::Pair* now;
  const trace::Pair* before;
  const Contact& contact;
};

const Vocabulary& vocabulary() {
  static const Vocabulary known = [] {
    Vocabulary all{{}, {kPrevious}, {}};
    for (const Quantity& quantity : pair_quantities()) all.quantities.push_back(quantity);
    constexpr bool kChange = true;
    for (const Quantity& quantity : {Quantity{"frame", Unit::Count},
                                     {"time", Unit::Seconds},
                                     {"a", Unit::Text},
                                     {"b", Unit::Text},
                                     {"label", Unit::Text},
                                     {"normal_turn", Unit::Degrees, kChange},
                                     {"overlap_change", Unit::Metres, kChange},
                                     {"impulse_change", Unit::NewtonSeconds, kChange},
                                     {"points_gained", Unit::Count, kChange},
                                     {"points_lost", Unit::Count, kChange},
                                     {"ids_gained", Unit::Count, kChange},
                                     {"ids_lost", Unit::Count, kChange},
                                     {"motion", Unit::Metres, kChange},
                                     {"turn", Unit::Degrees, kChange},
                                     {"age", Unit::Count, kChange},
                                     {"away", Unit::Count, kChange}})
      all.quantities.push_back(quantity);
    return all;
  }();
  return known;
}

Finder::Finder(Expression expression) : expression_(std::move(expression)) {
  wants_poses_ = std::ranges::any_of(expression_.facts(), [](const Expression::Fact& fact) {
    return fact.quantity == "motion" || fact.quantity == "turn";
  });
}

trace::Parts Finder::parts() const {
  return {.poses = wants_poses_, .stages = false};
}

Finder::Key Finder::key_of(const trace::Pair& pair) {
  return pair.a + '\n' + pair.b + '\n' + pair.label;
}

std::vector<Hit> Finder::next(trace::Frame frame) {
  before_ = std::move(now_);
  now_.emplace(Moment{std::move(frame)});
  ++place_;
  if (wants_poses_)
    for (const auto& [name, pose] : now_->frame.poses) now_->poses.emplace(name, &pose);

  std::vector<Hit> hits;
  const auto try_one = [&](const trace::Pair& named, const trace::Pair* now,
                           const trace::Pair* before, const Contact& contact) {
    const Tried tried{named.a, named.b, named.label, now, before, contact};
    const auto look_up = [&](const std::string& side, const std::string& quantity) {
      return value(tried, side, quantity);
    };
    if (!expression_.holds(look_up)) return;
    Hit& hit = hits.emplace_back(
        Hit{now_->frame.frame, now_->frame.time, named.a, named.b, named.label, {}});
    for (const Expression::Fact& fact : expression_.facts())
      hit.values.push_back(look_up(fact.side, fact.quantity));
  };
  const auto before_of = [&](const Key& key) -> const trace::Pair* {
    if (!before_) return nullptr;
    const auto found = before_->pairs.find(key);
    return found == before_->pairs.end() ? nullptr : found->second;
  };
  for (const trace::Pair& pair : now_->frame.pairs) {
    const Key key = key_of(pair);
    now_->pairs.emplace(key, &pair);
    Contact& contact = contacts_[key];
    if (!pair.manifolds.empty()) {
      if (contact.last >= 0 && contact.last < place_ - 1) contact.away = place_ - 1 - contact.last;
      if (contact.last < 0 || contact.last < place_ - 1) contact.first = place_;
      contact.last = place_;
    }
    try_one(pair, &pair, before_of(key), contact);
  }
  if (!before_) return hits;
  for (const trace::Pair& pair : before_->frame.pairs) {
    const Key key = key_of(pair);
    if (!now_->pairs.contains(key)) try_one(pair, nullptr, &pair, contacts_[key]);
  }
  return hits;
}

Value Finder::value(const Tried& tried, const std::string& side,
                    const std::string& quantity) const {
  const bool is_previous = !side.empty();
  if (is_previous && !before_) return kUnknown;
  if (quantity == "a") return tried.a;
  if (quantity == "b") return tried.b;
  if (quantity == "label") return tried.label;
  const trace::Frame& frame = is_previous ? before_->frame : now_->frame;
  if (quantity == "frame") return double(frame.frame);
  if (quantity == "time") return frame.time;
  const trace::Pair* const pair = is_previous ? tried.before : tried.now;
  static const trace::Pair kAbsent = [] {
    trace::Pair absent;
    absent.separation = kUnknown;
    return absent;
  }();
  const auto& known = pair_quantities();
  const auto found = std::ranges::find(known, quantity, &PairQuantity::name);
  if (found != known.end()) return found->of(pair != nullptr ? *pair : kAbsent);
  if (quantity == "age")
    return tried.contact.last == place_ ? double(place_ - tried.contact.first) : kUnknown;
  if (quantity == "away")
    return tried.contact.last == place_
               ? tried.contact.away < 0 ? kUnknown : double(tried.contact.away)
           : tried.contact.last < 0 ? kUnknown
                                    : double(place_ - tried.contact.last);
  if (!before_) return kUnknown;
  static const trace::Pair kNone;
  Tried both = tried;
  if (both.now == nullptr) both.now = &kNone;
  if (both.before == nullptr) both.before = &kNone;
  return change(both, quantity);
}

Value Finder::change(const Tried& tried, const std::string& quantity) const {
  const trace::Pair &now = *tried.now, &before = *tried.before;
  if (quantity == "normal_turn") return normal_turn(before, now);
  if (quantity == "overlap_change") return overlap_of(now) - overlap_of(before);
  if (quantity == "impulse_change") return impulse_of(now) - impulse_of(before);
  const int gained = point_count(now) - point_count(before);
  if (quantity == "points_gained") return double(std::max(0, gained));
  if (quantity == "points_lost") return double(std::max(0, -gained));
  if (quantity == "ids_gained") return ids_only_in(now, before);
  if (quantity == "ids_lost") return ids_only_in(before, now);
  double most = kUnknown;  // of the two shapes
  for (const std::string* name : {&tried.a, &tried.b}) {
    const auto old = before_->poses.find(*name), placed = now_->poses.find(*name);
    if (old == before_->poses.end() || placed == now_->poses.end()) continue;
    const Pose<double>&from = *old->second, &to = *placed->second;
    const Quatd rotation = to.rotation * from.rotation.conjugate();
    most = std::fmax(most, quantity == "motion"
                               ? (to.position - from.position).norm()
                               : 2 * std::atan2(rotation.vec().norm(), std::abs(rotation.w())) *
                                     180 / std::numbers::pi);
  }
  return most;
}

}  // namespace contactscope::find
