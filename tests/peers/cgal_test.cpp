#include "peers/cgal.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/exact_triangles.h"
#include "support/random_triangles.h"

namespace contactscope {
namespace {

using enum TriangleOverlapKind;
using test::Random;
using test::TrianglePair;
using test::TrianglePairs;

/// Agreement with CGAL over `count` pairs.
struct Compared {
  int overlapping = 0, separation = 0, refused = 0;
};

template <class S, class Draw>
Compared compare_with_cgal(int count, std::uint64_t seed, const Draw& draw) {
  Random random(seed);
  Compared compared;
  for (int i = 0; i < count; ++i) {
    const auto [a, b] = draw(random);
    if (is_degenerate(a) || is_degenerate(b)) {
      ++compared.refused;
      continue;
    }
    const bool expected = peers::cgal_overlaps(a, b);
    ++(expected ? compared.overlapping : compared.separation);
    const bool own = triangle_overlap_kind(test::rounded<S>(a), test::rounded<S>(b)) != None;
    if (own != expected) {
      ADD_FAILURE() << "pair " << i << ": CGAL says " << expected << ", exact clipping "
                    << (test::exact_triangle_overlap(a, b).kind != None);
      break;
    }
  }
  return compared;
}

/// All kinds of pairs, every decade of sizes equally likely, near the origin and far away.
TrianglePair hard_pair(Random& random, bool in_float) {
  const auto how = static_cast<TrianglePairs>(random.index(test::kTrianglePairs));
  const double size = random.decade(-4, 4);
  const double far = random.chance(0.3) ? 1000 * size : 0;
  return test::random_triangle_pair(random, how, size, far * random.unit_vector(), in_float);
}

TEST(Cgal, SlowAMillionPairsOfTheMixAgree) {
  const Compared compared = compare_with_cgal<float>(1'000'000, 31, [](Random& random) {
    return test::random_triangle_pair(random, test::draw_from_mix(random), 1, Vec3d::Zero(), true);
  });
  EXPECT_GT(compared.overlapping, 100'000);
  EXPECT_GT(compared.separation, 100'000);
}

TEST(Cgal, SlowHardFloatsAgree) {
  const Compared compared =
      compare_with_cgal<float>(200'000, 32, [](Random& random) { return hard_pair(random, true); });
  EXPECT_GT(compared.overlapping, 20'000);
  EXPECT_GT(compared.separation, 20'000);
}

TEST(Cgal, SlowHardDoublesAgree) {
  const Compared compared = compare_with_cgal<double>(
      200'000, 33, [](Random& random) { return hard_pair(random, false); });
  EXPECT_GT(compared.overlapping, 20'000);
  EXPECT_GT(compared.separation, 20'000);
}

}  // namespace
}  // namespace contactscope
