#pragma once

#include "draw/scene/scene.h"

/// Lengths, as drawings measure them.
namespace contactscope::draw {

/// A length between two points: a two-headed arrow, or where that would be too short to be one, two
/// that point at it from outside.
void draw_measure(const Scene& scene, const Vec3d& from, const Vec3d& to, float width,
                  Sketch& sketch);
/// The same for the legend.
void explain_measure(const Scene& scene, const Vec3d& from, const Vec3d& to,
                     const std::string& text, Legend& legend);

/// A gap of `metres` between two points, with its length `clearance` pixels away along `aside`.
void draw_gap(const Scene& scene, const Vec3d& from, const Vec3d& to, double metres,
              double clearance, const Vec3d& aside, Sketch& sketch);
void explain_gap(const Scene& scene, const Vec3d& from, const Vec3d& to, Legend& legend);

}  // namespace contactscope::draw
