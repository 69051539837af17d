#include "scenario/run.h"

namespace contactscope {

PairChooser::PairChooser(const Scenario& scenario)
    : scenario_(scenario),
      phase_(make_broad_phase(scenario.broad_phase)),
      any_dynamic_(std::ranges::any_of(scenario.shapes, &ScenarioShape::dynamic)) {
  for (int a = 0; a < kShapeKinds; ++a)
    for (int b = 0; b < kShapeKinds; ++b)
      at(at(answered_, a), b) = !refusal(scenario.pipeline.question, static_cast<ShapeKind>(a),
                                         static_cast<ShapeKind>(b));
}

double PairChooser::reach() const {
  const PipelineSettings& settings = scenario_.pipeline;
  if (!settings.makes_contacts()) return settings.question.tolerance;
  const double margin = std::max(settings.margin, scenario_.solver.speculative_margin.value_or(0));
  return settings.manifold == ManifoldKind::Incremental
             ? margin + settings.incremental.breaking_distance
             : margin;
}

std::vector<BoxPair> PairChooser::choose(const std::vector<Aabb<float>>& boxes,
                                         trace::Frame* record, bool cells) {
  const Vec3<float> far = Vec3<float>::Constant(std::numeric_limits<float>::infinity());
  const BroadPhaseCounts before = phase_->counts();
  for (int i = 0; i < count_of(boxes); ++i) {
    const Aabb<float> box = at(boxes, i).empty() ? Aabb<float>{-far, far} : at(boxes, i);
    if (i < phase_->handles())
      phase_->move(i, box);
    else
      phase_->add(box);
  }
  BroadPhaseRecord structure;
  std::vector<BoxPair> chosen = phase_->pairs(record && cells ? &structure : nullptr);
  std::erase_if(chosen, [&](const BoxPair& pair) {
    const ScenarioShape &a = scenario_.shape(pair.a), &b = scenario_.shape(pair.b);
    return (any_dynamic_ && !a.dynamic() && !b.dynamic()) ||
           !at(at(answered_, static_cast<int>(kind_of(*a.geometry))),
               static_cast<int>(kind_of(*b.geometry)));
  });
  if (record == nullptr) return chosen;

  const auto since = [&](std::int64_t BroadPhaseCounts::*count) {
    return static_cast<int>(phase_->counts().*count - before.*count);
  };
  trace::BroadPhase& facts = record->broad_phase.emplace();
  facts.method = scenario_.broad_phase;
  facts.pairs = count_of(chosen);
  facts.comparisons = since(&BroadPhaseCounts::comparisons);
  facts.visits = since(&BroadPhaseCounts::visits);
  facts.swaps = since(&BroadPhaseCounts::swaps);
  for (int i = 0; i < phase_->handles(); ++i) {
    if (!is_bounded(phase_->box(i))) continue;
    const Aabb<double> box = phase_->box(i).cast<double>();
    facts.bounds.push_back({scenario_.shape(i).name,
                            {box.lower, box.upper},
                            std::ranges::binary_search(structure.large, i)});
  }
  report(structure, facts);
  return chosen;
}

void PairChooser::report(const BroadPhaseRecord& structure, trace::BroadPhase& facts) const {
  Aabb<double> world;
  for (const trace::Bounds& bounds : facts.bounds) {
    world.include(bounds.box.lower);
    world.include(bounds.box.upper);
  }
  for (const BroadPhaseCell& cell : structure.cells) {
    Aabb<double> box = cell.box.cast<double>();
    // Columns are infinite.
    if (!is_bounded(cell.box))
      box = {box.lower.cwiseMax(world.lower), box.upper.cwiseMin(world.upper)};
    facts.cells.push_back({{box.lower, box.upper}, cell.depth, cell.members, cell.tests});
  }
  constexpr const char* kAxes[] = {"x", "y", "z"};
  if (structure.swept >= 0) facts.swept = kAxes[structure.swept];
  const auto name = [&](int handle) { return scenario_.shape(handle).name; };
  for (const EndSwap& swap : structure.swaps)
    facts.end_swaps.push_back({kAxes[swap.axis], static_cast<double>(swap.place), name(swap.lower),
                               name(swap.upper), swap.meets, swap.counts});
}

}  // namespace contactscope
