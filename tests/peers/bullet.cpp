// Bullet 3.24 as Debian builds it, in float. Collision algorithms come from its own dispatcher.
#include <btBulletCollisionCommon.h>

#include <limits>
#include <span>

#include "peers/bullet_shape.h"

namespace contactscope::peers {
namespace {

struct Engine {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
};

class BulletPair : public PeerPair {
 public:
  BulletPair(std::shared_ptr<Engine> engine, const PeerShape& a, const PeerShape& b,
             std::unordered_map<const Mesh<double>*, BulletMesh>& meshes)
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
      // Bullet's normal points at the manifold's first body.
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
  BulletShape shape_a_;
  BulletShape shape_b_;
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
  std::unordered_map<const Mesh<double>*, BulletMesh> meshes_;
};

}  // namespace

std::unique_ptr<Peer> make_bullet() { return std::make_unique<Bullet>(); }

}  // namespace contactscope::peers
