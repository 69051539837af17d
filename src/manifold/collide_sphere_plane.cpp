#include "manifold/collide_sphere_plane.h"

#include "manifold/plane_contact.h"
#include "manifold/recorder.h"
#ifndef CONTACTSCOPE_WITHOUT_RECORDER
#include "manifold/trace_recorder.h"
#endif

namespace contactscope {

template <class S, class Recorder>
S collide_sphere_plane(const Sphere<S>& a, const HalfSpace<S>& b, const Pose<S>& b_in_a,
                       const CollideOptions<S>& options, Contact<S>& contact,
                       Recorder& /*recorder*/) {
  const Plane<S> plane = plane_in_a(b, b_in_a);
  const Vec3<S> center = Vec3<S>::Zero();
  const S height = plane.distance(center);
  const S separation = height - a.radius;
  if (separation > options.margin) return separation;

  begin_plane_contact(plane, ContactType::PointFace, contact);
  contact.points.push_back(plane_point(plane, center, height, a.radius, 0));
  return separation;
}

#define CONTACTSCOPE_INSTANTIATE(S, Recorder)                                            \
  template S collide_sphere_plane(const Sphere<S>&, const HalfSpace<S>&, const Pose<S>&, \
                                  const CollideOptions<S>&, Contact<S>&, Recorder<S>&);
CONTACTSCOPE_INSTANTIATE(float, NoRecorder)
CONTACTSCOPE_INSTANTIATE(double, NoRecorder)
#ifndef CONTACTSCOPE_WITHOUT_RECORDER
CONTACTSCOPE_INSTANTIATE(float, TraceRecorder)
CONTACTSCOPE_INSTANTIATE(double, TraceRecorder)
#endif
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
