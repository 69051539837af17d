#include "manifold/capabilities.h"

#include <gmock/gmock.h>

#include "field/distance_field.h"
#include "geometry/bounds.h"
#include "geometry/primitives.h"
#include "manifold/pair_query.h"
#include "manifold/placed_shapes.h"
#include "query/overlap.h"
#include "query/penetration.h"
#include "query/v_clip.h"

namespace contactscope {
namespace {

using test::PlacedShapes;

constexpr QueryKind kEveryQuery[] = {QueryKind::Overlap, QueryKind::Touching, QueryKind::Distance,
                                     QueryKind::Penetration, QueryKind::Manifold};

/// Spans -0.5 to 0.5 along y; planes and meshes have their surface at 0.5. A mesh is always below.
Shape<double> shape_of(ShapeKind kind) {
  switch (kind) {
    case ShapeKind::Sphere:
      return test::ball(0.5);
    case ShapeKind::Capsule:
      return test::upright_capsule(0.25, 0.25);
    case ShapeKind::Hull:
      return make_box(Vec3d(0.5, 0.5, 0.5));
    case ShapeKind::Plane:
      return HalfSpace<double>{{Vec3d::UnitY(), 0.5}};
    case ShapeKind::Mesh:
      break;
    case ShapeKind::Field: {
      static const Shape<double> box = make_box(Vec3d(0.5, 0.5, 0.5));
      static const PlacedField placed = build_distance_field(box, {.cells = 16});
      return field_shape(placed, box);
    }
  }
  Mesh<double> grid = make_grid(4, 4, 2, 2, 0);
  for (Vec3d& vertex : grid.vertices) vertex.y() = 0.5;
  return build_mesh(grid.vertices, grid.triangles);
}

/// The convex shape lies `gap` metres above the other one.
PlacedShapes pair_of(ShapeKind lower, ShapeKind upper, double gap) {
  if (lower < upper) std::swap(lower, upper);
  if (upper == ShapeKind::Plane) std::swap(lower, upper);
  const double y = upper == ShapeKind::Mesh ? gap : 1 + gap;  // surface on surface for two meshes
  return {shape_of(lower), {}, shape_of(upper), {Quatd::Identity(), {0, y, 0}}};
}

struct Core {
  SupportSet<double> set;
  double radius;
};

Core core_of(const Shape<double>& shape) {
  if (const auto* capsule = std::get_if<Capsule<double>>(&shape))
    return {{capsule->points.data(), 2, nullptr}, capsule->radius};
  if (const auto* hull = std::get_if<Hull<double>>(&shape)) return {support_set(*hull), 0};
  static const Vec3d middle = Vec3d::Zero();
  return {support_set(middle), std::get<Sphere<double>>(shape).radius};
}

/// Result of a method for a pair: yes or no, or metres.
struct Said {
  bool yes = false;
  double metres = 0;
};

constexpr double kTolerance = 1e-9;

template <class Bound> Said query_bounds(QueryKind query, const Bound& a, const Bound& b) {
  using C = Comparison<double>;
  if (query == QueryKind::Overlap) return {overlaps(a, b, C::inclusive())};
  return {overlaps(a, b, C::within(kTolerance)) && !overlaps(a, b, C::exclusive())};
}

Said query_contacts(QueryKind query, const PlacedShapes& pair) {
  CollideOptions options;
  options.margin = kTolerance;
  Manifolds<double> manifolds;
  collide(pair.a, pair.pose_a, pair.b, pair.pose_b, options, manifolds);
  double separation = std::numeric_limits<double>::infinity();
  for (const Manifold<double>& manifold : manifolds)
    for (const ContactPoint<double>& point : manifold.points)
      separation = std::min(separation, point.separation);
  if (query == QueryKind::Overlap) return {separation <= kTolerance};
  if (query == QueryKind::Touching) return {std::abs(separation) <= kTolerance};
  return {separation < 0, -separation};
}

Said query_pair(QueryMethod method, QueryKind query, const PlacedShapes& pair) {
  if (method == QueryMethod::Contacts) return query_contacts(query, pair);
  if (method == QueryMethod::Aabb)
    return query_bounds(query, *aabb_of(pair.a, pair.pose_a), *aabb_of(pair.b, pair.pose_b));
  if (method == QueryMethod::Obb)
    return query_bounds(query, placed(*obb_of(pair.a), pair.pose_a),
                        placed(*obb_of(pair.b), pair.pose_b));
  if (method == QueryMethod::BoundingSphere)
    return query_bounds(query, placed(*bounding_sphere_of(pair.a), pair.pose_a),
                        placed(*bounding_sphere_of(pair.b), pair.pose_b));
  if (method == QueryMethod::Support || method == QueryMethod::Triangles) {
    OwnBounds<double> of_a, of_b;
    const Answer<double> answer = contactscope::query_pair<double>(
        {pair.a, pair.pose_a, of_a}, {pair.b, pair.pose_b, of_b}, {.kind = query});
    EXPECT_EQ(answer.method, method);
    if (query == QueryKind::Overlap) return {answer.overlap};
    if (query == QueryKind::Touching) return {*answer.touching};
    return {true, query == QueryKind::Distance ? std::max(0.0, *answer.gap) : -*answer.gap};
  }
  const Core a = core_of(pair.a), b = core_of(pair.b);
  const Pose<double> b_in_a = relative_pose(pair.pose_a, pair.pose_b);
  double separation = 0;
  if (method == QueryMethod::VClip) {
    separation =
        v_clip(std::get<Hull<double>>(pair.a), std::get<Hull<double>>(pair.b), b_in_a).distance;
  } else {
    separation = gjk(a.set, b.set, b_in_a).distance - (a.radius + b.radius);
  }
  if (method != QueryMethod::Gjk && method != QueryMethod::VClip) {
    constexpr PenetrationMethod kMethods[] = {PenetrationMethod::Sat, PenetrationMethod::Epa,
                                              PenetrationMethod::Mpr, PenetrationMethod::Sampling};
    const auto index =
        static_cast<std::size_t>(method) - static_cast<std::size_t>(QueryMethod::Sat);
    const auto found = penetration(kMethods[index], a.set, b.set, b_in_a);
    if (has_depth(found.status)) separation = -found.depth - (a.radius + b.radius);
  }
  if (query == QueryKind::Overlap) return {separation <= kTolerance};
  if (query == QueryKind::Touching) return {std::abs(separation) <= kTolerance};
  return {true, query == QueryKind::Distance ? std::max(0.0, separation) : -separation};
}

/// Calls visit(method, query, one, other) for every cell of the table.
template <class Visit> void for_every_cell(const Visit& visit) {
  for (int m = 0; m < kQueryMethods; ++m) {
    for (const QueryKind query : kEveryQuery) {
      for (int one = 0; one < kShapeKinds; ++one) {
        for (int other = 0; other < kShapeKinds; ++other) {
          const auto a = static_cast<ShapeKind>(one), b = static_cast<ShapeKind>(other);
          SCOPED_TRACE(std::string(to_string(static_cast<QueryMethod>(m))) + ", " +
                       to_string(query) + ", " + to_string(a) + "-" + to_string(b));
          visit(static_cast<QueryMethod>(m), query, a, b);
        }
      }
    }
  }
}

TEST(Capabilities, EveryClaimedCellAnswersRight) {
  int claimed = 0;
  for_every_cell([&](QueryMethod method, QueryKind query, ShapeKind one, ShapeKind other) {
    if (refusal(method, query, one, other)) return;
    ++claimed;
    const Said separated = query_pair(method, query, pair_of(one, other, 0.2));
    const Said touching = query_pair(method, query, pair_of(one, other, 0));
    // Two flat meshes have no inside to overlap.
    const bool flat = one == ShapeKind::Mesh && other == ShapeKind::Mesh;
    const Said deep = query_pair(method, query, pair_of(one, other, flat ? 0 : -0.125));
    const bool is_bound = method <= QueryMethod::BoundingSphere;
    switch (query) {
      case QueryKind::Overlap:
        EXPECT_TRUE(deep.yes);
        EXPECT_TRUE(touching.yes);
        // Bounds are larger than their shapes, but finite.
        EXPECT_FALSE(is_bound ? query_pair(method, query, pair_of(one, other, 20)).yes
                              : separated.yes);
        break;
      case QueryKind::Touching:
        if (method != QueryMethod::BoundingSphere || (one == other && one == ShapeKind::Sphere)) {
          EXPECT_TRUE(touching.yes);
          EXPECT_FALSE(separated.yes);
          EXPECT_EQ(deep.yes, flat);
        }
        EXPECT_FALSE(query_pair(method, query, pair_of(one, other, 20)).yes);
        break;
      case QueryKind::Distance:
        EXPECT_NEAR(separated.metres, 0.2, 1e-9);
        EXPECT_EQ(touching.metres < 1e-9, true);
        EXPECT_LT(deep.metres, 1e-9);
        break;
      case QueryKind::Penetration:
        // Portal refinement ends at the face that one ray hits; sampling only comes close.
        EXPECT_GE(deep.metres, 0.125 - 1e-9);
        EXPECT_LE(deep.metres, method == QueryMethod::Mpr ? 0.2 : 0.125 + 1e-3);
        break;
      case QueryKind::Manifold:
        EXPECT_NEAR(deep.metres, 0.125, 1e-9);
        EXPECT_FALSE(separated.yes);
        break;
    }
  });
  EXPECT_GT(claimed, 100);
}

TEST(Capabilities, RefusalsHaveAReasonAndAnAlternative) {
  for_every_cell([&](QueryMethod method, QueryKind query, ShapeKind one, ShapeKind other) {
    const std::optional<std::string> reason = refusal(method, query, one, other);
    EXPECT_EQ(reason, refusal(method, query, other, one));
    if (!reason) return;
    EXPECT_GT(reason->size(), 20u);
    EXPECT_NE(reason->back(), '.');
  });
  EXPECT_THAT(*refusal(QueryMethod::Gjk, QueryKind::Penetration, ShapeKind::Hull, ShapeKind::Hull),
              testing::HasSubstr("ask \"sat\""));
  EXPECT_THAT(*refusal(QueryMethod::Gjk, QueryKind::Touching, ShapeKind::Hull, ShapeKind::Hull),
              testing::HasSubstr("touching or not"));
  EXPECT_THAT(*refusal(QueryMethod::Sat, QueryKind::Distance, ShapeKind::Hull, ShapeKind::Hull),
              testing::HasSubstr("corners"));
}

TEST(Capabilities, APairIsRefusedWhereNoMethodAnswers) {
  using K = ShapeKind;
  EXPECT_THAT(methods_for(QueryKind::Distance, K::Hull, K::Capsule),
              testing::ElementsAre(QueryMethod::Gjk));
  EXPECT_THAT(methods_for(QueryKind::Manifold, K::Mesh, K::Sphere),
              testing::ElementsAre(QueryMethod::Contacts));
  EXPECT_EQ(methods_for(QueryKind::Penetration, K::Hull, K::Hull).size(), 5u);
  EXPECT_FALSE(refusal(QueryKind::Overlap, K::Plane, K::Hull));
  EXPECT_THAT(methods_for(QueryKind::Distance, K::Plane, K::Capsule),
              testing::ElementsAre(QueryMethod::Support));
  EXPECT_THAT(methods_for(QueryKind::Penetration, K::Sphere, K::Capsule),
              testing::ElementsAre(QueryMethod::Gjk, QueryMethod::Contacts));
  EXPECT_THAT(methods_for(QueryKind::Overlap, K::Mesh, K::Mesh),
              testing::ElementsAre(QueryMethod::Triangles));
  EXPECT_THAT(*refusal(QueryKind::Manifold, K::Mesh, K::Mesh),
              testing::HasSubstr("query = \"overlap\""));
  EXPECT_THAT(*refusal(QueryKind::Overlap, K::Plane, K::Plane), testing::HasSubstr("parallel"));
  EXPECT_THAT(*refusal(QueryKind::Distance, K::Hull, K::Mesh), testing::HasSubstr("margin"));
  for (const QueryKind query : kEveryQuery)
    for (int one = 0; one < kShapeKinds; ++one)
      for (int other = 0; other < kShapeKinds; ++other)
        EXPECT_EQ(!refusal(query, K(one), K(other)).has_value(),
                  !methods_for(query, K(one), K(other)).empty());
}

}  // namespace
}  // namespace contactscope
