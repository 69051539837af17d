#include "draw/scene/pairs.h"

namespace contactscope::draw {
namespace {

constexpr double kLegibleDepth = 13;      // pixels: six beyond the dot's border
constexpr double kExaggeratedDepth = 24;  // pixels of the sequence's deepest overlap
constexpr double kWidestGap = 150;        // pixels
constexpr double kMaxSideGap = 20;        // largest factor of overlaps next to such a gap
constexpr double kUsualImpulse = 0.20;    // of the view's height
constexpr double kUsualOfBody = 1.1;      // and of the smallest body's radius
constexpr double kMinUsual = 0.08;        // but at least this share of the view's height
constexpr double kUsualFriction = 0.5;    // of a usual impulse's length, with its own scale
constexpr double kLongestImpulse = 2.2;   // of a usual impulse
constexpr double kLongestStated = 0.45;   // of the view's height, if the view sets the scale
constexpr double kFastest = 0.26;         // of the view's height
constexpr double kWidestTurn = 1.2;       // of half a turn
constexpr double kWidestDrift = 46;       // pixels
constexpr double kPlainDrift = 16;        // pixels from which no exaggeration is needed
constexpr double kStill = 1e-3;           // pixels a frame: slower motion is rounding
constexpr double kTouching = 1e-4;        // of the smallest body's radius
constexpr double kSeenDistance = 6;       // pixels

// Median. An impact is many times the impulse of a resting body, so the usual frame sets the scale.
double usual(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

// Smallest factor of 1, 2, 5, 10, 20, 50, ... that makes the deepest overlap legible. Pixels.
double fit_overlap(double deepest, double pixel) {
  if (deepest <= 0 || deepest >= kLegibleDepth * pixel) return 1;
  const double wanted = kExaggeratedDepth * pixel / deepest;
  const double decade = std::pow(10.0, std::floor(std::log10(wanted)));
  double factor = 10 * decade;
  for (const double step : {5.0, 2.0, 1.0})
    if (step * decade >= 0.75 * wanted) factor = step * decade;
  return factor;
}

// Gaps get the factor of the overlaps, or their own if nothing overlaps, limited so that a gap
// stays near its shapes. Next to such a gap an overlap that needs a large factor is negligible.
void fit_gap(double widest, bool any_overlap, SequenceScales& scales) {
  const double pixel = scales.pixel;
  scales.gap = any_overlap ? scales.overlap : fit_overlap(widest, pixel);
  if (scales.overlap * widest <= kWidestGap * pixel) return;
  scales.gap = std::max(1.0, round_down(kWidestGap * pixel / widest));
  if (scales.overlap > kMaxSideGap) scales.overlap = scales.gap = 1;
}

}  // namespace

SequenceScales fit_scales(const ShapeMeshes& meshes, const std::vector<trace::Frame>& frames,
                          const Camera& whole, const Layout& layout, const View& view,
                          const CameraOf& camera_of) {
  SequenceScales scales;
  if (frames.size() > 1) {
    scales.step =
        (frames.back().time - frames.front().time) / (frames.back().frame - frames.front().frame);
  }
  std::vector<double> impulses, frictions;  // largest of each frame that has any
  double speed = 0, spin = 0;               // on the screen at one pixel a metre; radians a second
  double drift = 0, deepest = 0, gap = 0;   // pixels
  double pixels_per_metre = 0;
  double nearest = 0;                     // largest scale at a point, pixels per metre
  double most_overlap = 0, most_gap = 0;  // metres
  const auto moves = [&](const trace::Body& body) {
    if (!whole.sees(body.center_of_mass)) return;
    const double here = whole.pixels_per_metre(body.center_of_mass);
    speed = std::max(speed, here * body.velocity.norm());
    spin = std::max(spin, body.angular_velocity.norm());
  };
  for (const trace::Frame& frame : frames) {
    double largest = 0, largest_friction = 0;
    for (const trace::Pair& pair : frame.pairs) {
      const Camera* own = camera_of ? camera_of(pair) : nullptr;
      const Camera& camera = own != nullptr ? *own : whole;
      const double separation = pair.query && pair.query->gap ? *pair.query->gap : pair.separation;
      most_overlap = std::max(most_overlap, -separation);
      most_gap = std::max(most_gap, separation);
      for (const auto& [manifold, point] : all_points(pair)) {
        if (!camera.sees(point->position)) continue;
        const double here = camera.pixels_per_metre(point->position);
        nearest = std::max(nearest, here);
        // Points that show their age have no whiskers.
        if (!pair.incremental || !view.shows(Layer::Persistent))
          deepest = std::max(deepest, -point->separation * here);
        gap = std::max(gap, point->separation * here);
        if (!point->impulse) continue;
        pixels_per_metre = std::max(pixels_per_metre, here);
        largest = std::max(largest, point->impulse->normal);
        largest_friction = std::max(largest_friction, point->impulse->friction.norm());
        if (!point->relative_velocity || !view.shows(Layer::RelativeVelocity)) continue;
        const Vec3d& before = point->relative_velocity->before;
        scales.closing = std::max(scales.closing, std::abs(before.dot(manifold->normal)));
        speed = std::max(speed, here * before.norm());
      }
      if (!pair.incremental) continue;
      for (const trace::PersistentPoint& point : pair.incremental->points) {
        if (point.state == "broken") continue;  // its anchors may separate at any speed
        drift = std::max(drift, camera.pixels_per_metre(point.point.position) *
                                    (point.on_b() - point.on_a()).norm());
      }
    }
    if (largest > 0) impulses.push_back(largest);
    if (largest_friction > 0) frictions.push_back(largest_friction);
    if (!frame.solver) continue;
    std::ranges::for_each(frame.solver->bodies, moves);
  }
  for (std::size_t i = 0; view.shows(Layer::Velocities) && i + 1 < frames.size(); ++i) {
    if (frames[i].solver) break;
    const double seconds = frames[i + 1].time - frames[i].time;
    std::ranges::for_each(scripted_bodies(meshes, frames[i].poses, frames[i + 1].poses, seconds),
                          moves);
  }

  scales.pixel = layout.scale;
  scales.heap = view.layout != ViewLayout::SideBySide && std::ranges::any_of(frames, is_heap);
  scales.overlap = fit_overlap(deepest, scales.pixel);
  fit_gap(gap, deepest > 0, scales);
  const double smallest = meshes.smallest_radius();
  if (std::isfinite(smallest)) scales.touching = kTouching * smallest;
  // Points with a visible gap do not touch.
  if (nearest > 0)
    scales.touching = std::min(scales.touching, kSeenDistance * scales.pixel / nearest);
  // An overlap determines the unit, unless it is only a touch.
  scales.length = length_unit(
      most_overlap > scales.touching || most_gap <= scales.touching ? most_overlap : most_gap);
  const double height = layout.view.height;
  if (!impulses.empty()) {
    const double share = height / pixels_per_metre;
    const double length =
        std::max(kMinUsual * share, std::min(kUsualImpulse * share, kUsualOfBody * smallest));
    // The unit of the legend's round numbers: impulse, or force per step.
    const double unit = view.shows(Layer::Loads) && scales.step > 0 ? scales.step : 1;
    scales.impulse =
        view.impulse_scale.value_or(round_down(length / usual(impulses) * unit)) / unit;
    scales.longest_impulse = view.impulse_scale ? kLongestStated * share : kLongestImpulse * length;
    scales.load = prefix_for(usual(impulses) / unit);
    scales.friction = scales.impulse;
    if (view.shows(Layer::Friction) && !frictions.empty())
      scales.friction = round_down(kUsualFriction * length / usual(frictions) * unit) / unit;
  }
  if (speed * scales.step < kStill && scales.step > 0) speed = 0;
  if (spin * scales.step < kStill / height && scales.step > 0) spin = 0;
  if (speed > 0) scales.velocity = round_down(kFastest * height / speed);
  if (spin > 0) scales.spin = round_down(kWidestTurn * std::numbers::pi / spin);
  if (drift > 0 && drift < layout.px(kPlainDrift))
    scales.drift = std::max(1.0, round_down(layout.px(kWidestDrift) / drift));
  return scales;
}

}  // namespace contactscope::draw
