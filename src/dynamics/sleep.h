#pragma once

#include <span>
#include <vector>

#include "dynamics/solver.h"

/// Bodies that rest are left where they are, until something that moves touches them. Whether they may
/// is decided for an island at a time, that is for all dynamic bodies that contacts join: one of them
/// alone would fall asleep under a stack that still sways. Sources: Catto 2023, "Simulation Islands"
/// (union-find, and that an island wakes as a whole); NVIDIA 2024, "PhysX 5: Rigid Body Dynamics,
/// Sleeping" (that what counts is the kinetic energy of a kilogram, so that no extent is needed).
///
/// Steps: the contacts where the bodies are now join islands; an island wakes when one of its bodies is
/// awake or is touched by something that a script moves; awake bodies are solved; an island of which
/// no body was faster than `sleep_speed` for `sleep_after` seconds falls asleep, its velocities zero.
namespace contactscope {

/// Two bodies that share contact points.
struct Touch {
  int a = 0, b = 0;
};

/// Union-find with path halving. An island is named by its lowest body.
class Islands {
 public:
  explicit Islands(int bodies);
  void join(int a, int b);
  int of(int body);

 private:
  std::vector<int> parents_;
};

/// Who sleeps. A value: a copy goes on by itself.
template <class S>
class Sleepers {
 public:
  /// Nobody ever sleeps.
  Sleepers() = default;
  /// All are awake; nobody ever sleeps where `settings`, settled(), have no `sleep_after`.
  Sleepers(const std::vector<Body<S>>& bodies, const SolverSettings& settings);

  bool may_sleep() const { return !still_.empty(); }
  bool asleep(int body) const { return may_sleep() && at(asleep_, body); }

  /// Before a step: wakes islands as said above. `touches` are all that there are, of sleeping bodies too,
  /// `bodies` have the velocities of what a script moves. Returns whether anybody woke.
  bool wake(const std::vector<Body<S>>& bodies, std::span<const Touch> touches);
  /// That body was hit in the middle of a step; its island follows in the next.
  void wake(int body);
  /// After a step of `dt` seconds: puts islands to sleep.
  void settle(std::vector<Body<S>>& bodies, std::span<const Touch> touches, double dt);

 private:
  bool rests(double seconds) const { return seconds > 0 && seconds >= after_; }
  Islands join(const std::vector<Body<S>>& bodies, std::span<const Touch> touches) const;

  double speed_ = 0, after_ = 0;  // metres a second, seconds
  std::vector<bool> asleep_;      // one a body, as the next
  std::vector<double> still_;     // seconds for which it has been no faster than `speed_`
};

/// How fast the kilograms of a dynamic body are, in the root mean square, metres a second: what its
/// velocity and its spin come to together.
template <class S>
double mean_speed(const Body<S>& body);

/// solve_step() of all bodies that are awake. Others stay where they are, and the impulses between them
/// what they were. The same bits as solve_step() where nobody sleeps.
template <class S>
void solve_awake(std::vector<Body<S>>& bodies, std::span<const PairContacts<S>> pairs,
                 std::vector<PairImpulses<S>>& impulses, const Vec3<S>& gravity,
                 const SolverSettings& settings, S dt, const Sleepers<S>& sleepers);

}  // namespace contactscope
