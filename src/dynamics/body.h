#pragma once

#include <optional>

#include "core/pose.h"
#include "geometry/shape.h"

namespace contactscope {

/// Of a body that is filled evenly. Held in double, whatever the pipeline computes in.
struct MassProperties {
  double mass = 0;                              // kilograms
  Vec3d center = Vec3d::Zero();                 // centre of mass, the shape's frame, metres
  Mat3<double> inertia = Mat3<double>::Zero();  // about the centre, the shape's axes, kg m^2
};

/// Of a shape of one kilogram a cubic metre, so that its mass is its volume. Nothing for planes, meshes
/// and flat hulls: a plane has no end, a mesh is a surface that need not be closed, and a flat hull has
/// no volume; none of them can be dynamic.
template <class S>
std::optional<MassProperties> mass_properties(const Shape<S>& shape);

/// The same body of another mass (kilograms, > 0): the density differs, the form does not.
MassProperties with_mass(const MassProperties& properties, double mass);

/// Metres: how thin a body is, whatever its form and its frame: the shortest edge of the box that has
/// its mass (kilograms, > 0) and its inertia (kg m^2, about its centre). Of a ball 1.55 radii.
double shortest_edge(double mass, const Mat3<double>& inertia);

/// A rigid body. Dynamic bodies are moved by the solver; all others have an infinite mass and move
/// as a script says: `velocity` and `angular_velocity` are then what contacts feel of it.
template <class S>
struct Body {
  Vec3<S> center = Vec3<S>::Zero();  // world, metres: of mass, of others the origin of the shape
  Quat<S> rotation = Quat<S>::Identity();      // the shape's axes to the world's
  Vec3<S> velocity = Vec3<S>::Zero();          // world, metres a second, of `center`
  Vec3<S> angular_velocity = Vec3<S>::Zero();  // world, radians a second
  S mass = 0;                                  // kilograms; 0 stands for infinite
  S inverse_mass = 0;
  Mat3<S> inertia = Mat3<S>::Zero();  // about `center`, the shape's axes, kg m^2
  Mat3<S> inverse_inertia = Mat3<S>::Zero();
  Vec3<S> local_center = Vec3<S>::Zero();  // `center` in the shape's frame

  bool dynamic() const { return inverse_mass > 0; }

  /// Of the shape.
  Pose<S> pose() const { return {rotation, center - rotation * local_center}; }

  /// Puts the shape there.
  void place(const Pose<S>& pose) {
    rotation = pose.rotation;
    center = pose.transform(local_center);
  }
};

/// At rest; `properties` are those of its shape, mass > 0.
template <class S>
Body<S> dynamic_body(const Pose<S>& pose, const MassProperties& properties) {
  const Mat3<double> inverse = properties.inertia.inverse();
  Body<S> body;
  body.mass = static_cast<S>(properties.mass);
  body.inverse_mass = static_cast<S>(1 / properties.mass);
  body.inertia = properties.inertia.cast<S>();
  body.inverse_inertia = inverse.cast<S>();
  body.local_center = properties.center.cast<S>();
  body.place(pose);
  return body;
}

/// At rest, of infinite mass.
template <class S>
Body<S> static_body(const Pose<S>& pose) {
  Body<S> body;
  body.place(pose);
  return body;
}

/// Of a scripted body: the constant velocities that carry it from `from` to `to` in `dt` seconds,
/// the shortest way round.
template <class S>
void set_scripted_velocity(Body<S>& body, const Pose<double>& from, const Pose<double>& to,
                           double dt) {
  const Vec3d velocity = (to.position - from.position) / dt;
  body.velocity = velocity.cast<S>();
  body.angular_velocity = Vec3<S>::Zero();
  if (from.rotation.coeffs() == to.rotation.coeffs()) return;
  const Eigen::AngleAxisd turn(to.rotation * from.rotation.conjugate());
  const Vec3d angular = turn.angle() / dt * turn.axis();
  body.angular_velocity = angular.cast<S>();
}

/// About `center`, world, kg m^2 / s; 0 of bodies that are not dynamic.
template <class S>
Vec3d angular_momentum(const Body<S>& body) {
  const Quatd rotation = body.rotation.template cast<double>();
  const Vec3d local = rotation.conjugate() * body.angular_velocity.template cast<double>();
  const Vec3d momentum = body.inertia.template cast<double>() * local;
  return rotation * momentum;
}

/// Joules; 0 of bodies that are not dynamic.
template <class S>
double kinetic_energy(const Body<S>& body) {
  const Vec3d velocity = body.velocity.template cast<double>();
  const Vec3d turning = body.angular_velocity.template cast<double>();
  return 0.5 * static_cast<double>(body.mass) * velocity.squaredNorm() +
         0.5 * turning.dot(angular_momentum(body));
}

/// Joules against `gravity` (metres a second, a second), 0 at the origin.
template <class S>
double potential_energy(const Body<S>& body, const Vec3d& gravity) {
  return -static_cast<double>(body.mass) * gravity.dot(body.center.template cast<double>());
}

}  // namespace contactscope
