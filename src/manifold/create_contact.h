#pragma once

#include "manifold/clip.h"
#include "manifold/collide_options.h"
#include "manifold/contact.h"
#include "query/sat.h"

namespace contactscope {

template <class S> class Recorder;

/// Gregorius 2015, "Hull vs Hull: Contact Creation": a face contact or an edge contact from the
/// axis chosen by the separating axis test. `axes` must be touching.
///
/// An overlapping pair gets at least one point, and its deepest point is as deep as the deepest
/// axis less 5% (with Preference::None, less rounding). Where clipping falls short, a preferred
/// face is replaced by the deepest axis; if that is a face as well, support_contact() is added to
/// the points. The record then has a dropped point "cut off by the side planes; kept as the deepest
/// point". Pairs with a separation between zero and the margin may get no point.
template <class S>
void create_contact(const HullPair<S>& pair, const SatResult<S>& axes,
                    const CollideOptions& options, Contact<S>& contact, Recorder<S>* recorder);

/// Gregorius 2015, "Hull vs Hull: Face Contact", "Face Contact Clipping", "Coherent Points". Clips
/// the incident face against the side planes of the reference face, which `reference` owns, and
/// moves points up to `margin` (metres) above that face onto it. Overwrites `contact` and returns
/// the separation of the deepest point in metres; +infinity without points.
template <class S>
S create_face_contact(const HullPair<S>& pair, Owner reference, const FaceQuery<S>& query, S margin,
                      Contact<S>& contact, Recorder<S>* recorder);

/// The same for a known incident face and PlacedHull or PlacedFeatures. `scale` as in HullPair.
template <class Reference, class Other, class S>
S create_face_contact(const Reference& hull, const Other& other_hull, Owner reference,
                      const FaceQuery<S>& query, int incident, S scale, S margin,
                      Contact<S>& contact, Recorder<S>* recorder);

/// The face most anti-parallel to `reference_normal` among those at `support`, the vertex of `hull`
/// that is deepest below the reference face. The talk searches all faces. The result is the same
/// unless a sharp vertex sticks out (a pencil standing on its tip, a box with a spike). Then the
/// talk's face lacks the deepest point, and the manifold would miss the overlap.
template <class Placed, class S = typename Placed::Scalar>
int incident_face(const Placed& hull, int support, const Vec3<S>& reference_normal);

/// The point of the reference face above the deepest point of the other hull (depth from `query`),
/// for overlaps whose deepest point the clipping lost. Its id is the reference face and the other
/// hull's vertex there or the incident face. Never outside the reference face.
template <class S>
ContactPoint<S> support_contact(const HullPair<S>& pair, Owner reference, const FaceQuery<S>& query,
                                Recorder<S>* recorder);

}  // namespace contactscope
