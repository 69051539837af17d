#include <gmock/gmock.h>

#include "geometry/primitives.h"
#include "manifold/pair_query.h"
#include "manifold/placed_shapes.h"
#include "support/brute_force_boxes.h"
#include "support/brute_force_distance.h"
#include "support/builders.h"
#include "support/cases.h"
#include "support/sphere_mesh.h"
#include "trace/json.h"

namespace contactscope {
namespace {

using test::PlacedShapes;
using test::Random;

constexpr QueryMethod kBounds[] = {QueryMethod::Aabb, QueryMethod::Obb,
                                   QueryMethod::BoundingSphere};

template <class S> struct Queried {
  Answer<S> answer;
  trace::Pair record;
};

template <class S>
Queried<S> requested(const PlacedShapes& pair, const Question& question, bool b_first = false) {
  const Shape<S> a = shape_cast<S>(pair.a), b = shape_cast<S>(pair.b);
  const Pose<S> pose_a = pair.pose_a.cast<S>(), pose_b = pair.pose_b.cast<S>();
  OwnBounds<S> bounds_a, bounds_b;
  Queried<S> result;
  result.record.a = "a";
  result.record.b = "b";
  result.answer = query_pair<S>({a, pose_a, bounds_a}, {b, pose_b, bounds_b}, question, b_first,
                                &result.record);
  const Answer<S> unwatched =
      query_pair<S>({a, pose_a, bounds_a}, {b, pose_b, bounds_b}, question, b_first);
  EXPECT_EQ(result.answer.overlap, unwatched.overlap);
  EXPECT_EQ(result.answer.touching, unwatched.touching);
  EXPECT_EQ(result.answer.gap, unwatched.gap);
  EXPECT_EQ(result.answer.method, unwatched.method);
  return result;
}

PlacedShapes random_boxes(Random& random) {
  const double size = random.decade(-4, 4);
  PlacedShapes pair{test::random_box(random, size, 3), random.pose(size),
                    test::random_box(random, size, 3), random.pose(2.5 * size)};
  return pair;
}

TEST(QueryBounds, EveryBoundHoldsItsShapeAndNoneLosesAnOverlap) {
  Random random(81);
  int false_positives = 0;
  for (int i = 0; i < 500; ++i) {
    const PlacedShapes pair = random_boxes(random);
    const double extent = (pair.pose_b.position - pair.pose_a.position).norm() +
                          std::get<Hull<double>>(pair.a).radius;
    for (const QueryMethod bounds : kBounds) {
      const Queried<double> found =
          requested<double>(pair, {.kind = QueryKind::Overlap, .bounds = bounds});
      const trace::Query& query = *found.record.query;
      EXPECT_EQ(found.answer.method, bounds);
      for (const Vec3d& vertex : std::get<Hull<double>>(pair.a).vertices) {
        const Vec3d off = pair.pose_a.transform(vertex) - query.bounds_a->center;
        if (query.bounds_a->radius) {
          EXPECT_LE(off.norm(), *query.bounds_a->radius + 1e-13 * extent);
          continue;
        }
        const Quatd turn = query.bounds_a->rotation.value_or(Quatd::Identity());
        const Vec3d local = turn.conjugate() * off;
        EXPECT_LE((local.cwiseAbs() - *query.bounds_a->half_extents).maxCoeff(), 1e-13 * extent);
      }
      EXPECT_TRUE(found.answer.overlap || !query.shapes->overlap);
      false_positives += found.answer.overlap && !query.shapes->overlap;
      // Bounds overlap if and only if no axis separates them.
      bool separates = false;
      for (const trace::TestedAxis& axis : query.axes) {
        separates = separates || axis.separates;
        const double gap = std::max(axis.interval_b[0] - axis.interval_a[1],
                                    axis.interval_a[0] - axis.interval_b[1]);
        EXPECT_NEAR(axis.gap, gap, 1e-12 * extent);
      }
      EXPECT_EQ(found.answer.overlap, !separates);
      EXPECT_EQ(query.axes.size(), bounds == QueryMethod::Aabb  ? 3u
                                   : bounds == QueryMethod::Obb ? 15u
                                                                : 1u);
      // The oriented box of a box is the box itself.
      if (bounds == QueryMethod::Obb && std::abs(*found.answer.gap) > 1e-12 * extent) {
        EXPECT_EQ(found.answer.overlap, query.shapes->overlap);
      }
    }
  }
  EXPECT_GT(false_positives, 100);
}

TEST(QueryBounds, DistanceIsThatOfTheBounds) {
  Random random(82);
  int separated = 0;
  for (int i = 0; i < 300; ++i) {
    PlacedShapes pair = random_boxes(random);
    pair.pose_b.position *= 2;
    for (const QueryMethod bounds : kBounds) {
      const Queried<double> found =
          requested<double>(pair, {.kind = QueryKind::Distance, .bounds = bounds});
      const trace::Volume& a = *found.record.query->bounds_a;
      const trace::Volume& b = *found.record.query->bounds_b;
      const double offset = (b.center - a.center).norm();
      if (a.radius) {
        EXPECT_NEAR(*found.answer.gap, offset - *a.radius - *b.radius, 1e-13 * offset);
        continue;
      }
      if (!found.answer.overlap) ++separated;
      const auto features = [](const trace::Volume& box) {
        return test::features_of(make_box(*box.half_extents),
                                 {box.rotation.value_or(Quatd::Identity()), box.center});
      };
      const auto distance =
          static_cast<double>(test::brute_force_distance(features(a), features(b)).distance);
      EXPECT_NEAR(std::max(0.0, *found.answer.gap), distance, 1e-13 * offset);
    }
  }
  EXPECT_GT(separated, 200);
}

TEST(QueryBounds, TouchingBoundsTouch) {
  const Shape<double> box = make_box(Vec3d(0.5, 0.5, 0.5));
  const auto pair_at = [&](double x) -> PlacedShapes { return {box, {}, box, test::at(x, 0, 0)}; };
  for (const QueryMethod bounds : {QueryMethod::Aabb, QueryMethod::Obb}) {
    Question question{.kind = QueryKind::Touching, .bounds = bounds};
    EXPECT_EQ(requested<double>(pair_at(1), question).answer.touching, true);
    EXPECT_EQ(requested<double>(pair_at(1.125), question).answer.touching, false);
    EXPECT_EQ(requested<double>(pair_at(0.875), question).answer.touching, false);
    question.tolerance = 0.25;
    EXPECT_EQ(requested<double>(pair_at(1.125), question).answer.touching, true);
    EXPECT_EQ(requested<double>(pair_at(0.875), question).answer.touching, true);
    EXPECT_EQ(requested<double>(pair_at(0.5), question).answer.touching, false);
    question = {.kind = QueryKind::Overlap, .bounds = bounds};
    EXPECT_TRUE(requested<double>(pair_at(1), question).answer.overlap);
    question.comparison = QueryComparison::Exclusive;
    EXPECT_FALSE(requested<double>(pair_at(1), question).answer.overlap);
    EXPECT_TRUE(requested<double>(pair_at(0.875), question).answer.overlap);
  }
}

TEST(QueryBounds, SwappingTheShapesMirrorsTheRecord) {
  Random random(83);
  for (int i = 0; i < 60; ++i) {
    const PlacedShapes pair = random_boxes(random);
    const PlacedShapes swapped{pair.b, pair.pose_b, pair.a, pair.pose_a};
    for (const QueryKind kind : {QueryKind::Overlap, QueryKind::Distance}) {
      for (int b = -1; b < 3; ++b) {
        Question question{.kind = kind};
        if (b >= 0) question.bounds = kBounds[b];
        const trace::Pair one = requested<float>(pair, question).record;
        trace::Pair other = requested<float>(swapped, question, true).record;
        std::swap(other.a, other.b);  // names belong to sides, not to shapes
        trace::mirror(other);
        trace::Frame frame_one, frame_other;
        frame_one.pairs = {one};
        frame_other.pairs = {other};
        EXPECT_EQ(trace::to_json_line(frame_one), trace::to_json_line(frame_other));
      }
    }
  }
}

/// Two boxes with one axis direction in common, near and far, in overlap or separated. Each cross product of
/// the common axis with another is a normal of a face, up to rounding. Judged by brute force in 113
/// bits: the gap is a face's, unless edges separate by more than rounding.
template <class S> void judge_ties_of_axes(int cases, std::uint64_t seed) {
  Random random(seed);
  int faces = 0;
  for (int i = 0; i < cases; ++i) {
    const double size = random.decade(-4, 4);
    PlacedShapes pair{test::random_box(random, size, 3), random.pose(size),
                      test::random_box(random, size, 3), random.pose(0)};
    pair.pose_b.rotation =
        pair.pose_a.rotation *
        Quatd(Eigen::AngleAxisd(random.uniform(0, 6.3), Vec3d::Unit(random.index(3))));
    pair.pose_b.position =
        pair.pose_a.position + random.uniform(0.1, 4) * size * random.unit_vector();
    // Engines' fifteen axes skip short cross products, whose direction is noise.
    ObbTest<double> tested;
    if (random.chance(0.5)) tested = {.axes = ObbAxes::Fifteen, .skip_up_to = 1e-5};
    const Queried<S> found = requested<S>(
        pair, {.kind = QueryKind::Overlap, .bounds = QueryMethod::Obb, .test = tested});
    const auto box = [](const trace::Volume& volume) {
      return Obb<double>{volume.center, volume.rotation->toRotationMatrix(), *volume.half_extents};
    };
    const Obb<double> a = box(*found.record.query->bounds_a),
                      b = box(*found.record.query->bounds_b);
    const test::QuadBox of_a(a, a.center), of_b(b, a.center);
    double face = -std::numeric_limits<double>::infinity(), right = face;
    for (std::size_t k = 0; k < 3; ++k) {
      face = std::max({face, test::gap_along(of_a.axes[k], of_a, of_b),
                       test::gap_along(of_b.axes[k], of_a, of_b)});
      // Cross products of nearly parallel edges have any direction.
      for (const test::QuadVector& axis : of_b.axes)
        if (const auto across = test::cross(of_a.axes[k], axis); test::dot(across, across) > 1e-6)
          right = std::max(right, test::gap_along(across, of_a, of_b));
    }
    right = std::max(right, face);
    const double rounding =
        static_cast<double>(std::numeric_limits<S>::epsilon()) * test::size_of_pair(a, b);
    const trace::TestedAxis* widest = nullptr;
    for (const trace::TestedAxis& axis : found.record.query->axes)
      if (!axis.skipped && axis.gap == *found.answer.gap && !widest) widest = &axis;
    ASSERT_NE(widest, nullptr) << i;
    const Vec3d& d = widest->direction;
    // The direction of a short cross product turns by its rounding.
    ASSERT_NEAR(*found.answer.gap, test::gap_along({d.x(), d.y(), d.z()}, of_a, of_b),
                64 * rounding / widest->length)
        << i;
    ASSERT_GE(*found.answer.gap, right - 64 * rounding) << i;
    if (widest->is_of_edges()) {
      ASSERT_GT(*found.answer.gap, face) << i;
    } else {
      ++faces;
      ASSERT_NEAR(*found.answer.gap, face, 8 * rounding) << i;
    }
  }
  EXPECT_GT(faces, cases / 2);
}

TEST(QueryBounds, AFaceWinsATieWithEdgesInDouble) { judge_ties_of_axes<double>(1000, 351); }
TEST(QueryBounds, AFaceWinsATieWithEdgesInFloat) { judge_ties_of_axes<float>(1000, 352); }
TEST(QueryBounds, SlowTiesWithEdges) {
  judge_ties_of_axes<double>(test::cases(10'000), 353);
  judge_ties_of_axes<float>(test::cases(10'000), 354);
}

TEST(QueryBounds, MeshesHaveBoundsAsWell) {
  const Mesh<double> cube = test::cube_mesh(0.5);
  const PlacedShapes pair{cube, {}, cube, test::at(0.9, 0.9, 0)};
  for (const QueryMethod bounds : kBounds) {
    const Queried<double> found =
        requested<double>(pair, {.kind = QueryKind::Overlap, .bounds = bounds, .tolerance = 0.25});
    EXPECT_TRUE(found.answer.overlap);
    EXPECT_TRUE(found.record.query->shapes->overlap);
    EXPECT_TRUE(found.record.intersections.empty()) << "only the bounds were asked";
  }
}

TEST(QueryBounds, UnsupportedQueriesAreRefused) {
  using K = ShapeKind;
  Question question{.kind = QueryKind::Penetration, .bounds = QueryMethod::Aabb};
  EXPECT_THAT(*refusal(question, K::Hull, K::Hull), testing::HasSubstr("remove 'bounds'"));
  question.kind = QueryKind::Overlap;
  EXPECT_THAT(*refusal(question, K::Hull, K::Plane), testing::HasSubstr("no bounds"));
  EXPECT_FALSE(refusal(question, K::Mesh, K::Hull));
  EXPECT_THAT(*refusal({.kind = QueryKind::Overlap, .tolerance = 0.1}, K::Mesh, K::Mesh),
              testing::HasSubstr("exactly"));
  EXPECT_FALSE(refusal({.kind = QueryKind::Overlap}, K::Mesh, K::Mesh));
  EXPECT_THAT(*refusal({.kind = QueryKind::Distance}, K::Mesh, K::Mesh),
              testing::HasSubstr("query = \"overlap\""));
}

}  // namespace
}  // namespace contactscope
