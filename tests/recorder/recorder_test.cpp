#include "recorder/contactscope.h"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>
#include <thread>

#include "core/input_error.h"
#include "trace/json.h"

namespace contactscope {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kUp[3] = {0, 1, 0};
constexpr double kOrigin[3] = {0, 0, 0};
constexpr double kNoTurn[4] = {1, 0, 0, 0};

/// A file that is deleted with the test.
class Recording : public ::testing::Test {
 protected:
  Recording()
      : path_(std::filesystem::temp_directory_path() /
              ("recording_" + std::to_string(::getpid()) + ".jsonl")) {}
  ~Recording() override { std::filesystem::remove(path_); }

  cs_recorder* start(const cs_settings& settings = {}) const {
    return cs_start(path_.c_str(), "mine/stack", "Mine", "1.2", &settings);
  }
  std::string text() const {
    std::ifstream in(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  trace::Trace read() const {
    std::istringstream in(text());
    return trace::read_trace(in, "run.jsonl");
  }

  std::filesystem::path path_;
};

cs_point point_at(double x, double y, double z, double separation) {
  cs_point point{};
  point.position[0] = x;
  point.position[1] = y;
  point.position[2] = z;
  point.separation = separation;
  return point;
}

TEST_F(Recording, AStepReadsBack) {
  cs_settings settings{};
  settings.poses_at = 2;
  settings.force_step = 0.01;
  settings.friction_on_a = 1;
  cs_recorder* r = start(settings);
  ASSERT_NE(r, nullptr);
  const int floor = cs_plane(r, "floor", kUp, 0.25), crate = cs_box(r, "crate", 0.5, 1, 2);
  const double end[3] = {0, 1, 0};
  cs_capsule(r, "pill", kOrigin, end, 0.125);
  cs_begin_frame(r, 0.5);
  const double place[3] = {1, 2, 3}, turn[4] = {0.5, -0.5, 0.5, -0.5}, fast[3] = {4, 5, 6};
  cs_pose(r, floor, kOrigin, kNoTurn);
  cs_pose(r, crate, place, turn);
  cs_point points[2] = {point_at(1, 0.25, 3, -0.125), point_at(2, 0.25, 3, 0.0625)};
  points[0].has_sides = points[0].has_impulse = points[0].has_id = 1;
  points[0].on_a[0] = 7;
  points[0].on_b[0] = 8;
  points[0].impulse = 9;
  points[0].friction[2] = 0.5;
  points[0].id = 18446744073709551615u;
  points[1].idle = 1;
  cs_manifold(r, floor, crate, kUp, -1, points, 2);
  cs_body(r, crate, 2.5, place, fast, kUp);
  cs_solver(r, 8, 4, 1);
  cs_end_frame(r);
  EXPECT_EQ(cs_failure(r), nullptr);
  cs_stop(r);

  const trace::Trace trace = read();
  EXPECT_EQ(trace.header.scenario, "mine/stack");
  EXPECT_EQ(trace.header.engine, "Mine");
  EXPECT_EQ(trace.header.version, "1.2");
  EXPECT_EQ(trace.header.poses_at, "after_step");
  EXPECT_EQ(trace.header.impulses, (trace::ImpulseConvention{"N", "a", 0.01}));
  EXPECT_EQ(trace.header.scalar, "float");
  EXPECT_EQ(trace.header.up, "y");
  ASSERT_EQ(trace.header.shapes.size(), 3u);
  EXPECT_EQ(trace.header.shapes[0].half_space->offset, 0.25);
  EXPECT_EQ(trace.header.shapes[1].vertices.back(), Vec3d(0.5, 1, 2));
  EXPECT_EQ(trace.header.shapes[1].faces.size(), 6u);
  EXPECT_EQ(trace.header.shapes[1].edges.size(), 12u);
  EXPECT_EQ(trace.header.shapes[2].radius, 0.125);
  ASSERT_EQ(trace.frames.size(), 1u);
  const trace::Frame& frame = trace.frames[0];
  EXPECT_EQ(frame.time, 0.5);
  ASSERT_EQ(frame.poses.size(), 2u);  // the pill is missing
  EXPECT_EQ(frame.poses[1].second.position, Vec3d(1, 2, 3));
  EXPECT_EQ(frame.poses[1].second.rotation.coeffs(), Quatd(0.5, -0.5, 0.5, -0.5).coeffs());
  ASSERT_EQ(frame.pairs.size(), 1u);
  EXPECT_EQ(frame.pairs[0].kind, "plane-hull");
  EXPECT_EQ(frame.pairs[0].state, "touching");
  EXPECT_EQ(frame.pairs[0].separation, -0.125);
  const trace::Manifold& manifold = frame.pairs[0].manifolds.at(0);
  EXPECT_EQ(manifold.normal, Vec3d(0, 1, 0));
  ASSERT_EQ(manifold.points.size(), 2u);
  EXPECT_EQ(manifold.points[0].id, "18446744073709551615");
  EXPECT_EQ(manifold.points[0].on_a.value(), Vec3d(7, 0, 0));
  EXPECT_EQ(manifold.points[0].on_b.value(), Vec3d(8, 0, 0));
  EXPECT_EQ(manifold.points[0].impulse->normal, 9);
  EXPECT_EQ(manifold.points[0].impulse->friction, Vec3d(0, 0, 0.5));
  EXPECT_TRUE(manifold.points[0].active);
  EXPECT_FALSE(manifold.points[1].active);
  EXPECT_FALSE(manifold.points[1].impulse);
  ASSERT_TRUE(frame.solver);
  EXPECT_EQ(frame.solver->iterations, 8);
  EXPECT_EQ(frame.solver->substeps, 4);
  EXPECT_TRUE(frame.solver->warm_start);
  ASSERT_EQ(frame.solver->bodies.size(), 1u);
  EXPECT_EQ(frame.solver->bodies[0].name, "crate");
  EXPECT_EQ(frame.solver->bodies[0].mass, 2.5);
  EXPECT_EQ(frame.solver->bodies[0].velocity, Vec3d(4, 5, 6));
}

/// Every written number reads back to itself: a float with 9 digits, a double with 17.
TEST_F(Recording, NumbersReadBackToTheLastBit) {
  for (const bool doubles : {false, true}) {
    cs_settings settings{};
    settings.doubles = doubles ? 1 : 0;
    cs_recorder* r = start(settings);
    std::mt19937_64 engine(1);
    std::uniform_real_distribution<double> decade(-14, 14), part(1, 10), side(-1, 1);
    std::vector<double> numbers = {1,
                                   -1,
                                   0.1,
                                   9.999999999,
                                   0.99999999999999989,
                                   1e9,
                                   999999999.5,
                                   1e-10,
                                   1e-11,
                                   123456,
                                   1e300,
                                   5e-324,
                                   0.3,
                                   2.5,
                                   4194304.5,
                                   1e22,
                                   1 / 3.0,
                                   100,
                                   1234.5e6,
                                   1e-9,
                                   0.000999999999};
    for (int i = 0; i < 20000; ++i)
      numbers.push_back((side(engine) < 0 ? -1 : 1) * part(engine) *
                        std::pow(10.0, std::floor(decade(engine))));
    if (!doubles)
      for (double& number : numbers) number = static_cast<float>(number);
    std::erase_if(numbers, [](double number) { return !std::isfinite(number); });
    while (numbers.size() % 3 != 0) numbers.push_back(0);
    cs_begin_frame(r, 0);
    const int a = cs_sphere(r, "a", 1), b = cs_sphere(r, "b", 1);
    std::vector<cs_point> points;
    for (std::size_t i = 0; i < numbers.size(); i += 3)
      points.push_back(point_at(numbers[i], numbers[i + 1], numbers[i + 2], 0));
    cs_manifold(r, a, b, kUp, -1, points.data(), static_cast<int>(points.size()));
    cs_stop(r);
    const trace::Trace trace = read();
    const auto& written = trace.frames.at(0).pairs.at(0).manifolds.at(0).points;
    ASSERT_EQ(written.size(), points.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const double back = written[i / 3].position[static_cast<int>(i % 3)];
      if (doubles)
        ASSERT_EQ(back, numbers[i]);
      else
        ASSERT_EQ(static_cast<float>(back), static_cast<float>(numbers[i])) << back;
    }
  }
}

/// Any order of threads gives the same file.
TEST_F(Recording, DoesNotDependOnTheOrderOfThreads) {
  const auto recorded = [&](int threads, bool backwards) {
    cs_recorder* r = start();
    std::vector<int> balls;
    for (int i = 0; i < 64; ++i) balls.push_back(cs_sphere(r, nullptr, 0.5));
    for (int frame = 0; frame < 5; ++frame) {
      cs_begin_frame(r, frame);
      const auto work = [&](int thread) {
        for (int i = thread; i < 63; i += threads) {
          const int k = backwards ? 62 - i : i;
          const auto ball = static_cast<std::size_t>(k);
          const double place[3] = {1.0 * k, 0, 0};
          cs_pose(r, balls[ball], place, kNoTurn);
          cs_body(r, balls[ball], k + 1, place, kUp, kUp);
          for (int triangle = 0; triangle < 3; ++triangle) {
            const cs_point point = point_at(k, frame, triangle, -1e-3);
            cs_manifold(r, balls[ball], balls[ball + 1], kUp, triangle, &point, 1);
          }
        }
      };
      std::vector<std::thread> running;
      for (int t = 1; t < threads; ++t) running.emplace_back(work, t);
      work(0);
      for (std::thread& one : running) one.join();
      cs_end_frame(r);
    }
    EXPECT_EQ(cs_failure(r), nullptr);
    cs_stop(r);
    return text();
  };
  const std::string one = recorded(1, false);
  EXPECT_EQ(recorded(1, true), one);
  EXPECT_EQ(recorded(4, false), one);
  const trace::Trace trace = read();
  ASSERT_EQ(trace.frames.at(4).pairs.size(), 63u);
  EXPECT_EQ(trace.frames[4].pairs[7].manifolds.size(), 3u);
  EXPECT_EQ(trace.header.shapes.at(1).name, "shape 2");
}

TEST_F(Recording, IsWholeUpToTheLastFrameWhenTheProcessDies) {
  const pid_t child = ::fork();
  if (child == 0) {
    cs_recorder* r = start();
    const int ball = cs_sphere(r, "ball", 1);
    for (int frame = 0; frame < 4; ++frame) {
      cs_begin_frame(r, frame);
      cs_pose(r, ball, kUp, kNoTurn);
      if (frame == 3) ::_exit(9);
      cs_end_frame(r);
    }
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_EQ(WEXITSTATUS(status), 9);
  EXPECT_EQ(read().frames.size(), 3u);
}

TEST_F(Recording, ShapesComeAndGoAndPairsKeepTheirOrder) {
  cs_recorder* r = start();
  const int first = cs_sphere(r, "first", 1);
  cs_begin_frame(r, 0);
  cs_pose(r, first, kUp, kNoTurn);
  cs_end_frame(r);
  const double corners[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const int later = cs_hull(r, "later", corners, 4);
  cs_begin_frame(r, 1);
  cs_pose(r, later, kOrigin, kNoTurn);
  cs_pose(r, first, kUp, kNoTurn);
  cs_point point = point_at(0, 0, 0, -0.5);
  point.has_sides = 1;
  point.has_impulse = 1;
  point.friction[0] = 3;
  point.on_a[1] = 1;
  cs_manifold(r, later, first, kUp, -1, &point, 1);
  cs_end_frame(r);
  cs_begin_frame(r, 2);
  cs_pose(r, later, kOrigin, kNoTurn);
  cs_stop(r);  // ends the frame

  const trace::Trace trace = read();
  ASSERT_EQ(trace.header.shapes.size(), 1u);
  EXPECT_EQ(trace.header.frames, 3);
  EXPECT_THAT(trace.frames.at(0).shapes, testing::IsEmpty());
  EXPECT_EQ(trace.frames.at(1).shapes.at(0).name, "later");
  EXPECT_THAT(trace.frames[1].shapes[0].faces, testing::IsEmpty());
  EXPECT_EQ(trace.frames.at(0).poses.size(), 1u);
  EXPECT_EQ(trace.frames.at(1).poses.size(), 2u);
  EXPECT_EQ(trace.frames.at(2).poses.size(), 1u);
  const trace::Pair& pair = trace.frames[1].pairs.at(0);
  EXPECT_EQ(pair.a, "first");
  EXPECT_EQ(pair.b, "later");
  EXPECT_EQ(pair.kind, "sphere-hull");
  const trace::Manifold& manifold = pair.manifolds.at(0);
  EXPECT_EQ(manifold.normal, Vec3d(0, -1, 0));
  EXPECT_EQ(manifold.points[0].on_b.value(), Vec3d(0, 1, 0));
  EXPECT_EQ(manifold.points[0].impulse->friction, Vec3d(-3, 0, 0));
}

TEST_F(Recording, PartsOfACompoundGoWithIt) {
  cs_recorder* r = start();
  const int truck = cs_compound(r, "truck"), wheel = cs_sphere(r, "truck/wheel", 0.5);
  const double shifted[3] = {1, 0, 0}, place[3] = {0, 5, 0};
  const double quarter[4] = {std::sqrt(0.5), 0, 0, std::sqrt(0.5)};  // about z
  cs_part(r, truck, wheel, shifted, quarter);
  cs_begin_frame(r, 0);
  cs_pose(r, truck, place, quarter);
  cs_stop(r);
  const trace::Trace trace = read();
  ASSERT_EQ(trace.header.shapes.size(), 1u);
  ASSERT_EQ(trace.frames.at(0).poses.size(), 1u);
  const Pose<double>& pose = trace.frames[0].poses[0].second;
  EXPECT_NEAR((pose.position - Vec3d(0, 6, 0)).norm(), 0, 1e-7);
  EXPECT_NEAR((pose.rotation * Vec3d::UnitX() + Vec3d::UnitX()).norm(), 0, 1e-7);
}

/// Parts name their body, and a compound body has its mass under that name.
TEST_F(Recording, PartsNameTheirBody) {
  cs_recorder* r = start();
  const int truck = cs_compound(r, "truck"), wheel = cs_sphere(r, "wheel", 0.5),
            stone = cs_sphere(r, "stone", 0.5);
  cs_part(r, truck, wheel, kOrigin, kNoTurn);
  cs_begin_frame(r, 0);
  cs_pose(r, stone, kOrigin, kNoTurn);
  cs_pose(r, truck, kOrigin, kNoTurn);
  cs_body(r, truck, 7, kOrigin, kUp, kUp);
  cs_stop(r);
  const trace::Trace trace = read();
  EXPECT_EQ(trace.header.shapes.at(0).name, "wheel");
  EXPECT_EQ(trace.header.shapes[0].body, "truck");
  EXPECT_EQ(trace.header.shapes.at(1).body, "");
  EXPECT_EQ(trace.frames.at(0).solver->bodies.at(0).name, "truck");
}

/// Rings of 64 corners on the round surface, faces that the reader makes, and a margin around them.
TEST_F(Recording, CylindersAndConesStandAlongTheirAxis) {
  cs_recorder* r = start();
  for (int axis = 0; axis < 3; ++axis) {
    cs_cylinder(r, "drum", axis, 2, 0.5);
    cs_margin(r, cs_cone(r, "cone", axis, 2, 0.5), 0.04);
  }
  EXPECT_EQ(cs_cylinder(r, "drum", 3, 2, 0.5), -1);
  cs_begin_frame(r, 0);
  cs_stop(r);
  const trace::Trace trace = read();
  ASSERT_EQ(trace.header.shapes.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    const trace::Shape& shape = trace.header.shapes[i];
    const int axis = static_cast<int>(i / 2);
    const bool is_cone = i % 2 == 1;
    EXPECT_EQ(shape.type, is_cone ? "cone" : "cylinder");
    EXPECT_NEAR(shape.margin, is_cone ? 0.04 : 0, 1e-9);
    ASSERT_EQ(shape.vertices.size(), is_cone ? 65u : 128u);
    int tips = 0;
    for (const Vec3d& vertex : shape.vertices) {
      Vec3d across = vertex;
      across[axis] = 0;
      EXPECT_NEAR(std::abs(vertex[axis]), 2, 1e-9);
      if (across.norm() < 1e-9) {
        ++tips;
        EXPECT_NEAR(vertex[axis], 2, 1e-9);
      } else {
        EXPECT_NEAR(across.norm(), 0.5, 1e-8);
      }
    }
    EXPECT_EQ(tips, is_cone ? 1 : 0);
  }
}

TEST_F(Recording, NotesArePrintedOnce) {
  cs_recorder* r = start();
  testing::internal::CaptureStderr();
  for (const char* text : {"a ray is left out", "a ray", "a ray is left out", "a ray", "left out"})
    cs_note(r, text);
  cs_note(nullptr, "nobody");
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "contactscope: a ray is left out\ncontactscope: a ray\ncontactscope: left out\n");
  cs_stop(r);
}

TEST_F(Recording, MeshesAndHeightFieldsFaceUp) {
  for (const bool z_up : {false, true}) {
    cs_settings settings{};
    settings.z_up = z_up ? 1 : 0;
    cs_recorder* r = start(settings);
    const double heights[6] = {0, 0, 0, 0, 0.5, 0};
    cs_height_field(r, "hills", heights, 3, 2, 2.0);
    EXPECT_EQ(cs_height_field(r, "line", heights, 6, 1, 2.0), -1);
    cs_stop(r);
    std::istringstream in(text() + R"({"frame":0,"time":0,"poses":{},"pairs":[]})");
    const trace::Shape shape = trace::read_trace(in, "run.jsonl").header.shapes.at(0);
    EXPECT_EQ(shape.type, "mesh");
    ASSERT_EQ(shape.vertices.size(), 6u);
    ASSERT_EQ(shape.faces.size(), 4u);
    for (const std::vector<int>& face : shape.faces) {
      const auto corner = [&](std::size_t k) {
        return shape.vertices.at(static_cast<std::size_t>(face.at(k)));
      };
      const Vec3d normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
      EXPECT_GT(z_up ? normal.z() : normal.y(), 1);
    }
  }
}

TEST_F(Recording, NamesOfAnyLanguageAndNoneAreRecorded) {
  cs_recorder* r = start();
  for (const char* name : {"Würfel \"1\"\\\n", "箱", "箱", "\xff\xc3(\xed\xa0\x80", "箱"})
    cs_sphere(r, name, 1);
  cs_begin_frame(r, 0);
  cs_stop(r);
  std::vector<std::string> names;
  for (const trace::Shape& shape : read().header.shapes) names.push_back(shape.name);
  EXPECT_THAT(names, ElementsAre("Würfel \"1\"\\\n", "箱", "箱 2",
                                 "?"
                                 "?(?"
                                 "??",
                                 "箱 3"));
}

TEST_F(Recording, ANumberThatIsNoneIsNamedByTheReader) {
  cs_recorder* r = start();
  const int a = cs_sphere(r, "a", 1), b = cs_sphere(r, "b", 1);
  cs_begin_frame(r, 0);
  const cs_point point = point_at(0, std::numeric_limits<double>::quiet_NaN(), 0, 0);
  cs_manifold(r, a, b, kUp, -1, &point, 1);
  cs_stop(r);
  try {
    read();
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("pairs[0].manifolds[0].points[0].position[1]"));
  }
}

TEST_F(Recording, AFullDiskEndsItWithAnError) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  cs_recorder* r = cs_start("/dev/full", "mine/stack", nullptr, nullptr, nullptr);
  const int ball = cs_sphere(r, "ball", 1);
  for (int frame = 0; frame < 3; ++frame) {
    cs_begin_frame(r, frame);
    cs_pose(r, ball, kUp, kNoTurn);
    cs_end_frame(r);
  }
  EXPECT_STREQ(cs_failure(r), "the file cannot be written");
  cs_stop(r);
  EXPECT_EQ(cs_start("/no/such/folder/run.jsonl", "mine/stack", nullptr, nullptr, nullptr),
            nullptr);
}

TEST_F(Recording, ARecorderOfNullDoesNothing) {
  cs_recorder* r = nullptr;
  const cs_point point = point_at(0, 0, 0, 0);
  EXPECT_EQ(cs_sphere(r, "ball", 1), -1);
  EXPECT_EQ(cs_box(r, "box", 1, 1, 1), -1);
  EXPECT_EQ(cs_compound(r, "whole"), -1);
  cs_begin_frame(r, 0);
  cs_pose(r, 0, kUp, kNoTurn);
  cs_manifold(r, 0, 1, kUp, -1, &point, 1);
  cs_body(r, 0, 1, kUp, kUp, kUp);
  cs_solver(r, 1, 1, 1);
  cs_end_frame(r);
  EXPECT_EQ(cs_failure(r), nullptr);
  cs_stop(r);
  EXPECT_FALSE(std::filesystem::exists(path_));
}

/// Invalid data is omitted: an unknown shape, a pair with one, a point outside a frame.
TEST_F(Recording, InconsistentCallsAreIgnored) {
  cs_recorder* r = start();
  const int a = cs_sphere(r, "a", 1), b = cs_sphere(r, "b", 1);
  const cs_point point = point_at(0, 0, 0, 0);
  cs_manifold(r, a, b, kUp, -1, &point, 1);
  cs_begin_frame(r, 0);
  cs_manifold(r, a, a, kUp, -1, &point, 1);
  cs_manifold(r, a, 17, kUp, -1, &point, 1);
  cs_manifold(r, -1, b, kUp, -1, &point, 1);
  cs_manifold(r, a, b, kUp, -1, &point, 0);
  cs_pose(r, 5, kUp, kNoTurn);
  cs_stop(r);
  EXPECT_THAT(read().frames.at(0).pairs, testing::IsEmpty());
}

}  // namespace
}  // namespace contactscope
