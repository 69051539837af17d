#include "snapshot/sample_trace.h"

#include <string>

namespace contactscope {
namespace {

Vec3d rounded(double x, double y, double z) {
  return Vec3f(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)).cast<double>();
}

trace::Shape box(const std::string& name, double half) {
  trace::Shape shape;
  shape.name = name;
  shape.type = "box";
  for (int i = 0; i < 8; ++i) {
    shape.vertices.push_back(
        Vec3d(i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half));
  }
  shape.faces = {{1, 3, 7, 5}, {0, 4, 6, 2}, {2, 6, 7, 3},
                 {0, 1, 5, 4}, {4, 5, 7, 6}, {0, 2, 3, 1}};
  shape.edges = {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3},
                 {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  return shape;
}

trace::Pair contact() {
  trace::Pair pair;
  pair.a = "crate";
  pair.b = "floor";
  pair.kind = "hull-hull";
  pair.state = "touching";
  pair.separation = static_cast<double>(-0.005f);

  trace::Manifold manifold;
  manifold.normal = Vec3d(0, -1, 0);
  manifold.axis = "face_b";
  manifold.type = "face-face";
  trace::Polygon patch;
  for (int i = 0; i < 4; ++i) {
    trace::Point point;
    point.position = rounded(i == 1 || i == 2 ? 0.3 : -0.3, 0.5, i >= 2 ? 0.3 : -0.3);
    point.separation = pair.separation;
    point.id = "a:e" + std::to_string(i) + " a:e" + std::to_string(i + 4);
    point.impulse = trace::Impulse{0.5, Vec3d(0.125, 0, 0), 0.25};
    point.relative_velocity = trace::RelativeVelocity{Vec3d(0.5, -2, 0), Vec3d(0.5, 0, 0)};
    manifold.points.push_back(point);
    patch.push_back(point.position);
  }
  pair.manifolds.push_back(manifold);

  trace::Sat& sat = pair.sat.emplace();
  sat.face_a = trace::FaceAxis{3, pair.separation, Vec3d(0, -1, 0), patch[0]};
  sat.face_b = trace::FaceAxis{2, pair.separation, Vec3d(0, -1, 0), patch[1]};
  sat.edge = trace::EdgeAxis{2, 9, rounded(0, -0.1, 0).y(), Vec3d(0, -1, 0), patch[2], patch[3]};
  sat.chosen = "face_b";
  sat.preference = "relative";

  trace::Clip& clip = pair.clip.emplace();
  clip.reference = {"floor", 2, Vec3d(0, 1, 0), patch};
  clip.incident = {"crate", 3, Vec3d(0, -1, 0), patch};
  clip.steps.push_back({Vec3d(1, 0, 0), 0.5, patch});
  clip.steps.push_back({Vec3d(0, 0, 1), 0.5, patch});
  clip.dropped.push_back({rounded(0.2, 0.6, 0.1), "above the reference face"});

  sat.edge_pairs = {{2, 9, sat.edge->separation, Vec3d(0, -1, 0)}, {3, 9, -0.25, Vec3d(0, 0, 1)}};
  trace::Penetration& penetration = pair.penetration.emplace();
  penetration = {"epa", "converged", "", 2, 0.005, Vec3d(0, -1, 0), patch[0], patch[1], {}, {}, {}};
  const trace::Simplex corners = {{patch[0], patch[1]}, {patch[1], patch[2]}, {patch[2], patch[3]}};
  penetration.polytopes = {{corners, {{0, 1, 2}, {0, 2, 1}}, 1, 0.25}};
  penetration.portals = {corners};
  penetration.directions = {{Vec3d(0, 1, 0), 0.5}};
  pair.minkowski = trace::Minkowski{patch, {{0, 1, 2}, {0, 2, 3}}};
  trace::Incremental& incremental = pair.incremental.emplace();
  incremental = {"distance", "gjk", 0.01, 0.01, {}, {}};
  for (trace::Point point : manifold.points) {
    point.on_a = point.on_b = point.position;
    incremental.points.push_back({point, "persisted", "", 7});
  }
  pair.stability = trace::Stability{"crate",
                                    Vec3d(0, 1, 0),
                                    Vec3d(0, 0.5, 0),
                                    patch,
                                    0.25,
                                    "turns about a line",
                                    std::array<Vec3d, 2>{patch[0], patch[1]}};

  pair.cache = trace::Cache{true, "features", "face_a", manifold.normal, 0.0125};
  pair.degenerate = trace::Degenerate{"crossing axes", "fallback"};
  pair.gjk = trace::Gjk{"separated", 3, 0.25, patch[0], patch[1], {{{patch[0], patch[1]}}}};
  pair.tree = trace::Tree{"floor", {Vec3d(-1, -1, -1), Vec3d(1, 1, 1)}, {}, {4, 17}};
  pair.tree->visits.push_back({pair.tree->box, 0, true, true});
  trace::Reduction& reduction = pair.reduction.emplace();
  reduction.method = "area";
  reduction.points = manifold.points;
  reduction.kept = {0, 2, 1, 3};
  reduction.area = reduction.best_area = static_cast<double>(0.36f);
  reduction.best = {0, 1, 2, 3};
  reduction.choices = {{"support", Vec3d(1, 0, 0), {{0, trace::kNoEdge, 0.5}}},
                       {"outside", Vec3d::Zero(), {{2, {{0, 1}}, 0.25}}}};
  return pair;
}

}  // namespace

trace::Trace sample_trace() {
  trace::Trace trace;
  trace.header.scenario = "hull/face_contact";
  trace.header.title = "Box on box";
  trace.header.source = "Gregorius 2015, Hull vs Hull: Face Contact";
  trace.header.scalar = "float";
  trace.header.up = std::string("y");
  trace.header.frames = 24;
  trace.header.shapes = {box("crate", 0.3f), box("floor", 0.5)};
  for (const int number : {0, 12}) {
    trace::Frame frame;
    frame.frame = number;
    frame.time = number / 24.0;
    Pose<double> pose;
    pose.position = rounded(0, 0.795, 0);
    pose.rotation = Quatd(0.8, 0, 0.6, 0);
    frame.poses = {{"crate", pose}, {"floor", Pose<double>{}}};
    frame.pairs.push_back(contact());
    frame.solver = trace::Solver{"soft", 8, 4, true, 0.005, 0.02, 0.5, 0.05, {}};
    frame.solver->bodies = {
        {"crate", 2, Vec3d(0, 1, 0), Vec3d(0, -0.5, 0), Vec3d(0, 2, 0), 1, 8, true}};
    frame.totals = trace::totals_of(frame);
    trace.frames.push_back(frame);
  }
  return trace;
}

}  // namespace contactscope
