#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geometry/primitives.h"
#include "geometry/triangle_hull.h"
#include "manifold/placed_shapes.h"
#include "support/brute_force_distance.h"
#include "support/brute_force_sat.h"
#include "support/builders.h"

namespace contactscope {
namespace {

using test::about;
using test::at;
using test::deepest_of;
using test::kDegree;
using test::manifolds_of;
using test::PlacedShapes;

/// Largest angle between a normal and `direction`, radians.
template <class S> double worst_turn(const Manifolds<S>& manifolds, const Vec3d& direction) {
  double worst = 0;
  for (const Manifold<S>& manifold : manifolds) {
    const Vec3d normal = manifold.normal.template cast<double>();
    worst = std::max(worst, std::atan2(normal.cross(direction).norm(), normal.dot(direction)));
  }
  return worst;
}

/// A triangle of about `size` metres, up to `aspect` times narrower than long.
Mesh<double> random_triangle(test::Random& random, double size, double aspect) {
  const Quatd turn = random.rotation();
  const double narrow = size / (aspect > 1 ? random.decade(0, std::log10(aspect)) : 1);
  std::vector<Vec3d> corners = {{-0.5 * size, 0, 0}, {0.5 * size, 0, 0}};
  corners.push_back({size * random.uniform(-0.4, 0.4), 0, narrow});
  for (Vec3d& corner : corners) corner = turn * corner;
  return build_mesh(corners, {{{0, 1, 2}}});
}

test::Features features_of_triangle(const Mesh<double>& mesh, int triangle,
                                    const Pose<double>& pose) {
  test::Features features;
  for (int k = 0; k < 3; ++k)
    features.vertices.push_back(pose.transform(mesh.corner(triangle, k)).cast<test::Extended>());
  features.edges = {{0, 1}, {1, 2}, {2, 0}};
  features.triangles = {{0, 1, 2}, {0, 2, 1}};  // both sides, or the oracle would see an inside
  return features;
}

/// Without its face: points in the plane of the triangle are in front of neither side.
test::Features outline_of_triangle(const Mesh<double>& mesh, const Pose<double>& pose) {
  test::Features features = features_of_triangle(mesh, 0, pose);
  features.triangles.clear();
  return features;
}

bool inside_prism(const Mesh<double>& mesh, const Vec3d& point) {
  bool inside = true;
  for (int k = 0; k < 3; ++k) {
    const Vec3d& from = mesh.corner(0, k);
    const Vec3d outward = (mesh.corner(0, (k + 1) % 3) - from).cross(mesh.normal(0));
    inside = inside && outward.dot(point - from) <= 0;
  }
  return inside;
}

Mesh<double> mesh_rounded_to_float(const Mesh<double>& mesh) {
  std::vector<Vec3d> vertices;
  for (const Vec3d& vertex : mesh.vertices) vertices.push_back(vertex.cast<float>().cast<double>());
  return build_mesh(vertices, mesh.triangles);
}

// ---------------------------------------------------------------------------------------------
// One triangle

TEST(MeshPairs, ASphereIsAsFarFromATriangleAsItsClosestPoint) {
  test::Random random(11);
  int touching = 0;
  for (int i = 0; i < 4000; ++i) {
    const double size = random.decade(-4, 4);
    const Mesh<double> mesh = random_triangle(random, size, 1000);
    PlacedShapes pair{test::ball(size * random.decade(-3, 0)), random.pose(0.8 * size), mesh,
                      random.pose(0.2 * size)};
    const double radius = std::get<Sphere<double>>(pair.a).radius;
    const test::Features center = test::features_of_point(Vec3d::Zero(), pair.pose_a);
    const test::Features triangle = features_of_triangle(mesh, 0, pair.pose_b);
    const double separation =
        static_cast<double>(test::brute_force_distance(center, triangle).distance) - radius;
    const Manifolds<double> manifolds = manifolds_of<double>(pair);
    const double tolerance = 16 * std::numeric_limits<double>::epsilon() * size;
    if (std::abs(separation) > tolerance) {
      ASSERT_EQ(manifolds.empty(), separation > 0) << i;
    }
    if (manifolds.empty()) continue;
    ++touching;
    ASSERT_NEAR(deepest_of(manifolds), separation, tolerance) << i;
    ASSERT_EQ(manifolds[0].triangle, -1);
  }
  EXPECT_GT(touching, 400);
}

TEST(MeshPairs, ACapsuleNextToATriangleHasTheClosestDistance) {
  test::Random random(12);
  int touching = 0;
  for (int i = 0; i < 4000; ++i) {
    const double size = random.decade(-4, 4);
    const Mesh<double> mesh = random_triangle(random, size, 100);
    PlacedShapes pair{
        test::upright_capsule(size * random.uniform(0, 1), size * random.decade(-2, 0)),
        random.pose(size), mesh, random.pose(0.2 * size)};
    // Some in the plane of the triangle, within rounding.
    const bool in_plane = i % 4 == 0;
    if (in_plane) {
      const Vec3d& normal = mesh.normal(0);
      pair.pose_b = {};
      const Vec3d along = normal.cross(random.unit_vector()).normalized();
      pair.pose_a.rotation = Quatd::FromTwoVectors(Vec3d::UnitY(), along).normalized();
      pair.pose_a.position -= normal.dot(pair.pose_a.position - mesh.corner(0, 0)) * normal;
    }
    const test::Core core = test::core_of(pair.a, pair.pose_a);
    const test::Features segment = test::features_of_segment(core.from, core.to, {});
    const double distance = static_cast<double>(
        test::brute_force_distance(segment, in_plane ? outline_of_triangle(mesh, pair.pose_b)
                                                     : features_of_triangle(mesh, 0, pair.pose_b))
            .distance);
    const double tolerance = 32 * std::numeric_limits<double>::epsilon() * size;
    if (distance < tolerance) continue;  // crossing
    if (in_plane && inside_prism(mesh, core.at(0.5))) continue;
    const double separation = distance - core.radius;
    const Manifolds<double> manifolds = manifolds_of<double>(pair);
    if (std::abs(separation) > tolerance) {
      ASSERT_EQ(manifolds.empty(), separation > 0) << i;
    }
    if (manifolds.empty()) continue;
    ++touching;
    ASSERT_NEAR(deepest_of(manifolds), separation, tolerance) << i;
  }
  EXPECT_GT(touching, 400);
}

// ReactPhysics3D issue 347, at every angle, including the triangle's own plane.
TEST(MeshPairs, ACapsuleAlongAnEdgeHasTwoPointsWhereverItIsAboutTheEdge) {
  test::Random random(14);
  for (int i = 0; i < 2000; ++i) {
    const double size = random.decade(-4, 4);
    const std::vector<Vec3d> corners = {{-size, 0, 0}, {size, 0, 0}, {0, 0, -0.8 * size}};
    const Mesh<double> mesh = build_mesh(corners, {{{0, 1, 2}}});
    // From the triangle's plane to the perpendicular.
    const double up = i % 2 == 0 ? 0 : random.uniform(-1, 1) * std::numbers::pi / 2;
    const Vec3d displacement(0, std::sin(up), std::cos(up));
    const double radius = 0.1 * size, distance = 0.9 * radius, half = 0.5 * size;
    const Pose<double> world = random.pose(size);
    const Capsule<double> capsule{{Vec3d(-half, 0, 0), Vec3d(half, 0, 0)}, radius};
    Pose<double> pose = world;
    pose.position = world.transform(distance * displacement);
    const PlacedShapes pair{capsule, pose, mesh, world};
    const Manifolds<double> manifolds = manifolds_of<double>(pair);
    ASSERT_EQ(manifolds.size(), 1u) << i;
    ASSERT_EQ(manifolds[0].points.size(), 2u) << i << ", " << up << " rad";
    EXPECT_LT((manifolds[0].normal + world.rotate(displacement)).norm(), 1e-12) << i;
    const double tolerance = 64 * std::numeric_limits<double>::epsilon() * size;
    double ends = 0;
    for (const ContactPoint<double>& point : manifolds[0].points) {
      EXPECT_NEAR(point.separation, distance - radius, tolerance) << i;
      const Vec3d local = world.inverse_transform(point.position);
      EXPECT_NEAR(std::abs(local.x()), half, tolerance) << i;
      ends += local.x();
    }
    EXPECT_NEAR(ends, 0, tolerance) << i;
    EXPECT_NE(manifolds[0].points[0].id, manifolds[0].points[1].id) << i;
  }
}

TEST(MeshPairs, AHullOverlapsATriangleByTheShallowestOfAllAxes) {
  test::Random random(13);
  int touching = 0;
  CollideOptions exact;
  exact.preference = Preference::None;
  for (int i = 0; i < 3000; ++i) {
    const double size = random.decade(-4, 4);
    const Mesh<double> mesh = random_triangle(random, size, 20);
    const Hull<double> hull =
        i % 2 == 0 ? test::random_box(random, size, 4) : test::random_hull(random, 12, size, 3);
    const PlacedShapes pair{hull, random.pose(0.8 * size), mesh, random.pose(0.2 * size)};
    TriangleHull<double> triangle;
    triangle.set(mesh, 0);
    Pose<double> pose = pair.pose_b;
    pose.position = pair.pose_b.transform(triangle.origin);
    const double separation =
        test::brute_force_sat(hull, pair.pose_a, triangle.hull, pose).separation;
    const Manifolds<double> manifolds = manifolds_of<double>(pair, exact);
    const double tolerance = 64 * std::numeric_limits<double>::epsilon() * size;
    if (std::abs(separation) > tolerance) {
      ASSERT_EQ(manifolds.empty(), separation > 0) << i;
    }
    if (manifolds.empty()) continue;
    ++touching;
    ASSERT_NEAR(deepest_of(manifolds), separation, tolerance) << i;
  }
  EXPECT_GT(touching, 400);
}

// JoltPhysics issue 1488. Near one corner of the triangle its other corners are far above the box's
// lower side, so by depth the box's face is as good as the triangle's.
TEST(MeshPairs, ABoxTiltedALittleOnALargeTriangleTakesTheTrianglesNormal) {
  for (const double scale : {1e-3, 1.0, 1e3}) {
    const Mesh<double> ground = build_mesh(
        {Vec3d(0, 0, 0), Vec3d(0, 0, 100 * scale), Vec3d(100 * scale, 0, 0)}, {{{0, 1, 2}}});
    for (const double tilt : {-1e-3, -1e-4, 1e-4, 1e-3}) {
      for (const Vec3d& about : {Vec3d(1, 0, 0), Vec3d(0, 0, 1), Vec3d(1, 0, -1)}) {
        for (const double displacement : {0.1, 0.3, 0.6}) {
          Pose<double> pose = at(displacement * scale, 0.199 * scale, displacement * scale);
          pose.rotation = test::about(about, tilt);
          const PlacedShapes pair{make_box(scale * Vec3d(0.3, 0.2, 0.4)), pose, ground, {}};
          EXPECT_LT(worst_turn(manifolds_of<double>(pair), Vec3d(0, -1, 0)), 1e-12)
              << "tilt " << tilt << ", way " << displacement << ", scale " << scale;
          EXPECT_LT(worst_turn(manifolds_of<float>(pair), Vec3d(0, -1, 0)), 1e-5)
              << "tilt " << tilt << ", way " << displacement << ", scale " << scale;
          ASSERT_EQ(manifolds_of<double>(pair).size(), 1u);
        }
      }
    }
  }
}

// ---------------------------------------------------------------------------------------------
// A flat floor of many triangles is a floor

struct Slider {
  const char* name;
  Shape<double> shape;
  double height;  // of its centre when it rests on the floor
};

std::vector<Slider> sliders(double size) {
  return {{"sphere", test::ball(0.4 * size), 0.4 * size},
          {"box", test::cube(0.4 * size), 0.4 * size},
          {"lying capsule", test::lying_capsule(0.5 * size, 0.2 * size), 0.2 * size},
          {"upright capsule", test::upright_capsule(0.5 * size, 0.2 * size), 0.7 * size},
          {"cylinder", make_cylinder(0.4 * size, 0.3 * size, 12), 0.3 * size}};
}

/// Slides across the floor at an angle, sunk by 1 % of its size.
template <class S>
void slide(const Slider& slider, double size, bool internal_edges, double& worst_angle,
           double& worst_depth, int& least_manifolds) {
  const Mesh<double> floor = make_grid(8 * size, 8 * size, 8, 8, 0);
  CollideOptions options;
  options.internal_edges = internal_edges;
  const double depth = 0.01 * size;
  worst_angle = worst_depth = 0;
  least_manifolds = 1000;
  for (int step = 0; step < 300; ++step) {
    const double displacement = (step / 300.0 - 0.5) * 4 * size;
    Pose<double> pose = at(displacement, slider.height - depth, 0.37 * displacement + 0.013 * size);
    pose.rotation = about(Vec3d::UnitY(), 0.3);
    const Manifolds<S> manifolds = manifolds_of<S>({slider.shape, pose, floor, {}}, options);
    worst_angle = std::max(worst_angle, worst_turn(manifolds, Vec3d(0, -1, 0)));
    worst_depth = std::max(worst_depth, std::abs(deepest_of(manifolds) + depth));
    least_manifolds = std::min(least_manifolds, static_cast<int>(manifolds.size()));
  }
}

TEST(MeshPairs, SlowNothingTripsOverTheEdgesOfAFlatFloor) {
  for (const double size : {1e-3, 1.0, 1e3}) {
    for (const Slider& slider : sliders(size)) {
      double angle, depth;
      int manifolds;
      slide<double>(slider, size, true, angle, depth, manifolds);
      EXPECT_LT(angle, 1e-12) << slider.name << ", size " << size;
      EXPECT_LT(depth, 1e-14 * size) << slider.name << ", size " << size;
      EXPECT_GE(manifolds, 1) << slider.name << ", size " << size;
      slide<float>(slider, size, true, angle, depth, manifolds);
      EXPECT_LT(angle, 1e-5) << slider.name << ", size " << size;
      EXPECT_LT(depth, 1e-5 * size) << slider.name << ", size " << size;
      EXPECT_GE(manifolds, 1) << slider.name << ", size " << size;
    }
  }
}

/// Places on the edges and corners of the floor's cells. Each is approached along a line in none of
/// them, from a nanometre to a tenth of a millimetre, on both sides.
template <class Visit> void next_to_edges(double size, const Visit& visit) {
  for (const Vec3d& on_edge :
       {Vec3d(0, 0, 0.3), Vec3d(0.3, 0, 1), Vec3d(0.5, 0, 0.5), Vec3d(1, 0, -1)})
    for (const Vec3d& displacement : {Vec3d(0.9, 0, 0.2), Vec3d(-0.9, 0, -0.2)})
      for (double offset = 1e-9; offset < 2e-4; offset *= 3)
        visit(Vec3d(size * (on_edge + offset * displacement)));
}

TEST(MeshPairs, NothingFeelsAnEdgeOfAFlatFloorAtAnyDistance) {
  for (const double size : {1e-3, 1.0, 1e3}) {
    const Mesh<double> floor = make_grid(8 * size, 8 * size, 8, 8, 0);
    for (const Slider& slider : sliders(size)) {
      next_to_edges(size, [&](const Vec3d& place) {
        Pose<double> pose{about(Vec3d::UnitY(), 0.3), place};
        pose.position.y() = slider.height - 0.01 * size;
        const PlacedShapes pair{slider.shape, pose, floor, {}};
        const Manifolds<double> in_double = manifolds_of<double>(pair);
        ASSERT_LT(worst_turn(in_double, Vec3d(0, -1, 0)), 1e-14) << slider.name << place;
        ASSERT_NEAR(deepest_of(in_double), -0.01 * size, 1e-15 * size) << slider.name << place;
        const Manifolds<float> in_float = manifolds_of<float>(pair);
        ASSERT_LT(worst_turn(in_float, Vec3d(0, -1, 0)), 8e-6) << slider.name << place;
        ASSERT_NEAR(deepest_of(in_float), -0.01 * size, 1e-6 * size) << slider.name << place;
        if (slider.name != std::string("sphere")) return;
        ASSERT_EQ(in_double.size(), 1u) << place;
        ASSERT_EQ(in_double[0].points[0].id.second.kind, FeatureKind::Face) << place;
      });
    }
  }
}

// The option exists to show the problem, so there must be one.
TEST(MeshPairs, WithoutTheCareForInternalEdgesABoxTripsOverThem) {
  double angle, depth;
  int manifolds;
  slide<double>(sliders(1)[1], 1, false, angle, depth, manifolds);
  EXPECT_GT(angle, 80 * kDegree);
  slide<double>(sliders(1)[0], 1, false, angle, depth, manifolds);
  EXPECT_GT(angle, 5 * kDegree);
}

TEST(MeshPairs, ABoxOnAFloorFindsItsWholeFaceSupported) {
  const Mesh<double> floor = make_grid(8, 8, 8, 8, 0);
  const PlacedShapes pair{
      test::cube(0.7), {about(Vec3d::UnitY(), 0.3), {0.1, 0.69, 0.2}}, floor, {}};
  for (const double x : {-1.0, 1.0})
    for (const double z : {-1.0, 1.0}) {
      const Vec3d corner = pair.pose_a.transform(Vec3d(0.7 * x, -0.7, 0.7 * z));
      double least = 1;
      for (const Manifold<double>& manifold : manifolds_of<double>(pair))
        least = std::min(least, test::distance_to_nearest(manifold, corner));
      EXPECT_LT(least, 0.011);  // moved onto the face of either
    }
}

// ---------------------------------------------------------------------------------------------
// Ridges, valleys and closed bodies

Mesh<double> mesh_of_cube(double half) {
  const Hull<double> box = test::cube(half);
  std::vector<std::array<int, 3>> triangles;
  for (int face = 0; face < box.face_count(); ++face) {
    const std::vector<int> corners = face_vertices(box, face);
    triangles.push_back({corners[0], corners[1], corners[2]});
    triangles.push_back({corners[0], corners[2], corners[3]});
  }
  return build_mesh(box.vertices, triangles);
}

// Real features stay: every edge and corner of the cube, but not its diagonals.
TEST(MeshPairs, ASphereTouchesTheMeshOfACubeAsItTouchesTheCube) {
  test::Random random(14);
  const Shape<double> cube = test::cube(0.5);
  const Shape<double> mesh = mesh_of_cube(0.5);
  int touching = 0;
  for (int i = 0; i < 3000; ++i) {
    const Pose<double> pose_a = random.pose(1.2);
    const double radius = random.uniform(0.05, 0.4);
    if (pose_a.position.cwiseAbs().maxCoeff() < 0.5) continue;  // a mesh has no inside
    const Manifold<double> solid =
        test::manifold_of<double>({test::ball(radius), pose_a, cube, {}});
    const Manifolds<double> surface = manifolds_of<double>({test::ball(radius), pose_a, mesh, {}});
    ASSERT_EQ(surface.empty(), solid.points.empty()) << i;
    if (surface.empty()) continue;
    ++touching;
    ASSERT_NEAR(deepest_of(surface), test::deepest(solid), 1e-14) << i;
    double nearest = 10;
    for (const Manifold<double>& manifold : surface)
      nearest = std::min(nearest, worst_turn<double>({manifold}, solid.normal));
    ASSERT_LT(nearest, 1e-7) << i;
  }
  EXPECT_GT(touching, 300);
}

TEST(MeshPairs, SlowOnATerrainTheDeepestPointIsTheClosestOfTheWholeSurface) {
  test::Random random(15);
  const Mesh<double> terrain = mesh_rounded_to_float(make_grid(10, 10, 20, 20, 0.5));
  int touching = 0;
  for (int i = 0; i < 300; ++i) {
    const double radius = random.uniform(0.05, 1);
    Pose<double> pose_a = random.pose(4);
    pose_a.position.y() = random.uniform(-0.2, 1.5);
    const test::Features center = test::features_of_point(Vec3d::Zero(), pose_a);
    double distance = 100;
    for (int triangle = 0; triangle < terrain.triangle_count(); ++triangle)
      distance = std::min(
          distance, static_cast<double>(test::brute_force_distance(
                                            center, features_of_triangle(terrain, triangle, {}))
                                            .distance));
    const Manifolds<double> manifolds =
        manifolds_of<double>({test::ball(radius), pose_a, terrain, {}});
    ASSERT_EQ(manifolds.empty(), distance > radius) << i;
    if (manifolds.empty()) continue;
    ++touching;
    ASSERT_NEAR(deepest_of(manifolds), distance - radius, 1e-13) << i;
  }
  EXPECT_GT(touching, 100);
}

TEST(MeshPairs, InAValleyASphereTouchesBothFacesAndNotTheEdgeBetween) {
  // Two slopes of 45 degrees that meet along the z axis, fronts up.
  const Mesh<double> valley =
      build_mesh({{0, 0, -2}, {0, 0, 2}, {2, 2, 0}, {-2, 2, 0}}, {{{0, 1, 2}}, {{1, 0, 3}}});
  const double radius = 0.5;
  const Pose<double> pose = at(0, radius * std::numbers::sqrt2 - 0.01, 0.1);
  const Manifolds<double> manifolds = manifolds_of<double>({test::ball(radius), pose, valley, {}});
  ASSERT_EQ(manifolds.size(), 2u);
  for (const Manifold<double>& manifold : manifolds) {
    EXPECT_NEAR(std::abs(manifold.normal.x()), std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(test::deepest(manifold), -0.01 * std::sqrt(0.5), 1e-12);
  }
}

TEST(MeshPairs, ABoxIsPushedOutBehindATriangleWhenItsCentreIsThere) {
  const Mesh<double> floor = make_grid(8, 8, 8, 8, 0);
  const Manifolds<double> manifolds =
      manifolds_of<double>({test::cube(0.5), at(0.1, -0.45, 0.2), floor, {}});
  ASSERT_FALSE(manifolds.empty());
  for (const Manifold<double>& manifold : manifolds) {
    EXPECT_NEAR(manifold.normal.y(), 1, 1e-12);
    EXPECT_NEAR(test::deepest(manifold), -0.05, 1e-12);
  }
}

// A centre on a triangle, its edges or corners has only the triangle's front as normal. The
// neighbours, which push sideways, must not replace a skipped contact.
template <class S> void expect_recorded_and_skipped(const PlacedShapes& pair, const Vec3d& front) {
  const trace::Pair recorded = test::record_of<S>(pair);
  ASSERT_TRUE(recorded.degenerate.has_value());
  EXPECT_EQ(recorded.degenerate->answer, "fallback");
  ASSERT_FALSE(recorded.manifolds.empty());
  for (const trace::Manifold& manifold : recorded.manifolds)
    EXPECT_GT(-front.dot(manifold.normal), 1 - 1e-6);
  CollideOptions skip;
  skip.degenerate = Degenerate::Skip;
  const trace::Pair skipped = test::record_of<S>(pair, skip);
  ASSERT_TRUE(skipped.degenerate.has_value());
  EXPECT_EQ(skipped.degenerate->answer, "skip");
  EXPECT_EQ(skipped.state, "separated");
  const double radius = std::get<Sphere<double>>(pair.a).radius;
  EXPECT_NEAR(skipped.separation, -radius, 1e-6 * radius);
}

TEST(MeshPairs, ACentreInTheSurfaceIsDegenerateAndCanBeSkipped) {
  test::Random random(16);
  for (const double size : {1e-4, 1.0, 1e4}) {
    const Mesh<double> grid = make_grid(4 * size, 4 * size, 8, 8, 0);
    for (const Vec3d& place : {Vec3d(0, 0, 0), Vec3d(0.25, 0, 0), Vec3d(0.1, 0, 0.2)}) {
      const PlacedShapes pair{test::ball(0.3 * size), {Quatd::Identity(), size * place}, grid, {}};
      for (int i = 0; i < 20; ++i) {
        const Pose<double> by = i == 0 ? Pose<double>() : random.pose(size);
        const PlacedShapes turned = test::moved(pair, by);
        expect_recorded_and_skipped<float>(turned, by.rotate(Vec3d::UnitY()));
        expect_recorded_and_skipped<double>(turned, by.rotate(Vec3d::UnitY()));
      }
    }
  }
}

// ---------------------------------------------------------------------------------------------
// Records

TEST(MeshPairs, ARecordHasTheTraversalOfTheTree) {
  const Mesh<double> floor = make_grid(8, 8, 16, 16, 0);
  const PlacedShapes pair{test::ball(0.3), at(0.1, 0.25, 0.2), floor, at(0, 0, 0)};
  CollideOptions by_triangle;
  by_triangle.mesh_manifolds = MeshManifolds::Triangle;
  const trace::Pair record = test::record_of<double>(pair, by_triangle);
  EXPECT_EQ(record.kind, "sphere-mesh");
  EXPECT_EQ(record.state, "touching");
  ASSERT_TRUE(record.tree.has_value());
  EXPECT_EQ(record.tree->shape, "b");
  EXPECT_FALSE(record.sat.has_value());
  EXPECT_NEAR(record.tree->box.lower.y(), -0.05, 1e-12);
  ASSERT_FALSE(record.tree->visits.empty());
  EXPECT_EQ(record.tree->visits[0].box.lower, Vec3d(-4, 0, -4));
  EXPECT_EQ(record.tree->visits[0].depth, 0);
  // A ball of 0.6 m over cells of 0.5 m: two cells in each direction.
  EXPECT_GE(record.tree->candidates.size(), 6u);
  EXPECT_LE(record.tree->candidates.size(), 18u);
  for (const trace::Manifold& manifold : record.manifolds) {
    ASSERT_TRUE(manifold.triangle.has_value());
    EXPECT_NE(std::find(record.tree->candidates.begin(), record.tree->candidates.end(),
                        *manifold.triangle),
              record.tree->candidates.end());
  }
}

TEST(MeshPairs, ASphereFarFromEveryTriangleHasAFiniteDistance) {
  const Mesh<double> floor = make_grid(8, 8, 4, 4, 0);
  const trace::Pair record = test::record_of<double>({test::ball(0.5), at(0, 3, 0), floor, {}});
  EXPECT_EQ(record.state, "separated");
  EXPECT_NEAR(record.separation, 2.5, 1e-12);
}

TEST(MeshPairs, MeshesAndPlanesMakeNoContactsWithEachOther) {
  EXPECT_FALSE(can_collide(ShapeKind::Mesh, ShapeKind::Mesh));
  EXPECT_FALSE(can_collide(ShapeKind::Mesh, ShapeKind::Plane));
  EXPECT_FALSE(can_collide(ShapeKind::Plane, ShapeKind::Plane));
  for (const ShapeKind kind : {ShapeKind::Sphere, ShapeKind::Capsule, ShapeKind::Hull}) {
    EXPECT_TRUE(can_collide(kind, ShapeKind::Mesh));
    EXPECT_TRUE(can_collide(ShapeKind::Mesh, kind));
    EXPECT_TRUE(can_collide(ShapeKind::Plane, kind));
  }
}

}  // namespace
}  // namespace contactscope
