#include "manifold/create_contact.h"

#include "manifold/contact_depth.h"
#include "manifold/edge_contact.h"
#include "manifold/recorder.h"

namespace contactscope {

template <class S>
void create_contact(const HullPair<S>& pair, const SatResult<S>& axes,
                    const CollideOptions& options, Contact<S>& contact, Recorder<S>* recorder) {
  for (const AxisKind axis : {axes.chosen, axes.deepest}) {
    if (axis == AxisKind::EdgeEdge)
      return create_edge_contact(closest_points(pair.a, pair.b, axes.edge), axes.edge, contact);
    const Owner reference = axis == AxisKind::FaceA ? Owner::A : Owner::B;
    const FaceQuery<S>& query = reference == Owner::A ? axes.face_a : axes.face_b;
    const S deepest = create_face_contact(pair, reference, query, static_cast<S>(options.margin),
                                          contact, recorder);
    const S deepest_axis = axes.separation(axes.deepest);
    const bool overlap = deepest_axis <= S(0);
    if (!overlap || is_deep_enough(deepest, deepest_axis, options.preference, pair.scale)) return;

    // Either the support vertex is outside the side planes (beyond rounding only if the face is not
    // the deepest axis), or the clipped face is not the one that reaches below the reference face.
    if (axis == axes.deepest) {
      const ContactPoint<S> support = support_contact(pair, reference, query, recorder);
      if (contact.points.size() < contact.points.capacity()) contact.points.push_back(support);
      contact.type = face_contact_type(contact.points.size());
      return;
    }
    if (recorder) [[unlikely]]
      recorder->clip_abandoned();
  }
}

template decltype(create_contact<float>) create_contact<float>;
template decltype(create_contact<double>) create_contact<double>;

}  // namespace contactscope
