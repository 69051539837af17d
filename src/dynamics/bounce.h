#pragma once

#include "dynamics/solve_velocities.h"

/// Restitution: how fast bodies leave after they have met.
namespace contactscope {

/// Records how fast bodies move and points close, at the beginning of a sub-step.
template <class S>
void note_approach(std::span<SolverBody<S>> bodies, std::vector<ContactConstraint<S>>& contacts) {
  for (SolverBody<S>& body : bodies)
    body.velocity_began = body.body.velocity, body.spin_began = body.body.angular_velocity;
  for_each_point(bodies, contacts, [](const auto& pair, const auto& contact, auto& point) {
    point.approach = pair.velocity_at(point).dot(contact.normal);
  });
}

// Resting bodies meet at gravity's speed of one sub-step, up to the error of the sweeps: no bounce.
inline constexpr double kRestitutionThreshold = 2;  // times gravity times the sub-step

/// Velocity with which a point that came with `point.approach` leaves. Semi-implicit Euler follows
/// a parabola, with the velocity midway between those before and after gravity's share of the
/// sub-step. Restitution applies to that one, so an elastic ball keeps its energy. Separated points
/// travel the rest and back under gravity. `closing`: gravity's relative acceleration, m/s^2.
template <class S>
S leaving_velocity(const ConstraintPoint<S>& point, S restitution, S closing, S h) {
  const S half_step = S(0.5) * closing * h;
  const S middle = -point.approach - half_step;
  const S fall = 2 * closing * std::max(point.separation, S(0));
  const S met = std::max(middle * middle + fall, S(0));
  const S squared = std::clamp(restitution * restitution * met - fall, S(0), middle * middle);
  return std::sqrt(squared) - half_step;
}

/// The bodies after the sweeps, before they bounce, and the groups that impulses join.
template <class S> class StoppedBodies {
 public:
  explicit StoppedBodies(std::span<const SolverBody<S>> bodies) {
    for (const SolverBody<S>& body : bodies) bodies_.push_back(body.body);
    groups_.resize(bodies.size());
    std::iota(groups_.begin(), groups_.end(), 0);
  }
  const Body<S>& operator[](int body) const { return at(bodies_, body); }

  /// Static and scripted bodies join nothing.
  void join(int a, int b) {
    if (at(bodies_, a).dynamic() && at(bodies_, b).dynamic()) at(groups_, group(a)) = group(b);
  }
  int group(int body) const {
    while (at(groups_, body) != body) body = at(groups_, body);
    return body;
  }

 private:
  std::vector<Body<S>> bodies_;
  std::vector<int> groups_;  // another body of the group, or this one
};

/// Kinetic energies of the bodies of a group, joules.
struct BounceEnergy {
  double began = 0, stopped = 0, bounced = 0;
  double of_change = 0;  // at the differences between the last two velocities

  /// Share of the bounce that adds no energy to that of the beginning. If the stop itself has more
  /// energy, because it pushes overlaps out, the bounce is kept whole or given up.
  double share(double epsilon) const {
    const double lost = began - stopped;
    if (lost < 0) return bounced > 1.001 * began ? 0 : 1;
    if (!(bounced > began * (1 + 64 * epsilon))) return 1;
    const double linear = bounced - stopped - of_change;
    // The root of of_change t^2 + linear t = lost.
    return 2 * lost / (linear + std::sqrt(linear * linear + 4 * of_change * lost));
  }
};

/// Takes back the part of each bounce that adds energy. Friction turns some of a body's sliding
/// into approach, and restitution returns that as well: Newton's law with friction can gain energy
/// (Kane and Levinson 1985, "Dynamics: Theory and Applications", 5.8).
template <class S>
void limit_bounces(std::span<SolverBody<S>> bodies, std::vector<ContactConstraint<S>>& contacts,
                   const StoppedBodies<S>& stopped) {
  const auto energy = [](Body<S> body, const Vec3<S>& velocity, const Vec3<S>& spin) {
    body.velocity = velocity;
    body.angular_velocity = spin;
    return kinetic_energy(body);
  };
  std::vector<BounceEnergy> energies(bodies.size());
  for (int i = 0; i < count_of(bodies); ++i) {
    const SolverBody<S>& moving = at(bodies, i);
    if (!moving.stirred || !moving.body.dynamic()) continue;
    const Body<S>& body = moving.body;
    const Body<S>& before = stopped[i];
    BounceEnergy& sum = at(energies, stopped.group(i));
    sum.began += energy(body, moving.velocity_began, moving.spin_began);
    sum.stopped += kinetic_energy(before);
    sum.bounced += kinetic_energy(body);
    sum.of_change += energy(body, body.velocity - before.velocity,
                            body.angular_velocity - before.angular_velocity);
  }
  const auto share_of = [&](int i) {
    return static_cast<S>(at(energies, stopped.group(i)).share(std::numeric_limits<S>::epsilon()));
  };
  for (int i = 0; i < count_of(bodies); ++i) {
    Body<S>& body = at(bodies, i).body;
    const S share = share_of(i);
    if (share == 1) continue;
    body.velocity = stopped[i].velocity + share * (body.velocity - stopped[i].velocity);
    body.angular_velocity =
        stopped[i].angular_velocity + share * (body.angular_velocity - stopped[i].angular_velocity);
  }
  for (ContactConstraint<S>& contact : contacts) {
    const S share = share_of(at(bodies, contact.a).body.dynamic() ? contact.a : contact.b);
    if (share == 1) continue;
    for (ConstraintPoint<S>& point : contact.points) {
      point.normal_impulse =
          point.stopped_impulse + share * (point.normal_impulse - point.stopped_impulse);
      if (share == 0) point.bounce = 0;  // it relaxes like points that do not bounce
    }
  }
}

/// Adds bounces (Newton's restitution) after the sweeps of a sub-step, before the bodies move.
/// Points bounce if they closed faster than resting bodies do, and pushed. As many sweeps again, of
/// normal impulses only, solve them and all that they stir. So they keep angular momentum.
///
/// The first sweeps add no energy; without friction these return at most what the stop of the
/// normal velocities took. This requires that a stirred point that was opening before may close as
/// fast, as all points of a blow are reflected alike (Moreau 1988, "Unilateral Contact and Dry
/// Friction in Finite Freedom Dynamics"): held at zero, the far end of a spinning rod would gain a
/// third. A later sub-step meets it. With friction, limit_bounces() takes back what they add.
///
/// `gravity` in m/s^2, `h`: sub-step in seconds.
template <class S>
void bounce(std::span<SolverBody<S>> bodies, std::vector<ContactConstraint<S>>& contacts,
            const SolverSettings& settings, const Vec3<S>& gravity, S h) {
  const S threshold = static_cast<S>(kRestitutionThreshold) * gravity.norm() * h;
  bool any = false;
  for_each_point(bodies, contacts, [&](const auto& pair, const auto& contact, auto& point) {
    if (contact.restitution == 0 || !(point.approach < -threshold) || point.normal_impulse == 0)
      return;
    const S closing =
        (static_cast<S>(pair.a.body.dynamic()) - static_cast<S>(pair.b.body.dynamic())) *
        gravity.dot(contact.normal);
    point.bounce = std::max(leaving_velocity(point, contact.restitution, closing, h), S(0));
    if (point.bounce > 0) any = pair.a.stirred = pair.b.stirred = true;
  });
  if (!any) return;
  StoppedBodies<S> stopped(bodies);
  for_each_point(bodies, contacts, [](const auto&, const auto&, auto& point) {
    point.stopped_impulse = point.normal_impulse;
  });
  for (int i = 0; i < settings.iterations; ++i) {
    for (ContactConstraint<S>& contact : contacts) {
      const BodyPair<S> pair(bodies, contact);
      const bool against_static = !(pair.a.body.dynamic() && pair.b.body.dynamic());
      if (!(pair.a.body.dynamic() && pair.a.stirred) && !(pair.b.body.dynamic() && pair.b.stirred))
        continue;
      for (ConstraintPoint<S>& point : contact.points) {
        if (point.bounce == 0 && point.approach > 0) point.bounce = -point.approach;
        // Not from the spring: bodies would keep the velocity of its push.
        const bool push = settings.position_correction != PositionCorrection::Soft;
        PositionBias<S> bias = position_bias(point, push, against_static, settings, h);
        if (point.bounce > 0) bias = {-point.bounce};
        if (point.bounce < 0) bias = {std::max(bias.velocity, -point.bounce)};
        const S before = point.normal_impulse;
        solve_normal(pair, contact.normal, bias, point);
        if (point.normal_impulse == before) continue;
        pair.a.stirred = pair.b.stirred = true;
        stopped.join(contact.a, contact.b);
      }
    }
  }
  limit_bounces(bodies, contacts, stopped);
  for (SolverBody<S>& body : bodies) body.stirred = false;
}

/// Ends bounces after the bodies have moved: their impulses do not warm the next sub-step.
template <class S>
void end_bounces(std::span<SolverBody<S>> bodies, std::vector<ContactConstraint<S>>& contacts) {
  for_each_point(bodies, contacts, [](const auto&, const auto&, auto& point) {
    if (point.bounce > 0) point.normal_impulse = point.friction_u = point.friction_v = 0;
    point.bounce = 0;
  });
}

}  // namespace contactscope
