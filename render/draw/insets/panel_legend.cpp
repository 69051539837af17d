#include "draw/insets/panel_legend.h"

#include <algorithm>

#include "draw/scene/scene.h"

namespace contactscope::draw {

const trace::Pair* pair_of_contact_plane(const trace::Frame& frame) {
  for (const trace::Pair& pair : frame.pairs) {
    if (!pair.manifolds.empty()) return &pair;
  }
  return nullptr;
}

bool reduction_in_contact_plane(const trace::Pair& pair) {
  return pair.manifolds.size() == 1 && pair.reduction &&
         (pair.reduction->points.size() > 2 || pair.kind == "hull-hull");
}

void explain_panels(const Staging& staging, const trace::Frame& frame, Sketch& sketch) {
  const View& view = staging.view;
  const trace::Pair* pair = pair_of_contact_plane(frame);
  if (!view.shows(Panel::ContactPlane) || pair == nullptr) return;
  if (pair->clip && pair->manifolds.size() == 1) {
    sketch.explain(LegendKind::ReferenceFace, "reference face");
    sketch.explain(LegendKind::IncidentFace, "incident face");
    if (!pair->clip->steps.empty() && !pair->clip->steps.back().polygon.empty()) {
      sketch.explain(LegendKind::ClipPolygon, "clip polygon");
    }
    for (const trace::DroppedPoint& dropped : pair->clip->dropped) {
      if (!is_kept(*pair, dropped)) sketch.explain(LegendKind::Dropped, dropped.reason);
    }
  }
  if (!view.shows(Layer::Contacts)) sketch.explain(LegendKind::PlainPoint, "contact point");
  if (reduction_in_contact_plane(*pair) &&
      pair->reduction->kept.size() < pair->reduction->points.size()) {
    sketch.explain(LegendKind::Reduced, "reduced away");
    sketch.explain(LegendKind::Kept, "kept, in order of choice");
  }
}

}  // namespace contactscope::draw
