// Bullet 3.24 as Debian builds it, in float. Collision algorithms come from its own dispatcher.
#include <btBulletCollisionCommon.h>

#include <array>
#include <limits>
#include <span>
#include <unordered_map>

#include "peers/peer.h"

namespace contactscope::peers {
namespace {

btVector3 vector_of(const Vec3d& v) {
  return btVector3(btScalar(v.x()), btScalar(v.y()), btScalar(v.z()));
}

Vec3d vector_of(const btVector3& v) {
  return Vec3d(v.x(), v.y(), v.z());
}

btTransform transform_of(const Pose<double>& pose) {
  const Quatd& q = pose.rotation;
  return btTransform(
      btQuaternion(btScalar(q.x()), btScalar(q.y()), btScalar(q.z()), btScalar(q.w())),
      vector_of(pose.position));
}

struct Engine {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
};

struct MeshShape {
  std::vector<btVector3> vertices;
  std::vector<int> indices;
  std::unique_ptr<btTriangleIndexVertexArray> array;
  std::unique_ptr<btBvhTriangleMeshShape> shape;
};

/// Margins are zero: a hull would be rounded, and larger by the margin, otherwise.
class MadeShape {
 public:
  MadeShape(const PeerShape& shape, std::unordered_map<const Mesh<double>*, MeshShape>& meshes) {
    std::visit([&](const auto& value) { make(value, meshes); }, shape);
  }
  const btCollisionShape& get() const { return *shape_; }
  const Pose<double>& frame() const { return frame_; }

 private:
  using Meshes = std::unordered_map<const Mesh<double>*, MeshShape>;

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
    // With them, hulls are clipped against each other; without, there is one point.
    made->initializePolyhedralFeatures();
    own(std::move(made));
  }
  void make(const std::shared_ptr<const Mesh<double>>& mesh, Meshes& meshes) {
    MeshShape& made = meshes[mesh.get()];
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

class BulletPair : public PeerPair {
 public:
  BulletPair(std::shared_ptr<Engine> engine, const PeerShape& a, const PeerShape& b,
             std::unordered_map<const Mesh<double>*, MeshShape>& meshes)
      : engine_(std::move(engine)), shape_a_(a, meshes), shape_b_(b, meshes) {
    body_a_.setCollisionShape(const_cast<btCollisionShape*>(&shape_a_.get()));
    body_b_.setCollisionShape(const_cast<btCollisionShape*>(&shape_b_.get()));
    const btCollisionObjectWrapper a_wrapped = wrapped(body_a_);
    const btCollisionObjectWrapper b_wrapped = wrapped(body_b_);
    algorithm_ = engine_->dispatcher.findAlgorithm(&a_wrapped, &b_wrapped, nullptr,
                                                   BT_CONTACT_POINT_ALGORITHMS);
  }
  ~BulletPair() override {
    algorithm_->~btCollisionAlgorithm();
    engine_->dispatcher.freeCollisionAlgorithm(algorithm_);
  }
  BulletPair(const BulletPair&) = delete;
  BulletPair& operator=(const BulletPair&) = delete;

  void place(const Pose<double>& pose_a, const Pose<double>& pose_b) override {
    body_a_.setWorldTransform(transform_of(compose(pose_a, shape_a_.frame())));
    body_b_.setWorldTransform(transform_of(compose(pose_b, shape_b_.frame())));
  }

  void forget() override {
    for (btPersistentManifold* manifold : manifolds()) manifold->clearManifold();
  }

  double run() override {
    process();
    double sum = 0;
    for (btPersistentManifold* manifold : manifolds()) {
      for (int i = 0; i < manifold->getNumContacts(); ++i) {
        sum += double(manifold->getContactPoint(i).getDistance());
      }
    }
    return sum;
  }

  PeerContact collide() override {
    forget();
    process();
    PeerContact contact;
    for (btPersistentManifold* manifold : manifolds()) {
      // The normal of Bullet points at the manifold's first body.
      const double sign = manifold->getBody0() == &body_a_ ? -1 : 1;
      for (int i = 0; i < manifold->getNumContacts(); ++i) {
        const btManifoldPoint& point = manifold->getContactPoint(i);
        const btVector3 middle =
            (point.getPositionWorldOnA() + point.getPositionWorldOnB()) * btScalar(0.5);
        contact.points.push_back({vector_of(middle), double(point.getDistance()),
                                  sign * vector_of(point.m_normalWorldOnB)});
      }
    }
    return contact;
  }

 private:
  static btCollisionObjectWrapper wrapped(const btCollisionObject& body) {
    return btCollisionObjectWrapper(nullptr, body.getCollisionShape(), &body,
                                    body.getWorldTransform(), -1, -1);
  }

  void process() {
    const btCollisionObjectWrapper a = wrapped(body_a_);
    const btCollisionObjectWrapper b = wrapped(body_b_);
    btManifoldResult result(&a, &b);
    algorithm_->processCollision(&a, &b, info_, &result);
  }

  std::span<btPersistentManifold*> manifolds() {
    array_.resizeNoInitialize(0);
    algorithm_->getAllContactManifolds(array_);
    if (array_.size() == 0) return {};
    return {&array_[0], static_cast<std::size_t>(array_.size())};
  }

  std::shared_ptr<Engine> engine_;
  MadeShape shape_a_;
  MadeShape shape_b_;
  btCollisionObject body_a_;
  btCollisionObject body_b_;
  btDispatcherInfo info_;
  btManifoldArray array_;
  btCollisionAlgorithm* algorithm_ = nullptr;
};

class Bullet : public Peer {
 public:
  const char* name() const override { return "Bullet"; }
  std::string version() const override {
    return std::to_string(BT_BULLET_VERSION / 100) + "." + std::to_string(BT_BULLET_VERSION % 100);
  }
  double epsilon() const override { return std::numeric_limits<btScalar>::epsilon(); }
  std::unique_ptr<PeerPair> pair(const PeerShape& a, const PeerShape& b) override {
    return std::make_unique<BulletPair>(engine_, a, b, meshes_);
  }

 private:
  std::shared_ptr<Engine> engine_ = std::make_shared<Engine>();
  std::unordered_map<const Mesh<double>*, MeshShape> meshes_;
};

}  // namespace

std::unique_ptr<Peer> make_bullet() {
  return std::make_unique<Bullet>();
}

}  // namespace contactscope::peers
