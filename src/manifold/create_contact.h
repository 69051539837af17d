#pragma once

#include "manifold/clip.h"
#include "manifold/collide_options.h"
#include "manifold/contact.h"
#include "query/sat.h"

namespace contactscope {

template <class S>
class Recorder;

/// Gregorius 2015, "Hull vs Hull: Contact Creation": a face contact or an edge contact from the
/// axis that the separating axis test chose. `axes` must be touching.
///
/// An overlapping pair gets at least one point, and its deepest point is as deep as the deepest
/// axis less 5% (with Preference::None, less rounding). Where clipping falls short of that, a
/// preferred face gives way to the deepest axis; if that is a face itself, support_contact() joins
/// the points. The record says so: a dropped point "cut off by the side planes; kept as the deepest
/// point". Pairs that are separated by no more than the margin may get no point.
template <class S>
void create_contact(const HullPair<S>& pair, const SatResult<S>& axes,
                    const CollideOptions& options, Contact<S>& contact, Recorder<S>* recorder);

// face_contact.cpp

/// Gregorius 2015, "Hull vs Hull: Face Contact", "Face Contact Clipping", "Coherent Points". The
/// incident face, clipped against the side planes of the reference face but not against the
/// reference face itself; points up to `margin` (metres) above it are kept and moved onto it. Those
/// above the margin by no more than rounding count as at the margin.
/// `reference` says whose face `query.face` is. Fills `contact` anew and returns the separation of
/// the deepest point in metres; +infinity when nothing is left.
template <class S>
S create_face_contact(const HullPair<S>& pair, Owner reference, const FaceQuery<S>& query, S margin,
                      Contact<S>& contact, Recorder<S>* recorder);

/// The same with an incident face that is known, of hulls that are PlacedHull or PlacedFeatures.
/// `scale` is the pair's (see HullPair), metres.
template <class Reference, class Other, class S>
S create_face_contact(const Reference& hull, const Other& other_hull, Owner reference,
                      const FaceQuery<S>& query, int incident, S scale, S margin,
                      Contact<S>& contact, Recorder<S>* recorder);

/// The face of `hull` that is most anti-parallel to `reference_normal`, among those that meet at
/// its vertex `support`, the deepest below the reference face. The talk looks through all faces.
/// That is the same face unless the deepest vertex is a sharp one that sticks out beside it (a
/// pencil standing on its tip, a box with a spike): then the talk's face does not have the deepest
/// point, and the manifold would miss the overlap.
template <class Placed, class S = typename Placed::Scalar>
int incident_face(const Placed& hull, int support, const Vec3<S>& reference_normal);

/// The point of the reference face where the other hull is as deep below it as `query` says, for
/// overlaps whose deepest point the clipping lost. Its id is the reference face, and of the other
/// hull the vertex that is there or the incident face. Never outside of the reference face.
template <class S>
ContactPoint<S> support_contact(const HullPair<S>& pair, Owner reference, const FaceQuery<S>& query,
                                Recorder<S>* recorder);

}  // namespace contactscope
