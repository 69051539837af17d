#include "geometry/core_hull.h"

#include "geometry/hull_builder.h"

namespace contactscope {
namespace {

/// Faces of a hull around a vertex, counter-clockwise seen from outside.
std::vector<int> faces_around(const Hull<double>& hull, int vertex) {
  std::vector<int> faces;
  for (const int edge : hull.around_vertex(vertex)) faces.push_back(at(hull.half_edges, edge).face);
  std::ranges::reverse(faces);
  return faces;
}

/// Corner of the core where moved planes meet.
struct Corner {
  std::vector<int> faces;  // face indices of the original, ascending
  Vec3d place;
  int original;   // vertex of the original that it corresponds to
  int dual_face;  // face of the polar dual's hull
};

/// Intersection of the planes n . x = offset: three planes by Cramer's rule, which is exact for
/// boxes, more by least squares.
Vec3d meet(const std::vector<Plane<double>>& planes) {
  if (planes.size() == 3) {
    const Vec3d &a = planes[0].normal, &b = planes[1].normal;
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

/// Polar dual: the half-space n . x <= t, t > 0, becomes the point n / t. The convex hull of these
/// points has a vertex for every half-space that bounds the intersection, and a face for every
/// vertex of it. The points are stretched along the axes to about a cube, which keeps the topology:
/// the dual of a plate is a needle, and the builder's tolerance is relative to the needle's length.
std::vector<Vec3d> polar_dual(const std::vector<Plane<double>>& planes) {
  std::vector<Vec3d> points = mapped(
      planes, [](const Plane<double>& plane) -> Vec3d { return plane.normal / plane.offset; });
  Vec3d extent = Vec3d::Zero();
  for (const Vec3d& point : points) extent = extent.cwiseMax(point.cwiseAbs());
  for (Vec3d& point : points) point = point.cwiseQuotient(extent);
  return points;
}

/// For each vertex of `built` its index in `points`. The hull builder keeps their order.
std::vector<int> places_of(const Hull<double>& built, const std::vector<Vec3d>& points) {
  auto from = points.begin();
  return mapped(built.vertices, [&](const Vec3d& vertex) {
    from = std::find(from, points.end(), vertex);
    return static_cast<int>(from++ - points.begin());
  });
}

/// The original's vertex that shares the most faces with the corner; the nearest on a tie.
int vertex_that_it_stands_for(const Hull<double>& hull,
                              const std::vector<std::vector<int>>& faces_of, const Corner& corner) {
  std::tuple<std::ptrdiff_t, double, int> best{1, 0, -1};
  for (int vertex = 0; vertex < hull.vertex_count(); ++vertex) {
    const auto shared = std::ranges::count_if(corner.faces, [&](int face) {
      return std::ranges::find(at(faces_of, vertex), face) != at(faces_of, vertex).end();
    });
    const Vec3d displacement = at(hull.vertices, vertex) - corner.place;
    best = std::min(best, {-shared, displacement.squaredNorm(), vertex});
  }
  return std::get<int>(best);
}

/// The original's edge between two of its faces, or else the vertex of `corner`.
FeatureRef edge_that_it_stands_for(const Hull<double>& hull, int left, int right,
                                   const Corner& corner) {
  for (const int edge : hull.around_face(left))
    if (at(hull.half_edges, Hull<double>::twin(edge)).face == right)
      return edge_ref(Owner::A, edge / 2);
  return vertex_ref(Owner::A, corner.original);
}

CoreHull itself(const Hull<double>& hull, bool reduced) {
  CoreHull core{hull, 0, reduced, {}, {}, {}};
  for (int i = 0; i < hull.vertex_count(); ++i) core.vertices.push_back(vertex_ref(Owner::A, i));
  for (int i = 0; i < hull.edge_count(); ++i) core.edges.push_back(edge_ref(Owner::A, i));
  for (int i = 0; i < hull.face_count(); ++i) core.faces.push_back(face_ref(Owner::A, i));
  return core;
}

/// Corners in the order of their original vertices. `planes`: moved, relative to the centroid;
/// `dual`: the hull of their polar dual, whose vertices `face_of` maps to original faces.
std::vector<Corner> corners_of(const Hull<double>& hull, const std::vector<Plane<double>>& planes,
                               const Hull<double>& dual, const std::vector<int>& face_of) {
  std::vector<std::vector<int>> faces_of;
  for (int i = 0; i < hull.vertex_count(); ++i) faces_of.push_back(faces_around(hull, i));
  std::vector<Corner> corners;
  for (int face = 0; face < dual.face_count(); ++face) {
    const auto original = [&](int vertex) { return at(face_of, vertex); };
    Corner corner{mapped(face_vertices(dual, face), original), {}, 0, face};
    std::ranges::sort(corner.faces);
    corner.place = hull.centroid + meet(mapped(corner.faces, [&](int f) { return at(planes, f); }));
    corner.original = vertex_that_it_stands_for(hull, faces_of, corner);
    corners.push_back(std::move(corner));
  }
  std::ranges::stable_sort(corners, {}, &Corner::original);
  return corners;
}

/// Half-space intersection by the convex hull of the dual points: de Berg et al., "Computational
/// Geometry", 11.4. Steps: 1. move the faces; 2. build the hull of their duals; 3. its faces become
/// the core's vertices, computed from the planes themselves so that stretching and merging cost no
/// digits; 4. its vertices become the core's faces, with the corners around them in order.
CoreHull intersect(const Hull<double>& hull, double margin) {
  const std::vector<Plane<double>> planes =
      mapped(hull.planes, [&](const Plane<double>& plane) -> Plane<double> {
        return {plane.normal, plane.offset - plane.normal.dot(hull.centroid) - margin};
      });
  const std::vector<Vec3d> points = polar_dual(planes);
  const Hull<double> dual = build_hull(points, {.weld_duplicates = true});
  const std::vector<int> face_of = places_of(dual, points);

  CoreHull core;
  const std::vector<Corner> corners = corners_of(hull, planes, dual, face_of);
  std::vector<int> corner_of(corners.size());  // indexed by face of the dual
  for (int i = 0; i < count_of(corners); ++i) {
    at(corner_of, at(corners, i).dual_face) = i;
    core.vertices.push_back(vertex_ref(Owner::A, at(corners, i).original));
  }
  std::vector<std::vector<int>> outlines;
  for (int vertex = 0; vertex < dual.vertex_count(); ++vertex) {
    std::vector<int>& outline = outlines.emplace_back(
        mapped(faces_around(dual, vertex), [&](int face) { return at(corner_of, face); }));
    // Start where the original's face starts, so that edges have the same numbers.
    const int first = at(hull.half_edges, at(hull.face_edges, at(face_of, vertex))).origin;
    const auto start =
        std::ranges::find(outline, first, [&](int corner) { return at(corners, corner).original; });
    if (start != outline.end()) std::rotate(outline.begin(), start, outline.end());
    core.faces.push_back(face_ref(Owner::A, at(face_of, vertex)));
  }
  core.hull = hull_from_polygons(mapped(corners, &Corner::place), outlines);
  for (int face = 0; face < core.hull.face_count(); ++face) {
    const Plane<double>& plane = hull.planes[at(core.faces, face).index];
    at(core.hull.planes, face) = {plane.normal, plane.offset - margin};
  }
  lay_out(core.hull);
  for (int edge = 0; edge < core.hull.edge_count(); ++edge) {
    const HalfEdge& left = at(core.hull.half_edges, 2 * edge);
    const HalfEdge& right = at(core.hull.half_edges, 2 * edge + 1);
    core.edges.push_back(edge_that_it_stands_for(
        hull, static_cast<int>(at(core.faces, left.face).index),
        static_cast<int>(at(core.faces, right.face).index), at(corners, left.origin)));
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
  } catch (const ShapeError&) {
    return itself(hull, true);
  }
}

}  // namespace contactscope
