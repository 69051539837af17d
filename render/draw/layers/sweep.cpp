#include "draw/layers/layer.h"
#include "draw/scene/ghost.h"

/// How two shapes go through the step, and where they first meet: Catto 2013, "Continuous
/// Collision". Onion skins at the times up to which the search knew them apart; where they meet;
/// and where they are at the end of the step, as somebody who looks at frames alone would have it.
namespace contactscope::draw {
namespace {

constexpr double kLeastBetween = 0.03;  // of the step: of skins that are nearer one is drawn

constexpr LineStyle kSkin{1.2f, kDropped};
constexpr LineStyle kEnd{2.0f, kDropped, true};
constexpr LineStyle kMeeting{3.0f, kContact};

constexpr Swatch kSkinSwatch{LegendGroup::Motion, 5, [](auto& pen) { pen.area(kDropped, 0, 1.2); }};
constexpr Swatch kEndSwatch{LegendGroup::Motion, 6, [](auto& pen) { pen.dashes(2, kDropped); }};
constexpr Swatch kMeetingSwatch{LegendGroup::Motion, 7,
                                [](auto& pen) { pen.area(kContact, 0, 3); }};

constexpr Swatch kGhostSwatch{LegendGroup::Motion, 8, [](auto& pen) { pen.dot(4.2, 6.2, kAxis); }};

bool moves(const trace::Travel& travel) {
  return !travel.displacement.isZero(0) || !travel.turn.isZero(0);
}

void draw_sweep(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (!pair.impact) return;
  const trace::Impact& impact = *pair.impact;
  // A cast moves shapes as they stand; only the next frame shows what they have turned by.
  const auto draw_at = [&](double time, const LineStyle& style) {
    const double turned = impact.method == "swept" && time < 1 ? 0 : time;
    for (const auto& [name, travel] :
         {std::pair(pair.a, impact.travel_a), std::pair(pair.b, impact.travel_b)}) {
      const PlacedShape* shape = scene.find(name);
      if (shape == nullptr || shape->traced().half_space || !moves(travel)) continue;
      draw_ghost(scene.camera,
                 moved(*shape, travel.pivot, time * travel.displacement, turned * travel.turn),
                 style, sketch);
    }
  };
  double last = 0;
  for (const trace::ImpactStep& step : impact.steps) {
    if (impact.method == "speculative") break;  // nobody searches; the answer judges ghosts alone
    if (step.safe - last < kLeastBetween || step.safe >= 1) continue;
    if (impact.status == "hit" && impact.time - step.safe < kLeastBetween) continue;
    last = step.safe;
    draw_at(step.safe, kSkin);
    sketch.explain(kSkinSwatch, "a step of the search: apart for certain until then");
  }
  const bool moved_any = moves(impact.travel_a) || moves(impact.travel_b);
  if (moved_any) {
    draw_at(1, kEnd);
    sketch.explain(kEndSwatch, "at the next frame, if nothing stopped it");
  }
  for (const Vec3d& ghost : impact.ghosts) {
    sketch.mark(MarkKind::WideRing, ghost, kAxis);
    sketch.explain(kGhostSwatch, "ghost: holds back what would go past", ghost);
  }
  for (const std::vector<Vec3d>* corners : {&impact.corners_a, &impact.corners_b}) {
    for (std::size_t i = 0; i < corners->size(); ++i)
      sketch.line((*corners)[i], (*corners)[(i + 1) % corners->size()], kMeeting);
    if (!corners->empty()) sketch.explain(kMeetingSwatch, "the triangles where they first meet");
  }
  if (impact.status != "hit") return;
  if (moved_any) {
    draw_at(impact.time, kMeeting);
    sketch.explain(kMeetingSwatch, "where they first meet");
  }
  sketch.mark(MarkKind::Dot, impact.point_a, kContact);
}

}  // namespace

const LayerDrawing kSweepLayer{.result = draw_sweep};

}  // namespace contactscope::draw
