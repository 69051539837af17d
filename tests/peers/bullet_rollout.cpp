// Bullet 3.24 steps a scene: its discrete world with its default solver and settings.
#include <btBulletDynamicsCommon.h>

#include "peers/bullet_shape.h"
#include "peers/rollout.h"

namespace contactscope::peers {
namespace {

btScalar mean_friction(const btCollisionObject* a, const btCollisionObject* b) {
  return btSqrt(a->getFriction() * b->getFriction());
}
btScalar larger_restitution(const btCollisionObject* a, const btCollisionObject* b) {
  return btMax(a->getRestitution(), b->getRestitution());
}

/// Pose of a body one step earlier: Bullet derives the velocity of a kinematic body from it.
btTransform before(const BodyMotion& motion, double seconds) {
  const double angle = motion.angular_velocity.norm() * seconds;
  Pose<double> pose = motion.pose;
  pose.position -= seconds * motion.velocity;
  if (angle > 0)
    pose.rotation =
        Quatd(Eigen::AngleAxisd(-angle, motion.angular_velocity.normalized())) * pose.rotation;
  return transform_of(pose);
}

class BulletWorld : public RolloutWorld {
 public:
  BulletWorld(const std::vector<Piece>& pieces, const Vec3d& gravity) {
    gCalculateCombinedFrictionCallback = mean_friction;
    gCalculateCombinedRestitutionCallback = larger_restitution;
    world_.setGravity(vector_of(gravity));
    for (int i = 0; i < count_of(pieces); ++i) add(at(pieces, i), i);
  }
  ~BulletWorld() override {
    for (const auto& body : bodies_) world_.removeRigidBody(body.get());
  }
  BulletWorld(const BulletWorld&) = delete;
  BulletWorld& operator=(const BulletWorld&) = delete;

  BodyMotion motion(int piece) override {
    const btRigidBody& body = *at(bodies_, piece);
    const btTransform& place = body.getWorldTransform();
    const btQuaternion q = place.getRotation();
    const Quatd rotation(q.w(), q.x(), q.y(), q.z());
    return {{rotation.normalized(), vector_of(place.getOrigin())},
            vector_of(body.getLinearVelocity()),
            vector_of(body.getAngularVelocity())};
  }

  void drive(int piece, const BodyMotion& motion) override { driven_.emplace_back(piece, motion); }

  std::vector<Touch> step(double seconds) override {
    for (const auto& [piece, motion] : driven_) {
      btRigidBody& body = *at(bodies_, piece);
      body.setWorldTransform(transform_of(motion.pose));
      body.setInterpolationWorldTransform(before(motion, seconds));
    }
    driven_.clear();
    world_.stepSimulation(btScalar(seconds), 0);
    std::vector<Touch> touches;
    for (int i = 0; i < dispatcher_.getNumManifolds(); ++i)
      report(*dispatcher_.getManifoldByIndexInternal(i), touches);
    return touches;
  }

  int iterations() const override {
    return const_cast<BulletWorld*>(this)->world_.getSolverInfo().m_numIterations;
  }

 private:
  void add(const Piece& piece, int index) {
    shapes_.push_back(std::make_unique<BulletShape>(piece.shape, meshes_));
    auto* const shape = const_cast<btCollisionShape*>(&shapes_.back()->get());
    const btScalar mass = piece.is_dynamic ? btScalar(piece.mass) : btScalar(0);
    btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shape, vector_of(piece.moments));
    info.m_startWorldTransform = transform_of(piece.start.pose);
    info.m_friction = btScalar(piece.friction);
    info.m_restitution = btScalar(piece.restitution);
    auto body = std::make_unique<btRigidBody>(info);
    body->setUserIndex(index);
    body->setActivationState(DISABLE_DEACTIVATION);
    if (piece.is_scripted && !piece.is_dynamic)
      body->setCollisionFlags(body->getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
    body->setLinearVelocity(vector_of(piece.start.velocity));
    body->setAngularVelocity(vector_of(piece.start.angular_velocity));
    world_.addRigidBody(body.get());
    bodies_.push_back(std::move(body));
  }

  /// Bullet's normal points at the manifold's first body, and its impulses act on that body.
  static void report(const btPersistentManifold& manifold, std::vector<Touch>& touches) {
    const int a = manifold.getBody0()->getUserIndex(), b = manifold.getBody1()->getUserIndex();
    for (int i = 0; i < manifold.getNumContacts(); ++i) {
      const btManifoldPoint& point = manifold.getContactPoint(i);
      const btVector3 middle =
          (point.getPositionWorldOnA() + point.getPositionWorldOnB()) * btScalar(0.5);
      const btVector3 friction = -(point.m_appliedImpulseLateral1 * point.m_lateralFrictionDir1 +
                                   point.m_appliedImpulseLateral2 * point.m_lateralFrictionDir2);
      const bool is_active = point.getDistance() <= 0 || point.getAppliedImpulse() != 0;
      touches.push_back(
          {a,
           b,
           {vector_of(middle), double(point.getDistance()), -vector_of(point.m_normalWorldOnB)},
           trace::Impulse{double(point.getAppliedImpulse()), vector_of(friction)},
           is_active});
    }
  }

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  std::unordered_map<const Mesh<double>*, BulletMesh> meshes_;
  std::vector<std::unique_ptr<BulletShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
  std::vector<std::pair<int, BodyMotion>> driven_;
};

}  // namespace

RolloutEngine bullet_rollout() {
  const std::string version =
      std::to_string(BT_BULLET_VERSION / 100) + "." + std::to_string(BT_BULLET_VERSION % 100);
  return {"Bullet", version, Vec3d::UnitY(),
          [](const std::vector<Piece>& pieces, const Vec3d& g, double) {
            return std::make_unique<BulletWorld>(pieces, g);
          }};
}

}  // namespace contactscope::peers
