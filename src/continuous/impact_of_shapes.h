#pragma once

#include "continuous/impact.h"

namespace contactscope {

/// Method for shapes that meet between two frames.
enum class ImpactMethod {
  Speculative,              // keeps contacts up to the distance by which the two can approach
  Swept,                    // ignores rotation: casts the shape in its orientation at the start
  ConservativeAdvancement,  // distance over the fastest approach
  TimeOfImpact,             // roots of the separation
};

struct ImpactMethodInfo {
  ImpactMethod method;
  std::string name;
  std::string summary;  // one line
};

/// All methods, in listing order.
const std::vector<ImpactMethodInfo>& impact_methods();

constexpr const char* to_string(ImpactMethod method) {
  constexpr const char* kNames[] = {"speculative", "swept", "conservative_advancement",
                                    "time_of_impact"};
  return kNames[static_cast<int>(method)];
}

template <class S> struct ShapeImpact {
  ImpactResult<S> result;
  int triangle = -1;       // mesh triangle that is met first or overlaps; a's if both are meshes
  int triangle_of_b = -1;  // b's if both are meshes
  int triangles = 0;       // pairs tested, with a mesh
};

/// Why two kinds of shapes are not supported: two planes. nullopt if they are.
std::optional<std::string> impact_refusal(ShapeKind a, ShapeKind b);

/// The first time in a step at which two shapes are within the tolerance: time_of_impact() for all
/// kinds that impact_refusal() accepts. A mesh is a set of two-sided triangles. A ball against
/// triangles that do not turn is exact (sweep_sphere_triangle) if the gap is 0. A mesh with a
/// triangle that overlaps at the start is Overlapping, whatever comes later.
///
/// Computed in double, also for float shapes, so that the rounding of a large shape's far corners
/// does not make impacts early. Times in float are rounded down.
///
/// Distance fields are tested by their source surface; shapes that start inside are Overlapping.
///
/// Swept ignores rotation and is wrong for shapes that turn. Speculative makes no query between
/// frames; here it returns the result of TimeOfImpact, as a reference for its contacts.
///
/// `run` records the search against the triangle that is met first, and nothing if no triangle is.
template <class S>
ShapeImpact<S> impact_of_shapes(const Shape<S>& a, const Sweep<S>& motion_a, const Shape<S>& b,
                                const Sweep<S>& motion_b, ImpactMethod method,
                                const ImpactLimits<S>& allowed = {}, ImpactRun<S>* run = nullptr);

/// Distance of the surfaces, metres, at `count` > 1 evenly spaced times from 0 to 1; 0 when they
/// overlap. For meshes, of the triangles that meet first; empty if none. For pictures.
template <class S>
std::vector<S> distances_through(const Shape<S>& a, const Sweep<S>& sweep_a, const Shape<S>& b,
                                 const Sweep<S>& sweep_b, const ShapeImpact<S>& found, int count);

}  // namespace contactscope
