#include "manifold/collide_pairs.h"
#include "manifold/round_contact.h"

namespace contactscope {

template <class S>
S collide_sphere_sphere(const Sphere<S>& a, const Sphere<S>& b, const Pose<S>& b_in_a,
                        const CollideOptions& options, Contact<S>& contact, Recorder<S>* recorder) {
  const Vec3<S>& center_b = b_in_a.position;
  const S distance = safe_norm(center_b);
  const S separation = distance - (a.radius + b.radius);
  if (separation > options.margin) return separation;

  if (distance > S(0)) {
    contact.normal = safe_unit(center_b);
  } else {
    if (skips_degenerate("coincident centres", options, recorder)) return separation;
    contact.normal = b_in_a.rotate(Vec3<S>::UnitY());
  }
  contact.axis = AxisKind::ClosestPoints;
  contact.type = ContactType::PointPoint;
  const FeatureId id = FeatureId::of(vertex_ref(Owner::A, 0), vertex_ref(Owner::B, 0));
  add_round_point(Vec3<S>(Vec3<S>::Zero()), a.radius, center_b, b.radius, contact.normal, distance,
                  id, contact);
  return separation;
}

template CollideConvex<float, Sphere<float>, Sphere<float>> collide_sphere_sphere;
template CollideConvex<double, Sphere<double>, Sphere<double>> collide_sphere_sphere;

}  // namespace contactscope
