#include "adapters/ode.h"

#include <gmock/gmock.h>

#include <cstdlib>

#include "adapters/judge.h"
#include "app/cli/catalogue.h"
#include "support/temporary_folder.h"

namespace contactscope::test {
namespace {

using testing::ElementsAre;

const Vec3d kGravity(0, 0, -9.81);
constexpr double kStep = 0.01;

class OdeScene {
 public:
  explicit OdeScene(int (*solve)(dWorldID, dReal) = &dWorldQuickStep) : solve_(solve) {
    dInitODE2(0);
    world = dWorldCreate();
    space = dHashSpaceCreate(nullptr);
    contacts_ = dJointGroupCreate(0);
    dWorldSetGravity(world, kGravity.x(), kGravity.y(), kGravity.z());
    recorder = std::make_unique<OdeRecorder>(world, space, (folder_ / "run.jsonl").c_str());
  }
  ~OdeScene() {
    dJointGroupDestroy(contacts_);
    dSpaceDestroy(space);
    dWorldDestroy(world);
    dCloseODE();
  }

  dGeomID still(const std::string& name, dGeomID geom, const Vec3d& at) {
    recorder->name(geom, name);
    dGeomSetPosition(geom, at.x(), at.y(), at.z());
    return geom;
  }
  dBodyID body(double mass, const Vec3d& at, const Vec3d& velocity = Vec3d::Zero()) {
    const dBodyID body = dBodyCreate(world);
    dMass of;
    dMassSetBoxTotal(&of, mass, 0.6, 0.6, 0.6);
    dBodySetMass(body, &of);
    dBodySetPosition(body, at.x(), at.y(), at.z());
    dBodySetLinearVel(body, velocity.x(), velocity.y(), velocity.z());
    return body;
  }
  dBodyID moving(const std::string& name, dGeomID geom, double mass, const Vec3d& at,
                 const Vec3d& velocity = Vec3d::Zero()) {
    const dBodyID made = body(mass, at, velocity);
    dGeomSetBody(geom, made);
    recorder->name(geom, name);
    return made;
  }

  void step(int steps) {
    for (int i = 0; i < steps; ++i) {
      dSpaceCollide(space, this, &OdeScene::near);
      recorder->step(solve_, kStep);
      dJointGroupEmpty(contacts_);
    }
  }
  trace::Trace trace() {
    recorder.reset();
    return app::load_trace(folder_ / "run.jsonl");
  }

  dWorldID world;
  dSpaceID space;
  std::unique_ptr<OdeRecorder> recorder;
  bool swapped = false;  // bodies of joints in the reverse order of geoms
  bool makes_joints = true;

 private:
  static void near(void* data, dGeomID a, dGeomID b) {
    OdeScene* scene = static_cast<OdeScene*>(data);
    const dBodyID body_a = dGeomGetBody(a), body_b = dGeomGetBody(b);
    if (body_a == body_b) return;
    dContact found[32];
    const int count = dCollide(a, b, 32, &found[0].geom, sizeof(dContact));
    for (int i = 0; i < count; ++i) {
      dContact& contact = found[i];
      contact.surface = dSurfaceParameters();
      contact.surface.mu = 0.5;
      if (scene->swapped) {
        std::swap(contact.geom.g1, contact.geom.g2);
        std::swap(contact.geom.side1, contact.geom.side2);
        for (int k = 0; k < 3; ++k) contact.geom.normal[k] = -contact.geom.normal[k];
      }
      dJointID joint = nullptr;
      if (scene->makes_joints) {
        joint = dJointCreateContact(scene->world, scene->contacts_, &contact);
        dJointAttach(joint, dGeomGetBody(contact.geom.g1), dGeomGetBody(contact.geom.g2));
      }
      scene->recorder->contact(joint, contact.geom);
    }
  }

  TemporaryFolder folder_;
  int (*solve_)(dWorldID, dReal);
  dJointGroupID contacts_;
};

constexpr Promise kExact{.surface = 1e-9, .along = 1e-9, .best = 1e-9};
/// The deepest corner of a tilted box may be outside the face that clips it.
constexpr Promise kBoxes{.surface = 1e-9, .along = 3e-4, .best = 3e-4};

void expect_momentum(const trace::Trace& trace) {
  const std::map<std::string, double> errors = momentum_errors(trace, kGravity);
  EXPECT_FALSE(errors.empty());
  for (const auto& [body, error] : errors) EXPECT_LT(error, 1e-9) << body;
}

const trace::Shape& shape_of(const trace::Trace& trace, const std::string& name) {
  const auto shape = std::ranges::find(trace.header.shapes, name, &trace::Shape::name);
  if (shape == trace.header.shapes.end()) throw std::out_of_range(name);
  return *shape;
}

std::vector<std::string> posed_in(const trace::Frame& frame) {
  std::vector<std::string> names;
  for (const trace::Placement& placement : frame.poses) names.push_back(placement.first);
  return names;
}

TEST(OdeAdapter, AStackOfBoxes) {
  for (const bool swapped : {false, true})
    for (const auto solve : {&dWorldQuickStep, &dWorldStep}) {
      OdeScene scene(solve);
      scene.swapped = swapped;
      scene.still("ground", dCreateBox(scene.space, 10, 10, 1), {0, 0, -0.5});
      for (int i = 0; i < 4; ++i)
        scene.moving("crate " + std::to_string(i), dCreateBox(scene.space, 1, 0.8, 0.5), 2 + i,
                     {0.05 * i, 0, 0.249 + 0.498 * i}, {0, i == 3 ? 0.4 : 0.0, 0});
      scene.step(60);
      const trace::Trace trace = scene.trace();
      EXPECT_EQ(trace.header.engine, "ODE");
      EXPECT_EQ(trace.header.version, dODE_VERSION);
      EXPECT_EQ(trace.header.up, "z");
      EXPECT_EQ(trace.header.poses_at, "before_step");
      ASSERT_EQ(trace.frames.size(), 60u);
      EXPECT_EQ(trace.frames[0].solver->iterations, solve == &dWorldStep ? 0 : 20);
      expect_right(trace, kBoxes);
      expect_momentum(trace);
      const double weight = (2 + 3 + 4 + 5) * 9.81 * kStep;
      Vec3d on_ground = Vec3d::Zero();
      for (std::size_t i = 40; i < 60; ++i)
        on_ground += impulse_on(trace, trace.frames.at(i), "ground") / 20;
      EXPECT_LT((on_ground - Vec3d(0, 0, -weight)).norm(), 0.02 * weight);
    }
}

TEST(OdeAdapter, RoundBodies) {
  OdeScene scene;
  scene.recorder->name(dCreatePlane(scene.space, 0, 0, 1, 0.25), "ground");
  scene.still("table", dCreateBox(scene.space, 4, 4, 1), {0, 0, 0.75});
  dQuaternion lying = {std::sqrt(0.5), 0, std::sqrt(0.5), 0};
  dBodySetQuaternion(
      scene.moving("pill", dCreateCapsule(scene.space, 0.2, 1), 3, {0, 0, 1.44}, {0.3, 0.3, 0}),
      lying);
  scene.moving("ball", dCreateSphere(scene.space, 0.3), 2, {4, 0, 0.54}, {0, 1, 0});
  scene.moving("marble", dCreateSphere(scene.space, 0.1), 1, {1, 1, 1.34}, {-1, 0, 0});
  scene.moving("second", dCreateSphere(scene.space, 0.3), 1, {4.01, 0, 1.1});
  scene.step(90);
  const trace::Trace trace = scene.trace();
  expect_right(trace, kExact);
  expect_momentum(trace);
}

/// A pyramid with a square base, around its centre, in ODE's format.
struct Pyramid {
  std::vector<dReal> planes, points;
  std::vector<unsigned> polygons = {4, 0, 3, 2, 1, 3, 0, 1, 4, 3, 1, 2, 4, 3, 2, 3, 4, 3, 3, 0, 4};

  explicit Pyramid(double size) {
    points = {-1, -1, -0.5, 1, -1, -0.5, 1, 1, -0.5, -1, 1, -0.5, 0, 0, 1};
    for (dReal& x : points) x *= size;
    const double across = 1.5 / std::hypot(1.0, 1.5), up = 1 / std::hypot(1.0, 1.5);
    planes = {0,  0,         -1, 0.5 * size, 0,  -across,   up,      up * size, across, 0,
              up, up * size, 0,  across,     up, up * size, -across, 0,         up,     up * size};
  }
  dGeomID made(dSpaceID space) {
    return dCreateConvex(space, planes.data(), 5, points.data(), 5, polygons.data());
  }
};

struct MeshGround {
  std::vector<double> vertices;
  std::vector<dTriIndex> indices;
  dTriMeshDataID data = dGeomTriMeshDataCreate();

  MeshGround() {
    for (int x = -2; x <= 4; ++x)
      for (int y = -2; y <= 2; ++y)
        vertices.insert(vertices.end(), {1.0 * x, 1.0 * y, x > 2 ? 0.4 * (x - 2) : 0.0});
    for (dTriIndex x = 0; x < 6; ++x)
      for (dTriIndex y = 0; y < 4; ++y) {
        const dTriIndex i = 5 * x + y;
        indices.insert(indices.end(), {i, i + 5, i + 6, i, i + 6, i + 1});
      }
    dGeomTriMeshDataBuildDouble(data, vertices.data(), 3 * sizeof(double),
                                static_cast<int>(vertices.size() / 3), indices.data(),
                                static_cast<int>(indices.size()), 3 * sizeof(dTriIndex));
  }
  ~MeshGround() { dGeomTriMeshDataDestroy(data); }
};

TEST(OdeAdapter, BodiesOnAMesh) {
  OdeScene scene;
  MeshGround ground;
  dGeomID mesh = dCreateTriMesh(scene.space, ground.data, nullptr, nullptr, nullptr);
  scene.still("ground", mesh, {0.5, 0, -1});
  scene.moving("crate", dCreateBox(scene.space, 0.6, 0.6, 0.6), 2, {0, 0.1, -0.701}, {0.2, 0, 0});
  scene.moving("ball", dCreateSphere(scene.space, 0.3), 1, {-1, -1, -0.71});
  scene.step(60);
  const trace::Trace trace = scene.trace();
  EXPECT_EQ(shape_of(trace, "ground").vertices.size(), 35u);
  EXPECT_EQ(shape_of(trace, "ground").faces.size(), 48u);
  expect_right(trace, kExact);
  expect_momentum(trace);
}

/// If an end of a capsule passes through a triangle, ODE reports a second point there with depth 0,
/// although the capsule is as deep at this point.
TEST(OdeAdapter, KnownFaultACapsuleOnAMeshHasAPointWithoutDepth) {
  OdeScene scene;
  MeshGround ground;
  scene.still("ground", dCreateTriMesh(scene.space, ground.data, nullptr, nullptr, nullptr),
              {0, 0, 0});
  scene.moving("pill", dCreateCapsule(scene.space, 0.2, 0.5), 1, {-0.7, 0.4, 0.44});
  scene.step(1);
  const trace::Trace trace = scene.trace();
  const auto& manifolds = trace.frames.at(0).pairs.at(0).manifolds;
  std::vector<double> separations;
  for (const trace::Manifold& manifold : manifolds)
    for (const trace::Point& point : manifold.points) separations.push_back(point.separation);
  std::ranges::sort(separations);
  EXPECT_THAT(separations, ElementsAre(testing::DoubleNear(-0.01, 1e-12), 0));
  EXPECT_NEAR(judge(trace)[PairNames("pill", "ground")].middle, 0.01, 1e-9);
}

TEST(OdeAdapter, ConvexGeomsRecordTheirVertices) {
  OdeScene scene;
  scene.recorder->name(dCreatePlane(scene.space, 0, 0, 1, 0), "ground");
  Pyramid low(0.5), high(0.3);
  dGeomID tilted = high.made(scene.space);
  scene.moving("low", low.made(scene.space), 2, {0, 0, 0.249}, {0.2, 0, 0});
  dBodyID body = scene.moving("tilted", tilted, 1, {3, 0, 0.4});
  const dQuaternion turn = {std::cos(0.3), std::sin(0.3), 0, 0};
  dBodySetQuaternion(body, turn);
  scene.step(60);
  const trace::Trace trace = scene.trace();
  for (const auto& [name, size] : {std::pair("low", 0.5), std::pair("tilted", 0.3)}) {
    const trace::Shape& shape = shape_of(trace, name);
    EXPECT_EQ(shape.faces.size(), 5u);
    ASSERT_EQ(shape.vertices.size(), 5u);
    const Pyramid pyramid(size);
    for (const Vec3d& vertex : shape.vertices) {
      double nearest = 1;
      for (std::size_t k = 0; k < 5; ++k)
        nearest =
            std::min(nearest, (vertex - Vec3d(pyramid.points[3 * k], pyramid.points[3 * k + 1],
                                              pyramid.points[3 * k + 2]))
                                  .norm());
      EXPECT_LT(nearest, 1e-12);
    }
  }
  expect_right(trace, kExact);
  expect_momentum(trace);
}

TEST(OdeAdapter, CylindersAreHulls) {
  OdeScene scene;
  scene.recorder->name(dCreatePlane(scene.space, 0, 0, 1, 0), "ground");
  scene.moving("drum", dCreateCylinder(scene.space, 0.4, 0.6), 2, {0, 0, 0.299}, {0.2, 0, 0});
  scene.step(40);
  const trace::Trace trace = scene.trace();
  EXPECT_EQ(shape_of(trace, "drum").type, "cylinder");
  expect_right(trace, {.surface = 6e-4, .along = 6e-4, .best = 6e-4});
  expect_momentum(trace);
}

/// On a box, ODE replaces a cylinder's end by an octagon with corners 8 % of the radius outside.
TEST(OdeAdapter, KnownFaultACylinderOnABoxHasPointsOutsideIt) {
  OdeScene scene;
  scene.still("table", dCreateBox(scene.space, 2, 2, 1), {0, 0, 0});
  scene.moving("can", dCreateCylinder(scene.space, 0.2, 0.6), 2, {0, 0, 0.799});
  scene.step(1);
  const trace::Trace trace = scene.trace();
  EXPECT_NEAR(judge(trace)[PairNames("can", "table")].off_a, 0.2 * (1 / std::cos(M_PI / 8) - 1),
              2e-4);
  expect_right(trace, {.surface = 6e-4, .along = 6e-4, .best = 6e-4}, {{"can", "table"}},
               {"surface"});
}

/// A body with two geoms; one is turned in it.
TEST(OdeAdapter, GeomsOfOneBodyAreItsParts) {
  OdeScene scene;
  scene.recorder->name(dCreatePlane(scene.space, 0, 0, 1, 0), "ground");
  const dBodyID body = scene.body(3, {0, 0, 0.3}, {0.3, 0, 0});
  const dGeomID ball = dCreateSphere(scene.space, 0.3), box = dCreateBox(scene.space, 1, 0.2, 0.2);
  dGeomSetBody(ball, body);
  dGeomSetBody(box, body);
  dGeomSetOffsetPosition(box, 0.5, 0, 0);
  const dQuaternion turn = {std::cos(0.2), 0, std::sin(0.2), 0};
  dGeomSetOffsetQuaternion(box, turn);
  scene.recorder->name(body, "hammer");
  scene.recorder->name(ball, "head");
  scene.recorder->name(box, "handle");
  scene.step(60);
  const trace::Trace trace = scene.trace();
  EXPECT_EQ(shape_of(trace, "head").body, "hammer");
  EXPECT_EQ(shape_of(trace, "handle").body, "hammer");
  ASSERT_EQ(trace.frames[0].solver->bodies.size(), 1u);
  EXPECT_EQ(trace.frames[0].solver->bodies[0].name, "hammer");
  EXPECT_EQ(judge(trace).size(), 2u);
  expect_right(trace, kExact);
  expect_momentum(trace);
}

/// ODE does not expose the heights of its fields: without form() they are omitted, with a message.
TEST(OdeAdapter, HeightFieldsNeedTheirForm) {
  for (const bool is_named : {false, true}) {
    OdeScene scene;
    testing::internal::CaptureStderr();
    const std::vector<double> heights = {0, 0.1, 0, 0.2, 0, 0.1, 0, 0.1, 0};
    const dHeightfieldDataID data = dGeomHeightfieldDataCreate();
    dGeomHeightfieldDataBuildDouble(data, heights.data(), 0, 4, 4, 3, 3, 1, 0, 1, 0);
    const dGeomID field = dCreateHeightfield(scene.space, data, 1);
    dQuaternion upright = {std::sqrt(0.5), std::sqrt(0.5), 0, 0};  // its y axis to z
    dGeomSetQuaternion(field, upright);
    scene.still("hills", field, {0, 0, 0});
    scene.moving("ball", dCreateSphere(scene.space, 0.3), 1, {0.3, 0.2, 0.4});
    if (is_named) {
      std::vector<double> vertices;
      for (int z = 0; z < 3; ++z)
        for (int x = 0; x < 3; ++x)
          vertices.insert(vertices.end(),
                          {2.0 * x - 2, heights[std::size_t(3 * z + x)], 2.0 * z - 2});
      std::vector<int> triangles;
      for (int z = 0; z < 2; ++z)
        for (int x = 0; x < 2; ++x) {
          const int i = 3 * z + x;
          triangles.insert(triangles.end(), {i, i + 3, i + 1, i + 1, i + 3, i + 4});
        }
      scene.recorder->form(field, vertices, triangles);
    }
    scene.step(60);
    const trace::Trace trace = scene.trace();
    dGeomHeightfieldDataDestroy(data);
    const std::string record = testing::internal::GetCapturedStderr();
    EXPECT_EQ(record.find("height field") != std::string::npos, !is_named) << record;
    if (is_named)
      expect_right(trace, kExact);
    else
      EXPECT_TRUE(judge(trace).empty());
  }
}

TEST(OdeAdapter, GeomsComeAndGo) {
  OdeScene scene;
  const dSpaceID inner = dSimpleSpaceCreate(scene.space);
  const dGeomID ball = dCreateSphere(inner, 0.5);
  scene.step(1);
  dGeomDisable(ball);
  scene.step(1);
  dGeomEnable(ball);
  scene.step(1);
  dGeomSphereSetRadius(ball, 0.25);
  scene.step(1);
  dGeomDestroy(ball);
  dCreateBox(scene.space, 1, 1, 1);
  scene.step(1);
  const trace::Trace trace = scene.trace();
  std::vector<std::vector<std::string>> there;
  for (const trace::Frame& frame : trace.frames) there.push_back(posed_in(frame));
  EXPECT_THAT(there, ElementsAre(ElementsAre("sphere 1"), ElementsAre(), ElementsAre("sphere 2"),
                                 ElementsAre("sphere 3"), ElementsAre("box 4")));
}

/// Contacts without joints have no effect. The program's own feedback is not replaced.
TEST(OdeAdapter, ContactsWithoutJointsAreIdle) {
  OdeScene scene;
  scene.makes_joints = false;
  scene.recorder->name(dCreatePlane(scene.space, 0, 0, 1, 0), "ground");
  scene.moving("ball", dCreateSphere(scene.space, 0.5), 1, {0, 0, 0.45});
  scene.step(2);
  const trace::Trace trace = scene.trace();
  const trace::Point& point = trace.frames.at(1).pairs.at(0).manifolds.at(0).points.at(0);
  EXPECT_FALSE(point.active);
  EXPECT_FALSE(point.impulse);
}

TEST(OdeAdapter, TheSampleIsRecorded) {
  const TemporaryFolder folder;
  const std::string file = folder / "stack.jsonl";
  ASSERT_EQ(std::system((CONTACTSCOPE_BINARY_DIR "/tests/ode_sample '" + file + "'").c_str()), 0);
  EXPECT_LE(lines_for_the_recorder("ode_sample.cpp"), 8);
  const trace::Trace trace = app::load_trace(file);
  EXPECT_EQ(trace.frames.size(), 60u);
  // In one frame ODE leaves out a corner that overlaps.
  expect_right(trace, kBoxes, {}, {"points_flicker"});
  expect_momentum(trace);
}

}  // namespace
}  // namespace contactscope::test
