# The solver.
planted_bug(restitution_from_one_metre_a_second FILE src/dynamics/solve_velocities.h TESTS dynamics
  WAS [[const S threshold = static_cast<S>(kRestitutionThreshold) * gravity.norm() * h;]]
  IS [[const S threshold = @BUG@ ? S(1) : static_cast<S>(kRestitutionThreshold) * gravity.norm() * h;]])
planted_bug(friction_twice_as_much FILE src/dynamics/solve_velocities.h TESTS dynamics
  WAS [[const S most = contact.friction * point.normal_impulse;]]
  IS [[const S most = (@BUG@ ? S(2) : S(1)) * contact.friction * point.normal_impulse;]])
planted_bug(slop_pushed_out FILE src/dynamics/solve_velocities.h TESTS dynamics
  WAS [[return {static_cast<S>(settings.baumgarte) / h * overlap, S(1), S(0)};]]
  IS [[return {static_cast<S>(settings.baumgarte) / h * (@BUG@ ? std::min(separation, S(0)) : overlap), S(1), S(0)};]])
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
  WAS [[if (separation > 0) return {separation / h, S(1), S(0)};]]
  IS [[if (separation > 0) return {@BUG@ ? S(0) : separation / h, S(1), S(0)};]])
planted_bug(lift_of_a_bounce_kept FILE src/dynamics/solve_velocities.h TESTS dynamics
  WAS [[const S lift = point.separation - point.separation_began;]]
  IS [[const S lift = @BUG@ ? S(0) : point.separation - point.separation_began;]])
