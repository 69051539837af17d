// A scene in Bullet, recorded by the C++ adapter, and printed as PyBullet's functions return it:
//   bullet_facts OUT.jsonl
// python_test.py gives these numbers to contactscope.py and compares the two traces. PyBullet cannot
// be tested itself: no Debian package has it. Its server reads the same fields of Bullet (functions
// extractCollisionShapes and processRequestContactpointInformationCommand of PyBullet 3.2).
#define CONTACTSCOPE_IMPLEMENTATION
#include "adapters/bullet.h"

namespace {

constexpr double kStep = 1.0 / 60;

void print(const btVector3& v) {
  std::printf("[%.17g,%.17g,%.17g]", double(v.x()), double(v.y()), double(v.z()));
}

void print(const btQuaternion& q) {
  std::printf("[%.17g,%.17g,%.17g,%.17g]", double(q.x()), double(q.y()), double(q.z()),
              double(q.w()));
}

/// A type of pybullet.GEOM_SPHERE ..., dimensions, the frame in the body, and vertices of meshes.
void print_shape(int type, const btVector3& size, const btTransform& in_body,
                 const btConvexHullShape* hull) {
  std::printf("{\"type\":%d,\"size\":", type);
  print(size);
  std::printf(",\"position\":");
  print(in_body.getOrigin());
  std::printf(",\"turn\":");
  print(in_body.getRotation());
  std::printf(",\"vertices\":[");
  for (int i = 0; hull && i < hull->getNumVertices(); ++i) {
    btVector3 vertex;
    hull->getVertex(i, vertex);
    if (i > 0) std::printf(",");
    print(in_body * vertex);
  }
  std::printf("]}");
}

void print_shapes(const btCollisionShape* shape, const btTransform& in_body) {
  switch (shape->getShapeType()) {
    case STATIC_PLANE_PROXYTYPE:
      return print_shape(6, static_cast<const btStaticPlaneShape*>(shape)->getPlaneNormal(),
                         in_body, nullptr);
    case SPHERE_SHAPE_PROXYTYPE: {
      const btScalar radius = static_cast<const btSphereShape*>(shape)->getRadius();
      return print_shape(2, btVector3(radius, radius, radius), in_body, nullptr);
    }
    case BOX_SHAPE_PROXYTYPE:
      return print_shape(3, 2 * static_cast<const btBoxShape*>(shape)->getHalfExtentsWithMargin(),
                         in_body, nullptr);
    case CYLINDER_SHAPE_PROXYTYPE: {
      const btVector3 half =
          static_cast<const btCylinderShapeZ*>(shape)->getHalfExtentsWithMargin();
      return print_shape(4, btVector3(2 * half.z(), half.x(), 0), in_body, nullptr);
    }
    case CAPSULE_SHAPE_PROXYTYPE: {
      const btCapsuleShape* capsule = static_cast<const btCapsuleShape*>(shape);
      return print_shape(7, btVector3(2 * capsule->getHalfHeight(), capsule->getRadius(), 0),
                         in_body, nullptr);
    }
    case CONVEX_HULL_SHAPE_PROXYTYPE:
      return print_shape(5, btVector3(1, 1, 1), in_body,
                         static_cast<const btConvexHullShape*>(shape));
    default: {
      const btCompoundShape* compound = static_cast<const btCompoundShape*>(shape);
      for (int i = 0; i < compound->getNumChildShapes(); ++i) {
        if (i > 0) std::printf(",");
        print_shapes(compound->getChildShape(i), in_body * compound->getChildTransform(i));
      }
    }
  }
}

void print_contacts(const btDispatcher& dispatcher) {
  const char* comma = "";
  for (int i = 0; i < const_cast<btDispatcher&>(dispatcher).getNumManifolds(); ++i) {
    const btPersistentManifold* manifold =
        const_cast<btDispatcher&>(dispatcher).getManifoldByIndexInternal(i);
    for (int j = 0; j < manifold->getNumContacts(); ++j) {
      const btManifoldPoint& point = manifold->getContactPoint(j);
      std::printf("%s[0,%d,%d,-1,-1,", comma, manifold->getBody0()->getUserIndex(),
                  manifold->getBody1()->getUserIndex());
      print(point.getPositionWorldOnA());
      std::printf(",");
      print(point.getPositionWorldOnB());
      std::printf(",");
      print(point.m_normalWorldOnB);
      std::printf(",%.17g,%.17g,%.17g,", double(point.getDistance()),
                  double(point.getAppliedImpulse()) / kStep,
                  double(point.m_appliedImpulseLateral1) / kStep);
      print(point.m_lateralFrictionDir1);
      std::printf(",%.17g,", double(point.m_appliedImpulseLateral2) / kStep);
      print(point.m_lateralFrictionDir2);
      std::printf("]");
      comma = ",";
    }
  }
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 2) return 2;
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity(btVector3(0, 0, btScalar(-9.81)));
  contactscope::BulletRecorder recorder(world, arguments[1]);

  btStaticPlaneShape plane(btVector3(0, 0, 1), 0);
  btBoxShape box(btVector3(btScalar(0.5), btScalar(0.4), btScalar(0.3)));
  btSphereShape ball(btScalar(0.3));
  btCapsuleShapeZ pill(btScalar(0.2), btScalar(0.8));
  btCylinderShapeZ drum(btVector3(btScalar(0.4), btScalar(0.4), btScalar(0.3)));
  btConvexHullShape rock;
  for (int i = 0; i < 8; ++i)
    rock.addPoint(btVector3(btScalar(i & 1 ? 0.5 : -0.5), btScalar(i & 2 ? 0.4 : -0.3),
                            btScalar(i & 4 ? 0.3 + 0.02 * i : -0.3)));
  btBoxShape handle(btVector3(btScalar(0.6), btScalar(0.1), btScalar(0.1)));
  btCompoundShape hammer;
  hammer.addChildShape(btTransform(btQuaternion::getIdentity(), btVector3(btScalar(0.7), 0, 0)),
                       &ball);
  hammer.addChildShape(btTransform(btQuaternion(btVector3(0, 0, 1), btScalar(0.3)),
                                   btVector3(0, btScalar(0.1), btScalar(-0.1))),
                       &handle);
  struct Body {
    const char* name;
    btCollisionShape* shape;
    double mass, x, z, turn;
  };
  const Body bodies[] = {
      {"ground", &plane, 0, 0, 0, 0},      {"crate", &box, 10, 0, 0.29, 0},
      {"upper", &box, 5, 0.2, 0.88, 0.3},  {"ball", &ball, 3, 2, 0.29, 0},
      {"pill", &pill, 2, 4, 0.19, 1.5708}, {"drum", &drum, 4, 6, 0.29, 0},
      {"rock", &rock, 4, 8, 0.4, 0},       {"hammer", &hammer, 6, 11, 0.32, 0.05}};
  std::vector<std::unique_ptr<btRigidBody>> objects;
  std::printf("{\"bodies\":[");
  for (const Body& body : bodies) {
    btVector3 inertia(0, 0, 0);
    if (body.mass > 0) body.shape->calculateLocalInertia(btScalar(body.mass), inertia);
    objects.emplace_back(new btRigidBody(btRigidBody::btRigidBodyConstructionInfo(
        btScalar(body.mass), nullptr, body.shape, inertia)));
    btRigidBody& object = *objects.back();
    object.setWorldTransform(btTransform(btQuaternion(btVector3(0, 1, 0), btScalar(body.turn)),
                                         btVector3(btScalar(body.x), 0, btScalar(body.z))));
    object.setUserIndex(int(objects.size()) - 1);
    object.setActivationState(DISABLE_DEACTIVATION);
    recorder.name(&object, body.name);
    world.addRigidBody(&object);
    std::printf("%s{\"name\":\"%s\",\"mass\":%.17g,\"margin\":%.17g,\"shapes\":[",
                objects.size() > 1 ? "," : "", body.name, body.mass,
                double(body.shape->getMargin()));
    print_shapes(body.shape, btTransform::getIdentity());
    std::printf("]}");
  }
  std::printf("]}\n");
  for (int i = 0; i < 40; ++i) {
    const char* comma = "";
    std::printf("{\"poses\":[");
    for (const auto& object : objects) {
      std::printf("%s[", comma);
      print(object->getWorldTransform().getOrigin());
      std::printf(",");
      print(object->getWorldTransform().getRotation());
      std::printf(",");
      print(object->getLinearVelocity());
      std::printf(",");
      print(object->getAngularVelocity());
      std::printf("]");
      comma = ",";
    }
    world.stepSimulation(btScalar(kStep), 0);
    std::printf("],\"contacts\":[");
    print_contacts(dispatcher);
    std::printf("]}\n");
  }
}
