#include "draw/layers/layer.h"
#include "draw/scene/points.h"

/// Gregorius 2015, "Building Incremental Manifolds": state and drift of each point in this frame.
namespace contactscope::draw {
namespace {

constexpr double kMinAnchors = 12;  // pixels
constexpr double kCovered = 8;      // pixels

constexpr double kClearOfDot = 9;  // pixels between an arrow and the dot it points at

template <PointState kState>
constexpr Swatch kStateSwatch{
    LegendGroup::Points, 5 + static_cast<int>(kState),
    [](auto& pen) { draw_state_dot(kState, pen.middle(), pen.px(4.8), kContact, pen.drawing()); }};
constexpr Swatch kAnchorsSwatch{LegendGroup::Points, 8, [](auto& pen) {
                                  pen.level_line(2, 20, 1.5, kContact);
                                  for (const double at : {2.0, 20.0})
                                    pen.disc(pen.at(at), 2.4, kContact);
                                }};

constexpr int kCircle = 96;  // chords
constexpr Swatch kRejectingSwatch{LegendGroup::Points, 9,
                                  [](auto& pen) { pen.dashes(2, kMargin); }};

// Whether a current point is drawn over this one.
bool is_covered(const Scene& scene, const trace::Pair& pair, const Vec3d& at) {
  return std::ranges::any_of(pair.incremental->points, [&](const auto& other) {
    const auto pixels = seen_distance(scene.camera, at, other.point.position);
    return other.state != "broken" && pixels && *pixels < kCovered * scene.scales.pixel;
  });
}

// Arrow from a replaced point to its successor, with the distance; from a rejected or an added point
// a line to the nearest old point.
void lead_to_successor(const Scene& scene, const trace::Pair& pair,
                       const trace::PersistentPoint& point, Sketch& sketch) {
  const trace::PersistentPoint* nearest = nullptr;
  const auto away = [&](const trace::PersistentPoint& other) {
    return (other.point.position - point.point.position).norm();
  };
  for (const trace::PersistentPoint& other : pair.incremental->points) {
    if (&other != &point && other.state != "broken" &&
        (nearest == nullptr || away(other) < away(*nearest)))
      nearest = &other;
  }
  if (nearest == nullptr) return;
  const Vec3d& from = point.point.position;
  const Vec3d offset = nearest->point.position - from;
  const double clear = kClearOfDot * scene.scales.pixel / scene.camera.pixels_per_metre(from);
  if (point.reason != "replaced")
    sketch.bordered_line(from, from + offset, {2, kDropped}, 4);
  else if (offset.norm() > 2 * clear)
    sketch.arrow_to_scale(from, offset - clear * offset.normalized(), 2, 10, kDropped);
  sketch.label(from + 0.5 * offset,
               spell_length(offset.norm(), scene.noise(pair), scene.scales.length), kDropped, 17, 9,
               scene.camera.up());
}

/// Reason for the removal of a point; for slid points with the distance.
std::string reported_reason(const Scene& scene, const trace::Pair& pair,
                            const trace::PersistentPoint& point) {
  if (point.reason != "slid") return point.reason;
  const double metres = (point.on_b() - point.on_a()).norm();
  return spell_length(metres, scene.noise(pair), scene.scales.length) + " apart, " + point.reason;
}

void draw_persistent_point(const Scene& scene, const trace::Pair& pair,
                           const trace::PersistentPoint& point, PointState state, Sketch& sketch) {
  const Vec3d& at = point.point.position;
  const double factor = scene.scales.drift, pixels = scene.camera.pixels_per_metre(at);
  // The current anchors, unless they are as close to each other as the dot is wide.
  if (factor * pixels * (point.on_b() - point.on_a()).norm() >= kMinAnchors * scene.scales.pixel) {
    const Vec3d middle = 0.5 * (point.on_a() + point.on_b());
    const Vec3d from = middle + factor * (point.on_a() - middle);
    const Vec3d to = middle + factor * (point.on_b() - middle);
    sketch.bordered_line(from, to, {1.5f, kContact}, 3.5f);
    for (const Vec3d& end : {from, to}) sketch.mark(MarkKind::Core, end, kContact);
    sketch.explain(kAnchorsSwatch,
                   factor == 1 ? "places that met, and how far they are apart now"
                               : "places that met, now apart (× " + spell_number(factor) + ")",
                   from);
  }
  if (state == PointState::Broken) {
    if (point.reason == "too close") {
      sketch.explain(kDroppedSwatch, "new point, not added", at);
      sketch.mark(MarkKind::Cross, at, kDropped);
    } else {
      sketch.explain(kStateSwatch<PointState::Broken>, "taken out, and why", at);
      sketch.mark(is_covered(scene, pair, at) ? MarkKind::WideRing : MarkKind::Hollow, at,
                  kContact);
    }
    sketch.label(at, reported_reason(scene, pair, point), kDropped, 16, 12);
    if (point.reason == "replaced" || point.reason == "too close")
      lead_to_successor(scene, pair, point, sketch);
    return;
  }
  const bool is_new = state == PointState::New;
  sketch.explain(is_new ? kStateSwatch<PointState::New> : kStateSwatch<PointState::Persisted>,
                 is_new ? "new point" : "kept point, its age in frames", at);
  sketch.mark(is_new ? MarkKind::Dot : MarkKind::Half, at, kContact);
  if (is_new && pair.incremental->rejects_within) lead_to_successor(scene, pair, point, sketch);
  if (scene.shows(Layer::Ids)) return;  // its id is written there
  Label& label = sketch.label(at, is_new ? "new" : std::to_string(point.age), kContact, 17, 12);
  if (!is_new) label.badge = Badge::Age;
}

/// Where a new point is too close to an old one, seen from the eye: a circle with its radius.
void draw_rejecting(const Scene& scene, const trace::PersistentPoint& old, double radius,
                    Sketch& sketch) {
  const Vec3d &at = old.point.position, &right = scene.camera.right(), &up = scene.camera.up();
  Curve& border = sketch.curves.emplace_back(Curve{{}, {2, kMargin, true}, true});
  for (const Vec2d& on : circle(kCircle))
    border.points.push_back(at + radius * (on.x() * right + on.y() * up));
  const Vec3d end = at + radius * (0.5 * up - std::sqrt(0.75) * right);
  sketch.line(at, end, {1.5f, kMargin});
  sketch.label(0.5 * (at + end), spell_length(radius, 0, scene.scales.length), kMargin, 17, 9, up);
  sketch.explain(kRejectingSwatch, "a new point in here is rejected", at + radius * up);
}

void draw_persistent_points(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (!pair.incremental) return;
  if (pair.incremental->rejects_within)
    for (const trace::PersistentPoint& point : pair.incremental->points)
      if (point.state == "persisted")
        draw_rejecting(scene, point, *pair.incremental->rejects_within, sketch);
  // A removed point is often at the place of its successor. Current points are drawn last, and the
  // removed one is a ring around them.
  for (const bool broken : {true, false}) {
    for (const trace::PersistentPoint& point : pair.incremental->points) {
      const PointState state = point_state(point.state);
      if ((state == PointState::Broken) == broken)
        draw_persistent_point(scene, pair, point, state, sketch);
    }
  }
}

}  // namespace

const LayerDrawing kPersistentLayer{.result = draw_persistent_points};

}  // namespace contactscope::draw
