#include "draw/layers/layer.h"
#include "draw/scene/outlines.h"
#include "draw/scene/pairs.h"

namespace contactscope::draw {
namespace {

constexpr double kMinVelocity = 12;         // pixels: a shorter one is only a head
constexpr double kMinShare = 0.05;          // share of the fastest: slower ones do not matter
constexpr double kMinSpin = 0.12;           // radians: slower spins do not matter
constexpr double kSpinRadius = 0.42;        // in radii of the body
constexpr std::size_t kLabelledBodies = 4;  // bodies: more numbers would crowd the picture

constexpr Swatch kVelocitySwatch{LegendGroup::Motion, 0,
                                 [](auto& pen) { pen.arrow(3.5, 11, kMotion); }};
// Three quarters of a turn.
constexpr Swatch kSpinSwatch{
    LegendGroup::Motion, 3, [](auto& pen) {
      constexpr int kSteps = 18;
      const Point2 m = pen.middle();
      const float r = pen.px(7);
      const auto at = [&](int i) {
        const float angle =
            std::numbers::pi_v<float> * (0.3f + 1.5f * static_cast<float>(i) / kSteps);
        return Point2{m.x + r * std::cos(angle), m.y - r * std::sin(angle)};
      };
      for (int i = 0; i + 1 < kSteps - 3; ++i) pen.path({at(i), at(i + 1)}, 2.5, kMotion);
      const Point2 tip = at(kSteps), back = at(kSteps - 4);
      const Point2 across{0.6f * (tip.y - back.y), -0.6f * (tip.x - back.x)};
      pen.fill(
          {tip, {back.x + across.x, back.y + across.y}, {back.x - across.x, back.y - across.y}},
          kMotion);
    }};

// A velocity is drawn as the displacement of the centre of mass in a stated time, a spin as the
// rotation. A velocity too short for an arrow has no number either.
void draw_velocity(const Scene& scene, const trace::Body& body, double fastest, bool numbered,
                   Sketch& sketch) {
  const Vec3d& center = body.center_of_mass;
  const Vec3d offset = scene.scales.velocity * body.velocity;
  const double pixels = offset.norm() * scene.camera.pixels_per_metre(center);
  if (pixels < kMinVelocity || body.velocity.norm() < kMinShare * fastest) return;
  sketch.explain(kVelocitySwatch,
                 "velocity, way in " + spell_quantity(scene.scales.velocity, "s", 1));
  sketch.arrow_to_scale(center, offset, 3.5f, 13, kMotion);
  if (numbered)
    sketch.label(center + offset, spell_quantity(body.velocity.norm(), "m/s"), kMotion, 16, 9,
                 offset.normalized());
}

void draw_spin(const Scene& scene, const trace::Body& body, bool numbered, Sketch& sketch) {
  const double spin = body.angular_velocity.norm();
  if (!(spin * scene.scales.spin >= kMinSpin)) return;
  sketch.explain(kSpinSwatch, "spin, turn in " + spell_quantity(scene.scales.spin, "s", 1));
  const PlacedShape* shape = scene.find(body.name);
  const double radius = kSpinRadius * (shape == nullptr ? 1 : shape->mesh->radius);
  const Vec3d axis = body.angular_velocity / spin;
  const Vec3d& center = body.center_of_mass;
  const Vec3d tip = center + 1.3 * radius * axis;
  sketch.line(center - 1.3 * radius * axis, tip, {1.5f, kMotion, true});
  draw_curved_arrow(scene.camera, center, axis, radius, spin * scene.scales.spin, 3, kMotion,
                    sketch);
  if (!numbered) return;
  // At the arc, because the ends of the axis are closer to other objects.
  const Camera& camera = scene.camera;
  const Vec3d across = camera.right() - camera.right().dot(axis) * axis;
  const bool is_end_on = std::abs(camera.to_eye(center).dot(axis)) > 0.95;
  const Vec3d out = is_end_on             ? Vec3d((camera.right() + camera.up()).normalized())
                    : across.norm() > 0.1 ? Vec3d(across.normalized())
                                          : camera.up();
  sketch.label(center + radius * out, spell_quantity(spin, "rad/s"), kMotion, 16, 9, out);
}

// Bodies of the solver. Without a solver the scripted bodies, with velocities to the next frame, or
// in the last frame from the previous one.
std::vector<trace::Body> moving_bodies(const Scene& scene) {
  if (scene.frame.solver) return {scene.bodies().begin(), scene.bodies().end()};
  if (scene.sequence == nullptr || scene.sequence->size() < 2) return {};
  const auto here = std::ranges::find(*scene.sequence, scene.frame.frame, &FramePoses::frame);
  if (here == scene.sequence->end()) return {};
  const bool is_last = here + 1 == scene.sequence->end();
  const FramePoses& other = is_last ? *(here - 1) : *(here + 1);
  // Negative time step at the end: displacement and seconds both change their sign.
  return scripted_bodies(scene.meshes, scene.frame.poses, other.poses,
                         scene.scales.step * (other.frame - here->frame));
}

/// Middle of the visible part of a shape, at the shape's depth.
std::optional<Vec3d> seen_middle(const Camera& camera, const PlacedShape& shape) {
  Eigen::AlignedBox2d seen;
  for (const Vec2d& at : projected(camera, extent_points(shape))) seen.extend(at);
  const Rect& view = camera.viewport();
  seen.clamp({Vec2d(view.x, view.y), Vec2d(view.right(), view.bottom())});
  const Vec3d center = shape.pose.transform(shape.traced().center_of_mass);
  const std::optional<Point2> foot = camera.project(center);
  if (seen.isEmpty() || !foot) return std::nullopt;
  const Vec2d offset = (seen.center() - Vec2d(foot->x, foot->y)) / camera.pixels_per_metre(center);
  return center + offset.x() * camera.right() - offset.y() * camera.up();
}

// If scripted bodies have time of impact queries, draws their displacements in the step. These may
// be far longer or shorter than the shapes, so the arrows are to scale only among themselves.
void draw_paths(const Scene& scene, Sketch& sketch) {
  constexpr double kLongest = 110, kMin = 30;  // pixels
  double longest = 0;
  const auto each = [&](const auto& visit) {
    for (const trace::Pair& pair : scene.frame.pairs) {
      if (!pair.impact) continue;
      visit(pair.a, pair.impact->travel_a.displacement);
      visit(pair.b, pair.impact->travel_b.displacement);
    }
  };
  each(
      [&](const std::string&, const Vec3d& offset) { longest = std::max(longest, offset.norm()); });
  if (!(longest > 0)) return;
  std::set<std::string_view> drawn;  // a shape may be in several pairs
  each([&](const std::string& name, const Vec3d& offset) {
    const PlacedShape* shape = scene.find(name);
    const double pixels = kLongest * offset.norm() / longest;
    if (shape == nullptr || pixels < kMin || !drawn.insert(name).second) return;
    const std::optional<Vec3d> middle = seen_middle(scene.camera, *shape);
    if (!middle) return;
    const Vec3d along = offset.normalized();
    const double metres = scene.scales.pixel * pixels / scene.camera.pixels_per_metre(*middle);
    sketch.arrow(*middle - 0.5 * metres * along, along, static_cast<float>(pixels), 3.5f, 13,
                 kMotion);
    const bool is_level = std::abs(along.dot(scene.camera.right())) > 0.5;
    sketch.label(*middle, spell_length(offset.norm()), kMotion, 17, 9,
                 is_level ? scene.camera.up() : scene.camera.right());
    sketch.explain(kVelocitySwatch, "way through the step, not to scale");
  });
}

void draw_velocities(const Scene& scene, Sketch& sketch) {
  const bool shows_paths = std::ranges::any_of(
      scene.frame.pairs, [](const trace::Pair& pair) { return pair.impact.has_value(); });
  if (!scene.frame.solver && shows_paths) return draw_paths(scene, sketch);
  const std::vector<trace::Body> bodies = moving_bodies(scene);
  const bool numbered = bodies.size() <= kLabelledBodies;
  double fastest = 0;
  for (const trace::Body& body : bodies) fastest = std::max(fastest, body.velocity.norm());
  for (const trace::Body& body : bodies) {
    draw_velocity(scene, body, fastest, numbered, sketch);
    draw_spin(scene, body, numbered, sketch);
  }
}

// Next to the centre of mass.
void draw_masses(const Scene& scene, Sketch& sketch) {
  for (const trace::Body& body : scene.bodies()) {
    Label& label = sketch.label(body.center_of_mass, spell_number(body.mass) + " kg", kText, 19, 0,
                                scene.camera.up());
    const PlacedShape* shape = scene.find(body.name);
    if (shape == nullptr) continue;
    label.ground = outline_around(scene.camera, extent_points(*shape));
  }
}

constexpr double kMinClosing = 4;  // pixels

constexpr Swatch kWholeSwatch{LegendGroup::Motion, 1,
                              [](auto& pen) { pen.open_arrow(2, kMotion); }};
constexpr Swatch kPartSwatch{LegendGroup::Motion, 2, [](auto& pen) { pen.arrow(4, 11, kMotion); }};

// Decimals as for three digits of the largest speed, so that the rest after a stop is shown as
// zero.
std::string spell_closing(double speed, double fastest) {
  const int decimals =
      fastest > 0 ? std::clamp(2 - static_cast<int>(std::floor(std::log10(fastest))), 0, 9) : 0;
  if (std::abs(speed) < 0.5 * std::pow(10.0, -decimals)) return "0 m/s";
  return (speed < 0 ? "−" : "") + printed("%.*f m/s", decimals, std::abs(speed));
}

/// The terms of the relative velocity: r from each turning body's centre of mass to the point.
void draw_levers(const Scene& scene, const trace::Pair& pair, const Vec3d& at, Sketch& sketch) {
  for (const std::string* name : {&pair.a, &pair.b}) {
    const trace::Body* body = scene.body(*name);
    if (body == nullptr || body->angular_velocity.isZero(0)) continue;
    sketch.arrows.push_back(
        {.from = body->center_of_mass, .to = at, .width = 2, .head = 10, .color = kShapeEdge});
    sketch.label(0.3 * body->center_of_mass + 0.7 * at, "r", kText, 20, 8, -scene.camera.right());
    sketch.mark(MarkKind::Node, body->center_of_mass, kShapeEdge);
  }
}

// Gregorius 2015, "Recap: Solving Contact (2)": of the relative velocity at the point, only the
// part along the normal matters to the contact.
void draw_relative_velocity(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const SequenceScales& scales = scene.scales;
  for (const auto& [manifold, point] : all_points(pair)) {
    if (!point->relative_velocity) continue;
    const Vec3d& at = point->position;
    const Vec3d& before = point->relative_velocity->before;
    const double speed = before.dot(manifold->normal);
    const Vec3d whole = scales.velocity * before;
    const Vec3d part = scales.velocity * speed * manifold->normal;
    const auto is_seen = [&](const Vec3d& offset) {
      return offset.norm() * scene.camera.pixels_per_metre(at) >= kMinClosing;
    };
    if (is_seen(whole)) {
      sketch.arrow_to_scale(at, whole, 2, 10, kMotion).open = true;
      sketch.line(at + whole, at + part, {1.2f, kMotion, true});
      sketch.explain(kWholeSwatch, "relative velocity at the contact, way in " +
                                       spell_quantity(scales.velocity, "s", 1));
    }
    // The velocities of the bodies are its terms, and are shown too.
    if (scene.shows(Layer::Velocities) && is_seen(whole) && is_seen(part)) {
      draw_levers(scene, pair, at, sketch);
      sketch.label(at + whole, "v + ω × r", kMotion, 18, 9, whole.normalized());
    }
    const std::string spelled = spell_closing(speed, scales.closing);
    if (!is_seen(part) && is_seen(whole)) {
      sketch.label(at + whole, "slides at " + spell_quantity(before.norm(), "m/s"), kMotion, 18, 12,
                   whole.normalized());
      continue;
    }
    if (!is_seen(part)) {
      sketch.label(at, spelled + " along the normal", kMotion, 18, 12, scene.camera.right());
      continue;
    }
    sketch.explain(kPartSwatch, "its part along the normal", Vec3d(at + 0.8 * part));
    sketch.arrow_to_scale(at, part, 4, 14, kMotion);
    sketch.label(at + part, spelled, kMotion, 18, 12, scene.camera.right());
  }
}

}  // namespace

const LayerDrawing kVelocitiesLayer{.above = draw_velocities};
const LayerDrawing kMassesLayer{.above = draw_masses};

const LayerDrawing kRelativeVelocityLayer{.result = draw_relative_velocity};

}  // namespace contactscope::draw
