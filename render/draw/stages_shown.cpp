#include "draw/stages_shown.h"

#include "draw/layers/layer.h"

namespace contactscope::draw {
namespace {

using Stage = bool trace::Stages::*;

std::vector<Stage> needs_of(Panel panel) {
  using trace::Stages;
  switch (panel) {
    case Panel::Summary:
      return {&Stages::sat, &Stages::reduction};
    case Panel::ContactPlane:
      return {&Stages::clip, &Stages::reduction};
    case Panel::AxisHistory:
      return {&Stages::sat};
    case Panel::Stability:
      return {&Stages::stability};
    case Panel::Plots:
      return {};
    case Panel::Minkowski:
      return {&Stages::minkowski, &Stages::gjk, &Stages::penetration};
    case Panel::GaussMap:
      return {&Stages::gauss_map, &Stages::sat};
  }
  return {};
}

std::vector<Stage> needs_of(Story story) {
  using trace::Stages;
  switch (story) {
    case Story::None:
      return {};
    case Story::ClipSteps:
      return {&Stages::clip};
    case Story::GjkSteps:
    case Story::EpaSteps:
      return {&Stages::gjk, &Stages::penetration};
  }
  return {};
}

}  // namespace

trace::Stages stages_shown(const std::vector<View>& views) {
  trace::Stages stages = trace::Stages::none();
  const auto add = [&](const auto& needs) {
    for (const Stage stage : needs) {
      if (stage != nullptr) stages.*stage = true;
    }
  };
  for (const View& view : views) {
    for (const Layer layer : view.layers) add(kLayers[static_cast<std::size_t>(layer)]->needs);
    for (const Panel panel : view.panels) add(needs_of(panel));
    add(needs_of(view.story));
    stages.reduction = stages.reduction || view.kind == ViewKind::ContactPlane;
  }
  return stages;
}

}  // namespace contactscope::draw
