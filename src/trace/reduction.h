#pragma once

#include <array>
#include <string>
#include <vector>

#include "trace/contact.h"

namespace contactscope::trace {

inline constexpr std::array<int, 2> kNoEdge = {{-1, -1}};

/// What one point was worth at one step of a reducer, seen against the normal.
struct Measure {
  int point = -1;                     // index into the points
  std::array<int, 2> edge = kNoEdge;  // that it was measured against, where it was one
  double value = 0;                   // metres, or square metres with a sign for areas

  static constexpr auto fields() {
    return std::tuple(field::exact("point", &Measure::point).into("points"),
                      field::exact("edge", &Measure::edge).into("points").where_set(),
                      field::area("value", &Measure::value));
  }
};

/// How one kept point was chosen.
struct Choice {
  /// "support", "deepest", "farthest", "triangle", "outside", "distance".
  std::string rule;
  Vec3d direction = Vec3d::Zero();  // unit, of "support"
  std::vector<Measure> measures;    // of every candidate what decided; of the chosen one all

  /// Whether its measures are against an edge.
  bool is_against_edges() const {
    return rule == "triangle" || rule == "outside" || rule == "distance";
  }

  static constexpr auto fields() {
    return std::tuple(field::exact("rule", &Choice::rule),
                      field::direction("direction", &Choice::direction).where_set(),
                      field::facts("measures", &Choice::measures).entries("measure"));
  }
};

struct Reduction {
  std::string method;
  std::vector<Point> points;    // all, before
  std::vector<int> kept;        // indices into points, in the order of choice
  double area = 0;              // square metres, of the convex hull of the kept points in the plane
  double best_area = 0;         // largest that as many points can span
  std::vector<int> best;        // the points that span it; empty where nobody looked
  std::vector<Choice> choices;  // for each kept point, where the method has such steps

  static constexpr auto fields() {
    return std::tuple(field::exact("method", &Reduction::method),
                      field::facts("points", &Reduction::points).entries("reduction point"),
                      field::exact("kept", &Reduction::kept).into("points"),
                      field::area("area", &Reduction::area),
                      field::area("best_area", &Reduction::best_area),
                      field::exact("best", &Reduction::best).into("points").where_set(),
                      field::facts("choices", &Reduction::choices).where_set().entries("choice"));
  }
};

}  // namespace contactscope::trace
