# The solver.
planted_bug(restitution_from_one_metre_a_second FILE src/dynamics/bounce.h TESTS dynamics
  WAS [[const S threshold = static_cast<S>(kRestitutionThreshold) * gravity.norm() * h;]]
  IS [[const S threshold = @BUG@ ? S(1) : static_cast<S>(kRestitutionThreshold) * gravity.norm() * h;]])
planted_bug(friction_twice_as_much FILE src/dynamics/solve_velocities.h TESTS dynamics
  WAS [[const S most = contact.friction * point.normal_impulse;]]
  IS [[const S most = (@BUG@ ? S(2) : S(1)) * contact.friction * point.normal_impulse;]])
planted_bug(slop_pushed_out FILE src/dynamics/solve_velocities.h TESTS dynamics
  WAS [[return static_cast<S>(settings.baumgarte) / h * overlap;]]
  IS [[return static_cast<S>(settings.baumgarte) / h * (@BUG@ ? std::min(separation, S(0)) : overlap);]])
planted_bug(change_of_an_impulse_held_at_zero FILE src/dynamics/solve_velocities.h TESTS dynamics
  WAS [[const S impulse = std::max(point.normal_impulse + change, S(0));]]
  IS [[const S impulse = @BUG@ ? point.normal_impulse + std::max(change, S(0)) : std::max(point.normal_impulse + change, S(0));]])
planted_bug(never_warm FILE src/dynamics/solver.cpp TESTS dynamics
  WAS [[if (!settings.warm_start) point.normal_impulse]]
  IS [[if (@BUG@ || !settings.warm_start) point.normal_impulse]])
planted_bug(hollow_ball FILE src/dynamics/mass_properties.cpp TESTS dynamics
  WAS [[result.inertia = 0.4 * result.mass * r * r * Mat3<double>::Identity();]]
  IS [[result.inertia = (@BUG@ ? 2.0 / 3 : 0.4) * result.mass * r * r * Mat3<double>::Identity();]])
planted_bug(no_parallel_axes FILE src/dynamics/mass_properties.cpp TESTS dynamics
  WAS [[length * length / 4 + 0.375 * r * length);]]
  IS [[length * length / 4 + (@BUG@ ? 0 : 0.375) * r * length);]])
planted_bug(friction_not_warm FILE src/dynamics/solve_velocities.h TESTS dynamics
  WAS [[Vec3<S>(point.normal_impulse * contact.normal + point.friction_u * contact.tangent_u +]]
  IS [[Vec3<S>(point.normal_impulse * contact.normal + (@BUG@ ? S(0) : point.friction_u) * contact.tangent_u +]])
planted_bug(pyramid_of_friction FILE src/dynamics/solve_velocities.h TESTS dynamics
  WAS [[const S length = std::sqrt(u * u + v * v);]]
  IS [[const S length = @BUG@ ? std::max(std::abs(u), std::abs(v)) : std::sqrt(u * u + v * v);]])
planted_bug(points_apart_may_not_close FILE src/dynamics/solve_velocities.h TESTS dynamics
  WAS [[if (point.separation > 0) return {point.separation / h, S(1), S(0)};]]
  IS [[if (point.separation > 0) return {@BUG@ ? S(0) : point.separation / h, S(1), S(0)};]])
planted_bug(gravity_bounces_too FILE src/dynamics/bounce.h TESTS dynamics
  WAS [[return std::sqrt(squared) - half_step;]]
  IS [[return std::sqrt(squared) - (@BUG@ ? S(0) : half_step);]])
planted_bug(arms_stay_behind FILE src/dynamics/solver.cpp TESTS dynamics
  WAS [[follow(BodyPair<S>(all, contact), contact);]]
  IS [[if (!@BUG@) follow(BodyPair<S>(all, contact), contact);]])
planted_bug(push_gains_angular_momentum FILE src/dynamics/solve_velocities.h TESTS dynamics
  WAS [[  take_back(bodies, contact,]]
  IS [[  if (!@BUG@) take_back(bodies, contact,]])
