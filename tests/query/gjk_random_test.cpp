#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "query/gjk.h"
#include "support/brute_force_distance.h"
#include "support/cases.h"
#include "support/random_geometry.h"

/// GJK compared with exhaustion, over sizes, proportions, separations and places in the world.
namespace contactscope {
namespace {

using test::BruteForceDistance;
using test::Features;
using test::Random;

/// A point, a segment or a hull.
template <class S> struct Shape {
  std::vector<Vec3<S>> points;  // one or two, if there is no hull
  std::optional<Hull<S>> hull;

  template <class T> Shape<T> cast() const {
    Shape<T> result;
    for (const Vec3<S>& point : points) result.points.push_back(point.template cast<T>());
    if (hull) result.hull = hull_cast<T>(*hull);
    return result;
  }
  SupportSet<S> set() const {
    if (hull) return support_set(*hull);
    return {points.data(), static_cast<int>(points.size()), nullptr};
  }
  const std::vector<Vec3<S>>& vertices() const { return hull ? hull->vertices : points; }
  Features features(const Pose<S>& pose) const {
    const Pose<double> exact = pose.template cast<double>();
    if (hull) return test::features_of(hull_cast<double>(*hull), exact);
    const Shape<double> same = this->template cast<double>();
    if (points.size() == 1) return test::features_of_point(same.points[0], exact);
    return test::features_of_segment(same.points[0], same.points[1], exact);
  }
};

template <class S> struct ShapePair {
  Shape<S> a, b;
  Pose<S> pose_a, pose_b;  // in the world

  Pose<S> b_in_a() const { return relative_pose(pose_a, pose_b); }
  GjkResult<S> distance() const { return gjk(a.set(), b.set(), b_in_a()); }
  /// The length that rounding is relative to, metres: reach of both, plus all offsets of the poses.
  double scale() const {
    return static_cast<double>(reach_of(a.set()) + reach_of(b.set()) + pose_a.position.norm() +
                               pose_b.position.norm());
  }
};

Shape<double> random_shape(Random& random, double size) {
  // A quarter are needles or plates, up to the flattest that the hull builder accepts.
  const double aspect = random.chance(0.25) ? random.decade(1, 5) : 1;
  switch (random.index(6)) {
    case 0: {
      const Vec3d offset = random.unit_vector();
      return {{size * random.uniform(0, 1) * offset}, {}};
    }
    case 1: {
      const Vec3d half = size * random.unit_vector();
      return {{-half, half}, {}};
    }
    case 2:
    case 3:
      return {{}, test::random_box(random, size, aspect)};
    case 4:
      return {{}, test::random_hull(random, 4 + random.index(12), size, std::min(aspect, 1e3))};
    default:
      return {{}, test::random_hull(random, 16 + random.index(24), size, std::min(aspect, 1e3))};
  }
}

Vec3d farthest(const Shape<double>& shape, const Vec3d& direction) {
  return *std::max_element(
      shape.vertices().begin(), shape.vertices().end(),
      [&](const Vec3d& p, const Vec3d& q) { return direction.dot(p) < direction.dot(q); });
}

/// B's farthest point is near A's, along a random direction or the normal of a face of A.
ShapePair<double> random_pair(Random& random, double largest_ratio, double farthest_out) {
  ShapePair<double> pair;
  const double size_a = random.decade(-4, 4);
  const double decades = std::log10(largest_ratio);
  const double size_b = std::clamp(size_a * random.decade(-decades, decades), 1e-4, 1e4);
  pair.a = random_shape(random, size_a);
  pair.b = random_shape(random, size_b);
  const double smaller = std::min(size_a, size_b);

  Pose<double> b_in_a;
  b_in_a.rotation = random.rotation();
  const double alignment = random.uniform(0, 1);
  if (alignment < 0.2) b_in_a.rotation = random.rotation_by(random.decade(-12, -1));
  if (alignment < 0.1) b_in_a.rotation = Quatd::Identity();

  Vec3d direction = random.unit_vector();
  if (pair.a.hull && random.chance(0.4)) {
    const int face = random.index(pair.a.hull->face_count());
    direction = pair.a.hull->planes[static_cast<std::size_t>(face)].normal;
  }
  const double kind = random.uniform(0, 1);
  double gap = -random.decade(-6, 0);          // overlap
  if (kind < 0.8) gap = 0;                     // touching
  if (kind < 0.7) gap = random.decade(-7, 0);  // near
  if (kind < 0.2) gap = random.decade(0, 3);   // far
  const Vec3d offset_aside = random.unit_vector();
  const Vec3d aside = random.decade(-6, 0) * smaller * offset_aside;
  b_in_a.position = farthest(pair.a, direction) -
                    b_in_a.rotate(farthest(pair.b, b_in_a.inverse_rotate(Vec3d(-direction)))) +
                    gap * smaller * direction + aside - direction.dot(aside) * direction;

  pair.pose_a = random.pose(farthest_out);
  pair.pose_b = compose(pair.pose_a, b_in_a);
  pair.pose_b.rotation.normalize();
  return pair;
}

template <class S> ShapePair<S> rounded(const ShapePair<double>& pair) {
  return {pair.a.cast<S>(), pair.b.cast<S>(), pair.pose_a.cast<S>(), pair.pose_b.cast<S>()};
}

/// Shapes closer than four ulps are Touching; the decision itself is off by one or two roundings.
/// The distance between both closest points, each with its own roundings, is off by twice as much.
constexpr double kFewUlps = 6;

struct Sweep {
  double worst_distance = 0;     // all in ulps of the pair's scale
  double worst_point = 0;        // distance of a closest point from its shape
  double worst_certificate = 0;  // distance minus the separation along the normal
  double worst_gap = 0;          // difference of the closest points' distance and `distance`
  int separated = 0, touching = 0, overlap = 0;
  int most_iterations = 0;
};

double off(const Shape<double>& shape, const Vec3d& point) {
  return static_cast<double>(
      brute_force_distance(shape.features({}), test::features_of_point(point, {})).distance);
}

/// Separation of the projections of both shapes on the normal.
template <class S> double gap_along(const ShapePair<S>& pair, const Vec3d& normal) {
  const Pose<double> b_in_a = pair.b_in_a().template cast<double>();
  double end_of_a = -std::numeric_limits<double>::infinity();
  double start_of_b = std::numeric_limits<double>::infinity();
  for (const Vec3<S>& vertex : pair.a.vertices()) {
    end_of_a = std::max(end_of_a, normal.dot(vertex.template cast<double>()));
  }
  for (const Vec3<S>& vertex : pair.b.vertices()) {
    const Vec3d placed = b_in_a.transform(vertex.template cast<double>());
    start_of_b = std::min(start_of_b, normal.dot(placed));
  }
  return start_of_b - end_of_a;
}

template <class S> void count(const ShapePair<S>& pair, double tolerance, Sweep& sweep) {
  const GjkResult<S> result = pair.distance();
  const BruteForceDistance exact =
      brute_force_distance(pair.a.features(pair.pose_a), pair.b.features(pair.pose_b));
  const double ulp = static_cast<double>(std::numeric_limits<S>::epsilon()) * pair.scale();
  const double exact_distance = static_cast<double>(exact.distance);
  const double distance = static_cast<double>(result.distance);
  const auto worst = [](double& kept, double value) { kept = std::max(kept, value); };

  worst(sweep.worst_distance, std::abs(distance - exact_distance) / ulp);
  if (exact_distance > tolerance * ulp) {
    EXPECT_EQ(result.status, GjkStatus::Separated) << to_string(result.status);
  }
  EXPECT_NE(result.status, GjkStatus::OutOfIterations);
  sweep.most_iterations = std::max(sweep.most_iterations, result.iterations);
  sweep.separated += result.status == GjkStatus::Separated ? 1 : 0;
  sweep.touching += result.status == GjkStatus::Touching ? 1 : 0;
  sweep.overlap += result.status == GjkStatus::Overlap ? 1 : 0;

  const Vec3d on_a = result.on_a.template cast<double>();
  const Vec3d on_b = result.on_b.template cast<double>();
  worst(sweep.worst_gap, std::abs((on_b - on_a).norm() - distance) / ulp);
  if (sweep.separated % 4 == 0) {
    const Vec3d in_b = pair.b_in_a().template cast<double>().inverse_transform(on_b);
    worst(sweep.worst_point, off(pair.a.template cast<double>(), on_a) / ulp);
    worst(sweep.worst_point, off(pair.b.template cast<double>(), in_b) / ulp);
  }
  if (result.status == GjkStatus::Separated) {
    const Vec3d normal = result.normal.template cast<double>().normalized();
    worst(sweep.worst_certificate, (distance - gap_along(pair, normal)) / ulp);
  }
}

void expect_all_kinds(const Sweep& sweep, int pairs) {
  EXPECT_GT(sweep.separated, pairs / 2);
  EXPECT_GT(sweep.touching, 0);
  EXPECT_GT(sweep.overlap, pairs / 20);
  EXPECT_LT(sweep.most_iterations, 40);
}

template <class S> class GjkRandom : public testing::Test {};

using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(GjkRandom, Scalars);

/// Ten thousand pairs.
TYPED_TEST(GjkRandom, SlowDistanceAgreesWithExhaustionFromTenthsOfMillimetresToTenKilometres) {
  using S = TypeParam;
  Random random(1988);
  Sweep sweep;
  constexpr int kPairs = 10000;
  for (int i = 0; i < kPairs; ++i) {
    SCOPED_TRACE(i);
    count(rounded<S>(random_pair(random, i % 2 == 0 ? 10 : 1e6, 0)), kFewUlps, sweep);
  }
  EXPECT_LE(sweep.worst_distance, kFewUlps);
  EXPECT_LE(sweep.worst_gap, 2 * kFewUlps);
  EXPECT_LE(sweep.worst_point, kFewUlps);
  EXPECT_LE(sweep.worst_certificate, kFewUlps);
  expect_all_kinds(sweep, kPairs);
}

TYPED_TEST(GjkRandom, SlowDistanceKeepsWhatThePosesHaveFarFromTheOrigin) {
  using S = TypeParam;
  Random random(1999);
  Sweep sweep;
  constexpr int kPairs = 3000;
  for (int i = 0; i < kPairs; ++i) {
    SCOPED_TRACE(i);
    count(rounded<S>(random_pair(random, 100, random.decade(0, 6))), kFewUlps, sweep);
  }
  EXPECT_LE(sweep.worst_distance, kFewUlps);
  EXPECT_LE(sweep.worst_gap, 2 * kFewUlps);
  EXPECT_LE(sweep.worst_point, kFewUlps);
  EXPECT_LE(sweep.worst_certificate, kFewUlps);
}

TYPED_TEST(GjkRandom, EarlierSimplexChangesTheResultByRoundingOnly) {
  using S = TypeParam;
  Random random(2010);
  int cold_iterations = 0, warm_iterations = 0;
  for (int i = 0; i < test::cases(2000); ++i) {
    const ShapePair<S> pair = rounded<S>(random_pair(random, 10, 0));
    const GjkResult<S> cold = pair.distance();
    // From before a small motion, or wrongly from a very different pose.
    ShapePair<S> earlier = pair;
    const double motion = i % 4 == 0 ? 1 : random.decade(-6, -2);
    const Vec3d offset = motion * pair.scale() * random.unit_vector();
    earlier.pose_b.position += offset.cast<S>();
    const GjkSimplex<S> simplex = earlier.distance().simplex;
    const GjkResult<S> warm = gjk(pair.a.set(), pair.b.set(), pair.b_in_a(), &simplex);
    const double ulp = static_cast<double>(std::numeric_limits<S>::epsilon()) * pair.scale();
    EXPECT_NEAR(static_cast<double>(warm.distance), static_cast<double>(cold.distance),
                kFewUlps * ulp)
        << "pair " << i;
    cold_iterations += cold.iterations;
    warm_iterations += warm.iterations;
  }
  EXPECT_LT(warm_iterations, cold_iterations);
}

TYPED_TEST(GjkRandom, WatchingChangesNoBitAndSeesEveryIteration) {
  using S = TypeParam;
  Random random(2015);
  for (int i = 0; i < 500; ++i) {
    const ShapePair<S> pair = rounded<S>(random_pair(random, 10, 0));
    const GjkResult<S> unwatched = pair.distance();
    GjkRun<S> run;
    const GjkResult<S> watched = gjk<S>(pair.a.set(), pair.b.set(), pair.b_in_a(), nullptr, &run);
    EXPECT_EQ(watched.status, unwatched.status);
    EXPECT_EQ(watched.distance, unwatched.distance);
    EXPECT_EQ(watched.normal, unwatched.normal);
    EXPECT_EQ(watched.on_a, unwatched.on_a);
    EXPECT_EQ(watched.on_b, unwatched.on_b);
    ASSERT_EQ(static_cast<int>(run.steps.size()), watched.iterations);
    const GjkSimplex<S>& last = run.steps.back();
    ASSERT_EQ(last.vertices.size(), watched.simplex.vertices.size());
    for (std::size_t k = 0; k < last.vertices.size(); ++k) {
      EXPECT_EQ(last.vertices[k].index_a, watched.simplex.vertices[k].index_a);
      EXPECT_EQ(last.vertices[k].index_b, watched.simplex.vertices[k].index_b);
      EXPECT_EQ(last.weights[k], watched.simplex.weights[k]);
    }
  }
}

}  // namespace
}  // namespace contactscope
