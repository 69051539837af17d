#pragma once

#include <ode/ode.h>

#include <array>
#include <memory>
#include <unordered_map>
#include <vector>

#include "peers/peer.h"

/// ODE's shapes, for its contacts and its steps.
namespace contactscope::peers {

/// Keeps the library initialised.
struct OdeLibrary {
  OdeLibrary() {
    dInitODE2(0);
    dAllocateODEDataForThread(dAllocateMaskAll);
  }
  ~OdeLibrary() { dCloseODE(); }
};

struct OdeMesh {
  explicit OdeMesh(const Mesh<double>& mesh) : id(dGeomTriMeshDataCreate()) {
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
  ~OdeMesh() { dGeomTriMeshDataDestroy(id); }
  OdeMesh(const OdeMesh&) = delete;
  OdeMesh& operator=(const OdeMesh&) = delete;

  dTriMeshDataID id;
  std::vector<double> vertices;
  std::vector<dTriIndex> indices;
};

using OdeMeshes = std::unordered_map<const Mesh<double>*, std::shared_ptr<OdeMesh>>;

/// A geometry, the arrays that it points at, and its frame relative to the shape's.
class OdeGeometry {
 public:
  OdeGeometry(const PeerShape& shape, OdeMeshes& meshes) {
    std::visit([&](const auto& value) { make(value, meshes); }, shape);
  }
  ~OdeGeometry() { dGeomDestroy(id_); }
  OdeGeometry(const OdeGeometry&) = delete;
  OdeGeometry& operator=(const OdeGeometry&) = delete;

  dGeomID id() const { return id_; }
  const Pose<double>& frame() const { return frame_; }

  void place(const Pose<double>& pose) {
    if (dGeomGetClass(id_) == dPlaneClass) return place_plane(pose);
    const Pose<double> placed = compose(pose, frame_);
    const Quatd& q = placed.rotation;
    const dQuaternion turned = {q.w(), q.x(), q.y(), q.z()};
    dGeomSetQuaternion(id_, turned);
    dGeomSetPosition(id_, placed.position.x(), placed.position.y(), placed.position.z());
  }

 private:
  void make(const Sphere<double>& sphere, OdeMeshes&) {
    id_ = dCreateSphere(nullptr, sphere.radius);
  }
  void make(const Capsule<double>& capsule, OdeMeshes&) {
    id_ = dCreateCapsule(nullptr, capsule.radius, capsule_length(capsule));
    // ODE's capsule axis is z.
    frame_ = capsule_frame(capsule, Vec3d::UnitZ());
  }
  void make(const Box& box, OdeMeshes&) {
    const Vec3d sides = 2 * box.half_extents;
    id_ = dCreateBox(nullptr, sides.x(), sides.y(), sides.z());
  }
  void make(const Hull<double>& hull, OdeMeshes&) {
    // The origin of ODE's convex must lie inside.
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
  void make(const std::shared_ptr<const Mesh<double>>& mesh, OdeMeshes& meshes) {
    std::shared_ptr<OdeMesh>& data = meshes[mesh.get()];
    if (!data) data = std::make_shared<OdeMesh>(*mesh);
    mesh_ = data;
    id_ = dCreateTriMesh(nullptr, data->id, nullptr, nullptr, nullptr);
  }
  void make(const HalfSpace<double>& half_space, OdeMeshes&) {
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
  std::shared_ptr<OdeMesh> mesh_;
};

}  // namespace contactscope::peers
