#pragma once

#include "draw/scene/scene.h"

namespace contactscope::draw {

/// What a scenario calls the pair, above its shapes where it covers none. Of several pairs that share
/// a name the last one bears it: of a stack the uppermost. `pair` is one of the scene's.
void draw_pair_label(const Scene& scene, const trace::Pair& pair, Sketch& sketch);

}  // namespace contactscope::draw
