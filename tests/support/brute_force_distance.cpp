#include "support/brute_force_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace contactscope::test {
namespace {

constexpr std::size_t kAllTrianglesUpTo = 6;

ExtendedPoint placed(const Vec3d& point, const Pose<double>& pose) {
  const Eigen::Quaternion<Extended> rotation = pose.rotation.cast<Extended>().normalized();
  return rotation * point.cast<Extended>() + pose.position.cast<Extended>();
}

const ExtendedPoint& vertex(const Features& features, int i) {
  return features.vertices[static_cast<std::size_t>(i)];
}

ExtendedPoint on_segment(const ExtendedPoint& point, const ExtendedPoint& from,
                         const ExtendedPoint& to) {
  const ExtendedPoint along = to - from;
  const Extended squared = along.squaredNorm();
  if (squared == 0) return from;
  const ExtendedPoint offset = point - from;
  const Extended parameter = std::clamp<Extended>(offset.dot(along) / squared, 0, 1);
  return from + parameter * along;
}

class Nearest {
 public:
  void offer(const ExtendedPoint& on_a, const ExtendedPoint& on_b) {
    const Extended distance = (on_b - on_a).norm();
    if (distance < best_.distance) best_ = {distance, on_a, on_b};
  }
  const BruteForceDistance& best() const { return best_; }

 private:
  BruteForceDistance best_{std::numeric_limits<Extended>::infinity(), ExtendedPoint::Zero(),
                           ExtendedPoint::Zero()};
};

/// Offers each end with the other segment, and the two feet of the common perpendicular.
void offer_segments(const ExtendedPoint& p0, const ExtendedPoint& p1, const ExtendedPoint& q0,
                    const ExtendedPoint& q1, Nearest& nearest) {
  nearest.offer(p0, on_segment(p0, q0, q1));
  nearest.offer(p1, on_segment(p1, q0, q1));
  nearest.offer(on_segment(q0, p0, p1), q0);
  nearest.offer(on_segment(q1, p0, p1), q1);
  const ExtendedPoint u = p1 - p0;
  const ExtendedPoint v = q1 - q0;
  if (u.squaredNorm() == 0 || v.squaredNorm() == 0) return;
  // Gram-Schmidt: the part of v across u locates the crossing of q with the line of p.
  const ExtendedPoint across = v - v.dot(u) / u.squaredNorm() * u;
  if (across.squaredNorm() == 0) return;
  const ExtendedPoint offset = p0 - q0;
  const Extended t = offset.dot(across) / across.squaredNorm();
  if (!(t > 0 && t < 1)) return;
  const ExtendedPoint on_q = q0 + t * v;
  nearest.offer(on_segment(on_q, p0, p1), on_q);
}

/// The foot of the perpendicular, if it lies inside the triangle.
bool foot_inside(const ExtendedPoint& point, const ExtendedPoint& a, const ExtendedPoint& b,
                 const ExtendedPoint& c, ExtendedPoint& foot) {
  const ExtendedPoint normal = (b - a).cross(c - a);
  const Extended squared = normal.squaredNorm();
  if (squared == 0) return false;
  const ExtendedPoint offset = point - a;
  foot = point - offset.dot(normal) / squared * normal;
  const std::array<ExtendedPoint, 3> corners{a, b, c};
  for (std::size_t i = 0; i < 3; ++i) {
    const ExtendedPoint side = corners[(i + 1) % 3] - corners[i];
    const ExtendedPoint inward = normal.cross(side);
    const ExtendedPoint from_corner = foot - corners[i];
    if (from_corner.dot(inward) < 0) return false;
  }
  return true;
}

void offer_vertices_and_faces(const Features& a, const Features& b, bool swapped,
                              Nearest& nearest) {
  for (const ExtendedPoint& point : a.vertices) {
    for (const auto& [i, j, k] : b.triangles) {
      ExtendedPoint foot;
      if (!foot_inside(point, vertex(b, i), vertex(b, j), vertex(b, k), foot)) continue;
      if (swapped) {
        nearest.offer(foot, point);
      } else {
        nearest.offer(point, foot);
      }
    }
  }
}

/// Whether clipping the segment by the half-spaces of all faces leaves a part in the polyhedron.
bool enters(const ExtendedPoint& from, const ExtendedPoint& to, const Features& solid) {
  if (solid.triangles.empty()) return false;
  Extended first = 0, last = 1;
  const auto some_is_left_behind = [&](const ExtendedPoint& corner, const ExtendedPoint& normal) {
    const Extended start = normal.dot(from - corner);
    const Extended end = normal.dot(to - corner);
    if (start > 0 && end > 0) return false;
    if (start > 0) first = std::max(first, start / (start - end));
    if (end > 0) last = std::min(last, start / (start - end));
    return first <= last;
  };
  for (const auto& [i, j, k] : solid.triangles) {
    const ExtendedPoint& corner = vertex(solid, i);
    const ExtendedPoint normal = (vertex(solid, j) - corner).cross(vertex(solid, k) - corner);
    if (!some_is_left_behind(corner, normal)) return false;
  }
  for (const auto& [corner, outward] : solid.walls)
    if (!some_is_left_behind(corner, outward)) return false;
  return true;
}

bool any_edge_enters(const Features& edges_of, const Features& solid) {
  for (const auto& [i, j] : edges_of.edges) {
    if (enters(vertex(edges_of, i), vertex(edges_of, j), solid)) return true;
  }
  if (!edges_of.edges.empty()) return false;
  return enters(edges_of.vertices[0], edges_of.vertices[0], solid);
}

void add_face(const std::vector<int>& loop, Features& features) {
  const std::size_t count = loop.size();
  const bool all = count <= kAllTrianglesUpTo;
  for (std::size_t i = 0; i < (all ? count : 1); ++i) {
    for (std::size_t j = i + 1; j < count; ++j) {
      if (j > i + 1 && !(i == 0 && j + 1 == count)) features.edges.push_back({loop[i], loop[j]});
      const std::size_t k_end = all ? count : std::min(j + 2, count);
      for (std::size_t k = j + 1; k < k_end; ++k) {
        features.triangles.push_back({loop[i], loop[j], loop[k]});
      }
    }
  }
}

}  // namespace

Features features_of_point(const Vec3d& point, const Pose<double>& pose) {
  return {{placed(point, pose)}, {}, {}};
}

Features features_of_segment(const Vec3d& from, const Vec3d& to, const Pose<double>& pose) {
  return {{placed(from, pose), placed(to, pose)}, {{0, 1}}, {}};
}

Features features_of_triangle(const std::array<ExtendedPoint, 3>& corners) {
  Features face{{corners[0], corners[1], corners[2]}, {{0, 1}, {1, 2}, {2, 0}}, {}, {}};
  const ExtendedPoint normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  if (normal.squaredNorm() == 0) return face;
  face.triangles = {{0, 1, 2}, {0, 2, 1}};
  for (std::size_t i = 0; i < 3; ++i)
    face.walls.push_back({corners[i], (corners[(i + 1) % 3] - corners[i]).cross(normal)});
  return face;
}

Features features_of(const Hull<double>& hull, const Pose<double>& pose) {
  Features features;
  for (const Vec3d& point : hull.vertices) features.vertices.push_back(placed(point, pose));
  for (int e = 0; e < hull.edge_count(); ++e) {
    features.edges.push_back({hull.half_edges[static_cast<std::size_t>(2 * e)].origin,
                              hull.half_edges[static_cast<std::size_t>(2 * e + 1)].origin});
  }
  for (int f = 0; f < hull.face_count(); ++f) add_face(face_vertices(hull, f), features);
  if (!hull.flat()) return features;
  const std::vector<int> loop = face_vertices(hull, 0);
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const ExtendedPoint& from = vertex(features, loop[i]);
    const ExtendedPoint& to = vertex(features, loop[(i + 1) % loop.size()]);
    const ExtendedPoint& third = vertex(features, loop[(i + 2) % loop.size()]);
    const ExtendedPoint normal = (to - from).cross(third - to);
    features.walls.push_back({from, (to - from).cross(normal)});
  }
  return features;
}

BruteForceDistance brute_force_distance(const Features& a, const Features& b) {
  if (any_edge_enters(a, b) || any_edge_enters(b, a)) {
    return {0, ExtendedPoint::Zero(), ExtendedPoint::Zero()};
  }
  Nearest nearest;
  for (const ExtendedPoint& on_a : a.vertices) {
    for (const ExtendedPoint& on_b : b.vertices) nearest.offer(on_a, on_b);
  }
  for (const auto& [i, j] : a.edges) {
    for (const ExtendedPoint& point : b.vertices) {
      nearest.offer(on_segment(point, vertex(a, i), vertex(a, j)), point);
    }
  }
  for (const auto& [i, j] : b.edges) {
    for (const ExtendedPoint& point : a.vertices) {
      nearest.offer(point, on_segment(point, vertex(b, i), vertex(b, j)));
    }
  }
  offer_vertices_and_faces(a, b, false, nearest);
  offer_vertices_and_faces(b, a, true, nearest);
  for (const auto& [i, j] : a.edges) {
    const ExtendedPoint middle = (vertex(a, i) + vertex(a, j)) / 2;
    const Extended half = (vertex(a, i) - vertex(a, j)).norm() / 2;
    for (const auto& [k, l] : b.edges) {
      // Most pairs are settled by balls around both edges that are farther away than the best.
      const Extended reach = half + (vertex(b, k) - vertex(b, l)).norm() / 2;
      const Extended separation = (middle - (vertex(b, k) + vertex(b, l)) / 2).norm();
      if (separation - reach > nearest.best().distance) continue;
      offer_segments(vertex(a, i), vertex(a, j), vertex(b, k), vertex(b, l), nearest);
    }
  }
  return nearest.best();
}

Extended segment_distance_by_search(const ExtendedPoint& from_a, const ExtendedPoint& to_a,
                                    const ExtendedPoint& from_b, const ExtendedPoint& to_b) {
  const auto distance_at = [&](Extended parameter) {
    const ExtendedPoint point = from_a + parameter * (to_a - from_a);
    return (on_segment(point, from_b, to_b) - point).norm();
  };
  Extended low = 0, high = 1;
  for (int step = 0; step < 200 && low < high; ++step) {
    const Extended third = (high - low) / 3;
    if (distance_at(low + third) < distance_at(high - third)) {
      high -= third;
    } else {
      low += third;
    }
  }
  return std::min({distance_at((low + high) / 2), distance_at(0), distance_at(1)});
}

double extent(const Features& a, const Features& b) {
  Extended largest = 0;
  const ExtendedPoint& first = a.vertices[0];
  for (const Features* features : {&a, &b}) {
    for (const ExtendedPoint& point : features->vertices) {
      largest = std::max(largest, (point - first).norm());
    }
  }
  return static_cast<double>(largest);
}

}  // namespace contactscope::test
