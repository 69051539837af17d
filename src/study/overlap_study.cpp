#include "geometry/primitives.h"
#include "query/overlap.h"
#include "query/penetration.h"
#include "study/exhaustive_boxes.h"
#include "study/random_cases.h"
#include "study/study.h"

namespace contactscope {
namespace {

constexpr int kElongations[] = {1, 3, 10};
constexpr int kBoundPairs = 20000;
constexpr int kBoundRepetitions = 15;

constexpr double kThresholds[] = {1e-18, 1e-16, 1e-15, 1e-14, 1e-12, 1e-10, 1e-8,
                                  1e-7,  1e-6,  1e-5,  1e-4,  1e-3,  1e-2,  1e-1};
constexpr int kThresholdPairs = 20000;
constexpr int kThresholdRepetitions = 3;

/// Two boxes with all bounds of each.
struct BoundedPair {
  struct Bounded {
    Obb<float> box;
    Aabb<float> aabb;
    BoundingSphere<float> sphere;

    Bounded(const Vec3d& center, const Quatd& rotation, const Vec3d& half_extents)
        : box{center.cast<float>(), rotation.toRotationMatrix().cast<float>(),
              half_extents.cast<float>()} {
      const Vec3f reach = box.axes.cwiseAbs() * box.half_extents;
      aabb = {box.center - reach, box.center + reach};
      sphere = {box.center, box.half_extents.norm()};
    }
  } a, b;
  bool overlap;  // by brute force

  BoundedPair(const Bounded& one, const Bounded& other)
      : a(one), b(other), overlap(box_separation(a.box, b.box) <= 0) {}
};

/// The longest side is 1 m, the others are that over `elongation`; random rotations, and positions
/// uniform over the region where any of their bounds could overlap.
std::vector<BoundedPair> bounded_pairs(std::mt19937_64& engine, double elongation, int count) {
  const Vec3d half = 0.5 * Vec3d(1, 1 / elongation, 1 / elongation);
  const double reach = 2 * half.norm();
  std::vector<BoundedPair> pairs;
  for (int i = 0; i < count; ++i) {
    Vec3d offset;
    for (int k = 0; k < 3; ++k) offset[k] = uniform(engine, -reach, reach);
    const BoundedPair::Bounded a(Vec3d::Zero(), uniform_rotation(engine), half);
    pairs.emplace_back(a, BoundedPair::Bounded(offset, uniform_rotation(engine), half));
  }
  return pairs;
}

struct BoundMethod {
  const char* name;
  bool (*overlap)(const BoundedPair& pair);
};

constexpr auto kInclusive = Comparison<float>::inclusive();
template <auto bound> bool bounds_overlap(const BoundedPair& pair) {
  return overlaps(pair.a.*bound, pair.b.*bound, kInclusive);
}
const BoundMethod kBoundMethods[] = {
    {"AABB", bounds_overlap<&BoundedPair::Bounded::aabb>},
    {"sphere", bounds_overlap<&BoundedPair::Bounded::sphere>},
    {"OBB, six axes",
     [](const BoundedPair& pair) {
       return overlaps(pair.a.box, pair.b.box, kInclusive, {ObbAxes::Faces, 0});
     }},
    {"OBB, fifteen axes", bounds_overlap<&BoundedPair::Bounded::box>},
};

std::vector<trace::Study> study_bounds(const StudyOptions& options, const StudyProgress& progress) {
  const StudyGrid grid(options, kBoundMethods, kElongations, kBoundPairs, kBoundRepetitions);
  std::vector<trace::Study> results =
      results_of("overlap", "float", "times as long as wide",
                 "all axes in long double, " + std::to_string(grid.cases) +
                     " pairs of boxes a point" + options.seeded(),
                 {{"false_positives", "How many pairs a bound lets through that do not overlap",
                   "share of the passing pairs that are apart", "", 0.5 / grid.cases}});
  std::mt19937_64 engine(options.seed);
  std::vector<std::vector<BoundedPair>> pairs(grid.parameters.size());
  measure_grid(
      grid, results, progress,
      [&](std::size_t p) { pairs[p] = bounded_pairs(engine, grid.parameters[p], grid.cases); },
      [&](std::size_t m, std::size_t p, Measurement& measured) {
        for (const BoundedPair& pair : pairs[p]) {
          const bool passes = kBoundMethods[m].overlap(pair);
          if (passes) measured.errors[0].add(pair.overlap ? 0 : 1);
          measured.failed += pair.overlap && !passes ? 1 : 0;
        }
      },
      [&](std::size_t m, std::size_t p, std::size_t i) {
        return kBoundMethods[m].overlap(pairs[p][i]) ? 1.0 : 0.0;
      });
  record::drop_worst(results[0]);  // a share has none
  return results;
}

/// Two boxes rounded to a scalar, and their gap.
template <class S> struct NearParallelPair {
  Obb<S> a, b;
  double gap;
};

/// Sides of 0.2 to 2 m. A third of the pairs are parallel; the others are rotated by 1e-17 to 0.1
/// rad about a random axis. In half of these, two edges' centres are 0.01 to 100 mm from each other
/// or deep along the edges' cross product; all other pairs have random offsets up to 2.2 m.
template <class S> NearParallelPair<S> near_parallel_pair(std::mt19937_64& engine, int index) {
  const auto half = [&]() -> Vec3d {
    return {uniform(engine, 0.1, 1), uniform(engine, 0.1, 1), uniform(engine, 0.1, 1)};
  };
  const Vec3d half_a = half(), half_b = half();
  const Quatd turn = uniform_rotation(engine);
  const Vec3d about = uniform_rotation(engine) * Vec3d::UnitX();
  const double angle = std::pow(10.0, uniform(engine, -17, -1));
  Quatd other = turn;
  if (index % 3 != 0) other = Quatd(Eigen::AngleAxisd(angle, about)) * turn;
  Vec3d offset = uniform(engine, 0, 2.2) * (uniform_rotation(engine) * Vec3d::UnitX());
  if (index % 3 == 1) {
    // The cross product of an edge and its rotated copy, up to length.
    const Vec3d edge = turn * Vec3d::Unit(index / 3 % 3);
    const Vec3d axis = edge.cross(about.cross(edge)).normalized();
    const double gap = std::pow(10.0, uniform(engine, -5, -1));
    offset = (uniform(engine, 0, 1) < 0.5 ? gap : -gap) * axis;
    for (int k = 0; k < 3; ++k) {
      if (k == index / 3 % 3) continue;
      const Vec3d side = turn * Vec3d::Unit(k);
      offset += std::copysign(half_a[k] + half_b[k], axis.dot(side)) * side;
    }
  }
  NearParallelPair<S> pair{{Vec3<S>::Zero(), turn.toRotationMatrix().cast<S>(), half_a.cast<S>()},
                           {offset.cast<S>(), other.toRotationMatrix().cast<S>(), half_b.cast<S>()},
                           0};
  pair.gap = box_separation(pair.a, pair.b);
  return pair;
}

// Metres: float rounding of gaps and overlaps. Logarithmic axes end there.
constexpr double kRoundingOfFloat = 3e-5;

/// One series of the threshold study: one kind of error, missed or phantom.
template <class S>
Measurement judge_threshold(const std::vector<NearParallelPair<S>>& pairs, const ObbTest<S>& test,
                            bool missed, int repetitions) {
  Measurement measured(2, count_of(pairs));
  const auto answer = [&](const NearParallelPair<S>& pair) {
    return overlaps(pair.a, pair.b, Comparison<S>::inclusive(), test);
  };
  for (const NearParallelPair<S>& pair : pairs) {
    const double off = missed ? -pair.gap : pair.gap;
    if (off <= 0) continue;  // this pair cannot have this error
    const bool wrong = answer(pair) != missed && off > kRoundingOfFloat;
    measured.errors[0].add(wrong ? off : kRoundingOfFloat);
    measured.errors[1].add(wrong ? 1 : 0);
  }
  measured.times.measure(repetitions, count_of(pairs),
                         [&](int i) { return answer(at(pairs, i)) ? 1.0 : 0.0; });
  return measured;
}

template <class S>
void add_threshold_lines(const StudyOptions& options, const std::string& scalar,
                         std::vector<trace::Study>& results, const StudyStep& step) {
  std::mt19937_64 engine(options.seed);
  std::vector<NearParallelPair<S>> pairs;
  for (int i = 0; i < options.cases.value_or(kThresholdPairs); ++i)
    pairs.push_back(near_parallel_pair<S>(engine, i));
  const int repetitions = options.repetitions.value_or(kThresholdRepetitions);
  for (const bool missed : {true, false}) {
    const std::string panel = missed ? "overlaps called apart" : "gaps called overlaps";
    const std::string parameter = panel + ", by the sine up to which axes are skipped";
    add_line(results, {scalar, {}, panel, parameter}, kThresholds, [&](double threshold) {
      return judge_threshold<S>(pairs, {ObbAxes::Fifteen, static_cast<S>(threshold)}, missed,
                                repetitions);
    });
    add_line(results, {scalar + ", guarded", {}, panel, parameter}, kThresholds,
             [&, measured = judge_threshold<S>(pairs, {}, missed, repetitions)](double) {
               return measured;
             });
    step(scalar + ", " + panel);
  }
}

std::vector<trace::Study> study_thresholds(const StudyOptions& options,
                                           const StudyProgress& progress) {
  const int cases = options.cases.value_or(kThresholdPairs);
  std::vector<trace::Study> results = results_of(
      "overlap", "float and double", "sine up to which axes are skipped",
      "all axes in long double, " + std::to_string(cases) +
          " pairs of nearly parallel boxes, sides of 0.2 to 2 m" + options.seeded(),
      {{"threshold", "Skip too few cross products and overlaps are missed, too many and gaps are",
        "overlap or gap that is missed (m)", "", kRoundingOfFloat},
       {"wrong", "How often skipping short cross products, or not, gives the wrong answer",
        "share of the pairs with a wrong answer", "", 0.5 / cases}},
      trace::StudyForm::Curves);
  const StudyStep step = counted(progress, 4);
  add_threshold_lines<float>(options, "float", results, step);
  add_threshold_lines<double>(options, "double", results, step);
  finish_share(results[1], results[1].resolution);
  // Group series by panel.
  for (trace::Study& study : results)
    std::ranges::stable_sort(study.series, std::ranges::greater(), &trace::StudySeries::panel);
  return results;
}

constexpr int kOverlapsInPercent[] = {1, 2, 5, 10, 20, 40, 80};
constexpr int kBoxPairs = 2000, kBoxRepetitions = 3;

struct DeepBoxes {
  Hull<double> a, b;
  Pose<double> b_in_a;
  double depth;  // metres, by brute force
};

/// Sides of 0.4 to 2 m, random rotations, on a random ray from the middle of A the place of B at
/// which they overlap by this share of the shortest side.
DeepBoxes deep_boxes(std::mt19937_64& engine, double share) {
  const auto half = [&]() -> Vec3d {
    return {uniform(engine, 0.2, 1), uniform(engine, 0.2, 1), uniform(engine, 0.2, 1)};
  };
  const Vec3d half_a = half(), half_b = half();
  const Quatd rotation = uniform_rotation(engine);
  const Vec3d ray = uniform_rotation(engine) * Vec3d::UnitX();
  const double depth = share * 2 * std::min(half_a.minCoeff(), half_b.minCoeff());
  const auto separation = [&](double distance) {
    return box_separation(Obb<double>{Vec3d::Zero(), Mat3<double>::Identity(), half_a},
                          Obb<double>{distance * ray, rotation.toRotationMatrix(), half_b});
  };
  double near = 0, far = half_a.norm() + half_b.norm();  // it grows along the ray
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (near + far);
    (separation(middle) < -depth ? near : far) = middle;
  }
  return {make_box(half_a), make_box(half_b), {rotation, far * ray}, -separation(far)};
}

struct BoxMethod {
  const char* name;
  double (*depth)(const DeepBoxes& boxes);  // metres; 0: no contact
};
const BoxMethod kBoxMethods[] = {
    {"all corners and edges",
     [](const DeepBoxes& boxes) {
       const auto found =
           exhaustive_contact(boxes.a.half_extents, boxes.b.half_extents, boxes.b_in_a);
       return found ? found->depth : 0;
     }},
    {"separating axis test",
     [](const DeepBoxes& boxes) {
       return penetration(PenetrationMethod::Sat, support_set(boxes.a), support_set(boxes.b),
                          boxes.b_in_a, PenetrationOptions<double>{})
           .depth;
     }},
};

std::vector<trace::Study> study_boxes(const StudyOptions& options, const StudyProgress& progress) {
  const StudyGrid grid(options, kBoxMethods, kOverlapsInPercent, kBoxPairs, kBoxRepetitions);
  std::vector<trace::Study> results =
      results_of("overlap", "double", "overlap, % of the shortest side",
                 "all axes in long double, " + std::to_string(grid.cases) +
                     " pairs of boxes a point" + options.seeded(),
                 {{"boxes", "How often two ways to find the contact of two boxes are wrong",
                   "share of the pairs with a depth off by 5 % or more", "", 0.5 / grid.cases}});
  std::mt19937_64 engine(options.seed);
  std::vector<std::vector<DeepBoxes>> pairs(grid.parameters.size());
  measure_grid(
      grid, results, progress,
      [&](std::size_t p) {
        for (int i = 0; i < grid.cases; ++i)
          pairs[p].push_back(deep_boxes(engine, 0.01 * grid.parameters[p]));
      },
      [&](std::size_t m, std::size_t p, Measurement& measured) {
        for (const DeepBoxes& boxes : pairs[p]) {
          const double depth = kBoxMethods[m].depth(boxes);
          measured.errors[0].add(std::abs(depth - boxes.depth) >= 0.05 * boxes.depth ? 1 : 0);
          measured.failed += depth > 0 ? 0 : 1;
        }
      },
      [&](std::size_t m, std::size_t p, std::size_t i) {
        return kBoxMethods[m].depth(pairs[p][i]);
      });
  record::drop_worst(results[0]);  // a share has none
  return results;
}

}  // namespace

/// Overlap tests of bounding volumes and boxes, in four results.
///
/// "false_positives": for random boxes of 1:1:1, 3:1:1 and 10:1:1 near each other, the share of
/// passing pairs that are separated, against the time of a test: AABBs, spheres, oriented boxes by
/// six face normals and by all axes. No overlapping pair fails to pass.
///
/// "threshold": for nearly parallel oriented boxes, the deepest overlap, metres, reported as
/// separated and the widest gap reported as overlap, over the sine up to which cross products of
/// edges are skipped; 1e-18 skips none. Also the test with a rounding bound, which needs no
/// threshold. Errors below 0.03 mm, float's rounding, count as that. "wrong": the share of
/// overlapping, or separated, pairs with that error, at least half a pair.
///
/// "boxes": two overlapping boxes by the lecture's search of all corners and edges
/// (exhaustive_boxes.h) and by the separating axis test: the share whose depth is off by 5% of the
/// least overlap, or that have no contact, which also count as failed; over the overlap.
std::vector<trace::Study> study_overlap(const StudyOptions& options,
                                        const StudyProgress& progress) {
  std::vector<trace::Study> results = study_bounds(options, progress);
  std::ranges::move(study_thresholds(options, progress), std::back_inserter(results));
  std::ranges::move(study_boxes(options, progress), std::back_inserter(results));
  return results;
}

}  // namespace contactscope
