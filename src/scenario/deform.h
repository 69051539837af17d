#pragma once

#include <variant>
#include <vector>

#include "core/vec3.h"

/// How a mesh changes its form over time, in its own frame: motion.deform of a scenario file. Rest
/// is the form that the file gives.
namespace contactscope {

/// A sine that travels: x + direction amplitude sin(2 pi (axis . x - speed t) / wavelength).
struct TravellingWave {
  Vec3d axis = Vec3d::UnitX();       // unit; it travels along it
  Vec3d direction = Vec3d::UnitY();  // unit; what it moves is moved along it
  double amplitude = 0;              // metres
  double wavelength = 1;             // metres, > 0
  double speed = 0;                  // metres a second
};

/// x turned about the axis through the origin, by rate t (axis . x).
struct Twist {
  Vec3d axis = Vec3d::UnitY();  // unit
  double rate = 0;              // radians for each metre along the axis and each second
};

/// Vertices at a time, as many as at rest; linear between two of them, the ends are held.
struct VertexKeyframe {
  double time = 0;  // seconds
  std::vector<Vec3d> vertices;
};

using Deformation = std::variant<TravellingWave, Twist, std::vector<VertexKeyframe>>;

/// Where the vertices `at_rest` are at a time in seconds. Keyframes give all vertices by
/// themselves.
std::vector<Vec3d> deformed_vertices(const Deformation& deformation,
                                     const std::vector<Vec3d>& at_rest, double time);

}  // namespace contactscope
