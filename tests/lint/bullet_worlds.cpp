#include <memory>
#include <vector>

#include "adapters/bullet.h"
#include "lint/worlds.h"

namespace contactscope::test {
namespace {

btVector3 vector_of(double x, double y, double z) {
  return {btScalar(x), btScalar(y), btScalar(z)};
}

std::unique_ptr<btCollisionShape> shape_of(World world, int n) {
  // Persistent points of Bullet slide off unequal boxes.
  const int size = world == World::Stack ? 0 : n;
  const btVector3 half =
      vector_of(half_extent(size, 0), half_extent(size, 1), half_extent(size, 2));
  if (world == World::Stack || n % 4 == 0) return std::make_unique<btBoxShape>(half);
  if (n % 4 == 1) return std::make_unique<btSphereShape>(half.x());
  if (n % 4 == 2) return std::make_unique<btCapsuleShape>(half.x() / 2, half.y() * 2);
  auto hull = std::make_unique<btConvexHullShape>();
  for (int i = 0; i < 6; ++i) {  // a skewed octahedron
    btVector3 vertex(0, 0, 0);
    vertex[i / 2] = (i % 2 == 0 ? 1 : -1) * half[i / 2];
    vertex[(i / 2 + 1) % 3] = half.y() / 3;
    hull->addPoint(vertex);
  }
  hull->setMargin(btScalar(0.01));
  return hull;
}

}  // namespace

void record_in_bullet(const Recording& recording) {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity(vector_of(0, -9.81, 0));
  std::vector<std::unique_ptr<btCollisionShape>> shapes;
  std::vector<std::unique_ptr<btRigidBody>> bodies;
  const auto add = [&](std::unique_ptr<btCollisionShape> shape, double mass, const btVector3& at) {
    btVector3 inertia(0, 0, 0);
    if (mass > 0) shape->calculateLocalInertia(btScalar(mass), inertia);
    bodies.push_back(std::make_unique<btRigidBody>(
        btRigidBody::btRigidBodyConstructionInfo(btScalar(mass), nullptr, shape.get(), inertia)));
    btTransform pose = btTransform::getIdentity();
    pose.setOrigin(at);
    bodies.back()->setWorldTransform(pose);
    bodies.back()->setInterpolationWorldTransform(pose);
    shapes.push_back(std::move(shape));
    world.addRigidBody(bodies.back().get());
  };
  add(std::make_unique<btBoxShape>(vector_of(6, 0.5, 6)), 0, vector_of(0, -0.5, 0));
  const bool is_heap = recording.world == World::Heap;
  if (is_heap)
    for (int side = 0; side < 4; ++side) {
      const double x = side == 0 ? 1 : side == 1 ? -1 : 0, z = side == 2 ? 1 : side == 3 ? -1 : 0;
      add(std::make_unique<btBoxShape>(vector_of(x != 0 ? 0.5 : 3, 1, x != 0 ? 3 : 0.5)), 0,
          vector_of(2 * x, 1, 2 * z));
    }
  double top = 0;
  for (int n = 0; recording.world != World::Chains && n < recording.bodies; ++n) {
    const double height = half_extent(0, 1);
    if (is_heap)
      add(shape_of(recording.world, n), 2 + n % 3,
          vector_of(scattered(n, 0), 0.6 + 0.35 * n, scattered(n, 2)));
    else
      add(shape_of(recording.world, n), 2 + n % 3, vector_of(0.03 * n, top + height, 0.02 * n));
    top += 2 * height;
  }
  std::vector<std::unique_ptr<btTypedConstraint>> joints;
  const auto join = [&](std::unique_ptr<btTypedConstraint> joint) {
    world.addConstraint(joint.get(), true);
    joints.push_back(std::move(joint));
  };
  constexpr int kLinks = 5;
  for (int n = 0; recording.world == World::Chains && n < recording.bodies; ++n) {
    const int chain = n / kLinks, link = n % kLinks;
    const double half = 0.5 * half_extent(chain, 0), tilt = 0.9 * scattered(chain, 1);
    const btVector3 end = vector_of(0, half, 0);
    add(std::make_unique<btBoxShape>(vector_of(half / 3, half, half / 3)), 1 + n % 3,
        vector_of(scattered(chain, 0), 2, chain));
    btRigidBody& body = *bodies.back();
    btTransform pose(btQuaternion(vector_of(1, 0, 0.5).normalized(), btScalar(tilt)));
    pose.setOrigin(vector_of(scattered(chain, 0), 2, chain) -
                   pose.getBasis() * end * btScalar(2 * link));
    body.setWorldTransform(pose);
    body.setInterpolationWorldTransform(pose);
    if (link == 0)
      join(std::make_unique<btPoint2PointConstraint>(body, end));
    else
      join(std::make_unique<btPoint2PointConstraint>(*bodies[bodies.size() - 2], body, -end, end));
  }
  for (int i = 0; i < recording.unrecorded; ++i) world.stepSimulation(btScalar(1.0 / 60), 0);
  {
    BulletRecorder recorder(world, recording.path.c_str());
    for (int i = 0; i < recording.frames; ++i) world.stepSimulation(btScalar(1.0 / 60), 0);
  }
  for (const auto& joint : joints) world.removeConstraint(joint.get());
  for (const auto& body : bodies) world.removeRigidBody(body.get());
}

}  // namespace contactscope::test
