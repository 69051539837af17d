#include "manifold/fast/fast_pairs.h"

#include "manifold/fast/box_face_contact.h"
#include "query/fast/box_sat.h"

namespace contactscope {
namespace {

using namespace boxes;

/// create_edge_contact() for two boxes.
template <class S>
[[gnu::always_inline]] inline void edge_contact(const BoxAxis<S>& axis, BoxContact<S>& contact) {
  contact.axis = AxisKind::EdgeEdge;
  contact.type = ContactType::EdgeEdge;
  contact.normal = axis.edge.normal;
  contact.put(0, axis.edge.middle, axis.edge.separation, axis.edges.edge_a / 2,
              12 + axis.edges.edge_b / 2);
  contact.count = 1;
}

/// The steps of collide_hull_hull(); false: use that instead, and `contact` is undefined.
template <class S>
[[gnu::always_inline]] inline bool collide(const Hull<S>& a, const Hull<S>& b,
                                           const Pose<S>& b_in_a, const CollideOptions& options,
                                           BoxContact<S>& contact) {
  // Not a rotation, or not finite.
  if (!(std::abs(b_in_a.rotation.squaredNorm() - S(1)) <= S(8) * std::numeric_limits<S>::epsilon()))
    return false;
  const BoxPair<S> pair(a, b, b_in_a);
  contact.scale = pair.scale;
  const S margin = static_cast<S>(options.margin);
  const BoxAxis<S> axis = box_sat(pair, margin, options.preference);
  if (axis.verdict == Verdict::Separated) return true;
  if (axis.verdict == Verdict::Undecided) return false;
  if (axis.verdict == Verdict::Edge) {
    edge_contact(axis, contact);
    return true;
  }
  RectanglePair<S> rectangles;
  const FacePair<S> faces =
      face_pair(pair, axis.reference, axis.face.face, axis.directions, S(0), rectangles);
  S deepest;
  if (!face_contact(faces, axis.reference, axis.face.face, rectangles, pair.scale, margin, contact,
                    deepest))
    return false;
  // As in create_contact(), which would use another axis for a contact less deep than its axis.
  return axis.deepest > S(0) ||
         is_deep_enough(deepest, axis.deepest, options.preference, pair.scale);
}

}  // namespace

template <class S>
[[gnu::flatten]] bool collide_box_box(const Hull<S>& a, const Pose<S>& pose_a, const Hull<S>& b,
                                      const Pose<S>& pose_b, const CollideOptions& options,
                                      std::vector<Manifold<S>>& manifolds) {
  BoxContact<S> contact;
  if (!collide(a, b, relative_pose(pose_a, pose_b), options, contact)) return false;
  if (contact.count > 0) finish(pose_a, options, contact, manifolds.emplace_back());
  return true;
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(collide_box_box);

}  // namespace contactscope
