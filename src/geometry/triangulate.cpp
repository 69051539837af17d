#include "geometry/mesh.h"

#include "core/convex_polygon.h"
#include "geometry/hull_builder.h"

namespace contactscope {
namespace {

/// The corners projected along the dominant coordinate axis of the polygon's normal, in
/// counter-clockwise order. Dropping a coordinate is exact, so collinear corners stay collinear.
std::vector<Vec2d> flattened(std::span<const Vec3d> corners) {
  Vec3d normal = Vec3d::Zero();
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Vec3d one = corners[i] - corners[0];
    const Vec3d other = corners[i + 1] - corners[0];
    normal += one.cross(other);
  }
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  int u = (axis + 1) % 3;
  int v = (axis + 2) % 3;
  if (normal[axis] < 0) std::swap(u, v);
  return mapped(corners, [&](const Vec3d& corner) { return Vec2d(corner[u], corner[v]); });
}

/// Size that rounding of coordinates can give to a turn of 0. Corners written on a line are off it
/// by a few of these and must not count as bends.
double rounding_of_turns(const std::vector<Vec2d>& corners) {
  double coordinate = 0;
  double length = 0;
  for (const Vec2d& corner : corners) {
    coordinate = std::max(coordinate, corner.cwiseAbs().maxCoeff());
    length = std::max(length, (corner - corners[0]).cwiseAbs().maxCoeff());
  }
  return 8 * std::numeric_limits<double>::epsilon() * coordinate * length;
}

/// Rating of cutting off corner `i`: length of the cut over its distance from the corner. Infinite
/// if it is no ear: a left turn whose triangle (rim included) contains no other corner.
double flatness(const std::vector<Vec2d>& corners, std::size_t i, double rounding) {
  constexpr double kNoEar = std::numeric_limits<double>::infinity();
  const Vec2d& a = corners[(i + corners.size() - 1) % corners.size()];
  const Vec2d& b = corners[i];
  const Vec2d& c = corners[(i + 1) % corners.size()];
  const double area = turn(a, b, c);  // twice the triangle's area
  if (!(area > rounding)) return kNoEar;
  for (const Vec2d& p : corners) {
    // Skip corners at the same positions too: outlines of holes are often joined by double edges.
    if (p == a || p == b || p == c) continue;
    if (std::min({turn(a, b, p), turn(b, c, p), turn(c, a, p)}) >= -rounding) return kNoEar;
  }
  return (c - a).squaredNorm() / area;
}

using Edges = std::set<std::pair<int, int>>;  // the lower vertex first

/// Triangles of one face, or the face if a cut would duplicate an edge. Adds the cuts to `edges`.
std::vector<std::vector<int>> cut_face(const Hull<double>& hull, int face, Edges& edges) {
  const std::vector<int> loop = face_vertices(hull, face);
  if (loop.size() == 3) return {loop};
  const std::vector<Vec3d> corners =
      mapped(loop, [&](int vertex) { return at(hull.vertices, vertex); });
  std::vector<std::vector<int>> triangles;
  Edges cuts;
  for (const std::array<int, 3>& corner : triangulate_polygon(corners)) {
    triangles.push_back(mapped(corner, [&](int k) { return at(loop, k); }));
    for (std::size_t k = 0; k < 3; ++k) {
      const int from = corner[k], to = corner[(k + 1) % 3];
      if (to != (from + 1) % count_of(loop))
        cuts.insert(std::minmax({at(loop, from), at(loop, to)}));
    }
  }
  const auto is_edge = [&](const std::pair<int, int>& cut) { return edges.contains(cut); };
  if (std::ranges::any_of(cuts, is_edge)) return {loop};
  edges.merge(cuts);
  return triangles;
}

}  // namespace

/// Ear clipping. Deviation: the least flat ear is cut first, which makes fewer slivers and
/// postpones collinear corners until they are none. Steps: rate all corners; cut the best ear; rate
/// its two neighbours again; repeat until three corners are left.
std::vector<std::array<int, 3>> triangulate_polygon(std::span<const Vec3d> corners) {
  assert(corners.size() >= 3);
  std::vector<Vec2d> left = flattened(corners);  // remaining corners, in order
  std::vector<int> loop(left.size());            // their indices
  std::iota(loop.begin(), loop.end(), 0);
  const double rounding = rounding_of_turns(left);
  std::vector<double> ratings;
  for (std::size_t i = 0; i < left.size(); ++i) ratings.push_back(flatness(left, i, rounding));
  std::vector<std::array<int, 3>> triangles;
  while (left.size() > 3) {
    // If no ear is left, because the polygon crosses itself, all corners are equally bad.
    const auto best = std::ranges::min_element(ratings) - ratings.begin();
    const std::size_t ear = static_cast<std::size_t>(best), count = left.size();
    triangles.push_back({loop[(ear + count - 1) % count], loop[ear], loop[(ear + 1) % count]});
    left.erase(left.begin() + best);
    loop.erase(loop.begin() + best);
    ratings.erase(ratings.begin() + best);
    const std::size_t next = ear % left.size();
    for (const std::size_t i : {next, (next + left.size() - 1) % left.size()})
      ratings[i] = flatness(left, i, rounding);
  }
  triangles.push_back({loop[0], loop[1], loop[2]});
  return triangles;
}

Hull<double> triangulate_faces(const Hull<double>& hull) {
  Edges edges;
  for (std::size_t i = 0; i < hull.half_edges.size(); i += 2)
    edges.insert(std::minmax({hull.half_edges[i].origin, hull.half_edges[i + 1].origin}));
  std::vector<std::vector<int>> faces;
  std::vector<Plane<double>> planes;
  for (int face = 0; face < hull.face_count(); ++face) {
    for (std::vector<int>& part : cut_face(hull, face, edges)) {
      faces.push_back(std::move(part));
      planes.push_back(at(hull.planes, face));
    }
  }
  Hull<double> cut = hull_from_polygons(hull.vertices, faces);
  cut.planes = std::move(planes);
  cut.centroid = hull.centroid;
  cut.radius = hull.radius;
  lay_out(cut);
  return cut;
}

}  // namespace contactscope
