#include "draw/layers/layer.h"
#include "draw/scene/pairs.h"
#include "draw/scene/points.h"
#include "draw/scene/solid.h"

/// Gregorius 2015, "Building Incremental Manifolds (1)"; Catto 2007, "GJK Contact Margins": shapes
/// are cores inflated by margins. The cores stay separated while the margins overlap, so closest
/// points suffice. The depth is the sum of the margins less the distance of the cores.
namespace contactscope::draw {
namespace {

constexpr LineStyle kCoreFront{1.5f, with_alpha(kMargin, 0.75f), true, LineStyle::Hidden::Same};
constexpr LineStyle kCoreBack{1.0f, with_alpha(kMargin, 0.35f), true, LineStyle::Hidden::Same};
constexpr LineStyle kRoundedSurface{2.0f, kMargin};
constexpr LineStyle kExtension{1.0f, with_alpha(kQuietText, 0.8f)};
constexpr Swatch kCoreSwatch{LegendGroup::Cores, 0,
                             [](auto& pen) { pen.area(kMargin, 0, 1.8, true); }};
constexpr Swatch kRoundedSwatch{LegendGroup::Cores, 1, [](auto& pen) { pen.area(kMargin, 0, 2); }};

constexpr int kRoundedSteps = 180, kBisections = 40;
constexpr double kColumn = 30;  // pixels between the lines of a sum
constexpr double kBeyondColumn = 7, kMinOfSum = 6;

struct CoreCorner {
  Vec3d at;  // world, metres
  int side;  // the face across the edge that begins here
};
using CoreFace = std::vector<CoreCorner>;

// Half-space clipping of a convex polygon (Sutherland and Hodgman 1974).
CoreFace clipped_by(const CoreFace& polygon, const Plane<double>& plane, int side) {
  CoreFace inside;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const CoreCorner& from = polygon[i];
    const Vec3d& to = polygon[(i + 1) % polygon.size()].at;
    const double d0 = plane.distance(from.at), d1 = plane.distance(to);
    if (d0 <= 0) inside.push_back({from.at, d1 > 0 && d0 == 0 ? side : from.side});
    if ((d0 < 0 && d1 > 0) || (d0 > 0 && d1 <= 0))
      inside.push_back({from.at + d0 / (d0 - d1) * (to - from.at), d0 < 0 ? side : from.side});
  }
  return inside;
}

const Vec3d& farthest_corner(const std::vector<Vec3d>& corners, const Vec3d& direction) {
  return *std::ranges::max_element(corners, {}, [&](const Vec3d& p) { return direction.dot(p); });
}

// Outline of all points within `radius` of the hull of `corners`: a closed curve with round
// corners. Empty without corners, or if the eye is inside.
//
// A surface point is p + radius n, where p is the corner farthest along the normal n. View rays
// touch it if n is perpendicular to the ray. For an eye e, the support function h(n) + radius then
// equals n . e. Each half-plane about the line of sight contains one such normal, found by
// bisection. Rays of an orthographic camera are parallel, and n is perpendicular to them.
std::vector<Vec3d> rounded_outline(const std::vector<Vec3d>& corners, double radius,
                                   const Camera& camera) {
  if (corners.empty()) return {};
  const Vec3d middle = center_of(corners);
  const Vec3d sight = camera.to_eye(middle);
  const auto beyond_eye = [&](const Vec3d& normal) {
    return normal.dot(farthest_corner(corners, normal) - camera.eye()) + radius;
  };
  if (camera.is_perspective() && beyond_eye(sight) >= 0) return {};
  const Vec3d u = any_perpendicular(sight);
  const Vec3d v = sight.cross(u);
  std::vector<Vec3d> outline;
  for (const Vec2d& at : circle(kRoundedSteps)) {
    const Vec3d across = at.x() * u + at.y() * v;
    double low = -0.5 * std::numbers::pi, high = 0.5 * std::numbers::pi;
    const auto normal_at = [&](double tilt) -> Vec3d {
      return std::cos(tilt) * across + std::sin(tilt) * sight;
    };
    double tilt = 0;
    for (int k = 0; camera.is_perspective() && k < kBisections; ++k) {
      tilt = 0.5 * (low + high);
      (beyond_eye(normal_at(tilt)) > 0 ? low : high) = tilt;
    }
    const Vec3d normal = normal_at(tilt);
    outline.push_back(farthest_corner(corners, normal) + radius * normal);
  }
  return outline;
}

// Core of a hull after shrinking by a margin: each face moved inwards, clipped by all other planes
// moved inwards. Also draws the rounded surface at the margin from the core.
void draw_hull_core(const Scene& scene, const PlacedShape& shape, double margin, Sketch& sketch) {
  const int faces = count_of(shape.traced().faces);
  std::vector<Plane<double>> planes;
  std::vector<bool> front;
  for (int f = 0; f < faces; ++f) {
    const Vec3d normal = shape.normal(f), corner = shape.polygon(f)[0];
    planes.push_back({normal, normal.dot(corner) - margin});
    front.push_back(scene.camera.faces(corner, normal));
  }
  std::vector<Vec3d> corners;
  for (int f = 0; f < faces; ++f) {
    CoreFace face = mapped(shape.polygon(f), [&](const Vec3d& corner) -> CoreCorner {
      return {corner - margin * at(planes, f).normal, f};
    });
    for (int other = 0; other < faces && !face.empty(); ++other)
      if (other != f) face = clipped_by(face, at(planes, other), other);
    for (std::size_t i = 0; face.size() > 2 && i < face.size(); ++i) {
      corners.push_back(face[i].at);
      if (face[i].side < f) continue;  // drawn with the other face
      const bool seen = at(front, f) || at(front, face[i].side);
      sketch.line(face[i].at, face[(i + 1) % face.size()].at, seen ? kCoreFront : kCoreBack);
    }
  }
  sketch.curves.push_back({rounded_outline(corners, margin, scene.camera), kRoundedSurface, true});
}

/// Nearest, or deepest, points of the cores.
struct CorePair {
  Vec3d on_a, on_b;
  Vec3d normal;         // unit, from A to B
  double distance = 0;  // metres, negative for an overlap
};

std::optional<CorePair> core_pair(const trace::Pair& pair) {
  const trace::Incremental& incremental = *pair.incremental;
  if (incremental.query == "gjk") {
    if (!pair.gjk || pair.gjk->distance <= 0) return std::nullopt;
    const trace::Gjk& gjk = *pair.gjk;
    return CorePair{gjk.point_a, gjk.point_b, (gjk.point_b - gjk.point_a).normalized(),
                    gjk.distance};
  }
  if (incremental.query.empty() || incremental.query == "plane" || pair.manifolds.empty())
    return std::nullopt;
  const Vec3d& normal = pair.manifolds.front().normal;
  if (pair.penetration)
    return CorePair{pair.penetration->point_a, pair.penetration->point_b, normal,
                    -pair.penetration->depth};
  // The separating axis test records surface points only. The cores are deeper by the margins.
  const trace::PersistentPoint* deepest = nullptr;
  for (const trace::PersistentPoint& point : incremental.points) {
    if (point.state == "broken") continue;
    if (deepest == nullptr || point.point.separation < deepest->point.separation) deepest = &point;
  }
  if (deepest == nullptr) return std::nullopt;
  const double margins = incremental.margin_a + incremental.margin_b;
  return CorePair{deepest->on_a() - incremental.margin_a * normal,
                  deepest->on_b() + incremental.margin_b * normal, normal,
                  deepest->point.separation + margins};
}

// Lines of the sum in parallel columns, in true length; positions along the normal from A's core.
void draw_sum(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const std::optional<CorePair> cores = core_pair(pair);
  if (!cores) return;
  const Vec3d& normal = cores->normal;
  const Vec3d right = scene.camera.right() - scene.camera.right().dot(normal) * normal;
  const Vec3d side = right.norm() > 1e-3 ? Vec3d(right.normalized()) : any_perpendicular(normal);
  const double pixel = 1 / scene.camera.pixels_per_metre(cores->on_a);
  const auto place = [&](int column, double along) -> Vec3d {
    return cores->on_a + along * normal + column * kColumn * pixel * side;
  };
  const auto arrow = [&](int column, double from, double to, const Color& color, bool overlaps) {
    if (std::abs(to - from) < kMinOfSum * pixel) return;
    Arrow& added = sketch.measure(place(column, from), place(column, to), 3, 9, color);
    added.double_headed = !overlaps;
    added.bars = overlaps;
  };
  const auto line = [&](int column, double from, double to) {
    const LineStyle style{2.2f, kMargin};
    sketch.bordered_line(place(column, from), place(column, to), style, 5.0f);
    const Vec3d tick = 4 * pixel * side;
    for (const double end : {from, to})
      sketch.line(place(column, end) - tick, place(column, end) + tick, style);
  };
  const auto label = [&](int column, double along, const std::string& text, const Color& color,
                         const Vec3d& away) {
    sketch.label(place(column, along), text, color, 16, 8, away);
  };
  const double distance = cores->distance;
  const double margin_a = pair.incremental->margin_a, margin_b = pair.incremental->margin_b;
  const double a = margin_a, b = distance - margin_b;  // the surfaces
  if (distance < 0) {
    // The three parts are in one column, next to the contact's whisker, which is the whole.
    arrow(1, 0, distance, kAxis, true);
    label(1, 0.5 * distance,
          "cores overlap " + spell_margin(-distance) + ", by " + in_words(pair.incremental->query),
          kAxisText, side);
    sketch.explain(kOverlapSwatch, "overlap of the cores", place(1, 0.5 * distance));
    for (const double along : {a, 0.0, distance, b})
      sketch.line(place(0, along), place(1, along) + kBeyondColumn * pixel * side, kExtension);
    line(1, 0, a);
    line(1, b, distance);
    label(1, 0.5 * a, "A's margin " + spell_margin(margin_a), kMargin, side);
    label(1, 0.5 * (b + distance), "B's margin " + spell_margin(margin_b), kMargin, side);
    return;
  }
  arrow(0, 0, distance, kAxis, false);
  // Thin lines from one column to another and slightly beyond.
  for (const auto& [from, to, along] :
       {std::tuple(0, 1, 0.0), {0, 2, distance}, {1, 3, a}, {2, 3, b}})
    sketch.line(place(from, along), place(to, along) + kBeyondColumn * pixel * side, kExtension);
  line(1, 0, a);
  line(2, b, distance);
  label(1, 0.3 * a, "A's margin " + spell_margin(margin_a), kMargin, side - 2 * normal);
  label(2, distance - 0.3 * margin_b, "B's margin " + spell_margin(margin_b), kMargin,
        side + 2 * normal);
  const bool separated = b >= a;
  sketch.explain(kAxisSwatch,
                 separated ? "distance of the cores, and the gap that the margins leave"
                           : "distance of the cores",
                 place(0, 0.5 * distance));
  arrow(3, a, b, separated ? kAxis : kContact, !separated);
  label(3, 0.5 * (a + b), (separated ? "gap " : "overlap ") + spell_margin(std::abs(b - a)),
        separated ? kAxisText : kContact, side);
  // Inside A, because the contact and B's corner without margin are at the middle.
  label(0, 0.15 * distance, "cores " + spell_margin(distance) + " apart", kAxisText, -side);
}

/// Gregorius 2015, "Collision Shapes": a sphere's centre is local to its body.
void draw_body_origin(const PlacedShape& ball, Sketch& sketch) {
  const Vec3d &origin = ball.pose.position, &center = ball.vertices.front();
  if (origin == center) return;
  sketch.line(origin, center, {1.5f, kShapeEdge, true});
  sketch.mark(MarkKind::Node, origin, kShapeEdge);
  sketch.label(origin, "origin of the body", kText, 15, 9);
}

void draw_cores(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  for (const std::string* name : {&pair.a, &pair.b})
    if (const PlacedShape* shape = scene.find(*name); shape != nullptr && is_ball(*shape))
      draw_body_origin(*shape, sketch);
  if (!pair.incremental) return draw_radii(scene, pair, sketch);
  const double margin_a = pair.incremental->margin_a, margin_b = pair.incremental->margin_b;
  bool any = false;
  for (const auto& [name, margin] : {std::pair{&pair.a, margin_a}, {&pair.b, margin_b}}) {
    const PlacedShape* shape = scene.find(*name);
    // Round shapes show their cores already.
    if (shape == nullptr || margin <= 0 || shape->traced().radius > 0) continue;
    if (shape->traced().faces.empty() || shape->is_mesh()) continue;
    draw_hull_core(scene, *shape, margin, sketch);
    any = true;
  }
  if (!any) return;
  sketch.explain(kCoreSwatch,
                 "core, " + spell_margin(std::max(margin_a, margin_b)) + " within the faces");
  sketch.explain(kRoundedSwatch, "core and margin: the surface that touches");
  draw_sum(scene, pair, sketch);
}

}  // namespace

const LayerDrawing kCoreLayer{.needs = {&Stages::gjk, &Stages::penetration}, .search = draw_cores};

}  // namespace contactscope::draw
