#pragma once

#include "core/vec3.h"
#include "trace/field.h"

namespace contactscope::trace {

/// Best axis of one face query of the separating axis test.
struct FaceAxis {
  int face = -1;
  double separation = 0;
  Vec3d normal = Vec3d::Zero();   // unit, from a to b
  Vec3d support = Vec3d::Zero();  // deepest vertex of the other shape

  static constexpr auto fields() {
    return field::list(field::exact<&FaceAxis::face>, field::length<&FaceAxis::separation>,
                       field::direction_to_b<&FaceAxis::normal>.optional(),
                       field::position<&FaceAxis::support>.optional().says("support point"));
  }
};

/// Best axis of the edge query.
struct EdgeAxis {
  int a = -1;  // edge of a
  int b = -1;  // edge of b
  double separation = 0;
  Vec3d normal = Vec3d::Zero();   // unit, from a to b
  Vec3d point_a = Vec3d::Zero();  // closest points of the two edges
  Vec3d point_b = Vec3d::Zero();

  static constexpr auto fields() {
    return field::list(
        field::exact<&EdgeAxis::a>.swaps(&EdgeAxis::b).says("edge of a"),
        field::exact<&EdgeAxis::b>.says("edge of b"), field::length<&EdgeAxis::separation>,
        field::direction_to_b<&EdgeAxis::normal>.optional(),
        field::position<&EdgeAxis::point_a>.optional().swaps(&EdgeAxis::point_b).says("point on a"),
        field::position<&EdgeAxis::point_b>.optional().says("point on b"));
  }
};

/// Two edges whose arcs on the Gauss map cross, so that they form a face of the Minkowski
/// difference.
struct EdgePair {
  int a = -1;  // edge of a
  int b = -1;  // edge of b
  double separation = 0;
  Vec3d normal = Vec3d::Zero();  // unit, from a to b

  static constexpr auto fields() {
    return field::list(field::exact<&EdgePair::a>.swaps(&EdgePair::b).names(),
                       field::exact<&EdgePair::b>.names(), field::length<&EdgePair::separation>,
                       field::direction_to_b<&EdgePair::normal>);
  }
  friend bool operator==(const EdgePair&, const EdgePair&) = default;
};

struct Sat {
  std::optional<FaceAxis> face_a;
  std::optional<FaceAxis> face_b;
  std::optional<EdgeAxis> edge;
  std::string chosen;      // "face_a", "face_b", "edge_edge"; separates, or gives the contact
  std::string preference;  // "relative" or "none"
  // Metres by which a preferred axis may be worse than the best; recorded with the decisions.
  std::optional<double> tolerance{};
  std::vector<EdgePair> edge_pairs{};  // all that the edge query measured, for the Gauss map

  static constexpr auto fields() {
    return field::list(field::fact<&Sat::face_a>.swaps(&Sat::face_b).called("sat face_a"),
                       field::fact<&Sat::face_b>.called("sat face_b"),
                       field::fact<&Sat::edge>.called("sat edge"),  //
                       field::axis<&Sat::chosen>, field::exact<&Sat::preference>.optional(),
                       field::length<&Sat::tolerance>,
                       field::facts<&Sat::edge_pairs>.where_set().entries("sat edge pair"));
  }
};

}  // namespace contactscope::trace
