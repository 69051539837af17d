#include "manifold/create_contact.h"

#include "manifold/edge_contact.h"
#include "manifold/face_contact.h"
#include "manifold/recorder.h"
#include "query/tolerance.h"

namespace contactscope {
namespace {

/// The separation that a manifold's deepest point must not exceed.
template <class S>
S deep_enough(const HullPair<S>& pair, S deepest_axis, Preference preference) {
  const S preferred = preference == Preference::Relative
                          ? preference_tolerance(deepest_axis, pair.min_radius)
                          : S(0);
  return deepest_axis + preferred + depth_rounding(pair.scale);
}

template <class S>
S face_contact(const HullPair<S>& pair, const SatResult<S>& axes, S margin, Contact<S>& contact,
               Recorder<S>* recorder) {
  if (contact.axis == AxisKind::FaceA) {
    contact.normal = pair.a.normals[axes.face_a.face];
    return create_face_contact(pair, Owner::A, axes.face_a, margin, contact.points, recorder);
  }
  contact.normal = -pair.b.normals[axes.face_b.face];
  return create_face_contact(pair, Owner::B, axes.face_b, margin, contact.points, recorder);
}

template <class S>
void edge_contact(const HullPair<S>& pair, const SatResult<S>& axes, Contact<S>& contact) {
  contact.type = ContactType::EdgeEdge;
  contact.normal = axes.edge.normal;
  contact.points.clear();
  contact.points.push_back(
      create_edge_contact(closest_points(pair.a, pair.b, axes.edge), axes.edge));
}

/// The contact of the chosen axis; leaves the type of a face contact open.
template <class S>
void contact_of_axis(const HullPair<S>& pair, const SatResult<S>& axes, S margin,
                     Preference preference, Contact<S>& contact, Recorder<S>* recorder) {
  contact.axis = axes.chosen;
  if (contact.axis == AxisKind::EdgeEdge) return edge_contact(pair, axes, contact);

  const S deepest_axis = axes.separation(axes.deepest);
  const S limit = deep_enough(pair, deepest_axis, preference);
  S deepest = face_contact(pair, axes, margin, contact, recorder);
  const bool overlap = deepest_axis <= S(0);
  if (!overlap || deepest <= limit) return;

  // The face's support vertex hangs over its side, which only a face that is not the deepest axis
  // allows beyond rounding.
  if (contact.axis != axes.deepest) {
    if (recorder) [[unlikely]]
      recorder->clip_abandoned();
    contact.axis = axes.deepest;
    if (contact.axis == AxisKind::EdgeEdge) return edge_contact(pair, axes, contact);
    deepest = face_contact(pair, axes, margin, contact, recorder);
    if (deepest <= limit) return;
  }
  const bool on_a = contact.axis == AxisKind::FaceA;
  const ContactPoint<S> support =
      support_contact(pair, on_a ? Owner::A : Owner::B, on_a ? axes.face_a : axes.face_b, recorder);
  if (contact.points.size() < contact.points.capacity()) contact.points.push_back(support);
}

}  // namespace

template <class S>
void create_contact(const HullPair<S>& pair, const SatResult<S>& axes, S margin,
                    Preference preference, Contact<S>& contact, Recorder<S>* recorder) {
  contact_of_axis(pair, axes, margin, preference, contact, recorder);
  if (contact.axis != AxisKind::EdgeEdge) contact.type = face_contact_type(contact.points.size());
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                    \
  template void create_contact(const HullPair<S>&, const SatResult<S>&, S, Preference, \
                               Contact<S>&, Recorder<S>*);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
