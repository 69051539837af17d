#include "manifold/dispatch.h"
#include "study/limits_study.h"
#include "study/random_cases.h"
#include "study/study.h"

namespace contactscope {
namespace {

constexpr int kTilts[] = {1, 2, 5, 10, 20, 40};  // degrees
constexpr int kStackedBoxes = 200, kStackRepetitions = 15;

/// Times contacts of two cubes, one tilted on the other, which is turned about the vertical, 3 %
/// deep. `as_box`: the pair may take the path of boxes.
Measurement judge_boxes(const StudyOptions& options, int tilt, bool as_box) {
  std::mt19937_64 engine(options.seed);
  std::vector<StackedPair> pairs;
  std::vector<std::array<Shape<float>, 2>> shapes;
  for (int i = 0; i < options.cases.value_or(kStackedBoxes); ++i) {
    const Stacking stacking{.overlap = 0.03, .tilt = tilt * std::numbers::pi / 180};
    StackedPair& pair =
        pairs.emplace_back(stacked_pair({Stacked::Box, Stacked::Box}, stacking, i, engine));
    pair.pose_below.rotation = Eigen::AngleAxisd(uniform(engine, 0, 0.2), Vec3d::UnitY());
    const auto box = [&](const Shape<double>& shape) -> Shape<float> {
      Hull<float> hull = hull_cast<float>(std::get<Hull<double>>(shape));
      if (!as_box) hull.half_extents.setZero();  // only boxes have them
      return hull;
    };
    shapes.push_back({box(pair.below), box(pair.on_top)});
  }
  Measurement measured(1, count_of(pairs));
  CollideOptions collide_options;
  collide_options.reducer = find_reducer("area");
  Manifolds<float> manifolds;
  const auto points = [&](int i) -> double {
    const StackedPair& pair = at(pairs, i);
    collide<float>(at(shapes, i)[0], pair.pose_below.cast<float>(), at(shapes, i)[1],
                   pair.pose_on_top.cast<float>(), collide_options, manifolds);
    return manifolds.empty() ? 0 : double(manifolds[0].points.size());
  };
  for (int i = 0; i < count_of(pairs); ++i) measured.failed += points(i) < 1;
  measured.times.measure(options.repetitions.value_or(kStackRepetitions), count_of(pairs), points);
  measured.errors[0].add(measured.times.summary().min);
  return measured;
}

}  // namespace

/// Gregorius 2015, "Collision Shapes: Convex Hull": a box should be as fast as a general hull as by
/// a path of its own. The least time of a contact over the tilt of the upper box, by both paths.
/// Pairs without a point count as failed; there is none.
std::vector<trace::Study> study_box_path(const StudyOptions& options,
                                         const StudyProgress& progress) {
  std::vector<trace::Study> results = results_of(
      "box_path", "float", "tilt of the upper box, degrees", "",
      {{"time", "Two boxes by their own path and as any hulls", "least time of a contact", "ns"}},
      trace::StudyForm::Curves);
  const StudyStep step = counted(progress, 2);
  for (const bool as_box : {false, true}) {
    const std::string name = as_box ? "by the path of boxes" : "by the path of any hulls";
    add_line(results, {name, {}}, kTilts,
             [&](int tilt) { return judge_boxes(options, tilt, as_box); });
    step(name);
  }
  return results;
}

}  // namespace contactscope
