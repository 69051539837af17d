#pragma once

#include "manifold/recorder.h"
#include "scenario/scenario.h"

namespace contactscope {

/// A patch as a pair without shapes, labelled with its name: the manifold of the reduced points
/// and, if recorded, all points with the choices. Points are rounded to the reducer's scalar; their
/// ids are their numbers, from 1.
template <class S>
trace::Pair patch_facts(const ScenarioPatch& patch, const PipelineSettings& settings,
                        const trace::Stages& stages) {
  std::vector<ContactPoint<S>> points;
  for (const ContactPoint<double>& point : patch.points)
    points.push_back({point.position.cast<S>(), static_cast<S>(point.separation), FeatureId()});
  const Vec3<S> normal = patch.normal.cast<S>();
  const ReducerInfo* const reducer = find_reducer(settings.reducer);
  ReduceOptions options;
  options.max_points = settings.max_points;

  trace::Pair pair;
  pair.label = patch.name;
  pair.kind = "patch";
  pair.state = "touching";
  trace::Stages recorded = stages;
  recorded.reduction = stages.reduction && reducer != nullptr;
  const KeptIndices kept =
      Recorder<S>(ToWorld<S>(Pose<S>()), recorded, pair).reduce(reducer, points, normal, options);
  const auto record = [&](int index) -> trace::Point {
    const ContactPoint<S>& point = at(points, index);
    return {point.position.template cast<double>(), static_cast<double>(point.separation),
            std::to_string(index + 1)};
  };
  trace::Manifold& manifold = pair.manifolds.emplace_back();
  manifold.normal = normal.template cast<double>();
  for (const int index : kept) manifold.points.push_back(record(index));
  if (pair.reduction) {
    for (int i = 0; i < count_of(points); ++i) at(pair.reduction->points, i) = record(i);
  }
  pair.separation = manifold.points.front().separation;
  for (const trace::Point& point : manifold.points)
    pair.separation = std::min(pair.separation, point.separation);
  return pair;
}

}  // namespace contactscope
