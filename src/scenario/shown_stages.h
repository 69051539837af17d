#pragma once

#include <algorithm>
#include <vector>

#include "trace/trace.h"
#include "view/view.h"

namespace contactscope {

inline bool shown(const std::vector<View>& views, auto what) {
  return std::ranges::any_of(views, [&](const View& view) { return view.shows(what); });
}

/// Adds stages that are too large to record unless a view shows them.
inline trace::Stages with_insets(trace::Stages stages, const std::vector<View>& views) {
  stages.gauss_map = stages.gauss_map || shown(views, Panel::GaussMap);
  stages.minkowski = stages.minkowski || shown(views, Panel::Minkowski);
  stages.cells = stages.cells || shown(views, Layer::Cells) || shown(views, Panel::Endpoints);
  stages.node_pairs = stages.node_pairs || shown(views, Panel::NodePairs);
  stages.fields = stages.fields || shown(views, Layer::Field);
  stages.decisions = stages.decisions || shown(views, Layer::FlipDistance);
  stages.flip = stages.flip || shown(views, Layer::FlipDistance);
  return stages;
}

}  // namespace contactscope
