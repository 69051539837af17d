#pragma once

#include <array>

#include "core/layers.h"
#include "draw/scene/scene.h"

namespace contactscope::draw {

/// All of a layer but its name: what it needs recorded, what it draws, and what the legend says of
/// that. It stands in the file of the layer.
struct LayerDrawing {
  using OfFrame = void (*)(const Scene&, Sketch&);
  using OfPair = void (*)(const Scene&, const trace::Pair&, Sketch&);

  std::array<bool trace::Stages::*, 3> needs{};
  OfFrame beneath = nullptr;  // once a frame, first
  OfPair search = nullptr;    // pair by pair: how its contact was looked for
  OfPair result = nullptr;    // pair by pair: its contact, which a story of steps tells last
  OfFrame above = nullptr;    // once a frame, last

  /// What of all this is in the picture, for the legend. Asked of every frame of a sequence, to make
  /// room for the longest legend, where drawing is asked only of the frames that are shown.
  void (*explain)(const Scene&, const trace::Pair&, Legend&) = nullptr;
  void (*explain_frame)(const Scene&, Legend&) = nullptr;
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
