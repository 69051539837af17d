#include "manifold/pair_query.h"

#include <gmock/gmock.h>

#include "geometry/primitives.h"
#include "manifold/placed_shapes.h"
#include "manifold/queried_pair.h"
#include "support/brute_force_distance.h"
#include "support/brute_force_sat.h"
#include "support/builders.h"
#include "support/cases.h"
#include "support/sphere_mesh.h"

/// Queries, checked by exhaustion in extended precision or by formula.
namespace contactscope {
namespace {

using test::PlacedShapes;
using test::Random;

constexpr Question kOverlap{.kind = QueryKind::Overlap};
constexpr Question kExclusive{.kind = QueryKind::Overlap, .comparison = QueryComparison::Exclusive};
constexpr Question kProper{.kind = QueryKind::Overlap, .comparison = QueryComparison::Proper};
constexpr Question kTouching{.kind = QueryKind::Touching};
constexpr Question kDistance{.kind = QueryKind::Distance};
constexpr Question kPenetration{.kind = QueryKind::Penetration};

template <class S>
Answer<S> answer_of(const PlacedShapes& pair, const Question& question,
                    trace::Pair* record = nullptr, QueryMemory* memory = nullptr) {
  const Shape<S> a = shape_cast<S>(pair.a), b = shape_cast<S>(pair.b);
  const Pose<S> pose_a = pair.pose_a.cast<S>(), pose_b = pair.pose_b.cast<S>();
  OwnBounds<S> bounds_a, bounds_b;
  return query_pair<S>({a, pose_a, bounds_a}, {b, pose_b, bounds_b}, question, false, record,
                       kUsualStages, memory);
}

trace::Pair record_of(const PlacedShapes& pair, const Question& question) {
  trace::Pair record;
  record.a = "a";
  record.b = "b";
  answer_of<double>(pair, question, &record);
  return record;
}

test::Features features_of(const Shape<double>& shape, const Pose<double>& pose) {
  if (std::holds_alternative<Sphere<double>>(shape))
    return test::features_of_point(Vec3d::Zero(), pose);
  if (const auto* capsule = std::get_if<Capsule<double>>(&shape))
    return test::features_of_segment(capsule->points[0], capsule->points[1], pose);
  return test::features_of(std::get<Hull<double>>(shape), pose);
}

double radius_of(const Shape<double>& shape) {
  if (const auto* sphere = std::get_if<Sphere<double>>(&shape)) return sphere->radius;
  const auto* capsule = std::get_if<Capsule<double>>(&shape);
  return capsule ? capsule->radius : 0;
}

struct Truth {
  double gap;     // metres; only an upper bound if the cores overlap
  bool deep;      // the cores overlap
  double extent;  // metres: rounding is relative to it
};

Truth truth_of(const PlacedShapes& pair) {
  const test::Features a = features_of(pair.a, pair.pose_a), b = features_of(pair.b, pair.pose_b);
  const double radii = radius_of(pair.a) + radius_of(pair.b);
  const auto distance = static_cast<double>(test::brute_force_distance(a, b).distance);
  return {distance - radii, distance == 0, test::extent(a, b) + radii};
}

Shape<double> random_convex(Random& random, double size) {
  switch (random.index(4)) {
    case 0:
      return test::ball(random.uniform(0.2, 1) * size);
    case 1: {
      const double half = random.uniform(0.1, 1) * size;
      return test::upright_capsule(half, random.uniform(0.1, 0.6) * size);
    }
    case 2:
      return test::random_box(random, size, 5);
    default:
      return test::random_hull(random, 4 + random.index(20), size, 4);
  }
}

/// Pairs that nearly touch, by some roundings of S or by fractions of their size, and pairs that
/// are separated or deep. The whole is moved by a random rigid motion. Sizes from 1e-4 to 1e4 m.
template <class S> PlacedShapes near_pair(Random& random) {
  const double size = random.decade(-4, 4);
  PlacedShapes pair{random_convex(random, size), {}, random_convex(random, size), {}};
  pair.pose_b = {random.rotation(), Vec3d::Zero()};
  const Vec3d displacement = random.unit_vector();
  double low = 0, high = 10 * size;  // where the overlap begins along the direction
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (low + high);
    pair.pose_b.position = middle * displacement;
    (truth_of(pair).gap > 0 ? high : low) = middle;
  }
  const double epsilon = std::numeric_limits<S>::epsilon();
  const double off[] = {0, epsilon * random.decade(0, 3), 1e-6, 1e-3, 0.1, 1};
  const double moved = off[random.index(6)] * (random.chance(0.5) ? size : -size);
  pair.pose_b.position = std::max(0.0, high + moved) * displacement;
  return test::rounded<S>(
      test::moved(pair, {random.rotation(), random.vector(-3 * size, 3 * size)}));
}

/// In metres.
struct Bounds {
  double given;     // a few roundings, in S, of the given coordinates
  double computed;  // rounding of a separation that is computed in double and reported in S
};

template <class S> Bounds bounds_of(const Truth& truth, const PlacedShapes& pair) {
  const double epsilon = std::numeric_limits<S>::epsilon();
  const double places = pair.pose_a.position.norm() + pair.pose_b.position.norm();
  const double computed = 64 * std::numeric_limits<double>::epsilon() * (2 * truth.extent + places);
  return {4 * epsilon * (2 * truth.extent + places) + computed,
          computed + epsilon * std::abs(truth.gap)};
}

template <class S> void judge_random_pairs(int count, std::uint64_t seed) {
  Random random(seed);
  int separated = 0, together = 0;
  for (int i = 0; i < count && !testing::Test::HasFailure(); ++i) {
    const PlacedShapes pair = near_pair<S>(random);
    const Truth truth = truth_of(pair);
    const auto [given, computed] = bounds_of<S>(truth, pair);
    SCOPED_TRACE("pair " + std::to_string(i) + ", gap " + std::to_string(truth.gap) + ", of " +
                 std::to_string(given));
    const Answer<S> inclusive = answer_of<S>(pair, kOverlap);
    const Answer<S> exclusive = answer_of<S>(pair, kExclusive);
    const Answer<S> distance = answer_of<S>(pair, kDistance);
    const Answer<S> penetration = answer_of<S>(pair, kPenetration);
    const Answer<S> touching = answer_of<S>(pair, kTouching);
    EXPECT_EQ(distance.overlap, inclusive.overlap);
    EXPECT_EQ(penetration.overlap, inclusive.overlap);
    EXPECT_EQ(touching.overlap, inclusive.overlap);
    EXPECT_EQ(*touching.touching, inclusive.overlap && !exclusive.overlap);
    if (truth.gap <= 0) {
      ++together;
      EXPECT_TRUE(inclusive.overlap);
    } else if (truth.gap > given) {
      ++separated;
      EXPECT_FALSE(inclusive.overlap);
    }
    if (truth.gap >= 0 && !truth.deep) {
      EXPECT_FALSE(exclusive.overlap);
    }
    if (truth.gap > computed) {
      EXPECT_NEAR(*distance.gap, truth.gap, computed);
    }
    const auto* hull_a = std::get_if<Hull<double>>(&pair.a);
    const auto* hull_b = std::get_if<Hull<double>>(&pair.b);
    ASSERT_TRUE(penetration.gap.has_value());
    double depth = -truth.gap;  // holds for overlapping cores only if both are hulls
    if (!truth.deep) {
      EXPECT_NEAR(*penetration.gap, truth.gap, computed);
    } else if (hull_a && hull_b) {
      depth = -test::brute_force_sat(*hull_a, pair.pose_a, *hull_b, pair.pose_b).separation;
      // The planes of a hull's faces are rounded too.
      EXPECT_NEAR(*penetration.gap, -depth, given);
      if (depth > given) {
        EXPECT_EQ(penetration.method, QueryMethod::Sat);
      }
    } else {
      EXPECT_LE(*penetration.gap, truth.gap + computed);
    }
    if (depth > given) {
      EXPECT_TRUE(exclusive.overlap);
    }
    // The manifold is computed entirely in S. For capsules and hulls that touch along a line,
    // errors of 4e-8 of the extent occur in double.
    const double rounding = 16 * given + 1e-7 * truth.extent;
    if (truth.gap > rounding || depth > rounding) {
      EXPECT_EQ(inclusive.overlap, !test::manifolds_of<S>(pair).empty());
    }
  }
  EXPECT_GT(separated, count / 4);
  EXPECT_GT(together, count / 4);
}

TEST(PairQuery, ConvexPairsAreJudgedRightInDouble) { judge_random_pairs<double>(600, 71); }
TEST(PairQuery, ConvexPairsAreJudgedRightInFloat) { judge_random_pairs<float>(600, 72); }
TEST(PairQuery, GjkFindsTheDistanceFromTheLastSimplexInFewerSteps) {
  Random random(77);
  int from_one_point = 0, from_the_last = 0, measured = 0;
  for (int i = 0; i < 60; ++i) {
    PlacedShapes pair = near_pair<double>(random);
    const double step = 1e-3 * truth_of(pair).extent;
    QueryMemory memory;
    for (int frame = 0; frame < 6; ++frame) {
      pair.pose_b.position += random.vector(-step, step);
      const Truth truth = truth_of(pair);
      trace::Pair fresh, again;
      answer_of<double>(pair, kDistance, &fresh);
      const Answer<double> answer = answer_of<double>(pair, kDistance, &again, &memory);
      const double computed = bounds_of<double>(truth, pair).computed;
      if (truth.gap > computed) {
        EXPECT_NEAR(*answer.gap, truth.gap, computed) << "pair " << i;
      }
      if (frame == 0 || !fresh.gjk) continue;
      ++measured;
      from_one_point += fresh.gjk->iterations;
      from_the_last += again.gjk->iterations;
    }
  }
  EXPECT_GT(measured, 100);
  EXPECT_LT(from_the_last, 0.8 * from_one_point);
}

TEST(PairQuery, SlowConvexPairs) {
  judge_random_pairs<double>(test::cases(3'000), 73);
  judge_random_pairs<float>(test::cases(3'000), 74);
}

/// Faces, edges and round surfaces that touch exactly, in dyadic numbers.
std::vector<PlacedShapes> kissing_pairs(double size) {
  const Shape<double> box = make_box(Vec3d(size, size, size));
  const Pose<double> here{};
  const auto above = [&](double y) -> Pose<double> { return test::at(0, y, 0); };
  return {
      {box, here, box, above(2 * size)},
      {box, here, box, test::at(2 * size, 2 * size, size)},
      {box, here, test::ball(size), above(2 * size)},
      {test::ball(size), here, test::ball(0.5 * size), above(1.5 * size)},
      {box, here, test::upright_capsule(size, 0.25 * size), above(2.25 * size)},
      {test::upright_capsule(size, size), here, test::lying_capsule(size, size), above(3 * size)},
      {HalfSpace<double>{{Vec3d::UnitY(), size}}, here, box, above(2 * size)}};
}

template <class S> void judge_kisses() {
  Random random(75);
  for (const double size : {1.0 / 8192, 0.25, 1.0, 8192.0}) {
    for (const PlacedShapes& still : kissing_pairs(size)) {
      for (int turn = 0; turn < 8; ++turn) {
        const Pose<double> motion{random.rotation(), random.vector(-4 * size, 4 * size)};
        const PlacedShapes pair = turn == 0 ? still : test::rounded<S>(test::moved(still, motion));
        SCOPED_TRACE("size " + std::to_string(size) + ", turn " + std::to_string(turn));
        EXPECT_TRUE(answer_of<S>(pair, kOverlap).overlap);
        EXPECT_FALSE(answer_of<S>(pair, kExclusive).overlap);
        EXPECT_TRUE(*answer_of<S>(pair, kTouching).touching);
        PlacedShapes separated = pair, deep = pair;
        const Vec3d displacement = (pair.pose_b.position - pair.pose_a.position).normalized();
        separated.pose_b.position += 0.125 * size * displacement;
        deep.pose_b.position -= 0.125 * size * displacement;
        EXPECT_FALSE(answer_of<S>(separated, kOverlap).overlap);
        EXPECT_FALSE(*answer_of<S>(separated, kTouching).touching);
        EXPECT_TRUE(answer_of<S>(deep, kExclusive).overlap);
        EXPECT_FALSE(*answer_of<S>(deep, kTouching).touching);
        Question wide = kTouching;
        wide.tolerance = 0.25 * size;
        EXPECT_TRUE(*answer_of<S>(separated, wide).touching);
        EXPECT_TRUE(*answer_of<S>(deep, wide).touching);
        Question within = kOverlap;
        within.tolerance = 0.25 * size;
        EXPECT_TRUE(answer_of<S>(separated, within).overlap);
      }
    }
  }
}

TEST(PairQuery, ShapesThatTouchTouchAtEveryScale) {
  judge_kisses<double>();
  judge_kisses<float>();
}

/// Changes one number after the other.
TEST(PairQuery, TheRoundingOfAPointIsThatOfEachNumberThatPlacesIt) {
  Random random(77);
  constexpr double kChange = 1e-7;
  for (int i = 0; i < 300; ++i) {
    const Vec3d normal = random.unit_vector(), point = random.vector(-3, 3);
    Pose<double> pose = random.pose(5);
    if (i % 3 == 0) pose.rotation = test::about(Vec3d::UnitY(), random.uniform(-3, 3));
    const auto along = [&](const Pose<double>& of, const Vec3d& in_frame) {
      return normal.dot(of.rotation.normalized() * in_frame + of.position);
    };
    double changed = 0;
    for (int k = 0; k < 10; ++k) {
      Pose<double> other = pose;
      Vec3d moved = point;
      double& number = k < 3   ? other.position[k]
                       : k < 6 ? moved[k - 3]
                               : other.rotation.coeffs()[k - 6];
      number *= 1 + kChange;
      changed += std::abs(along(other, moved) - along(pose, point)) / kChange;
    }
    EXPECT_NEAR(rounding_along(normal, pose, point, 1), changed, 1e-5);
  }
  // A corner of a level floor with any rotation about the vertical.
  const Pose<double> floor{test::about(Vec3d::UnitY(), 1), {0, -1, 0}};
  EXPECT_NEAR(rounding_along(Vec3d::UnitY(), floor, {500, 1, -500}, 1), 2, 1e-12);
}

TEST(PairQuery, APlaneIsMeasuredAlongItsNormal) {
  Random random(76);
  for (int i = 0; i < 300; ++i) {
    const double size = random.decade(-4, 4);
    const Shape<double> shape = random_convex(random, size);
    const Pose<double> pose{random.rotation(), random.vector(-2 * size, 2 * size)};
    const Pose<double> ground{random.rotation(), random.vector(-size, size)};
    const HalfSpace<double> plane{{random.unit_vector(), random.uniform(-size, size)}};
    const Vec3d normal = ground.rotate(plane.plane.normal);
    double lowest = 1e300;
    for (const test::ExtendedPoint& vertex : features_of(shape, pose).vertices)
      lowest = std::min(lowest, normal.dot(vertex.cast<double>() - ground.position));
    const double gap = lowest - plane.plane.offset - radius_of(shape);
    const PlacedShapes pair{plane, ground, shape, pose};
    const Answer<double> answer = answer_of<double>(pair, kDistance);
    EXPECT_NEAR(*answer.gap, gap, 1e-14 * 20 * size);
    EXPECT_EQ(answer.overlap, gap <= 0);
    EXPECT_EQ(answer.method, QueryMethod::Support);
    const trace::Query recorded = *record_of(pair, kPenetration).query;
    EXPECT_LT((*recorded.normal - normal).norm(), 1e-12) << "from the plane to the shape";
    EXPECT_NEAR((*recorded.point_b - *recorded.point_a).dot(*recorded.normal), gap,
                1e-13 * 20 * size);
  }
}

TEST(PairQuery, AMeshIsASurface) {
  const Mesh<double> cube = test::cube_mesh(1);
  const auto pair = [&](double x) -> PlacedShapes {
    return {test::ball(0.25), test::at(x, 0.1, 0.2), cube, {}};
  };
  EXPECT_FALSE(answer_of<double>(pair(0), kOverlap).overlap) << "wholly inside";
  EXPECT_TRUE(answer_of<double>(pair(0.9), kOverlap).overlap);
  EXPECT_FALSE(answer_of<double>(pair(1.5), kOverlap).overlap);
  EXPECT_TRUE(answer_of<double>(pair(1.25), kOverlap).overlap);
  EXPECT_FALSE(answer_of<double>(pair(1.25), kExclusive).overlap);
  EXPECT_TRUE(*answer_of<double>(pair(1.25), kTouching).touching);
  EXPECT_FALSE(*answer_of<double>(pair(1.1), kTouching).touching);
  EXPECT_NEAR(*answer_of<double>(pair(1.1), kPenetration).gap, -0.15, 1e-12);
  const trace::Pair record = record_of(pair(1.1), kOverlap);
  EXPECT_TRUE(record.manifolds.empty());
  EXPECT_EQ(record.query->method, "contacts");
}

PlacedShapes spheres(double radius_b, double x) {
  return {test::built(test::sphere_mesh(1, 12, 6, 0)),
          {},
          test::built(test::sphere_mesh(radius_b, 10, 5, 0)),
          test::at(x, 0.01, 0.02)};
}

TEST(PairQuery, TwoMeshesReportTheirCrossingTriangles) {
  const trace::Pair record = record_of(spheres(1, 1.2), kOverlap);
  EXPECT_EQ(record.overlap, true);
  EXPECT_EQ(record.state, "touching");
  EXPECT_GT(record.intersections.size(), 10u);
  EXPECT_FALSE(record.query->containment.has_value());
  EXPECT_GT(record.query->trees->node_pairs, 0);
  for (const trace::Intersection& crossing : record.intersections) {
    EXPECT_EQ(crossing.kind, "proper");
    ASSERT_TRUE(crossing.segment.has_value());
    // Inside both surfaces: the chord of a triangle is inside its sphere.
    for (const Vec3d& end : *crossing.segment) {
      EXPECT_LE(end.norm(), 1 + 1e-12);
      EXPECT_LE((end - Vec3d(1.2, 0.01, 0.02)).norm(), 1 + 1e-12);
      EXPECT_GT(end.norm(), 0.8);
    }
  }
}

TEST(PairQuery, AMeshInsideAnotherOverlapsIt) {
  const trace::Pair inside = record_of(spheres(0.4, 0.1), kOverlap);
  EXPECT_EQ(inside.overlap, true);
  EXPECT_TRUE(inside.intersections.empty());
  EXPECT_EQ(inside.query->containment->a, "outside");
  EXPECT_EQ(inside.query->containment->b, "inside");
  const trace::Pair separated = record_of(spheres(0.4, 3), kOverlap);
  EXPECT_EQ(separated.overlap, false);
  EXPECT_EQ(separated.query->containment->b, "outside");

  PlacedShapes holed = spheres(0.4, 0.1);
  auto& mesh = std::get<Mesh<double>>(holed.a);
  auto triangles = mesh.triangles;
  triangles.pop_back();
  mesh = build_mesh(mesh.vertices, triangles);
  const trace::Pair unknown = record_of(holed, kOverlap);
  EXPECT_EQ(unknown.overlap, false) << "a surface with a hole has no inside";
  EXPECT_EQ(unknown.query->containment->a, "open");
  EXPECT_EQ(unknown.query->containment->b, "unknown");
}

TEST(PairQuery, ExclusiveMeshesMeetWithTheirInteriors) {
  const Mesh<double> cube = test::cube_mesh(0.5);
  const auto at = [&](double x, double y, const Question& question) {
    return answer_of<double>({cube, {}, cube, test::at(x, y, 0)}, question).overlap;
  };
  EXPECT_TRUE(at(1, 0.25, kOverlap)) << "faces share an area";
  EXPECT_TRUE(at(1, 0.25, kExclusive));
  EXPECT_FALSE(at(1, 0.25, kProper)) << "only within one plane";
  EXPECT_TRUE(at(0.9, 0.25, kProper));
  EXPECT_TRUE(at(1, 1, kOverlap)) << "an edge of each";
  EXPECT_FALSE(at(1, 1, kExclusive));
  EXPECT_FALSE(at(1.001, 1, kOverlap));
}

}  // namespace
}  // namespace contactscope
