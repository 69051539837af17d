#include "trace/sample_trace.h"

#include <limits>

namespace contactscope::trace {
namespace {

Shape sample_shape(std::string name, std::string type) {
  Shape shape;
  shape.name = std::move(name);
  shape.type = std::move(type);
  shape.vertices = {{0, 0, 0}, {double(0.1f), 0, -0.0}, {0, 1e-300, 0}, {0, 0, 1.0 / 3.0}};
  shape.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  shape.edges = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  shape.center_of_mass = {0.025, 0.25, 1.0 / 12.0};
  return shape;
}

Shape sample_round_shape() {
  Shape shape;
  shape.name = "pill";
  shape.type = "capsule";
  shape.vertices = {{0, -0.5, 0}, {0, 0.5, 0}};
  shape.edges = {{0, 1}};
  shape.radius = double(0.1f);
  return shape;
}

}  // namespace

Header sample_header() {
  Header header{"hull/face_contact",
                "Tetrahedron \"above\" a floor \u2014 \u00e9",
                "Gregorius 2015",
                "float",
                "z",
                24,
                {}};
  // Not sorted by name: shapes stay in file order.
  header.shapes = {sample_shape("zebra", "hull"), sample_shape("apple", "box")};
  header.shapes.push_back(sample_round_shape());
  Shape ground;
  ground.name = "ground";
  ground.type = "plane";
  ground.half_space = HalfSpace{{0.6, 0, -0.8}, -0.25};
  header.shapes.push_back(ground);
  header.engine = "Another";
  header.version = "3.14";
  header.poses_at = "after_step";
  header.impulses = ImpulseConvention{"N", "a", 0.02};
  return header;
}

Frame sample_frame() {
  Frame frame;
  frame.frame = 12;
  frame.time = 12 / 60.0;
  frame.poses.emplace_back("zebra", Pose<double>{Quatd(0.5, -0.5, 0.5, -0.5),
                                                 {1, std::numeric_limits<double>::max(), 3}});
  frame.poses.emplace_back("apple", Pose<double>{});

  Pair pair{"zebra", "apple", "preference on", "hull-hull", "touching", double(-0.005f), {}, {},
            {},      {}};
  Manifold manifold{{0, -1, -0.0}, "face_b", {}, {}};
  manifold.points = {{{0.1, 0.2, 0.3}, -0.005, "a:e3 b:e7"}, {{1e-300, 4, 5}, -0.0, "a:e1 a:e2"}};
  manifold.type = "face-face";
  pair.manifolds.push_back(manifold);
  manifold.type.clear();
  manifold.triangle = 17;
  pair.manifolds.push_back(manifold);
  pair.sat = Sat{FaceAxis{1, -0.5, {0, 1, 0}, {6, 7, 8}},
                 FaceAxis{2, -0.25, {1, 0, 0}, {9, 10, 11}},
                 EdgeAxis{3, 4, -0.125, {0, 0, 1}, {1, 2, 3}, {4, 5, 6}},
                 "face_b",
                 "relative",
                 0.006};
  Clip clip;
  clip.reference = {"apple", 2, {0, 1, 0}, {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}}};
  clip.incident = {"zebra", 3, {0, -1, 0}, {{0, 1, 0}, {1, 1, 0}, {1, 1, 1}}};
  clip.steps.push_back({{1, 0, 0}, 0.75, {{0, 0, 0}, {0.75, 0, 0}, {0.5, 0, 0.5}}});
  clip.steps.push_back({{0, 0, 1}, -0.75, {}});
  clip.dropped.push_back({{3, 2, 1}, "above the reference face"});
  pair.clip = clip;
  pair.reduction = Reduction{"area", manifold.points, {1, 0}, 0.0625, 0.125, {0, 1}, {}};
  pair.reduction->choices = {
      {"support", {0.6, -0.0, 0.8}, {{0, kNoEdge, -0.0}, {1, kNoEdge, double(0.1f)}}},
      {"outside", {0, 0, 0}, {{0, {{1, 0}}, -1e-300}}}};
  pair.degenerate = Degenerate{"coincident centres", "skip"};
  pair.voided = Voided{"zebra", "covered face", {0.6, -0.0, 0.8}, manifold.points};
  pair.gjk = Gjk{"separated", 3, 0.25, {1, 2, 3}, {4, 5, 6}, {}};
  pair.gjk->steps = {{{{0, 1, 0}, {-0.0, 2, 1}}}, {{{1, 0, 0}, {0, 0, 1}}, {{7, 8, 9}, {1, 1, 1}}}};
  pair.tree = Tree{"apple", {{-1, -2, -3}, {1, 2, 3}}, {}, {4, 17}};
  pair.tree->visits = {{{{-8, -8, -8}, {8, 8, 8}}, 0, false, true},
                       {{{0, 0, 0}, {1, 1, 1e-300}}, 1, true, false}};
  pair.cache = Cache{true, "features", "face_b", Vec3d(0, -1, -0.0), double(0.0125f)};
  pair.sat->edge_pairs = {{3, 4, -0.125, {0, 0, 1}}, {5, 0, -0.5, {0.6, -0.0, 0.8}}};
  pair.manifolds[0].points[0].on_a = Vec3d(0.1, 0.2, 0.3);
  pair.manifolds[0].points[0].on_b = Vec3d(0.1, -0.0, 1e-300);
  pair.manifolds[0].points[1].active = false;
  pair.manifolds[0].points[1].impulse = Impulse{0.75, {0.125, -0.0, 1e-300}, 0.5};
  pair.penetration = Penetration{
      "epa", "converged", "", 2, double(0.005f), {0, -1, -0.0}, {1, 2, 3}, {4, 5, 6}, {}, {}, {}};
  const Simplex corners = {{{0, 0, 0}, {1, 0, 0}},
                           {{0, 1, 0}, {0, 0, 0}},
                           {{0, 0, 1}, {0, 0, -0.0}},
                           {{1e-300, 0, 0}, {0.1, 0.2, 0.3}}};
  pair.penetration->polytopes = {{corners, {{0, 2, 1}, {0, 1, 3}}, 1, 0.00375},
                                 {corners, {}, -1, 0}};
  pair.minkowski = Minkowski{{{0, 0, 0}, {1, 0, 0}, {0, -0.0, 1.0 / 3.0}}, {{0, 1, 2}, {2, 1, 0}}};
  pair.incremental = Incremental{"distance", "gjk", 0.01, 0.02, 0.04, {}};
  pair.incremental->points = {
      {{{1, 2, 3},
        -0.005,
        "a:v1 b:f2",
        Impulse{0.25, {0, 0, 0}, 0},
        {},
        Vec3d(7, 8, 9),
        Vec3d(4, 5, 6)},
       "new",
       "",
       0},
      {{{3, 2, 1}, 0.125, "", {}, {}, Vec3d(9, 8, 7), Vec3d(6, 5, 4)}, "broken", "slid", 17}};
  pair.stability = Stability{"zebra",
                             {0, 1, 0},
                             {0, 0.5, -0.0},
                             {{0, 0, 0}, {1, 0, 0}},
                             -0.25,
                             "turns about a line",
                             std::array<Vec3d, 2>{Vec3d(0, 0, 0), Vec3d(1, 0, 0)}};
  frame.pairs.push_back(pair);
  frame.solver = Solver{"soft", 8, 4, true, 0.005, 0.02, 0.5, 0.05, {}};
  frame.solver->bodies = {{"zebra", 2.5, {1, 2, 3}, {4, 5, 6}, {7, 8, 9}, 0.5, -9.81, true},
                          {"apple", 1e-300, {0, 0, 0}, {0, 0, -0.0}, {0, 0, 0}, 0, 0}};

  frame.pairs.push_back({"apple", "zebra", "", "hull-hull", "separated", 0.25, {}, {}, {}, {}});
  return frame;
}

}  // namespace contactscope::trace
