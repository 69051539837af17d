#include "manifold/collide_capsule_plane.h"

#include <algorithm>
#include <cmath>

#include "manifold/plane_contact.h"
#include "manifold/round_contact.h"

namespace contactscope {

template <class S>
S collide_capsule_plane(const Capsule<S>& a, const HalfSpace<S>& b, const Pose<S>& b_in_a,
                        const CollideOptions<S>& options, Contact<S>& contact,
                        Recorder<S>* /*recorder*/) {
  const Plane<S> plane = plane_in_a(b, b_in_a);
  const S heights[2] = {plane.distance(a.points[0]), plane.distance(a.points[1])};
  const S separation = std::min(heights[0], heights[1]) - a.radius;
  if (separation > options.margin) return separation;

  const Vec3<S> along = a.points[1] - a.points[0];
  const S length = safe_norm(along);
  const bool level = length > S(0) && std::abs(plane.normal.dot(along)) <= kLevel<S> * length;
  begin_plane_contact(plane, level ? ContactType::EdgeFace : ContactType::PointFace, contact);
  for (int end = 0; end < (length > S(0) ? 2 : 1); ++end) {
    if (heights[end] - a.radius > options.margin) continue;
    const Vec3<S>& center = a.points[static_cast<std::size_t>(end)];
    contact.points.push_back(plane_point(plane, center, heights[end], a.radius, end));
  }
  return separation;
}

template CollideConvex<float, Capsule<float>, HalfSpace<float>> collide_capsule_plane;
template CollideConvex<double, Capsule<double>, HalfSpace<double>> collide_capsule_plane;

}  // namespace contactscope
