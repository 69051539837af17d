#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/pose.h"
#include "geometry/hull.h"
#include "geometry/mesh.h"
#include "geometry/shape.h"

/// Bullet, ODE and FCL behind one interface, for the comparisons of tests and benchmarks. Each
/// library's headers stay in one file. Metres; poses place shapes in the world.
namespace contactscope::peers {

struct Box {
  Vec3d half_extents;
};
/// The shapes that libraries distinguish. Meshes are shared: a library builds one tree for each.
using PeerShape = std::variant<Sphere<double>, Capsule<double>, Box, Hull<double>,
                               HalfSpace<double>, std::shared_ptr<const Mesh<double>>>;

/// A Box if make_box made the hull, otherwise the hull itself.
PeerShape shape_of(const Hull<double>& hull);
/// Any shape; a mesh is copied.
PeerShape shape_of(const Shape<double>& shape);

/// Pose, in the capsule's frame, of a capsule about `axis` (unit) centred on the origin, for
/// libraries that support no others.
Pose<double> capsule_frame(const Capsule<double>& capsule, const Vec3d& axis);
double capsule_length(const Capsule<double>& capsule);

struct PeerPoint {
  Vec3d position;     // world; its place between the surfaces differs by library
  double separation;  // metres, negative = overlap
  Vec3d normal;       // world, unit, from A to B
};

struct PeerContact {
  std::vector<PeerPoint> points;
  bool failed = false;  // the library gave up and reported this

  /// The point of least separation; nullptr without points.
  const PeerPoint* deepest() const;
  /// Whether any point overlaps. Bullet also reports separated points.
  bool touching() const;
};

/// Two shapes converted to a library's own objects.
class PeerPair {
 public:
  virtual ~PeerPair() = default;
  virtual void place(const Pose<double>& pose_a, const Pose<double>& pose_b) = 0;
  /// Clears what the library remembers of earlier calls.
  virtual void forget() = 0;
  /// Runs only the library's work, for timing. Returns a number that depends on the result.
  virtual double run() = 0;
  virtual PeerContact collide() = 0;
};

class Peer {
 public:
  virtual ~Peer() = default;
  virtual const char* name() const = 0;
  virtual std::string version() const = 0;  // the version that this was compiled with
  /// The relative error of one operation in the library's scalar.
  virtual double epsilon() const = 0;
  /// Null if the library has no algorithm for these shapes.
  virtual std::unique_ptr<PeerPair> pair(const PeerShape& a, const PeerShape& b) = 0;
};

std::unique_ptr<Peer> make_bullet();
std::unique_ptr<Peer> make_ode();
std::unique_ptr<Peer> make_fcl();
/// All three, in this order.
std::vector<std::unique_ptr<Peer>> make_peers();

}  // namespace contactscope::peers
