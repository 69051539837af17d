#include <algorithm>

#include "draw/layers/layer.h"
#include "draw/scene/swatches.h"

namespace contactscope::draw {
namespace {

// More crosses than this would hide the polygon on which they stand.
constexpr std::size_t kCrowd = 24;

/// The reduction of a pair's one manifold, where it took points away.
const trace::Reduction* reduction_of(const trace::Pair& pair) {
  if (pair.manifolds.size() != 1 || pair.manifolds.front().points.empty()) return nullptr;
  if (!pair.reduction || pair.reduction->kept.size() >= pair.reduction->points.size())
    return nullptr;
  return &*pair.reduction;
}

// Gregorius 2015, "Contact Point Reduction".
void draw_reduced(const Scene&, const trace::Pair& pair, Sketch& sketch) {
  const trace::Reduction* reduction = reduction_of(pair);
  if (reduction == nullptr) return;
  const std::vector<int>& kept = reduction->kept;
  const bool crowded = reduction->points.size() - kept.size() > kCrowd;
  for (std::size_t i = 0; i < reduction->points.size(); ++i) {
    const Vec3d& at = reduction->points[i].position;
    const auto choice = std::ranges::find(kept, static_cast<int>(i));
    if (choice == kept.end()) {
      sketch.mark(crowded ? MarkKind::SmallCross : MarkKind::Cross, at, kDropped);
    } else {
      sketch.mark(MarkKind::Ring, at, kContact);
      sketch.label(at, std::to_string(choice - kept.begin() + 1), kContact, 20, 14);
    }
  }
}

void explain_reduced(const Scene&, const trace::Pair& pair, Legend& legend) {
  const trace::Reduction* reduction = reduction_of(pair);
  if (reduction == nullptr) return;
  legend.explain(kReducedSwatch, "reduced away");
  if (!reduction->kept.empty()) legend.explain(kKeptSwatch, "kept, in order of choice");
}

}  // namespace

const LayerDrawing kReducedLayer{
    .needs = {&trace::Stages::reduction}, .result = draw_reduced, .explain = explain_reduced};

}  // namespace contactscope::draw
