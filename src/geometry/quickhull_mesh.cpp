#include "geometry/quickhull.h"

#include "geometry/predicates.h"

namespace contactscope::quickhull {

Mesh::Mesh(std::span<const Vec3d> points) : points_(points), leaving_(points.size(), -1) {}

std::vector<int> Mesh::faces() const {
  std::vector<int> kept;
  for (int i = 0; i < face_count(); ++i)
    if (!face(i).gone) kept.push_back(i);
  return kept;
}

std::vector<int> Mesh::loop(int face_index) const {
  std::vector<int> vertices;
  for (const int e : around(face_index)) vertices.push_back(edge(e).origin);
  return vertices;
}

int Mesh::add_triangle(int a, int b, int c) {
  const int first = count_of(edges_);
  const int index = face_count();
  const int corners[] = {a, b, c};
  for (int i = 0; i < 3; ++i) {
    edges_.push_back({corners[i], first + (i + 1) % 3, first + (i + 2) % 3, -1, index});
    leaving(corners[i]) = first + i;
  }
  faces_.emplace_back().edge = first;
  measure(index);
  return first;
}

void Mesh::sew(int one, int other) {
  edge_at(one).twin = other;
  edge_at(other).twin = one;
}

void Mesh::follow(int first, int second) {
  edge_at(first).next = second;
  edge_at(second).previous = first;
}

void Mesh::measure(int face_index) {
  Face& measured = face(face_index);
  const std::vector<int> corners = loop(face_index);
  measured.centroid = Vec3d::Zero();
  for (const int corner : corners) measured.centroid += point(corner);
  measured.centroid /= count_of(corners);
  const Vec3d area = doubled_area(count_of(corners), [&](int i) { return point(at(corners, i)); });
  const double length = area.norm();
  measured.area = 0.5 * length;
  // A face without area has no normal. A zero normal puts every point on its plane, so it merges.
  measured.plane.normal = length > 0 ? Vec3d(area / length) : Vec3d::Zero();
  measured.plane.offset = measured.plane.normal.dot(measured.centroid);
}

bool Mesh::meet_in_one_edge(int one, int other) const {
  const std::vector<int> vertices = loop(one);
  const auto is_shared = [&](int e) {
    return std::ranges::find(vertices, edge(e).origin) != vertices.end();
  };
  return std::ranges::count_if(around(other), is_shared) == 2;
}

bool Mesh::merge_across(int e, std::vector<int>& touched) {
  const int t = edge(e).twin;
  const int kept = edge(e).face;
  const int swallowed = edge(t).face;
  if (!meet_in_one_edge(kept, swallowed)) return false;

  //    kept  |  swallowed        Join the two loops: the edge before e continues after t, and the
  //      ----v----               edge before t continues after e.
  //        e | t
  //      ----u----
  const int u = edge(e).origin;
  const int v = edge(t).origin;
  for (int i = edge(t).next; i != t; i = edge(i).next) edge_at(i).face = kept;
  const int after_e = edge(e).next;
  const int after_t = edge(t).next;
  follow(edge(e).previous, after_t);
  follow(edge(t).previous, after_e);
  leaving(u) = after_t;
  leaving(v) = after_e;
  face(kept).edge = after_e;
  face(swallowed).gone = true;

  std::vector<int> changed = {kept, swallowed};
  restore_invariants({u, v}, changed);
  for (const int i : changed) {
    if (!face(i).gone) measure(i);
    if (std::ranges::find(touched, i) == touched.end()) touched.push_back(i);
  }
  return true;
}

void Mesh::split(int one, int other) {
  //    v---one--->        v = origin of one, w = origin of other.
  //    ^ |        \       The new edge v-w closes the loop of `other`, which stays; its twin w-v
  //    | |   new   v      closes the loop of `one`, which is the new face.
  //     <--other--w
  const int kept = edge(one).face;
  const int added = face_count();
  const int forth = count_of(edges_);
  const int back = forth + 1;
  const int before_one = edge(one).previous, before_other = edge(other).previous;
  edges_.push_back({edge(one).origin, -1, -1, back, kept});
  edges_.push_back({edge(other).origin, -1, -1, forth, added});
  follow(before_one, forth);
  follow(forth, other);
  follow(before_other, back);
  follow(back, one);
  faces_.emplace_back().edge = back;
  face(kept).edge = forth;
  for (const int e : around(added)) edge_at(e).face = added;
  measure(kept);
  measure(added);
}

void Mesh::restore_invariants(std::vector<int> vertices, std::vector<int>& changed) {
  while (!vertices.empty() && !broken_) {
    const int vertex = vertices.back();
    vertices.pop_back();
    const int first = leaving(vertex);
    if (first < 0) continue;
    const int second = edge(edge(first).twin).next;
    const int third = edge(edge(second).twin).next;
    if (second == first) {
      broken_ = true;
    } else if (third == first) {
      remove_vertex(vertex, vertices, changed);
    }
  }
}

void Mesh::remove_vertex(int vertex, std::vector<int>& vertices, std::vector<int>& changed) {
  //       face(in)             `in` and `out` meet at the vertex on one side, their twins on the
  //   --in--> x --out-->       other side. `in` is extended to the target of `out`, and the twin of
  //   <------ x <-------       `out` to the origin of `in`; the other two half-edges are removed
  //       face(back)           together with the vertex.
  const int out = leaving(vertex);
  const int in = edge(out).previous;
  const int back = edge(out).twin;
  const int one = edge(in).face;
  const int other = edge(back).face;
  if (one == other) {
    broken_ = true;
    return;
  }
  const int after_back = edge(edge(in).twin).next;
  follow(in, edge(out).next);
  follow(back, after_back);
  sew(in, back);
  leaving(vertex) = -1;
  face(one).edge = in;
  face(other).edge = back;
  changed.insert(changed.end(), {one, other});
  for (const int i : {one, other})
    if (loop(i).size() == 2 && !broken_) remove_two_gon(i, vertices);
}

void Mesh::remove_two_gon(int face_index, std::vector<int>& vertices) {
  const int x = face(face_index).edge;
  const int y = edge(x).next;
  const int outside_x = edge(x).twin, outside_y = edge(y).twin;
  if (edge(outside_x).face == edge(outside_y).face || outside_x == y) {
    broken_ = true;
    return;
  }
  sew(outside_x, outside_y);
  leaving(edge(x).origin) = outside_y;
  leaving(edge(y).origin) = outside_x;
  face(face_index).gone = true;
  vertices.push_back(edge(x).origin);
  vertices.push_back(edge(y).origin);
}

}  // namespace contactscope::quickhull
