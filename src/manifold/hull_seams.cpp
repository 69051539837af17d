#include "manifold/collide_pairs.h"
#include "manifold/create_contact.h"
#include "manifold/internal_edges.h"
#include "manifold/round_contact.h"
#include "query/fast/face_bounds.h"

namespace contactscope {
namespace {

/// Whether the surface beyond an edge of the hull, from either of its faces, rises along a normal.
template <class S>
bool rises_beyond(const Hull<S>& hull, int half_edge, const ContactNormal<S>& normal) {
  for (const int edge : {half_edge, Hull<S>::twin(half_edge)}) {
    const Vec3<S>& beyond = at(hull.seams.beyond, edge);
    const Vec3<S> back = hull.origin(edge) - hull.target(edge);
    if (!beyond.isZero(S(0)) && normal.rises(beyond.cross(back))) return true;
  }
  return false;
}

/// Why the surface lacks what a contact touches; null: it has it. `normal`: outward, hull's frame.
template <class S>
const char* lacks(const Hull<S>& hull, Owner owner, const ContactNormal<S>& normal,
                  const Contact<S>& contact) {
  for (int face = 0; face < hull.face_count(); ++face) {
    const Vec3<S>& outward = at(hull.planes, face).normal;
    if (normal.direction.dot(outward) > S(0) &&
        normal.direction.cross(outward).norm() <= normal.tolerance)
      return at(hull.seams.covered, face) != 0 ? "covered face" : nullptr;
  }
  const auto is_inside = [&](const FeatureRef& feature) {
    const int index = static_cast<int>(feature.index);
    if (feature.owner != owner || feature.kind == FeatureKind::Face) return false;
    if (feature.kind == FeatureKind::Edge) return rises_beyond(hull, 2 * index, normal);
    return std::ranges::any_of(hull.around_vertex(index),
                               [&](int edge) { return rises_beyond(hull, edge, normal); });
  };
  for (const ContactPoint<S>& point : contact.points)
    if (is_inside(point.id.first) || is_inside(point.id.second)) return "continued edge";
  return nullptr;
}

/// The uncovered face that a point is farthest in front of; -1: all are covered.
template <class S> int face_before(const Hull<S>& hull, const Vec3<S>& point) {
  int best = -1;
  S highest = -std::numeric_limits<S>::infinity();
  for (int face = 0; face < hull.face_count(); ++face) {
    const S height = at(hull.planes, face).distance(point);
    if (at(hull.seams.covered, face) != 0 || !(height > highest)) continue;
    highest = height;
    best = face;
  }
  return best;
}

template <class S> Vec3<S> middle_of(const Hull<S>& a) { return a.centroid; }
template <class S> Vec3<S> middle_of(const Sphere<S>&) { return Vec3<S>::Zero(); }
template <class S> Vec3<S> middle_of(const Capsule<S>& a) {
  return S(0.5) * (a.points[0] + a.points[1]);
}

}  // namespace

template <class S, class A>
void respect_seams(const A& a, const Hull<S>& b, const Pose<S>& b_in_a, Owner owner,
                   const CollideOptions& options, Contact<S>& contact, Recorder<S>* recorder) {
  const Hull<S>* hull = &b;
  if constexpr (std::is_same_v<A, Hull<S>>)
    if (owner == Owner::A) hull = &a;
  if (hull->seams.empty() || contact.points.empty() || !options.internal_edges) return;
  const bool of_a = owner == Owner::A;
  const ContactNormal<S> normal{of_a ? contact.normal
                                     : Vec3<S>(-b_in_a.inverse_rotate(contact.normal))};
  const char* const reason = lacks(*hull, owner, normal, contact);
  if (reason == nullptr) return;
  if (recorder) [[unlikely]]
    recorder->voided(owner, reason, contact);
  const Vec3<S> middle =
      of_a ? b_in_a.transform(b.centroid) : b_in_a.inverse_transform(middle_of(a));
  const int face = face_before(*hull, middle);
  contact.points.clear();
  if (face < 0) return;
  if constexpr (std::is_same_v<A, Hull<S>>) {
    const HullPair<S> pair(a, b, b_in_a);
    const FaceQuery<S> query =
        of_a ? measure_face(pair.a, face, pair.b) : measure_face(pair.b, face, pair.a);
    create_face_contact(pair, owner, query, static_cast<S>(options.margin), contact, recorder);
  } else {
    const Vec3<S> centre = b_in_a.inverse_transform(middle_of(a));
    Vec3<S> ends[2] = {centre, centre};
    if constexpr (std::is_same_v<A, Capsule<S>>)
      for (int end = 0; end < 2; ++end) ends[end] = b_in_a.inverse_transform(at(a.points, end));
    if (ends[0] == ends[1] && !projects_into(b, face, centre, S(0))) return;
    touch_along_face(b, b_in_a, face, ends, a.radius, static_cast<S>(options.margin), contact);
  }
}

template decltype(respect_seams<float, Hull<float>>) respect_seams<float, Hull<float>>;
template decltype(respect_seams<double, Hull<double>>) respect_seams<double, Hull<double>>;
template decltype(respect_seams<float, Sphere<float>>) respect_seams<float, Sphere<float>>;
template decltype(respect_seams<double, Sphere<double>>) respect_seams<double, Sphere<double>>;
template decltype(respect_seams<float, Capsule<float>>) respect_seams<float, Capsule<float>>;
template decltype(respect_seams<double, Capsule<double>>) respect_seams<double, Capsule<double>>;

}  // namespace contactscope
