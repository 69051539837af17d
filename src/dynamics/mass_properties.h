#pragma once

#include <optional>

#include "core/vec3.h"
#include "geometry/shape.h"

namespace contactscope {

/// Of a body that is filled evenly. Held in double, whatever the pipeline computes in.
struct MassProperties {
  double volume = 0;                            // cubic metres
  double mass = 0;                              // kilograms
  Vec3d center = Vec3d::Zero();                 // centre of mass, the shape's frame, metres
  Mat3<double> inertia = Mat3<double>::Zero();  // about the centre, the shape's axes, kg m^2
};

/// Of a shape with an even `density` (kilograms a cubic metre, > 0). Nothing for planes, meshes
/// and flat hulls: a plane has no end, a mesh is a surface that need not be closed, and a flat hull has
/// no volume; none of them can be dynamic.
template <class S>
std::optional<MassProperties> mass_properties(const Shape<S>& shape, double density = 1);

/// The same body of another mass (kilograms, > 0): the density differs, the form does not.
MassProperties with_mass(const MassProperties& properties, double mass);

/// Metres: how thin a body is, whatever its form and its frame: the shortest edge of the box that has
/// its mass (kilograms, > 0) and its inertia (kg m^2, about its centre). Of a ball 1.55 radii.
double shortest_edge(double mass, const Mat3<double>& inertia);

}  // namespace contactscope
