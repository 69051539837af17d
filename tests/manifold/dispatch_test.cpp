#include "manifold/dispatch.h"

#include <gtest/gtest.h>

#include <cstring>

#include "field/distance_field.h"
#include "geometry/primitives.h"
#include "manifold/placed_shapes.h"
#include "support/builders.h"
#include "trace/json.h"
#include "trace/pair.h"

namespace contactscope {
namespace {

using test::manifolds_of;
using test::PlacedShapes;

template <class T> bool same_bits(const T& one, const T& other) {
  return std::memcmp(&one, &other, sizeof(T)) == 0;
}

/// Compares bits, so that a zero and a negative zero differ.
template <class S>
testing::AssertionResult same(const Manifolds<S>& one, const Manifolds<S>& other) {
  if (one.size() != other.size()) return testing::AssertionFailure() << "count of manifolds";
  for (std::size_t m = 0; m < one.size(); ++m) {
    if (!same_bits(one[m].normal, other[m].normal)) return testing::AssertionFailure() << "normal";
    if (one[m].axis != other[m].axis) return testing::AssertionFailure() << "axis";
    if (one[m].type != other[m].type) return testing::AssertionFailure() << "type";
    if (one[m].triangle != other[m].triangle) return testing::AssertionFailure() << "triangle";
    if (one[m].points.size() != other[m].points.size())
      return testing::AssertionFailure() << "count of points";
    for (std::size_t i = 0; i < one[m].points.size(); ++i) {
      if (!same_bits(one[m].points[i].position, other[m].points[i].position) ||
          !same_bits(one[m].points[i].separation, other[m].points[i].separation) ||
          one[m].points[i].id != other[m].points[i].id)
        return testing::AssertionFailure() << "point " << i;
    }
  }
  return testing::AssertionSuccess();
}

Shape<double> random_shape(test::Random& random, ShapeKind kind, double size) {
  switch (kind) {
    case ShapeKind::Sphere:
      return test::ball(size * random.uniform(0.2, 1));
    case ShapeKind::Capsule:
      return test::upright_capsule(size * random.uniform(0, 1), size * random.uniform(0.2, 1));
    case ShapeKind::Hull:
      return random.chance(0.5) ? test::random_box(random, size, 5)
                                : test::random_hull(random, 12, size, 3);
    case ShapeKind::Mesh:
      return make_grid(3 * size, 2 * size, 3, 2, random.chance(0.3) ? 0 : 0.3 * size);
    case ShapeKind::Field: {
      static const Shape<double> box = make_box(Vec3d(1, 0.6, 0.3));
      static const Shape<double> field = field_shape(build_distance_field(box, {.cells = 8}), box);
      return scaled(field, size * random.uniform(0.2, 1));
    }
    case ShapeKind::Plane:
      break;
  }
  return HalfSpace<double>{{random.unit_vector(), size * random.uniform(-1, 1)}};
}

/// At all distances from separated to coincident; sometimes both frames coincide.
PlacedShapes random_pair(test::Random& random, ShapeKind a, ShapeKind b) {
  const double size = random.decade(-2, 2);
  PlacedShapes pair{
      random_shape(random, a, size), random.pose(size), random_shape(random, b, size), {}};
  pair.pose_b = random.chance(0.1) ? pair.pose_a : random.pose(2 * size);
  return pair;
}

constexpr ShapeKind kKinds[] = {ShapeKind::Sphere, ShapeKind::Capsule, ShapeKind::Hull,
                                ShapeKind::Plane,  ShapeKind::Mesh,    ShapeKind::Field};

template <class S> CollideOptions some_options(int number) {
  CollideOptions options;
  options.degenerate = number % 5 == 0 ? Degenerate::Skip : Degenerate::Fallback;
  options.margin = number % 3 == 0 ? S(0.05) : S(0);
  options.reducer = number % 2 == 0 ? find_reducer("area") : nullptr;
  return options;
}

PlacedShapes swapped(const PlacedShapes& pair) {
  return {pair.b, pair.pose_b, pair.a, pair.pose_a};
}

template <class S> class Dispatch : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Dispatch, Scalars);

TEST(Dispatch, EveryPairOfKindsCollidesInBothOrdersButPlanesAndMeshes) {
  const auto bounds_nothing = [](ShapeKind kind) {
    return kind == ShapeKind::Plane || kind == ShapeKind::Mesh;
  };
  for (const ShapeKind a : kKinds) {
    for (const ShapeKind b : kKinds) {
      const bool neither = bounds_nothing(a) && bounds_nothing(b);
      EXPECT_EQ(can_collide(a, b), !neither) << to_string(a) << "-" << to_string(b);
    }
  }
}

TEST(Dispatch, TwoPlanesMakeNoContact) {
  EXPECT_TRUE(manifolds_of<double>({test::ground(), {}, test::ground(), {}}, {}).empty());
  const trace::Pair record = test::record_of<double>({test::ground(), {}, test::ground(), {}});
  EXPECT_EQ(record.state, "separated");
  EXPECT_EQ(record.kind, "plane-plane");
}

TYPED_TEST(Dispatch, SlowSwappingShapesOfDifferentKindsMirrorsEveryBit) {
  using S = TypeParam;
  test::Random random(1);
  for (const ShapeKind a : kKinds) {
    for (const ShapeKind b : kKinds) {
      if (a == b || !can_collide(a, b)) continue;
      SCOPED_TRACE(std::string(to_string(a)) + "-" + to_string(b));
      int touching = 0;
      for (int i = 0; i < 1000; ++i) {
        const PlacedShapes pair = random_pair(random, a, b);
        const CollideOptions options = some_options<S>(i);
        const Manifolds<S> there = manifolds_of<S>(pair, options);
        Manifolds<S> back = manifolds_of<S>(swapped(pair), options);
        touching += there.empty() ? 0 : 1;
        for (Manifold<S>& manifold : back) mirror(manifold);
        ASSERT_TRUE(same(there, back)) << "pair " << i;
      }
      EXPECT_GT(touching, 200);
    }
  }
}

/// Coincident origins, with the same rotation or another one, and equal or different shapes.
PlacedShapes coincident_pair(test::Random& random, ShapeKind kind, int number) {
  PlacedShapes pair = random_pair(random, kind, kind);
  pair.pose_b.position = pair.pose_a.position;
  if (number % 3 == 0) pair.b = pair.a;
  pair.pose_b.rotation = number % 3 == 1 ? pair.pose_a.rotation : random.rotation();
  return pair;
}

TYPED_TEST(Dispatch, SwappingTwoRoundShapesMirrorsEveryBitAlsoAtEqualCentres) {
  using S = TypeParam;
  test::Random random(2);
  for (const ShapeKind kind : {ShapeKind::Sphere, ShapeKind::Capsule}) {
    int touching = 0;
    for (int i = 0; i < 2000; ++i) {
      const PlacedShapes pair =
          i % 2 == 0 ? random_pair(random, kind, kind) : coincident_pair(random, kind, i);
      const CollideOptions options = some_options<S>(i);
      const Manifolds<S> there = manifolds_of<S>(pair, options);
      Manifolds<S> back = manifolds_of<S>(swapped(pair), options);
      touching += there.empty() ? 0 : 1;
      for (Manifold<S>& manifold : back) mirror(manifold);
      ASSERT_TRUE(same(there, back)) << to_string(kind) << " pair " << i;
    }
    EXPECT_GT(touching, 500);
  }
}

// If one face is clearly the best, swapping the hulls changes only rounding.
TYPED_TEST(Dispatch, SlowSwappingTwoHullsMirrorsTheContactUnlessBothFacesTie) {
  using S = TypeParam;
  constexpr double kEpsilon = std::numeric_limits<S>::epsilon();
  test::Random random(5);
  int compared = 0;
  for (int i = 0; i < 3000; ++i) {
    const PlacedShapes pair =
        test::rounded<S>(random_pair(random, ShapeKind::Hull, ShapeKind::Hull));
    CollideOptions options;
    options.preference = Preference::None;
    const Manifold<S> there = test::manifold_of<S>(pair, options);
    const Manifold<S> back = test::manifold_of<S>(swapped(pair), options);
    const double size =
        std::get<Hull<double>>(pair.a).radius + std::get<Hull<double>>(pair.b).radius;
    const double rounding =
        256 * kEpsilon * (size + (pair.pose_a.position - pair.pose_b.position).norm());
    if (there.points.empty() || back.points.empty()) {
      for (const Manifold<S>& only : {there, back})
        ASSERT_TRUE(only.points.empty() || test::deepest_of(only) > -rounding) << i;
      continue;
    }
    ASSERT_NEAR(test::deepest_of(there), test::deepest_of(back), rounding) << i;
    if (there.axis != mirrored(back.axis) || there.axis == AxisKind::EdgeEdge) continue;
    if ((test::normal_of(there) + test::normal_of(back)).norm() > 64 * kEpsilon) continue;
    ++compared;
    // Corners within rounding of a side plane may be one point or two.
    for (const ContactPoint<S>& point : there.points) {
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < back.points.size(); ++k) {
        const Vec3d offset = point.position.template cast<double>() - test::position_of(back, k);
        nearest = std::min(nearest, offset.norm());
      }
      ASSERT_LT(nearest, 1e-3 * size) << i;
    }
  }
  EXPECT_GT(compared, 300);
}

TYPED_TEST(Dispatch, SlowRecordingChangesNoBitOfAnyPair) {
  using S = TypeParam;
  test::Random random(3);
  for (const ShapeKind a : kKinds) {
    for (const ShapeKind b : kKinds) {
      if (!can_collide(a, b)) continue;
      SCOPED_TRACE(std::string(to_string(a)) + "-" + to_string(b));
      for (int i = 0; i < 500; ++i) {
        const PlacedShapes pair = random_pair(random, a, b);
        const CollideOptions options = some_options<S>(i);
        Manifolds<S> watched;
        trace::Pair record;
        collide(shape_cast<S>(pair.a), pair.pose_a.template cast<S>(), shape_cast<S>(pair.b),
                pair.pose_b.template cast<S>(), options, watched, nullptr, &record,
                {i % 2 == 0, i % 3 == 0, i % 5 == 0});
        ASSERT_TRUE(same(watched, manifolds_of<S>(pair, options))) << "pair " << i;
        ASSERT_EQ(record.state, watched.empty() ? "separated" : "touching");
        ASSERT_EQ(record.manifolds.size(), watched.size());
      }
    }
  }
}

TYPED_TEST(Dispatch, SlowARecordIsInTheOrderOfTheArguments) {
  using S = TypeParam;
  test::Random random(4);
  for (const ShapeKind a : kKinds) {
    for (const ShapeKind b : kKinds) {
      if (!can_collide(a, b)) continue;
      for (int i = 0; i < 200; ++i) {
        const PlacedShapes pair = random_pair(random, a, b);
        const Manifold<S> manifold = test::manifold_of<S>(pair);
        const trace::Pair record = test::record_of<S>(pair);
        ASSERT_EQ(record.kind, std::string(to_string(a)) + "-" + to_string(b));
        if (manifold.points.empty()) continue;
        const trace::Manifold& recorded = record.manifolds.at(0);
        ASSERT_EQ(recorded.normal, test::normal_of(manifold));
        ASSERT_EQ(recorded.axis, to_string(manifold.axis));
        ASSERT_EQ(recorded.type, to_string(manifold.type));
        for (std::size_t k = 0; k < manifold.points.size(); ++k)
          ASSERT_EQ(recorded.points[k].id, to_string(manifold.points[k].id));
      }
    }
  }
}

TYPED_TEST(Dispatch, SlowSwappingTheArgumentsMirrorsTheWholeRecord) {
  using S = TypeParam;
  trace::Stages all;
  all.gauss_map = all.minkowski = true;
  const auto record_of = [&](const PlacedShapes& pair, const std::string& a, const std::string& b,
                             const CollideOptions& options) {
    trace::Pair record;
    record.a = a;
    record.b = b;
    Manifolds<S> manifolds;
    collide(shape_cast<S>(pair.a), pair.pose_a.template cast<S>(), shape_cast<S>(pair.b),
            pair.pose_b.template cast<S>(), options, manifolds, nullptr, &record, all);
    return record;
  };
  const auto line = [](const trace::Pair& record) {
    trace::Frame frame;
    frame.pairs.push_back(record);
    return trace::to_json_line(frame);
  };
  test::Random random(6);
  for (const ShapeKind a : kKinds) {
    for (const ShapeKind b : kKinds) {
      if (!can_collide(a, b)) continue;
      SCOPED_TRACE(std::string(to_string(a)) + "-" + to_string(b));
      for (int i = 0; i < 60; ++i) {
        const PlacedShapes pair = random_pair(random, a, b);
        CollideOptions options = some_options<S>(i);
        options.penetration = static_cast<PenetrationMethod>(i % 4);
        const std::string recorded = line(record_of(pair, "one", "other", options));
        options.b_first = true;  // two hulls have no order of their own
        trace::Pair mirrored = record_of(swapped(pair), "other", "one", options);
        ASSERT_NE(line(mirrored), recorded);
        trace::mirror(mirrored);
        ASSERT_EQ(line(mirrored), recorded) << "pair " << i;
      }
    }
  }
}

}  // namespace
}  // namespace contactscope
