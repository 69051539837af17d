#include "scenario/deform.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "core/at.h"

namespace contactscope {
namespace {

/// Only the fractional turns count, so that a sine far along a wave keeps its digits.
double phase_of(double turns) { return 2 * std::numbers::pi * (turns - std::floor(turns)); }

std::vector<Vec3d> deformed(const TravellingWave& wave, const std::vector<Vec3d>& at_rest,
                            double time) {
  return mapped(at_rest, [&](const Vec3d& x) -> Vec3d {
    const double turns = (wave.axis.dot(x) - wave.speed * time) / wave.wavelength;
    return x + wave.amplitude * std::sin(phase_of(turns)) * wave.direction;
  });
}

/// Rodrigues' formula.
std::vector<Vec3d> deformed(const Twist& twist, const std::vector<Vec3d>& at_rest, double time) {
  return mapped(at_rest, [&](const Vec3d& x) -> Vec3d {
    const double along = twist.axis.dot(x);
    const Vec3d foot = along * twist.axis;
    const double angle = twist.rate * time * along;
    return foot + std::cos(angle) * (x - foot) + std::sin(angle) * twist.axis.cross(x);
  });
}

std::vector<Vec3d> deformed(const std::vector<VertexKeyframe>& keyframes,
                            const std::vector<Vec3d>& at_rest, double time) {
  const auto later = std::ranges::upper_bound(keyframes, time, {}, &VertexKeyframe::time);
  if (later == keyframes.begin()) return keyframes.front().vertices;
  const VertexKeyframe& from = *std::prev(later);
  assert(from.vertices.size() == at_rest.size());
  // At a keyframe's time return its exact vertices, without rounding of the interpolation.
  if (later == keyframes.end() || time == from.time) return from.vertices;
  const double share = (time - from.time) / (later->time - from.time);
  std::vector<Vec3d> vertices;
  vertices.reserve(at_rest.size());
  for (int i = 0; i < count_of(at_rest); ++i)
    vertices.emplace_back((1 - share) * at(from.vertices, i) + share * at(later->vertices, i));
  return vertices;
}

}  // namespace

std::vector<Vec3d> deformed_vertices(const Deformation& deformation,
                                     const std::vector<Vec3d>& at_rest, double time) {
  return std::visit([&](const auto& how) { return deformed(how, at_rest, time); }, deformation);
}

}  // namespace contactscope
