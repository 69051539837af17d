#include <algorithm>
#include <cmath>

#include "draw/scene/curved_arrow.h"
#include "draw/scene/palette.h"
#include "draw/scene/quantity.h"
#include "draw/scene/scene.h"

namespace contactscope::draw {
namespace {

constexpr double kLeastVelocity = 5;        // pixels: a shorter one is only a head
constexpr double kLeastNamed = 1.5;         // pixels
constexpr double kLeastSpin = 0.12;         // radians, likewise
constexpr double kSpinRadius = 0.42;        // of the body's radius
constexpr std::size_t kLabelledBodies = 4;  // bodies: more numbers than these would be a crowd

std::string spell_time(double seconds) {
  return spell_quantity(seconds, "s", 1);
}

void label_velocity(const Vec3d& at, const std::string& text, const Vec3d& direction,
                    Sketch& sketch) {
  sketch.labels.push_back({.at = at,
                           .text = text,
                           .color = kReferenceFace,
                           .size = 16,
                           .bold = true,
                           .clearance = 9,
                           .direction = direction});
}

// Beside the centre of mass.
void draw_mass(const trace::Body& body, Sketch& sketch) {
  sketch.labels.push_back({.at = body.center_of_mass,
                           .text = spell_number(body.mass) + " kg",
                           .color = kText,
                           .size = 19,
                           .bold = true,
                           .clearance = 0,
                           .direction = std::nullopt});
}

}  // namespace

void draw_masses(const Scene& scene, Sketch& sketch) {
  if (!scene.frame.solver) return;
  for (const trace::Body& body : scene.frame.solver->bodies) draw_mass(body, sketch);
}

// A velocity is drawn as the way of the centre of mass in a stated time, a spin as the turn.
void draw_velocities(const Scene& scene, Sketch& sketch) {
  if (!scene.frame.solver) return;
  const std::vector<trace::Body>& bodies = scene.frame.solver->bodies;
  const SequenceScales& scales = scene.scales;
  for (const trace::Body& body : bodies) {
    const Vec3d way = scales.velocity * body.velocity;
    const double pixels = scene.camera.pixels_per_metre(body.center_of_mass);
    if (way.norm() * pixels >= kLeastVelocity) {
      sketch.arrows.push_back(arrow_to_scale(body.center_of_mass, way, 3.5f, 13, kReferenceFace));
      if (bodies.size() <= kLabelledBodies) {
        label_velocity(body.center_of_mass + way, spell_quantity(body.velocity.norm(), "m/s"),
                       way.normalized(), sketch);
      }
      sketch.explain(LegendKind::Velocity, "velocity, way in " + spell_time(scales.velocity));
    }
    // One that is too short for an arrow still has a number beside those of others.
    const double named = way.norm() * pixels;
    if (named >= kLeastNamed && named < kLeastVelocity && bodies.size() <= kLabelledBodies) {
      label_velocity(body.center_of_mass, spell_quantity(body.velocity.norm(), "m/s"),
                     way.normalized(), sketch);
      sketch.explain(LegendKind::Velocity, "velocity, way in " + spell_time(scales.velocity));
    }
    const double spin = body.angular_velocity.norm();
    if (spin * scales.spin < kLeastSpin) continue;
    const PlacedShape* shape = scene.find(body.name);
    const double radius = kSpinRadius * (shape == nullptr ? 1 : shape->mesh->radius);
    const Vec3d axis = body.angular_velocity / spin;
    const LineStyle thin{1.5f, kReferenceFace, true, LineStyle::Hidden::Same};
    sketch.lines.push_back({body.center_of_mass - 1.3 * radius * axis,
                            body.center_of_mass + 1.3 * radius * axis, thin, false});
    draw_curved_arrow(scene.camera, body.center_of_mass, axis, radius, spin * scales.spin, 3,
                      kReferenceFace, sketch);
    if (bodies.size() <= kLabelledBodies) {
      label_velocity(body.center_of_mass + 1.3 * radius * axis, spell_quantity(spin, "rad/s"), axis,
                     sketch);
    }
    sketch.explain(LegendKind::Spin, "spin, turn in " + spell_time(scales.spin));
  }
}

}  // namespace contactscope::draw
