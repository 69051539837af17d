#include "query/closest_points.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/brute_force_distance.h"
#include "support/random_geometry.h"

namespace contactscope {
namespace {

using test::Random;

template <class S> struct Segments {
  Vec3<S> from_a, to_a, from_b, to_b;

  Segments swapped() const { return {from_b, to_b, from_a, to_a}; }
  ClosestOfSegments<S> closest() const { return closest_of_segments(from_a, to_a, from_b, to_b); }
  /// Approximately the largest difference of coordinates.
  double scale() const {
    return static_cast<double>((to_a - from_a).norm() + (to_b - from_b).norm() +
                               (from_b - from_a).norm());
  }
  double searched_distance() const {
    const auto extended = [](const Vec3<S>& p) {
      return test::ExtendedPoint(p.template cast<test::Extended>());
    };
    return static_cast<double>(test::segment_distance_by_search(extended(from_a), extended(to_a),
                                                                extended(from_b), extended(to_b)));
  }
};

template <class S>
Segments<S> moved(const Segments<double>& segments, double size, const Pose<double>& pose) {
  const auto place = [&](const Vec3d& p) { return Vec3<S>((size * pose.transform(p)).cast<S>()); };
  return {place(segments.from_a), place(segments.to_a), place(segments.from_b),
          place(segments.to_b)};
}

template <class S> class ClosestPoints : public testing::Test {
 protected:
  static constexpr double kUlp = static_cast<double>(std::numeric_limits<S>::epsilon());

  static void expect_consistent(const Segments<S>& segments, const ClosestOfSegments<S>& result) {
    EXPECT_GE(result.parameter_a, S(0));
    EXPECT_LE(result.parameter_a, S(1));
    EXPECT_GE(result.parameter_b, S(0));
    EXPECT_LE(result.parameter_b, S(1));
    const Vec3<S> a = segments.from_a + result.parameter_a * (segments.to_a - segments.from_a);
    const Vec3<S> b = segments.from_b + result.parameter_b * (segments.to_b - segments.from_b);
    const double rounding = 4 * kUlp * (segments.scale() + static_cast<double>(a.norm()));
    EXPECT_LE(static_cast<double>((a - result.on_a).norm()), rounding);
    EXPECT_LE(static_cast<double>((b - result.on_b).norm()), rounding);
    EXPECT_EQ((result.on_b - result.on_a).norm(), result.distance);
  }

  static void expect_mirrored(const Segments<S>& segments) {
    const ClosestOfSegments<S> result = segments.closest();
    const ClosestOfSegments<S> mirror = segments.swapped().closest();
    EXPECT_EQ(result.on_a, mirror.on_b);
    EXPECT_EQ(result.on_b, mirror.on_a);
    EXPECT_EQ(result.parameter_a, mirror.parameter_b);
    EXPECT_EQ(result.parameter_b, mirror.parameter_a);
    EXPECT_EQ(result.distance, mirror.distance);
  }
};

using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(ClosestPoints, Scalars);

/// A about the origin along x, B at height 2, turned about y; crossing at known parameters.
TYPED_TEST(ClosestPoints, SkewSegmentsMeetOnTheCommonPerpendicularAtAnyPoseAndScale) {
  using S = TypeParam;
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    const double size = random.decade(-4, 4);
    const double s = random.uniform(0.01, 0.99), t = random.uniform(0.01, 0.99);
    const double angle = random.uniform(0.2, 2.9);
    const Vec3d along(std::cos(angle), 0, std::sin(angle));
    const Segments<double> segments{Vec3d(-s, 0, 0), Vec3d(1 - s, 0, 0), Vec3d(0, 2, 0) - t * along,
                                    Vec3d(0, 2, 0) + (1 - t) * along};
    const Segments<S> placed = moved<S>(segments, size, random.pose(1));
    const ClosestOfSegments<S> result = placed.closest();
    EXPECT_NEAR(static_cast<double>(result.parameter_a), s, 1000 * this->kUlp);
    EXPECT_NEAR(static_cast<double>(result.parameter_b), t, 1000 * this->kUlp);
    EXPECT_NEAR(static_cast<double>(result.distance), 2 * size, 8 * this->kUlp * size);
    this->expect_consistent(placed, result);
    this->expect_mirrored(placed);
  }
}

TYPED_TEST(ClosestPoints, CrossingSegmentsMeetInTheirCommonPoint) {
  using S = TypeParam;
  const Segments<S> cross{Vec3<S>(-1, 0, 0), Vec3<S>(1, 0, 0), Vec3<S>(0, -1, 0), Vec3<S>(0, 3, 0)};
  const ClosestOfSegments<S> result = cross.closest();
  EXPECT_EQ(result.distance, S(0));
  EXPECT_EQ(result.parameter_a, S(0.5));
  EXPECT_EQ(result.parameter_b, S(0.25));
  this->expect_mirrored(cross);
}

TYPED_TEST(ClosestPoints, ParallelSegmentsMeetInTheMiddleOfWhatTheyShare) {
  using S = TypeParam;
  const auto at_y = [](S x) { return Vec3<S>(x, 1, 0); };
  const auto on_x = [](S x) { return Vec3<S>(x, 0, 0); };
  struct Row {
    S from, to, middle;
    const char* what;
  };
  // A lies on x from 0 to 4; B is parallel to it.
  const Row rows[] = {
      {1, 3, 2, "B inside A"}, {-2, 8, 2, "A inside B"},          {2, 8, 3, "B past the end of A"},
      {0, 4, 2, "equal"},      {4, 0, 2, "equal, B turned back"}, {0, 2, 1, "starting together"},
      {4, 6, 4, "end to end"}};
  for (const Row& row : rows) {
    const Segments<S> segments{on_x(0), on_x(4), at_y(row.from), at_y(row.to)};
    const ClosestOfSegments<S> result = segments.closest();
    EXPECT_EQ(result.on_a, on_x(row.middle)) << row.what;
    EXPECT_EQ(result.on_b, at_y(row.middle)) << row.what;
    this->expect_mirrored(segments);
  }
}

TYPED_TEST(ClosestPoints, ParallelSegmentsKeepTheMiddleUnderRotation) {
  using S = TypeParam;
  Random random(2);
  for (int i = 0; i < 300; ++i) {
    // Both start together and B is half as long, so the shared stretch is all of B. Rounding
    // decides whether the feet of the perpendiculars at the start fall on the segments.
    const Segments<double> level{Vec3d(0, 0, 0), Vec3d(2, 0, 0), Vec3d(0, 1, 0), Vec3d(1, 1, 0)};
    const double size = random.decade(-4, 4);
    const Segments<S> segments = moved<S>(level, size, random.pose(1));
    const ClosestOfSegments<S> result = segments.closest();
    EXPECT_NEAR(static_cast<double>(result.distance), size, 8 * this->kUlp * size);
    EXPECT_NEAR(static_cast<double>(result.parameter_a), 0.25, 16 * this->kUlp);
    EXPECT_NEAR(static_cast<double>(result.parameter_b), 0.5, 16 * this->kUlp);
    this->expect_mirrored(segments);
  }
}

TYPED_TEST(ClosestPoints, OffsetParallelSegmentsMeetAtTheirEnds) {
  using S = TypeParam;
  const Segments<S> segments{Vec3<S>(0, 0, 0), Vec3<S>(1, 0, 0), Vec3<S>(8, 4, 0),
                             Vec3<S>(4, 4, 0)};
  const ClosestOfSegments<S> result = segments.closest();
  EXPECT_EQ(result.parameter_a, S(1));
  EXPECT_EQ(result.parameter_b, S(1));
  EXPECT_EQ(result.distance, S(5));
  this->expect_mirrored(segments);
}

TYPED_TEST(ClosestPoints, SegmentsOfLengthZeroArePoints) {
  using S = TypeParam;
  const Vec3<S> point(1, 2, 0);
  const Segments<S> one{Vec3<S>(0, 0, 0), Vec3<S>(4, 0, 0), point, point};
  EXPECT_EQ(one.closest().distance, S(2));
  EXPECT_EQ(one.closest().parameter_a, S(0.25));
  this->expect_mirrored(one);
  const Segments<S> both{point, point, Vec3<S>(4, 6, 0), Vec3<S>(4, 6, 0)};
  EXPECT_EQ(both.closest().distance, S(5));
  this->expect_mirrored(both);
  const Segments<S> same{point, point, point, point};
  EXPECT_EQ(same.closest().distance, S(0));
  EXPECT_EQ(same.closest().on_a, point);
}

TYPED_TEST(ClosestPoints, RandomSegmentsAgreeWithNestedSearch) {
  using S = TypeParam;
  Random random(3);
  double worst = 0;
  for (int i = 0; i < 3000; ++i) {
    const double size = random.decade(-4, 4);
    const auto point = [&](double length) {
      return Vec3<S>((length * random.unit_vector()).cast<S>());
    };
    Segments<S> segments{point(size), point(size), point(size * random.decade(-3, 3)), {}};
    segments.to_b = segments.from_b + point(size * random.decade(-3, 3));
    const ClosestOfSegments<S> result = segments.closest();
    const double error =
        std::abs(static_cast<double>(result.distance) - segments.searched_distance());
    worst = std::max(worst, error / (this->kUlp * segments.scale()));
    this->expect_consistent(segments, result);
    this->expect_mirrored(segments);
  }
  EXPECT_LE(worst, 4) << "ulps of the pair's extent";
}

TYPED_TEST(ClosestPoints, NearlyParallelSegmentsAgreeWithNestedSearch) {
  using S = TypeParam;
  Random random(4);
  double worst = 0;
  for (int i = 0; i < 3000; ++i) {
    const double size = random.decade(-4, 4);
    const Vec3d along = random.unit_vector();
    const Vec3d start = random.unit_vector();
    const Vec3d other =
        start + random.decade(-6, 1) * random.unit_vector() + random.uniform(-1, 1) * along;
    const Vec3d tilted = random.rotation_by(random.decade(-12, -1)) * along;
    const auto point = [&](const Vec3d& p) { return Vec3<S>((size * p).cast<S>()); };
    const Segments<S> segments{point(start), point(start + along), point(other),
                               point(other + random.decade(-2, 2) * tilted)};
    const ClosestOfSegments<S> result = segments.closest();
    const double error =
        std::abs(static_cast<double>(result.distance) - segments.searched_distance());
    worst = std::max(worst, error / (this->kUlp * segments.scale()));
    this->expect_consistent(segments, result);
    this->expect_mirrored(segments);
  }
  EXPECT_LE(worst, 4) << "ulps of the pair's extent";
}

TYPED_TEST(ClosestPoints, PointAndSegmentMeetAtEndsAndInBetween) {
  using S = TypeParam;
  const Vec3<S> from(1, 0, 0), to(5, 0, 0);
  const ClosestOnSegment<S> before = closest_on_segment(Vec3<S>(0, 1, 0), from, to);
  EXPECT_EQ(before.parameter, S(0));
  EXPECT_EQ(before.point, from);
  const ClosestOnSegment<S> after = closest_on_segment(Vec3<S>(9, 1, 7), from, to);
  EXPECT_EQ(after.parameter, S(1));
  EXPECT_EQ(after.point, to);
  const ClosestOnSegment<S> between = closest_on_segment(Vec3<S>(4, 1, 7), from, to);
  EXPECT_EQ(between.parameter, S(0.75));
  EXPECT_EQ(between.point, Vec3<S>(4, 0, 0));
  const ClosestOnSegment<S> on_point = closest_on_segment(Vec3<S>(4, 1, 7), from, from);
  EXPECT_EQ(on_point.parameter, S(0));
  EXPECT_EQ(on_point.point, from);
}

TYPED_TEST(ClosestPoints, RandomPointsAndSegmentsAgreeWithNestedSearch) {
  using S = TypeParam;
  Random random(5);
  for (int i = 0; i < 3000; ++i) {
    const double size = random.decade(-4, 4);
    const Vec3<S> point = (size * random.decade(-6, 6) * random.unit_vector()).cast<S>();
    const Vec3<S> from = (size * random.unit_vector()).cast<S>();
    const Vec3<S> to =
        from + Vec3<S>((size * random.decade(-6, 6) * random.unit_vector()).cast<S>());
    const Segments<S> segments{from, to, point, point};
    const ClosestOnSegment<S> result = closest_on_segment(point, from, to);
    EXPECT_NEAR(static_cast<double>((result.point - point).norm()), segments.searched_distance(),
                3 * this->kUlp * segments.scale());
  }
}

}  // namespace
}  // namespace contactscope
