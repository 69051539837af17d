#include <algorithm>
#include <istream>
#include <map>
#include <string>

#include "core/input_error.h"
#include "trace/dynamics_json.h"
#include "trace/json.h"
#include "trace/penetration_json.h"
#include "trace/read_node.h"

namespace contactscope::trace {
namespace {

/// Undirected edges in the order in which the faces first run along them.
std::vector<std::array<int, 2>> edges_of(const std::vector<std::vector<int>>& faces) {
  std::vector<std::array<int, 2>> edges;
  std::map<std::array<int, 2>, bool> seen;
  for (const std::vector<int>& face : faces)
    for (std::size_t i = 0; i < face.size(); ++i) {
      const int from = face[i];
      const int to = face[(i + 1) % face.size()];
      if (seen.emplace(std::array<int, 2>{std::min(from, to), std::max(from, to)}, true).second)
        edges.push_back({from, to});
    }
  return edges;
}

Shape read_shape(const std::string& name, const Node& node) {
  Shape shape;
  shape.name = name;
  shape.type = node.string_or_empty("type");
  shape.vertices = node.at("vertices").vectors();
  shape.faces = node.at("faces").faces(shape.vertices.size());
  if (const auto edges = node.find("edges")) {
    for (const Node& edge : edges->items())
      shape.edges.push_back(edge.indices<2>(shape.vertices.size(), "vertices"));
  } else {
    shape.edges = edges_of(shape.faces);
  }
  shape.center_of_mass = node.vector_or_zero("center_of_mass");
  if (const auto radius = node.find("radius")) shape.radius = radius->number();
  if (const auto half_space = node.find("half_space"))
    shape.half_space =
        HalfSpace{half_space->at("normal").vector(), half_space->at("offset").number()};
  return shape;
}

Header read_header(const Node& node) {
  const Node schema = node.at("schema");
  if (schema.string() != kSchema)
    schema.fail("is '" + schema.string() + "'; '" + kSchema + "' is what can be read here");
  Header header;
  header.scenario = node.at("scenario").string();
  header.title = node.string_or_empty("title");
  header.source = node.string_or_empty("source");
  header.scalar = node.at("scalar").string();
  header.up = node.at("up").string();
  header.frames = node.at("frames").integer();
  for (const auto& [name, shape] : node.at("shapes").members())
    header.shapes.push_back(read_shape(name, shape));
  return header;
}

FaceAxis read_face_axis(const Node& node) {
  return {node.at("face").integer(), node.at("separation").number(), node.vector_or_zero("normal"),
          node.vector_or_zero("support")};
}

Sat read_sat(const Node& node) {
  Sat sat;
  if (const auto axis = node.find("face_a")) sat.face_a = read_face_axis(*axis);
  if (const auto axis = node.find("face_b")) sat.face_b = read_face_axis(*axis);
  if (const auto axis = node.find("edge"))
    sat.edge = EdgeAxis{axis->at("a").integer(),         axis->at("b").integer(),
                        axis->at("separation").number(), axis->vector_or_zero("normal"),
                        axis->vector_or_zero("point_a"), axis->vector_or_zero("point_b")};
  sat.chosen = node.at("chosen").string();
  sat.preference = node.string_or_empty("preference");
  if (const auto pairs = node.find("edge_pairs")) {
    for (const Node& pair : pairs->items())
      sat.edge_pairs.push_back({pair.at("a").integer(), pair.at("b").integer(),
                                pair.at("separation").number(), pair.at("normal").vector()});
  }
  return sat;
}

ClipFace read_clip_face(const Node& node) {
  return {node.at("shape").string(), node.at("face").integer(), node.vector_or_zero("normal"),
          node.at("polygon").vectors()};
}

Clip read_clip(const Node& node) {
  Clip clip;
  clip.reference = read_clip_face(node.at("reference"));
  clip.incident = read_clip_face(node.at("incident"));
  for (const Node& step : node.at("steps").items()) {
    const Node plane = step.at("plane");
    clip.steps.push_back(
        {plane.at("normal").vector(), plane.at("offset").number(), step.at("polygon").vectors()});
  }
  for (const Node& dropped : node.at("dropped").items())
    clip.dropped.push_back({dropped.at("position").vector(), dropped.at("reason").string()});
  return clip;
}

Choice read_choice(const Node& node, std::size_t points) {
  Choice choice;
  choice.rule = node.at("rule").string();
  if (const auto direction = node.find("direction")) choice.direction = direction->vector();
  for (const Node& item : node.at("measures").items()) {
    Measure measure;
    measure.point = item.at("point").index(points, "points");
    if (choice.is_against_edges()) measure.edge = item.at("edge").indices<2>(points, "points");
    measure.value = item.at("value").number();
    choice.measures.push_back(measure);
  }
  return choice;
}

Reduction read_reduction(const Node& node) {
  Reduction reduction;
  reduction.method = node.at("method").string();
  reduction.points = read_points(node.at("points"));
  for (const Node& kept : node.at("kept").items())
    reduction.kept.push_back(kept.index(reduction.points.size(), "points"));
  reduction.area = node.at("area").number();
  reduction.best_area = node.at("best_area").number();
  if (const auto best = node.find("best")) {
    for (const Node& index : best->items())
      reduction.best.push_back(index.index(reduction.points.size(), "points"));
  }
  if (const auto choices = node.find("choices")) {
    for (const Node& choice : choices->items())
      reduction.choices.push_back(read_choice(choice, reduction.points.size()));
  }
  return reduction;
}

Gjk read_gjk(const Node& node) {
  Gjk gjk;
  gjk.status = node.at("status").string();
  gjk.iterations = node.at("iterations").integer();
  gjk.distance = node.at("distance").number();
  gjk.point_a = node.at("point_a").vector();
  gjk.point_b = node.at("point_b").vector();
  for (const Node& step : node.at("steps").items()) gjk.steps.push_back(read_simplex(step));
  return gjk;
}

Box read_box(const Node& node) {
  return {node.at("lower").vector(), node.at("upper").vector()};
}

Tree read_tree(const Node& node) {
  Tree tree;
  tree.shape = node.at("shape").string();
  tree.box = read_box(node.at("box"));
  for (const Node& visit : node.at("visits").items())
    tree.visits.push_back({read_box(visit.at("box")), visit.at("depth").integer(),
                           visit.at("leaf").boolean(), visit.at("overlaps").boolean()});
  for (const Node& triangle : node.at("candidates").items())
    tree.candidates.push_back(triangle.integer());
  return tree;
}

Cache read_cache(const Node& node) {
  Cache cache;
  cache.hit = node.at("hit").boolean();
  cache.kind = node.at("kind").string();
  cache.axis = node.string_or_empty("axis");
  if (const auto normal = node.find("normal")) cache.normal = normal->vector();
  if (const auto moved = node.find("moved")) cache.moved = moved->number();
  return cache;
}

Pair read_pair(const Node& node) {
  Pair pair;
  pair.a = node.at("a").string();
  pair.b = node.at("b").string();
  pair.label = node.string_or_empty("label");
  pair.kind = node.at("kind").string();
  pair.state = node.at("state").string();
  pair.separation = node.at("separation").number();
  for (const Node& item : node.at("manifolds").items()) {
    Manifold manifold;
    manifold.normal = item.at("normal").vector();
    manifold.axis = item.at("axis").string();
    manifold.type = item.string_or_empty("type");
    if (const auto triangle = item.find("triangle")) manifold.triangle = triangle->integer();
    manifold.points = read_points(item.at("points"));
    pair.manifolds.push_back(std::move(manifold));
  }
  if (const auto sat = node.find("sat")) pair.sat = read_sat(*sat);
  if (const auto clip = node.find("clip")) pair.clip = read_clip(*clip);
  if (const auto reduction = node.find("reduction")) pair.reduction = read_reduction(*reduction);
  if (const auto cache = node.find("cache")) pair.cache = read_cache(*cache);
  if (const auto gjk = node.find("gjk")) pair.gjk = read_gjk(*gjk);
  if (const auto tree = node.find("tree")) pair.tree = read_tree(*tree);
  if (const auto degenerate = node.find("degenerate"))
    pair.degenerate =
        Degenerate{degenerate->at("geometry").string(), degenerate->at("answer").string()};
  if (const auto facts = node.find("penetration")) pair.penetration = read_penetration(*facts);
  if (const auto facts = node.find("minkowski")) pair.minkowski = read_minkowski(*facts);
  if (const auto facts = node.find("incremental")) pair.incremental = read_incremental(*facts);
  if (const auto facts = node.find("stability")) pair.stability = read_stability(*facts);
  return pair;
}

Frame read_frame(const Node& node) {
  Frame frame;
  frame.frame = node.at("frame").integer();
  frame.time = node.at("time").number();
  for (const auto& [name, pose] : node.at("poses").members()) {
    const std::vector<Node> q = pose.at("quat_wxyz").items();
    if (q.size() != 4) pose.fail("needs four numbers in 'quat_wxyz'");
    frame.poses.emplace_back(
        name, Pose<double>{Quatd(q[0].number(), q[1].number(), q[2].number(), q[3].number()),
                           pose.at("position").vector()});
  }
  for (const Node& pair : node.at("pairs").items()) frame.pairs.push_back(read_pair(pair));
  if (const auto solver = node.find("solver")) frame.solver = read_solver(*solver);
  if (const auto totals = node.find("totals")) frame.totals = read_totals(*totals);
  return frame;
}

}  // namespace

Trace read_trace(std::istream& in, const std::string& name) {
  Trace trace;
  bool has_header = false;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    try {
      const Json json = Json::parse(line);
      const Node node(json, "");
      if (has_header) {
        trace.frames.push_back(read_frame(node));
      } else {
        trace.header = read_header(node);
        has_header = true;
      }
    } catch (const nlohmann::json::parse_error& error) {
      throw InputError(name, number, static_cast<int>(error.byte),
                       "this line is no JSON from here on; a trace has one whole object on each "
                       "line, so it may be torn: make it again");
    } catch (const nlohmann::json::exception& error) {
      throw InputError(name, number, 1, std::string("not read: ") + error.what());
    } catch (const Complaint& complaint) {
      throw InputError(name, number, 1, complaint.message);
    }
  }
  if (!has_header)
    throw InputError(name, 0, 0,
                     std::string("the trace is empty; its first line must be a header with "
                                 "\"schema\":\"") +
                         kSchema + "\"");
  return trace;
}

}  // namespace contactscope::trace
