#pragma once

#include "core/vec3.h"
#include "trace/field.h"

namespace contactscope::trace {

using Polygon = std::vector<Vec3d>;

/// Half-space of a shape of type "plane": normal . x <= offset.
struct HalfSpace {
  Vec3d normal = Vec3d::UnitY();  // unit
  double offset = 0;              // metres

  static constexpr auto fields() {
    return field::list(field::direction<&HalfSpace::normal>, field::length<&HalfSpace::offset>);
  }
  friend bool operator==(const HalfSpace&, const HalfSpace&) = default;
};

/// A shape in its local frame, as needed for drawing.
struct Shape {
  std::string name;
  std::string type;  // "box", "hull", "cylinder", "cone", "sphere", "capsule", "mesh", "plane"
  /// A sphere's centre, the ends of a capsule's segment, none for a plane.
  std::vector<Vec3d> vertices;
  std::vector<std::vector<int>> faces;  // vertex indices, counter-clockwise seen from outside
  // Vertex indices. Ids such as "a:e3" are indices into this list. Ids of a mesh are relative to
  // the manifold's triangle: edge k runs from its corner k to the next.
  std::vector<std::array<int, 2>> edges;
  Vec3d center_of_mass = Vec3d::Zero();
  double radius = 0;  // metres; rounds a sphere or capsule about its vertices and edge
  std::optional<HalfSpace> half_space{};
  /// Metres: rounding of a convex shape by another engine, about the hull of its vertices.
  double margin = 0;
  /// Body with several shapes that this one is part of; the solver stores its mass under this name.
  std::string body{};
  // Needed by other engines to step the scene. The friction of a contact is the geometric mean of
  // both shapes', the restitution the larger one.
  std::optional<double> friction{};     // Coulomb's coefficient
  std::optional<double> restitution{};  // share of the approach speed that is returned

  /// Undirected edges in the order in which faces first contain them.
  static void edges_from_faces(Shape& shape);

  static constexpr auto fields() {
    return field::list(
        field::name(&Shape::name),  //
        field::exact<&Shape::type>.optional(), field::position<&Shape::vertices>.says(""),
        field::exact<&Shape::faces>.into("vertices").optional().says("face"),
        field::exact<&Shape::edges>.into("vertices").otherwise_by(&Shape::edges_from_faces).says("edge"),
        field::position<&Shape::center_of_mass>.optional().says("centre of mass"),
        field::length<&Shape::radius>.where_set(),
        field::fact<&Shape::half_space>.says("half-space"),
        field::length<&Shape::margin>.where_set(), field::exact<&Shape::body>.where_set(),
        field::ratio<&Shape::friction>, field::ratio<&Shape::restitution>);
  }
};

/// An engine's convention for impulses if it differs from Impulse; readers convert it.
struct ImpulseConvention {
  std::string unit = "N s";  // or "N": forces, over a step of `step`
  std::string on = "b";      // or "a": friction acts on a and normal parts are negative
  double step = 0;           // seconds; needed for forces

  static constexpr auto fields() {
    return field::list(field::exact<&ImpulseConvention::unit>.optional(),
                       field::exact<&ImpulseConvention::on>.optional(),
                       field::exact<&ImpulseConvention::step>.where_set());
  }
  friend bool operator==(const ImpulseConvention&, const ImpulseConvention&) = default;
};

/// Parameters that another engine needs to step the bodies.
struct World {
  Vec3d gravity = Vec3d::Zero();  // metres per second squared
  double time_step = 0;           // seconds, from frame to frame

  static constexpr auto fields() {
    return field::list(field::exact<&World::gravity>,
                       field::exact<&World::time_step>.says("time step"));
  }
  friend bool operator==(const World&, const World&) = default;
};

struct Header {
  std::string scenario;  // "hull/face_contact"
  std::string title;
  std::string source;
  std::string scalar;  // "float" or "double"
  std::string up;      // "y" or "z"
  int frames = 0;      // frames of the scenario, even if fewer were run
  std::vector<Shape> shapes;
  // Set in another engine's trace:
  std::string engine{};   // "Bullet", ...; empty: this program
  std::string version{};  // version of the engine
  std::string
      poses_at{};  // "before_step", "after_step": when the poses were taken; contacts belong to the
                   // step between
  std::optional<ImpulseConvention> impulses{};
  std::optional<World> world{};

  static constexpr auto fields() {
    return field::list(
        field::exact<&Header::scenario>, field::exact<&Header::title>.optional(),
        field::exact<&Header::source>.optional(),
        field::exact<&Header::scalar>,  //
        field::exact<&Header::up>,      //
        field::exact<&Header::frames>.optional(), field::facts<&Header::shapes>.entries("shape"),
        field::exact<&Header::engine>.where_set(), field::exact<&Header::version>.where_set(),
        field::exact<&Header::poses_at>.where_set(),
        field::fact<&Header::impulses>.called("convention of impulses"),
        field::fact<&Header::world>.called("world"));
  }
};

}  // namespace contactscope::trace
