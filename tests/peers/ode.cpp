// ODE 0.16 as Debian builds it, in double. dCollide finds the algorithm and keeps nothing.
#include <ode/ode.h>

#include <array>
#include <limits>
#include <unordered_map>

#include "peers/peer.h"

namespace contactscope::peers {
namespace {

constexpr int kMaxPoints = 8;
/// A mesh gives points for each of its triangles.
constexpr int kMaxMeshPoints = 64;

struct Engine {
  Engine() {
    dInitODE2(0);
    dAllocateODEDataForThread(dAllocateMaskAll);
  }
  ~Engine() { dCloseODE(); }
};

struct MeshData {
  explicit MeshData(const Mesh<double>& mesh) : id(dGeomTriMeshDataCreate()) {
    for (const Vec3d& v : mesh.vertices) {
      vertices.insert(vertices.end(), {v.x(), v.y(), v.z()});
    }
    for (const std::array<int, 3>& corners : mesh.triangles) {
      indices.insert(indices.end(), corners.begin(), corners.end());
    }
    dGeomTriMeshDataBuildDouble(id, vertices.data(), 3 * sizeof(double),
                                static_cast<int>(vertices.size() / 3), indices.data(),
                                static_cast<int>(indices.size()), 3 * sizeof(dTriIndex));
  }
  ~MeshData() { dGeomTriMeshDataDestroy(id); }
  MeshData(const MeshData&) = delete;
  MeshData& operator=(const MeshData&) = delete;

  dTriMeshDataID id;
  std::vector<double> vertices;
  std::vector<dTriIndex> indices;
};

using Meshes = std::unordered_map<const Mesh<double>*, std::shared_ptr<MeshData>>;

/// A geometry with the arrays that it points at, and its own frame in the shape's.
class MadeGeometry {
 public:
  MadeGeometry(const PeerShape& shape, Meshes& meshes) {
    std::visit([&](const auto& value) { make(value, meshes); }, shape);
  }
  ~MadeGeometry() { dGeomDestroy(id_); }
  MadeGeometry(const MadeGeometry&) = delete;
  MadeGeometry& operator=(const MadeGeometry&) = delete;

  dGeomID id() const { return id_; }

  void place(const Pose<double>& pose) {
    if (dGeomGetClass(id_) == dPlaneClass) return place_plane(pose);
    const Pose<double> placed = compose(pose, frame_);
    const Quatd& q = placed.rotation;
    const dQuaternion turned = {q.w(), q.x(), q.y(), q.z()};
    dGeomSetQuaternion(id_, turned);
    dGeomSetPosition(id_, placed.position.x(), placed.position.y(), placed.position.z());
  }

 private:
  void make(const Sphere<double>& sphere, Meshes&) { id_ = dCreateSphere(nullptr, sphere.radius); }
  void make(const Capsule<double>& capsule, Meshes&) {
    id_ = dCreateCapsule(nullptr, capsule.radius, capsule_length(capsule));
    // Its axis is z.
    frame_ = capsule_frame(capsule, Vec3d::UnitZ());
  }
  void make(const Box& box, Meshes&) {
    const Vec3d sides = 2 * box.half_extents;
    id_ = dCreateBox(nullptr, sides.x(), sides.y(), sides.z());
  }
  void make(const Hull<double>& hull, Meshes&) {
    // Its origin must lie inside.
    frame_.position = hull.centroid;
    for (const Vec3d& vertex : hull.vertices) {
      const Vec3d v = vertex - hull.centroid;
      points_.insert(points_.end(), {v.x(), v.y(), v.z()});
    }
    for (int face = 0; face < hull.face_count(); ++face) {
      const Plane<double>& plane = hull.planes[static_cast<std::size_t>(face)];
      const Vec3d& n = plane.normal;
      planes_.insert(planes_.end(), {n.x(), n.y(), n.z(), plane.offset - n.dot(hull.centroid)});
      const std::vector<int> loop = face_vertices(hull, face);
      polygons_.push_back(static_cast<unsigned>(loop.size()));
      polygons_.insert(polygons_.end(), loop.begin(), loop.end());
    }
    id_ =
        dCreateConvex(nullptr, planes_.data(), static_cast<unsigned>(hull.face_count()),
                      points_.data(), static_cast<unsigned>(hull.vertex_count()), polygons_.data());
  }
  void make(const std::shared_ptr<const Mesh<double>>& mesh, Meshes& meshes) {
    std::shared_ptr<MeshData>& data = meshes[mesh.get()];
    if (!data) data = std::make_shared<MeshData>(*mesh);
    mesh_ = data;
    id_ = dCreateTriMesh(nullptr, data->id, nullptr, nullptr, nullptr);
  }
  void make(const HalfSpace<double>& half_space, Meshes&) {
    half_space_ = half_space;
    id_ = dCreatePlane(nullptr, half_space.plane.normal.x(), half_space.plane.normal.y(),
                       half_space.plane.normal.z(), half_space.plane.offset);
  }

  /// A plane has no pose.
  void place_plane(const Pose<double>& pose) {
    const Vec3d normal = pose.rotate(half_space_.plane.normal);
    dGeomPlaneSetParams(id_, normal.x(), normal.y(), normal.z(),
                        half_space_.plane.offset + normal.dot(pose.position));
  }

  dGeomID id_ = nullptr;
  Pose<double> frame_;
  HalfSpace<double> half_space_;
  std::vector<dReal> points_;
  std::vector<dReal> planes_;
  std::vector<unsigned> polygons_;
  std::shared_ptr<MeshData> mesh_;
};

class OdePair : public PeerPair {
 public:
  OdePair(std::shared_ptr<Engine> engine, const PeerShape& a, const PeerShape& b, Meshes& meshes)
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

  std::shared_ptr<Engine> engine_;
  MadeGeometry a_;
  MadeGeometry b_;
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

  std::shared_ptr<Engine> engine_ = std::make_shared<Engine>();
  Meshes meshes_;
};

}  // namespace

std::unique_ptr<Peer> make_ode() {
  return std::make_unique<Ode>();
}

}  // namespace contactscope::peers
