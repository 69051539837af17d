#pragma once

#include <string>
#include <vector>

#include "core/vec3.h"
#include "trace/field.h"

/// When two shapes that move through the step first meet, and how that was found.
namespace contactscope::trace {

/// How a shape goes through the step: its pivot straight on, and about it the shape turns at a
/// constant rate. Where it is at the start the frame's poses say.
struct Travel {
  Vec3d pivot = Vec3d::Zero();         // at the start, world
  Vec3d displacement = Vec3d::Zero();  // metres in the whole step, world
  Vec3d turn = Vec3d::Zero();          // axis times radians in the whole step, world

  static constexpr auto fields() {
    return field::list(field::position("pivot", &Travel::pivot),
                       field::position("displacement", &Travel::displacement),
                       field::ratio("turn", &Travel::turn));
  }
  friend bool operator==(const Travel&, const Travel&) = default;
};

/// One step of the search.
struct ImpactStep {
  double time = 0;                // fraction of the scenario's step
  double distance = 0;            // of the surfaces then, metres
  Vec3d axis = Vec3d::Zero();     // unit, from a to b: along it they are apart
  double bracket_end = 0;         // time of the last look along the axis
  double bracket_separation = 0;  // along the axis, metres, that was seen or must be feared then
  double safe = 0;                // until this time they cannot meet

  static constexpr auto fields() {
    using I = ImpactStep;
    return field::list(field::ratio("time", &I::time), field::length("distance", &I::distance),
                       field::direction_to_b("axis", &I::axis),
                       field::ratio("bracket_end", &I::bracket_end),
                       field::length("bracket_separation", &I::bracket_separation),
                       field::ratio("safe", &I::safe));
  }
  friend bool operator==(const ImpactStep&, const ImpactStep&) = default;
};

/// How far apart the surfaces are at some time, whoever looks.
struct DistanceAt {
  double time = 0;      // fraction of the scenario's step
  double distance = 0;  // metres; 0 where they overlap

  static constexpr auto fields() {
    return field::list(field::ratio("time", &DistanceAt::time),
                       field::length("distance", &DistanceAt::distance));
  }
  friend bool operator==(const DistanceAt&, const DistanceAt&) = default;
};

struct Impact {
  std::string method;   // "speculative", "swept", "conservative_advancement", "time_of_impact"
  std::string status;   // "separated", "hit", "overlapping", "out_of_iterations"
  double time = 0;      // fraction of the scenario's step
  double distance = 0;  // of the surfaces then, metres
  Vec3d normal = Vec3d::Zero();   // unit, from a to b, of a hit
  Vec3d point_a = Vec3d::Zero();  // closest points at that time, world, of a hit
  Vec3d point_b = Vec3d::Zero();
  int triangle = -1;                            // of a mesh, that is met first; -1: none
  int triangle_a = -1, triangle_b = -1;         // of two meshes, likewise
  std::vector<Vec3d> corners_a{}, corners_b{};  // of these two at that time, world
  Travel travel_a, travel_b;
  /// Metres up to which contacts of a speculative pair are kept: as much nearer as the two can come.
  double margin = 0;
  /// Where contact points hold back shapes that would not meet, world: speculative ones that the motion
  /// closes, of a pair that is "separated".
  std::vector<Vec3d> ghosts{};
  std::vector<DistanceAt> distances;  // through the step, evenly apart
  std::vector<ImpactStep> steps;

  static constexpr auto fields() {
    using I = Impact;
    return field::list(
        field::exact("method", &I::method), field::exact("status", &I::status),
        field::ratio("time", &I::time), field::length("distance", &I::distance),
        field::direction_to_b("normal", &I::normal).where_set(),
        field::position("point_a", &I::point_a).swaps(&I::point_b).where_set().says("point of a"),
        field::position("point_b", &I::point_b).where_set().says("point of b"),
        field::exact("triangle", &I::triangle).where_set(),
        field::exact("triangle_a", &I::triangle_a).swaps(&I::triangle_b).where_set(),
        field::exact("triangle_b", &I::triangle_b).where_set(),
        field::position("corners_a", &I::corners_a).swaps(&I::corners_b).where_set().says(""),
        field::position("corners_b", &I::corners_b).where_set().says(""),
        field::fact("travel_a", &I::travel_a).swaps(&I::travel_b),
        field::fact("travel_b", &I::travel_b), field::length("margin", &I::margin).where_set(),
        field::position("ghosts", &I::ghosts).where_set().says(""),
        field::facts("distances", &I::distances).where_set().entries("distance"),
        field::facts("steps", &I::steps).entries("step of the search"));
  }
  friend bool operator==(const Impact&, const Impact&) = default;
};

}  // namespace contactscope::trace
