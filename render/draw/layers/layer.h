#pragma once

#include <array>

#include "core/layers.h"
#include "draw/scene/scene.h"

namespace contactscope::draw {

using trace::Stages;

/// All of a layer but its name: what it needs recorded and what it draws, which it explains to the
/// sketch's legend. It stands in the file of the layer.
struct LayerDrawing {
  using OfFrame = void (*)(const Scene&, Sketch&);
  using OfPair = void (*)(const Scene&, const trace::Pair&, Sketch&);

  std::array<bool Stages::*, 3> needs{};
  OfFrame beneath = nullptr;  // once a frame, first
  OfPair search = nullptr;    // pair by pair: how its contact was looked for
  OfPair result = nullptr;    // pair by pair: its contact, which a story of steps tells last
  OfFrame above = nullptr;    // once a frame, last

  /// Of a layer that costs much to draw: what the legend says of it, which drawing then leaves out.
  /// The legends of a whole sequence are made to find room for the longest, where only the frames
  /// that are shown are drawn.
  void (*explain)(const Scene&, Legend&) = nullptr;
};

/// One for each Layer, in their order.
using LayerTable = std::array<const LayerDrawing*, kLayerNames.size()>;

#define CONTACTSCOPE_DECLARE(layer, name) extern const LayerDrawing k##layer##Layer;
CONTACTSCOPE_LAYERS(CONTACTSCOPE_DECLARE)
#undef CONTACTSCOPE_DECLARE

#define CONTACTSCOPE_ENTRY(layer, name) &k##layer##Layer,
inline constexpr LayerTable kLayers = {CONTACTSCOPE_LAYERS(CONTACTSCOPE_ENTRY)};
#undef CONTACTSCOPE_ENTRY

}  // namespace contactscope::draw
