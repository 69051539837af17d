#include <gmock/gmock.h>

#include "core/input_error.h"
#include "scenario/run.h"
#include "scenario/scenario.h"
#include "support/random_geometry.h"

namespace contactscope {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kShapes =
    "title = \"Shapes\"\n"
    "[shapes.ball]\ntype = \"sphere\"\nradius = 0.5\nposition = [0, 0.25, 0]\n"
    "[shapes.other]\ntype = \"sphere\"\nradius = 0.25\nposition = [0.5, 0.25, 0]\n"
    "[shapes.pill]\ntype = \"capsule\"\nradius = 0.1\npoints = [[1, 2, 3], [4, 5, 6]]\n"
    "[shapes.rod]\ntype = \"capsule\"\nradius = 0.1\nhalf_height = 0.75\n"
    "[shapes.ground]\ntype = \"plane\"\nnormal = [0, 3, 4]\noffset = -0.5\n";

TEST(OtherShapes, AreReadWithTheirSizes) {
  const Scenario scenario = parse_scenario(kShapes, "hull/a.toml");
  ASSERT_EQ(scenario.shapes.size(), 5u);
  EXPECT_EQ(std::get<Sphere<double>>(*scenario.shapes[0].geometry).radius, 0.5);
  const auto& pill = std::get<Capsule<double>>(*scenario.shapes[2].geometry);
  EXPECT_THAT(pill.points, ElementsAre(Vec3d(1, 2, 3), Vec3d(4, 5, 6)));
  const auto& rod = std::get<Capsule<double>>(*scenario.shapes[3].geometry);
  EXPECT_THAT(rod.points, ElementsAre(Vec3d(0, -0.75, 0), Vec3d(0, 0.75, 0)));
  const auto& ground = std::get<HalfSpace<double>>(*scenario.shapes[4].geometry);
  EXPECT_LT((ground.plane.normal - Vec3d(0, 0.6, 0.8)).norm(), 1e-15);
  EXPECT_EQ(ground.plane.offset, -0.5);
  EXPECT_EQ(scenario.shapes[0].hull(), nullptr);
}

TEST(OtherShapes, StandInTheTraceWithWhatTheyAreMadeOf) {
  const Scenario scenario = parse_scenario(kShapes, "hull/a.toml");
  const trace::Header header = Runner(scenario).header();
  EXPECT_EQ(header.shapes[0].radius, 0.5);
  EXPECT_THAT(header.shapes[0].vertices, ElementsAre(Vec3d(0, 0, 0)));
  EXPECT_EQ(header.shapes[2].radius, double(0.1f));
  EXPECT_EQ(header.shapes[2].edges.size(), 1u);
  EXPECT_EQ(header.shapes[2].center_of_mass, Vec3d(2.5, 3.5, 4.5));
  EXPECT_EQ(header.shapes[4].half_space->offset, -0.5);
}

TEST(OtherShapes, ASphereTurnsAboutItsBodysOriginWithItsOwnCentre) {
  test::Random random(19);
  const auto spelled = [](const Vec3d& v) {
    return "[" + std::to_string(v.x()) + ", " + std::to_string(v.y()) + ", " +
           std::to_string(v.z()) + "]";
  };
  int touching = 0;
  for (int i = 0; i < 100; ++i) {
    const Vec3d center = random.vector(-1, 1), position = random.vector(-1, 1);
    const Quatd turn = random.rotation();
    const auto number = [&](double value) { return std::to_string(value); };
    const Scenario scenario = parse_scenario(
        "title = \"\"\n[pipeline]\nscalar = \"double\"\n[shapes.ball]\ntype = \"sphere\"\nradius = "
        "0.5\ncenter = " +
            spelled(center) + "\nposition = " + spelled(position) + "\nrotation = { quat_wxyz = [" +
            number(turn.w()) + ", " + number(turn.x()) + ", " + number(turn.y()) + ", " +
            number(turn.z()) +
            "] }\n"
            "[shapes.other]\ntype = \"sphere\"\nradius = 0.75\n",
        "round/a.toml");
    Runner runner(scenario);
    const trace::Shape shape = runner.header().shapes.at(0);
    const trace::Frame frame = runner.frame(0);
    // Files have six digits.
    const Vec3d middle = position + turn * center;
    EXPECT_LT((frame.poses.at(0).second.position - position).norm(), 1e-5);
    EXPECT_LT((frame.poses.at(0).second.transform(shape.vertices.at(0)) - middle).norm(), 1e-5);
    const trace::Pair& pair = frame.pairs.at(0);
    EXPECT_EQ(pair.kind, "sphere-sphere");
    EXPECT_EQ(pair.state == "touching", middle.norm() < 1.25);
    if (pair.manifolds.empty()) continue;
    ++touching;
    EXPECT_NEAR(pair.separation, middle.norm() - 1.25, 1e-5);
    EXPECT_LT((pair.manifolds[0].normal + middle.normalized()).norm(), 1e-4);
  }
  EXPECT_GT(touching, 30);
  EXPECT_THROW(
      parse_scenario("title = \"\"\n[shapes.f]\ntype = \"sdf\"\ncell = 0.1\n[shapes.f.of]\n"
                     "type = \"sphere\"\nradius = 1\ncenter = [1, 0, 0]\n[shapes.b]\n"
                     "type = \"sphere\"\nradius = 1\n",
                     "round/a.toml"),
      InputError);
}

// The user's a and b decide, not the order in the file.
TEST(OtherShapes, SwappingAAndBMirrorsTheManifold) {
  const auto pair_of = [](const std::string& a, const std::string& b) {
    const Scenario scenario = parse_scenario(
        kShapes + "[[pairs]]\na = \"" + a + "\"\nb = \"" + b + "\"\n", "hull/a.toml");
    return Runner(scenario).frame(0).pairs.at(0);
  };
  const trace::Pair there = pair_of("ball", "other");
  const trace::Pair back = pair_of("other", "ball");
  ASSERT_EQ(there.state, "touching");
  EXPECT_EQ(back.kind, "sphere-sphere");
  EXPECT_EQ(back.manifolds.at(0).normal, Vec3d(-there.manifolds.at(0).normal));
  EXPECT_EQ(back.manifolds[0].points.at(0).position, there.manifolds[0].points.at(0).position);
  EXPECT_EQ(there.separation, -0.25);
  EXPECT_EQ(back.separation, -0.25);
  EXPECT_EQ(there.manifolds[0].type, "point-point");
}

TEST(OtherShapes, MayBeLeftUnmergedWhereTheyAreHulls) {
  const std::string shapes =
      "title = \"Unmerged\"\n"
      "[shapes.box]\ntype = \"box\"\nhalf_extents = [1, 1, 1]\nmerge_coplanar = false\n"
      "[shapes.can]\ntype = \"cylinder\"\nradius = 1\nhalf_height = 1\nsegments = 8\n"
      "merge_coplanar = false\n"
      "[shapes.hat]\ntype = \"cone\"\nradius = 1\nhalf_height = 1\nsegments = 8\n"
      "merge_coplanar = false\n"
      "[shapes.wedge]\ntype = \"hull\"\nmerge_coplanar = false\n"
      "vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1]]\n"
      "[shapes.flat]\ntype = \"hull\"\nmerge_coplanar = false\n"
      "vertices = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]\n"
      "[shapes.merged]\ntype = \"box\"\nhalf_extents = [1, 1, 1]\nmerge_coplanar = true\n";
  const Scenario scenario = parse_scenario(shapes, "hull/a.toml");
  const int faces[] = {12, 2 * 6 + 8 * 2, 6 + 8, 2 + 3 * 2, 2, 6};
  for (std::size_t i = 0; i < scenario.shapes.size(); ++i) {
    EXPECT_EQ(scenario.shapes[i].hull()->face_count(), faces[i]) << scenario.shapes[i].name;
  }
  const trace::Header header = Runner(scenario).header();
  EXPECT_EQ(header.shapes[0].faces.size(), 12u);
  EXPECT_EQ(header.shapes[0].edges.size(), 18u);
}

TEST(OtherShapes, AWiderWeldJoinsAcrossAWiderGap) {
  const auto shapes_with = [](const std::string& weld) {
    return parse_scenario(
               "title = \"Welded\"\n"
               "[shapes.floor]\ntype = \"mesh\"\n" +
                   weld +
                   "vertices = [[-1, 0, -1], [0, 0, -1], [0, 0, 1], [0, 1e-4, -1], [1, 0, 0], "
                   "[0, 1e-4, 1]]\n"
                   "triangles = [[0, 2, 1], [3, 5, 4]]\n"
                   "[shapes.left]\ntype = \"box\"\nposition = [-1, 5, 0]\n" +
                   weld +
                   "half_extents = [1, 1, 1]\n"
                   "[shapes.right]\ntype = \"box\"\nposition = [1.0003, 5, 0]\n" +
                   weld + "half_extents = [1, 1, 1]\n",
               "mesh/a.toml")
        .shapes;
  };
  const auto separate = shapes_with(""), joined = shapes_with("weld = 1e-3\n");
  const auto seams = [](const ScenarioShape& shape) {
    return shape.is_mesh() ? std::get<Mesh<double>>(*shape.collider).seams.size()
                           : std::get<Hull<double>>(*shape.collider).seams.covered.size();
  };
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(seams(separate[i]), 0u) << separate[i].name;
    EXPECT_EQ(seams(joined[i]), i == 0 ? 2u : 6u) << joined[i].name;
  }
}

TEST(OtherShapes, PairsThatMakeNoContactAreWarnedOfOnce) {
  const std::string planes = kShapes +
                             "[shapes.wall]\ntype = \"plane\"\nnormal = [1, 0, 0]\noffset = 0\n"
                             "[shapes.roof]\ntype = \"plane\"\nnormal = [0, -1, 0]\noffset = -3\n"
                             "[[pairs]]\na = \"ground\"\nb = \"wall\"\n"
                             "[[pairs]]\na = \"roof\"\nb = \"wall\"\n";
  const Scenario scenario = parse_scenario(planes, "hull/a.toml");
  ASSERT_EQ(scenario.warnings.size(), 1u);
  EXPECT_THAT(scenario.warnings[0], HasSubstr("'ground' and 'wall' make no contacts: plane-plane"));
  EXPECT_THAT(Runner(scenario).frame(0).pairs, IsEmpty());
}

TEST(OtherShapes, NothingCanBeExpectedOfAPairThatIsNotCollided) {
  const std::string expecting = kShapes +
                                "[shapes.wall]\ntype = \"plane\"\nnormal = [1, 0, 0]\noffset = 0\n"
                                "[[expect]]\na = \"ground\"\nb = \"wall\"\nstate = \"separated\"\n";
  try {
    parse_scenario(expecting, "hull/a.toml");
    FAIL() << "taken";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("plane-plane pairs are not collided"));
  }
}

const std::string kMeshes =
    "title = \"Meshes\"\n"
    "[shapes.terrain]\ntype = \"mesh\"\ngrid = { size = [4, 2], cells = [8, 4], amplitude = 0.1 }\n"
    "[shapes.ramp]\ntype = \"mesh\"\n"
    "vertices = [[0, 0, 0], [0, 0, 1], [1, 0, 0], [1, 0, 1], [2, 0, 0]]\n"
    "triangles = [[0, 1, 2], [1, 3, 2], [0, 2, 4]]\n";

TEST(OtherShapes, MeshesAreReadAndWhatWasLeftOutIsWarnedOf) {
  const Scenario scenario = parse_scenario(kMeshes, "hull/a.toml");
  const auto& terrain = std::get<Mesh<double>>(*scenario.shapes[0].geometry);
  EXPECT_EQ(terrain.triangle_count(), 64);
  EXPECT_EQ(terrain.tree.bounds().upper.x(), 2);
  EXPECT_EQ(terrain.tree.bounds().upper.z(), 1);
  const auto& ramp = std::get<Mesh<double>>(*scenario.shapes[1].geometry);
  EXPECT_EQ(ramp.triangle_count(), 2);
  EXPECT_EQ(ramp.neighbour(0, 1), 1);
  ASSERT_EQ(scenario.warnings.size(), 2u);
  EXPECT_THAT(scenario.warnings[0], HasSubstr("mesh 'ramp': triangle 2 has no area"));
  EXPECT_THAT(scenario.warnings[1], HasSubstr("mesh-mesh pairs are not collided"));
}

TEST(OtherShapes, AMeshStandsInTheTraceWithEveryEdgeOnce) {
  const Scenario scenario = parse_scenario(kMeshes, "hull/a.toml");
  const trace::Header header = Runner(scenario).header();
  EXPECT_EQ(header.shapes[0].faces.size(), 64u);
  EXPECT_EQ(header.shapes[0].edges.size(), 8u * 5 + 4u * 9 + 32u);
  EXPECT_EQ(header.shapes[1].edges.size(), 5u);
  EXPECT_EQ(header.shapes[1].faces.size(), 2u);
}

TEST(OtherShapes, ASphereOnAMeshHasAManifoldForEachTriangle) {
  const Scenario scenario = parse_scenario(
      "title = \"Sphere\"\n[pipeline]\nmesh_manifolds = \"triangle\"\n[shapes.ball]\ntype = "
      "\"sphere\"\nradius = 0.5\n"
      "position = [0.3, 0.45, 0.2]\n"
      "[shapes.floor]\ntype = \"mesh\"\ngrid = { size = 4, cells = 4 }\n",
      "hull/a.toml");
  const trace::Frame frame = Runner(scenario).frame(0);
  const trace::Pair& pair = frame.pairs.at(0);
  EXPECT_EQ(pair.kind, "sphere-mesh");
  EXPECT_NEAR(pair.separation, -0.05, 1e-7);
  ASSERT_EQ(pair.manifolds.size(), 1u);
  EXPECT_TRUE(pair.manifolds[0].triangle.has_value());
  ASSERT_TRUE(pair.tree.has_value());
  EXPECT_EQ(pair.tree->shape, "floor");
  const trace::Frame unrecorded = Runner(scenario).frame_unrecorded(0);
  EXPECT_EQ(unrecorded.pairs.at(0).manifolds.at(0).triangle, pair.manifolds[0].triangle);
  EXPECT_FALSE(unrecorded.pairs.at(0).tree.has_value());
}

TEST(OtherShapes, AKeyChoosesTheTriangleWhoseStagesAreRecorded) {
  const auto scenario = [](const std::string& key, const std::string& floor) {
    return parse_scenario("title = \"Box\"\n[pipeline]\n" + key +
                              "[shapes.box]\ntype = \"box\"\nhalf_extents = [1, 0.5, 1]\n"
                              "position = [0.3, 0.45, 0.2]\n[shapes.floor]\n" +
                              floor,
                          "hull/a.toml");
  };
  const std::string mesh = "type = \"mesh\"\ngrid = { size = 4, cells = 2 }\n";
  const Scenario chosen = scenario("triangle = 5\n", mesh);
  const trace::Frame frame = Runner(chosen).frame(0);
  const trace::Pair& pair = frame.pairs.at(0);
  EXPECT_EQ(pair.triangle, 5);
  ASSERT_TRUE(pair.clip.has_value());
  EXPECT_EQ(pair.clip->reference.shape, "floor");
  EXPECT_EQ(pair.clip->reference.face, 5);
  EXPECT_THAT(scenario("triangle = 8\n", mesh).warnings,
              ElementsAre(HasSubstr("'floor' has triangles 0 to 7")));
  EXPECT_THAT(
      scenario("triangle = 0\n", "type = \"plane\"\nnormal = [0, 1, 0]\noffset = 0\n").warnings,
      ElementsAre(HasSubstr("neither shape is a mesh")));
}

}  // namespace
}  // namespace contactscope
