#include "query/fast/face_bounds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>
#include <string>
#include <vector>

#include "geometry/primitives.h"
#include "query/tolerance.h"
#include "support/cases.h"
#include "support/pair_case.h"

// Bounds skip only work: the separating axis test with bounds and the one that measures every face
// and every edge give the same result, bit for bit.
namespace contactscope {
namespace {

using test::PairCase;
using test::Random;

template <class S> bool same_bits(const S& one, const S& other) {
  return std::memcmp(&one, &other, sizeof one) == 0;
}

template <class S> void expect_same(const FaceQuery<S>& query, const FaceQuery<S>& expected) {
  EXPECT_EQ(query.face, expected.face);
  EXPECT_EQ(query.support, expected.support);
  EXPECT_TRUE(same_bits(query.separation, expected.separation))
      << query.separation << " for " << expected.separation;
}

template <class S> void expect_same(const SatResult<S>& axes, const SatResult<S>& expected) {
  EXPECT_EQ(axes.status, expected.status);
  EXPECT_EQ(axes.chosen, expected.chosen);
  EXPECT_EQ(axes.deepest, expected.deepest);
  EXPECT_EQ(axes.queries_run, expected.queries_run);
  EXPECT_EQ(axes.tie, expected.tie);
  expect_same(axes.face_a, expected.face_a);
  expect_same(axes.face_b, expected.face_b);
  EXPECT_EQ(axes.edge.edge_a, expected.edge.edge_a);
  EXPECT_EQ(axes.edge.edge_b, expected.edge.edge_b);
  EXPECT_TRUE(same_bits(axes.edge.separation, expected.edge.separation));
  EXPECT_TRUE(same_bits(axes.edge.normal, expected.edge.normal));
}

/// Many sides; a few may be coplanar within rounding or a little off.
Hull<double> prism(Random& random) {
  const int segments = 8 + random.index(40);
  return random.chance(0.7) ? make_cylinder(0.5, random.uniform(0.02, 1), segments)
                            : make_cone(0.5, random.uniform(0.1, 1), 2 * segments);
}

Hull<double> any_hull(Random& random) {
  if (random.chance(0.3)) return prism(random);
  return test::random_hull(random, 16 + random.index(60), 0.5, random.chance(0.3) ? 10 : 1);
}

/// Moves B along a unit direction until the hulls overlap by `overlap` along it.
void leave_overlap(PairCase<double>& pair, const Vec3d& direction, double overlap) {
  double a_most = -1e30, b_least = 1e30;
  for (const Vec3d& v : pair.a.vertices) a_most = std::max(a_most, direction.dot(v));
  for (const Vec3d& v : pair.b.vertices)
    b_least = std::min(b_least, direction.dot(pair.pose_b.transform(v)));
  pair.pose_b.position += (a_most - b_least - overlap) * direction;
}

double overlap(Random& random) { return random.chance(0.2) ? 0 : random.uniform(-0.02, 0.1); }

PairCase<double> at_random(Random& random) {
  PairCase<double> pair{any_hull(random), {}, any_hull(random), {}};
  pair.pose_b = {random.rotation(), random.vector(-0.8, 0.8)};
  if (random.chance(0.8)) leave_overlap(pair, random.unit_vector(), overlap(random));
  return pair;
}

/// The centroids are near each other or coincide.
PairCase<double> deep(Random& random) {
  PairCase<double> pair{any_hull(random), {}, any_hull(random), {}};
  pair.pose_b.rotation = random.rotation();
  pair.pose_b.position = random.unit_vector() * (random.chance(0.2) ? 0 : random.decade(-9, -0.5));
  return pair;
}

/// The same hull twice, turned by nothing or by little: all edges are nearly parallel.
PairCase<double> twins(Random& random) {
  const Hull<double> hull = any_hull(random);
  PairCase<double> pair{hull, {}, hull, {}};
  if (random.chance(0.8)) pair.pose_b.rotation = random.rotation_by(random.decade(-9, -1));
  leave_overlap(pair, random.unit_vector(), overlap(random));
  return pair;
}

/// A hull and its mirror image through a point, shifted: faces on faces, edges on edges.
PairCase<double> images(Random& random) {
  const Hull<double> hull = prism(random);
  PairCase<double> pair{hull, {}, hull, {}};
  const Vec3d axis = Vec3d::Unit(random.index(3));
  const double turns[] = {0.25, 0.5, 1, 0.125};
  pair.pose_b.rotation =
      Quatd(Eigen::AngleAxisd(at(turns, random.index(4)) * std::numbers::pi, axis)).normalized();
  if (random.chance(0.5)) {
    pair.pose_b.rotation =
        (random.rotation_by(random.decade(-8, -2)) * pair.pose_b.rotation).normalized();
  }
  const Vec3d shifted = random.chance(0.5) ? Vec3d::Zero() : random.vector(-0.3, 0.3);
  pair.pose_b.position = shifted;
  leave_overlap(pair, random.chance(0.7) ? axis : Vec3d::Unit(random.index(3)), overlap(random));
  return pair;
}

struct Family {
  const char* name;
  PairCase<double> (*draw)(Random& random);
};
constexpr Family kFamilies[] = {
    {"at random", at_random}, {"deep", deep}, {"twins", twins}, {"images", images}};

/// The hull in units of `size` metres.
template <class S> Hull<S> scaled(Hull<double> hull, double size) {
  for (Vec3d& vertex : hull.vertices) vertex *= size;
  for (Plane<double>& plane : hull.planes) plane.offset *= size;
  hull.centroid *= size;
  hull.radius *= size;
  lay_out(hull);
  return hull_cast<S>(hull);
}

template <class S> void expect_the_same_by_bounds(std::uint64_t seed) {
  Random random(seed);
  for (const Family& family : kFamilies) {
    SCOPED_TRACE(family.name);
    for (int i = 0; i < test::cases(800) && !testing::Test::HasFailure(); ++i) {
      SCOPED_TRACE("pair " + std::to_string(i));
      const PairCase<double> drawn = family.draw(random);
      const double size = random.chance(0.5) ? 1 : random.decade(-4, 4);
      const Hull<S> a = scaled<S>(drawn.a, size), b = scaled<S>(drawn.b, size);
      Pose<double> b_in_a = drawn.pose_b;
      b_in_a.position *= size;
      const HullPair<S> pair(a, b, b_in_a.cast<S>());
      const S margin = static_cast<S>(random.chance(0.5) ? 0 : 0.02 * size);
      for (const Preference preference : {Preference::Relative, Preference::None}) {
        for (const Owner preferred : {Owner::A, Owner::B}) {
          FaceSeparations<S> faces_a(pair.a), faces_b(pair.b);
          expect_same(sat(pair, margin, preference, preferred),
                      sat(pair, margin, preference, faces_a, faces_b, preferred));
        }
      }
    }
  }
}

TEST(FaceBounds, ChangeNoBitOfTheSeparatingAxisTestInFloat) {
  expect_the_same_by_bounds<float>(3201);
}
TEST(FaceBounds, ChangeNoBitOfTheSeparatingAxisTestInDouble) {
  expect_the_same_by_bounds<double>(3202);
}

TEST(FaceBounds, AFaceIsMeasuredAsTheFaceQueryDoes) {
  Random random(3203);
  for (const int vertices : {4, 5, 6, 7, 31, 32, 64, 66}) {
    SCOPED_TRACE(vertices);
    const Hull<float> a = hull_cast<float>(test::random_hull(random, 20, 0.5, 1));
    const Hull<float> b = hull_cast<float>(test::random_hull(random, vertices, 0.5, 1));
    // So far away that the lanes' padding would be the deepest vertex somewhere, if it were one.
    const Pose<float> b_in_a{random.rotation().cast<float>(), Vec3f(0.3f, 4, -3)};
    const HullPair<float> pair(a, b, b_in_a);
    FaceSeparations<float> faces(pair.a);
    query_faces(pair.a, pair.b, 0.f, faces);
    for (int face = 0; face < a.face_count(); ++face) {
      expect_same(measure_face(pair.a, face, pair.b),
                  {face, faces.support(face), faces.separation(face)});
    }
  }
}

/// The purpose of the bounds: hulls of 32 vertices have 90 edges.
TEST(FaceBounds, LeaveOutMostFacesAndEdgesOfHullsThatTouch) {
  Random random(3204);
  int edges_left = 0, given_up = 0;
  constexpr int kPairs = 200;
  for (int i = 0; i < kPairs; ++i) {
    PairCase<double> drawn{
        test::random_hull(random, 32, 0.5, 1), {}, test::random_hull(random, 32, 0.5, 1), {}};
    drawn.pose_b.rotation = random.rotation();
    leave_overlap(drawn, random.unit_vector(), 0.005);
    const HullPair<double> pair(drawn.a, drawn.b, drawn.pose_b);
    FaceBounds<double> bounds(pair.a, pair.b);
    const Vec3d towards_a = drawn.pose_b.inverse_rotate(Vec3d(-drawn.pose_b.position));
    int nearest = 0;
    for (int v = 1; v < drawn.b.vertex_count(); ++v) {
      if (towards_a.dot(at(drawn.b.vertices, v)) > towards_a.dot(at(drawn.b.vertices, nearest)))
        nearest = v;
    }
    bounds.look_at({nearest});
    if (!bounds.find_best(tie_tolerance(pair.scale))) {
      ++given_up;
      continue;
    }
    std::vector<int> edges(static_cast<std::size_t>(drawn.a.edge_count() + 1));
    edges_left += bounds.edges_above(bounds.best().separation, edges.data());
  }
  EXPECT_LT(given_up, kPairs / 50);
  EXPECT_LT(edges_left, 6 * kPairs);
}

}  // namespace
}  // namespace contactscope
