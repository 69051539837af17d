#include "manifold/collide_sphere_plane.h"

#include "manifold/plane_contact.h"

namespace contactscope {

template <class S>
S collide_sphere_plane(const Sphere<S>& a, const HalfSpace<S>& b, const Pose<S>& b_in_a,
                       const CollideOptions<S>& options, Contact<S>& contact,
                       Recorder<S>* /*recorder*/) {
  const Plane<S> plane = plane_in_a(b, b_in_a);
  const Vec3<S> center = Vec3<S>::Zero();
  const S height = plane.distance(center);
  const S separation = height - a.radius;
  if (separation > options.margin) return separation;

  begin_plane_contact(plane, ContactType::PointFace, contact);
  contact.points.push_back(plane_point(plane, center, height, a.radius, 0));
  return separation;
}

template CollideConvex<float, Sphere<float>, HalfSpace<float>> collide_sphere_plane;
template CollideConvex<double, Sphere<double>, HalfSpace<double>> collide_sphere_plane;

}  // namespace contactscope
