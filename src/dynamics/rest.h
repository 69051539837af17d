#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/vec3.h"
#include "trace/trace.h"

/// Gregorius 2015, "Incremental Manifold Stability": a body can rest on a manifold if its centre of
/// mass projects inside of it, along the normal.
namespace contactscope {

enum class Rest {
  Stable,            // inside, by more than rounding
  TurnsAboutALine,   // two points, points on a line, or the projection on or beyond an edge
  TurnsAboutAPoint,  // one point, or the projection beyond a corner
  NoContact,
};

/// "stable", "turns about a line", "turns about a point", "no contact", as traces spell it.
constexpr const char* to_string(Rest rest) {
  constexpr const char* kNames[] = {"stable", "turns about a line", "turns about a point",
                                    "no contact"};
  return kNames[static_cast<int>(rest)];
}

/// World, metres.
struct Resting {
  Rest rest = Rest::NoContact;
  Vec3d projection = Vec3d::Zero();  // of the centre of mass into the contact plane
  std::vector<Vec3d> support;        // corners of the points' hull there, against the normal
  double margin = 0;  // from the projection to its border, negative outside; 0 within rounding
  std::optional<std::array<Vec3d, 2>> axis;  // of a line: the edge, or both ends of the points
};

/// `points` and `normal` (unit) of a manifold, and where a body's centre of mass is. The contact
/// plane is that through the middle of the points across the normal. `rounding`, metres: how far
/// the points may be off, as rounding_of() says; no nearer to the border is inside, nor are points
/// nearer to a line than an area.
///
/// Without points there is no plane: projection and margin say nothing.
Resting rest_of(std::span<const Vec3d> points, const Vec3d& normal, const Vec3d& center_of_mass,
                double rounding);

/// How far the pipeline's rounding may have moved points of such coordinates. `epsilon`: of its
/// scalar.
double rounding_of(std::span<const Vec3d> points, const Vec3d& center_of_mass, double epsilon);

/// The same of a recorded pair's manifolds, for the record. Of several manifolds, a mesh's, all
/// points count, and the normal is the mean of their points'. `shape` names the body.
trace::Stability rest_of(const trace::Pair& pair, const std::string& shape,
                         const Vec3d& center_of_mass, double epsilon);

}  // namespace contactscope
