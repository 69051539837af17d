#include <algorithm>
#include <cmath>
#include <numbers>

#include "draw/layers/layer.h"
#include "draw/scene/pairs.h"
#include "draw/scene/points.h"

namespace contactscope::draw {
namespace {

// Pixels. Shorter, an arrow would hide behind the dots of its contact.
constexpr double kLeastArrow = 8;
constexpr double kLeastLean = 3;  // degrees

constexpr Swatch kNormalSwatch{LegendGroup::Forces, 0,
                               [](auto& pen) { pen.arrow(3, 10, kNormal); }};
constexpr Swatch kUsualNormalSwatch{LegendGroup::Forces, 1,
                                    [](auto& pen) { pen.arrow(2, 8, kDropped); }};

// Whether an arrow that starts here has room in the view for so many pixels, as it is seen: one
// that points at the eye has not.
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

/// The mesh of the pair and a triangle of it: that triangle's own normal, unit, whichever way.
std::optional<Vec3d> face_normal(const Scene& scene, const trace::Pair& pair,
                                 const trace::Manifold& manifold) {
  if (!manifold.triangle) return std::nullopt;
  for (const std::string* name : {&pair.a, &pair.b}) {
    const PlacedShape* shape = scene.find(*name);
    if (shape == nullptr || !shape->is_mesh()) continue;
    const std::vector<Vec3d> corners = shape->polygon(*manifold.triangle);
    return Vec3d((corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized());
  }
  return std::nullopt;
}

/// Degrees by which a contact of a mesh leans from the normal that its triangle shares with another one of
/// the pair, whose contact has that normal: an edge that the surface lacks made it lean. 0 where none does.
double lean_of(const Scene& scene, const trace::Pair& pair, const trace::Manifold& manifold) {
  constexpr double kParallel = 0.9998;  // cosine
  const std::optional<Vec3d> own = face_normal(scene, pair, manifold);
  if (!own) return 0;
  const bool any_upright = std::ranges::any_of(pair.manifolds, [&](const trace::Manifold& other) {
    const std::optional<Vec3d> face = face_normal(scene, pair, other);
    return face && std::abs(face->dot(*own)) > kParallel &&
           std::abs(face->dot(other.normal)) > kParallel;
  });
  const double cosine = std::abs(own->dot(manifold.normal));
  return any_upright && cosine < kParallel ? std::acos(cosine) * 180 / std::numbers::pi : 0;
}

void draw_normals(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  // A mesh's arrows, as long as elsewhere, would be a wood.
  const bool many = pair.manifolds.size() > kFewManifolds;
  const std::optional<Vec3d> usual = usual_normal(scene.frame);
  for (const trace::Manifold& manifold : pair.manifolds) {
    if (manifold.points.empty()) continue;
    const bool steps_back = usual && is_like(*usual, manifold.normal);
    const bool stands_out = usual && !steps_back;
    const Arrow arrow{.from = start_of_normal(scene, pair, manifold),
                      .direction = manifold.normal,
                      .pixels = steps_back            ? 26.0f
                                : many && !stands_out ? 44.0f
                                                      : 78.0f,
                      .width = steps_back            ? 1.5f
                               : many && !stands_out ? 2.0f
                                                     : 3.0f,
                      .head = steps_back            ? 7.0f
                              : many && !stands_out ? 9.0f
                                                    : 13.0f,
                      .color = steps_back ? kDropped : kNormal};
    if (!has_room(scene.camera, arrow)) continue;
    sketch.arrows.push_back(arrow);
    const Vec3d ahead = arrow.from + 0.7 * arrow.pixels /
                                         scene.camera.pixels_per_metre(arrow.from) *
                                         arrow.direction;
    const double lean = usual ? 0 : lean_of(scene, pair, manifold);
    if (lean >= kLeastLean)
      sketch.label(ahead, printed("leans %.0f°", lean), kNormal, 18, 12,
                   Vec3d(-scene.camera.right()));
    if (steps_back)
      sketch.explain(kUsualNormalSwatch, "normal and points as most have them", ahead);
    else
      sketch.explain(kNormalSwatch, "normal, from A to B", ahead);
  }
}

}  // namespace

const LayerDrawing kNormalsLayer{.result = draw_normals};

}  // namespace contactscope::draw
