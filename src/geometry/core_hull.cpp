#include "geometry/core_hull.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

#include "geometry/hull_builder.h"
#include "geometry/hull_from_polygons.h"

namespace contactscope {
namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

/// The faces of a hull around each of its vertices, counter-clockwise seen from outside.
std::vector<int> faces_around(const Hull<double>& hull, int vertex) {
  std::vector<int> faces;
  const int first = hull.vertex_edges[at(vertex)];
  int edge = first;
  do {
    faces.push_back(hull.half_edges[at(edge)].face);
    edge = hull.half_edges[at(Hull<double>::twin(edge))].next;  // to the right
  } while (edge != first);
  std::reverse(faces.begin(), faces.end());
  return faces;
}

/// A corner of the core: the moved planes that meet there, and the place.
struct Corner {
  std::vector<int> faces;  // of the original, ascending
  Vec3d place;
  int original = 0;  // vertex that it stands for
};

/// Where the planes n . x = offset meet: three of them by Cramer's rule, which is exact for boxes,
/// more by least squares.
Vec3d meet(const std::vector<Plane<double>>& planes) {
  if (planes.size() == 3) {
    const Vec3d& a = planes[0].normal;
    const Vec3d& b = planes[1].normal;
    const Vec3d& c = planes[2].normal;
    const Vec3d bc = b.cross(c), ca = c.cross(a), ab = a.cross(b);
    const Vec3d sum = planes[0].offset * bc + planes[1].offset * ca + planes[2].offset * ab;
    return sum / a.dot(bc);
  }
  Mat3<double> normal_matrix = Mat3<double>::Zero();
  Vec3d right = Vec3d::Zero();
  for (const Plane<double>& plane : planes) {
    normal_matrix += plane.normal * plane.normal.transpose();
    right += plane.offset * plane.normal;
  }
  return normal_matrix.ldlt().solve(right);
}

/// Half-spaces about a point inside of them.
struct HalfSpaces {
  Vec3d inside;
  std::vector<Plane<double>> planes;  // about `inside`: every offset > 0
};

/// The polar dual: the half-space n . x <= t, t > 0, becomes the point n / t. The convex hull of
/// these points has a vertex for every half-space that bounds the intersection, and a face for every
/// vertex of it. Stretched along the axes to about a cube, which changes no topology: a plate's dual
/// is a needle, and the builder's tolerance is relative to the needle's length.
std::vector<Vec3d> polar_dual(const HalfSpaces& spaces) {
  std::vector<Vec3d> points;
  Vec3d extent = Vec3d::Zero();
  for (const Plane<double>& plane : spaces.planes) {
    points.push_back(plane.normal / plane.offset);
    extent = extent.cwiseMax(points.back().cwiseAbs());
  }
  for (Vec3d& point : points) point = point.cwiseQuotient(extent);
  return points;
}

/// Of each vertex of `built` the place in `points`, whose order the hull builder keeps.
std::vector<int> places_of(const Hull<double>& built, const std::vector<Vec3d>& points) {
  std::vector<int> places;
  auto from = points.begin();
  for (const Vec3d& vertex : built.vertices) {
    from = std::find(from, points.end(), vertex);
    places.push_back(static_cast<int>(from - points.begin()));
    ++from;
  }
  return places;
}

/// The original's vertex with the most of the corner's faces, the nearest among equals.
int vertex_that_it_stands_for(const Hull<double>& hull,
                              const std::vector<std::vector<int>>& faces_of, const Corner& corner) {
  int best = 0, most = -1;
  double least = std::numeric_limits<double>::infinity();
  for (int vertex = 0; vertex < hull.vertex_count(); ++vertex) {
    const auto shared = static_cast<int>(std::ranges::count_if(corner.faces, [&](int face) {
      return std::ranges::find(faces_of[at(vertex)], face) != faces_of[at(vertex)].end();
    }));
    const Vec3d way = hull.vertices[at(vertex)] - corner.place;
    const double distance = way.squaredNorm();
    if (shared > most || (shared == most && distance < least)) {
      best = vertex;
      most = shared;
      least = distance;
    }
  }
  return best;
}

/// The original's edge between two of its faces; else the vertex that `corner` stands for.
FeatureRef edge_that_it_stands_for(const Hull<double>& hull, int left, int right,
                                   const Corner& corner) {
  const int first = hull.face_edges[at(left)];
  int edge = first;
  do {
    const HalfEdge& half_edge = hull.half_edges[at(edge)];
    if (hull.half_edges[at(Hull<double>::twin(edge))].face == right)
      return edge_ref(Owner::A, edge / 2);
    edge = half_edge.next;
  } while (edge != first);
  return vertex_ref(Owner::A, corner.original);
}

CoreHull itself(const Hull<double>& hull, bool reduced) {
  CoreHull core{hull, 0, reduced, {}, {}, {}};
  for (int i = 0; i < hull.vertex_count(); ++i) core.vertices.push_back(vertex_ref(Owner::A, i));
  for (int i = 0; i < hull.edge_count(); ++i) core.edges.push_back(edge_ref(Owner::A, i));
  for (int i = 0; i < hull.face_count(); ++i) core.faces.push_back(face_ref(Owner::A, i));
  return core;
}

/// Corners in the order of the vertices that they stand for; `dual` is the hull of the polar dual,
/// `face_of` the original's face of each of its vertices. `order[f]` is the corner of dual face f.
std::vector<Corner> corners_of(const Hull<double>& hull, const HalfSpaces& spaces,
                               const Hull<double>& dual, const std::vector<int>& face_of,
                               std::vector<int>& order) {
  std::vector<std::vector<int>> faces_of;
  for (int i = 0; i < hull.vertex_count(); ++i) faces_of.push_back(faces_around(hull, i));
  std::vector<Corner> corners;
  for (int face = 0; face < dual.face_count(); ++face) {
    Corner& corner = corners.emplace_back();
    for (const int vertex : face_vertices(dual, face)) corner.faces.push_back(face_of[at(vertex)]);
    std::ranges::sort(corner.faces);
    std::vector<Plane<double>> planes;
    for (const int f : corner.faces) planes.push_back(spaces.planes[at(f)]);
    corner.place = spaces.inside + meet(planes);
    corner.original = vertex_that_it_stands_for(hull, faces_of, corner);
  }
  std::vector<int> sorted(corners.size());
  std::iota(sorted.begin(), sorted.end(), 0);
  std::ranges::stable_sort(sorted, {}, [&](int i) { return corners[at(i)].original; });
  order.resize(corners.size());
  std::vector<Corner> result;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    order[at(sorted[i])] = static_cast<int>(i);
    result.push_back(corners[at(sorted[i])]);
  }
  return result;
}

/// Starts a face's outline where the original's face starts, so that edges are numbered alike.
void start_as(const Hull<double>& hull, int face, const std::vector<Corner>& corners,
              std::vector<int>& outline) {
  const int first = hull.half_edges[at(hull.face_edges[at(face)])].origin;
  const auto start = std::ranges::find_if(
      outline, [&](int corner) { return corners[at(corner)].original == first; });
  if (start != outline.end()) std::rotate(outline.begin(), start, outline.end());
}

/// Source: de Berg et al., "Computational Geometry", 11.4: half-space intersection by the convex
/// hull of the dual points. Steps: 1. move the faces; 2. the hull of their duals; 3. its faces are
/// the core's vertices, found from the planes themselves, so that the stretching and the merging
/// cost no digits; 4. its vertices are the core's faces, with the corners around them in order.
CoreHull intersect(const Hull<double>& hull, double margin) {
  HalfSpaces spaces{hull.centroid, {}};
  for (const Plane<double>& plane : hull.planes)
    spaces.planes.push_back(
        {plane.normal, plane.offset - plane.normal.dot(hull.centroid) - margin});
  const std::vector<Vec3d> points = polar_dual(spaces);
  const Hull<double> dual = build_hull(points, {.weld_duplicates = true});
  const std::vector<int> face_of = places_of(dual, points);

  CoreHull core;
  std::vector<int> order;
  const std::vector<Corner> corners = corners_of(hull, spaces, dual, face_of, order);
  std::vector<Vec3d> places;
  for (const Corner& corner : corners) {
    places.push_back(corner.place);
    core.vertices.push_back(vertex_ref(Owner::A, corner.original));
  }
  std::vector<std::vector<int>> outlines;
  for (int vertex = 0; vertex < dual.vertex_count(); ++vertex) {
    std::vector<int>& outline = outlines.emplace_back();
    for (const int face : faces_around(dual, vertex)) outline.push_back(order[at(face)]);
    start_as(hull, face_of[at(vertex)], corners, outline);
    core.faces.push_back(face_ref(Owner::A, face_of[at(vertex)]));
  }
  core.hull = hull_from_polygons(std::move(places), outlines);
  for (int face = 0; face < core.hull.face_count(); ++face) {
    const Plane<double>& plane = hull.planes[core.faces[at(face)].index];
    core.hull.planes[at(face)] = {plane.normal, plane.offset - margin};
  }
  lay_out(core.hull);
  for (int edge = 0; edge < core.hull.edge_count(); ++edge) {
    const HalfEdge& left = core.hull.half_edges[at(2 * edge)];
    const HalfEdge& right = core.hull.half_edges[at(2 * edge + 1)];
    core.edges.push_back(edge_that_it_stands_for(
        hull, static_cast<int>(core.faces[at(left.face)].index),
        static_cast<int>(core.faces[at(right.face)].index), corners[at(left.origin)]));
  }
  return core;
}

}  // namespace

CoreHull core_hull(const Hull<double>& hull, double margin) {
  double room = std::numeric_limits<double>::infinity();
  for (const Plane<double>& plane : hull.planes)
    room = std::min(room, plane.offset - plane.normal.dot(hull.centroid));
  const double moved = std::min(margin, kLargestCoreShare * room);
  if (hull.flat() || !(moved > 0)) return itself(hull, margin > 0);
  try {
    CoreHull core = intersect(hull, moved);
    core.margin = moved;
    core.reduced = moved < margin;
    return core;
  } catch (const HullError&) {
    return itself(hull, true);
  }
}

}  // namespace contactscope
