#include "adapters/bullet.h"

#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>
#include <memory>
#include <set>

#include "adapters/judge.h"
#include "app/cli/catalogue.h"
#include "support/temporary_folder.h"

namespace contactscope::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

const Vec3d kGravity(0, -9.81, 0);

/// A world with a recorder, and the objects in it.
class BulletScene {
 public:
  BulletScene() : world_(&dispatcher_, &broadphase_, &solver_, &configuration_) {
    world_.setGravity(vector_of(kGravity));
  }
  ~BulletScene() {
    recorder_.reset();
    for (const auto& body : bodies_)
      if (body->getBroadphaseHandle() != nullptr) world_.removeRigidBody(body.get());
  }

  static btVector3 vector_of(const Vec3d& v) {
    return btVector3(btScalar(v.x()), btScalar(v.y()), btScalar(v.z()));
  }

  btDiscreteDynamicsWorld& world() { return world_; }
  BulletRecorder& recorder() {
    if (!recorder_)
      recorder_ = std::make_unique<BulletRecorder>(world_, (folder_ / "run.jsonl").c_str());
    return *recorder_;
  }

  template <class Shape, class... Arguments> Shape* shape(Arguments&&... arguments) {
    auto made = std::make_unique<Shape>(std::forward<Arguments>(arguments)...);
    Shape* plain = made.get();
    shapes_.push_back(std::move(made));
    return plain;
  }
  btBoxShape* box(double x, double y, double z) {
    return shape<btBoxShape>(vector_of(Vec3d(x, y, z)));
  }

  /// A mass of 0 makes a static body.
  btRigidBody* body(const std::string& name, btCollisionShape* shape, double mass, const Vec3d& at,
                    const Vec3d& velocity = Vec3d::Zero(),
                    const btQuaternion& turn = btQuaternion::getIdentity()) {
    btVector3 inertia(0, 0, 0);
    if (mass > 0) shape->calculateLocalInertia(btScalar(mass), inertia);
    bodies_.push_back(std::make_unique<btRigidBody>(
        btRigidBody::btRigidBodyConstructionInfo(btScalar(mass), nullptr, shape, inertia)));
    btRigidBody* body = bodies_.back().get();
    body->setWorldTransform(btTransform(turn, vector_of(at)));
    body->setInterpolationWorldTransform(
        body->getWorldTransform());  // otherwise it starts at the origin
    body->setLinearVelocity(vector_of(velocity));
    recorder().name(body, name);
    world_.addRigidBody(body);
    return body;
  }

  void step(int steps) {
    recorder();
    for (int i = 0; i < steps; ++i) world_.stepSimulation(btScalar(1.0 / 60), 0);
  }

  trace::Trace trace() {
    recorder_.reset();
    return app::load_trace(folder_ / "run.jsonl");
  }

 private:
  TemporaryFolder folder_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
  std::unique_ptr<BulletRecorder> recorder_;
};

/// Boxes, spheres and planes use formulas in float; shapes that use GJK stop at 1e-4.
constexpr Promise kExact{.surface = 5e-6, .along = 2e-4, .best = 2e-4};

void expect_momentum(const trace::Trace& trace) {
  const std::map<std::string, double> errors = momentum_errors(trace, kGravity);
  EXPECT_FALSE(errors.empty());
  for (const auto& [body, error] : errors) EXPECT_LT(error, 1e-5) << body;
}

const trace::Shape& shape_of(const trace::Trace& trace, const std::string& name) {
  const auto shape = std::ranges::find(trace.header.shapes, name, &trace::Shape::name);
  if (shape == trace.header.shapes.end()) throw std::out_of_range(name);
  return *shape;
}

std::vector<std::string> names_of(const trace::Trace& trace) {
  std::vector<std::string> names;
  for (const trace::Shape& shape : trace.header.shapes) names.push_back(shape.name);
  return names;
}

std::vector<std::string> posed_in(const trace::Frame& frame) {
  std::vector<std::string> names;
  for (const trace::Placement& placement : frame.poses) names.push_back(placement.first);
  return names;
}

/// Five crates, each slightly offset from the one below, on a static ground.
void add_stack(BulletScene& scene, double speed_of_the_last) {
  scene.body("ground", scene.box(5, 0.5, 5), 0, {0, -0.5, 0});
  btBoxShape* crate = scene.box(0.5, 0.25, 0.4);
  for (int i = 0; i < 5; ++i)
    scene.body("crate " + std::to_string(i), crate, 2 + i, {0.05 * i, 0.25 + 0.5 * i, 0},
               {0, 0, i == 4 ? speed_of_the_last : 0});
}

TEST(BulletAdapter, AStackOfBoxes) {
  BulletScene scene;
  add_stack(scene, 0);
  scene.step(90);
  const trace::Trace trace = scene.trace();
  EXPECT_EQ(trace.header.engine, "Bullet");
  EXPECT_EQ(trace.header.version, "3.24");
  EXPECT_EQ(trace.header.scalar, sizeof(btScalar) == 4 ? "float" : "double");
  EXPECT_EQ(trace.header.up, "y");
  EXPECT_EQ(trace.header.poses_at, "before_step");
  ASSERT_EQ(trace.frames.size(), 90u);
  EXPECT_NEAR(trace.frames[89].time, 89 / 60.0, 1e-5);
  EXPECT_EQ(trace.frames[0].solver->iterations, 10);
  EXPECT_TRUE(trace.frames[0].solver->warm_start);
  expect_right(trace, kExact);
  expect_momentum(trace);
  // The whole stack rests on the ground.
  const double weight = (2 + 3 + 4 + 5 + 6) * 9.81 / 60;
  Vec3d on_ground = Vec3d::Zero();
  for (int i = 80; i < 90; ++i)
    on_ground += impulse_on(trace, trace.frames.at(std::size_t(i)), "ground") / 10;
  EXPECT_LT((on_ground - Vec3d(0, -weight, 0)).norm(), 0.01 * weight);
}

/// Errors in the recorded facts would be found.
TEST(BulletAdapter, LatePosesAndTurnedNormalsWouldBeSeen) {
  BulletScene scene;
  scene.body("ground", scene.box(5, 0.5, 5), 0, {0, -0.5, 0});
  scene.body("crate", scene.box(0.5, 0.5, 0.5), 2, {0, 0.495, 0}, {1, 0, 0});
  scene.step(30);
  const trace::Trace trace = scene.trace();
  const PairNames pair{"ground", "crate"};
  EXPECT_LT(judge(trace)[pair].surface, kExact.surface);
  EXPECT_GT(judge(with_late_poses(trace))[pair].surface, 100 * kExact.surface);
  EXPECT_GT(judge(with_turned_normals(trace))[pair].best, 0.5);
}

TEST(BulletAdapter, RoundBodies) {
  BulletScene scene;
  scene.body("ground", scene.shape<btStaticPlaneShape>(btVector3(0, 1, 0), btScalar(0.25)), 0,
             {0, -0.25, 0});
  scene.body("table", scene.box(2, 0.5, 2), 0, {0, 0.5, 0});
  scene.body("pill", scene.shape<btCapsuleShapeX>(btScalar(0.2), btScalar(1)), 3, {0, 1.2, 0},
             {0.5, 0, 0.3});
  scene.body("ball", scene.shape<btSphereShape>(btScalar(0.3)), 2, {4, 0.35, 0}, {0, 0, 1});
  scene.body("marble", scene.shape<btSphereShape>(btScalar(0.1)), 1, {1, 1.1, 1}, {-1, 0, 0});
  scene.step(90);
  const trace::Trace trace = scene.trace();
  expect_right(trace, kExact);
  expect_momentum(trace);
  EXPECT_EQ(shape_of(trace, "pill").type, "capsule");
  EXPECT_EQ(trace.frames.back().pairs.size(), 3u);
}

/// Cylinders and cones become hulls with 64 corners around, up to 0.12 % of the radius inside.
TEST(BulletAdapter, CylindersAndConesAreHulls) {
  BulletScene scene;
  scene.body("ground", scene.box(5, 0.5, 5), 0, {3, -0.5, 0});
  scene.body("drum", scene.shape<btCylinderShape>(btVector3(0.4f, 0.3f, 0.4f)), 2, {0, 0.31, 0});
  scene.body("roll", scene.shape<btCylinderShapeZ>(btVector3(0.4f, 0.4f, 0.3f)), 2, {2, 0.4, 0},
             {0.5, 0, 0});
  btConeShape* cone = scene.shape<btConeShape>(btScalar(0.4), btScalar(0.6));
  const btScalar margin = cone->getMargin();
  scene.body("cone", cone, 2, {4, 0.3 + double(margin), 0});
  scene.step(60);
  const trace::Trace trace = scene.trace();
  EXPECT_EQ(shape_of(trace, "drum").type, "cylinder");
  EXPECT_EQ(shape_of(trace, "cone").type, "cone");
  EXPECT_NEAR(shape_of(trace, "cone").margin, double(margin), 1e-9);
  expect_right(trace, {.surface = 6e-4, .along = 6e-4, .best = 6e-4});
  expect_momentum(trace);
}

btConvexHullShape* wedge(BulletScene& scene) {
  btConvexHullShape* hull = scene.shape<btConvexHullShape>();
  for (const Vec3d& v : {Vec3d(-0.5, -0.3, -0.4), Vec3d(0.5, -0.3, -0.4), Vec3d(0.5, -0.3, 0.4),
                         Vec3d(-0.5, -0.3, 0.4), Vec3d(0, 0.4, -0.3), Vec3d(0, 0.4, 0.3)})
    hull->addPoint(BulletScene::vector_of(v));
  return hull;
}

/// A ground of triangles: level, and a slope from x = 2 on.
struct MeshGround {
  std::vector<btVector3> vertices;
  std::vector<int> indices;
  std::unique_ptr<btTriangleIndexVertexArray> array;

  MeshGround() {
    for (int x = -2; x <= 4; ++x)
      for (int z = -2; z <= 2; ++z)
        vertices.emplace_back(btScalar(x), btScalar(x > 2 ? 0.4 * (x - 2) : 0), btScalar(z));
    for (int x = 0; x < 6; ++x)
      for (int z = 0; z < 4; ++z) {
        const int i = 5 * x + z;
        indices.insert(indices.end(), {i, i + 1, i + 6, i, i + 6, i + 5});
      }
    array = std::make_unique<btTriangleIndexVertexArray>(
        int(indices.size() / 3), indices.data(), int(3 * sizeof(int)), int(vertices.size()),
        &vertices[0].m_floats[0], int(sizeof(btVector3)));
  }
};

/// A hull's margin is outside its points: 40 mm by default.
TEST(BulletAdapter, AHullWithAMarginOnAMesh) {
  const MeshGround ground;
  BulletScene scene;
  scene.body("ground", scene.shape<btBvhTriangleMeshShape>(ground.array.get(), true), 0, {0, 0, 0});
  btConvexHullShape* hull = wedge(scene);
  scene.body("wedge", hull, 2, {0.1, 0.34, 0.1}, {0.3, 0, 0});
  btConvexHullShape* small = wedge(scene);
  small->setLocalScaling(btVector3(0.5f, 0.5f, 0.5f));
  small->setMargin(btScalar(0.01));
  scene.body("small", small, 1, {3.2, 0.75, 0.3});
  scene.body("ball", scene.shape<btSphereShape>(btScalar(0.3)), 1, {-1.2, 0.29, -1});
  scene.step(90);
  const trace::Trace trace = scene.trace();
  EXPECT_NEAR(shape_of(trace, "wedge").margin, 0.04, 1e-6);
  EXPECT_NEAR(shape_of(trace, "small").margin, 0.01, 1e-6);
  EXPECT_NEAR(shape_of(trace, "small").vertices[0].x(), -0.25, 1e-6);
  EXPECT_EQ(shape_of(trace, "ground").faces.size(), 48u);
  // Bullet tests triangles alone, unless a callback fixes edges within the surface.
  expect_right(trace, {.surface = 2e-4, .along = 2e-4}, {}, {"internal_edge"});
  expect_momentum(trace);
  EXPECT_EQ(trace.frames.back().pairs.size(), 3u);
  for (const trace::Frame& frame : trace.frames)
    for (const trace::Pair& pair : frame.pairs)
      for (const trace::Manifold& manifold : pair.manifolds) {
        // The named triangle is the one below.
        ASSERT_TRUE(manifold.triangle);
        const trace::Shape& mesh = shape_of(trace, "ground");
        const std::vector<int>& face = mesh.faces.at(std::size_t(*manifold.triangle));
        const auto corner = [&](std::size_t k) { return mesh.vertices.at(std::size_t(face[k])); };
        const Vec3d up = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
        for (const trace::Point& point : manifold.points)
          EXPECT_LT(std::abs(up.dot(*point.on_a - corner(0))), 2e-4);
      }
}

TEST(BulletAdapter, CompoundsAreRecordedByPart) {
  BulletScene scene;
  btCompoundShape* floor = scene.shape<btCompoundShape>();
  floor->addChildShape(btTransform(btQuaternion::getIdentity(), btVector3(-2, -0.5f, 0)),
                       scene.box(2, 0.5, 2));
  floor->addChildShape(btTransform(btQuaternion::getIdentity(), btVector3(2, -0.5f, 0)),
                       scene.box(2, 0.5, 2));
  scene.body("floor", floor, 0, {0, 0, 0});
  btCompoundShape* inner = scene.shape<btCompoundShape>();
  inner->addChildShape(btTransform(btQuaternion::getIdentity(), btVector3(0, 0, 0.3f)),
                       scene.box(0.1, 0.2, 0.1));
  inner->addChildShape(btTransform(btQuaternion::getIdentity(), btVector3(0, 0, -0.3f)),
                       scene.box(0.1, 0.2, 0.1));
  btCompoundShape* table = scene.shape<btCompoundShape>();
  table->addChildShape(btTransform(btQuaternion::getIdentity(), btVector3(0, 0.25f, 0)),
                       scene.box(0.6, 0.05, 0.5));
  table->addChildShape(btTransform(btQuaternion(btVector3(0, 1, 0), 0.3f), btVector3(-0.4f, 0, 0)),
                       inner);
  table->addChildShape(btTransform(btQuaternion::getIdentity(), btVector3(0.4f, 0, 0)),
                       scene.shape<btSphereShape>(btScalar(0.2)));
  scene.body("table", table, 6, {0.3, 0.2, 0}, {0.2, 0, 0});
  scene.step(60);
  const trace::Trace trace = scene.trace();
  EXPECT_THAT(names_of(trace),
              ElementsAre("floor/0", "floor/1", "table/0", "table/1/0", "table/1/1", "table/2"));
  EXPECT_EQ(shape_of(trace, "table/1/0").body, "table");
  // If boxes are clipped at the side of another one, Bullet's points are about 30 um off it.
  expect_right(trace, {.surface = 1e-4, .along = 2e-4, .best = 2e-4});
  expect_momentum(trace);
  std::set<PairNames> met;
  for (const auto& [names, claims] : judge(trace)) met.insert(names);
  EXPECT_THAT(met, Contains(PairNames("floor/0", "table/1/0")));
  EXPECT_THAT(met, Contains(PairNames("floor/0", "table/1/1")));
  EXPECT_THAT(met, Contains(PairNames("floor/1", "table/2")));
}

TEST(BulletAdapter, HeightFieldsAreMeshes) {
  for (const int up : {1, 2}) {
    BulletScene scene;
    std::vector<float> heights;
    for (int y = 0; y < 6; ++y)
      for (int x = 0; x < 5; ++x) heights.push_back(0.1f * float((x * x + 2 * y) % 5));
    Vec3d gravity = Vec3d::Zero();
    gravity[up] = -9.81;
    scene.world().setGravity(BulletScene::vector_of(gravity));
    scene.body(
        "hills",
        scene.shape<btHeightfieldTerrainShape>(5, 6, heights.data(), btScalar(1), btScalar(0),
                                               btScalar(0.4), up, PHY_FLOAT, false),
        0, {0, 0, 0});
    Vec3d above = Vec3d::Constant(0.1);
    above[up] = 0.5;
    scene.body("ball", scene.shape<btSphereShape>(btScalar(0.3)), 1, above);
    scene.step(60);
    const trace::Trace trace = scene.trace();
    EXPECT_EQ(trace.header.up, up == 1 ? "y" : "z");
    const trace::Shape& hills = shape_of(trace, "hills");
    EXPECT_EQ(hills.faces.size(), 40u);
    for (const std::vector<int>& face : hills.faces) {
      const auto corner = [&](std::size_t k) { return hills.vertices.at(std::size_t(face[k])); };
      EXPECT_GT((corner(1) - corner(0)).cross(corner(2) - corner(0))[up], 0.9);
    }
    // Points of earlier frames persist with their old normals.
    expect_right(trace, {.surface = 2e-4, .along = 1e-3});
  }
}

/// Kinematic bodies, sensors and sleeping bodies.
TEST(BulletAdapter, KinematicBodiesSensorsAndSleepers) {
  BulletScene scene;
  scene.body("ground", scene.box(5, 0.5, 5), 0, {0, -0.5, 0});
  btRigidBody* lift = scene.body("lift", scene.box(0.5, 0.1, 0.5), 0, {0, 0.1, 0});
  lift->setCollisionFlags(lift->getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
  lift->setActivationState(DISABLE_DEACTIVATION);
  scene.body("crate", scene.box(0.3, 0.3, 0.3), 2, {0, 0.5, 0});
  btRigidBody* sleeper = scene.body("sleeper", scene.box(0.3, 0.3, 0.3), 2, {3, 0.3, 0});
  btRigidBody* gate = scene.body("gate", scene.box(0.2, 0.2, 0.2), 0, {3, 0.5, 0});
  gate->setCollisionFlags(gate->getCollisionFlags() | btCollisionObject::CF_NO_CONTACT_RESPONSE);
  for (int i = 0; i < 60; ++i) {
    if (i == 40) sleeper->forceActivationState(ISLAND_SLEEPING);
    lift->setWorldTransform(
        btTransform(btQuaternion::getIdentity(), btVector3(0, btScalar(0.1 + 0.005 * i), 0)));
    scene.step(1);
  }
  const trace::Trace trace = scene.trace();
  // The crate is lifted: kinematic bodies also have the poses of their contacts.
  expect_right(trace, kExact);
  trace::Trace awake = trace;
  awake.frames.resize(40);
  expect_momentum(awake);
  EXPECT_EQ(judge(trace)[PairNames("lift", "crate")].frames, 60);
  for (const trace::Frame& frame : trace.frames)
    for (const trace::Pair& pair : frame.pairs)
      for (const trace::Manifold& manifold : pair.manifolds)
        for (const trace::Point& point : manifold.points) {
          const bool is_gate = pair.b == "gate",
                     is_asleep = pair.b == "sleeper" && frame.frame >= 40;
          EXPECT_TRUE(point.active || is_gate);
          EXPECT_EQ(point.impulse.has_value(), !is_gate && !is_asleep) << pair.b;
        }
  EXPECT_EQ(trace.frames.back().solver->bodies.size(), 2u);
}

/// Reused memory for another body, another shape of a body, and one that leaves and comes back.
TEST(BulletAdapter, BodiesComeAndGo) {
  BulletScene scene;
  btBoxShape* crate = scene.box(0.5, 0.5, 0.5);
  const btRigidBody::btRigidBodyConstructionInfo info(1, nullptr, crate, btVector3(1, 1, 1));
  alignas(btRigidBody) unsigned char memory[sizeof(btRigidBody)];
  btRigidBody* first = new (memory) btRigidBody(info);
  scene.world().addRigidBody(first);
  scene.step(1);
  scene.world().removeRigidBody(first);
  scene.step(1);
  scene.world().addRigidBody(first);
  scene.step(1);
  scene.world().removeRigidBody(first);
  first->~btRigidBody();
  btRigidBody* second = new (memory) btRigidBody(info);
  ASSERT_EQ(first, second);
  scene.world().addRigidBody(second);
  scene.step(1);
  second->setCollisionShape(scene.shape<btSphereShape>(btScalar(0.5)));
  scene.step(1);
  scene.world().removeRigidBody(second);
  second->~btRigidBody();
  const trace::Trace trace = scene.trace();
  ASSERT_EQ(trace.frames.size(), 5u);
  std::vector<std::vector<std::string>> there;
  for (const trace::Frame& frame : trace.frames) there.push_back(posed_in(frame));
  EXPECT_THAT(there, ElementsAre(ElementsAre("box 1"), ElementsAre(), ElementsAre("box 2"),
                                 ElementsAre("box 3"), ElementsAre("sphere 4")));
}

int ticks = 0;

/// The world's own callbacks are called with their pointer, and are restored in the end.
TEST(BulletAdapter, CallbacksOfTheWorldStay) {
  BulletScene scene;
  ticks = 0;
  const auto before = [](btDynamicsWorld* world, btScalar) {
    EXPECT_EQ(world->getWorldUserInfo(), &ticks);
    ++ticks;
  };
  const auto after = [](btDynamicsWorld* world, btScalar) {
    EXPECT_EQ(world->getWorldUserInfo(), &ticks);
    ticks += 100;
  };
  scene.world().setInternalTickCallback(before, &ticks, true);
  scene.world().setInternalTickCallback(after, &ticks);
  scene.body("ball", scene.shape<btSphereShape>(btScalar(0.5)), 1, {0, 0, 0});
  scene.step(3);
  EXPECT_EQ(ticks, 303);
  EXPECT_EQ(scene.trace().frames.size(), 3u);
  scene.step(2);  // with a new recorder
  EXPECT_EQ(scene.trace().frames.size(), 2u);
  scene.world().stepSimulation(btScalar(1.0 / 60), 0);
  EXPECT_EQ(ticks, 606);
}

/// Points that persist in Bullet stay with their bodies and slide from each other, by up to 20 mm,
/// until they are dropped. The midpoint is then outside a shape if they are at its edge.
TEST(BulletAdapter, KnownFaultPersistedPointsDrift) {
  BulletScene scene;
  add_stack(scene, 1);
  scene.step(30);
  const trace::Trace trace = scene.trace();
  expect_right(trace, kExact);  // lint measures such points at on_a and on_b
  const Claims claims = judge(trace)[PairNames("crate 3", "crate 4")];
  EXPECT_LT(claims.surface, kExact.surface);  // each side alone is on its surface
  EXPECT_GT(claims.off_a, 5e-3);
}

/// Hulls with polyhedral features are clipped against each other without their margins, but have
/// them against all other shapes. So when Bullet reports touching, both margins overlap.
TEST(BulletAdapter, KnownFaultHullsWithFeaturesAreClippedWithoutTheirMargins) {
  BulletScene scene;
  scene.body("ground", scene.shape<btStaticPlaneShape>(btVector3(0, 1, 0), btScalar(0)), 0,
             {0, 0, 0});
  for (int i = 0; i < 2; ++i) {
    btConvexHullShape* hull = scene.shape<btConvexHullShape>();
    for (int k = 0; k < 8; ++k)
      hull->addPoint(btVector3(k & 1 ? 0.5f : -0.5f, k & 2 ? 0.5f : -0.5f, k & 4 ? 0.5f : -0.5f));
    hull->initializePolyhedralFeatures();
    scene.body(i == 0 ? "lower" : "upper", hull, 2, {0.02 * i, 0.54 + 1.04 * i, 0});
  }
  scene.step(60);
  const trace::Trace trace = scene.trace();
  expect_right(trace, kExact, {{"lower", "upper"}}, {"surface", "overlap_without_contact"});
  const Claims claims = judge(trace)[{"lower", "upper"}];
  EXPECT_NEAR(claims.along, 0.08, 2e-3);
}

TEST(BulletAdapter, TheSampleIsRecorded) {
  const TemporaryFolder folder;
  const std::string file = folder / "stack.jsonl";
  ASSERT_EQ(std::system((CONTACTSCOPE_BINARY_DIR "/tests/bullet_sample '" + file + "'").c_str()),
            0);
  EXPECT_LE(lines_for_the_recorder("bullet_sample.cpp"), 4);
  const trace::Trace trace = app::load_trace(file);
  EXPECT_EQ(trace.frames.size(), 60u);
  expect_right(trace, kExact);
  expect_momentum(trace);
}

}  // namespace
}  // namespace contactscope::test
