// ODE 0.16 as Debian builds it, in double. dCollide selects the algorithm and keeps nothing.
#include <ode/ode.h>

#include <limits>

#include "peers/ode_geometry.h"

namespace contactscope::peers {
namespace {

constexpr int kMaxPoints = 8;
/// A mesh reports points for each of its triangles.
constexpr int kMaxMeshPoints = 64;

class OdePair : public PeerPair {
 public:
  OdePair(std::shared_ptr<OdeLibrary> engine, const PeerShape& a, const PeerShape& b,
          OdeMeshes& meshes)
      : engine_(std::move(engine)), a_(a, meshes), b_(b, meshes) {
    const bool mesh =
        dGeomGetClass(a_.id()) == dTriMeshClass || dGeomGetClass(b_.id()) == dTriMeshClass;
    limit_ = mesh ? kMaxMeshPoints : kMaxPoints;
  }

  void place(const Pose<double>& pose_a, const Pose<double>& pose_b) override {
    a_.place(pose_a);
    b_.place(pose_b);
  }

  void forget() override {}

  double run() override {
    const int count = process();
    double sum = 0;
    for (int i = 0; i < count; ++i) sum += contacts_[static_cast<std::size_t>(i)].depth;
    return sum;
  }

  PeerContact collide() override {
    PeerContact contact;
    const int count = process();
    for (int i = 0; i < count; ++i) {
      const dContactGeom& found = contacts_[static_cast<std::size_t>(i)];
      const dReal* p = found.pos;
      const dReal* n = found.normal;  // points into the first body
      contact.points.push_back({Vec3d(p[0], p[1], p[2]), -found.depth, Vec3d(-n[0], -n[1], -n[2])});
    }
    return contact;
  }

 private:
  int process() {
    return dCollide(a_.id(), b_.id(), limit_, contacts_.data(), sizeof(dContactGeom));
  }

  std::shared_ptr<OdeLibrary> engine_;
  OdeGeometry a_;
  OdeGeometry b_;
  int limit_;
  std::array<dContactGeom, kMaxMeshPoints> contacts_;
};

class Ode : public Peer {
 public:
  const char* name() const override { return "ODE"; }
  std::string version() const override { return dODE_VERSION; }
  double epsilon() const override { return std::numeric_limits<dReal>::epsilon(); }
  std::unique_ptr<PeerPair> pair(const PeerShape& a, const PeerShape& b) override {
    if (unknown(a, b) || unknown(b, a)) return nullptr;
    return std::make_unique<OdePair>(engine_, a, b, meshes_);
  }

 private:
  using MeshPointer = std::shared_ptr<const Mesh<double>>;

  static bool unknown(const PeerShape& one, const PeerShape& other) {
    return std::holds_alternative<Hull<double>>(one) && std::holds_alternative<MeshPointer>(other);
  }

  std::shared_ptr<OdeLibrary> engine_ = std::make_shared<OdeLibrary>();
  OdeMeshes meshes_;
};

}  // namespace

std::unique_ptr<Peer> make_ode() { return std::make_unique<Ode>(); }

}  // namespace contactscope::peers
