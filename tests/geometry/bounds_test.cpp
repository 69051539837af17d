#include "geometry/bounds.h"

#include <gmock/gmock.h>

#include <cmath>

#include "geometry/hull_builder.h"
#include "geometry/primitives.h"
#include "support/random_geometry.h"

namespace contactscope {
namespace {

using test::Random;
using Extended = Vec3<long double>;

template <class S> class Bounds : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Bounds, Scalars);

/// Distance of the point outside the box that the columns span, relative to the point's distance
/// from the centre, in long double.
template <class S> double outside(const Obb<S>& box, const Vec3<S>& point) {
  const Mat3<long double> axes = box.axes.template cast<long double>();
  const Extended offset =
      point.template cast<long double>() - box.center.template cast<long double>();
  const Extended local = axes.inverse() * offset;
  double most = 0;
  for (int k = 0; k < 3; ++k) {
    const long double more = std::abs(local[k]) - (long double)(box.half_extents[k]);
    if (more > 0) most = std::max(most, double(more / offset.norm()));
  }
  return most;
}

template <class S> double surface(const Obb<S>& box) {
  const Vec3d h = box.half_extents.template cast<double>();
  return 8 * (h.x() * h.y() + h.y() * h.z() + h.z() * h.x());
}

template <class S> Hull<S> moved(Hull<double> hull, const Pose<double>& pose) {
  for (Vec3d& vertex : hull.vertices) vertex = pose.transform(vertex);
  return hull_cast<S>(build_hull(hull.vertices));
}

TYPED_TEST(Bounds, HoldEveryVertexOfAnyHull) {
  using S = TypeParam;
  Random random(1);
  for (int trial = 0; trial < 60; ++trial) {
    const double size = random.decade(-4, 4);
    const Pose<double> pose = random.pose(random.chance(0.3) ? 1000 * size : size);
    const Hull<S> hull =
        moved<S>(test::random_hull(random, 6 + random.index(30), size, random.decade(0, 2)), pose);
    const Shape<S> shape = hull;
    const Obb<S> box = *obb_of(shape);
    const BoundingSphere<S> sphere = *bounding_sphere_of(shape);
    const Aabb<S> aabb = *aabb_of(shape);
    const double epsilon = std::numeric_limits<S>::epsilon();
    const Mat3<S> product = box.axes.transpose() * box.axes;
    EXPECT_LE((product - Mat3<S>::Identity()).cwiseAbs().maxCoeff(), 8 * epsilon);
    for (const Vec3<S>& vertex : hull.vertices) {
      EXPECT_LE(outside(box, vertex), 1e-18) << trial;
      const Extended offset =
          vertex.template cast<long double>() - sphere.center.template cast<long double>();
      EXPECT_LE(offset.norm(), (long double)(sphere.radius) * (1 + 1e-18L)) << trial;
      EXPECT_TRUE((vertex.array() >= aabb.lower.array()).all());
      EXPECT_TRUE((vertex.array() <= aabb.upper.array()).all());
    }
    EXPECT_LE(surface(box), double(surface_area(aabb)) * (1 + 1e-5)) << trial;
    // No larger than a sphere about the centre of the box.
    EXPECT_LE(double(sphere.radius), 0.5 * double(aabb.extent().norm()) * (1 + 1e-4));
  }
}

TYPED_TEST(Bounds, BoxObbIsTheBoxAtAnyRotation) {
  using S = TypeParam;
  Random random(2);
  EXPECT_EQ(obb_of(Shape<S>(hull_cast<S>(make_box(Vec3d(0.5, 0.25, 0.1)))))->half_extents,
            Vec3<S>(S(0.5), S(0.25), S(0.1)));
  EXPECT_TRUE(obb_of(Shape<S>(hull_cast<S>(make_box(Vec3d(0.5, 2, 1)))))->axes.isIdentity(0));
  for (int trial = 0; trial < 30; ++trial) {
    const double size = random.decade(-4, 4);
    const Vec3d half = size * Vec3d(1, random.uniform(0.1, 1), random.uniform(0.1, 1));
    const Obb<S> box =
        *obb_of(Shape<S>(moved<S>(make_box(half), {random.rotation(), size * Vec3d(1, 2, 3)})));
    EXPECT_NEAR(double(box.volume()) / (8 * half.prod()), 1, 1e-5);
  }
}

TYPED_TEST(Bounds, TetrahedronObbIsTheCubeNoFaceLiesIn) {
  using S = TypeParam;
  Random random(3);
  const std::vector<Vec3d> corners = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  for (int trial = 0; trial < 10; ++trial) {
    const Shape<S> shape = moved<S>(build_hull(corners), random.pose(1));
    EXPECT_NEAR(double(obb_of(shape)->volume()), 8, 1e-4);
    EXPECT_NEAR(double(bounding_sphere_of(shape)->radius), std::sqrt(3.0), 1e-5);
  }
}

/// Radius of the smallest ball through 2, 3 or 4 of the points that contains all, in long double.
long double smallest_radius(const std::vector<Vec3d>& points) {
  using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  long double best = std::numeric_limits<long double>::infinity();
  for (unsigned chosen = 1; chosen < 1U << points.size(); ++chosen) {
    std::vector<Extended> through;
    for (std::size_t i = 0; i < points.size(); ++i)
      if ((chosen >> i & 1U) != 0) through.push_back(points[i].cast<long double>());
    if (through.size() < 2 || through.size() > 4) continue;
    const auto count = static_cast<Eigen::Index>(through.size()) - 1;
    Matrix offsets(3, count);
    for (Eigen::Index i = 0; i < count; ++i)
      offsets.col(i) = through[static_cast<std::size_t>(i) + 1] - through[0];
    const Matrix normal = offsets.transpose() * offsets;
    const Eigen::FullPivLU<Matrix> solver(normal);
    if (solver.rank() < count) continue;
    const Matrix factors = solver.solve(Matrix(0.5L * normal.diagonal()));
    const Extended center = through[0] + Extended(offsets * factors);
    const long double radius = (center - through[0]).norm();
    bool holds = true;
    for (const Vec3d& point : points)
      holds = holds && (point.cast<long double>() - center).norm() <= radius * (1 + 1e-12L);
    if (holds) best = std::min(best, radius);
  }
  return best;
}

TEST(SphereAround, IsTheSmallestOfAllBallsThroughFourPoints) {
  Random random(4);
  for (int trial = 0; trial < 200; ++trial) {
    const double size = random.decade(-4, 4);
    const Vec3d flat(1, random.chance(0.3) ? 0 : 1, random.chance(0.3) ? random.decade(-6, 0) : 1);
    std::vector<Vec3d> points;
    for (int i = 0; i < 3 + trial % 6; ++i) {
      const Vec3d direction = random.unit_vector();
      points.push_back(size * direction.cwiseProduct(flat));
    }
    if (random.chance(0.3)) points.push_back(points.front());
    const double radius = sphere_around<double>(points).radius;
    EXPECT_NEAR(radius / double(smallest_radius(points)), 1, 1e-9) << trial;
  }
}

TEST(SphereAround, ManyPointsOnASphereAndOneOrNone) {
  Random random(5);
  std::vector<Vec3d> points;
  for (int i = 0; i < 3000; ++i) points.emplace_back(Vec3d(7, 0, 0) + 2 * random.unit_vector());
  EXPECT_NEAR(sphere_around<double>(points).radius, 2, 1e-3);
  EXPECT_LE(sphere_around<double>(points).radius, 2 * (1 + 1e-9));
  EXPECT_TRUE(sphere_around<double>({}).empty());
  EXPECT_EQ(sphere_around<double>(std::vector<Vec3d>(3, Vec3d(1, 2, 3))).radius, 0);
}

TYPED_TEST(Bounds, RoundShapesHaveThemPlanesDoNot) {
  using S = TypeParam;
  Random random(6);
  for (int trial = 0; trial < 200; ++trial) {
    const double size = random.decade(-4, 4);
    Capsule<S> capsule{{Vec3<S>::Zero(), Vec3<S>::Zero()}, S(size * random.uniform(0.1, 1))};
    for (Vec3<S>& end : capsule.points) end = (size * random.unit_vector()).cast<S>();
    if (trial % 4 == 0) capsule.points[1] = capsule.points[0];
    if (trial % 4 == 1) capsule.points[1] = capsule.points[0] + S(size) * Vec3<S>::UnitY();
    const Shape<S> shape = capsule;
    const Obb<S> box = *obb_of(shape);
    const BoundingSphere<S> sphere = *bounding_sphere_of(shape);
    const Pose<S> pose = random.pose(10 * size).template cast<S>();
    const Aabb<S> aabb = *aabb_of(shape, pose);
    const Extended radius = Extended::Constant(capsule.radius);
    for (const Vec3<S>& end : capsule.points) {
      // A ball about each end is inside, along the normals of the box, of the sphere, of the Aabb.
      for (int k = 0; k < 3; ++k) {
        const Extended across = box.axes.col((k + 1) % 3)
                                    .template cast<long double>()
                                    .cross(box.axes.col((k + 2) % 3).template cast<long double>());
        const Extended normal = across.normalized();
        const Extended out =
            end.template cast<long double>() - box.center.template cast<long double>();
        const long double face = (long double)(box.half_extents[k]) *
                                 std::abs(normal.dot(box.axes.col(k).template cast<long double>()));
        EXPECT_LE(std::abs(normal.dot(out)) + radius[0], face * (1 + 1e-17L)) << trial;
        const S at = pose.transform(end)[k];
        EXPECT_LE((long double)(aabb.lower[k]), (long double)(at)-radius[0]);
        EXPECT_GE((long double)(aabb.upper[k]), (long double)(at) + radius[0]);
      }
      const Extended offset =
          end.template cast<long double>() - sphere.center.template cast<long double>();
      EXPECT_LE(offset.norm() + radius[0], (long double)(sphere.radius) * (1 + 1e-17L));
    }
    EXPECT_LE(double(sphere.radius), 1.001 * (size + double(capsule.radius)));
  }
  const Shape<S> ball = Sphere<S>{2};
  EXPECT_EQ(obb_of(ball)->half_extents, Vec3<S>(2, 2, 2));
  EXPECT_EQ(bounding_sphere_of(ball)->radius, S(2));
  EXPECT_EQ(aabb_of(ball, Pose<S>{Quat<S>::Identity(), Vec3<S>(1, 0, 0)})->upper, Vec3<S>(3, 2, 2));
  const Shape<S> plane = HalfSpace<S>{};
  EXPECT_FALSE(aabb_of(plane));
  EXPECT_FALSE(obb_of(plane));
  EXPECT_FALSE(bounding_sphere_of(plane));
}

TYPED_TEST(Bounds, MeshBoundsHoldItsVertices) {
  using S = TypeParam;
  Random random(7);
  const Pose<double> pose = random.pose(100);
  std::vector<Vec3d> vertices;
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 9; ++j)
      vertices.push_back(pose.transform({0.3 * i, 1.0 * j, 0.01 * (i * j % 3)}));
  std::vector<std::array<int, 3>> triangles;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 8; ++j) triangles.push_back({9 * i + j, 9 * i + j + 1, 9 * i + j + 9});
  const Shape<S> shape = shape_cast<S>(Shape<double>(build_mesh(vertices, triangles)));
  const Obb<S> box = *obb_of(shape);
  for (const Vec3<S>& vertex : std::get<Mesh<S>>(shape).vertices)
    EXPECT_LE(outside(box, vertex), 1e-18);
  // Along the strip in any pose.
  EXPECT_LT(double(box.volume()), 1.5 * 1.2 * 8 * 0.04);
}

}  // namespace
}  // namespace contactscope
