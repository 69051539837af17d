#include <gmock/gmock.h>

#include "geometry/primitives.h"
#include "manifold/pair_query.h"
#include "manifold/placed_shapes.h"
#include "support/brute_force_distance.h"
#include "support/builders.h"
#include "support/cases.h"
#include "support/sphere_mesh.h"

/// Small shapes over floors that are up to ten thousand times as large. Contact must be decided
/// with the rounding of the closest features, wherever the floor's corners are. The true separation
/// is that of the lowest vertex, in extended precision.
namespace contactscope {
namespace {

using test::PlacedShapes;
using test::Random;

enum class Floor { Box, Plane, Mesh };

Shape<double> floor_of(Floor kind, double reach, double thickness) {
  switch (kind) {
    case Floor::Box:
      return make_box(Vec3d(reach, thickness, reach));
    case Floor::Plane:
      return HalfSpace<double>{{Vec3d::UnitY(), thickness}};
    case Floor::Mesh:
      break;
  }
  return build_mesh({{-reach, thickness, -reach},
                     {reach, thickness, -reach},
                     {reach, thickness, reach},
                     {-reach, thickness, reach}},
                    {{{0, 2, 1}}, {{0, 3, 2}}});
}

Shape<double> small_of(Random& random, double size) {
  switch (random.index(4)) {
    case 0:
      return test::ball(size);
    case 1:
      return test::upright_capsule(0.5 * size, 0.5 * size);
    case 2:
      return make_box(size * Vec3d(1, 0.5, 0.75));
    default:
      return test::random_hull(random, 6 + random.index(8), size, 2);
  }
}

test::Features core_features(const Shape<double>& shape, const Pose<double>& pose) {
  if (std::holds_alternative<Sphere<double>>(shape))
    return test::features_of_point(Vec3d::Zero(), pose);
  if (const auto* capsule = std::get_if<Capsule<double>>(&shape))
    return test::features_of_segment(capsule->points[0], capsule->points[1], pose);
  return test::features_of(std::get<Hull<double>>(shape), pose);
}

double radius_of(const Shape<double>& shape) {
  if (const auto* sphere = std::get_if<Sphere<double>>(&shape)) return sphere->radius;
  const auto* capsule = std::get_if<Capsule<double>>(&shape);
  return capsule ? capsule->radius : 0;
}

/// A small shape over a floor that is level, at most turned about the vertical, or at any pose.
struct Scene {
  Floor kind = Floor::Box;
  double size = 1, reach = 1, thickness = 1;
  bool level = true;     // the floor
  bool upright = false;  // the small shape is at most turned about the vertical
  PlacedShapes pair;     // the floor is a

  double gap() const {
    const Eigen::Quaternion<test::Extended> rotation =
        pair.pose_a.rotation.cast<test::Extended>().normalized();
    test::Extended lowest = std::numeric_limits<test::Extended>::infinity();
    for (const test::ExtendedPoint& vertex : core_features(pair.b, pair.pose_b).vertices) {
      const test::ExtendedPoint own =
          rotation.conjugate() *
          test::ExtendedPoint(vertex - pair.pose_a.position.cast<test::Extended>());
      lowest = std::min(lowest, own.y());
    }
    const Vec3d top =
        kind == Floor::Box ? std::get<Hull<double>>(pair.a).vertices.back() : Vec3d(0, top_of(), 0);
    return static_cast<double>(lowest - static_cast<test::Extended>(top.y())) - radius_of(pair.b);
  }
  double top_of() const {
    if (const auto* half_space = std::get_if<HalfSpace<double>>(&pair.a))
      return half_space->plane.offset;
    return std::get<Mesh<double>>(pair.a).vertices[0].y();
  }
};

template <class S> Shape<double> rounded_floor(const Shape<double>& shape) {
  if (const auto* mesh = std::get_if<Mesh<double>>(&shape)) {
    std::vector<Vec3d> vertices;
    for (const Vec3d& vertex : mesh->vertices) vertices.push_back(test::rounded<S>(vertex));
    return build_mesh(vertices, mesh->triangles);
  }
  return test::rounded<S>(shape);
}

template <class S> Scene random_scene(Random& random) {
  Scene scene;
  scene.kind = static_cast<Floor>(random.index(3));
  scene.size = random.decade(-4, 4);
  scene.reach = scene.size * random.decade(0.7, 4);
  scene.thickness = scene.size * random.uniform(0.2, 2);
  scene.level = random.chance(0.7);
  scene.upright = random.chance(0.4);
  const double yaw = random.chance(0.5) ? 0 : random.uniform(-3, 3);
  Pose<double> floor{test::about(Vec3d::UnitY(), yaw),
                     random.chance(0.5) ? Vec3d(0, 0, 0) : random.vector(-1, 1) * scene.reach};
  if (!scene.level) floor.rotation = random.rotation();
  const Shape<double> small = small_of(random, scene.size);
  Pose<double> own{
      scene.upright ? test::about(Vec3d::UnitY(), random.uniform(-3, 3)) : random.rotation(),
      random.level(scene.reach - 3 * scene.size, 0)};
  double lowest = 1e300;
  for (const test::ExtendedPoint& vertex : core_features(small, own).vertices)
    lowest = std::min(lowest, static_cast<double>(vertex.y()));
  const double share = random.chance(0.1) ? 0 : random.decade(-9, -1);
  const double gap = (random.chance(0.5) ? share : -share) * scene.size;
  own.position.y() = scene.thickness + gap - (lowest - radius_of(small));
  Pose<double> pose = compose(floor, own);
  pose.rotation.normalize();
  const auto exact = [](const Pose<double>& of) -> Pose<double> {
    return of.cast<S>().template cast<double>();
  };
  scene.pair = {rounded_floor<S>(floor_of(scene.kind, scene.reach, scene.thickness)), exact(floor),
                test::rounded<S>(small), exact(pose)};
  return scene;
}

template <class S>
Answer<S> answer_of(const PlacedShapes& pair, bool swapped, const Question& question) {
  const Shape<S> a = shape_cast<S>(pair.a), b = shape_cast<S>(pair.b);
  const Pose<S> pose_a = pair.pose_a.cast<S>(), pose_b = pair.pose_b.cast<S>();
  OwnBounds<S> bounds_a, bounds_b;
  if (swapped) return query_pair<S>({b, pose_b, bounds_b}, {a, pose_a, bounds_a}, question);
  return query_pair<S>({a, pose_a, bounds_a}, {b, pose_b, bounds_b}, question);
}

/// Rounding of a separation computed in double, metres.
double rounding_of_double(const Scene& scene) {
  return 64 * std::numeric_limits<double>::epsilon() * 5 * scene.reach;
}

/// A few roundings in S, plus those of double, in metres. Only the heights over a level floor
/// count; all coordinates count for an inclined floor or a turned shape.
template <class S> double bound_of(const Scene& scene, double gap) {
  const double epsilon = std::numeric_limits<S>::epsilon();
  const PlacedShapes& pair = scene.pair;
  const auto height = [&](const Pose<double>& pose) {
    return scene.level ? std::abs(pose.position.y()) : pose.position.norm();
  };
  const double own = scene.thickness + 6 * scene.size + std::abs(gap);
  const double inclined = scene.level ? 0 : 6 * scene.reach;
  return 2 * epsilon * (own + inclined + height(pair.pose_a) + height(pair.pose_b)) +
         rounding_of_double(scene);
}

struct Tally {
  int separated = 0, together = 0, near = 0;
};

template <class S> void judge(const Scene& scene, bool swapped, Tally& tally) {
  const double gap = scene.gap(), bound = bound_of<S>(scene, gap);
  const double computed = rounding_of_double(scene);
  const double rounded = static_cast<double>(std::numeric_limits<S>::epsilon()) * std::abs(gap);
  const auto query_for = [&](QueryKind kind, bool inclusive = true) {
    return answer_of<S>(
        scene.pair, swapped,
        {.kind = kind,
         .comparison = inclusive ? QueryComparison::Inclusive : QueryComparison::Exclusive});
  };
  const Answer<S> inclusive = query_for(QueryKind::Overlap);
  const Answer<S> exclusive = query_for(QueryKind::Overlap, false);
  const Answer<S> touching = query_for(QueryKind::Touching);
  const Answer<S> penetration = query_for(QueryKind::Penetration);
  const bool is_mesh = scene.kind == Floor::Mesh;
  EXPECT_EQ(inclusive.overlap, penetration.overlap);
  EXPECT_EQ(inclusive.overlap, touching.overlap);
  if (!is_mesh) {
    const Answer<S> distance = query_for(QueryKind::Distance);
    EXPECT_EQ(inclusive.overlap, distance.overlap);
    if (gap > computed) {
      EXPECT_NEAR(*distance.gap, gap, computed + rounded);
    }
  }
  if (gap <= 0) {
    EXPECT_TRUE(inclusive.overlap);
  }
  if (gap >= 0) {
    EXPECT_FALSE(exclusive.overlap);
  }
  if (gap > bound) {
    ++tally.separated;
    EXPECT_FALSE(inclusive.overlap) << bound;
    EXPECT_FALSE(*touching.touching);
  } else if (gap < -bound) {
    ++tally.together;
    EXPECT_TRUE(exclusive.overlap) << bound;
    EXPECT_FALSE(*touching.touching);
    // One of two triangles may be left by a shorter path: sideways, over their common edge.
    EXPECT_GE(*penetration.gap, gap - computed - rounded);
    EXPECT_LE(*penetration.gap, (is_mesh ? 0.5 : 1) * gap + computed + rounded);
  } else {
    ++tally.near;
  }
  // The manifold is computed entirely in S.
  const double rounding =
      bound + 64 * static_cast<double>(std::numeric_limits<S>::epsilon()) * scene.reach;
  if (std::abs(gap) > rounding) {
    const bool has_points = !test::manifolds_of<S>(scene.pair).empty();
    EXPECT_EQ(has_points, gap < 0);
    EXPECT_EQ(has_points, inclusive.overlap);
  }
}

template <class S> void judge_random_scenes(int count, std::uint64_t seed) {
  Random random(seed);
  Tally tally;
  for (int i = 0; i < count && !testing::Test::HasFailure(); ++i) {
    const Scene scene = random_scene<S>(random);
    SCOPED_TRACE(testing::Message()
                 << "scene " << i << ", floor " << static_cast<int>(scene.kind) << ", level "
                 << scene.level << ", upright " << scene.upright << ", size " << scene.size
                 << ", reach " << scene.reach << ", gap " << scene.gap() << ", shape "
                 << to_string(kind_of(scene.pair.b)));
    judge<S>(scene, i % 2 == 1, tally);
  }
  EXPECT_GT(tally.separated, count / 6);
  EXPECT_GT(tally.together, count / 6);
  EXPECT_GT(tally.near, count / 20);
}

/// Five millimetres above a floor of one kilometre, and on the floor's far side.
TEST(QueryOnFloor, ABallOverAFloorOfAKilometreDoesNotTouchIt) {
  for (const Vec3d& place : {Vec3d(0, 0.505, 0), Vec3d(480, 0.50001, -490)}) {
    const PlacedShapes pair{make_box(Vec3d(500, 1, 500)),
                            test::at(0, -1, 0),
                            test::ball(0.5),
                            {Quatd::Identity(), place}};
    for (const QueryKind kind :
         {QueryKind::Overlap, QueryKind::Distance, QueryKind::Penetration, QueryKind::Touching}) {
      const Answer<float> answer = answer_of<float>(pair, false, {.kind = kind});
      EXPECT_FALSE(answer.overlap);
      EXPECT_NEAR(*answer.gap, static_cast<float>(place.y()) - 0.5F, 1e-9);
    }
  }
}

TEST(QueryOnFloor, RandomFloorsInDouble) { judge_random_scenes<double>(1000, 345); }
TEST(QueryOnFloor, RandomFloorsInFloat) { judge_random_scenes<float>(1000, 346); }
TEST(QueryOnFloor, SlowRandomFloors) {
  judge_random_scenes<double>(test::cases(10'000), 347);
  judge_random_scenes<float>(test::cases(10'000), 348);
}

}  // namespace
}  // namespace contactscope
