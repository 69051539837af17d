#include "manifold/collide_pairs.h"
#include "manifold/round_contact.h"
#include "query/tolerance.h"

// The plane is always B and is treated as an infinite face of a hull: points move onto it, as the
// talk moves the points of a face contact onto the reference face ("Face Contact Clipping"). So a
// floor gives the same manifold as the top of a wide box, and the points are coplanar. The lecture
// on contact generation ("Box-Plane Contact Generation") puts them at half the depth.

namespace contactscope {
namespace {

/// Shapes whose ends differ in height by less than this fraction of their size are level. This
/// equals the preference of the separating axis test: 0.2%, a tenth of a degree. It does not depend
/// on the depth: the lowest feature does not change as it sinks.
template <class S> constexpr S kLevel = S(0.002);

/// The boundary of `half_space` in A's frame.
template <class S> Plane<S> plane_in_a(const HalfSpace<S>& half_space, const Pose<S>& b_in_a) {
  const Vec3<S> normal = b_in_a.rotate(half_space.plane.normal);
  return {normal, half_space.plane.offset + normal.dot(b_in_a.position)};
}

/// Initializes a contact of A with that plane: the normal points into the ground.
template <class S>
void begin_plane_contact(const Plane<S>& plane, ContactType type, Contact<S>& contact) {
  contact.axis = AxisKind::FaceB;
  contact.type = type;
  contact.normal = -plane.normal;
}

/// The point below the ball of `radius` about vertex `index` of A, `height` above the plane.
template <class S>
ContactPoint<S> plane_point(const Plane<S>& plane, const Vec3<S>& core, S height, S radius,
                            int index) {
  const FeatureId id = FeatureId::of(vertex_ref(Owner::A, index), face_ref(Owner::B, 0));
  return {core - height * plane.normal, height - radius, id};
}

template <class S> bool is_deeper(const ContactPoint<S>& one, const ContactPoint<S>& other) {
  return one.separation < other.separation;
}

/// Keeps the deepest of more points than fit into a manifold: a heap with the highest on top.
template <class S>
void replace_highest(const ContactPoint<S>& point, bool& is_heap, Contact<S>& contact) {
  auto& points = contact.points;
  if (!is_heap) std::make_heap(points.begin(), points.end(), is_deeper<S>);
  is_heap = true;
  if (!is_deeper(point, *points.begin())) return;
  std::pop_heap(points.begin(), points.end(), is_deeper<S>);
  points.back() = point;
  std::push_heap(points.begin(), points.end(), is_deeper<S>);
}

}  // namespace

template <class S>
S collide_sphere_plane(const Sphere<S>& a, const HalfSpace<S>& b, const Pose<S>& b_in_a,
                       const CollideOptions& options, Contact<S>& contact,
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

template <class S>
S collide_capsule_plane(const Capsule<S>& a, const HalfSpace<S>& b, const Pose<S>& b_in_a,
                        const CollideOptions& options, Contact<S>& contact,
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
    contact.points.push_back(plane_point(plane, at(a.points, end), heights[end], a.radius, end));
  }
  return separation;
}

template <class S>
S collide_hull_plane(const Hull<S>& a, const HalfSpace<S>& b, const Pose<S>& b_in_a,
                     const CollideOptions& options, Contact<S>& contact,
                     Recorder<S>* /*recorder*/) {
  const Plane<S> plane = plane_in_a(b, b_in_a);
  S lowest = std::numeric_limits<S>::infinity();
  bool is_heap = false;
  for (int v = 0; v < a.vertex_count(); ++v) {
    const Vec3<S>& vertex = at(a.vertices, v);
    const S height = plane.distance(vertex);
    lowest = std::min(lowest, height);
    if (height > options.margin) continue;
    const ContactPoint<S> point = plane_point(plane, vertex, height, S(0), v);
    if (contact.points.size() < kMaxManifoldPoints)
      contact.points.push_back(point);
    else
      replace_highest(point, is_heap, contact);
  }
  if (lowest > options.margin) return lowest;
  // Restore the order of the vertices.
  if (is_heap) std::ranges::sort(contact.points, {}, &ContactPoint<S>::id);

  const S scale = a.centroid.cwiseAbs().maxCoeff() + a.radius + std::abs(plane.offset);
  contact.scale = scale;
  const S tolerance =
      options.preference == Preference::Relative ? kLevel<S> * a.radius : tie_tolerance(scale);
  const auto as_low = std::ranges::count_if(a.vertices, [&](const Vec3<S>& vertex) {
    return plane.distance(vertex) <= lowest + tolerance;
  });
  begin_plane_contact(plane, face_contact_type(static_cast<std::size_t>(as_low)), contact);
  return lowest;
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(collide_sphere_plane, collide_capsule_plane, collide_hull_plane);

}  // namespace contactscope
