#pragma once

#include "core/vec3.h"

/// Deformation of a mesh over time, own frame: motion.deform. The file has the rest shape.
namespace contactscope {

/// A travelling sine: x + direction amplitude sin(2 pi (axis . x - speed t) / wavelength).
struct TravellingWave {
  Vec3d axis = Vec3d::UnitX();       // unit; the wave travels along it
  Vec3d direction = Vec3d::UnitY();  // unit; vertices move along it
  double amplitude = 0;              // metres
  double wavelength = 1;             // metres, > 0
  double speed = 0;                  // metres per second
};

/// Turns x about the axis through the origin by rate t (axis . x).
struct Twist {
  Vec3d axis = Vec3d::UnitY();  // unit
  double rate = 0;              // radians per metre along the axis and per second
};

/// Vertices at a time, as many as at rest; linear between keyframes, clamped outside.
struct VertexKeyframe {
  double time = 0;  // seconds
  std::vector<Vec3d> vertices;
};

using Deformation = std::variant<TravellingWave, Twist, std::vector<VertexKeyframe>>;

/// Positions of the vertices `at_rest` at a time in seconds. Keyframes replace all vertices.
std::vector<Vec3d> deformed_vertices(const Deformation& deformation,
                                     const std::vector<Vec3d>& at_rest, double time);

}  // namespace contactscope
