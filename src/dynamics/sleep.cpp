#include "dynamics/sleep.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/at.h"
#include "core/instantiate.h"

namespace contactscope {

Islands::Islands(int bodies) : parents_(static_cast<std::size_t>(bodies)) {
  std::iota(parents_.begin(), parents_.end(), 0);
}

int Islands::of(int body) {
  while (at(parents_, body) != body) body = at(parents_, body) = at(parents_, at(parents_, body));
  return body;
}

void Islands::join(int a, int b) {
  const auto [lower, higher] = std::minmax({of(a), of(b)});
  at(parents_, higher) = lower;
}

template <class S>
Sleepers<S>::Sleepers(const std::vector<Body<S>>& bodies, const SolverSettings& settings) {
  if (!settings.sleep_after) return;
  after_ = *settings.sleep_after;
  speed_ = settled(settings, bodies).sleep_speed.value_or(0);
  asleep_.assign(bodies.size(), false);
  still_.assign(bodies.size(), 0);
}

template <class S>
Islands Sleepers<S>::join(const std::vector<Body<S>>& bodies,
                          std::span<const Touch> touches) const {
  Islands islands(count_of(bodies));
  for (const Touch& touch : touches)
    if (at(bodies, touch.a).dynamic() && at(bodies, touch.b).dynamic())
      islands.join(touch.a, touch.b);
  return islands;
}

template <class S> void Sleepers<S>::wake(int body) {
  if (!may_sleep()) return;
  at(asleep_, body) = false;
  at(still_, body) = 0;
}

template <class S>
bool Sleepers<S>::wake(const std::vector<Body<S>>& bodies, std::span<const Touch> touches) {
  if (std::ranges::none_of(asleep_, [](bool asleep) { return asleep; })) return false;
  Islands islands = join(bodies, touches);
  std::vector<bool> wakes(bodies.size());  // by island
  for (int i = 0; i < count_of(bodies); ++i)
    if (at(bodies, i).dynamic() && !asleep(i)) at(wakes, islands.of(i)) = true;
  const auto is_moved = [&](int i) {
    const Body<S>& body = at(bodies, i);
    return !body.dynamic() && !(body.velocity.isZero(S(0)) && body.angular_velocity.isZero(S(0)));
  };
  for (const Touch& touch : touches) {
    if (is_moved(touch.a)) at(wakes, islands.of(touch.b)) = true;
    if (is_moved(touch.b)) at(wakes, islands.of(touch.a)) = true;
  }
  bool any = false;
  for (int i = 0; i < count_of(bodies); ++i) {
    if (!asleep(i) || !at(wakes, islands.of(i))) continue;
    wake(i);
    any = true;
  }
  return any;
}

template <class S>
void Sleepers<S>::settle(std::vector<Body<S>>& bodies, std::span<const Touch> touches, double dt) {
  if (!may_sleep()) return;
  bool any = false;
  for (int i = 0; i < count_of(bodies); ++i) {
    const Body<S>& body = at(bodies, i);
    if (!body.dynamic() || asleep(i)) continue;
    at(still_, i) = mean_speed(body) <= speed_ ? at(still_, i) + dt : 0;
    any = any || rests(at(still_, i));
  }
  if (!any) return;
  Islands islands = join(bodies, touches);
  std::vector<double> least(still_);  // by island
  for (int i = 0; i < count_of(bodies); ++i)
    at(least, islands.of(i)) = std::min(at(least, islands.of(i)), at(still_, i));
  for (int i = 0; i < count_of(bodies); ++i) {
    Body<S>& body = at(bodies, i);
    if (!body.dynamic() || asleep(i) || !rests(at(least, islands.of(i)))) continue;
    at(asleep_, i) = true;
    body.velocity.setZero();
    body.angular_velocity.setZero();
  }
}

template <class S> double mean_speed(const Body<S>& body) {
  return std::sqrt(2 * kinetic_energy(body) / static_cast<double>(body.mass));
}

template <class S>
void solve_awake(std::vector<Body<S>>& bodies, std::span<const PairContacts<S>> pairs,
                 std::vector<PairImpulses<S>>& impulses, const Vec3<S>& gravity,
                 const SolverSettings& settings, S dt, const Sleepers<S>& sleepers) {
  const SolverSettings of_all = settled(settings, bodies);
  std::vector<int> awake;                     // bodies in the step
  std::vector<int> place(bodies.size(), -1);  // of each body in `awake`
  for (int i = 0; i < count_of(bodies); ++i) {
    if (sleepers.asleep(i)) continue;
    at(place, i) = count_of(awake);
    awake.push_back(i);
  }
  if (awake.size() == bodies.size())
    return solve_step<S>(bodies, pairs, impulses, gravity, of_all, dt);

  impulses.resize(pairs.size());
  std::vector<Body<S>> moving = mapped(awake, [&](int i) { return at(bodies, i); });
  std::vector<std::size_t> acting;
  std::vector<PairContacts<S>> contacts;
  std::vector<PairImpulses<S>> given;
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const PairContacts<S>& pair = pairs[p];
    // Sleeping bodies touch no awake dynamic body, else they would be awake too.
    if (at(place, pair.a) < 0 || at(place, pair.b) < 0) continue;
    acting.push_back(p);
    contacts.push_back(pair);
    contacts.back().a = at(place, pair.a);
    contacts.back().b = at(place, pair.b);
    given.push_back(std::move(impulses[p]));
  }
  solve_step<S>(moving, contacts, given, gravity, of_all, dt);
  for (std::size_t i = 0; i < acting.size(); ++i) impulses[acting[i]] = std::move(given[i]);
  for (std::size_t i = 0; i < awake.size(); ++i) at(bodies, awake[i]) = moving[i];
}

template class Sleepers<float>;
template class Sleepers<double>;
CONTACTSCOPE_FLOAT_AND_DOUBLE(mean_speed, solve_awake);

}  // namespace contactscope
