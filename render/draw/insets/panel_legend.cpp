#include "draw/insets/panel_legend.h"

#include <algorithm>
#include <cmath>

#include "draw/scene/pair_points.h"
#include "draw/scene/support.h"
#include "draw/scene/swatches.h"

namespace contactscope::draw {
namespace {

constexpr double kShortMargin = 0.06;  // of the support: too short to be drawn

constexpr Swatch kMarginSwatch{LegendGroup::Masses, 2, [](const SwatchPen& pen) {
                                 pen.level_line(0, 16, 2.2, kAxis);
                                 pen.head(22, 8, kAxis);
                               }};

void explain_stability(const trace::Pair& pair, Legend& legend) {
  if (!pair.stability || pair.manifolds.empty()) return;
  const trace::Stability& stability = *pair.stability;
  if (stability.verdict == "no contact") return;
  explain_support(stability, stability.axis && stability.verdict != "stable", legend);
  double reach = 0;
  for (const Vec3d& corner : stability.support)
    reach = std::max(reach, (corner - stability.projection).norm());
  if (std::abs(stability.margin) > kShortMargin * reach)
    legend.explain(kMarginSwatch, "margin: to the border of the support");
}

void explain_contact_plane(const View& view, const trace::Pair& pair, Legend& legend) {
  if (pair.clip && pair.manifolds.size() == 1) {
    legend.explain(kReferenceFaceSwatch, "reference face");
    legend.explain(kIncidentFaceSwatch, "incident face");
    if (!pair.clip->steps.empty() && !pair.clip->steps.back().polygon.empty())
      legend.explain(kClipPolygonSwatch, "clip polygon");
    for (const trace::DroppedPoint& dropped : pair.clip->dropped) {
      if (!is_kept(pair, dropped)) legend.explain(kDroppedSwatch, dropped.reason);
    }
  }
  if (!view.shows(Layer::Contacts)) legend.explain(kPlainPointSwatch, "contact point");
  if (reduction_in_contact_plane(pair) &&
      pair.reduction->kept.size() < pair.reduction->points.size()) {
    legend.explain(kReducedSwatch, "reduced away");
    legend.explain(kKeptSwatch, "kept, in order of choice");
  }
}

}  // namespace

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

void explain_panels(const View& view, const trace::Frame& frame, Legend& legend) {
  if (view.shows(Panel::Stability)) {
    for (const trace::Pair& pair : frame.pairs) explain_stability(pair, legend);
  }
  const trace::Pair* pair = pair_of_contact_plane(frame);
  if (view.shows(Panel::ContactPlane) && pair != nullptr)
    explain_contact_plane(view, *pair, legend);
}

}  // namespace contactscope::draw
