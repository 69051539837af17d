#pragma once

#include "core/vec3.h"
#include "trace/field.h"

/// Time of impact of two shapes that move through the step, and how it was found.
namespace contactscope::trace {

/// Motion of a shape through the step: the pivot moves in a straight line and the shape turns about
/// it at a constant rate. The frame's poses are the start.
struct Travel {
  Vec3d pivot = Vec3d::Zero();         // at the start, world
  Vec3d displacement = Vec3d::Zero();  // metres over the whole step, world
  Vec3d turn = Vec3d::Zero();          // axis times radians over the whole step, world

  static constexpr auto fields() {
    return field::list(field::position<&Travel::pivot>, field::position<&Travel::displacement>,
                       field::ratio<&Travel::turn>);
  }
  friend bool operator==(const Travel&, const Travel&) = default;
};

/// One step of the search.
struct ImpactStep {
  double time = 0;                // fraction of the scenario's step
  double distance = 0;            // between the surfaces at that time, metres
  Vec3d axis = Vec3d::Zero();     // unit, from a to b: the shapes are separated along it
  double bracket_end = 0;         // last time that was tested along the axis
  double bracket_separation = 0;  // metres along the axis, exact or a lower bound, at that time
  double safe = 0;                // no contact before this time

  static constexpr auto fields() {
    using I = ImpactStep;
    return field::list(field::ratio<&I::time>, field::length<&I::distance>,
                       field::direction_to_b<&I::axis>, field::ratio<&I::bracket_end>,
                       field::length<&I::bracket_separation>, field::ratio<&I::safe>);
  }
  friend bool operator==(const ImpactStep&, const ImpactStep&) = default;
};

/// Distance between the surfaces at some time.
struct DistanceAt {
  double time = 0;      // fraction of the scenario's step
  double distance = 0;  // metres; 0 if they overlap

  static constexpr auto fields() {
    return field::list(field::ratio<&DistanceAt::time>, field::length<&DistanceAt::distance>);
  }
  friend bool operator==(const DistanceAt&, const DistanceAt&) = default;
};

struct Impact {
  std::string method;   // "speculative", "swept", "conservative_advancement", "time_of_impact"
  std::string status;   // "separated", "hit", "overlapping", "out_of_iterations"
  double time = 0;      // fraction of the scenario's step
  double distance = 0;  // between the surfaces at that time, metres
  Vec3d normal = Vec3d::Zero();   // unit, from a to b, for a hit
  Vec3d point_a = Vec3d::Zero();  // closest points at that time, world, for a hit
  Vec3d point_b = Vec3d::Zero();
  int triangle = -1;                            // of the mesh, hit first; -1: none
  int triangle_a = -1, triangle_b = -1;         // of two meshes, likewise
  std::vector<Vec3d> corners_a{}, corners_b{};  // of these two triangles at that time, world
  Travel travel_a, travel_b;
  /// Metres within which a speculative pair keeps contacts: the most that the two can approach.
  double margin = 0;
  /// Speculative points that the motion closes although the pair is "separated", world. They hold
  /// back shapes that would not meet.
  std::vector<Vec3d> ghosts{};
  std::vector<DistanceAt> distances;  // through the step, evenly spaced
  std::vector<ImpactStep> steps;

  static constexpr auto fields() {
    using I = Impact;
    return field::list(
        field::exact<&I::method>, field::exact<&I::status>, field::ratio<&I::time>,
        field::length<&I::distance>, field::direction_to_b<&I::normal>.where_set(),
        field::position<&I::point_a>.swaps(&I::point_b).where_set().says("point of a"),
        field::position<&I::point_b>.where_set().says("point of b"),
        field::exact<&I::triangle>.where_set(),
        field::exact<&I::triangle_a>.swaps(&I::triangle_b).where_set(),
        field::exact<&I::triangle_b>.where_set(),
        field::position<&I::corners_a>.swaps(&I::corners_b).where_set().says(""),
        field::position<&I::corners_b>.where_set().says(""),
        field::fact<&I::travel_a>.swaps(&I::travel_b), field::fact<&I::travel_b>,
        field::length<&I::margin>.where_set(), field::position<&I::ghosts>.where_set().says(""),
        field::facts<&I::distances>.where_set().entries("distance"),
        field::facts<&I::steps>.entries("step of the search"));
  }
  friend bool operator==(const Impact&, const Impact&) = default;
};

}  // namespace contactscope::trace
