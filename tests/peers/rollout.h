#pragma once

#include <functional>
#include <iosfwd>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "peers/peer.h"
#include "trace/contact.h"

/// Common code of engines that step a scene themselves when `contactscope versus --rollout` runs
/// their program. src/versus/README.md documents input and output.
namespace contactscope::peers {

/// Motion of a body: metres, radians, seconds, world.
struct BodyMotion {
  Pose<double> pose{};
  Vec3d velocity = Vec3d::Zero();  // of the origin
  Vec3d angular_velocity = Vec3d::Zero();
};

/// A shape in a frame that every engine accepts: a dynamic body has its centre of mass at the
/// origin and principal axes along the axes; a capsule is along the engine's capsule axis.
struct Piece {
  std::string name;
  PeerShape shape;
  bool is_dynamic = false;
  bool is_scripted = false;  // it moves as the request says; neither scripted nor dynamic: static
  BodyMotion start{};
  double mass = 0;                // kilograms, only if dynamic
  Vec3d moments = Vec3d::Zero();  // kg m^2, about the axes
  double friction = 0, restitution = 0;
  Pose<double> in_shape{};  // this frame in the frame of the request's shape
};

/// A point that an engine found between two pieces.
struct Touch {
  int a = 0, b = 0;
  PeerPoint point;  // normal from a to b
  std::optional<trace::Impulse> impulse{};
  bool is_active = true;
  std::optional<int> triangle{};
};

/// Pieces in an engine's world. Any two may touch if at least one is dynamic. Friction combines as
/// the geometric mean, restitution as the maximum. Nothing sleeps, nothing is damped.
class RolloutWorld {
 public:
  virtual ~RolloutWorld() = default;
  virtual BodyMotion motion(int piece) = 0;
  /// Called for a scripted piece before each step: its position, and its motion in the step.
  virtual void drive(int piece, const BodyMotion& motion) = 0;
  /// Returns the contacts at the poses before the step.
  virtual std::vector<Touch> step(double seconds) = 0;
  virtual int iterations() const { return 0; }  // of its solver, if it has such a number
};

/// Message of a program that cannot step, or not this scene; the program then ends with kNoRollout.
struct NotStepped : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct RolloutEngine {
  std::string name, version;
  Vec3d capsule_axis = Vec3d::UnitY();
  std::function<std::unique_ptr<RolloutWorld>(const std::vector<Piece>&, const Vec3d& gravity,
                                              double step)>
      make;
};

/// Reads a request, steps it, and writes a frame before each step: its poses, and the contacts and
/// impulses of the step. Throws NotStepped, and InputError if the request is invalid.
void roll_out(const RolloutEngine& engine, std::istream& in, std::ostream& out);

RolloutEngine bullet_rollout();
RolloutEngine ode_rollout();

}  // namespace contactscope::peers
