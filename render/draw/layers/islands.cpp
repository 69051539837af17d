#include "draw/layers/layer.h"
#include "draw/scene/pairs.h"

/// Bodies joined by contacts fall asleep and wake together: Catto 2010, "Islands". Islands follow
/// from the trace: bodies joined by contact points, except static ones. The trace records whether
/// an island sleeps. Without sleeping, it rests for the number of frames in which none of its
/// bodies moved.
namespace contactscope::draw {
namespace {

constexpr double kUnmoved = 1e-4;  // of a body's radius, per frame
constexpr int kMinRest = 2;        // frames: less may be a turning point
constexpr float kTint = 0.22f;     // opacity over a body's fill

template <const Color& kInk>
constexpr Swatch kIslandSwatch{LegendGroup::Trees, 9,
                               [](auto& pen) {
                                 pen.level_line(3, 19, 2.5, kInk);
                                 for (const double at : {3.0, 19.0}) pen.disc(pen.at(at), 4, kInk);
                               },
                               kInk};

/// Island of each body of the solver.
std::vector<std::size_t> islands_of(const Scene& scene) {
  const auto bodies = scene.bodies();
  std::vector<std::size_t> island(bodies.size());
  std::iota(island.begin(), island.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (island[i] != i) i = island[i] = island[island[i]];
    return i;
  };
  const auto place = [&](std::string_view name) {
    return static_cast<std::size_t>(std::ranges::find(bodies, name, &trace::Body::name) -
                                    bodies.begin());
  };
  for (const trace::Pair& pair : scene.frame.pairs) {
    if (all_points(pair).empty()) continue;
    const std::size_t a = place(pair.a), b = place(pair.b);
    if (a == bodies.size() || b == bodies.size()) continue;
    const std::size_t of_a = root(a), of_b = root(b);
    island[std::max(of_a, of_b)] = std::min(of_a, of_b);
  }
  for (std::size_t i = 0; i < island.size(); ++i) island[i] = root(i);
  return island;
}

/// Number of frames up to this one in which the body has not moved.
int rest_of(const Scene& scene, const trace::Body& body) {
  const PlacedShape* shape = scene.find(body.name);
  if (scene.sequence == nullptr || shape == nullptr || !std::isfinite(shape->mesh->radius))
    return 0;
  const double radius = shape->mesh->radius;
  const Pose<double>* later = &shape->pose;
  int frames = 0;
  for (auto past = scene.sequence->rbegin(); past != scene.sequence->rend(); ++past) {
    if (past->frame >= scene.frame.frame) continue;
    const auto pose = std::ranges::find(past->poses, body.name, &trace::Placement::first);
    if (pose == past->poses.end()) break;
    const double offset = (pose->second.position - later->position).norm();
    const double turn = pose->second.rotation.angularDistance(later->rotation);
    if (offset + radius * turn > kUnmoved * radius) break;
    later = &pose->second;
    ++frames;
  }
  return frames;
}

/// Tints a body in its island's colour, which is noticed before any line.
void tint(const Camera& camera, const PlacedShape& shape, const Color& color, Sketch& sketch) {
  const Color fill = with_alpha(color, kTint);
  if (shape.traced().radius > 0) {
    const std::vector<Vec3d> outline =
        RoundBody{shape.vertices, shape.traced().radius}.outline(camera);
    if (outline.size() > 2) sketch.surfaces.push_back({outline, fill});
    return;
  }
  for (int face = 0; face < count_of(shape.traced().faces); ++face) {
    const std::vector<Vec3d> polygon = shape.polygon(face);
    if (camera.faces(polygon.front(), shape.normal(face)))
      sketch.surfaces.push_back({polygon, fill});
  }
}

void draw_islands(const Scene& scene, Sketch& sketch) {
  const auto bodies = scene.bodies();
  const std::vector<std::size_t> island = islands_of(scene);
  const Vec3d up = scene.camera.up();
  for (const trace::Pair& pair : scene.frame.pairs) {
    const trace::Body* a = scene.body(pair.a);
    const trace::Body* b = scene.body(pair.b);
    if (a == nullptr || b == nullptr || all_points(pair).empty()) continue;
    const Color color = a->asleep == true && b->asleep == true ? kQuietText : kBox;
    sketch.bordered_line(a->center_of_mass, b->center_of_mass, {4.0f, color}, 7.0f);
  }
  int number = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (island[i] != i) continue;
    const bool asleep = bodies[i].asleep == true;  // like all bodies of its island
    const Color color = asleep ? kQuietText : kBox;
    std::size_t members = 0;
    int rest = std::numeric_limits<int>::max();
    const trace::Body* highest = &bodies[i];
    for (std::size_t k = i; k < bodies.size(); ++k) {
      if (island[k] != i) continue;
      const trace::Body& body = bodies[k];
      ++members;
      if (!asleep) rest = std::min(rest, rest_of(scene, body));
      if (up.dot(body.center_of_mass - highest->center_of_mass) > 0) highest = &body;
      sketch.mark(MarkKind::Node, body.center_of_mass, color);
      if (const PlacedShape* shape = scene.find(body.name); shape != nullptr && !scene.crowded())
        tint(scene.camera, *shape, color, sketch);
    }
    ++number;
    if (asleep)
      sketch.explain(kIslandSwatch<kQuietText>, "island that sleeps");
    else
      sketch.explain(kIslandSwatch<kBox>, "island: bodies that contacts join");
    if (scene.crowded()) continue;
    std::string text =
        "island " + std::to_string(number) + ": " + counted(members, "body", "bodies");
    if (asleep)
      text += ", asleep";
    else if (bodies[i].asleep)
      text += ", awake";
    else if (rest >= kMinRest)
      text += ", unmoved for " + std::to_string(rest) + " frames";
    // Above the bodies: the text is as wide as a body and would cover its edges.
    Vec3d top = highest->center_of_mass;
    if (const PlacedShape* shape = scene.find(highest->name)) {
      double reach = 0;
      for (const Vec3d& p : extent_points(*shape)) reach = std::max(reach, up.dot(p - top));
      top += reach * up;
    }
    sketch.label(top, text, color, 16, 9, up);
  }
}

}  // namespace

const LayerDrawing kIslandsLayer{.above = draw_islands};

}  // namespace contactscope::draw
