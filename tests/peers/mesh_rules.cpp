#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

#include "peers/rules.h"
#include "support/brute_force_sat.h"

namespace contactscope::peers {
namespace {

// btGjkEpa2.cpp, in single precision, as in round_rules.cpp. It stops at a gain of a tenth of a
// millimetre, or when a face of the polytope is too thin for float.
constexpr double kEpaMetres = 15e-4;
/// collision_trimesh_box.cpp: fDepth * 1.5f < m_fBestDepth.
bool wins_by_edge_factor_on_mesh(const Comparison& c) {
  constexpr double kFactor = 1.5;
  return c.overlap <= kFactor * c.depth() + c.tolerance;
}

bool within_epa_accuracy(const Comparison& c) { return c.overlap - c.depth() <= kEpaMetres; }

/// The triangle is clipped to the box, or the box's face to the triangle. The remaining part may be
/// less deep than the whole along that normal, but not less than the least overlap.
bool deepest_of_what_is_left(const Comparison& c) {
  return c.reported <= c.overlap && c.reported >= c.depth() - c.tolerance;
}

/// Clips a polygon to the planes through a face's edges, perpendicular to the face; hull's frame.
std::vector<Vec3d> within_sides(std::vector<Vec3d> polygon, const Hull<double>& hull, int face) {
  const std::vector<int> loop = face_vertices(hull, face);
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vec3d& from = hull.vertices[static_cast<std::size_t>(loop[k])];
    const Vec3d& to = hull.vertices[static_cast<std::size_t>(loop[(k + 1) % loop.size()])];
    const Vec3d outward =
        (to - from).cross(hull.planes[static_cast<std::size_t>(face)].normal).normalized();
    std::vector<Vec3d> left;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec3d& point = polygon[i];
      const Vec3d& next = polygon[(i + 1) % polygon.size()];
      const double here = outward.dot(point - from);
      const double there = outward.dot(next - from);
      if (here <= 0) left.push_back(point);
      if ((here < 0) != (there < 0)) left.push_back(point + here / (here - there) * (next - point));
    }
    polygon = left;
  }
  return polygon;
}

/// The part of triangle B that btPolyhedralContactClipping::clipFaceAgainstHull keeps. It clips to
/// the sides of that face of hull A which is most parallel to the normal from GJK and EPA.
struct ClippedTriangle {
  double depth = 0;              // of the deepest point, below that face; 0 if nothing is left
  std::optional<Vec3d> deepest;  // world
};

ClippedTriangle clipped_triangle(const Comparison& c) {
  const Hull<double>& hull = c.hulls->a;
  const Pose<double>& pose = c.hulls->pose_a;
  std::vector<Vec3d> triangle;
  for (const Vec3d& corner : c.hulls->b.vertices) {
    triangle.push_back(pose.inverse_transform(c.hulls->pose_b.transform(corner)));
  }
  const test::BruteForceAxis truth = test::brute_force_sat(hull, pose, c.hulls->b, c.hulls->pose_b);
  const Vec3d along = pose.inverse_rotate(truth.normal);
  const auto facing = std::ranges::max_element(
      hull.planes, {}, [&](const Plane<double>& plane) { return plane.normal.dot(along); });
  ClippedTriangle result;
  for (const Vec3d& point :
       within_sides(triangle, hull, static_cast<int>(facing - hull.planes.begin()))) {
    if (-facing->distance(point) <= result.depth) continue;
    result = {-facing->distance(point), pose.transform(point)};
  }
  return result;
}

/// btPersistentManifold::getCacheEntry: of two points of one pair closer than the threshold, the
/// later one replaces the earlier, even if it is less deep and belongs to another triangle.
bool replaced_by_another_triangle(const Comparison& c) {
  const ClippedTriangle clipped = clipped_triangle(c);
  if (!clipped.deepest) return false;
  const double reach = breaking_threshold(c.hulls->a) + clipped.depth;
  return std::ranges::any_of(c.answer.points, [&](const PeerPoint& point) {
    return (point.position - *clipped.deepest).norm() <= reach;
  });
}

constexpr Rule kOdeBoxRules[] = {
    {Aspect::Normal, kEdgeFactorOnMesh, wins_by_edge_factor_on_mesh},
    {Aspect::Depth, kClippedPart, deepest_of_what_is_left},
};

constexpr Rule kBulletOnMeshRules[] = {
    {Aspect::Normal, kEpaAccuracy, within_epa_accuracy},
    {Aspect::Deepest, kReplaced, replaced_by_another_triangle},
};

/// The rules for two hulls, and those for a mesh.
std::vector<Rule> bullet_rules(const Peer& peer) {
  const std::span<const Rule> hulls = rules_of(peer, false);
  std::vector<Rule> rules(hulls.begin(), hulls.end());
  rules.insert(rules.end(), std::begin(kBulletOnMeshRules), std::end(kBulletOnMeshRules));
  return rules;
}

}  // namespace

std::span<const Rule> mesh_rules_of(const Peer& peer, bool box) {
  const std::string_view name = peer.name();
  if (name == "Bullet") {
    static const std::vector<Rule> rules = bullet_rules(peer);
    return rules;
  }
  return name == "ODE" && box ? std::span<const Rule>(kOdeBoxRules) : rules_of(peer, false);
}

}  // namespace contactscope::peers
