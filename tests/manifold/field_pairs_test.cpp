#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>

#include "field/closed_surface.h"
#include "field/distance_field.h"
#include "geometry/hull_builder.h"
#include "geometry/primitives.h"
#include "manifold/dispatch.h"
#include "manifold/field_contact.h"
#include "manifold/placed_shapes.h"
#include "query/mesh_overlap.h"
#include "query/winding.h"
#include "support/brute_force_distance.h"
#include "support/builders.h"
#include "support/cases.h"
#include "support/sphere_mesh.h"

namespace contactscope {
namespace {

using test::deepest_of;
using test::manifolds_of;
using test::PlacedShapes;
using test::Random;

Shape<double> field_of(const Shape<double>& shape, const FieldSettings& settings = {}) {
  return field_shape(build_distance_field(shape, settings), shape);
}

TEST(FieldPairs, ASphereTouchesAFieldAsItTouchesTheBoxThatItIsMadeOf) {
  Random random(1);
  int touching = 0;
  for (int i = 0; i < 200; ++i) {
    const double size = random.decade(-4, 4);
    const Hull<double> box = make_box(size * Vec3d(1, 0.7, 0.4));
    const double radius = size * random.uniform(0.1, 0.5);
    // Outside the box, the centre has the same distance from both.
    const Vec3d center = box.radius * random.uniform(0.3, 1.4) * random.unit_vector();
    const Pose<double> frame = random.pose(3 * size);
    const PlacedShapes to_box =
        test::moved({Sphere<double>{radius}, {Quatd::Identity(), center}, box, {}}, frame);
    PlacedShapes to_field = to_box;
    to_field.b = field_of(box, {.cells = 12});
    const Manifolds<double> expected = manifolds_of(to_box), found = manifolds_of(to_field);
    ASSERT_EQ(found.size(), expected.size()) << i;
    if (found.empty()) continue;
    ++touching;
    EXPECT_NEAR(deepest_of(found), deepest_of(expected), 1e-12 * size) << i;
    EXPECT_GT(found[0].normal.dot(expected[0].normal), 1 - 1e-9) << i;
    EXPECT_LT((found[0].points[0].position - expected[0].points[0].position).norm(), 1e-9 * size);
  }
  EXPECT_GT(touching, 50);
}

TEST(FieldPairs, SlowAHullThatCrossesAMeshIsNeverMissed) {
  // Overlap: triangles that share a point, exactly, or a corner inside, by its winding number.
  Random random(2);
  int overlapping = 0, spacing = 0, false_alarms = 0;
  for (int i = 0; i < 400; ++i) {
    const double size = random.decade(-4, 4);
    const Mesh<double> mesh = test::built(test::sphere_mesh(size, 12, 9, 0.3));
    const Hull<double> hull = test::random_hull(random, 8, size * random.uniform(0.02, 0.6), 30);
    Pose<double> hull_in_mesh = random.pose(0);
    hull_in_mesh.position = size * random.uniform(0.8, 1.5) * random.unit_vector();
    bool truth = mesh_overlap(mesh, surface_of(hull), hull_in_mesh).overlapping();
    for (const Vec3d& vertex : hull.vertices)
      truth |= winding_number(mesh, hull_in_mesh.transform(vertex)).number != 0;
    const PlacedShapes pair = test::moved(
        {hull, hull_in_mesh, field_of(mesh, {.cells = 16, .band = 1}), {}}, random.pose(size));
    const Manifolds<double> found = manifolds_of(pair);
    (truth ? overlapping : spacing)++;
    if (truth) {
      ASSERT_FALSE(found.empty()) << i;
    } else if (!found.empty()) {
      // Closer than a fraction of a cell, as the separation shows.
      ++false_alarms;
      const double cell = std::get<Field<double>>(pair.b).cell;
      EXPECT_GT(deepest_of(found), -1e-12 * size);
      EXPECT_LT(deepest_of(found), 2 * kFieldTolerance * cell);
    }
  }
  EXPECT_GT(overlapping, 100);
  EXPECT_GT(spacing, 100);
  EXPECT_LT(false_alarms, 3);
}

TEST(FieldPairs, SamplesMissANeedleThatTheBoundFinds) {
  // A needle sticks out of a block, through the middle of another block's face.
  const Hull<double> floor = make_box(Vec3d(1, 0.1, 1));
  const Hull<double> needle = make_box(Vec3d(0.003, 0.5, 0.003));
  int missed = 0;
  for (int i = 0; i < 20; ++i) {
    // Here the needle is the field and ends in the floor: no corner of the floor is near.
    const PlacedShapes pair{floor, test::at(0, 0, 0), field_of(needle, {.cells = 64}),
                            test::at(0.031 * i, 0.55, 0.017 * i)};
    EXPECT_FALSE(manifolds_of(pair).empty()) << i;
    missed += manifolds_of(pair, {.field = FieldSearch::Sampled}).empty() ? 1 : 0;
  }
  EXPECT_GT(missed, 10);
}

TEST(FieldPairs, ABoxOnAFieldHasItsCornersAndKeepsTheirNames) {
  const Shape<double> floor = field_of(make_box(Vec3d(2, 0.5, 2)), {.cells = 32});
  const auto names = [&](double x) {
    const PlacedShapes pair{floor, test::at(0, -0.5, 0), make_box(Vec3d(0.5, 0.5, 0.5)),
                            test::at(x, 0.49, 0.1)};
    const Manifolds<double> found = manifolds_of(pair, {.reducer = find_reducer(kDefaultReducer)});
    EXPECT_EQ(found.size(), 1U);
    EXPECT_LT((found[0].normal - Vec3d::UnitY()).norm(), 1e-12);
    EXPECT_EQ(found[0].points.size(), 4U);
    for (const ContactPoint<double>& point : found[0].points) {
      EXPECT_NEAR(point.separation, -0.01, 1e-12);
      EXPECT_NEAR(std::abs(point.position.x() - x), 0.5, 1e-12);
      EXPECT_NEAR(point.position.y(), 0, 1e-12);
    }
    return test::sorted_ids(found[0]);
  };
  const std::vector<FeatureId> before = names(0.1);
  EXPECT_EQ(names(0.1001), before);
  EXPECT_EQ(names(0.3), before);
}

/// Largest area of four corners of a planar convex polygon, given in order; square metres.
double largest_of_four(const std::vector<Vec3d>& corners) {
  double largest = 0;
  const std::size_t count = corners.size();
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j)
      for (std::size_t k = j + 1; k < count; ++k)
        for (std::size_t l = k + 1; l < count; ++l)
          largest = std::max(largest,
                             0.5 * (corners[k] - corners[i]).cross(corners[l] - corners[j]).norm());
  return largest;
}

/// A prism of 4 to 10 sides slides for 50 frames on the flat face of a field, anywhere. All its
/// corners are equally deep except for rounding, which must never change the selected points.
/// Returns the number of changes.
template <class S> int jumps_of_a_prism(Random& random) {
  const double size = random.decade(-4, 4);
  const int sides = 4 + random.index(7);
  std::vector<Vec3d> corners;
  const double flat = random.uniform(0.4, 1);
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * (i + random.uniform(0, 0.8)) / sides;
    corners.push_back(0.5 * size * Vec3d(std::cos(angle), 0, flat * std::sin(angle)));
  }
  const double largest = largest_of_four(corners);
  std::vector<Vec3d> vertices = corners;
  for (const Vec3d& corner : corners) vertices.push_back(corner + Vec3d(0, size, 0));
  const Shape<double> prism = build_hull(vertices);
  const Shape<double> floor =
      field_of(make_box(size * Vec3d(1.5, 0.5, 1.5)), {.cells = 12 + random.index(30)});
  const Pose<double> frame = random.pose(2 * size);
  const Quatd turned = test::about(Vec3d::UnitY(), random.uniform(-3, 3));
  const Vec3d from = random.level(0.8 * size, 0.49 * size),
              to = random.level(0.8 * size, 0.49 * size);
  int jumps = 0;
  std::vector<FeatureId> before;
  for (int i = 0; i <= 50; ++i) {
    const PlacedShapes pair =
        test::moved({prism, {turned, from + 0.02 * i * (to - from)}, floor, {}}, frame);
    const Manifolds<S> found = manifolds_of<S>(pair, {.reducer = find_reducer(kDefaultReducer)});
    EXPECT_EQ(found.size(), 1U);
    if (found.size() != 1 || found[0].points.size() != 4) return 50;
    std::vector<Vec3d> kept;
    for (const ContactPoint<S>& point : found[0].points)
      kept.push_back(point.position.template cast<double>());
    double area = 0;  // of the four points, in any order
    for (const auto& [p, q, r, s] : {std::array{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 1, 3, 2}})
      area =
          std::max(area, 0.5 * (at(kept, r) - at(kept, p)).cross(at(kept, s) - at(kept, q)).norm());
    EXPECT_NEAR(area, largest, 1e-4 * largest);
    const std::vector<FeatureId> now = test::sorted_ids(found[0]);
    jumps += i > 0 && now != before ? 1 : 0;
    before = now;
  }
  return jumps;
}

TEST(FieldPairs, SlowAPrismThatSlidesOnAFieldKeepsItsPoints) {
  Random random(5);
  int jumps = 0;
  const int prisms = test::cases(2'000) / 50;  // a case is a frame
  for (int i = 0; i < prisms; ++i) {
    SCOPED_TRACE(i);
    jumps += i % 2 == 0 ? jumps_of_a_prism<double>(random) : jumps_of_a_prism<float>(random);
  }
  EXPECT_LE(jumps, 1 + prisms / 100);
}

TEST(FieldPairs, AFieldOnAPlaneTouchesWithTheCornersOfItsShape) {
  const Hull<double> box = make_box(Vec3d(0.5, 0.4, 0.3));
  for (const double tilt : {0.0, 0.1, 0.7}) {
    const PlacedShapes as_hull{
        test::ground(), {}, box, {test::about({1, 0, 2}, tilt), {0.3, 0.38, 0}}};
    PlacedShapes as_field = as_hull;
    as_field.b = field_of(box, {.cells = 8});
    const Manifolds<double> expected = manifolds_of(as_hull), found = manifolds_of(as_field);
    ASSERT_EQ(found.size(), expected.size());
    EXPECT_EQ(found[0].points.size(), expected[0].points.size());
    EXPECT_NEAR(deepest_of(found), deepest_of(expected), 1e-15);
    EXPECT_LT((found[0].normal - expected[0].normal).norm(), 1e-15);
  }
}

TEST(FieldPairs, RoundShapesMeshesAndOtherFieldsMeetAField) {
  const Shape<double> floor = field_of(make_box(Vec3d(1, 0.5, 1)), {.cells = 24});
  const Shape<double> ball = field_of(Sphere<double>{0.5}, {.cells = 24});
  const Mesh<double> wavy = test::built(test::sphere_mesh(0.5, 24, 17, 0));
  const auto depth = [&](const Shape<double>& shape, double height) {
    return -deepest_of(manifolds_of({shape, test::at(0.1, 0.5 + height, 0.1), floor, {}}));
  };
  EXPECT_NEAR(depth(test::lying_capsule(0.3, 0.2), 0.19), 0.01, 1e-12);
  EXPECT_NEAR(depth(test::upright_capsule(0.3, 0.2), 0.45), 0.05, 1e-12);
  EXPECT_NEAR(depth(ball, 0.48), 0.02, 1e-12);
  // Poles are on z; the lowest vertices of the mesh are on y.
  EXPECT_NEAR(depth(wavy, 0.48), 0.02, 2e-3);
  EXPECT_NEAR(depth(field_of(wavy, {.cells = 24}), 0.48), 0.02, 2e-3);
  EXPECT_EQ(depth(ball, 0.51), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(depth(test::lying_capsule(0.3, 0.2), 0.21), -std::numeric_limits<double>::infinity());
}

TEST(FieldPairs, AShapeWhollyInsideIsFound) {
  const Shape<double> small = field_of(make_box(Vec3d(0.1, 0.1, 0.1)), {.cells = 8});
  const Shape<double> large = field_of(make_box(Vec3d(1, 1, 1)), {.cells = 8});
  const Pose<double> inside = test::at(0.5, 0, 0);
  // With a margin the wall is within reach.
  for (const double margin : {0.0, 0.45}) {
    const auto outward = [&](const Shape<double>& a, const Shape<double>& b,
                             const Pose<double>& b_in_a) {
      CollideOptions options;
      options.margin = margin;
      const Manifolds<double> found = manifolds_of({a, {}, b, b_in_a}, options);
      EXPECT_FALSE(found.empty());
      return deepest_of(found);
    };
    // By the small field's far corner; for two fields, by the deepest of the surface's points.
    EXPECT_NEAR(outward(make_box(Vec3d(1, 1, 1)), small, inside), -0.6, 1e-12);
    EXPECT_LE(outward(large, small, inside), -0.5);
    EXPECT_LE(outward(small, large, test::at(-0.5, 0, 0)), -0.5);
    // The distance of the ball's centre from the small box, minus its radius.
    EXPECT_NEAR(outward(Sphere<double>{2}, small, inside), 0.4 - 2, 1e-12);
  }
}

/// The separation in the trace.
template <class S = double>
double recorded_separation(const PlacedShapes& pair, const CollideOptions& options = {}) {
  Manifolds<S> manifolds;
  trace::Pair record;
  collide(shape_cast<S>(pair.a), pair.pose_a.cast<S>(), shape_cast<S>(pair.b),
          pair.pose_b.cast<S>(), options, manifolds, nullptr, &record);
  EXPECT_EQ(record.state == "separated", manifolds.empty());
  return record.separation;
}

TEST(FieldPairs, ABoxOnAFieldKeepsItsFourCornersAmongManySamples) {
  // The upper box's side is a fraction of the lower one's: at least 256 samples, four corners.
  for (const double height : {1.49, 1.5 - 1e-9}) {
    const PlacedShapes pair{field_of(make_box(Vec3d(1, 1, 1))),
                            {},
                            make_box(Vec3d(0.5, 0.5, 0.5)),
                            test::at(0, height, 0)};
    const Manifolds<double> found = manifolds_of(pair);
    ASSERT_EQ(found.size(), 1U);
    std::set<std::pair<double, double>> corners;
    for (const ContactPoint<double>& point : found[0].points)
      if (std::abs(std::abs(point.position.x()) - 0.5) < 1e-12 &&
          std::abs(std::abs(point.position.z()) - 0.5) < 1e-12)
        corners.insert({std::round(2 * point.position.x()), std::round(2 * point.position.z())});
    EXPECT_EQ(corners.size(), 4U) << height;
  }
}

TEST(FieldPairs, SlowNoLimitOfPointsDropsTheOutlineOrTheDeepestPoint) {
  // A wheel's cap with more vertices than a manifold can hold, and a plane or a field below it.
  Random random(11);
  constexpr int kRing = 3 * static_cast<int>(kMaxManifoldPoints);
  for (int i = 0; i < 20; ++i) {
    const double size = random.decade(-4, 4);
    const double radius = 0.9 * size;
    Mesh<double> wheel;
    wheel.vertices = {Vec3d(0, -0.011 * size, 0), Vec3d(0, 0.3 * size, 0)};  // the hub is deepest
    for (int k = 0; k < kRing; ++k) {
      const double angle = 2 * std::numbers::pi * k / kRing;
      wheel.vertices.push_back({radius * std::cos(angle), -0.01 * size, radius * std::sin(angle)});
    }
    for (int k = 0; k < kRing; ++k) {
      const int from = 2 + k, to = 2 + (k + 1) % kRing;
      wheel.triangles.push_back({0, from, to});
      wheel.triangles.push_back({1, to, from});
    }
    const Mesh<double> mesh = build_mesh(wheel.vertices, wheel.triangles);
    const Pose<double> frame = random.pose(3 * size);
    const Shape<double> floor = field_of(make_box(size * Vec3d(1, 0.5, 1)), {.cells = 16});
    const PlacedShapes on_field{mesh, {}, floor, test::at(0, -0.5 * size, 0)};
    const PlacedShapes on_plane{field_of(mesh, {.cells = 16}), {}, test::ground(), {}};
    for (const PlacedShapes& pair : {on_field, on_plane}) {
      const PlacedShapes placed = test::moved(pair, frame);
      const Manifolds<double> found = manifolds_of(placed);
      ASSERT_FALSE(found.empty());
      EXPECT_NEAR(deepest_of(found), -0.011 * size, 1e-9 * size);
      // The points reach as far as the ring in every direction.
      double least_reach = std::numeric_limits<double>::infinity();
      for (int k = 0; k < 64; ++k) {
        const double angle = 2 * std::numbers::pi * k / 64;
        const Vec3d along = frame.rotate(Vec3d(std::cos(angle), 0, std::sin(angle)));
        double reach = 0;
        for (const ContactPoint<double>& point : found[0].points)
          reach = std::max(reach, along.dot(Vec3d(point.position - frame.position)));
        least_reach = std::min(least_reach, reach);
      }
      EXPECT_GT(least_reach, 0.99 * radius);
    }
  }
}

TEST(FieldPairs, ASeparatedSphereIsAsFarAsFromTheBoxItself) {
  const PlacedShapes near{Sphere<double>{0.2},
                          test::at(-0.8126, 0.83614, 0.04694),
                          field_of(make_box(Vec3d(1, 0.6, 0.8)), {.cells = 24}),
                          {}};
  EXPECT_NEAR(recorded_separation(near), 0.83614 - 0.6 - 0.2, 1e-15);
  Random random(12);
  for (const int cells : {12, 24, 48}) {
    const Vec3d half(1, 0.6, 0.8);
    const Shape<double> field = field_of(make_box(half), {.cells = cells});
    for (int i = 0; i < test::cases(5000); ++i) {
      const Vec3d centre = random.vector(-1, 1).cwiseProduct(Vec3d(2, 1.6, 1.8));
      const double gap = (centre.cwiseAbs() - half).cwiseMax(0.0).norm();
      if (gap == 0) continue;
      const double radius = gap * random.uniform(0.05, 0.98);
      const PlacedShapes pair = test::moved(
          {Sphere<double>{radius}, {Quatd::Identity(), centre}, field, {}}, random.pose(1));
      ASSERT_NEAR(recorded_separation(pair), gap - radius, 1e-14) << cells << ", " << i;
    }
  }
}

TEST(FieldPairs, SlowASeparatedHullIsAsFarAsFromTheHullThatTheFieldIsMadeOf) {
  Random random(13);
  int separated = 0;
  for (int i = 0; i < test::cases(1500) / 5; ++i) {
    const double size = random.decade(-4, 4);
    const Hull<double> source = test::random_hull(random, 10, size, 5);
    const Shape<double> field = field_of(source, {.cells = 12});
    for (int k = 0; k < 5; ++k) {
      const Hull<double> hull = test::random_hull(random, 8, size * random.uniform(0.1, 1), 10);
      PlacedShapes pair{hull, random.pose(1.5 * size), field, random.pose(1.5 * size)};
      const test::Features features = test::features_of(hull, pair.pose_a);
      const test::Features features_of_source = test::features_of(source, pair.pose_b);
      const auto truth =
          static_cast<double>(test::brute_force_distance(features, features_of_source).distance);
      if (truth < 1e-9 * size) continue;
      ++separated;
      if (k % 2 == 1) {
        std::swap(pair.a, pair.b);
        std::swap(pair.pose_a, pair.pose_b);
      }
      ASSERT_NEAR(recorded_separation(pair), truth, 1e-12 * size) << i;
    }
  }
  EXPECT_GT(separated, 300);
}

TEST(FieldPairs, ASeparatedMeshIsAsFarAsItsNearestTriangle) {
  // One triangle is near a corner of the field's box; the other one is nearer to its surface.
  Random random(14);
  for (int i = 0; i < 100; ++i) {
    const double size = random.decade(-4, 4), gap = size * random.uniform(0.01, 0.5);
    Mesh<double> two;
    const auto add = [&](const Vec3d& corner) {
      const int first = count_of(two.vertices);
      for (const Vec3d& to : {Vec3d(0, 0, 0), Vec3d(0.1, 0, 0), Vec3d(0, 0, 0.1)})
        two.vertices.push_back(size * (corner + to));
      two.triangles.push_back({first, first + 2, first + 1});
    };
    add({0.9, 0.9, 0.9});
    add({0.0, 1 + gap / size, 0.0});
    const PlacedShapes pair{build_mesh(two.vertices, two.triangles),
                            {},
                            field_of(Sphere<double>{size}, {.cells = 16}),
                            {}};
    EXPECT_NEAR(recorded_separation(test::moved(pair, random.pose(size))), gap, 1e-13 * size);
  }
}

TEST(FieldPairs, SwappingTheArgumentsMirrorsTheContact) {
  const Shape<double> field = field_of(make_box(Vec3d(1, 0.5, 1)), {.cells = 16});
  const Shape<double> box = make_box(Vec3d(0.3, 0.3, 0.3));
  const Pose<double> pose{test::about({1, 2, 3}, 0.4), {0.1, 0.9, 0.2}};
  const Manifolds<float> there = manifolds_of<float>({field, {}, box, pose});
  const Manifolds<float> back = manifolds_of<float>({box, pose, field, {}});
  ASSERT_FALSE(there.empty());
  ASSERT_EQ(there.size(), back.size());
  EXPECT_EQ(there[0].normal, Vec3f(-back[0].normal));
  ASSERT_EQ(there[0].points.size(), back[0].points.size());
  EXPECT_EQ(there[0].points[0].position, back[0].points[0].position);
  EXPECT_EQ(there[0].points[0].id, back[0].points[0].id.flipped());
}

}  // namespace
}  // namespace contactscope
