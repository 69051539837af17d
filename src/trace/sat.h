#pragma once

#include <optional>
#include <string>
#include <vector>

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
    return field::list(
        field::exact("face", &FaceAxis::face), field::length("separation", &FaceAxis::separation),
        field::direction_to_b("normal", &FaceAxis::normal).optional(),
        field::position("support", &FaceAxis::support).optional().says("support point"));
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
        field::exact("a", &EdgeAxis::a).swaps(&EdgeAxis::b).says("edge of a"),
        field::exact("b", &EdgeAxis::b).says("edge of b"),
        field::length("separation", &EdgeAxis::separation),
        field::direction_to_b("normal", &EdgeAxis::normal).optional(),
        field::position("point_a", &EdgeAxis::point_a)
            .optional()
            .swaps(&EdgeAxis::point_b)
            .says("point on a"),
        field::position("point_b", &EdgeAxis::point_b).optional().says("point on b"));
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
    return field::list(field::exact("a", &EdgePair::a).swaps(&EdgePair::b).names(),
                       field::exact("b", &EdgePair::b).names(),
                       field::length("separation", &EdgePair::separation),
                       field::direction_to_b("normal", &EdgePair::normal));
  }
  friend bool operator==(const EdgePair&, const EdgePair&) = default;
};

struct Sat {
  std::optional<FaceAxis> face_a;
  std::optional<FaceAxis> face_b;
  std::optional<EdgeAxis> edge;
  std::string chosen;      // "face_a", "face_b", "edge_edge"; separates, or gives the contact
  std::string preference;  // "relative" or "none"
  std::vector<EdgePair> edge_pairs{};  // all that the edge query measured, for the Gauss map

  static constexpr auto fields() {
    return field::list(
        field::fact("face_a", &Sat::face_a).swaps(&Sat::face_b).called("sat face_a"),
        field::fact("face_b", &Sat::face_b).called("sat face_b"),
        field::fact("edge", &Sat::edge).called("sat edge"),  //
        field::axis("chosen", &Sat::chosen),
        field::exact("preference", &Sat::preference).optional(),
        field::facts("edge_pairs", &Sat::edge_pairs).where_set().entries("sat edge pair"));
  }
};

}  // namespace contactscope::trace
