#include "geometry/primitives.h"
#include "manifold/dispatch.h"
#include "study/random_cases.h"
#include "study/study.h"

namespace contactscope {
namespace {

constexpr int kPrismSides[] = {4, 6, 8, 12, 16};
constexpr int kPrismPairs = 200, kPrismRepetitions = 15;

struct PrismPair {
  Shape<float> a, b;
  Pose<float> b_in_a;
};

/// A prism stands on another one, 1 to 10 mm deep, turned about the vertical and up to 0.2 m aside.
/// `as_box`: the pair may take the path of boxes.
std::vector<PrismPair> stacked_prisms(const StudyOptions& options, int sides, bool as_box) {
  std::mt19937_64 engine(options.seed);
  std::vector<PrismPair> pairs;
  for (int i = 0; i < options.cases.value_or(kPrismPairs); ++i) {
    const auto prism = [&](double height) -> Shape<float> {
      const double width = uniform(engine, 0.4, 0.6);
      Hull<float> hull = hull_cast<float>(sides == 4 ? make_box({width, height, width})
                                                     : make_cylinder(width, height, sides));
      if (!as_box) hull.half_extents.setZero();  // only boxes have them
      return hull;
    };
    const double below = uniform(engine, 0.3, 0.5), above = uniform(engine, 0.3, 0.5);
    const Vec3d place(uniform(engine, -0.2, 0.2), below + above - uniform(engine, 1e-3, 1e-2),
                      uniform(engine, -0.2, 0.2));
    const Quatd turn(Eigen::AngleAxisd(uniform(engine, 0, 1.5), Vec3d::UnitY()));
    pairs.push_back({prism(below), prism(above), Pose<double>{turn, place}.cast<float>()});
  }
  return pairs;
}

Measurement judge_prisms(const StudyOptions& options, int sides, bool as_box) {
  const std::vector<PrismPair> pairs = stacked_prisms(options, sides, as_box);
  Measurement measured(1, count_of(pairs));
  CollideOptions collide_options;
  collide_options.reducer = find_reducer("area");
  Manifolds<float> manifolds;
  const auto points = [&](int i) -> double {
    const PrismPair& pair = at(pairs, i);
    collide<float>(pair.a, {}, pair.b, pair.b_in_a, collide_options, manifolds);
    return manifolds.empty() ? 0 : double(manifolds[0].points.size());
  };
  for (int i = 0; i < count_of(pairs); ++i) measured.failed += points(i) < 3;
  measured.times.measure(options.repetitions.value_or(kPrismRepetitions), count_of(pairs), points);
  measured.errors[0].add(measured.times.summary().min);
  return measured;
}

}  // namespace

/// Gregorius 2015, "Collision Shapes: Convex Hull": a box should be as fast as a general hull as by a
/// path of its own. The least time of a contact of two prisms, face on face, over their vertices, by
/// the path for any hulls; and of two boxes by their own path. Pairs with fewer than three points
/// count as failed; there is none.
std::vector<trace::Study> study_box_path(const StudyOptions& options,
                                         const StudyProgress& progress) {
  std::vector<trace::Study> results = results_of(
      "box_path", "float", "vertices of each hull", "",
      {{"time", "Two boxes by their own path and as any hulls", "least time of a contact", "ns"}},
      trace::StudyForm::Curves);
  const StudyStep step = counted(progress, 2);
  for (const bool as_box : {false, true}) {
    const std::string name = as_box ? "boxes by their own path" : "any hulls";
    trace::StudySeries& line = results[0].series.emplace_back(trace::StudySeries{name, {}});
    for (const int sides : kPrismSides)
      if (!as_box || sides == 4)
        line.points.push_back(judge_prisms(options, sides, as_box).point(2 * sides, 0));
    step(name);
  }
  return results;
}

}  // namespace contactscope
