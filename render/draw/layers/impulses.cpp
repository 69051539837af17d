#include <algorithm>
#include <cmath>

#include "draw/layers/layer.h"
#include "draw/scene/pair_points.h"
#include "draw/scene/quantity.h"

/// Gregorius 2015, "Recap: Solving Contact": what the solver gave each point in the step from here.
/// Layers loads and friction are ways of layer impulses to show it.
namespace contactscope::draw {
namespace {

constexpr double kLeastImpulse = 3;         // pixels
constexpr double kLeastFriction = 10;       // pixels: shorter, an open head is only a blot
constexpr std::size_t kLabelledPoints = 8;  // points: more numbers than these would be a crowd

// The colour of friction is too light for letters on white; the same hue, darkened.
constexpr Color kFrictionText = rgb(0x8A5F00);

constexpr Swatch kNormalImpulseSwatch{LegendGroup::Forces, 1,
                                      [](auto& pen) { pen.arrow(3, 10, kContact); }};
constexpr Swatch kWarmStartSwatch{LegendGroup::Forces, 2, [](auto& pen) {
                                    pen.level_line(0, 22, 9, kContact);
                                    pen.level_line(1.5, 20.5, 6, kWhite);
                                  }};
constexpr Swatch kFrictionSwatch{LegendGroup::Forces, 3,
                                 [](auto& pen) { pen.open_arrow(2.5, kIncidentFace); }};
// Two strokes across a line that goes on.
constexpr Swatch kBreakSwatch{LegendGroup::Forces, 4, [](auto& pen) {
                                pen.level_line(0, 8.5, 3, kContact);
                                pen.level_line(14, 22, 3, kContact);
                                for (const double at : {9.0, 13.0}) {
                                  const Point2 middle = pen.at(at);
                                  const float rise = pen.px(6), lean = pen.px(2);
                                  pen.line({middle.x - lean, middle.y + rise},
                                           {middle.x + lean, middle.y - rise}, 1.8, kContact);
                                }
                              }};

bool shows_loads(const Scene& scene) {
  return scene.shows(Layer::Loads) && scene.scales.step > 0;
}

/// Impulses are drawn on the body that they move: b, unless only a is moved.
struct Moved {
  bool a = false, b = true;
  double side() const { return a && !b ? -1 : 1; }
};

Moved moved_of(const Scene& scene, const trace::Pair& pair) {
  if (!scene.frame.solver) return {};
  return {scene.body(pair.a) != nullptr, scene.body(pair.b) != nullptr};
}

/// What is drawn at a point, metres along the normal; nothing of what is 0.
struct Drawn {
  double normal = 0, warm = 0;
  bool normal_cut = false, warm_cut = false;  // longer than drawn
  Vec3d friction = Vec3d::Zero();
  bool friction_cut = false;
};

Drawn drawn_at(const Scene& scene, const trace::Point& point, double side) {
  const SequenceScales& scales = scene.scales;
  const double pixels = scene.camera.pixels_per_metre(point.position);
  const auto cut = [&](double impulse, double& length, bool& is_cut) {
    const double whole = scales.impulse * impulse;
    const double shown = std::min(whole, scales.longest_impulse);
    if (shown * pixels < kLeastImpulse) return;
    length = shown;
    is_cut = whole > shown;
  };
  Drawn drawn;
  cut(point.impulse->normal, drawn.normal, drawn.normal_cut);
  cut(point.impulse->warm_start, drawn.warm, drawn.warm_cut);
  const double length = scales.impulse * point.impulse->normal;
  const bool own_scale = scales.friction != scales.impulse;
  // Cut as the normal's arrow is, so that the two still make the angle that they do.
  const double share =
      own_scale ? 1.0 : std::min(1.0, scales.longest_impulse / std::max(length, 1e-300));
  const Vec3d way = side * share * scales.friction * point.impulse->friction;
  // As it is seen: towards the eye it would be a blot too.
  const auto seen = seen_distance(scene.camera, point.position, point.position + way);
  if (seen && *seen >= kLeastFriction * scales.pixel) {
    drawn.friction = way;
    drawn.friction_cut = share < 1;
  }
  return drawn;
}

/// Points that have an impulse, in the picture.
std::vector<PairPoint> pushed_points(const Scene& scene, const trace::Pair& pair) {
  if (scene.scales.impulse == 0) return {};
  std::vector<PairPoint> points = all_points(pair);
  std::erase_if(points, [&](const PairPoint& any) {
    return !any.point->impulse || !scene.camera.sees(any.point->position);
  });
  return points;
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
    sketch.line(middle - slanted, middle + slanted, {5.0f, kWhite});
    sketch.line(middle - slanted, middle + slanted, {2.0f, color});
  }
}

void draw_normal_impulse(const Scene& scene, const Drawn& drawn, const Vec3d& at, const Vec3d& out,
                         Sketch& sketch) {
  if (drawn.warm > 0) {
    sketch.bordered_line(at, at + drawn.warm * out, {6.0f, kWhite}, 9.0f, kContact);
    if (drawn.warm_cut) draw_break(scene, at + 0.6 * drawn.warm * out, out, kContact, sketch);
  }
  if (!(drawn.normal > 0)) return;
  sketch.arrows.push_back(arrow_to_scale(at, drawn.normal * out, 3, 12, kContact));
  sketch.arrows.back().halo = false;
  if (drawn.normal_cut) draw_break(scene, at + 0.6 * drawn.normal * out, out, kContact, sketch);
}

void draw_friction(const Scene& scene, const Drawn& drawn, const Vec3d& at, Sketch& sketch) {
  if (drawn.friction.isZero(0)) return;
  sketch.arrows.push_back(arrow_to_scale(at, drawn.friction, 2.5f, 10, kIncidentFace));
  sketch.arrows.back().open = true;
  if (drawn.friction_cut)
    draw_break(scene, at + 0.6 * drawn.friction, drawn.friction.normalized(), kIncidentFace,
               sketch);
}

// What the pair's points carry together, beside the one that is farthest to the right.
void draw_load(const Scene& scene, const trace::Pair& pair, double side, Sketch& sketch) {
  const Vec3d right = scene.camera.right();
  const trace::Point* outermost = nullptr;
  double normal = 0;
  Vec3d friction = Vec3d::Zero();
  for (const PairPoint& any : all_points(pair)) {
    const trace::Point& point = *any.point;
    if (!point.impulse) continue;
    normal += point.impulse->normal;
    friction += side * point.impulse->friction;
    if (outermost == nullptr || right.dot(point.position - outermost->position) > 0)
      outermost = &point;
  }
  if (outermost == nullptr || !(normal > 0)) return;
  const double step = scene.scales.step;
  sketch.label(outermost->position, spell_quantity(normal / step, "N"), kContact, 17, 12, right);
  if (!scene.shows(Layer::Friction) || friction.norm() < 1e-6 * normal) return;
  const Vec3d way = side * scene.scales.friction * outermost->impulse->friction;
  sketch.label(outermost->position + way, spell_quantity(friction.norm() / step, "N"),
               kFrictionText, 17, 10, Vec3d(friction.normalized()));
}

void explain_impulse(const Scene& scene, const Drawn& drawn, bool loads, Legend& legend) {
  const SequenceScales& scales = scene.scales;
  const auto scale = [&](double metres) {
    return loads ? spell_impulse_scale(metres * scales.step, "N") : spell_impulse_scale(metres);
  };
  if (drawn.warm > 0) legend.explain(kWarmStartSwatch, "kept of the step before");
  if (drawn.warm_cut || drawn.normal_cut) legend.explain(kBreakSwatch, "longer than drawn");
  if (drawn.normal > 0)
    legend.explain(kNormalImpulseSwatch,
                   (loads ? "normal force, " : "normal impulse, ") + scale(scales.impulse));
  if (!drawn.friction.isZero(0))
    legend.explain(kFrictionSwatch, scales.friction == scales.impulse
                                        ? "friction, same scale"
                                        : "friction, " + scale(scales.friction));
}

void draw_impulses(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (scene.scales.impulse == 0) return;
  const Moved moved = moved_of(scene, pair);
  const bool loads = shows_loads(scene);
  if (loads) draw_load(scene, pair, moved.side(), sketch);
  std::size_t points = 0;
  for (const trace::Pair& other : scene.frame.pairs) points += point_count(other);
  for (const auto& [manifold, point] : pushed_points(scene, pair)) {
    const Vec3d& at = point->position;
    const Vec3d out = moved.side() * manifold->normal;
    const Drawn drawn = drawn_at(scene, *point, moved.side());
    if (!scene.shows(Layer::Contacts)) sketch.mark(MarkKind::Core, at, kContact);
    draw_normal_impulse(scene, drawn, at, out, sketch);
    if (moved.a && moved.b && points == 1) draw_normal_impulse(scene, drawn, at, -out, sketch);
    draw_friction(scene, drawn, at, sketch);
    explain_impulse(scene, drawn, loads, sketch.legend);
    const double length = scene.scales.impulse * point->impulse->normal;
    const double pixels = scene.camera.pixels_per_metre(at);
    if (loads || points > kLabelledPoints || length * pixels < kLeastImpulse) continue;
    sketch.label(at + std::min(length, scene.scales.longest_impulse) * out,
                 spell_quantity(point->impulse->normal, "N s"), kContact, 15, 8, out);
  }
}

}  // namespace

const LayerDrawing kImpulsesLayer{.result = draw_impulses};
const LayerDrawing kLoadsLayer{};
const LayerDrawing kFrictionLayer{};

}  // namespace contactscope::draw
