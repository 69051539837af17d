// A stack of crates in Bullet, recorded: bullet_sample stack.jsonl
#define CONTACTSCOPE_IMPLEMENTATION
#include <contactscope/adapters/bullet.h>

int main(int count, char** arguments) {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity(btVector3(0, btScalar(-9.81), 0));

  contactscope::BulletRecorder recorder(&world, count > 1 ? arguments[1] : "stack.jsonl");

  btStaticPlaneShape ground_shape(btVector3(0, 1, 0), 0);
  btRigidBody ground(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &ground_shape));
  recorder.name(&ground, "ground");
  world.addRigidBody(&ground);
  btBoxShape crate_shape(btVector3(btScalar(0.5), btScalar(0.5), btScalar(0.5)));
  btVector3 inertia;
  crate_shape.calculateLocalInertia(10, inertia);
  std::vector<std::unique_ptr<btRigidBody>> crates;
  for (int i = 0; i < 4; ++i) {
    crates.emplace_back(new btRigidBody(
        btRigidBody::btRigidBodyConstructionInfo(10, nullptr, &crate_shape, inertia)));
    btTransform place = btTransform::getIdentity();
    place.setOrigin(btVector3(btScalar(0.05) * btScalar(i), btScalar(i) + btScalar(0.5), 0));
    crates.back()->setWorldTransform(place);
    world.addRigidBody(crates.back().get());
  }
  for (int i = 0; i < 60; ++i) world.stepSimulation(btScalar(1.0 / 60), 0);
}
