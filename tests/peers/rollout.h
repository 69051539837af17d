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

/// An engine that steps a scene by itself when `contactscope versus --rollout` asks its program:
/// src/versus/README.md says what is read and written. What the engines have in common is here.
namespace contactscope::peers {

/// How a body moves: metres, radians, seconds, world.
struct BodyMotion {
  Pose<double> pose{};
  Vec3d velocity = Vec3d::Zero();  // of the origin
  Vec3d angular_velocity = Vec3d::Zero();
};

/// A shape of the request in a frame that every engine can take: a dynamic body has its centre of mass at the
/// origin and its principal axes along the axes, a capsule lies along the axis that the engine knows.
struct Piece {
  std::string name;
  PeerShape shape;
  bool is_dynamic = false;
  bool is_scripted = false;  // it moves as the request says; else, if not dynamic, it stands
  BodyMotion start{};
  double mass = 0;                // kilograms, of dynamic ones
  Vec3d moments = Vec3d::Zero();  // kg m^2, about the axes
  double friction = 0, restitution = 0;
  Pose<double> in_shape{};  // this frame in that of the request's shape
};

/// A point that an engine found between two pieces.
struct Touch {
  int a = 0, b = 0;
  PeerPoint point;  // normal from a to b
  std::optional<trace::Impulse> impulse{};
  bool is_active = true;
  std::optional<int> triangle{};
};

/// Pieces in an engine's world. Every two may touch of which one is dynamic; of a contact the friction is the
/// geometric mean of both, the restitution the larger. Nothing sleeps, and nothing is damped.
class RolloutWorld {
 public:
  virtual ~RolloutWorld() = default;
  virtual BodyMotion motion(int piece) = 0;
  /// Of a scripted piece, before each step: where it is, and how it moves in the step.
  virtual void drive(int piece, const BodyMotion& motion) = 0;
  /// What it found where the bodies were before the step.
  virtual std::vector<Touch> step(double seconds) = 0;
  virtual int iterations() const { return 0; }  // of its solver, where it has a number of them
};

/// What a program that steps nothing, or not this, says before it ends with kNoRollout.
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

/// Reads a request, steps it, and writes a frame before each step: its poses, and the contacts and impulses of the
/// step. Throws NotStepped, and InputError of a request that is none.
void roll_out(const RolloutEngine& engine, std::istream& in, std::ostream& out);

RolloutEngine bullet_rollout();
RolloutEngine ode_rollout();

}  // namespace contactscope::peers
