#pragma once

#include "geometry/lanes.h"
#include "geometry/mesh.h"
#include "query/closest_points.h"

namespace contactscope {

/// The triangles whose boxes touch the box of a shape. Many later queries lie near the shape as
/// well; they test these few boxes instead of the tree, with the same answers in the same order.
template <class S> class NearTriangles {
 public:
  /// `mesh` must outlive this. `box`: mesh frame.
  NearTriangles(const Mesh<S>& mesh, const Aabb<S>& box)
      : mesh_(mesh), box_(box), is_whole_(mesh.tree.find_places(box, places_)) {}

  const Mesh<S>& mesh() const { return mesh_; }

  /// Visits the triangles that `skips` does not exclude. Tests all before the first visit: which ones
  /// it excludes is random, and branches between visits would be mispredicted.
  template <class Skips, class Visit> void each(const Skips& skips, const Visit& visit) const {
    if (!is_whole_)
      return mesh_.tree.query(box_, [&](int t) { return skips(t) ? void() : visit(t); });
    StaticVector<int, 128> visited;
    for (const int place : places_) {
      visited.push_back(at(mesh_.tree.triangles, place));
      visited.truncate(visited.size() - (skips(visited.back()) ? 1 : 0));
    }
    for (const int triangle : visited) visit(triangle);
  }

  /// As AabbTree::any_of, over all triangles of the mesh.
  template <class Holds> bool any_of(const Aabb<S>& box, const Holds& holds) const {
    const AabbTree<S>& tree = mesh_.tree;
    if (!is_whole_ || !box_.contains(box)) return tree.any_of(box, holds);
    if (lower_[0].empty()) lay_boxes();
    return any_hit<lanes::kWidth<S>>(
        count_of(places_), [&](int i) { return overlapping(box, i); },
        [&](int i) { return holds(at(tree.triangles, at(places_, i))); });
  }

 private:
  using Lanes = StaticVector<S, 128>;

  /// Padded with boxes that overlap nothing.
  void lay_boxes() const {
    const Aabb<S> none;
    for (int i = 0; i < padded(count_of(places_)); ++i) {
      const Aabb<S>& box = i < count_of(places_) ? at(mesh_.tree.boxes, at(places_, i)) : none;
      for (int k = 0; k < 3; ++k)
        lower_[k].push_back(box.lower[k]), upper_[k].push_back(box.upper[k]);
    }
  }

  /// overlaps() for boxes i, i + 1, ...: a bit each.
  std::uint32_t overlapping(const Aabb<S>& box, int i) const {
    lanes::Flags<S> all = ~lanes::Flags<S>{};
    for (int k = 0; k < 3; ++k) {
      all &= lanes::load(lower_[k].data() + i) <= box.upper[k];
      all &= lanes::load(upper_[k].data() + i) >= box.lower[k];
    }
    return lanes::bits<S>(all);
  }

  const Mesh<S>& mesh_;
  Aabb<S> box_;
  StaticVector<int, 128> places_;      // positions in the tree
  bool is_whole_;                      // all of them fit into places_
  mutable Lanes lower_[3], upper_[3];  // of their boxes; empty before the first query
};

/// Radians. A normal this near to the limit of a feature's normals counts as the feature's: the
/// rounding of a face normal turned into the other shape's frame and back. With more, a ball next
/// to an edge of a flat floor would feel that edge and lean by that angle. Normals between close
/// points are less exact, see normal_tolerance() in collide_with_triangles.h.
template <class S> constexpr S kNormalTolerance = S(16) * std::numeric_limits<S>::epsilon();

/// Upper bound of triangles at a vertex; ends the walk if its neighbours contradict each other.
inline constexpr int kMaxTrianglesAround = 1024;

template <class S> int corner_of(const Mesh<S>& mesh, int triangle, int vertex_of, int k) {
  // Neighbours may use another index for an equal vertex, so corners are found by position.
  const Vec3<S>& place = mesh.corner(vertex_of, k);
  for (int i = 0; i < 3; ++i)
    if (mesh.corner(triangle, i) == place) return i;
  return -1;
}

/// A contact's unit normal, from the mesh, mesh frame; and how far rounding may have turned it.
template <class S> struct ContactNormal {
  Vec3<S> direction;
  S tolerance = kNormalTolerance<S>;
  /// Set where the surface of another shape rises: that shape makes the contact.
  mutable bool is_of_other = false;

  /// Whether this offset from a feature rises along the normal by more than the tolerance.
  bool rises(const Vec3<S>& edge_vector) const {
    const S rise = direction.dot(edge_vector);
    return rise > S(0) && rise > tolerance * edge_vector.norm();  // most need no square root
  }
};

/// Whether the normal is that of a triangle with an area, or its opposite.
template <class S>
bool is_along_face(const Mesh<S>& mesh, int triangle, const ContactNormal<S>& normal) {
  const Vec3<S> sine = normal.direction.cross(mesh.normal(triangle));
  return sine.squaredNorm() <= normal.tolerance * normal.tolerance;
}

/// Upper bound of adjacent triangles without an area, which may form a ring.
inline constexpr int kMaxFlatNeighbours = 16;

/// Whether the surface beyond edge k of a triangle, which may be a seam, rises from it along the
/// normal, so that the surface lacks the edge. Crosses a neighbour without an area: from a short
/// edge of it the surface continues beyond its longest, and from its longest beyond both others.
template <class S>
bool rises_across(const Mesh<S>& mesh, int triangle, int k, const ContactNormal<S>& normal,
                  int crossed = 0) {
  const int across = mesh.beyond(triangle, k);
  if (across < 0 || crossed > kMaxFlatNeighbours) return false;
  if (mesh.neighbour(triangle, k) < 0) {
    const Vec3<S> back = mesh.corner(triangle, k) - mesh.corner(triangle, (k + 1) % 3);
    const bool rises = normal.rises(mesh.normal(across).cross(back));
    normal.is_of_other = normal.is_of_other || (rises && across >= mesh.triangle_count());
    return rises;
  }
  int shared = 0;
  while (shared < 3 && mesh.neighbour(across, shared) != triangle) ++shared;
  if (shared == 3) return false;
  if (!has_area(mesh, across)) {
    const int longest = longest_edge(mesh, across);
    if (shared != longest) return rises_across(mesh, across, longest, normal, crossed + 1);
    for (int i = 1; i < 3; ++i) {
      const int other = (shared + i) % 3;
      if (mesh.corner(across, other) == mesh.corner(across, (other + 1) % 3)) continue;
      if (!rises_across(mesh, across, other, normal, crossed + 1)) return false;
    }
    return true;
  }
  // Perpendicular to the edge, by the normal: on a sliver the direction to the apex is nearly along
  // the edge, and the rounded rest of it may point anywhere.
  const Vec3<S> along = mesh.corner(across, (shared + 1) % 3) - mesh.corner(across, shared);
  return normal.rises(mesh.normal(across).cross(along));
}

/// Walks around corner k of `triangle`, first across the edges that leave it. If that does not lead
/// back, it walks across those that arrive. Tests every triangle met, and those beyond seams.
template <class S>
bool supports_around(const Mesh<S>& mesh, int triangle, int k, const ContactNormal<S>& normal) {
  const Vec3<S>& vertex = mesh.corner(triangle, k);
  for (const bool leaving : {true, false}) {
    int corner = k;
    int next = triangle;
    for (int step = 0; step < kMaxTrianglesAround; ++step) {
      const int edge = leaving ? corner : (corner + 2) % 3;
      const int across = mesh.neighbour(next, edge);
      if (across < 0 && rises_across(mesh, next, edge, normal)) return false;
      next = across;
      if (next == triangle) return true;
      corner = next < 0 ? -1 : corner_of(mesh, next, triangle, k);
      if (corner < 0) break;
      for (int i = 1; i < 3; ++i)
        if (normal.rises(mesh.corner(next, (corner + i) % 3) - vertex)) return false;
    }
  }
  return true;
}

/// Whether a contact normal can come from a mesh, or only from one of its triangles alone. A single
/// triangle has edges and corners that the surface lacks: a box that slides over a flat floor would
/// trip over them. Source: Terdiman, "Contact generation for meshes".
///
/// `normal` touches the feature of the triangle that is farthest along it: the face, an edge or a
/// corner. `edge` is the edge known to have made the contact, or -1. The surface has that feature
/// when no vertex of the triangles around it is farther along the normal. That holds for the face;
/// never for an edge in a flat or hollow place; for a ridge or a peak if the normal is between
/// those of its faces. Boundary edges belong to the surface.
///
/// We test the vertices and not, as is usual, the angles between the faces: that works for corners
/// as well as edges, and for both sides of a triangle.
///
/// Steps: 1. the face itself; 2. an edge whose two ends are the farthest corners of the triangle:
/// the triangle across must not rise from it; 3. a single farthest corner: none around it may rise.
template <class S>
bool belongs_to_surface(const Mesh<S>& mesh, int triangle, const ContactNormal<S>& normal,
                        int edge = -1) {
  if (is_along_face(mesh, triangle, normal)) return true;
  if (edge >= 0) return !rises_across(mesh, triangle, edge, normal);
  int top = 0;
  for (int k = 1; k < 3; ++k) {
    const Vec3<S> edge_vector = mesh.corner(triangle, k) - mesh.corner(triangle, top);
    if (normal.direction.dot(edge_vector) > S(0)) top = k;
  }
  const auto fall = [&](int k) {
    const Vec3<S> edge_vector = mesh.corner(triangle, top) - mesh.corner(triangle, k);
    return normal.direction.dot(edge_vector) / edge_vector.norm();
  };
  const int one = (top + 1) % 3;
  const int other = (top + 2) % 3;
  const int next = fall(one) <= fall(other) ? one : other;
  if (fall(next) <= normal.tolerance)
    return !rises_across(mesh, triangle, next == one ? top : other, normal);
  return supports_around(mesh, triangle, top, normal);
}

/// The same for a triangle without an area, a segment or a point, touched at `place`. If it closes
/// a T-junction of a flat floor, the floor has no edge there.
template <class S>
bool flat_belongs_to_surface(const Mesh<S>& mesh, int triangle, const ContactNormal<S>& normal,
                             const Vec3<S>& place) {
  const int from = longest_edge(mesh, triangle), to = (from + 1) % 3;
  const Vec3<S> along = mesh.corner(triangle, to) - mesh.corner(triangle, from);
  const S rise = normal.direction.dot(along), reach = normal.tolerance * along.norm();
  if (!(std::abs(rise) < reach))
    return supports_around(mesh, triangle, rise > S(0) ? to : from, normal);
  for (int k = 0; k < 3; ++k) {
    const Vec3<S>& corner = mesh.corner(triangle, k);
    const Vec3<S> edge = mesh.corner(triangle, (k + 1) % 3) - corner;
    const S part = edge.dot(Vec3<S>(place - corner));
    const bool is_touched = part >= S(0) && part <= edge.squaredNorm();
    if (is_touched && rises_across(mesh, triangle, k, normal)) return false;
  }
  return true;
}

/// Whether the point projects into the triangle along its normal. False without an area.
template <class S> bool over_triangle(const Mesh<S>& mesh, int triangle, const Vec3<S>& point) {
  if (!has_area(mesh, triangle)) return false;
  for (int k = 0; k < 3; ++k) {
    const Vec3<S>& from = mesh.corner(triangle, k);
    const Vec3<S> along = mesh.corner(triangle, (k + 1) % 3) - from;
    if (along.cross(mesh.normal(triangle)).dot(Vec3<S>(point - from)) > S(0)) return false;
  }
  return true;
}

/// Stops at `enough`, metres: a lower bound of the distance from there on.
template <class S>
S distance_to_triangle(const Mesh<S>& mesh, int triangle, const Vec3<S>& point, S enough) {
  const S from_plane =
      std::abs(mesh.normal(triangle).dot(Vec3<S>(point - mesh.corner(triangle, 0))));
  // A sliver's plane may not contain all of the sliver.
  if (from_plane >= enough && !mesh.is_sliver(triangle)) return from_plane;
  if (over_triangle(mesh, triangle, point)) return from_plane;
  S least = std::numeric_limits<S>::infinity();
  for (int k = 0; k < 3; ++k) {
    const ClosestOnSegment<S> closest =
        closest_on_segment(point, mesh.corner(triangle, k), mesh.corner(triangle, (k + 1) % 3));
    least = std::min(least, Vec3<S>(point - closest.point).norm());
  }
  return least;
}

/// Whether the segment passes through the triangle from one side to the other, between its ends.
/// Touching only the triangle's outline or plane does not count.
template <class S>
bool crosses(const Mesh<S>& mesh, int triangle, const Vec3<S>& from, const Vec3<S>& to) {
  const Vec3<S>& normal = mesh.normal(triangle);
  const S before = normal.dot(Vec3<S>(from - mesh.corner(triangle, 0)));
  const S behind = normal.dot(Vec3<S>(to - mesh.corner(triangle, 0)));
  if (!(before * behind < S(0))) return false;
  const Vec3<S> edge_vector = to - from;
  int left = 0, right = 0;
  for (int k = 0; k < 3; ++k) {
    const Vec3<S> corner = mesh.corner(triangle, k) - from;
    const Vec3<S> next = mesh.corner(triangle, (k + 1) % 3) - from;
    const S turn = edge_vector.dot(corner.cross(next));
    left += turn > S(0) ? 1 : 0;
    right += turn < S(0) ? 1 : 0;
  }
  return left == 0 || right == 0;
}

/// Whether another triangle is between `eye` and the point `on_triangle` of a triangle, so that a
/// shape centred at `eye` cannot have come to that side. Does not depend on winding. Mesh frame.
template <class S>
bool hidden_from(const NearTriangles<S>& near, int triangle, const Vec3<S>& eye,
                 const Vec3<S>& on_triangle) {
  const Mesh<S>& mesh = near.mesh();
  // Moved slightly inwards, because the neighbours of a point on an edge end there.
  const Vec3<S> middle =
      (mesh.corner(triangle, 0) + mesh.corner(triangle, 1) + mesh.corner(triangle, 2)) / S(3);
  const Vec3<S> target = on_triangle + S(0.01) * (middle - on_triangle);
  return near.any_of({eye.cwiseMin(target), eye.cwiseMax(target)}, [&](int other) {
    return other != triangle && crosses(mesh, other, eye, target);
  });
}

/// Whether any part of the mesh is nearer to `point` than `distance`. Mesh frame, metres.
template <class S>
bool surface_within(const NearTriangles<S>& near, const Vec3<S>& point, S distance) {
  const Vec3<S> reach = Vec3<S>::Constant(distance);
  return near.any_of({point - reach, point + reach}, [&](int triangle) {
    return distance_to_triangle(near.mesh(), triangle, point, distance) < distance;
  });
}

}  // namespace contactscope
