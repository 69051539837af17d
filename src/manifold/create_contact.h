#pragma once

#include "core/manifold.h"
#include "manifold/contact.h"
#include "query/sat.h"

namespace contactscope {

template <class S>
class Recorder;

/// Gregorius 2015, "Hull vs Hull: Contact Creation": a face contact or an edge contact from the
/// axis that the separating axis test chose. `axes` must be touching.
///
/// An overlapping pair gets at least one point, and its deepest point is as deep as the deepest
/// axis less the preference tolerance (with Preference::None, less rounding). Where clipping falls
/// short of that, a preferred face gives way to the deepest axis; if that is a face itself, its
/// support vertex joins the points. The record says so: a dropped point "cut off by the side
/// planes; kept as the deepest point". Pairs apart by no more than the margin may get no point.
template <class S>
void create_contact(const HullPair<S>& pair, const SatResult<S>& axes, S margin,
                    Preference preference, Contact<S>& contact, Recorder<S>* recorder);

}  // namespace contactscope
