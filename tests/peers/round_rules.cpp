#include <algorithm>
#include <cmath>
#include <string_view>

#include "geometry/primitives.h"
#include "peers/rules.h"
#include "support/brute_force_distance.h"
#include "support/brute_force_sat.h"

namespace contactscope::peers {
namespace {

// btGjkEpa2.cpp, in single precision. EPA on overlapping cores stops at a gain of EPA_ACCURACY or
// when a face is too thin for float, which leaves about ten times that.
constexpr double kEpaMetres = 15e-4;
constexpr double kGjkMinDistance = 1e-4;

Vec3d centroid(const Shape<double>& shape) {
  const auto* hull = std::get_if<Hull<double>>(&shape);
  return hull == nullptr ? Vec3d::Zero() : hull->centroid;
}

Vec3d mean_of_vertices(const Shape<double>& shape) {
  const auto* hull = std::get_if<Hull<double>>(&shape);
  if (hull == nullptr) return Vec3d::Zero();
  Vec3d sum = Vec3d::Zero();
  for (const Vec3d& vertex : hull->vertices) sum += vertex;
  return sum / hull->vertex_count();
}

using Centre = Vec3d (*)(const Shape<double>&);

/// As for hulls in rules.cpp: between the least depth and the exit distance along the centres.
template <Centre centre> bool on_the_exit(const Comparison& c) {
  if (c.reported < c.depth() - c.tolerance) return false;
  RoundPair moved = *c.round;
  const Vec3d line =
      moved.pose_b.transform(centre(moved.b)) - moved.pose_a.transform(centre(moved.a));
  if (c.answer.deepest()->normal.dot(line) <= 0) return false;
  moved.pose_b.position += (c.reported - c.tolerance) * line.normalized();
  return separation_by_exhaustion(moved) <= c.tolerance;
}

template <Centre centre> bool nearest_on_triangle(const Comparison& c) {
  return c.reported <= c.overlap && on_the_exit<centre>(c);
}

/// dCollideCapsuleBox: if the axis meets the box, it runs dBoxBox for the box around the capsule,
/// with its factor for edges. That box is larger than the capsule, so the depth is no less.
bool counted_as_a_box(const Comparison& c) {
  const auto* capsule = std::get_if<Capsule<double>>(&c.round->a);
  const auto* box = std::get_if<Hull<double>>(&c.round->b);
  if (capsule == nullptr || box == nullptr) return false;
  if (!std::holds_alternative<Box>(shape_of(*box)) || c.depth() < capsule->radius) return false;
  const Vec3d end = capsule->points[1].cwiseAbs();
  const Hull<double> around = make_box(end + Vec3d::Constant(capsule->radius));
  const test::BruteForceAxis boxes =
      test::brute_force_sat(around, c.round->pose_a, *box, c.round->pose_b);
  const Vec3d normal = c.answer.deepest()->normal.normalized();
  const double along =
      -test::separation_along(normal, around, c.round->pose_a, *box, c.round->pose_b);
  const double most = -1.05 * boxes.separation + c.tolerance;
  return along <= most && c.reported <= most && c.reported >= c.depth() - c.tolerance;
}

double off(const Comparison& c) {
  return std::max(std::abs(c.overlap - c.depth()), std::abs(c.reported - c.overlap));
}

bool cores_overlap(const Comparison& c) {
  return c.depth() >= radius_of(c.round->a) + radius_of(c.round->b) - kGjkMinDistance;
}

bool within_epa_accuracy(const Comparison& c) { return cores_overlap(c) && off(c) <= kEpaMetres; }

/// Closest point to the shape without its radius, on the triangle, world.
Vec3d closest_on_triangle(const RoundPair& pair) {
  const auto* capsule = std::get_if<Capsule<double>>(&pair.a);
  const test::Features core =
      capsule == nullptr
          ? test::features_of_point(Vec3d::Zero(), pair.pose_a)
          : test::features_of_segment(capsule->points[0], capsule->points[1], pair.pose_a);
  const auto& triangle = std::get<Hull<double>>(pair.b);
  return test::brute_force_distance(core, test::features_of(triangle, pair.pose_b))
      .on_b.cast<double>();
}

/// As in rules.cpp: 0.02 of the largest distance of a point of the shape from its origin, bounded
/// by its box for a capsule. Points are between the surfaces, so the depth counts too.
bool replaced_by_a_neighbour(const Comparison& c) {
  const auto* capsule = std::get_if<Capsule<double>>(&c.round->a);
  const double radius = radius_of(c.round->a);
  Vec3d half = Vec3d::Constant(radius);
  if (capsule != nullptr) half += capsule->points[1].cwiseAbs();
  const double threshold = 0.02 * (capsule == nullptr ? radius : half.norm());
  const Vec3d lost = closest_on_triangle(*c.round);
  return std::ranges::any_of(c.answer.points, [&](const PeerPoint& point) {
    return (point.position - lost).norm() <= threshold + c.depth();
  });
}

/// fcl::detail::sphereTriangleIntersect returns the distance minus the radius, negative in overlap,
/// as the depth. So the deepest point is the one with the largest apparent separation.
bool has_its_sign_reversed(const Comparison& c) {
  if (!std::holds_alternative<Sphere<double>>(c.round->a) || c.answer.points.empty()) return false;
  const PeerPoint& deepest = *std::ranges::max_element(c.answer.points, {}, &PeerPoint::separation);
  const double overlap = -separation_along(deepest.normal.normalized(), *c.round);
  return std::abs(deepest.separation - c.depth()) <= c.tolerance &&
         overlap <= c.depth() + c.tolerance;
}

constexpr Rule kBulletRules[] = {
    {Aspect::Normal, kEpaAccuracy, within_epa_accuracy},
    {Aspect::Depth, kEpaAccuracy, within_epa_accuracy},
};

constexpr Rule kOdeRules[] = {
    {Aspect::Normal, kExitDepth, on_the_exit<centroid>},
    {Aspect::Depth, kExitDepth, nearest_on_triangle<centroid>},
    {Aspect::Normal, kCapsuleAsBox, counted_as_a_box},
    {Aspect::Depth, kCapsuleAsBox, counted_as_a_box},
};

constexpr Rule kFclRules[] = {
    {Aspect::Normal, kExitDepth, on_the_exit<mean_of_vertices>},
    {Aspect::Depth, kExitDepth, nearest_on_triangle<mean_of_vertices>},
};

constexpr Rule kBulletMeshRules[] = {
    {Aspect::Deepest, kReplaced, replaced_by_a_neighbour},
};

constexpr Rule kFclMeshRules[] = {
    {Aspect::Touching, kSphereSign, has_its_sign_reversed},
    {Aspect::Normal, kExitDepth, on_the_exit<mean_of_vertices>},
    {Aspect::Depth, kExitDepth, nearest_on_triangle<mean_of_vertices>},
};

}  // namespace

std::span<const Rule> round_mesh_rules_of(const Peer& peer) {
  const std::string_view name = peer.name();
  if (name == "Bullet") return kBulletMeshRules;
  return name == "FCL" ? std::span<const Rule>(kFclMeshRules) : std::span<const Rule>();
}

std::span<const Rule> round_rules_of(const Peer& peer) {
  const std::string_view name = peer.name();
  if (name == "Bullet") return kBulletRules;
  return name == "ODE" ? std::span<const Rule>(kOdeRules) : kFclRules;
}

}  // namespace contactscope::peers
