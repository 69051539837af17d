#include "trace/penetration_json.h"

#include <utility>

namespace contactscope::trace {
namespace {

Json polytope(const Polytope& p) {
  return {{"vertices", simplex(p.vertices)},
          {"faces", p.faces},
          {"nearest", p.nearest},
          {"distance", number(p.distance, "distance")}};
}

Polytope read_polytope(const Node& node) {
  Polytope polytope;
  polytope.vertices = read_simplex(node.at("vertices"));
  for (const Node& face : node.at("faces").items())
    polytope.faces.push_back(face.indices<3>(polytope.vertices.size(), "vertices"));
  const Node nearest = node.at("nearest");
  // One without faces, such as a flat start, has no nearest one either.
  polytope.nearest =
      nearest.integer() < 0 ? -1 : nearest.index(polytope.faces.size(), "faces of the polytope");
  polytope.distance = node.at("distance").number();
  return polytope;
}

}  // namespace

Json simplex(const Simplex& s) {
  Json vertices = Json::array();
  for (const SimplexVertex& vertex : s)
    vertices.push_back({{"a", vector(vertex.a, "a")}, {"b", vector(vertex.b, "b")}});
  return vertices;
}

Simplex read_simplex(const Node& node) {
  Simplex simplex;
  for (const Node& vertex : node.items())
    simplex.push_back({vertex.at("a").vector(), vertex.at("b").vector()});
  return simplex;
}

Json penetration(const Penetration& p) {
  Json json = {{"method", p.method}, {"status", p.status}};
  if (!p.fallback.empty()) json["fallback"] = p.fallback;
  json["iterations"] = p.iterations;
  json["depth"] = number(p.depth, "depth");
  json["normal"] = vector(p.normal, "normal");
  json["point_a"] = vector(p.point_a, "point_a");
  json["point_b"] = vector(p.point_b, "point_b");
  const auto list = [&json](const char* key, const auto& items, auto&& write) {
    if (items.empty()) return;
    Json& array = json[key] = Json::array();
    for (const auto& item : items) array.push_back(write(item));
  };
  list("polytopes", p.polytopes, polytope);
  list("portals", p.portals, simplex);
  list("directions", p.directions, [](const SampledDirection& d) -> Json {
    return {{"normal", vector(d.normal, "normal")},
            {"separation", number(d.separation, "separation")}};
  });
  return json;
}

Penetration read_penetration(const Node& node) {
  Penetration p;
  p.method = node.at("method").string();
  p.status = node.at("status").string();
  p.fallback = node.string_or_empty("fallback");
  p.iterations = node.at("iterations").integer();
  p.depth = node.at("depth").number();
  p.normal = node.at("normal").vector();
  p.point_a = node.at("point_a").vector();
  p.point_b = node.at("point_b").vector();
  if (const auto polytopes = node.find("polytopes")) {
    for (const Node& item : polytopes->items()) p.polytopes.push_back(read_polytope(item));
  }
  if (const auto portals = node.find("portals")) {
    for (const Node& item : portals->items()) p.portals.push_back(read_simplex(item));
  }
  if (const auto directions = node.find("directions")) {
    for (const Node& item : directions->items())
      p.directions.push_back({item.at("normal").vector(), item.at("separation").number()});
  }
  return p;
}

Json minkowski(const Minkowski& m) {
  return {{"vertices", vectors(m.vertices, "vertices")}, {"faces", m.faces}};
}

Minkowski read_minkowski(const Node& node) {
  Minkowski m;
  m.vertices = node.at("vertices").vectors();
  m.faces = node.at("faces").faces(m.vertices.size());
  return m;
}

}  // namespace contactscope::trace
