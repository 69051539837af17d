#include "geometry/mesh_seams.h"

#include "core/convex_polygon.h"

namespace contactscope {
namespace {

template <class S> SurfaceEdge edge_of(const Mesh<S>& mesh, const TriangleEdge& edge) {
  const auto corner = [&](int k) -> Vec3d {
    return mesh.corner(edge.triangle, k % 3).template cast<double>();
  };
  return {corner(edge.edge), corner(edge.edge + 1) - corner(edge.edge),
          mesh.normal(edge.triangle).template cast<double>()};
}

Aabb<double> box_of(const SurfaceEdge& edge, double margin) {
  const Vec3d to = edge.from + edge.along, grown = Vec3d::Constant(margin);
  return {edge.from.cwiseMin(to) - grown, edge.from.cwiseMax(to) + grown};
}

/// The part of an edge along which another one lies, in metres from the edge's start.
struct Part {
  double begin, end;
  int other;
};

/// Step 2. Empty if the other edge is not on this one.
Part part_along(const SurfaceEdge& edge, const SurfaceEdge& other, int number, double width) {
  const double length = edge.along.norm();
  const Vec3d direction = edge.along / length;
  const auto place = [&](const Vec3d& point) { return (point - edge.from).dot(direction); };
  const double first = place(other.from + other.along), last = place(other.from);
  if (!(last > first)) return {};
  const Part part{std::max(first, 0.0), std::min(last, length), number};
  for (const double end : {part.begin, part.end}) {
    const Vec3d there = other.from + (last - end) / (last - first) * other.along;
    if (!((there - edge.from - end * direction).norm() <= width)) return {};
  }
  return part;
}

/// Whether parts cover an edge of this length.
bool leave_no_gap(std::vector<Part> parts, double length, double width) {
  std::ranges::sort(parts, {}, &Part::begin);
  double covered = 0;
  for (const Part& part : parts) {
    if (part.begin > covered + width) return false;
    covered = std::max(covered, part.end);
  }
  return covered >= length - width;
}

/// The edges and faces that can continue another shape's surface, in the world.
struct Surface {
  std::vector<SurfaceEdge> edges;
  std::vector<std::vector<Vec3d>> faces;  // of a hull
  std::vector<Vec3d> normals;             // of `faces`
  double seam = 0;                        // how wide seams may be, metres
  Aabb<double> box;                       // grown by the width of a seam
  bool is_joined = false;                 // it has a seam, or another one's seam is with it
};

SurfaceEdge edge_of(const Hull<double>& hull, int half_edge) {
  const Vec3d& from = hull.origin(half_edge);
  return {from, hull.target(half_edge) - from,
          at(hull.planes, at(hull.half_edges, half_edge).face).normal};
}

SurfaceEdge moved(const Pose<double>& pose, const SurfaceEdge& edge) {
  return {pose.transform(edge.from), pose.rotate(edge.along), pose.rotate(edge.normal)};
}

Surface surface_of(const PlacedSurface& placed) {
  Surface surface;
  double reach = 0, seam = placed.seam;
  if (const auto* hull = std::get_if<Hull<double>>(placed.shape)) {
    for (int i = 0; i < count_of(hull->half_edges); ++i) surface.edges.push_back(edge_of(*hull, i));
    for (int face = 0; face < hull->face_count(); ++face) {
      surface.normals.push_back(placed.pose.rotate(at(hull->planes, face).normal));
      surface.faces.push_back(mapped(face_vertices(*hull, face), [&](int vertex) -> Vec3d {
        return placed.pose.transform(at(hull->vertices, vertex));
      }));
    }
  } else if (const auto* mesh = std::get_if<Mesh<double>>(placed.shape)) {
    std::vector<TriangleEdge> lone = lone_edges(*mesh);
    surface.edges = edges_of_wide_triangles(*mesh, lone);
    seam = mesh->seam;
  }
  for (SurfaceEdge& edge : surface.edges) {
    reach = std::max(reach, edge.from.cwiseAbs().maxCoeff());
    edge = moved(placed.pose, edge);
    surface.box.include(edge.from);
    surface.box.include(Vec3d(edge.from + edge.along));
  }
  surface.seam = seam * reach;
  const Vec3d margin = Vec3d::Constant(surface.seam);
  surface.box = {surface.box.lower - margin, surface.box.upper + margin};
  return surface;
}

/// Area that two convex polygons in a plane share (Sutherland and Hodgman 1974).
double shared_area(std::vector<Vec2d> polygon, const std::vector<Vec2d>& sides) {
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Vec2d &from = sides[i], &to = sides[(i + 1) % sides.size()];
    std::vector<Vec2d> left;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Vec2d &here = polygon[k], &next = polygon[(k + 1) % polygon.size()];
      const double height = turn(from, to, here), height_next = turn(from, to, next);
      if (height >= 0) left.push_back(here);
      if ((height > 0 && height_next < 0) || (height < 0 && height_next > 0))
        left.push_back(here + height / (height - height_next) * (next - here));
    }
    polygon = std::move(left);
  }
  return area_of(polygon);
}

/// Step 1 for a face. `others` are the surfaces near it.
bool is_covered(const std::vector<Vec3d>& face, const Vec3d& normal,
                const std::vector<Surface*>& others, double width) {
  const PlaneFrame<double> plane(face.front(), normal);
  const auto seen = [&](const Vec3d& point) { return plane.seen(point); };
  const std::vector<Vec2d> outline = mapped(face, seen);
  double perimeter = 0;
  for (std::size_t i = 0; i < face.size(); ++i)
    perimeter += (outline[(i + 1) % outline.size()] - outline[i]).norm();
  double uncovered = area_of(outline) - perimeter * width;
  std::vector<Surface*> covering;
  for (Surface* other : others) {
    for (std::size_t i = 0; i < other->faces.size(); ++i) {
      if (!((other->normals[i] + normal).norm() <= kFlatEdgeAngle)) continue;
      const bool lies_against = std::ranges::all_of(other->faces[i], [&](const Vec3d& corner) {
        return std::abs(normal.dot(corner - face.front())) <= width;
      });
      if (!lies_against) continue;
      std::vector<Vec2d> sides = mapped(other->faces[i], seen);
      std::ranges::reverse(sides);  // seen from the other side
      const double shared = shared_area(outline, sides);
      if (shared > 0) covering.push_back(other);
      uncovered -= shared;
    }
  }
  if (uncovered > 0) return false;
  for (Surface* other : covering) other->is_joined = true;
  return true;
}

/// Returns whether there are seams.
bool join(Hull<double>& hull, const Surface& own, const Pose<double>& pose,
          const std::vector<Surface*>& others) {
  HullSeams<double> seams;
  for (std::size_t face = 0; face < own.faces.size(); ++face)
    seams.covered.push_back(is_covered(own.faces[face], own.normals[face], others, own.seam) ? 1
                                                                                             : 0);
  bool continues = std::ranges::count(seams.covered, 1) > 0;
  seams.beyond.resize(hull.half_edges.size(), Vec3d::Zero());
  std::vector<std::pair<const SurfaceEdge*, Surface*>> edges;
  for (Surface* other : others)
    for (const SurfaceEdge& edge : other->edges) edges.emplace_back(&edge, other);
  const AabbTree<double> tree =
      build_aabb_tree(mapped(edges, [](const auto& edge) { return box_of(*edge.first, 0); }));
  for (std::size_t i = 0; i < own.edges.size(); ++i) {
    if (at(seams.covered, hull.half_edges[i].face) != 0) continue;
    std::vector<int> places;
    tree.query(box_of(own.edges[i], own.seam), [&](int other) { places.push_back(other); });
    std::ranges::sort(places);
    std::vector<SurfaceEdge> near;
    std::vector<Surface*> owners;
    for (const int place : places) {
      const auto& [edge, owner] = at(edges, place);
      // A face that lies against this one covers it near the edge, and does not continue it.
      if ((edge->normal + own.edges[i].normal).norm() <= kFlatEdgeAngle) continue;
      near.push_back(*edge), owners.push_back(owner);
    }
    const int found = continuation(own.edges[i], near, seam_width(own.edges[i], own.seam));
    if (found < 0) continue;
    seams.beyond[i] = pose.inverse_rotate(at(near, found).normal);
    at(owners, found)->is_joined = true;
    continues = true;
  }
  if (continues) hull.seams = std::move(seams);
  return continues;
}

bool join(Mesh<double>& mesh, const Pose<double>& pose, const std::vector<Surface*>& others) {
  const Pose<double> to_mesh = relative_pose(pose, Pose<double>());
  std::vector<SurfaceEdge> near;
  for (const Surface* other : others)
    for (const SurfaceEdge& edge : other->edges) near.push_back(moved(to_mesh, edge));
  const std::vector<TriangleEdge> lone = lone_edges(mesh);
  const std::vector<std::array<int, 3>> seams = find_seams(mesh, lone, near);
  if (seams.empty()) return false;
  if (mesh.seams.empty()) mesh.seams.resize(mesh.triangles.size(), {-1, -1, -1});
  for (const auto& [triangle, edge] : lone)
    at(at(mesh.seams, triangle), edge) = at(at(seams, triangle), edge);
  for (const SurfaceEdge& edge : near) mesh.normals.push_back(edge.normal);
  classify_edges(mesh);
  return true;
}

}  // namespace

double seam_width(const SurfaceEdge& edge, double widest) {
  return std::min(widest, kSliver * edge.along.norm());
}

template <class S> double widest_seam(const Mesh<S>& mesh, const std::vector<TriangleEdge>& edges) {
  double reach = 0;
  for (const TriangleEdge& edge : edges)
    reach = std::max(reach, edge_of(mesh, edge).from.cwiseAbs().maxCoeff());
  return mesh.seam * reach;
}

int continuation(const SurfaceEdge& edge, const std::vector<SurfaceEdge>& near, double width) {
  std::vector<Part> parts;
  for (int i = 0; i < count_of(near); ++i) {
    const Part part = part_along(edge, at(near, i), i, width);
    if (part.end - part.begin > width) parts.push_back(part);
  }
  if (parts.empty() || !leave_no_gap(parts, edge.along.norm(), width)) return -1;
  const auto normal = [&](const Part& part) -> const Vec3d& { return at(near, part.other).normal; };
  for (const Part& part : parts)
    if (!((normal(part) - normal(parts.front())).norm() <= kFlatEdgeAngle)) return -1;
  return std::ranges::max_element(parts, {}, [](const Part& part) { return part.end - part.begin; })
      ->other;
}

template <class S>
std::vector<SurfaceEdge> edges_of_wide_triangles(const Mesh<S>& mesh,
                                                 std::vector<TriangleEdge>& edges) {
  const double seam = widest_seam(mesh, edges);
  std::erase_if(edges, [&](const TriangleEdge& edge) {
    if (!has_area(mesh, edge.triangle)) return true;
    const int longest = longest_edge(mesh, edge.triangle);
    const Vec3d along = edge_of(mesh, {edge.triangle, longest}).along;
    const Vec3d next = edge_of(mesh, {edge.triangle, longest + 1}).along;
    return !(along.cross(next).norm() > 2 * seam * along.norm());
  });
  return mapped(edges, [&](const TriangleEdge& edge) { return edge_of(mesh, edge); });
}

template <class S>
std::vector<std::array<int, 3>> find_seams(const Mesh<S>& mesh, std::vector<TriangleEdge> alone,
                                           const std::vector<SurfaceEdge>& others) {
  std::vector<std::array<int, 3>> seams;
  const double widest = widest_seam(mesh, alone);
  std::vector<SurfaceEdge> edges = edges_of_wide_triangles(mesh, alone);
  edges.insert(edges.end(), others.begin(), others.end());
  if (edges.size() < 2) return seams;
  const auto boxes = mapped(edges, [&](const SurfaceEdge& edge) { return box_of(edge, widest); });
  const auto triangle_of = [&](int edge) {
    const int other = edge - count_of(alone);
    return other < 0 ? at(alone, edge).triangle : mesh.triangle_count() + other;
  };
  const AabbTree<double> tree = build_aabb_tree(boxes);
  std::vector<int> found;
  std::vector<SurfaceEdge> near;
  for (std::size_t i = 0; i < alone.size(); ++i) {
    found.clear();
    near.clear();
    tree.query(boxes[i], [&](int other) {
      if (triangle_of(other) == alone[i].triangle) return;
      found.push_back(triangle_of(other));
      near.push_back(at(edges, other));
    });
    const int beyond = continuation(edges[i], near, seam_width(edges[i], widest));
    if (beyond < 0) continue;
    if (seams.empty()) seams.resize(mesh.triangles.size(), {-1, -1, -1});
    at(at(seams, alone[i].triangle), alone[i].edge) = at(found, beyond);
  }
  return seams;
}

std::vector<TriangleEdge> lone_edges(const Mesh<double>& mesh) {
  std::vector<TriangleEdge> lone;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k)
      if (mesh.beyond(t, k) < 0) lone.push_back({t, k});
  return lone;
}

void weld(Mesh<double>& mesh, double seam) {
  mesh.seam = seam;
  mesh.seams.clear();
  mesh.seams = find_seams(mesh, lone_edges(mesh));
  classify_edges(mesh);
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(widest_seam, edges_of_wide_triangles, find_seams);

std::vector<std::size_t> join_seams(std::span<const PlacedSurface> shapes) {
  std::vector<Surface> surfaces = mapped(shapes, surface_of);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    std::vector<Surface*> near;
    for (std::size_t k = 0; k < shapes.size(); ++k)
      if (k != i && overlaps(surfaces[i].box, surfaces[k].box)) near.push_back(&surfaces[k]);
    if (near.empty()) continue;
    auto* const hull = std::get_if<Hull<double>>(shapes[i].shape);
    auto* const mesh = std::get_if<Mesh<double>>(shapes[i].shape);
    if ((hull != nullptr && join(*hull, surfaces[i], shapes[i].pose, near)) ||
        (mesh != nullptr && join(*mesh, shapes[i].pose, near)))
      surfaces[i].is_joined = true;
  }
  std::vector<std::size_t> joined;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (!surfaces[i].is_joined) continue;
    joined.push_back(i);
    auto* const hull = std::get_if<Hull<double>>(shapes[i].shape);
    if (hull == nullptr || !hull->seams.empty()) continue;
    hull->seams.covered.resize(hull->planes.size(), 0);
    hull->seams.beyond.resize(hull->half_edges.size(), Vec3d::Zero());
  }
  return joined;
}

}  // namespace contactscope
