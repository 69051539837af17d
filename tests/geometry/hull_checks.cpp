#include "geometry/hull_checks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace contactscope::test {
namespace {

using ::testing::AssertionFailure;
using ::testing::AssertionResult;
using ::testing::AssertionSuccess;

}  // namespace

AssertionResult is_sound(const Hull<double>& hull) {
  const int vertices = hull.vertex_count();
  const int edges = hull.edge_count();
  const int faces = hull.face_count();
  if (vertices - edges + faces != 2) {
    return AssertionFailure() << "V - E + F = " << vertices << " - " << edges << " + " << faces;
  }
  if (hull.vertex_edges.size() != hull.vertices.size() ||
      hull.face_edges.size() != hull.planes.size() || hull.half_edges.size() % 2 != 0) {
    return AssertionFailure() << "sizes do not fit together";
  }
  std::vector<int> degree(hull.vertices.size(), 0);
  for (std::size_t i = 0; i < hull.half_edges.size(); ++i) {
    const HalfEdge& edge = hull.half_edges[i];
    const HalfEdge& twin = hull.half_edges[i ^ 1];
    if (edge.origin < 0 || edge.origin >= vertices || edge.face < 0 || edge.face >= faces ||
        edge.next < 0 || edge.next >= 2 * edges) {
      return AssertionFailure() << "half-edge " << i << " points outside";
    }
    const HalfEdge& next = hull.half_edges[static_cast<std::size_t>(edge.next)];
    if (next.origin != twin.origin) {
      return AssertionFailure() << "half-edge " << i << " ends where its twin does not begin";
    }
    if (twin.origin == edge.origin || twin.face == edge.face) {
      return AssertionFailure() << "half-edge " << i << " and its twin do not run opposite";
    }
    if (next.face != edge.face) return AssertionFailure() << "the loop leaves face " << edge.face;
    ++degree[static_cast<std::size_t>(edge.origin)];
  }
  for (std::size_t i = 0; i < degree.size(); ++i) {
    if (degree[i] < 3)
      return AssertionFailure() << "vertex " << i << " has " << degree[i] << " edges";
    const int leaving = hull.vertex_edges[i];
    if (hull.half_edges[static_cast<std::size_t>(leaving)].origin != static_cast<int>(i)) {
      return AssertionFailure() << "vertex_edges of " << i << " leaves another vertex";
    }
  }
  std::size_t visited = 0;
  for (int face = 0; face < faces; ++face) {
    const int first = hull.face_edges[static_cast<std::size_t>(face)];
    if (hull.half_edges[static_cast<std::size_t>(first)].face != face) {
      return AssertionFailure() << "face_edges of " << face << " is in another face";
    }
    const std::vector<int> loop = face_vertices(hull, face);
    const std::vector<int>::difference_type distinct = [&] {
      std::vector<int> sorted = loop;
      std::sort(sorted.begin(), sorted.end());
      return std::unique(sorted.begin(), sorted.end()) - sorted.begin();
    }();
    if (loop.size() < 3 || distinct != static_cast<std::ptrdiff_t>(loop.size())) {
      return AssertionFailure() << "face " << face << " is no polygon";
    }
    visited += loop.size();
  }
  if (visited != hull.half_edges.size()) return AssertionFailure() << "loops miss half-edges";
  Hull<double> laid_out = hull;
  lay_out(laid_out);
  if (hull.lanes != laid_out.lanes) return AssertionFailure() << "lanes differ from the hull";
  return AssertionSuccess();
}

AssertionResult is_convex(const Hull<double>& hull, double tolerance) {
  for (int face = 0; face < hull.face_count(); ++face) {
    const Plane<double>& plane = hull.planes[static_cast<std::size_t>(face)];
    if (!(std::abs(plane.normal.norm() - 1) < 1e-12)) {
      return AssertionFailure() << "the normal of face " << face << " is not unit";
    }
    for (std::size_t i = 0; i < hull.vertices.size(); ++i) {
      const double distance = plane.distance(hull.vertices[i]);
      if (!(distance <= tolerance)) {
        return AssertionFailure() << "vertex " << i << " is " << distance << " above face " << face;
      }
    }
    const std::vector<int> loop = face_vertices(hull, face);
    Vec3d area = Vec3d::Zero();
    const Vec3d first = hull.vertices[static_cast<std::size_t>(loop[0])];
    for (std::size_t i = 2; i < loop.size(); ++i) {
      const Vec3d one = hull.vertices[static_cast<std::size_t>(loop[i - 1])] - first;
      const Vec3d other = hull.vertices[static_cast<std::size_t>(loop[i])] - first;
      area += one.cross(other);
    }
    if (!(area.dot(plane.normal) > 0)) {
      return AssertionFailure() << "face " << face << " is not counter-clockwise";
    }
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const auto corner = [&](std::size_t k) -> Vec3d {
        return hull.vertices[static_cast<std::size_t>(loop[k % loop.size()])];
      };
      const Vec3d line = (corner(i + 2) - corner(i)).normalized();
      const Vec3d arm = corner(i + 1) - corner(i);
      if (!(line.cross(arm).dot(plane.normal) <= tolerance)) {
        return AssertionFailure() << "the outline of face " << face << " turns inwards by "
                                  << line.cross(arm).dot(plane.normal);
      }
    }
    for (const int vertex : loop) {
      const double distance = plane.distance(hull.vertices[static_cast<std::size_t>(vertex)]);
      if (!(distance >= -tolerance)) {
        return AssertionFailure() << "face " << face << " is not flat: vertex " << vertex << " is "
                                  << distance << " off";
      }
    }
    if (!(plane.distance(hull.centroid) < 0)) {
      return AssertionFailure() << "the centroid is above face " << face;
    }
  }
  return AssertionSuccess();
}

Measures measure(const Hull<double>& hull) {
  Measures measures;
  const Vec3d apex = hull.vertices[0];
  for (int face = 0; face < hull.face_count(); ++face) {
    const std::vector<int> loop = face_vertices(hull, face);
    const Vec3d a = hull.vertices[static_cast<std::size_t>(loop[0])];
    for (std::size_t i = 2; i < loop.size(); ++i) {
      const Vec3d ab = hull.vertices[static_cast<std::size_t>(loop[i - 1])] - a;
      const Vec3d ac = hull.vertices[static_cast<std::size_t>(loop[i])] - a;
      const Vec3d twice_area = ab.cross(ac);
      const Vec3d arm = a - apex;
      measures.area += twice_area.norm() / 2;
      measures.volume += twice_area.dot(arm) / 6;
    }
  }
  return measures;
}

double support_error(const Hull<double>& hull, const std::vector<Vec3d>& points,
                     const std::vector<Vec3d>& directions) {
  double largest = 0;
  for (const Vec3d& direction : directions) {
    const auto reach = [&](const std::vector<Vec3d>& of) {
      double farthest = direction.dot(of[0]);
      for (const Vec3d& point : of) farthest = std::max(farthest, direction.dot(point));
      return farthest;
    };
    largest = std::max(largest, std::abs(reach(points) - reach(hull.vertices)));
  }
  return largest;
}

std::vector<int> face_sizes(const Hull<double>& hull) {
  std::vector<int> sizes;
  for (int face = 0; face < hull.face_count(); ++face) {
    sizes.push_back(static_cast<int>(face_vertices(hull, face).size()));
  }
  std::sort(sizes.begin(), sizes.end());
  return sizes;
}

}  // namespace contactscope::test
