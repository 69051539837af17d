#include "adapters/fcl.h"

#include <fcl/narrowphase/collision.h>
#include <gmock/gmock.h>

#include <cstdlib>
#include <deque>
#include <memory>
#include <numbers>

#include "adapters/judge.h"
#include "app/cli/catalogue.h"
#include "support/temporary_folder.h"

namespace contactscope::test {
namespace {

using testing::ElementsAre;

fcl::Transform3d pose(const Vec3d& at, const Quatd& turn = Quatd::Identity()) {
  fcl::Transform3d result = fcl::Transform3d::Identity();
  result.linear() = turn.toRotationMatrix();
  result.translation() = at;
  return result;
}

Quatd about(const Vec3d& axis, double angle) { return Quatd(Eigen::AngleAxisd(angle, axis)); }

class FclScene {
 public:
  FclScene() : recorder_(std::make_unique<FclRecorder<double>>((folder_ / "run.jsonl").c_str())) {}

  template <class Geometry, class... Arguments>
  fcl::CollisionObjectd& add(const std::string& name, const fcl::Transform3d& at,
                             Arguments&&... arguments) {
    return add(name, at, std::make_shared<Geometry>(std::forward<Arguments>(arguments)...));
  }
  fcl::CollisionObjectd& add(const std::string& name, const fcl::Transform3d& at,
                             const std::shared_ptr<fcl::CollisionGeometryd>& geometry) {
    objects_.emplace_back(geometry, at);
    recorder_->name(objects_.back(), name);
    return objects_.back();
  }
  /// All pairs, in both orders.
  void collide() {
    for (const bool is_swapped : {false, true}) {
      recorder_->begin_frame(time_++);
      for (std::size_t i = 0; i < objects_.size(); ++i)
        for (std::size_t k = i + 1; k < objects_.size(); ++k) {
          const auto &a = objects_[is_swapped ? k : i], &b = objects_[is_swapped ? i : k];
          fcl::CollisionResultd result;
          fcl::collide(&a, &b, fcl::CollisionRequestd(64, true), result);
          recorder_->pair(a, b, result);
        }
    }
  }
  FclRecorder<double>& recorder() { return *recorder_; }
  trace::Trace trace() {
    recorder_.reset();
    return app::load_trace(folder_ / "run.jsonl");
  }

 private:
  TemporaryFolder folder_;
  std::unique_ptr<FclRecorder<double>> recorder_;
  std::deque<fcl::CollisionObjectd> objects_;
  int time_ = 0;
};

using Model = fcl::BVHModel<fcl::OBBRSSd>;

/// Formulas; libccd, which FCL uses otherwise, stops at 1e-6.
constexpr Promise kExact{.surface = 1e-9, .along = 1e-9, .best = 1e-9};

const trace::Shape& shape_of(const trace::Trace& trace, const std::string& name) {
  const auto shape = std::ranges::find(trace.header.shapes, name, &trace::Shape::name);
  if (shape == trace.header.shapes.end()) throw std::out_of_range(name);
  return *shape;
}

TEST(FclAdapter, BodiesOnBoxes) {
  FclScene scene;
  scene.add<fcl::Boxd>("table", pose({0, 0, 0}), 2, 2, 1);
  scene.add<fcl::Boxd>("crate", pose({0.1, 0.2, 0.69}, about(Vec3d::UnitZ(), 0.3)), 0.4, 0.6, 0.4);
  scene.add<fcl::Boxd>("tilted", pose({-0.6, 0.2, 0.79}, about(Vec3d(1, 1, 0).normalized(), 0.5)),
                       0.4, 0.4, 0.4);
  scene.add<fcl::Sphered>("ball", pose({0.8, 0.8, 0.59}), 0.1);
  scene.add<fcl::Capsuled>(
      "pill", pose({0.6, -0.5, 0.59}, about(Vec3d::UnitY(), std::numbers::pi / 2)), 0.1, 0.5);
  scene.add<fcl::Sphered>("second", pose({0.8, 0.7, 0.75}), 0.1);
  scene.collide();
  const trace::Trace trace = scene.trace();
  EXPECT_EQ(trace.header.engine, "FCL");
  EXPECT_EQ(trace.header.version, FCL_VERSION);
  EXPECT_EQ(trace.header.scalar, "double");
  EXPECT_EQ(trace.header.poses_at, "");
  EXPECT_EQ(trace.frames.size(), 2u);
  EXPECT_EQ(trace.frames[1].poses.size(), 6u);  // including those of untouched objects
  EXPECT_EQ(judge(trace).size(), 5u);
  for (const auto& [names, claims] : judge(trace)) EXPECT_EQ(claims.frames, 2) << names.second;
  expect_right(trace, kExact);
  EXPECT_GT(judge(with_turned_normals(trace))[PairNames("table", "crate")].best, 0.5);
}

TEST(FclAdapter, BodiesOnAHalfSpace) {
  FclScene scene;
  scene.add<fcl::Halfspaced>("ground", pose({0, 0, -1.5}), Vec3d(0, 0, 1), 0.5);
  const Quatd tilt = about(Vec3d::UnitY(), 0.4);
  scene.add<fcl::Boxd>("crate", pose({0, 0, -0.6}, tilt), 1, 1, 0.9);
  scene.add<fcl::Sphered>("ball", pose({2, 0, -0.6}), 0.5);
  scene.add<fcl::Capsuled>("pill", pose({4, 0, -0.6}, tilt), 0.3, 0.5);
  scene.collide();
  const trace::Trace trace = scene.trace();
  EXPECT_EQ(judge(trace).size(), 3u);
  expect_right(trace, kExact);
}

/// Recorded as hulls inside these shapes.
TEST(FclAdapter, CylindersConesAndEllipsoidsAreHulls) {
  FclScene scene;
  scene.add<fcl::Halfspaced>("ground", pose({0, 0, 0}), Vec3d(0, 0, 1), 0);
  const Quatd tilt = about(Vec3d::UnitY(), 0.4);
  scene.add<fcl::Cylinderd>("drum", pose({0, 0, 0.3}, tilt), 0.3, 0.5);
  scene.add<fcl::Coned>("cone", pose({2, 0, 0.4}, tilt), 0.3, 0.9);
  scene.add<fcl::Ellipsoidd>("egg", pose({4, 0, 0.18}), 0.4, 0.3, 0.2);
  testing::internal::CaptureStderr();
  scene.collide();
  EXPECT_NE(testing::internal::GetCapturedStderr().find("ellipsoid"), std::string::npos);
  const trace::Trace trace = scene.trace();
  EXPECT_EQ(judge(trace).size(), 3u);
  EXPECT_EQ(shape_of(trace, "cone").type, "cone");
  expect_right(trace, {.surface = 1e-3, .along = 1e-3, .best = 1e-3});
}

std::shared_ptr<fcl::Convexd> wedge() {
  auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
  for (const Vec3d& v : {Vec3d(-0.5, -0.4, -0.3), Vec3d(0.5, -0.4, -0.3), Vec3d(0.5, 0.4, -0.3),
                         Vec3d(-0.5, 0.4, -0.3), Vec3d(0, -0.3, 0.4), Vec3d(0, 0.3, 0.4)})
    vertices->push_back(v);
  auto faces = std::make_shared<std::vector<int>>(std::initializer_list<int>{
      4, 0, 3, 2, 1, 3, 0, 1, 4, 4, 1, 2, 5, 4, 3, 2, 3, 5, 4, 3, 0, 4, 5});
  return std::make_shared<fcl::Convexd>(vertices, 5, faces);
}

TEST(FclAdapter, HullsOnBoxesAndHulls) {
  FclScene scene;
  scene.add<fcl::Boxd>("table", pose({0, 0, -0.5}), 4, 4, 1);
  scene.add("wedge", pose({0, 0, 0.29}), wedge());
  scene.add("upon", pose({0.1, 0, 0.96}, about(Vec3d::UnitZ(), 0.4)), wedge());
  scene.collide();
  const trace::Trace trace = scene.trace();
  EXPECT_EQ(shape_of(trace, "wedge").faces.size(), 5u);
  EXPECT_EQ(judge(trace).size(), 2u);
  expect_right(trace, {.surface = 1e-4, .along = 1e-4, .best = 1e-4});
}

std::shared_ptr<Model> grid() {
  std::vector<fcl::Vector3d> vertices;
  std::vector<fcl::Triangle> triangles;
  for (int x = -2; x <= 4; ++x)
    for (int y = -2; y <= 2; ++y) vertices.emplace_back(x, y, x > 2 ? 0.4 * (x - 2) : 0);
  for (std::size_t x = 0; x < 6; ++x)
    for (std::size_t y = 0; y < 4; ++y) {
      const std::size_t i = 5 * x + y;
      triangles.emplace_back(i, i + 5, i + 6);
      triangles.emplace_back(i, i + 6, i + 1);
    }
  auto model = std::make_shared<Model>();
  model->beginModel();
  model->addSubModel(vertices, triangles);
  model->endModel();
  return model;
}

/// Triangles are tested alone: next to the one below a hull, an edge may push it aside by more.
TEST(FclAdapter, KnownFaultEdgesOfAMeshPushHullsAside) {
  FclScene scene;
  scene.add("ground", pose({0.5, 0, -1}), grid());
  scene.add("wedge", pose({-0.9, -0.7, -0.71}), wedge());
  scene.add<fcl::Boxd>("crate", pose({0.8, 0.3, -0.71}, about(Vec3d::UnitZ(), 0.5)), 0.4, 0.6, 0.6);
  scene.collide();
  const trace::Trace trace = scene.trace();
  EXPECT_EQ(shape_of(trace, "ground").faces.size(), 48u);
  expect_right(trace, {.surface = 1e-6}, {}, {"internal_edge"});
  int upright = 0;
  for (const trace::Frame& frame : trace.frames) {
    ASSERT_EQ(frame.pairs.size(), 2u);
    for (const trace::Pair& pair : frame.pairs)
      for (const trace::Manifold& manifold : pair.manifolds) {
        EXPECT_TRUE(manifold.triangle);
        EXPECT_GT(manifold.normal.z(), -1e-6);
        if (manifold.normal.z() < 1 - 1e-6) continue;
        ++upright;
        for (const trace::Point& point : manifold.points)
          EXPECT_NEAR(point.separation, -0.01, 1e-6);
      }
  }
  EXPECT_GE(upright, 4);
}

/// FCL negates the overlap of a ball and a triangle: 10 mm of overlap become 10 mm of separation.
TEST(FclAdapter, KnownFaultABallOnAMeshHasPositiveSeparation) {
  FclScene scene;
  scene.add("ground", pose({0.5, 0, -1}), grid());
  scene.add<fcl::Sphered>("ball", pose({0.2, 0.3, -0.71}), 0.3);
  scene.collide();
  const trace::Trace trace = scene.trace();
  ASSERT_EQ(trace.frames.at(0).pairs.size(), 1u);
  EXPECT_NEAR(trace.frames[0].pairs[0].separation, 0.01, 1e-9);
  EXPECT_NEAR(judge(trace)[PairNames("ground", "ball")].along, 0.02, 1e-9);
  expect_right(trace, kExact, {{"ground", "ball"}}, {"positive_depths"});
}

TEST(FclAdapter, ObjectsComeAndGoAndChange) {
  FclScene scene;
  fcl::CollisionObjectd ball(std::make_shared<fcl::Sphered>(0.5));
  scene.recorder().begin_frame(0);
  scene.recorder().object(ball);
  scene.recorder().begin_frame(1);
  scene.recorder().begin_frame(2);
  scene.recorder().object(ball);
  {
    fcl::CollisionObjectd other(std::make_shared<fcl::Boxd>(1, 1, 1));
    scene.recorder().begin_frame(3);
    scene.recorder().object(other);
  }
  const trace::Trace trace = scene.trace();
  std::vector<std::vector<std::string>> there;
  for (const trace::Frame& frame : trace.frames) {
    there.emplace_back();
    for (const trace::Placement& placement : frame.poses) there.back().push_back(placement.first);
  }
  EXPECT_THAT(there, ElementsAre(ElementsAre("sphere 1"), ElementsAre(), ElementsAre("sphere 1"),
                                 ElementsAre("box 2")));
}

TEST(FclAdapter, ShapesWithoutAVolumeAreLeftOut) {
  FclScene scene;
  testing::internal::CaptureStderr();
  scene.add<fcl::Planed>("plane", pose({0, 0, 0}), Vec3d(0, 0, 1), 0);
  scene.add<fcl::Sphered>("ball", pose({0, 0, 0.3}), 0.5);
  scene.collide();
  EXPECT_NE(testing::internal::GetCapturedStderr().find("a Plane is left out"), std::string::npos);
  const trace::Trace trace = scene.trace();
  EXPECT_EQ(trace.header.shapes.size(), 1u);
  EXPECT_TRUE(judge(trace).empty());
}

TEST(FclAdapter, TheSampleIsRecorded) {
  const TemporaryFolder folder;
  const std::string file = folder / "pairs.jsonl";
  ASSERT_EQ(std::system((CONTACTSCOPE_BINARY_DIR "/tests/fcl_sample '" + file + "'").c_str()), 0);
  EXPECT_LE(lines_for_the_recorder("fcl_sample.cpp"), 6);
  const trace::Trace trace = app::load_trace(file);
  EXPECT_EQ(trace.frames.size(), 10u);
  expect_right(trace, kExact);
}

}  // namespace
}  // namespace contactscope::test
