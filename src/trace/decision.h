#pragma once

#include "core/vec3.h"
#include "trace/field.h"

namespace contactscope::trace {

/// A choice of the pipeline and its margin: how much the compared values must change for the next
/// best to win. Tolerances that prefer one candidate are included.
struct Decision {
  /// "contact", "face_a", "face_b", "axis", "incident_face"; "point 0", "point 1", ... for the
  /// steps of a reducer, "points" for one that chooses all at once.
  std::string stage;
  std::string took;  // "face_a", "face 2", "point 3", "touching"
  std::string over;  // the next best
  // Exactly one is set, by what was compared:
  std::optional<double> margin{};         // metres
  std::optional<double> margin_area{};    // square metres
  std::optional<double> margin_cosine{};  // between the normals of two faces

  static constexpr auto fields() {
    using D = Decision;
    return field::list(field::axis<&D::stage>.names(), field::axis<&D::took>, field::axis<&D::over>,
                       field::length<&D::margin>, field::area<&D::margin_area>,
                       field::direction<&D::margin_cosine>);
  }
  friend bool operator==(const Decision&, const Decision&) = default;
};

/// The smallest change of the second shape's pose, along the tried directions, that changes the ids
/// of the pair's points.
struct Flip {
  std::optional<double> offset{};   // metres; none: not within 1/100 of the smaller shape
  Vec3d direction = Vec3d::Zero();  // unit; b moves along it
  std::optional<double> turn{};     // radians about the centre of the points; none likewise
  Vec3d axis = Vec3d::Zero();       // unit; b turns about it
  /// Steps of one coordinate of b's position; a step is one ulp of the pair's largest length.
  std::optional<int> last_places{};

  static constexpr auto fields() {
    using F = Flip;
    return field::list(field::length<&F::offset>.keyed("way"),
                       field::direction_to_b<&F::direction>.where_set(), field::ratio<&F::turn>,
                       field::direction_to_b<&F::axis>.where_set().says("axis of the turn"),
                       field::exact<&F::last_places>.says("units in the last place"));
  }
  friend bool operator==(const Flip&, const Flip&) = default;
};

}  // namespace contactscope::trace
