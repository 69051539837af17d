#pragma once

#include "draw/scene/scene.h"

namespace contactscope::draw {

using trace::Stages;

/// The parts of a layer except its name: the stages it needs, and its drawing functions, which add
/// to the sketch's legend. It is defined in the layer's file.
struct LayerDrawing {
  using OfFrame = void (*)(const Scene&, Sketch&);
  using OfPair = void (*)(const Scene&, const trace::Pair&, Sketch&);

  std::array<bool Stages::*, 3> needs{};
  OfFrame beneath = nullptr;  // once a frame, first
  OfPair search = nullptr;    // pair by pair: the search for its contact
  OfPair result = nullptr;    // pair by pair: its contact, the last step of a story
  OfFrame above = nullptr;    // once a frame, last

  /// For layers that are slow to draw: the layer's legend entries, which drawing then does not add.
  /// Layout needs the legends of all frames of a sequence, but only the shown frames are drawn.
  void (*explain)(const Scene&, Legend&) = nullptr;
};

/// One entry for each Layer, in order.
using LayerTable = std::array<const LayerDrawing*, kLayerNames.size()>;

#define CONTACTSCOPE_DECLARE(layer, name) extern const LayerDrawing k##layer##Layer;
CONTACTSCOPE_LAYERS(CONTACTSCOPE_DECLARE)
#undef CONTACTSCOPE_DECLARE

#define CONTACTSCOPE_ENTRY(layer, name) &k##layer##Layer,
inline constexpr LayerTable kLayers = {CONTACTSCOPE_LAYERS(CONTACTSCOPE_ENTRY)};
#undef CONTACTSCOPE_ENTRY

}  // namespace contactscope::draw
