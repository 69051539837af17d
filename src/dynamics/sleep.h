#pragma once

#include "dynamics/solver.h"

/// Resting bodies stay in place until a moving one touches them. This is decided per island, all
/// dynamic bodies that contacts join: a body alone would fall asleep under a stack that still
/// sways. Sources: Catto 2023, "Simulation Islands" (union-find, islands wake as a whole); NVIDIA
/// 2024, "PhysX 5: Rigid Body Dynamics, Sleeping" (energy per kilogram, which needs no extent).
///
/// Steps: the contacts at the current poses join islands; an island wakes when one of its bodies is
/// awake or touches a moving scripted body; awake bodies are solved; an island whose bodies all had
/// at most `sleep_speed` for `sleep_after` seconds falls asleep at rest.
///
/// Gregorius 2015, "Incremental Manifold Stability": the centre of mass projects into the manifold.
namespace contactscope {

/// Two bodies that share contact points.
struct Touch {
  int a = 0, b = 0;
};

/// Union-find with path halving. An island's id is its lowest body.
class Islands {
 public:
  explicit Islands(int bodies);
  void join(int a, int b);
  int of(int body);

 private:
  std::vector<int> parents_;
};

/// Sleep state of all bodies. Copies are independent.
template <class S> class Sleepers {
 public:
  /// Sleeping is off.
  Sleepers() = default;
  /// All bodies start awake. Sleeping is off if `settings`, settled(), have no `sleep_after`.
  Sleepers(const std::vector<Body<S>>& bodies, const SolverSettings& settings);
  bool may_sleep() const { return !still_.empty(); }
  bool asleep(int body) const { return may_sleep() && at(asleep_, body); }

  /// Before a step: wakes islands as described above. `touches` includes sleeping bodies, `bodies`
  /// the velocities of scripted ones. Returns whether any body woke.
  bool wake(const std::vector<Body<S>>& bodies, std::span<const Touch> touches);
  /// Wakes a body that was hit within a step; its island follows in the next step.
  void wake(int body);
  /// After a step of `dt` seconds: puts islands to sleep.
  void settle(std::vector<Body<S>>& bodies, std::span<const Touch> touches, double dt);

 private:
  bool rests(double seconds) const { return seconds > 0 && seconds >= after_; }
  Islands join(const std::vector<Body<S>>& bodies, std::span<const Touch> touches) const;

  double speed_ = 0, after_ = 0;  // metres per second, seconds
  std::vector<bool> asleep_;      // one per body, like the next
  std::vector<double> still_;     // seconds for which it has not been faster than `speed_`
};

/// Root mean square speed over a dynamic body's mass, from velocity and spin, metres per second.
template <class S> double mean_speed(const Body<S>& body);

/// solve_step() for all awake bodies. Sleeping bodies stay in place, and the impulses between them
/// are kept. Bit for bit solve_step() if no body sleeps.
template <class S>
void solve_awake(std::vector<Body<S>>& bodies, std::span<const PairContacts<S>> pairs,
                 std::vector<PairImpulses<S>>& impulses, const Vec3<S>& gravity,
                 const SolverSettings& settings, S dt, const Sleepers<S>& sleepers);

/// Whether a body rests on a manifold's `points` with this `normal` (unit). World, metres. The
/// contact plane passes through the middle of the points, perpendicular to the normal. `rounding`,
/// metres: error of the points, see rounding_of(). A projection closer to the border is not inside,
/// and points closer to a line have no area. The verdict:
///   - "stable": the projection is inside, by more than rounding;
///   - "turns about a line": two points, points on a line, or the projection on or beyond an edge;
///   - "turns about a point": one point, or the projection beyond a corner;
///   - "no contact": no points. There is no plane, and projection and margin are meaningless.
trace::Stability rest_of(std::span<const Vec3d> points, const Vec3d& normal,
                         const Vec3d& center_of_mass, double rounding);

/// Bound of the pipeline's rounding for points with such coordinates. `epsilon`: of its scalar.
double rounding_of(std::span<const Vec3d> points, const Vec3d& center_of_mass, double epsilon);

/// The same for the manifolds of a recorded pair. A mesh's manifolds are joined: all points count,
/// and the normal is the mean over them. `shape`: name of the body.
trace::Stability rest_of(const trace::Pair& pair, const std::string& shape,
                         const Vec3d& center_of_mass, double epsilon);

}  // namespace contactscope
