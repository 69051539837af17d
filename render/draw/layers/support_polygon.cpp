#include "draw/layers/layer.h"
#include "draw/scene/pairs.h"

namespace contactscope::draw {
namespace {

constexpr double kFreeTurn = 0.9;         // of a full turn, for the curved arrow of a free axis
constexpr double kFreeTurnRadius = 30;    // pixels, or
constexpr double kFreeTurnShare = 0.085;  // share of a small view
constexpr double kClearTurns = 2.4;       // in radii of the curved arrow
constexpr double kBeyondAxis = 0.35;      // extension of an axis beyond its points, in body radii
constexpr double kMinMargin = 50;         // pixels: shorter margins are written with the verdict

constexpr Swatch kCenterOfMassSwatch{
    LegendGroup::Masses, 0,
    [](auto& pen) { draw_quartered_disc(pen.middle(), pen.px(7.5), pen.px(1.4), pen.drawing()); }};

// Quartered discs, as in technical drawings, and the projection of a body's centre of mass. It
// needs a contact, which defines the plane.
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

bool turns(const trace::Stability& stability) {
  return stability.axis && stability.verdict != "stable" &&
         (*stability.axis)[0] != (*stability.axis)[1];
}

/// Torque direction about a place, of gravity or another force that presses the bodies together.
Vec3d torque_about(const trace::Pair& pair, const Vec3d& place) {
  const Vec3d& normal = pair.manifolds.front().normal;
  const Vec3d down = pair.stability->shape == pair.a ? normal : Vec3d(-normal);
  return (pair.stability->center_of_mass - place).cross(down);
}

/// Two points on the axis about which the body turns; equal if it turns about a point.
std::optional<std::array<Vec3d, 2>> free_axis(const trace::Pair& pair) {
  const trace::Stability& stability = *pair.stability;
  if (pair.manifolds.empty()) return std::nullopt;
  if (turns(stability)) return stability.axis;
  if (stability.support.size() != 1 || stability.margin == 0) return std::nullopt;
  return std::array<Vec3d, 2>{stability.support[0], stability.support[0]};
}

void draw_free_axis(const Scene& scene, const trace::Pair& pair, const std::array<Vec3d, 2>& ends,
                    Sketch& sketch) {
  const Vec3d between = ends[1] - ends[0];
  const Vec3d torque = torque_about(pair, ends[0]);
  const Vec3d along = between.isZero(0) ? torque.normalized() : between.normalized();
  const PlacedShape* body = scene.find(pair.stability->shape);
  const double radius =
      body != nullptr && std::isfinite(body->mesh->radius) ? body->mesh->radius : between.norm();
  // The curved arrow keeps clear of the points.
  const double pixels = std::min(kFreeTurnRadius, kFreeTurnShare * scene.camera.viewport().height);
  const double turn = pixels / scene.camera.pixels_per_metre(0.5 * (ends[0] + ends[1]));
  const double beyond = std::max({0.25 * between.norm(), kBeyondAxis * radius, kClearTurns * turn});
  const Vec3d from = ends[0] - beyond * along, to = ends[1] + beyond * along;
  // Between its points the axis is a drawn edge of the support.
  sketch.bordered_line(ends[0], from, {2.5f, kNormal, true}, 5.5f);
  sketch.bordered_line(ends[1], to, {2.5f, kNormal, true}, 5.5f);
  // At the end nearer to the eye, so that the points stay visible.
  const bool last = scene.camera.to_camera(to).z() < scene.camera.to_camera(from).z();
  const double inset = std::min(0.3 * beyond, 0.5 * turn);
  const Vec3d place = last ? Vec3d(to - inset * along) : Vec3d(from + inset * along);
  const Vec3d axis = torque.dot(along) < 0 ? Vec3d(-along) : along;
  // A body in balance may turn either way: arrows in both directions.
  for (const double direction : {1.0, -1.0}) {
    if (direction < 0 && pair.stability->margin != 0) break;
    draw_curved_arrow(scene.camera, place, direction * axis, turn, 2 * std::numbers::pi * kFreeTurn,
                      2.5f, kNormal, sketch);
  }
}

/// Nearest point of the support's border to the projection. If several are equal, the rightmost,
/// next to the text below the projection.
std::optional<Vec3d> nearest_border(const Scene& scene, const trace::Stability& stability) {
  std::optional<Vec3d> nearest;
  const std::vector<Vec3d>& corners = stability.support;
  const Vec3d& from = stability.projection;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3d& begin = corners[i];
    const Vec3d side = corners[(i + 1) % corners.size()] - begin;
    const double share = std::clamp(side.dot(from - begin) / side.squaredNorm(), 0.0, 1.0);
    const Vec3d place = begin + share * side;
    const double more = nearest ? (place - from).norm() - (*nearest - from).norm() : -1;
    const double equal = 1e-3 * std::abs(stability.margin);
    const bool is_right = nearest && scene.camera.right().dot(place - *nearest) > 0;
    if (more < -equal || (more < equal && is_right)) nearest = place;
  }
  return nearest;
}

std::string verdict_of(const trace::Stability& stability) {
  const std::string balance = spell_balance(balance_of(stability));
  if (stability.verdict == "no contact" || stability.verdict == "stable") return balance;
  // The verdict contains how it turns.
  return balance + ": " + stability.verdict;
}

/// Margin inside or outside the support: on an arrow if it is long enough, otherwise with the
/// verdict.
void draw_verdict(const Scene& scene, const trace::Stability& stability, Sketch& sketch) {
  std::string verdict = verdict_of(stability);
  if (stability.support.size() > 2 && stability.margin == 0) {
    verdict = spell_balance(balance_of(stability)) + ", on the border";
  } else if (stability.support.size() > 2) {
    const Vec3d& from = stability.projection;
    const std::string margin =
        spell_margin(std::abs(stability.margin)) + (stability.margin < 0 ? " outside" : " inside");
    const std::optional<Vec3d> border = nearest_border(scene, stability);
    const std::optional<float> seen = seen_distance(scene.camera, from, *border);
    if (seen && *seen >= kMinMargin * scene.scales.pixel) {
      sketch.measure(from, *border, 1.5f, 9, kNormal);
      const Vec3d direction = (*border - from).normalized();
      sketch.label(0.5 * (from + *border), margin, kText, 17, 9,
                   Vec3d(scene.camera.up() - scene.camera.up().dot(direction) * direction));
    } else {
      verdict += ", " + margin;
    }
  }
  sketch.label(stability.projection, verdict, kText, 18, 16, Vec3d(-scene.camera.up()));
}

// Gregorius 2015, "Incremental Manifold Stability": a body is stable if its centre of mass projects
// into the manifold. Otherwise it turns about the support.
void draw_support(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (!pair.stability) return;
  const trace::Stability& stability = *pair.stability;
  const std::optional<std::array<Vec3d, 2>> axis = free_axis(pair);
  explain_support(stability, turns(stability), sketch.legend);
  if (axis && !turns(stability))
    sketch.explain(kFreeAxisSwatch, "axis about which the body turns", (*axis)[1]);
  if (stability.support.size() > 2)
    sketch.surfaces.push_back({stability.support, with_alpha(kClipPolygon, 0.28f)});
  // No label covers its edges, because they show on which side the centre of mass is.
  const std::size_t count = stability.support.size();
  for (std::size_t i = 0; count > 1 && i < count; ++i)
    sketch.lines.push_back(
        {stability.support[i], stability.support[(i + 1) % count], {3.0f, kClipPolygon}, true});
  if (axis) draw_free_axis(scene, pair, *axis, sketch);
  if (!stability.support.empty()) draw_verdict(scene, stability, sketch);
}

}  // namespace

const LayerDrawing kSupportLayer{.needs = {&Stages::stability}, .search = draw_support};

const LayerDrawing kCenterOfMassLayer{.needs = {&Stages::stability},
                                      .beneath = draw_centers_of_mass};

}  // namespace contactscope::draw
