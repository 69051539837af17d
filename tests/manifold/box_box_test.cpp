#include "manifold/fast/fast_pairs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>
#include <string>

#include "geometry/primitives.h"
#include "manifold/collide_pairs.h"
#include "manifold/dispatch.h"
#include "support/brute_force_sat.h"
#include "support/builders.h"
#include "support/random_geometry.h"

// The special path of two boxes gives the result of two general hulls, bit for bit, or no result.
namespace contactscope {
namespace {

using test::Random;

template <class S> bool same_bits(const S& one, const S& other) {
  return std::memcmp(&one, &other, sizeof one) == 0;
}

/// Zeros of either sign are equal.
template <class S> bool same(const Vec3<S>& one, const Vec3<S>& other) {
  for (int k = 0; k < 3; ++k) {
    if (!same_bits(one[k] + S(0), other[k] + S(0))) return false;
  }
  return true;
}

template <class S> void expect_same(const Manifold<S>& contact, const Manifold<S>& expected) {
  ASSERT_EQ(contact.points.size(), expected.points.size());
  EXPECT_EQ(contact.axis, expected.axis);
  EXPECT_EQ(contact.type, expected.type);
  EXPECT_TRUE(same(contact.normal, expected.normal))
      << contact.normal.transpose() << " for " << expected.normal.transpose();
  for (std::size_t i = 0; i < expected.points.size(); ++i) {
    SCOPED_TRACE("point " + std::to_string(i));
    EXPECT_EQ(to_string(contact.points[i].id), to_string(expected.points[i].id));
    EXPECT_TRUE(same(contact.points[i].position, expected.points[i].position))
        << contact.points[i].position.transpose() - expected.points[i].position.transpose();
    EXPECT_TRUE(same_bits(contact.points[i].separation, expected.points[i].separation));
  }
}

/// Two boxes, in double; positions in units of `size` metres.
struct BoxPairCase {
  Vec3d half_a, half_b;
  Pose<double> b_in_a;
  double size = 1;
};

Vec3d random_half_extents(Random& random, double aspect) {
  const double most = std::log10(aspect);
  Vec3d half;
  for (int k = 0; k < 3; ++k) half[k] = 0.5 * random.decade(-most, 0);
  return half;
}

/// Moves B along `axis` until the boxes overlap by `overlap` along it.
void leave_overlap(BoxPairCase& pair, const Vec3d& axis, double overlap) {
  const Mat3<double> r = pair.b_in_a.rotation.toRotationMatrix();
  const double reach =
      pair.half_a.dot(axis.cwiseAbs()) + pair.half_b.dot((r.transpose() * axis).cwiseAbs());
  pair.b_in_a.position += (reach - overlap - pair.b_in_a.position.dot(axis)) * axis;
}

BoxPairCase any_pose(Random& random) {
  BoxPairCase pair{random_half_extents(random, 4), random_half_extents(random, 4), {}, 1};
  pair.b_in_a = {random.rotation(), random.vector(-1, 1)};
  return pair;
}

/// Face on face, tilted by nothing, by rounding or by a little, with any yaw or none.
BoxPairCase at_rest(Random& random) {
  BoxPairCase pair{random_half_extents(random, 3), random_half_extents(random, 3), {}, 1};
  const double tilts[] = {0, 1e-8, 1e-6, 1e-4, 3e-3};
  const double yaw = random.chance(0.3) ? 0 : random.uniform(-3, 3);
  const int up = random.index(3);
  const Vec3d axis = Vec3d::Unit(up) * (random.chance(0.5) ? 1 : -1);
  pair.b_in_a.rotation =
      Quatd(Eigen::AngleAxisd(yaw, axis)) * random.rotation_by(at(tilts, random.index(5)));
  pair.b_in_a.rotation.normalize();
  const Vec3d offset = random.vector(-0.4, 0.4);
  pair.b_in_a.position = offset - axis * axis.dot(offset);
  leave_overlap(pair, axis, random.chance(0.2) ? 0 : random.uniform(-0.001, 0.02));
  return pair;
}

/// Equal coordinates everywhere: sides that coincide, corners on corners, one box inside the other.
BoxPairCase on_a_lattice(Random& random) {
  const auto sizes = [&] {
    Vec3d half;
    for (int k = 0; k < 3; ++k) half[k] = 0.25 * (1 + random.index(3));
    return half;
  };
  BoxPairCase pair{sizes(), sizes(), {}, 1};
  for (int turns = random.index(6); turns > 0; --turns) {
    const Vec3d axis = Vec3d::Unit(random.index(3));
    const double angle = random.chance(0.8) ? 90 : 45;
    pair.b_in_a.rotation =
        (Quatd(Eigen::AngleAxisd(angle * std::numbers::pi / 180, axis)) * pair.b_in_a.rotation)
            .normalized();
  }
  for (int k = 0; k < 3; ++k) pair.b_in_a.position[k] = 0.25 * (random.index(13) - 6);
  return pair;
}

BoxPairCase edge_on_edge(Random& random) {
  BoxPairCase pair{random_half_extents(random, 2), random_half_extents(random, 2), {}, 1};
  pair.b_in_a.rotation = random.rotation();
  const Mat3<double> r = pair.b_in_a.rotation.toRotationMatrix();
  const Vec3d axis = Vec3d::Unit(random.index(3)).cross(r.col(random.index(3)));
  pair.b_in_a.position = random.vector(-0.2, 0.2);
  if (axis.norm() > 1e-3) leave_overlap(pair, axis.normalized(), random.uniform(-0.001, 0.02));
  return pair;
}

/// Two edges, near each other and parallel to within `angle`.
BoxPairCase edges_nearly_parallel(Random& random) {
  BoxPairCase pair = edge_on_edge(random);
  const Vec3d axis = Vec3d::Unit(random.index(3));
  const Quatd roll(Eigen::AngleAxisd(random.uniform(-3, 3), axis));
  pair.b_in_a.rotation = (random.rotation_by(random.decade(-8, -1)) * roll).normalized();
  pair.b_in_a.position = random.vector(-0.5, 0.5);
  return pair;
}

struct Family {
  const char* name;
  BoxPairCase (*draw)(Random& random);
  double decided;  // minimum share that the general path does not handle
};
constexpr Family kFamilies[] = {{"any pose", any_pose, 0.97},
                                {"at rest", at_rest, 0.6},
                                {"on a lattice", on_a_lattice, 0.05},
                                {"edge on edge", edge_on_edge, 0.9},
                                {"edges nearly parallel", edges_nearly_parallel, 0.6}};

struct Setting {
  Preference preference;
  double margin;  // in sizes
};
constexpr Setting kSettings[] = {
    {Preference::Relative, 0}, {Preference::Relative, 0.02}, {Preference::None, 0}};

template <class S> class BoxBox : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(BoxBox, Scalars);

constexpr int kPairs = 4000;  // per family

TYPED_TEST(BoxBox, SlowGivesWhatTwoHullsGiveBitForBit) {
  using S = TypeParam;
  for (const Family& family : kFamilies) {
    Random random(17);
    int decided = 0, touching = 0;
    for (int i = 0; i < kPairs; ++i) {
      BoxPairCase drawn = family.draw(random);
      drawn.size = random.chance(0.5) ? 1 : random.decade(-4, 4);
      const Hull<S> a = hull_cast<S>(make_box(drawn.size * drawn.half_a));
      const Hull<S> b = hull_cast<S>(make_box(drawn.size * drawn.half_b));
      ASSERT_TRUE(a.is_box() && b.is_box());
      drawn.b_in_a.position *= drawn.size;
      Pose<double> pose_a;
      if (random.chance(0.5)) pose_a = random.pose(drawn.size);
      const Pose<S> in_world = pose_a.template cast<S>();
      const Pose<S> pose_b = compose(pose_a, drawn.b_in_a).template cast<S>();
      for (const auto& [preference, margin] : kSettings) {
        SCOPED_TRACE(std::string(family.name) + ", pair " + std::to_string(i) + ", preference " +
                     to_string(preference) + ", margin " + std::to_string(margin));
        CollideOptions options;
        options.preference = preference;
        options.margin = margin * drawn.size;
        if (random.chance(0.5)) options.reducer = find_reducer("area");
        Manifolds<S> manifolds;
        if (!collide_box_box(a, in_world, b, pose_b, options, manifolds)) {
          ASSERT_TRUE(manifolds.empty());
          continue;
        }
        const Manifold<S> expected = collide_hull_hull(a, in_world, b, pose_b, options);
        ++decided;
        ASSERT_EQ(manifolds.empty(), expected.points.empty());
        if (manifolds.empty()) continue;
        ++touching;
        expect_same(manifolds[0], expected);
        ASSERT_FALSE(this->HasFailure());
      }
    }
    std::printf("%s: %.3f decided, %d of them touch\n", family.name, decided / (3.0 * kPairs),
                touching);
    EXPECT_GT(decided, family.decided * 3 * kPairs) << family.name;
    EXPECT_GT(touching, kPairs / 20) << family.name;
  }
}

TYPED_TEST(BoxBox, IsAsDeepAsBruteForceOverEveryAxis) {
  using S = TypeParam;
  for (const Family& family : kFamilies) {
    Random random(18);
    for (int i = 0; i < 300; ++i) {
      SCOPED_TRACE(std::string(family.name) + ", pair " + std::to_string(i));
      const BoxPairCase drawn = family.draw(random);
      const Hull<S> a = hull_cast<S>(make_box(drawn.half_a));
      const Hull<S> b = hull_cast<S>(make_box(drawn.half_b));
      const Pose<S> b_in_a = drawn.b_in_a.template cast<S>();
      CollideOptions options;
      options.preference = Preference::None;
      Manifolds<S> manifolds;
      if (!collide_box_box(a, {}, b, b_in_a, options, manifolds)) continue;
      const test::BruteForceAxis best = test::brute_force_sat(
          hull_cast<double>(a), {}, hull_cast<double>(b), b_in_a.template cast<double>());
      const double rounding =
          64 * std::numeric_limits<S>::epsilon() * (a.radius + b.radius + b_in_a.position.norm());
      if (std::abs(best.separation) > rounding) {
        ASSERT_EQ(manifolds.empty(), best.separation > 0) << best.separation;
      }
      if (!manifolds.empty()) {
        ASSERT_NEAR(test::deepest(manifolds[0]), best.separation, rounding);
      }
    }
  }
}

TEST(BoxHull, OnlyWhatMakeBoxMakesIsABox) {
  const Hull<double> box = make_box({1, 2, 3});
  EXPECT_EQ(box.half_extents, Vec3d(1, 2, 3));
  Hull<double> moved = box;
  for (Vec3d& vertex : moved.vertices) vertex.x() += 1;
  lay_out(moved);
  EXPECT_FALSE(moved.is_box());
  Hull<double> leaning = box;
  leaning.vertices[3].y() += 1e-9;
  lay_out(leaning);
  EXPECT_FALSE(leaning.is_box());
  EXPECT_FALSE(make_cylinder(1, 1, 4).is_box());
  EXPECT_TRUE(hull_cast<float>(box).is_box());
  EXPECT_FALSE(hull_cast<float>(make_box({1e-30, 1, 1})).is_box());
}

TEST(BoxBox, LeavesARotationThatIsNoneToTheGeneralPath) {
  const Hull<double> box = make_box({1, 1, 1});
  Pose<double> b_in_a;
  b_in_a.position = {0, 1.9, 0.1};
  Manifolds<double> manifolds;
  EXPECT_TRUE(collide_box_box(box, {}, box, b_in_a, {}, manifolds));
  EXPECT_EQ(manifolds.size(), 1U);
  manifolds.clear();
  b_in_a.rotation.coeffs() *= 1.001;
  EXPECT_FALSE(collide_box_box(box, {}, box, b_in_a, {}, manifolds));
  b_in_a.rotation.coeffs().setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(collide_box_box(box, {}, box, b_in_a, {}, manifolds));
  EXPECT_TRUE(manifolds.empty());
}

}  // namespace
}  // namespace contactscope
