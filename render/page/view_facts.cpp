#include "draw/scene/pairs.h"
#include "page/facts.h"

namespace contactscope::page {
namespace {

/// Projected corners; empty if one is behind the eye.
std::vector<draw::Point2> seen(const draw::Staging& staging, const std::vector<Vec3d>& polygon) {
  std::vector<draw::Point2> corners;
  for (const Vec3d& corner : polygon) {
    const std::optional<draw::Point2> at = staging.camera.project(corner);
    if (!at) return {};
    corners.push_back(*at);
  }
  return corners;
}

double area_on_screen(const std::vector<draw::Point2>& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    twice += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return 0.5 * std::abs(twice);
}

/// The axis of a normal as part of a sentence.
std::string axis_words(const std::string& axis, const trace::Pair& pair) {
  if (axis == "face_a") return "face of " + pair.a;
  if (axis == "face_b") return "face of " + pair.b;
  if (axis == "edge_edge") return "two crossing edges";
  return axis == "closest_points" ? "closest points" : axis;
}

std::string state_words(const trace::Pair& pair) {
  const bool touches = pair.state == "touching";
  if (pair.query) return pair.overlap.value_or(touches) ? "overlapping" : "separated";
  if (touches) return pair.separation > 0 ? "within the margin" : "touching";
  return pair.separation < 0 ? "overlapping, without contact" : "separated";
}

std::string count_words(const trace::Pair& pair) {
  const std::size_t count = draw::all_points(pair).size();
  std::string text = std::to_string(count);
  if (pair.manifolds.size() > 1)
    text += " in " + std::to_string(pair.manifolds.size()) + " manifolds";
  else if (pair.reduction && pair.reduction->points.size() > count)
    text += " of " + std::to_string(pair.reduction->points.size()) + " kept by " +
            pair.reduction->method;
  return text;
}

AreaFacts face_of(const trace::ClipFace& face, const char* what, Layer layer,
                  const trace::Pair& pair, const draw::Staging& staging) {
  AreaFacts facts{.key = std::string(what) + "|" + pair.a + "|" + pair.b + "|" + pair.label,
                  .name = what,
                  .of = draw::pair_name(pair),
                  .layer = std::string(name_of(layer)),
                  .polygon = seen(staging, face.polygon)};
  if (face.face >= 0)
    facts.rows.emplace_back("face", std::to_string(face.face) + " of " + face.shape);
  else
    facts.rows.emplace_back("of", face.shape);
  facts.rows.emplace_back("corners", std::to_string(face.polygon.size()));
  if (!face.normal.isZero(0)) facts.rows.emplace_back("normal", spell_vector(face.normal));
  return facts;
}

void add_clip(const trace::Pair& pair, const draw::Staging& staging, const trace::Frame& frame,
              const draw::Drawing& drawing, std::vector<AreaFacts>& all) {
  const trace::Clip& clip = *pair.clip;
  const std::string parts = parts_of(pair);
  if (!clip.steps.empty() && shows_layer(drawing, name_of(Layer::ClipPolygons), parts)) {
    const bool story = staging.view.story == Story::ClipSteps;
    const int done = std::min(story ? frame.frame : count_of(clip.steps), count_of(clip.steps));
    if (done > 0) {
      const trace::Polygon& left = at(clip.steps, done - 1).polygon;
      all.push_back({.key = "clip|" + parts + "|" + pair.label,
                     .name = "clip polygon",
                     .of = draw::pair_name(pair),
                     .layer = std::string(name_of(Layer::ClipPolygons)),
                     .polygon = seen(staging, left),
                     .rows = {{"cut by", std::to_string(done) + " of " +
                                             counted(clip.steps.size(), "side plane")},
                              {"corners", std::to_string(left.size())}}});
    }
  }
  if (shows_layer(drawing, name_of(Layer::IncidentFace), parts))
    all.push_back(face_of(clip.incident, "incident face", Layer::IncidentFace, pair, staging));
  if (shows_layer(drawing, name_of(Layer::ReferenceFace), parts))
    all.push_back(face_of(clip.reference, "reference face", Layer::ReferenceFace, pair, staging));
}

/// Outlines of shapes, nearest first. Omits meshes and planes, which are mostly the ground.
void add_shapes(const draw::Staging& staging, const trace::Frame& frame,
                std::vector<AreaFacts>& all) {
  const draw::Scene scene = draw::scene_of(staging, frame);
  if (scene.crowded()) return;
  std::vector<std::pair<double, AreaFacts>> shapes;
  for (const draw::PlacedShape& shape : scene.shapes) {
    const trace::Shape& traced = shape.traced();
    if (shape.is_mesh() || traced.half_space) continue;
    const std::vector<Vec3d> points = draw::extent_points(shape);
    std::vector<Vec2d> corners = draw::projected(staging.camera, points);
    if (corners.size() < points.size()) continue;
    AreaFacts facts{.key = "shape|" + traced.name,
                    .name = traced.name,
                    .of = {},
                    .layer = std::string(name_of(Layer::Shapes))};
    for (const Vec2d& corner : convex_polygon(std::move(corners)))
      facts.polygon.push_back(draw::pixel(corner));
    facts.rows.emplace_back("shape", traced.type);
    const trace::Body* const body = scene.body(traced.name);
    if (body != nullptr) facts.rows.emplace_back("mass", draw::spell_number(body->mass) + " kg");
    facts.rows.emplace_back("position", spell_vector(shape.pose.position) + " m");
    if (body != nullptr) facts.rows.emplace_back("velocity", spell_vector(body->velocity) + " m/s");
    const Vec3d middle = shape.pose.transform(traced.center_of_mass);
    shapes.emplace_back((middle - staging.camera.eye()).norm(), std::move(facts));
  }
  std::ranges::stable_sort(shapes, {}, [](const auto& shape) { return shape.first; });
  for (auto& [away, facts] : shapes) all.push_back(std::move(facts));
}

}  // namespace

std::vector<AreaFacts> area_facts(const draw::Staging& staging, const trace::Frame& frame,
                                  const draw::Drawing& drawing) {
  std::vector<AreaFacts> all;
  if (staging.cells) return all;
  for (const trace::Pair& pair : frame.pairs)
    if (pair.clip) add_clip(pair, staging, frame, drawing, all);
  std::erase_if(all, [](const AreaFacts& area) { return area.polygon.size() < 3; });
  // Smaller areas are on top.
  std::ranges::stable_sort(all, {},
                           [](const AreaFacts& area) { return area_on_screen(area.polygon); });
  if (shows_layer(drawing, name_of(Layer::Shapes))) add_shapes(staging, frame, all);
  std::erase_if(all, [](const AreaFacts& area) { return area.polygon.size() < 3; });
  return all;
}

std::vector<PairFacts> pair_facts(const trace::Frame& frame) {
  std::vector<PairFacts> all;
  for (const trace::Pair& pair : frame.pairs) {
    PairFacts facts{.key = pair.a + "|" + pair.b + "|" + pair.label,
                    .name = draw::pair_name(pair),
                    .parts = parts_of(pair)};
    FactRows& rows = facts.rows;
    rows.emplace_back("state", state_words(pair));
    if (pair.degenerate)
      rows.emplace_back("no normal", pair.degenerate->geometry + ": " + pair.degenerate->answer);
    const bool is_known = !pair.query || pair.query->gap;
    if (is_known && (pair.separation != 0 || !pair.manifolds.empty()))
      rows.push_back(gap_row(pair.query && pair.query->gap ? *pair.query->gap : pair.separation));
    if (pair.query) {
      rows.emplace_back(
          "query",
          pair.query->requested +
              (pair.query->bounds.empty() ? std::string() : " of bounds, " + pair.query->bounds));
      if (!pair.query->method.empty()) rows.emplace_back("method", pair.query->method);
    } else {
      rows.emplace_back("points", count_words(pair));
    }
    if (const std::string axis = draw::axis_of(pair); !axis.empty())
      rows.emplace_back("axis", axis_words(axis, pair));
    if (!pair.manifolds.empty()) {
      const trace::Manifold& manifold = pair.manifolds.front();
      rows.emplace_back("normal", spell_vector(manifold.normal) +
                                      (pair.a.empty() ? "" : ", " + pair.a + " to " + pair.b));
      if (!manifold.type.empty()) rows.emplace_back("features", manifold.type);
    }
    if (const double impulse = impulse_of(pair); impulse > 0)
      rows.emplace_back("impulses", draw::spell_quantity(impulse, "N s") + " in total");
    if (pair.stability) rows.emplace_back(pair.stability->shape, pair.stability->verdict);
    all.push_back(std::move(facts));
  }
  return all;
}

}  // namespace contactscope::page
