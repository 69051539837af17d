#include <algorithm>
#include <cmath>
#include <optional>

#include "draw/scene/palette.h"
#include "draw/scene/quantity.h"
#include "draw/scene/scene.h"

namespace contactscope::draw {
namespace {

constexpr double kLeastImpulse = 3;         // pixels
constexpr double kLeastFriction = 10;       // pixels: shorter, an open head is only a blot
constexpr std::size_t kLabelledPoints = 8;  // points: more numbers than these would be a crowd

// The colour of friction is too light for letters on white; the same hue, darkened.
constexpr Color kFrictionText = rgb(0x8A5F00);

// Impulses are drawn on the body that they move: b, unless only a is moved.
struct Moved {
  bool a = false, b = false;
};

Moved moved_of(const Scene& scene, const trace::Pair& pair) {
  if (!scene.frame.solver) return {false, true};
  const auto moved = [&](const std::string& name) {
    return std::ranges::any_of(scene.frame.solver->bodies,
                               [&](const trace::Body& body) { return body.name == name; });
  };
  return {moved(pair.a), moved(pair.b)};
}

bool shows_loads(const Scene& scene) {
  return scene.shows(Layer::Loads) && scene.scales.step > 0;
}

// Two strokes across an arrow that goes on.
void draw_break(const Scene& scene, const Vec3d& at, const Vec3d& along, const Color& color,
                Sketch& sketch) {
  const Vec3d across = along.cross(scene.camera.to_eye(at));
  if (!(across.norm() > 0)) return;
  const double pixel = 1 / scene.camera.pixels_per_metre(at);
  const Vec3d slanted = pixel * (6 * across.normalized() + 3 * along);
  for (const double shift : {-2.5, 2.5}) {
    const Vec3d middle = at + shift * pixel * along;
    sketch.lines.push_back({middle - slanted, middle + slanted, {5.0f, kWhite}, false});
    sketch.lines.push_back({middle - slanted, middle + slanted, {2.0f, color}, false});
  }
}

void draw_normal_impulse(const Scene& scene, const trace::Point& point, const Vec3d& out,
                         Sketch& sketch) {
  const SequenceScales& scales = scene.scales;
  const double length = scales.impulse * point.impulse->normal;
  const double drawn = std::min(length, scales.longest_impulse);
  const double pixels = scene.camera.pixels_per_metre(point.position);
  const double warm = std::min(scales.impulse * point.impulse->warm_start, scales.longest_impulse);
  if (warm * pixels >= kLeastImpulse) {
    const Vec3d end = point.position + warm * out;
    sketch.lines.push_back({point.position, end, {9.0f, kContact}, false});
    sketch.lines.push_back({point.position, end, {6.0f, kWhite}, true});
    if (scales.impulse * point.impulse->warm_start > warm) {
      draw_break(scene, point.position + 0.6 * warm * out, out, kContact, sketch);
      sketch.explain(LegendKind::BreakMark, "longer than drawn");
    }
    sketch.explain(LegendKind::WarmStart, "kept of the step before");
  }
  if (drawn * pixels < kLeastImpulse) return;
  sketch.arrows.push_back(arrow_to_scale(point.position, drawn * out, 3, 12, kContact));
  sketch.arrows.back().halo = false;
  if (length > drawn) {
    draw_break(scene, point.position + 0.6 * drawn * out, out, kContact, sketch);
    sketch.explain(LegendKind::BreakMark, "longer than drawn");
  }
  const bool loads = shows_loads(scene);
  sketch.explain(LegendKind::NormalImpulse,
                 loads ? "normal force, " + spell_impulse_scale(scales.impulse * scales.step, "N")
                       : "normal impulse, " + spell_impulse_scale(scales.impulse));
}

void draw_friction(const Scene& scene, const trace::Point& point, double side, Sketch& sketch) {
  const SequenceScales& scales = scene.scales;
  const double length = scales.impulse * point.impulse->normal;
  const bool own_scale = scales.friction != scales.impulse;
  // Cut as the normal's arrow is, so that the two still make the angle that they do.
  const double share =
      own_scale ? 1.0 : std::min(1.0, scales.longest_impulse / std::max(length, 1e-300));
  const Vec3d way = side * share * scales.friction * point.impulse->friction;
  // As it is seen: towards the eye it would be a blot too.
  const std::optional<Point2> from = scene.camera.project(point.position);
  const std::optional<Point2> to = scene.camera.project(point.position + way);
  if (!from || !to) return;
  if (std::hypot(to->x - from->x, to->y - from->y) < kLeastFriction * scales.pixel) return;
  Arrow arrow = arrow_to_scale(point.position, way, 2.5f, 10, kIncidentFace);
  arrow.open = true;
  sketch.arrows.push_back(arrow);
  if (share < 1) {
    draw_break(scene, point.position + 0.6 * way, way.normalized(), kIncidentFace, sketch);
  }
  const bool loads = shows_loads(scene);
  sketch.explain(LegendKind::FrictionImpulse,
                 !own_scale ? "friction, same scale"
                 : loads    ? "friction, " + spell_impulse_scale(scales.friction * scales.step, "N")
                            : "friction, " + spell_impulse_scale(scales.friction));
}

// What the pair's points carry together, beside the one that is farthest to the right.
void draw_load(const Scene& scene, const trace::Pair& pair, double side, Sketch& sketch) {
  const Vec3d right = scene.camera.right();
  const trace::Point* outermost = nullptr;
  double normal = 0;
  Vec3d friction = Vec3d::Zero();
  for (const trace::Manifold& manifold : pair.manifolds) {
    for (const trace::Point& point : manifold.points) {
      if (!point.impulse) continue;
      normal += point.impulse->normal;
      friction += side * point.impulse->friction;
      if (outermost == nullptr || right.dot(point.position - outermost->position) > 0) {
        outermost = &point;
      }
    }
  }
  if (outermost == nullptr || !(normal > 0)) return;
  const double step = scene.scales.step;
  sketch.labels.push_back({.at = outermost->position,
                           .text = spell_quantity(normal / step, "N"),
                           .color = kContact,
                           .size = 17,
                           .bold = true,
                           .clearance = 12,
                           .direction = right});
  if (!scene.shows(Layer::Friction) || friction.norm() < 1e-6 * normal) return;
  const Vec3d way = side * scene.scales.friction * outermost->impulse->friction;
  sketch.labels.push_back({.at = outermost->position + way,
                           .text = spell_quantity(friction.norm() / step, "N"),
                           .color = kFrictionText,
                           .size = 17,
                           .bold = true,
                           .clearance = 10,
                           .direction = friction.normalized()});
}

}  // namespace

// Gregorius 2015, "Recap: Solving Contact": what the solver gave each point in the step from here.
void draw_impulses(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (scene.scales.impulse == 0) return;
  const Moved moved = moved_of(scene, pair);
  const double side = moved.a && !moved.b ? -1 : 1;
  const bool loads = shows_loads(scene);
  if (loads) draw_load(scene, pair, side, sketch);
  std::size_t points = 0;
  for (const trace::Pair& other : scene.frame.pairs) {
    for (const trace::Manifold& manifold : other.manifolds) points += manifold.points.size();
  }
  for (const trace::Manifold& manifold : pair.manifolds) {
    const Vec3d out = side * manifold.normal;
    for (const trace::Point& point : manifold.points) {
      if (!point.impulse) continue;
      const std::optional<Point2> seen = scene.camera.project(point.position);
      if (!seen || !scene.camera.viewport().contains(*seen)) continue;
      if (!scene.shows(Layer::Contacts)) {
        sketch.marks.push_back({MarkKind::Core, point.position, kContact});
      }
      draw_normal_impulse(scene, point, out, sketch);
      if (moved.a && moved.b && points == 1) draw_normal_impulse(scene, point, -out, sketch);
      draw_friction(scene, point, side, sketch);
      const double length = scene.scales.impulse * point.impulse->normal;
      const double pixels = scene.camera.pixels_per_metre(point.position);
      if (loads || points > kLabelledPoints || length * pixels < kLeastImpulse) continue;
      const Vec3d tip = point.position + std::min(length, scene.scales.longest_impulse) * out;
      sketch.labels.push_back({.at = tip,
                               .text = spell_quantity(point.impulse->normal, "N s"),
                               .color = kContact,
                               .size = 15,
                               .bold = true,
                               .clearance = 8,
                               .direction = out});
    }
  }
}

}  // namespace contactscope::draw
