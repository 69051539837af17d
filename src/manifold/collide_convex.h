#pragma once

#include "manifold/collide_options.h"
#include "manifold/contact.h"
#include "manifold/recorder.h"

namespace contactscope {

/// What collides two convex shapes in the frame of the first: fills `contact` there and returns the
/// separation, metres, negative in overlap. `recorder` is null when nobody watches.
template <class S, class A, class B>
using CollideConvex = S(const A& a, const B& b, const Pose<S>& b_in_a,
                        const CollideOptions<S>& options, Contact<S>& contact,
                        Recorder<S>* recorder);

}  // namespace contactscope
