#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "draw/layers/layer.h"
#include "draw/scene/pair_words.h"
#include "draw/scene/quantity.h"

namespace contactscope::draw {
namespace {

constexpr double kFreeTurn = 0.9;         // of a whole one, by the curved arrow of a free axis
constexpr double kFreeTurnRadius = 30;    // pixels, or
constexpr double kFreeTurnShare = 0.085;  // of a small view
constexpr double kClearTurns = 2.4;       // of the curved arrow's radius
constexpr double kBeyondAxis = 0.35;      // of an axis beyond its two points, of the body's radius

constexpr Swatch kCenterOfMassSwatch{
    LegendGroup::Masses, 0,
    [](auto& pen) { draw_quartered_disc(pen.middle(), pen.px(7.5), pen.px(1.4), pen.drawing()); }};

// Quartered discs, as drawings have them, and where a body's centre of mass lies over its contact:
// without one there is no plane to project into.
void draw_centers_of_mass(const Scene& scene, Sketch& sketch) {
  std::set<std::string_view> drawn;
  bool any_projected = false;
  std::optional<Vec3d> first;
  const auto draw = [&](const std::string& name, const Vec3d& center) {
    if (!first) first = center;
    if (drawn.insert(name).second) sketch.mark(MarkKind::Quartered, center, kNormal);
  };
  for (const trace::Pair& pair : scene.frame.pairs) {
    if (!pair.stability) continue;
    const trace::Stability& stability = *pair.stability;
    draw(stability.shape, stability.center_of_mass);
    if (stability.verdict == "no contact") continue;
    any_projected = true;
    sketch.bordered_line(stability.center_of_mass, stability.projection, {1.6f, kNormal, true},
                         4.0f, with_alpha(kWhite, 0.8f));
    sketch.mark(MarkKind::SmallQuartered, stability.projection, kNormal);
  }
  for (const trace::Body& body : scene.bodies()) draw(body.name, body.center_of_mass);
  if (!drawn.empty())
    sketch.explain(kCenterOfMassSwatch,
                   any_projected ? "centre of mass, and its projection" : "centre of mass", first);
}

void draw_free_axis(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const std::array<Vec3d, 2>& ends = *pair.stability->axis;
  const Vec3d between = ends[1] - ends[0];
  const Vec3d along = between.normalized();
  const PlacedShape* body = scene.find(pair.stability->shape);
  const double radius =
      body != nullptr && std::isfinite(body->mesh->radius) ? body->mesh->radius : between.norm();
  // The curved arrow stands clear of the points.
  const double pixels = std::min(kFreeTurnRadius, kFreeTurnShare * scene.camera.viewport().height);
  const double turn = pixels / scene.camera.pixels_per_metre(0.5 * (ends[0] + ends[1]));
  const double beyond = std::max({0.25 * between.norm(), kBeyondAxis * radius, kClearTurns * turn});
  const Vec3d from = ends[0] - beyond * along, to = ends[1] + beyond * along;
  sketch.bordered_line(from, to, {2.5f, kNormal, true}, 5.5f);
  // At the end that is farther from what else is drawn, so that the points stay free.
  const bool last = scene.camera.to_camera(to).z() < scene.camera.to_camera(from).z();
  const double inset = std::min(0.3 * beyond, 0.5 * turn);
  const Vec3d place = last ? Vec3d(to - inset * along) : Vec3d(from + inset * along);
  // Which way gravity, or whatever presses the bodies together, turns the body.
  const Vec3d& normal = pair.manifolds.front().normal;
  const Vec3d down = pair.stability->shape == pair.a ? normal : Vec3d(-normal);
  const Vec3d torque = (pair.stability->center_of_mass - ends[0]).cross(down);
  const Vec3d axis = torque.dot(along) < 0 ? Vec3d(-along) : along;
  // In balance on its axis it may turn either way: heads at both ends.
  for (const double way : {1.0, -1.0}) {
    if (way < 0 && pair.stability->margin != 0) break;
    draw_curved_arrow(scene.camera, place, way * axis, turn, 2 * std::numbers::pi * kFreeTurn, 2.5f,
                      kNormal, sketch);
  }
}

bool turns(const trace::Pair& pair) {
  const trace::Stability& stability = *pair.stability;
  return stability.axis && stability.verdict != "stable" && !pair.manifolds.empty() &&
         (*stability.axis)[0] != (*stability.axis)[1];
}

std::string verdict_of(const trace::Stability& stability) {
  const std::string balance = spell_balance(balance_of(stability));
  if (stability.verdict == "no contact") return balance;
  // How it turns is said where it does.
  const std::string verdict =
      stability.verdict == "stable" ? balance : balance + ": " + stability.verdict;
  if (stability.support.size() < 3) return verdict;
  if (stability.margin == 0) return verdict + ", on the border";
  const std::string margin = spell_margin(std::abs(stability.margin));
  return verdict + ", " + margin + (stability.margin < 0 ? " outside" : " inside");
}

// Gregorius 2015, "Incremental Manifold Stability": a body is stable while its centre of mass
// projects into the manifold; before, it turns about what there is.
void draw_support(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (!pair.stability) return;
  const trace::Stability& stability = *pair.stability;
  explain_support(stability, turns(pair), sketch.legend);
  if (stability.support.size() > 2)
    sketch.surfaces.push_back({stability.support, with_alpha(kClipPolygon, 0.28f)});
  // A line is seen on both sides of the axis that lies on it.
  const float width = stability.support.size() == 2 && turns(pair) ? 7.0f : 3.0f;
  if (stability.support.size() > 1) sketch.outline(stability.support, {width, kClipPolygon});
  if (turns(pair)) draw_free_axis(scene, pair, sketch);
  if (stability.support.empty()) return;
  sketch.label(stability.projection, verdict_of(stability), kText, 18, 16,
               Vec3d(-scene.camera.up()));
}

}  // namespace

const LayerDrawing kSupportLayer{.needs = {&Stages::stability}, .search = draw_support};

const LayerDrawing kCenterOfMassLayer{.needs = {&Stages::stability},
                                      .beneath = draw_centers_of_mass};

}  // namespace contactscope::draw
