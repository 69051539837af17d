#include "lint/balance.h"

#include "trace/find.h"

namespace contactscope::lint {
namespace {

constexpr double kBalanced = 0.02;  // of the weight of a step: what rounding leaves
constexpr double kDamping = 1;      // per second; engines have less

Loads loads_of(const Solids& solids, const trace::Frame& frame) {
  Loads loads;
  const auto add = [&](Load& load, double sign, const Vec3d& normal, const trace::Point& point) {
    load.is_known = load.is_known && point.impulse;
    if (!point.impulse) return;
    const Vec3d& friction = point.impulse->friction;
    const Vec3d impulse = sign * (point.impulse->normal * normal + friction);
    const Vec3d& at = point.position;
    if (load.points.insert({at.x(), at.y(), at.z(), point.impulse->normal}).second)
      load.once += impulse;
    load.impulse += impulse;
  };
  for (const trace::Pair& pair : frame.pairs) {
    const std::string &a = solids.body_of(pair.a), &b = solids.body_of(pair.b);
    if (a == b) continue;  // two parts of one body
    for (const trace::Manifold& manifold : pair.manifolds)
      for (const trace::Point& point : manifold.points) {
        if (!point.active) continue;
        add(loads[a], -1, manifold.normal, point);
        add(loads[b], 1, manifold.normal, point);
      }
  }
  return loads;
}

}  // namespace

const Load* known_load(const Loads& loads, const std::string& body) {
  const auto found = loads.find(body);
  return found == loads.end() || !found->second.is_known ? nullptr : &found->second;
}

void Balance::see(const Solids& solids, const Moments& frames) {
  missing_.clear();
  const std::set<std::string> were_off = std::exchange(off_, {});
  before = std::move(now);
  now = frames.before == nullptr ? loads_of(solids, *frames.now) : std::move(after);
  if (frames.before == nullptr) before.clear();
  after = frames.after == nullptr ? Loads() : loads_of(solids, *frames.after);
  // The impulses lead from the velocities of one frame to those of the other.
  const trace::Frame* const other = frames.after_step ? frames.before : frames.after;
  if (!frames.now->solver || other == nullptr) return;
  const double step = other->time - frames.now->time;  // negative after the step
  const Vec3d fall = -kGravity * step * up_;           // the velocity that gravity adds
  for (const trace::Body& body : frames.now->solver->bodies) {
    const trace::Body* const then = trace::find_body(*other, body.name);
    if (then == nullptr || !(body.mass > 0) || !std::isfinite(body.mass)) continue;
    const auto load = now.find(body.name);
    const bool is_at_rest = body.velocity.isZero() && then->velocity.isZero();
    if (then->center_of_mass == body.center_of_mass || (is_at_rest && load == now.end()))
      continue;  // it sleeps
    if (load != now.end() && !load->second.is_known) continue;
    const double sign = step < 0 ? -1 : 1;
    const Vec3d change = then->velocity - body.velocity;
    Vec3d impulse = sign * body.mass * (change - fall);
    if (load != now.end()) impulse -= load->second.impulse;
    const double weight = body.mass * fall.norm();
    const double damped = body.mass * body.velocity.norm() * kDamping * std::abs(step);
    // Impacts are rounded, and split among the iterations of a solver.
    const bool is_impact = change.norm() > fall.norm();
    const double carried = load == now.end() ? 0 : load->second.impulse.norm();
    const double share = std::max(impulse.norm() - damped, 0.0) / (weight + carried);
    // If a point is there twice, the second one is the fault.
    const bool are_twice =
        load != now.end() && load->second.once != load->second.impulse &&
        (impulse + load->second.impulse - load->second.once).norm() <= kBalanced * weight + damped;
    missing_[body.name] = {impulse, is_impact || are_twice ? 0 : share,
                           were_off.contains(body.name)};
    if (share > Missing::kOff) off_.insert(body.name);
    if (load == now.end()) continue;
    ++count_, balanced_ += impulse.norm() <= kBalanced * weight + damped;
  }
}

const Balance::Missing* Balance::missing(const std::string& body) const {
  constexpr int kEnough = 20;
  constexpr double kNearlyAll = 0.7;
  const auto found = missing_.find(body);
  const bool is_known = count_ >= kEnough && balanced_ >= kNearlyAll * count_;
  return is_known && found != missing_.end() ? &found->second : nullptr;
}

}  // namespace contactscope::lint
