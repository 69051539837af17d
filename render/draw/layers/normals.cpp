#include <algorithm>

#include "draw/layers/layer.h"
#include "draw/scene/pairs.h"
#include "draw/scene/points.h"

namespace contactscope::draw {
namespace {

// Pixels. Shorter, an arrow would hide behind the dots of its contact.
constexpr double kLeastArrow = 8;
constexpr std::size_t kMany = 2;  // manifolds: a mesh's arrows, as long as usual, would be a wood

constexpr Swatch kNormalSwatch{LegendGroup::Forces, 0,
                               [](auto& pen) { pen.arrow(3, 10, kNormal); }};

// Whether an arrow that starts here has room in the view for so many pixels, as it is seen: one that
// points at the eye has not.
bool has_room(const Camera& camera, const Arrow& arrow) {
  const std::optional<Point2> a = camera.project(arrow.from);
  const std::optional<Point2> b = camera.project(
      arrow.from + arrow.pixels / camera.pixels_per_metre(arrow.from) * arrow.direction);
  if (!a || !b || !camera.viewport().contains(*a)) return false;
  const std::optional<Segment2> seen = clip_segment(camera.viewport(), *a, *b);
  return seen && distance(*a, seen->to) >= kLeastArrow;
}

// The middle of the points. Of a single one, the arrow begins where a whisker that runs the same
// way ends, for it would cover it.
Vec3d start_of_normal(const Scene& scene, const trace::Pair& pair,
                      const trace::Manifold& manifold) {
  const Vec3d middle = mean_of(mapped(manifold.points, &trace::Point::position));
  if (manifold.points.size() > 1 || !scene.shows(Layer::Contacts)) return middle;
  const auto [on_a, on_b] = whisker_at(scene, pair, {&manifold, &manifold.points.front()});
  const double ahead =
      std::max((on_a - middle).dot(manifold.normal), (on_b - middle).dot(manifold.normal));
  return middle + std::max(0.0, ahead) * manifold.normal;
}

void draw_normals(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const bool many = pair.manifolds.size() > kMany;
  for (const trace::Manifold& manifold : pair.manifolds) {
    if (manifold.points.empty()) continue;
    const Arrow arrow{.from = start_of_normal(scene, pair, manifold),
                      .direction = manifold.normal,
                      .pixels = many ? 44.0f : 78.0f,
                      .width = many ? 2.0f : 3.0f,
                      .head = many ? 9.0f : 13.0f,
                      .color = kNormal};
    if (!has_room(scene.camera, arrow)) continue;
    sketch.arrows.push_back(arrow);
    sketch.explain(kNormalSwatch, "normal, from A to B");
  }
}

}  // namespace

const LayerDrawing kNormalsLayer{.result = draw_normals};

}  // namespace contactscope::draw
