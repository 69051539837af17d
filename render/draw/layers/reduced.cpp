#include <algorithm>

#include "draw/layers/layer.h"
#include "draw/scene/pairs.h"

namespace contactscope::draw {
namespace {

// With more crosses than this the polygon would be hidden.
constexpr std::size_t kCrowd = 24;

// Gregorius 2015, "Contact Point Reduction": for a pair with one manifold that was reduced.
void draw_reduced(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (pair.manifolds.size() != 1 || pair.manifolds.front().points.empty() || !pair.reduction)
    return;
  const std::vector<trace::Point>& points = pair.reduction->points;
  const std::vector<int>& kept = pair.reduction->kept;
  if (kept.size() >= points.size()) return;
  const std::vector<Vec3d> corners = kept_polygon(*pair.reduction, pair.manifolds.front().normal);
  const bool spans = corners.size() > 2;
  if (spans) sketch.face(corners, with_alpha(kContact, kKeptFill), {2.0f, kContact});
  const bool crowded = points.size() - kept.size() > kCrowd;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3d& at = points[i].position;
    const auto choice = std::ranges::find(kept, static_cast<int>(i));
    if (choice == kept.end()) {
      sketch.mark(crowded ? MarkKind::SmallCross : MarkKind::Cross, at, kDropped);
    } else {
      if (!scene.shows(Layer::Contacts)) sketch.mark(MarkKind::Dot, at, kContact);
      sketch.mark(MarkKind::Ring, at, kContact);
      sketch.label(at, std::to_string(choice - kept.begin() + 1), kContact, 17, 12).badge =
          Badge::Choice;
    }
  }
  sketch.explain(kReducedSwatch, "reduced away");
  if (!kept.empty())
    sketch.explain(spans ? kSpannedSwatch : kKeptSwatch,
                   spans ? kSpannedWords : "kept, in order of choice");
}

}  // namespace

const LayerDrawing kReducedLayer{.needs = {&Stages::reduction}, .result = draw_reduced};

}  // namespace contactscope::draw
