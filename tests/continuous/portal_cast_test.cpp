#include "continuous/portal_cast.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <vector>

#include "geometry/primitives.h"
#include "support/random_geometry.h"

namespace contactscope {
namespace {

using test::Random;
using Extended = long double;
using Point = Eigen::Matrix<Extended, 3, 1>;

/// Two hulls; B moves straight.
struct Flight {
  Hull<double> a, b;
  Pose<double> pose_a, pose_b;
  Vec3d offset;
};

std::vector<Point> placed_vertices(const Hull<double>& hull, const Pose<double>& pose) {
  const Eigen::Quaternion<Extended> rotation = pose.rotation.cast<Extended>().normalized();
  std::vector<Point> result;
  for (const Vec3d& vertex : hull.vertices)
    result.push_back(rotation * Point(vertex.cast<Extended>()) + pose.position.cast<Extended>());
  return result;
}

/// The time span of overlap along every axis of the Minkowski difference; its end is before its
/// begin if there is none. All face normals and products of edges, in extended precision.
TimeSpan<Extended> overlap_span(const Flight& of) {
  const std::vector<Point> a = placed_vertices(of.a, of.pose_a),
                           b = placed_vertices(of.b, of.pose_b);
  const Point offset = of.offset.cast<Extended>();
  constexpr Extended kInfinity = std::numeric_limits<Extended>::infinity();
  TimeSpan<Extended> span{-kInfinity, kInfinity};
  const auto clip = [&](const Point& axis) {
    if (axis.squaredNorm() < 1e-24L) return;
    Extended least_a = kInfinity, most_a = -kInfinity, least_b = kInfinity, most_b = -kInfinity;
    for (const Point& p : a) {
      least_a = std::min(least_a, axis.dot(p));
      most_a = std::max(most_a, axis.dot(p));
    }
    for (const Point& p : b) {
      least_b = std::min(least_b, axis.dot(p));
      most_b = std::max(most_b, axis.dot(p));
    }
    const Extended speed = axis.dot(offset);
    const Extended first = least_a - most_b, last = most_a - least_b;
    if (speed == 0) {
      if (first > 0 || last < 0) span = {1, 0};
      return;
    }
    span.begin = std::max(span.begin, std::min(first / speed, last / speed));
    span.end = std::min(span.end, std::max(first / speed, last / speed));
  };
  std::vector<Point> edges[2];
  for (const auto& [hull, vertices, list] :
       {std::tuple(&of.a, &a, &edges[0]), std::tuple(&of.b, &b, &edges[1])}) {
    for (int e = 0; e < 2 * hull->edge_count(); e += 2) {
      const auto from = static_cast<std::size_t>(at(hull->half_edges, e).origin);
      const auto to = static_cast<std::size_t>(at(hull->half_edges, e ^ 1).origin);
      list->push_back(((*vertices)[to] - (*vertices)[from]).normalized());
    }
    for (int face = 0; face < hull->face_count(); ++face) {
      const std::vector<int> ring = face_vertices(*hull, face);
      const Point& corner = at(*vertices, ring[0]);
      clip((at(*vertices, ring[1]) - corner).cross(at(*vertices, ring[2]) - corner).normalized());
    }
  }
  for (const Point& edge_a : edges[0])
    for (const Point& edge_b : edges[1]) clip(edge_a.cross(edge_b));
  return span;
}

Flight random_flight(Random& random, double size) {
  const auto hull = [&] {
    if (random.chance(0.3)) return test::random_box(random, size, 5);
    const int vertices = 4 + random.index(20);
    return test::random_hull(random, vertices, size, 5);
  };
  Flight of{hull(), hull(), random.pose(size), random.pose(size), Vec3d::Zero()};
  of.pose_b.position += 4 * size * random.unit_vector();
  const Vec3d aim = of.pose_a.position + size * random.vector(-1, 1);
  of.offset = random.uniform(1, 3) * (aim - of.pose_b.position);
  return of;
}

template <class S> struct Cast {
  explicit Cast(const Flight& of)
      : a(hull_cast<S>(of.a)),
        b(hull_cast<S>(of.b)),
        turning_a({support_set(a), still(of.pose_a), 0}),
        turning_b({support_set(b), still(of.pose_b), 0}),
        between((of.pose_b.position - of.pose_a.position).cast<S>()),
        offset(of.offset.cast<S>()),
        scale(turning_a.reach() + turning_b.reach() + between.norm() + offset.norm()),
        cast(turning_a, turning_b, scale) {
    cast.place(0, between, offset);
  }
  static Sweep<S> still(const Pose<double>& pose) {
    Sweep<S> sweep;
    sweep.start = pose.cast<S>();
    return sweep;
  }

  Hull<S> a, b;
  Turning<S> turning_a, turning_b;
  Vec3<S> between, offset;
  S scale;
  PortalCast<S> cast;
};

template <class S> class PortalCasts : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(PortalCasts, Scalars);

/// Never late, never early without a reason, and Hit or Separated if the oracle is sure.
TYPED_TEST(PortalCasts, SlowAgreeWithEveryAxis) {
  using S = TypeParam;
  Random random(31);
  int hits = 0, separated = 0, undecided = 0, supports = 0;
  constexpr int kFlights = 4000;
  for (int i = 0; i < kFlights; ++i) {
    const double size = random.decade(-4, 4);
    const Flight of = random_flight(random, size);
    const TimeSpan<Extended> exact = overlap_span(of);
    Cast<S> own(of);
    const S rounding = tie_tolerance(own.scale);
    const S target = S(4) * rounding, slack = S(2) * rounding;
    const CastStatus status = own.cast.cast({target, slack, S(1)});
    supports += own.cast.supports();
    // With an overlap of this duration, rounding and target cannot cause a miss.
    const auto sure = static_cast<Extended>(S(8) * rounding / own.offset.norm());
    const bool meets = exact.begin <= exact.end && exact.begin < 1;
    const auto safe = static_cast<Extended>(own.cast.safe_time());
    if (meets) {
      ASSERT_LE(safe, exact.begin) << i;
    }
    if (status == CastStatus::Hit) {
      ++hits;
      // Target and slack are between the portal, which is inside, and the support plane.
      const Vec3<S> normal = own.cast.plane().normal;
      const auto speed = static_cast<Extended>(normal.dot(own.offset));
      ASSERT_GT(speed, 0);
      ASSERT_TRUE(exact.begin <= exact.end + sure) << i;
      EXPECT_LE(exact.begin - safe, static_cast<Extended>(target + slack + S(2) * rounding) / speed)
          << i;
      EXPECT_NEAR(static_cast<double>(normal.norm()), 1, 1e-5);
    } else if (status == CastStatus::Separated) {
      ++separated;
      EXPECT_FALSE(meets && exact.begin < 1 - sure) << i;
    } else {
      ++undecided;
      EXPECT_LT(exact.end - exact.begin, 100 * sure) << i;
    }
  }
  EXPECT_GT(hits, kFlights / 2);
  EXPECT_GT(separated, kFlights / 20);
  EXPECT_LT(undecided, kFlights / 200);
  std::printf("hits %d, separated %d, undecided %d, supports %.2f\n", hits, separated, undecided,
              static_cast<double>(supports) / kFlights);
}

TYPED_TEST(PortalCasts, APortalOfCubesThatMeetFlatLiesInTheirFaces) {
  using S = TypeParam;
  const Hull<double> cube = make_box(Vec3d(1, 1, 1));
  Flight of{cube, cube, {}, {}, Vec3d(0, 0, -8)};
  of.pose_b.position = Vec3d(0.3, -0.4, 6);
  Cast<S> own(of);
  ASSERT_EQ(own.cast.cast({S(1e-4), S(1e-5), S(1)}), CastStatus::Hit);
  EXPECT_NEAR(static_cast<double>(own.cast.safe_time()), (4 - 1e-4) / 8, 1e-6);
  EXPECT_NEAR(static_cast<double>(own.cast.plane().normal.z()), -1, 1e-6);
  const GjkSimplex<S> portal = own.cast.portal();
  S sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(portal.vertices[i].a.z(), S(1));
    EXPECT_EQ(portal.vertices[i].b.z(), S(-1));
    EXPECT_GE(portal.weights[i], S(0));
    sum += portal.weights[i];
  }
  EXPECT_NEAR(static_cast<double>(sum), 1, 1e-6);
  const Closest<S> closest = own.cast.closest(own.cast.safe_time());
  EXPECT_NEAR(static_cast<double>(closest.distance), 1e-4, 3e-6);
  EXPECT_NEAR(static_cast<double>(closest.on_b.z() - closest.on_a.z()), 1e-4, 3e-6);
}

TYPED_TEST(PortalCasts, EveryRecordedPlaneAdvancesTheSafeTime) {
  using S = TypeParam;
  Random random(32);
  std::size_t most = 0;
  for (int i = 0; i < 100; ++i) {
    Cast<S> own(random_flight(random, 1));
    std::vector<SupportPlane<S>> planes;
    own.cast.cast({S(1e-3), S(1e-4), S(1)}, &planes);
    S reached = 0;
    for (const SupportPlane<S>& plane : planes) {
      EXPECT_GT(plane.time, reached);
      EXPECT_GT(plane.separation, S(1e-3));
      reached = plane.time;
    }
    EXPECT_EQ(reached, own.cast.safe_time());
    most = std::max(most, planes.size());
  }
  EXPECT_GT(most, 2U);
}

/// A cast that continues from the last portal gives the same result as one from the start.
TYPED_TEST(PortalCasts, GoOnFromThePortalOfTheSearchBefore) {
  using S = TypeParam;
  Random random(33);
  int hits = 0, fewer = 0;
  for (int i = 0; i < 200; ++i) {
    Cast<S> own(random_flight(random, 1));
    const CastLimits<S> limits{S(1e-3), S(1e-4), S(1)};
    if (own.cast.cast(limits) != CastStatus::Hit) continue;
    const Vec3<S> offset = own.offset + S(0.01) * random.vector(-1, 1).template cast<S>();
    own.cast.place(0, own.between, offset);
    const int before = own.cast.supports();
    const CastStatus again = own.cast.cast_again(limits);
    const int middle = own.cast.supports();
    const S time = own.cast.safe_time();
    ASSERT_EQ(own.cast.cast(limits), again);
    if (again != CastStatus::Hit) continue;
    ++hits;
    fewer += middle - before < own.cast.supports() - middle;
    EXPECT_NEAR(static_cast<double>(own.cast.safe_time()), static_cast<double>(time), 1e-3);
  }
  EXPECT_GT(hits, 80);
  EXPECT_GT(fewer, hits * 3 / 4);
}

TYPED_TEST(PortalCasts, ZeroDisplacementOrEqualCentresAreUndecided) {
  using S = TypeParam;
  const Hull<double> cube = make_box(Vec3d(1, 1, 1));
  Flight still{cube, cube, {}, {}, Vec3d::Zero()};
  still.pose_b.position = Vec3d(0, 0, 6);
  Cast<S> without_offset(still);
  EXPECT_EQ(without_offset.cast.cast({S(1e-4), S(1e-5), S(1)}), CastStatus::Undecided);
  EXPECT_EQ(without_offset.cast.safe_time(), S(0));
  Flight same{cube, cube, {}, {}, Vec3d(1, 0, 0)};
  Cast<S> inside(same);
  EXPECT_EQ(inside.cast.cast({S(1e-4), S(1e-5), S(1)}), CastStatus::Undecided);
  EXPECT_EQ(inside.cast.safe_time(), S(0));
}

}  // namespace
}  // namespace contactscope
