#pragma once

#include <btBulletCollisionCommon.h>

#include <array>
#include <memory>
#include <unordered_map>

#include "peers/peer.h"

/// Bullet's shapes, for its contacts and its steps.
namespace contactscope::peers {

inline btVector3 vector_of(const Vec3d& v) {
  return btVector3(btScalar(v.x()), btScalar(v.y()), btScalar(v.z()));
}

inline Vec3d vector_of(const btVector3& v) { return Vec3d(v.x(), v.y(), v.z()); }

inline btTransform transform_of(const Pose<double>& pose) {
  const Quatd& q = pose.rotation;
  return btTransform(
      btQuaternion(btScalar(q.x()), btScalar(q.y()), btScalar(q.z()), btScalar(q.w())),
      vector_of(pose.position));
}

struct BulletMesh {
  std::vector<btVector3> vertices;
  std::vector<int> indices;
  std::unique_ptr<btTriangleIndexVertexArray> array;
  std::unique_ptr<btBvhTriangleMeshShape> shape;
};

/// Margins are zero; otherwise a hull would be rounded and larger by the margin.
class BulletShape {
 public:
  BulletShape(const PeerShape& shape, std::unordered_map<const Mesh<double>*, BulletMesh>& meshes) {
    std::visit([&](const auto& value) { make(value, meshes); }, shape);
  }
  const btCollisionShape& get() const { return *shape_; }
  const Pose<double>& frame() const { return frame_; }

 private:
  using Meshes = std::unordered_map<const Mesh<double>*, BulletMesh>;

  void own(std::unique_ptr<btCollisionShape> shape) {
    owned_ = std::move(shape);
    shape_ = owned_.get();
  }

  void make(const Sphere<double>& sphere, Meshes&) {
    own(std::make_unique<btSphereShape>(btScalar(sphere.radius)));
  }
  void make(const Capsule<double>& capsule, Meshes&) {
    frame_ = capsule_frame(capsule, Vec3d::UnitY());
    own(std::make_unique<btCapsuleShape>(btScalar(capsule.radius),
                                         btScalar(capsule_length(capsule))));
  }
  void make(const Box& box, Meshes&) {
    auto made = std::make_unique<btBoxShape>(vector_of(box.half_extents));
    made->setMargin(0);
    made->initializePolyhedralFeatures();
    own(std::move(made));
  }
  void make(const Hull<double>& hull, Meshes&) {
    auto made = std::make_unique<btConvexHullShape>();
    made->setMargin(0);
    for (const Vec3d& vertex : hull.vertices) made->addPoint(vector_of(vertex), false);
    made->recalcLocalAabb();
    // With these features, hulls are clipped against each other; without them, there is one point.
    made->initializePolyhedralFeatures();
    own(std::move(made));
  }
  void make(const std::shared_ptr<const Mesh<double>>& mesh, Meshes& meshes) {
    BulletMesh& made = meshes[mesh.get()];
    if (!made.shape) {
      for (const Vec3d& vertex : mesh->vertices) made.vertices.push_back(vector_of(vertex));
      for (const std::array<int, 3>& corners : mesh->triangles) {
        made.indices.insert(made.indices.end(), corners.begin(), corners.end());
      }
      made.array = std::make_unique<btTriangleIndexVertexArray>(
          int(made.indices.size() / 3), made.indices.data(), int(3 * sizeof(int)),
          int(made.vertices.size()), &made.vertices.data()->m_floats[0], int(sizeof(btVector3)));
      made.shape = std::make_unique<btBvhTriangleMeshShape>(made.array.get(), true);
      made.shape->setMargin(0);
    }
    shape_ = made.shape.get();
  }
  void make(const HalfSpace<double>& half_space, Meshes&) {
    auto made = std::make_unique<btStaticPlaneShape>(vector_of(half_space.plane.normal),
                                                     btScalar(half_space.plane.offset));
    made->setMargin(0);
    own(std::move(made));
  }

  std::unique_ptr<btCollisionShape> owned_;
  const btCollisionShape* shape_ = nullptr;
  Pose<double> frame_;
};

}  // namespace contactscope::peers
