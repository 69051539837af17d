#include "peers/rules.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "query/support_set.h"

namespace contactscope::peers {
namespace {

// btGjkEpa2.cpp, in single precision.
constexpr double kGjkMinDistance = 1e-4;
constexpr double kEpaAccuracyMetres = 1e-4;
/// btConvexHullComputer rounds vertices to a grid of 10216 cells along the longest axis. A plane
/// through three such vertices is off by a few cells if they are near each other.
constexpr double kHullGrid = 4.0 / 10216;
/// dBoxBox2: fudge_factor.
constexpr double kEdgeFudge = 1.05;
/// btBoxBoxDetector: fudge2. FCL's eps is smaller.
constexpr double kCosineFudgeSize = 1e-5;

double sine_between(const Vec3d& one, const Vec3d& other) { return one.cross(other).norm(); }

/// The largest cosine between an axis and a face normal, either sign.
double face_alignment(const Hull<double>& hull, const Pose<double>& pose, const Vec3d& axis) {
  const Vec3d local = pose.inverse_rotate(axis);
  double best = 0;
  for (const Plane<double>& plane : hull.planes) {
    best = std::max(best, std::abs(plane.normal.dot(local)));
  }
  return best;
}

bool is_face_axis(const Comparison& c, const Vec3d& normal) {
  constexpr double kParallel = 1 - 1e-9;
  return std::max(face_alignment(c.hulls->a, c.hulls->pose_a, normal),
                  face_alignment(c.hulls->b, c.hulls->pose_b, normal)) > kParallel;
}

bool wins_by_edge_factor(const Comparison& c) {
  return c.overlap <= kEdgeFudge * c.depth() + c.tolerance;
}

/// The vertex farthest along a direction, both in the world frame.
Vec3d extreme(const Hull<double>& hull, const Pose<double>& pose, const Vec3d& direction) {
  const int vertex = support_index(support_set(hull), pose.inverse_rotate(direction));
  return pose.transform(hull.vertices[static_cast<std::size_t>(vertex)]);
}

/// Whether the vertex of `corner_owner` that is farthest against `direction` (world, outward from
/// the face) is outside the face's sides.
bool corner_is_outside(const Hull<double>& box, const Pose<double>& pose,
                       const Hull<double>& corner_owner, const Pose<double>& corner_pose,
                       const Vec3d& direction, double tolerance) {
  const Vec3d world = extreme(corner_owner, corner_pose, Vec3d(-direction));
  const Vec3d local = pose.inverse_transform(world);
  const Vec3d along = pose.inverse_rotate(direction);
  for (const Plane<double>& plane : box.planes) {
    if (std::abs(plane.normal.dot(along)) > 0.5) continue;  // the face and its opposite
    if (plane.normal.dot(local) > plane.offset - tolerance) return true;
  }
  return false;
}

bool deepest_corner_is_outside(const Comparison& c) {
  if (c.reported > c.overlap) return false;
  const Vec3d normal = c.answer.deepest()->normal.normalized();
  const test::PairCase<double>& p = *c.hulls;
  const bool of_a = face_alignment(p.a, p.pose_a, normal) > face_alignment(p.b, p.pose_b, normal);
  return of_a ? corner_is_outside(p.a, p.pose_a, p.b, p.pose_b, normal, c.tolerance)
              : corner_is_outside(p.b, p.pose_b, p.a, p.pose_a, Vec3d(-normal), c.tolerance);
}

/// Sine of the angle between the two edges whose cross product is the normal.
double sine_of_edges(const Comparison& c, const Vec3d& normal) {
  double best_alignment = 0;
  double sine = 1;
  for (int i = 0; i < 3; ++i) {
    const Vec3d on_a = c.hulls->pose_a.rotate(Vec3d::Unit(i));
    for (int j = 0; j < 3; ++j) {
      const Vec3d on_b = c.hulls->pose_b.rotate(Vec3d::Unit(j));
      const Vec3d cross = on_a.cross(on_b);
      const double alignment = std::abs(cross.normalized().dot(normal));
      if (alignment <= best_alignment) continue;
      best_alignment = alignment;
      sine = sine_between(on_a, on_b);
    }
  }
  return sine;
}

/// An edge axis is measured by four products with a cosine; each grows up to half extent * fudge.
bool deeper_by_cosine_fudge(const Comparison& c) {
  const Vec3d normal = c.answer.deepest()->normal.normalized();
  if (is_face_axis(c, normal)) return false;
  const double extents = c.hulls->a.vertices[7].sum() + c.hulls->b.vertices[7].sum();
  const double growth = kCosineFudgeSize * extents / sine_of_edges(c, normal);
  return c.reported >= c.overlap && c.reported <= c.overlap + growth + c.tolerance;
}

double least_threshold(const Comparison& c) {
  return std::min(breaking_threshold(c.hulls->a), breaking_threshold(c.hulls->b));
}

/// btPersistentManifold::getCacheEntry: of two points closer than the threshold, the later one
/// replaces the earlier, even if it is less deep.
bool replaced_by_a_neighbour(const Comparison& c) {
  if (c.reported > c.overlap) return false;
  const PeerPoint& point = *c.answer.deepest();
  const Vec3d corner_a = extreme(c.hulls->a, c.hulls->pose_a, point.normal);
  const Vec3d corner_b = extreme(c.hulls->b, c.hulls->pose_b, Vec3d(-point.normal));
  const double nearest =
      std::min((corner_a - point.position).norm(), (corner_b - point.position).norm());
  return nearest <= least_threshold(c) + c.overlap;
}

/// The origin that ODE gets for a hull: see ode.cpp.
Vec3d centroid(const Hull<double>& hull) { return hull.centroid; }

/// fcl::Convex::getInteriorPoint; for a box this equals the centre.
Vec3d mean_of_vertices(const Hull<double>& hull) {
  Vec3d sum = Vec3d::Zero();
  for (const Vec3d& vertex : hull.vertices) sum += vertex;
  return sum / hull.vertex_count();
}

using Centre = Vec3d (*)(const Hull<double>&);

/// MPR (Snethen 2008) follows the line through both centres to its exit from the Minkowski
/// difference, and returns the distance to the triangle that it crosses there. This is at least the
/// least depth and at most the exit distance along the line. So B must still touch A after moving
/// by the depth along the line. The normal is that of the triangle's nearest point.
template <Centre centre> bool on_the_exit(const Comparison& c) {
  if (c.reported < c.depth() - c.tolerance) return false;
  const Vec3d line =
      c.hulls->pose_b.transform(centre(c.hulls->b)) - c.hulls->pose_a.transform(centre(c.hulls->a));
  if (c.answer.deepest()->normal.dot(line) <= 0) return false;
  Pose<double> moved = c.hulls->pose_b;
  moved.position += (c.reported - c.tolerance) * line.normalized();
  return test::brute_force_sat(c.hulls->a, c.hulls->pose_a, c.hulls->b, moved).separation <=
         c.tolerance;
}

/// The distance from a triangle's corner or edge is less than the overlap along it.
template <Centre centre> bool nearest_on_triangle(const Comparison& c) {
  return c.reported <= c.overlap && on_the_exit<centre>(c);
}

bool within_min_distance(const Comparison& c) { return std::abs(c.separation) <= kGjkMinDistance; }

/// EPA starts from a simplex that GJK mistook for an overlap.
bool normal_near_min_distance(const Comparison& c) { return c.depth() <= 2 * kGjkMinDistance; }

/// If the simplex degenerates, btGjkPairDetector returns its current points, which are separated.
bool gave_up_near_the_surface(const Comparison& c) {
  return c.reported < 0 && c.depth() > 0 && c.depth() <= 10 * kGjkMinDistance;
}

bool within_epa_accuracy(const Comparison& c) {
  return c.overlap - c.depth() <= 5 * kEpaAccuracyMetres;
}

/// How far a point is from being `separation` above a face most parallel to `direction` (world,
/// unit), or nearly so: the best of those faces.
double misfit(const Hull<double>& hull, const Pose<double>& pose, const Vec3d& point,
              double separation, const Vec3d& direction) {
  constexpr double kNearlyAsWell = 0.01;
  const Vec3d local = pose.inverse_transform(point);
  const Vec3d along = pose.inverse_rotate(direction);
  double alignment = -1;
  for (const Plane<double>& plane : hull.planes) {
    alignment = std::max(alignment, plane.normal.dot(along));
  }
  double best = std::numeric_limits<double>::infinity();
  for (const Plane<double>& plane : hull.planes) {
    if (plane.normal.dot(along) < alignment - kNearlyAsWell) continue;
    best = std::min(best, std::abs(plane.distance(local) - separation));
  }
  return best;
}

/// In units of the larger hull's radius.
double misfit(const Comparison& c) {
  const PeerPoint& point = *c.answer.deepest();
  const Vec3d normal = point.normal.normalized();
  const Vec3d half = 0.5 * point.separation * normal;
  const double off = std::min(
      misfit(c.hulls->a, c.hulls->pose_a, point.position + half, point.separation, normal),
      misfit(c.hulls->b, c.hulls->pose_b, point.position - half, point.separation, Vec3d(-normal)));
  return (off - c.tolerance) / std::max(c.hulls->a.radius, c.hulls->b.radius);
}

/// btPolyhedralContactClipping measures the clipped corners of one hull from the plane of the
/// other's best-facing face, whatever the normal, and drops those outside that face.
bool measured_to_a_face_plane(const Comparison& c) {
  return !c.answer.points.empty() && misfit(c) <= 2 * kHullGrid;
}

/// It limits the depth to the one that GJK and EPA found plus the threshold.
bool clamped_by_threshold(const Comparison& c) {
  return std::abs(c.reported - c.overlap - least_threshold(c)) <= kEpaAccuracyMetres;
}

constexpr Rule kBoxRules[] = {
    {Aspect::Normal, kEdgeFactor, wins_by_edge_factor},
    {Aspect::Depth, kCornerOutside, deepest_corner_is_outside},
};

constexpr Rule kBulletBoxRules[] = {
    {Aspect::Normal, kEdgeFactor, wins_by_edge_factor},
    {Aspect::Depth, kCornerOutside, deepest_corner_is_outside},
    {Aspect::Depth, kCosineFudge, deeper_by_cosine_fudge},
    {Aspect::Depth, kMerged, replaced_by_a_neighbour},
};

constexpr Rule kOdeHullRules[] = {
    {Aspect::Normal, kExitDepth, on_the_exit<centroid>},
    {Aspect::Depth, kExitDepth, nearest_on_triangle<centroid>},
};

constexpr Rule kFclHullRules[] = {
    {Aspect::Normal, kExitDepth, on_the_exit<mean_of_vertices>},
    {Aspect::Depth, kExitDepth, nearest_on_triangle<mean_of_vertices>},
};

constexpr Rule kBulletHullRules[] = {
    {Aspect::Touching, kMinDistance, within_min_distance},
    {Aspect::Touching, kFacePlane, measured_to_a_face_plane},
    {Aspect::Touching, kGaveUp, gave_up_near_the_surface},
    {Aspect::Normal, kMinDistance, normal_near_min_distance},
    {Aspect::Normal, kEpaAccuracy, within_epa_accuracy},
    {Aspect::Depth, kFacePlane, measured_to_a_face_plane},
    {Aspect::Depth, kClamped, clamped_by_threshold},
    {Aspect::Depth, kMinDistance, within_min_distance},
};

}  // namespace

double breaking_threshold(const Hull<double>& hull) {
  Vec3d low = hull.vertices[0];
  Vec3d high = low;
  for (const Vec3d& vertex : hull.vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  return 0.02 * (0.5 * (high - low).norm() + 0.5 * (high + low).norm());
}

std::span<const Rule> rules_of(const Peer& peer, bool boxes) {
  const std::string_view name = peer.name();
  if (name == "Bullet") return boxes ? std::span<const Rule>(kBulletBoxRules) : kBulletHullRules;
  if (boxes) return kBoxRules;
  return name == "ODE" ? std::span<const Rule>(kOdeHullRules) : kFclHullRules;
}

double tolerance_of(const Peer& peer, double length_scale) {
  // Bullet rounds to float a few dozen times; ODE and FCL stop MPR at steps of a millionth.
  const double relative = std::max(2e-6, 100 * peer.epsilon());
  return relative * length_scale;
}

}  // namespace contactscope::peers
