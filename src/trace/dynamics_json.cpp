#include "trace/dynamics_json.h"

#include <algorithm>
#include <set>

namespace contactscope::trace {
namespace {

Point read_point(const Node& node) {
  Point point{node.at("position").vector(), node.at("separation").number(),
              node.string_or_empty("id")};
  if (const auto impulse = node.find("impulse"))
    point.impulse = Impulse{impulse->at("normal").number(), impulse->vector_or_zero("friction"),
                            impulse->number_or_zero("warm_start")};
  if (const auto velocity = node.find("relative_velocity"))
    point.relative_velocity =
        RelativeVelocity{velocity->at("before").vector(), velocity->at("after").vector()};
  return point;
}

Json body(const Body& b) {
  return {{"mass", number(b.mass, "mass")},
          {"center_of_mass", vector(b.center_of_mass, "center_of_mass")},
          {"velocity", vector(b.velocity, "velocity")},
          {"angular_velocity", vector(b.angular_velocity, "angular_velocity")},
          {"kinetic_energy", number(b.kinetic_energy, "kinetic_energy")},
          {"potential_energy", number(b.potential_energy, "potential_energy")}};
}

}  // namespace

std::vector<Point> read_points(const Node& node) {
  std::vector<Point> points;
  for (const Node& item : node.items()) points.push_back(read_point(item));
  return points;
}

Json incremental(const Incremental& i) {
  Json points = Json::array();
  for (const PersistentPoint& p : i.points) {
    Json json = point(p.point);
    json["on_a"] = vector(p.on_a, "on_a");
    json["on_b"] = vector(p.on_b, "on_b");
    json["state"] = p.state;
    if (!p.reason.empty()) json["reason"] = p.reason;
    json["age"] = p.age;
    points.push_back(std::move(json));
  }
  return {{"confirm", i.confirm},
          {"query", i.query},
          {"margin_a", number(i.margin_a, "margin_a")},
          {"margin_b", number(i.margin_b, "margin_b")},
          {"points", std::move(points)}};
}

Incremental read_incremental(const Node& node) {
  Incremental incremental;
  incremental.confirm = node.at("confirm").string();
  incremental.query = node.at("query").string();
  incremental.margin_a = node.at("margin_a").number();
  incremental.margin_b = node.at("margin_b").number();
  for (const Node& item : node.at("points").items())
    incremental.points.push_back({read_point(item), item.at("on_a").vector(),
                                  item.at("on_b").vector(), item.at("state").string(),
                                  item.string_or_empty("reason"), item.at("age").integer()});
  return incremental;
}

Json stability(const Stability& s) {
  Json json = {{"shape", s.shape},
               {"center_of_mass", vector(s.center_of_mass, "center_of_mass")},
               {"projection", vector(s.projection, "projection")},
               {"support", vectors(s.support, "support")},
               {"margin", number(s.margin, "margin")},
               {"verdict", s.verdict}};
  if (s.axis)
    json["axis"] = Json::array({vector((*s.axis)[0], "axis"), vector((*s.axis)[1], "axis")});
  return json;
}

Stability read_stability(const Node& node) {
  Stability s;
  s.shape = node.at("shape").string();
  s.center_of_mass = node.at("center_of_mass").vector();
  s.projection = node.at("projection").vector();
  s.support = node.at("support").vectors();
  s.margin = node.at("margin").number();
  s.verdict = node.at("verdict").string();
  if (const auto axis = node.find("axis")) {
    const std::vector<Vec3d> points = axis->vectors();
    if (points.size() != 2) axis->fail("must have two points");
    s.axis = {points[0], points[1]};
  }
  return s;
}

Json solver(const Solver& s) {
  Json bodies = Json::object();
  for (const Body& b : s.bodies) bodies[b.name] = body(b);
  return {{"position_correction", s.position_correction},
          {"iterations", s.iterations},
          {"substeps", s.substeps},
          {"warm_start", s.warm_start},
          {"slop", number(s.slop, "slop")},
          {"speculative_margin", number(s.speculative_margin, "speculative_margin")},
          {"bodies", std::move(bodies)}};
}

Solver read_solver(const Node& node) {
  Solver s;
  s.position_correction = node.at("position_correction").string();
  s.iterations = node.at("iterations").integer();
  s.substeps = node.at("substeps").integer();
  s.warm_start = node.at("warm_start").boolean();
  s.slop = node.number_or_zero("slop");
  s.speculative_margin = node.number_or_zero("speculative_margin");
  for (const auto& [name, item] : node.at("bodies").members())
    s.bodies.push_back({name, item.at("mass").number(), item.at("center_of_mass").vector(),
                        item.at("velocity").vector(), item.at("angular_velocity").vector(),
                        item.at("kinetic_energy").number(), item.at("potential_energy").number()});
  return s;
}

Totals totals_of(const Frame& frame) {
  Totals totals;
  for (const Pair& pair : frame.pairs) {
    std::set<std::pair<int, std::string>> ids;
    for (const Manifold& manifold : pair.manifolds) {
      for (const Point& point : manifold.points) {
        if (frame.solver && !point.impulse) continue;
        totals.penetration = std::max(totals.penetration, -point.separation);
        if (point.impulse) totals.normal_impulse += point.impulse->normal;
        ++totals.points;
        ids.emplace(manifold.triangle.value_or(-1), point.id);
      }
    }
    totals.ids += static_cast<int>(ids.size());
  }
  if (!frame.solver) return totals;
  for (const Body& b : frame.solver->bodies) {
    totals.kinetic_energy += b.kinetic_energy;
    totals.potential_energy += b.potential_energy;
  }
  return totals;
}

Json totals(const Totals& t) {
  return {{"penetration", number(t.penetration, "penetration")},
          {"normal_impulse", number(t.normal_impulse, "normal_impulse")},
          {"points", t.points},
          {"ids", t.ids},
          {"kinetic_energy", number(t.kinetic_energy, "kinetic_energy")},
          {"potential_energy", number(t.potential_energy, "potential_energy")}};
}

Totals read_totals(const Node& node) {
  return {node.at("penetration").number(),    node.at("normal_impulse").number(),
          node.at("points").integer(),        node.at("ids").integer(),
          node.at("kinetic_energy").number(), node.at("potential_energy").number()};
}

}  // namespace contactscope::trace
