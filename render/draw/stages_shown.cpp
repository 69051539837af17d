#include "draw/stages_shown.h"

#include "draw/layers/layer.h"

namespace contactscope::draw {
namespace {

using trace::Stages;
using Needs = std::array<bool Stages::*, 3>;

// One row for each Panel, in their order.
constexpr std::array<Needs, kPanelNames.size()> kOfPanels{{
    {&Stages::sat, &Stages::reduction},                        // Summary
    {&Stages::clip, &Stages::reduction},                       // ContactPlane
    {&Stages::sat},                                            // AxisHistory
    {&Stages::stability},                                      // Stability
    {},                                                        // Plots
    {&Stages::minkowski, &Stages::gjk, &Stages::penetration},  // Minkowski
    {&Stages::gauss_map, &Stages::sat},                        // GaussMap
}};

// And for each Story.
constexpr std::array<Needs, 4> kOfStories{{
    {},                                    // None
    {&Stages::clip},                       // ClipSteps
    {&Stages::gjk, &Stages::penetration},  // GjkSteps
    {&Stages::gjk, &Stages::penetration},  // EpaSteps
}};

}  // namespace

trace::Stages stages_shown(const std::vector<View>& views) {
  trace::Stages stages = trace::Stages::none();
  const auto add = [&](const Needs& needs) {
    for (const auto stage : needs) {
      if (stage != nullptr) stages.*stage = true;
    }
  };
  for (const View& view : views) {
    for (const Layer layer : view.layers) add(kLayers[static_cast<std::size_t>(layer)]->needs);
    for (const Panel panel : view.panels) add(kOfPanels[static_cast<std::size_t>(panel)]);
    add(kOfStories[static_cast<std::size_t>(view.story)]);
    stages.reduction = stages.reduction || view.kind == ViewKind::ContactPlane;
  }
  return stages;
}

}  // namespace contactscope::draw
