#include "trace/json.h"

#include "trace/dynamics_json.h"
#include "trace/json_values.h"
#include "trace/penetration_json.h"

namespace contactscope::trace {
namespace {

Json shape(const Shape& s) {
  Json json = {{"type", s.type},
               {"vertices", vectors(s.vertices, "vertices")},
               {"faces", s.faces},
               {"edges", s.edges},
               {"center_of_mass", vector(s.center_of_mass, "center_of_mass")}};
  if (s.radius != 0) json["radius"] = number(s.radius, "radius");
  if (s.half_space)
    json["half_space"] = {{"normal", vector(s.half_space->normal, "normal")},
                          {"offset", number(s.half_space->offset, "offset")}};
  return json;
}

Json manifold(const Manifold& m) {
  Json json = {{"normal", vector(m.normal, "normal")}, {"axis", m.axis}};
  if (!m.type.empty()) json["type"] = m.type;
  json["triangle"] = m.triangle ? Json(*m.triangle) : Json(nullptr);
  json["points"] = points(m.points);
  return json;
}

Json face_axis(const FaceAxis& axis) {
  return {{"face", axis.face},
          {"separation", number(axis.separation, "separation")},
          {"normal", vector(axis.normal, "normal")},
          {"support", vector(axis.support, "support")}};
}

Json edge_axis(const EdgeAxis& axis) {
  return {{"a", axis.a},
          {"b", axis.b},
          {"separation", number(axis.separation, "separation")},
          {"normal", vector(axis.normal, "normal")},
          {"point_a", vector(axis.point_a, "point_a")},
          {"point_b", vector(axis.point_b, "point_b")}};
}

Json sat(const Sat& s) {
  Json json = Json::object();
  if (s.face_a) json["face_a"] = face_axis(*s.face_a);
  if (s.face_b) json["face_b"] = face_axis(*s.face_b);
  if (s.edge) json["edge"] = edge_axis(*s.edge);
  json["chosen"] = s.chosen;
  json["preference"] = s.preference;
  if (!s.edge_pairs.empty()) {
    Json& pairs = json["edge_pairs"] = Json::array();
    for (const EdgePair& pair : s.edge_pairs)
      pairs.push_back({{"a", pair.a},
                       {"b", pair.b},
                       {"separation", number(pair.separation, "separation")},
                       {"normal", vector(pair.normal, "normal")}});
  }
  return json;
}

Json clip(const Clip& c) {
  Json steps = Json::array();
  for (const ClipStep& step : c.steps)
    steps.push_back(
        {{"plane",
          {{"normal", vector(step.normal, "normal")}, {"offset", number(step.offset, "offset")}}},
         {"polygon", vectors(step.polygon, "polygon")}});
  Json dropped = Json::array();
  for (const DroppedPoint& d : c.dropped)
    dropped.push_back({{"position", vector(d.position, "position")}, {"reason", d.reason}});
  const auto face = [](const ClipFace& f) -> Json {
    return {{"shape", f.shape},
            {"face", f.face},
            {"normal", vector(f.normal, "normal")},
            {"polygon", vectors(f.polygon, "polygon")}};
  };
  return {{"reference", face(c.reference)},
          {"incident", face(c.incident)},
          {"steps", std::move(steps)},
          {"dropped", std::move(dropped)}};
}

Json choice(const Choice& c) {
  Json json = {{"rule", c.rule}};
  if (!c.direction.isZero()) json["direction"] = vector(c.direction, "direction");
  Json measures = Json::array();
  for (const Measure& m : c.measures) {
    Json measure = {{"point", m.point}};
    if (m.edge[0] >= 0) measure["edge"] = m.edge;
    measure["value"] = number(m.value, "value");
    measures.push_back(std::move(measure));
  }
  json["measures"] = std::move(measures);
  return json;
}

Json reduction(const Reduction& r) {
  Json json = {{"method", r.method},
               {"points", points(r.points)},
               {"kept", r.kept},
               {"area", number(r.area, "area")},
               {"best_area", number(r.best_area, "best_area")}};
  if (!r.best.empty()) json["best"] = r.best;
  if (!r.choices.empty()) {
    json["choices"] = Json::array();
    for (const Choice& made : r.choices) json["choices"].push_back(choice(made));
  }
  return json;
}

Json gjk(const Gjk& g) {
  Json steps = Json::array();
  for (const Simplex& step : g.steps) steps.push_back(simplex(step));
  return {{"status", g.status},
          {"iterations", g.iterations},
          {"distance", number(g.distance, "distance")},
          {"point_a", vector(g.point_a, "point_a")},
          {"point_b", vector(g.point_b, "point_b")},
          {"steps", std::move(steps)}};
}

Json box(const Box& b) {
  return {{"lower", vector(b.lower, "lower")}, {"upper", vector(b.upper, "upper")}};
}

Json tree(const Tree& t) {
  Json visits = Json::array();
  for (const TreeVisit& visit : t.visits)
    visits.push_back({{"box", box(visit.box)},
                      {"depth", visit.depth},
                      {"leaf", visit.leaf},
                      {"overlaps", visit.overlaps}});
  return {{"shape", t.shape},
          {"box", box(t.box)},
          {"visits", std::move(visits)},
          {"candidates", t.candidates}};
}

Json cache(const Cache& c) {
  Json json = {{"hit", c.hit}, {"kind", c.kind}, {"axis", c.axis}};
  if (c.normal) json["normal"] = vector(*c.normal, "normal");
  if (c.moved) json["moved"] = number(*c.moved, "moved");
  return json;
}

Json pair(const Pair& p) {
  Json json = {{"a", p.a}, {"b", p.b}};
  if (!p.label.empty()) json["label"] = p.label;
  json["kind"] = p.kind;
  json["state"] = p.state;
  json["separation"] = number(p.separation, "separation");
  json["manifolds"] = Json::array();
  for (const Manifold& m : p.manifolds) json["manifolds"].push_back(manifold(m));
  if (p.sat) json["sat"] = sat(*p.sat);
  if (p.clip) json["clip"] = clip(*p.clip);
  if (p.reduction) json["reduction"] = reduction(*p.reduction);
  if (p.gjk) json["gjk"] = gjk(*p.gjk);
  if (p.tree) json["tree"] = tree(*p.tree);
  if (p.degenerate)
    json["degenerate"] = {{"geometry", p.degenerate->geometry}, {"answer", p.degenerate->answer}};
  if (p.cache) json["cache"] = cache(*p.cache);
  if (p.penetration) json["penetration"] = penetration(*p.penetration);
  if (p.minkowski) json["minkowski"] = minkowski(*p.minkowski);
  if (p.incremental) json["incremental"] = incremental(*p.incremental);
  if (p.stability) json["stability"] = stability(*p.stability);
  return json;
}

Json pose(const Pose<double>& p) {
  const Quatd& q = p.rotation;
  return {{"position", vector(p.position, "position")},
          {"quat_wxyz", Json::array({number(q.w(), "quat_wxyz"), number(q.x(), "quat_wxyz"),
                                     number(q.y(), "quat_wxyz"), number(q.z(), "quat_wxyz")})}};
}

}  // namespace

std::string to_json_line(const Header& header) {
  Json shapes = Json::object();
  for (const Shape& s : header.shapes) shapes[s.name] = shape(s);
  const Json json = {{"schema", kSchema},       {"scenario", header.scenario},
                     {"title", header.title},   {"source", header.source},
                     {"scalar", header.scalar}, {"up", header.up},
                     {"frames", header.frames}, {"shapes", std::move(shapes)}};
  return json.dump();
}

std::string to_json_line(const Frame& frame) {
  Json poses = Json::object();
  for (const auto& [name, p] : frame.poses) poses[name] = pose(p);
  Json pairs = Json::array();
  for (const Pair& p : frame.pairs) pairs.push_back(pair(p));
  Json json = {{"frame", frame.frame},
               {"time", number(frame.time, "time")},
               {"poses", std::move(poses)},
               {"pairs", std::move(pairs)}};
  if (frame.solver) json["solver"] = solver(*frame.solver);
  if (frame.totals) json["totals"] = totals(*frame.totals);
  return json.dump();
}

}  // namespace contactscope::trace
