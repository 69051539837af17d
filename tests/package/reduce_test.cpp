#include <contactscope/reduce.h>
#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace contactscope {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

/// Eight corners of a ring; number 3 is the deepest.
Manifold ring() {
  Manifold manifold{{0, 1, 0}};
  for (int i = 0; i < 8; ++i) {
    const double angle = std::numbers::pi / 4 * i;
    manifold.points.push_back({{std::cos(angle), 0, std::sin(angle)}, i == 3 ? -0.02 : -0.01});
  }
  return manifold;
}

TEST(PackageReduce, EveryReducerKeepsAtMostFour) {
  ASSERT_THAT(reducers(), testing::Not(IsEmpty()));
  for (const Reducer& reducer : reducers()) {
    const std::size_t expected = reducer.name == "none" ? 8 : 4;
    EXPECT_THAT(reduce(ring(), reducer.name), SizeIs(testing::Le(expected))) << reducer.name;
    EXPECT_FALSE(reducer.summary.empty()) << reducer.name;
  }
}

TEST(PackageReduce, DeepestPointIsKeptInEitherScalar) {
  for (const Scalar scalar : {Scalar::Float, Scalar::Double}) {
    ReduceOptions options;
    options.scalar = scalar;
    EXPECT_THAT(reduce(ring(), "optimal_deepest", options), Contains(3));
  }
}

TEST(PackageReduce, FewPointsAreKeptInTheirOrder) {
  ReduceOptions options;
  options.max_points = 8;
  EXPECT_THAT(reduce(ring(), "area", options), ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
}

TEST(PackageReduce, NothingIsKeptOfWhatIsNotFinite) {
  Manifold manifold = ring();
  manifold.points[5].separation = std::numeric_limits<double>::infinity();
  EXPECT_THAT(reduce(manifold, "area"), IsEmpty());
}

TEST(PackageReduce, UnknownReducerAndTooManyPointsAreRefused) {
  EXPECT_THROW(reduce(ring(), "best"), std::invalid_argument);
  Manifold large = ring();
  large.points.resize(257);
  EXPECT_THROW(reduce(large, "area"), std::invalid_argument);
}

}  // namespace
}  // namespace contactscope
