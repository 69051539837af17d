#pragma once

#include "geometry/shape.h"

namespace contactscope {

/// Mass properties of a body of uniform density. In double for any scalar of the pipeline.
struct MassProperties {
  double mass = 0;                              // kilograms
  Vec3d center = Vec3d::Zero();                 // centre of mass, in the shape's frame, metres
  Mat3<double> inertia = Mat3<double>::Zero();  // about the centre, the shape's axes, kg m^2
};

/// For a density of 1 kg/m^3: the mass equals the volume. nullopt for shapes that cannot be
/// dynamic: infinite planes, meshes, which need not be closed, and flat hulls without volume.
template <class S> std::optional<MassProperties> mass_properties(const Shape<S>& shape);

/// The same body with another mass (kilograms, > 0) and the density that follows.
MassProperties with_mass(const MassProperties& properties, double mass);

/// Thickness of a body in metres, for any shape and frame: shortest edge of the box with its mass
/// (kilograms, > 0) and inertia (kg m^2, about its centre). For a ball 1.55 radii.
double shortest_edge(double mass, const Mat3<double>& inertia);

/// A rigid body. Dynamic bodies are moved by the solver. All others have infinite mass and follow a
/// script; contacts use their `velocity` and `angular_velocity`.
template <class S> struct Body {
  Vec3<S> center = Vec3<S>::Zero();  // centre of mass, world, metres; if not dynamic the origin
  Quat<S> rotation = Quat<S>::Identity();      // the shape's axes to the world's
  Vec3<S> velocity = Vec3<S>::Zero();          // world, metres per second, of `center`
  Vec3<S> angular_velocity = Vec3<S>::Zero();  // world, radians per second
  S mass = 0;                                  // kilograms; 0 means infinite
  S inverse_mass = 0;
  Mat3<S> inertia = Mat3<S>::Zero();  // about `center`, the shape's axes, kg m^2
  Mat3<S> inverse_inertia = Mat3<S>::Zero();
  Vec3<S> local_center = Vec3<S>::Zero();  // `center` in the shape's frame
  bool dynamic() const { return inverse_mass > 0; }
  Pose<S> pose() const { return {rotation, center - rotation * local_center}; }

  void place(const Pose<S>& pose) {
    rotation = pose.rotation;
    center = pose.transform(local_center);
  }
};

/// A body at rest with the `properties` of its shape, mass > 0.
template <class S> Body<S> dynamic_body(const Pose<S>& pose, const MassProperties& properties) {
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

/// A body at rest with infinite mass.
template <class S> Body<S> static_body(const Pose<S>& pose) {
  Body<S> body;
  body.place(pose);
  return body;
}

/// Sets the velocities that move a scripted body from `from` to `to` in `dt` seconds.
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

/// About `center`, world, kg m^2 / s; 0 for bodies that are not dynamic.
template <class S> Vec3d angular_momentum(const Body<S>& body) {
  const Quatd rotation = body.rotation.template cast<double>();
  const Vec3d local = rotation.conjugate() * body.angular_velocity.template cast<double>();
  const Vec3d momentum = body.inertia.template cast<double>() * local;
  return rotation * momentum;
}

/// Joules; 0 for bodies that are not dynamic.
template <class S> double kinetic_energy(const Body<S>& body) {
  const Vec3d velocity = body.velocity.template cast<double>();
  const Vec3d turning = body.angular_velocity.template cast<double>();
  return 0.5 * static_cast<double>(body.mass) * velocity.squaredNorm() +
         0.5 * turning.dot(angular_momentum(body));
}

/// Joules for `gravity` in m/s^2, 0 at the origin.
template <class S> double potential_energy(const Body<S>& body, const Vec3d& gravity) {
  return -static_cast<double>(body.mass) * gravity.dot(body.center.template cast<double>());
}

}  // namespace contactscope
