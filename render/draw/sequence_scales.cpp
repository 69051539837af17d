#include "draw/sequence_scales.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "draw/camera.h"
#include "draw/layout.h"
#include "draw/quantity.h"
#include "draw/scene.h"

namespace contactscope::draw {
namespace {

constexpr double kUsualImpulse = 0.20;   // of the view's height
constexpr double kUsualOfBody = 1.1;     // and of the smallest body's radius
constexpr double kLongestImpulse = 2.2;  // of a usual one
constexpr double kFastest = 0.26;        // of the view's height
constexpr double kWidestTurn = 1.2;      // of half a turn
constexpr double kWidestDrift = 46;      // pixels
constexpr double kPlainDrift = 16;       // pixels that need no exaggeration

double smallest_radius(const std::vector<ShapeMesh>& meshes) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const ShapeMesh& mesh : meshes) {
    if (mesh.radius > 0) smallest = std::min(smallest, mesh.radius);
  }
  return smallest;
}

// An impact is many times what a resting body needs: the usual frame sets the scale.
double usual(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace

double round_down(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {5.0, 2.0}) {
    if (step * decade <= value * (1 + 1e-12)) return step * decade;
  }
  return decade;
}

SequenceScales fit_scales(const std::vector<ShapeMesh>& meshes,
                          const std::vector<trace::Frame>& frames, const Camera& camera,
                          const Layout& layout) {
  std::vector<double> impulses;  // largest of each frame that has any
  double speed = 0, spin = 0;    // on the screen at one pixel a metre; radians a second
  double drift = 0;              // pixels
  double pixels_per_metre = 0;
  for (const trace::Frame& frame : frames) {
    double largest = 0;
    for (const trace::Pair& pair : frame.pairs) {
      for (const trace::Manifold& manifold : pair.manifolds) {
        for (const trace::Point& point : manifold.points) {
          if (!point.impulse) continue;
          pixels_per_metre = std::max(pixels_per_metre, camera.pixels_per_metre(point.position));
          largest = std::max(largest, point.impulse->normal);
        }
      }
      if (!pair.incremental) continue;
      for (const trace::PersistentPoint& point : pair.incremental->points) {
        if (point.state == "broken") continue;  // it may have come off at any speed
        drift = std::max(drift, camera.pixels_per_metre(point.point.position) *
                                    (point.on_b - point.on_a).norm());
      }
    }
    if (largest > 0) impulses.push_back(largest);
    if (!frame.solver) continue;
    for (const trace::Body& body : frame.solver->bodies) {
      const double here = camera.pixels_per_metre(body.center_of_mass);
      speed = std::max(speed, here * body.velocity.norm());
      spin = std::max(spin, body.angular_velocity.norm());
    }
  }

  SequenceScales scales;
  const double height = layout.view.height;
  if (!impulses.empty()) {
    const double length =
        std::min(kUsualImpulse * height / pixels_per_metre, kUsualOfBody * smallest_radius(meshes));
    scales.impulse = round_down(length / usual(impulses));
    scales.longest_impulse = kLongestImpulse * length;
  }
  if (speed > 0) scales.velocity = round_down(kFastest * height / speed);
  if (spin > 0) scales.spin = round_down(kWidestTurn * std::numbers::pi / spin);
  if (drift > 0 && drift < layout.px(kPlainDrift)) {
    scales.drift = std::max(1.0, round_down(layout.px(kWidestDrift) / drift));
  }
  return scales;
}

std::string spell_impulse_scale(double metres_per_newton_second) {
  // As many newton seconds as give a length that a person can imagine beside the bodies.
  double newton_seconds = 1;
  while (metres_per_newton_second * newton_seconds > 1) newton_seconds /= 10;
  while (metres_per_newton_second * newton_seconds < 0.1) newton_seconds *= 10;
  return spell_quantity(newton_seconds, "N s", 1) + " = " +
         spell_quantity(metres_per_newton_second * newton_seconds, "m", 1);
}

}  // namespace contactscope::draw
