#include <algorithm>
#include <thread>

#include <gmock/gmock.h>

#include "reduce/brute_force.h"
#include "scenario/broken.h"
#include "scenario/run.h"
#include "support/builders.h"
#include "trace/json.h"

namespace contactscope {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Three crates that fall on each other and on a turning slab.
std::string falling(const std::string& rest = "") {
  std::string text = "title = \"Falling\"\n[time]\nframes = 40\ndt = 0.02\n";
  for (int i = 0; i < 3; ++i) {
    const std::string number = std::to_string(i);
    text += "[shapes.crate" + number +
            "]\ntype = \"box\"\nhalf_extents = [0.5, 0.25, 0.5]\nposition = [0.1" + number + ", " +
            std::to_string(0.3 + 0.55 * i) + ", 0." + number +
            "]\nmotion = { dynamic = true, mass = " + std::to_string(i + 1) + " }\n";
  }
  return text +
         "[shapes.slab]\ntype = \"box\"\nhalf_extents = [2, 0.5, 2]\nposition = [0, -0.5, 0]\n"
         "motion = { angular_velocity = [0, 0.5, 0.1] }\n"
         "[shapes.floor]\ntype = \"plane\"\nnormal = [0, 1, 0]\noffset = -1\n"
         "[solver]\nslop = 0.001\n" +
         rest;
}

class DynamicRun : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Pipelines, DynamicRun,
                         ::testing::Values("scalar = \"float\"", "scalar = \"double\"",
                                           "manifold = \"incremental\"",
                                           "reducer = \"coherent\"\ncache = false"),
                         [](const ::testing::TestParamInfo<const char*>& test) {
                           std::string name = test.param;
                           std::erase_if(name,
                                         [](unsigned char c) { return std::isalnum(c) == 0; });
                           return name;
                         });

TEST_P(DynamicRun, AFrameDoesNotDependOnEarlierRequestsAndACopyContinuesAlike) {
  const Scenario scenario =
      parse_scenario(falling(std::string("[pipeline]\n") + GetParam()), "g/a.toml");
  Runner runner(scenario);
  std::vector<std::string> lines;
  std::vector<Runner> copies;
  for (int frame = 0; frame < 40; ++frame) {
    if (frame % 10 == 5) copies.push_back(runner);
    lines.push_back(trace::to_json_line(runner.frame(frame)));
  }
  Runner skipping(scenario);
  for (const int frame : {2, 3, 17, 39})
    EXPECT_EQ(trace::to_json_line(skipping.frame(frame)), lines[static_cast<std::size_t>(frame)]);
  for (std::size_t i = 0; i < copies.size(); ++i) {
    const std::size_t frame = 10 * i + 7;
    EXPECT_EQ(trace::to_json_line(copies[i].frame(static_cast<int>(frame))), lines[frame]);
  }
}

TEST_P(DynamicRun, RecordingChangesNothing) {
  const Scenario scenario =
      parse_scenario(falling(std::string("[pipeline]\n") + GetParam()), "g/a.toml");
  Runner watched(scenario), unwatched(scenario);
  for (int number = 0; number < scenario.frames; ++number) {
    const trace::Frame recorded = watched.frame(number);
    const trace::Frame bare = unwatched.frame_unrecorded(number);
    ASSERT_EQ(recorded.poses.size(), bare.poses.size());
    for (std::size_t i = 0; i < bare.poses.size(); ++i) {
      EXPECT_EQ(recorded.poses[i].second.position, bare.poses[i].second.position);
      EXPECT_EQ(recorded.poses[i].second.rotation.coeffs(), bare.poses[i].second.rotation.coeffs());
    }
    EXPECT_TRUE(recorded.solver);
    EXPECT_FALSE(bare.solver);
    ASSERT_EQ(recorded.pairs.size(), bare.pairs.size());
    for (std::size_t i = 0; i < bare.pairs.size(); ++i) {
      ASSERT_EQ(recorded.pairs[i].manifolds.size(), bare.pairs[i].manifolds.size());
      for (std::size_t m = 0; m < bare.pairs[i].manifolds.size(); ++m) {
        const auto& points = recorded.pairs[i].manifolds[m].points;
        ASSERT_EQ(points.size(), bare.pairs[i].manifolds[m].points.size());
        for (std::size_t p = 0; p < points.size(); ++p) {
          EXPECT_EQ(points[p].position, bare.pairs[i].manifolds[m].points[p].position);
          EXPECT_TRUE(points[p].impulse);
        }
      }
    }
  }
}

constexpr const char* kResting = R"(title = "Resting"
up = "z"
[time]
frames = 200
[shapes.lower]
type = "box"
half_extents = [0.5, 0.5, 0.5]
position = [0, 0, 0.499]
motion = { dynamic = true, density = 4 }
[shapes.upper]
type = "sphere"
radius = 0.5
position = [0, 0, 1.498]
motion = { dynamic = true, mass = 2 }
[shapes.floor]
type = "plane"
normal = [0, 0, 1]
offset = 0
[solver]
slop = 0.001
[pipeline]
scalar = "double"
)";

TEST(DynamicRun, AStackCarriesItsWeightAndRecordsIt) {
  const Scenario scenario =
      parse_scenario(std::string(kResting) +
                         "[[expect]]\na = \"lower\"\nb = \"floor\"\nframes = [150, 199]\n"
                         "load = 58.86\ntolerance = 1e-4\nseparation = -0.001\n"
                         "[[expect]]\na = \"lower\"\nb = \"upper\"\nframes = [150, 199]\n"
                         "load = 19.62\ntolerance = 1e-4\n",
                     "g/a.toml");
  EXPECT_THAT(unmet_expectations(scenario, {Runner(scenario).frame(199)}), IsEmpty());
  Scenario wrong = scenario;
  wrong.expectations[0].load = 60;
  EXPECT_THAT(unmet_expectations(wrong, {Runner(wrong).frame(199)}),
              ElementsAre(::testing::HasSubstr("expected load 60 N, got 58.8")));

  const trace::Frame frame = Runner(scenario).frame(0);
  ASSERT_TRUE(frame.solver);
  EXPECT_EQ(frame.solver->position_correction, "baumgarte");
  EXPECT_EQ(frame.solver->iterations, 10);
  ASSERT_EQ(frame.solver->bodies.size(), 2u);
  EXPECT_EQ(frame.solver->bodies[0].name, "lower");
  EXPECT_NEAR(frame.solver->bodies[0].mass, 4, 1e-12);
  EXPECT_EQ(frame.solver->bodies[0].kinetic_energy, 0);
  EXPECT_NEAR(frame.solver->bodies[1].potential_energy, 2 * 9.81 * 1.498, 1e-12);
  ASSERT_EQ(frame.pairs.size(), 3u);
  for (const trace::Point& point : frame.pairs[1].manifolds.at(0).points) {
    ASSERT_TRUE(point.impulse);
    EXPECT_GT(point.impulse->normal, 0);
    EXPECT_EQ(point.impulse->warm_start, 0);  // there was no previous impulse
  }
}

TEST(DynamicRun, AFrameShowsTheBodiesBeforeItsStep) {
  const Scenario scenario =
      parse_scenario(one_shape("type = \"sphere\"\nradius = 0.1\nposition = [1, 2, 3]\n"
                               "motion = { dynamic = true, mass = 1, velocity = [0.5, 0, 0] }\n"
                               "[time]\nframes = 3\ndt = 0.25\n[pipeline]\nscalar = \"double\"\n"
                               "[world]\ngravity = [0, -8, 0]\n"),
                     "g/a.toml");
  Runner runner(scenario);
  EXPECT_EQ(runner.frame(0).poses[0].second.position, Vec3d(1, 2, 3));
  // v = -8 * 0.25 and y = 2 - 2 * 0.25 after the first step.
  const trace::Frame second = runner.frame(1);
  EXPECT_EQ(second.poses[0].second.position, Vec3d(1.125, 1.5, 3));
  EXPECT_EQ(second.solver->bodies.at(0).velocity, Vec3d(0.5, -2, 0));
}

TEST(DynamicRun, OnlyTheFirstOfSeveralEntriesMovesTheBodies) {
  const std::string pair = "[[pairs]]\na = \"lower\"\nb = \"floor\"\n";
  const std::string once = kResting + pair;
  const std::string thrice = once + "label = \"on\"\n[[pairs]]\na = \"floor\"\nb = \"lower\"\n" +
                             "[[pairs]]\na = \"lower\"\nb = \"floor\"\nlabel = \"three\"\n" +
                             "max_points = 3\n";
  const Scenario one = parse_scenario(once, "g/a.toml");
  const Scenario three = parse_scenario(thrice, "g/a.toml");
  const trace::Frame frame = Runner(three).frame(50);
  EXPECT_EQ(frame.poses[0].second.position, Runner(one).frame(50).poses[0].second.position);
  ASSERT_EQ(frame.pairs.size(), 3u);
  EXPECT_TRUE(frame.pairs[0].manifolds.at(0).points.at(0).impulse);
  EXPECT_FALSE(frame.pairs[1].manifolds.at(0).points.at(0).impulse);
  EXPECT_EQ(frame.pairs[2].manifolds.at(0).points.size(), 3u);
}

TEST(DynamicRun, PairsThatTheSolverCannotMoveAreLeftOutByDefault) {
  const Scenario scenario = parse_scenario(falling(), "g/a.toml");
  std::vector<std::string> names;
  for (const ScenarioPair& pair : scenario.pairs)
    names.push_back(scenario.shapes[static_cast<std::size_t>(pair.a)].name + "-" +
                    scenario.shapes[static_cast<std::size_t>(pair.b)].name);
  EXPECT_EQ(names.size(), 9u);
  EXPECT_EQ(std::ranges::count(names, "slab-floor"), 0);
}

TEST(DynamicRun, KeysOfTheSolverAreRead) {
  const Scenario scenario = parse_scenario(
      std::string(kResting).substr(0, std::string(kResting).find("[solver]")) +
          "friction = 0.2\nrestitution = 0.9\n[world]\nfriction = 0.3\nrestitution = 0.1\n"
          "[solver]\niterations = 7\nsubsteps = 3\nposition_correction = \"projection\"\n"
          "warm_start = false\nbaumgarte = 0.2\nslop = 0.004\nhertz = 60\ndamping_ratio = 5\n"
          "speculative_margin = 0.02\n",
      "g/a.toml");
  EXPECT_EQ(scenario.world.gravity, Vec3d(0, 0, -9.81));
  EXPECT_EQ(scenario.world.friction, 0.3);
  EXPECT_EQ(scenario.world.restitution, 0.1);
  EXPECT_EQ(scenario.shapes[2].friction, 0.2);
  EXPECT_EQ(scenario.shapes[2].restitution, 0.9);
  EXPECT_FALSE(scenario.shapes[0].friction);
  EXPECT_NEAR(scenario.shapes[0].body->mass, 4, 1e-12);
  EXPECT_FALSE(scenario.shapes[2].body);
  EXPECT_EQ(scenario.solver.iterations, 7);
  EXPECT_EQ(scenario.solver.substeps, 3);
  EXPECT_EQ(scenario.solver.position_correction, PositionCorrection::Projection);
  EXPECT_FALSE(scenario.solver.warm_start);
  EXPECT_EQ(scenario.solver.baumgarte, 0.2);
  EXPECT_EQ(scenario.solver.slop, 0.004);
  EXPECT_EQ(scenario.solver.hertz, 60);
  EXPECT_EQ(scenario.solver.damping_ratio, 5);
  EXPECT_EQ(scenario.solver.speculative_margin, 0.02);
}

// 1/200 and 1/50 of the thinnest one: the upper box, whose shortest edge is 0.2 m.
TEST(DynamicRun, LengthsOfTheSolverAreByDefaultThoseOfTheSmallestBody) {
  const std::string upper =
      "[shapes.thin]\ntype = \"box\"\nhalf_extents = [0.4, 0.1, 0.3]\nposition = [0, 0, 3]\n"
      "motion = { dynamic = true, mass = 2 }\n";
  std::string text = kResting + upper;
  text.erase(text.find("slop = 0.001\n"), 13);
  const auto solver_of = [&](const std::string& key) {
    return parse_scenario(std::string(text).insert(text.find("[pipeline]"), key), "g/a.toml")
        .solver;
  };
  EXPECT_NEAR(*solver_of("").slop, 0.001, 1e-12);
  EXPECT_NEAR(*solver_of("").speculative_margin, 0.004, 1e-12);
  EXPECT_EQ(solver_of("slop = 0.0\n").slop, 0);
  EXPECT_NEAR(*solver_of("slop = 0.0\n").speculative_margin, 0.004, 1e-12);
  EXPECT_EQ(solver_of("speculative_margin = 3\n").speculative_margin, 3);
  const Scenario scenario = parse_scenario(text, "g/a.toml");
  const trace::Frame frame = Runner(scenario).frame(0);
  EXPECT_EQ(frame.solver->slop, scenario.solver.slop);
  EXPECT_EQ(frame.solver->speculative_margin, scenario.solver.speculative_margin);
}

TEST(World, RelativeVelocityIsThatOfThePointBeforeAndAfterTheStepAndTotalsSumTheFrame) {
  // A ball that spins on a rising platform: at the contact it moves by spin x radius.
  const Scenario scenario = parse_scenario(
      "title = \"t\"\n[time]\nframes = 2\ndt = 0.01\n"
      "[shapes.platform]\ntype = \"box\"\nhalf_extents = [1, 0.5, 1]\nposition = [0, -0.5, 0]\n"
      "motion = { velocity = [0, 0.5, 0] }\n"
      "[shapes.ball]\ntype = \"sphere\"\nradius = 0.25\nposition = [0, 0.25, 0]\n"
      "motion = { dynamic = true, mass = 2, velocity = [1, -2, 0], angular_velocity = [0, 0, 3] }\n"
      "[pipeline]\nscalar = \"double\"\n[world]\ngravity = [0, 0, 0]\nfriction = 0\n"
      "[solver]\nslop = 0.0\n",
      "g/a.toml");
  const trace::Frame frame = Runner(scenario).frame(0);
  ASSERT_EQ(frame.pairs[0].manifolds.size(), 1u);
  const trace::Point& point = frame.pairs[0].manifolds[0].points[0];
  ASSERT_TRUE(point.relative_velocity.has_value());
  // From the platform to the ball; spin x arm = (0, 0, 3) x (0, -0.25, 0) = (0.75, 0, 0).
  const double sign = frame.pairs[0].a == "platform" ? 1 : -1;
  EXPECT_NEAR((sign * point.relative_velocity->before - Vec3d(1.75, -2.5, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((sign * point.relative_velocity->after - Vec3d(1.75, 0, 0)).norm(), 0, 1e-12);
  ASSERT_TRUE(frame.totals.has_value());
  EXPECT_NEAR(frame.totals->normal_impulse, 5, 1e-12) << "2 kg, 2.5 m/s";
  EXPECT_EQ(frame.totals->points, 1);
  EXPECT_EQ(frame.totals->ids, 1);
  EXPECT_NEAR(frame.totals->kinetic_energy, 0.5 * 2 * 5 + 0.5 * 0.4 * 2 * 0.0625 * 9, 1e-12);
}

TEST(World, WithoutASolverThereAreTotalsWherePlotsAreShown) {
  const std::string text =
      "title = \"t\"\n[shapes.a]\ntype = \"sphere\"\nradius = 1\n[shapes.b]\ntype = "
      "\"sphere\"\nradius = 1\nposition = [0, 1.5, 0]\n";
  const Scenario plain = parse_scenario(text, "g/a.toml");
  EXPECT_FALSE(Runner(plain).frame(0).totals.has_value());
  const Scenario plotted = parse_scenario(text + "[[views]]\npanels = [\"plots\"]\n", "g/a.toml");
  const trace::Frame frame = Runner(plotted).frame(0);
  ASSERT_TRUE(frame.totals.has_value());
  EXPECT_EQ(frame.totals->penetration, 0.5);
  EXPECT_EQ(frame.totals->points, 1);
}

// Only keys that are written and have no effect are reported, with their line.
TEST(IdleKeys, AreReportedWithTheirLineAndTheRemedy) {
  const auto warnings = [](const std::string& text) {
    return parse_scenario(text, "g/a.toml").warnings;
  };
  const std::string moving =
      "title = \"Moving\"\n[shapes.ball]\ntype = \"sphere\"\nradius = 1\nmotion = { dynamic = "
      "true, "
      "mass = 1 }\n[shapes.floor]\ntype = \"plane\"\nnormal = [0, 1, 0]\noffset = -1\n";
  EXPECT_THAT(warnings(moving + "[solver]\nhertz = 20\n"),
              ElementsAre("line 11: 'hertz' has no effect: position_correction is "
                          "\"baumgarte\"; set position_correction = \"soft\", or remove it"));
  EXPECT_THAT(warnings(moving + "[solver]\nposition_correction = \"soft\"\nbaumgarte = 0.1\n"
                                "hertz = 20\ndamping_ratio = 5\n"),
              ElementsAre(::testing::StartsWith("line 12: 'baumgarte' has no effect")));
  EXPECT_THAT(warnings(moving + "[pipeline]\npenetration = \"sat\"\nconfirm = \"ids\"\n"),
              ElementsAre(::testing::StartsWith("line 11: 'penetration' has no effect"),
                          ::testing::StartsWith("line 12: 'confirm' has no effect")));
  EXPECT_THAT(warnings(moving + "[pipeline]\ntoo_close = \"reject\"\n"),
              ElementsAre(::testing::StartsWith("line 11: 'too_close' has no effect")));
  EXPECT_THAT(warnings(moving + "[pipeline]\nmanifold = \"incremental\"\npenetration = \"epa\"\n"
                                "core_margin = 0.1\nbreaking_distance = 0.1\n"),
              ElementsAre("line 13: 'core_margin' has no effect: only hulls have a core margin; "
                          "remove it"));
  EXPECT_THAT(warnings(moving), IsEmpty());

  const std::string still = two_boxes("[world]\nfriction = 0.5\n[solver]\nhertz = 20\n");
  EXPECT_THAT(warnings(still),
              ElementsAre("line 8: [world] has no effect: no shape is dynamic; give "
                          "one motion = { dynamic = true, mass = 1.0 }, or "
                          "remove it",
                          ::testing::StartsWith("line 10: [solver]")));
  EXPECT_THAT(warnings(two_boxes("restitution = 0.5\n")),
              ElementsAre(::testing::StartsWith("line 8: 'restitution' has no effect")));
  // A key of [pipeline] has an effect if it applies to any pair.
  const std::string mixed = two_boxes(
      "[shapes.ball]\ntype = \"sphere\"\nradius = 1\n[pipeline]\npenetration = \"epa\"\n");
  EXPECT_THAT(warnings(mixed), IsEmpty());
  EXPECT_THAT(
      warnings(mixed + "[[pairs]]\na = \"crate\"\nb = \"ball\"\n"
                       "breaking_distance = 0.1\n[[pairs]]\na = \"crate\"\nb = \"floor\"\n"),
      ElementsAre(::testing::StartsWith("line 16: 'breaking_distance' has no effect")));
}

/// A crate on a crate, turned by 40 degrees, on a floor.
std::string turned_crates(const std::string& pipeline) {
  const auto crate = [](const std::string& name, double y, const std::string& more) {
    return "[shapes." + name +
           "]\ntype = \"box\"\nhalf_extents = [0.5, 0.5, 0.5]\nposition = [0, " +
           std::to_string(y) + ", 0]\nmotion = { dynamic = true, mass = 1 }\n" + more;
  };
  return "title = \"Turned\"\n[time]\nframes = 120\n"
         "[shapes.floor]\ntype = \"plane\"\nnormal = [0, 1, 0]\noffset = 0\n" +
         crate("lower", 0.5, "") +
         crate("upper", 1.5, "rotation = { axis = [0, 1, 0], degrees = 40 }\n") + "[pipeline]\n" +
         pipeline;
}

/// Corners of the octagon that two unit squares share if one is turned by 40 degrees.
std::vector<test::Place> shared_octagon() {
  std::vector<Eigen::Vector2d> normals;
  for (const double turned : {0.0, 40.0})
    for (int k = 0; k < 4; ++k) {
      const double angle = test::kDegree * (turned + 90 * k);
      normals.emplace_back(std::cos(angle), std::sin(angle));
    }
  std::vector<test::Place> corners;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      Eigen::Matrix2d sides;
      sides << normals[i].transpose(), normals[j].transpose();
      if (std::abs(sides.determinant()) < 0.1) continue;
      const Eigen::Vector2d corner = sides.inverse() * Eigen::Vector2d(0.5, 0.5);
      if (std::ranges::all_of(
              normals, [&](const Eigen::Vector2d& n) { return n.dot(corner) < 0.5 + 1e-12; }))
        corners.push_back({corner.x(), corner.y()});
    }
  }
  return corners;
}

// At first all eight points are equally deep, so the four of the largest area are kept. Later the
// crate leans by micrometres, and they are the four of the largest area with the deepest one.
TEST(TurnedCrates, RestOnFourPointsOfTheLargestArea) {
  const double largest = test::largest_area(shared_octagon(), 4);
  for (const char* pipeline : {"", "reducer = \"optimal_deepest\"\n", "scalar = \"double\"\n"}) {
    const Scenario scenario = parse_scenario(turned_crates(pipeline), "g/a.toml");
    Runner runner(scenario);
    for (int frame = 0; frame < 120; ++frame) {
      const trace::Frame now = runner.frame(frame);
      const auto pair = std::ranges::find_if(
          now.pairs, [](const trace::Pair& one) { return one.a == "lower" && one.b == "upper"; });
      ASSERT_NE(pair, now.pairs.end());
      ASSERT_TRUE(pair->reduction) << pipeline << frame;
      const auto& points = pair->reduction->points;
      ASSERT_EQ(points.size(), 8u) << pipeline << frame;
      ASSERT_EQ(pair->reduction->kept.size(), 4u) << pipeline << frame;
      std::vector<test::Place> places;
      for (const trace::Point& point : points)
        places.push_back({point.position.x(), point.position.z()});
      const double area = test::hull_area(test::at(places, pair->reduction->kept));
      const int deepest = static_cast<int>(
          std::ranges::min_element(points, {}, &trace::Point::separation) - points.begin());
      const double with_deepest = test::largest_area(
          places, 4, [&](const auto& chosen) { return std::ranges::count(chosen, deepest) > 0; });
      EXPECT_GE(area, with_deepest - 1e-6) << pipeline << frame;
      if (frame == 0) {
        EXPECT_NEAR(area, largest, 1e-6) << pipeline;
      }
    }
  }
}

}  // namespace
}  // namespace contactscope
