#pragma once

#include <optional>
#include <string>
#include <vector>

#include "continuous/impact.h"
#include "geometry/shape.h"

namespace contactscope {

/// What is done about shapes that meet between two frames.
enum class ImpactMethod {
  Speculative,              // contacts are kept as far apart as the two can come nearer
  Swept,                    // as if nothing turned: a cast of the shape as it is at the start
  ConservativeAdvancement,  // distance over the fastest approach
  TimeOfImpact,             // roots of the separation
};

struct ImpactMethodInfo {
  ImpactMethod method;
  std::string name;
  std::string summary;  // one line
};

/// Every method, in the order in which to list them.
const std::vector<ImpactMethodInfo>& impact_methods();

/// "speculative", "swept", "conservative_advancement", "time_of_impact".
constexpr const char* to_string(ImpactMethod method) {
  constexpr const char* kNames[] = {"speculative", "swept", "conservative_advancement",
                                    "time_of_impact"};
  return kNames[static_cast<int>(method)];
}

template <class S>
struct ShapeImpact {
  ImpactResult<S> result;
  int triangle = -1;       // of a mesh, of a's of two, that is met first, or overlapped
  int triangle_of_b = -1;  // of two meshes
  int triangles = 0;       // pairs that were asked, with a mesh
};

/// Why two kinds of shapes cannot be asked: two planes. Nothing where they can.
std::optional<std::string> impact_refusal(ShapeKind a, ShapeKind b);

/// The first time in a step at which two shapes are within the tolerance: time_of_impact() for any two
/// kinds but those that impact_refusal() names. A mesh is its triangles, each with two sides; a ball
/// that does not meet one that turns meets it exactly (sweep_sphere_triangle), where no gap is asked
/// for. A mesh that overlaps at the start by one triangle is Overlapping, whatever comes later.
///
/// Searched in double, also of shapes in float, so that the rounding of a large shape's far corners makes
/// no impact early. In float the time is rounded down.
///
/// Of a distance field the surface that it was made of is asked, whatever its lattice makes of that; what
/// is inside of it at the start is Overlapping.
///
/// Swept leaves turns out, and is wrong where something turns; Speculative asks nothing between
/// frames, and here gets the answer of TimeOfImpact, by which its contacts can be judged.
///
/// `run` records the search against the triangle that is met first, and of a mesh that is not met
/// nothing.
template <class S>
ShapeImpact<S> impact_of_shapes(const Shape<S>& a, const Sweep<S>& motion_a, const Shape<S>& b,
                                const Sweep<S>& motion_b, ImpactMethod method,
                                const ImpactLimits<S>& allowed = {}, ImpactRun<S>* run = nullptr);

/// The distance of the surfaces, metres, at `count` > 1 times of the step, the first at 0 and the last at
/// 1, evenly apart; 0 where they overlap. Of meshes that of the triangles that were found to meet first,
/// and nothing where none were. It is what the search looks at, for pictures.
template <class S>
std::vector<S> distances_through(const Shape<S>& a, const Sweep<S>& sweep_a, const Shape<S>& b,
                                 const Sweep<S>& sweep_b, const ShapeImpact<S>& found, int count);

}  // namespace contactscope
