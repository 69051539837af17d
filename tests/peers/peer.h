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

/// Bullet, ODE and FCL behind one plain interface, so that tests and benchmarks compare with them
/// and their headers stay in one file each. Metres; poses place shapes in the world.
namespace contactscope::peers {

struct Box {
  Vec3d half_extents;
};
/// As the libraries tell shapes apart. Meshes are shared: a library builds its tree over one once.
using PeerShape = std::variant<Sphere<double>, Capsule<double>, Box, Hull<double>,
                               HalfSpace<double>, std::shared_ptr<const Mesh<double>>>;

/// A hull as a library of boxes knows it: Box for what make_box made, the hull itself otherwise.
PeerShape shape_of(const Hull<double>& hull);
/// Any shape; a mesh is copied.
PeerShape shape_of(const Shape<double>& shape);

/// Where a capsule about `axis` (unit), centred on the origin, has to be placed in the capsule's
/// frame, for libraries that know no other.
Pose<double> capsule_frame(const Capsule<double>& capsule, const Vec3d& axis);
double capsule_length(const Capsule<double>& capsule);

struct PeerPoint {
  Vec3d position;     // world; where on the way between the surfaces differs by library
  double separation;  // metres, negative = overlap
  Vec3d normal;       // world, unit, from A to B
};

struct PeerContact {
  std::vector<PeerPoint> points;
  bool failed = false;  // the library gave up and said so

  /// The point of least separation; nullptr without points.
  const PeerPoint* deepest() const;
  /// Whether a point overlaps. Bullet also reports points that are apart.
  bool touching() const;
};

/// Two shapes that a library has made its own objects of.
class PeerPair {
 public:
  virtual ~PeerPair() = default;
  virtual void place(const Pose<double>& pose_a, const Pose<double>& pose_b) = 0;
  /// Forgets what the library remembers of earlier calls.
  virtual void forget() = 0;
  /// The library's work and nothing else, for timing. Returns a number that depends on the result.
  virtual double run() = 0;
  virtual PeerContact collide() = 0;
};

class Peer {
 public:
  virtual ~Peer() = default;
  virtual const char* name() const = 0;
  virtual std::string version() const = 0;  // that it was compiled with
  /// The relative error of one operation in the library's scalar.
  virtual double epsilon() const = 0;
  /// Null where the library has no algorithm for these shapes.
  virtual std::unique_ptr<PeerPair> pair(const PeerShape& a, const PeerShape& b) = 0;
};

std::unique_ptr<Peer> make_bullet();
std::unique_ptr<Peer> make_ode();
std::unique_ptr<Peer> make_fcl();
/// All three, in this order.
std::vector<std::unique_ptr<Peer>> make_peers();

}  // namespace contactscope::peers
