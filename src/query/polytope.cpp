#include "query/polytope.h"

#include <cmath>
#include <limits>

namespace contactscope {
namespace {

/// A triangle is a needle when it is thinner than this many roundings: its normal is then less
/// certain than an eighth, and the way to its long edge says more.
constexpr int kNeedleRoundings = 8;

/// Point of an edge nearest to the origin; the weight is that of `to`.
template <class S>
S weight_on_edge(const Vec3<S>& from, const Vec3<S>& to) {
  const Vec3<S> along = to - from;
  const S squared = along.squaredNorm();
  if (!(squared > S(0))) return S(0);
  return std::clamp(-from.dot(along) / squared, S(0), S(1));
}

}  // namespace

template <class S>
Polytope<S>::Polytope(const StartSimplex<S>& tetrahedron, S rounding) : rounding_(rounding) {
  for (const DifferencePoint<S>& point : tetrahedron.points) vertices_.push_back(point);
  const Vec3<S> side1 = vertex(1).point - vertex(0).point;
  const Vec3<S> side2 = vertex(2).point - vertex(0).point;
  const Vec3<S> side3 = vertex(3).point - vertex(0).point;
  // Seen from outside, that is from the other side than vertex 3.
  const bool flip = side1.cross(side2).dot(side3) > S(0);
  const int one = flip ? 2 : 1, two = flip ? 1 : 2;
  const int corners[4][3] = {{0, one, two}, {one, 0, 3}, {two, one, 3}, {0, two, 3}};
  for (const auto& [i, j, k] : corners) add_face(i, j, k);
  for (int f = 0; f < 4; ++f) {
    for (int e = 0; e < 3; ++e) {
      const int from = corners[f][e], to = corners[f][(e + 1) % 3];
      for (int g = 0; g < 4; ++g) {
        const int back = edge_from(g, to);
        if (g != f && back >= 0 && corners[g][(back + 1) % 3] == from) link(f, e, g, back);
      }
    }
  }
}

template <class S>
int Polytope<S>::edge_from(int index, int from) const {
  for (int e = 0; e < 3; ++e) {
    if (face(index).vertices[static_cast<std::size_t>(e)] == from) return e;
  }
  return -1;
}

template <class S>
void Polytope<S>::link(int one, int edge, int other, int other_edge) {
  faces_[static_cast<std::size_t>(one)].neighbours[static_cast<std::size_t>(edge)] =
      static_cast<std::int16_t>(other);
  faces_[static_cast<std::size_t>(other)].neighbours[static_cast<std::size_t>(other_edge)] =
      static_cast<std::int16_t>(one);
}

template <class S>
int Polytope<S>::add_face(int first, int second, int third) {
  PolytopeFace<S> added;
  added.vertices = {static_cast<std::int16_t>(first), static_cast<std::int16_t>(second),
                    static_cast<std::int16_t>(third)};
  added.neighbours = {-1, -1, -1};
  added.is_alive = true;
  added.is_closed = false;
  measure(added);
  if (free_.empty()) {
    faces_.push_back(added);
    return face_slots() - 1;
  }
  const int slot = free_.back();
  free_.truncate(free_.size() - 1);
  faces_[static_cast<std::size_t>(slot)] = added;
  return slot;
}

/// The distance is that of the triangle, not that of its plane: where the nearest point is inside,
/// which it is in some face of a convex polytope, they are the same, and elsewhere rounding of a
/// needle's normal can bring its plane arbitrarily near while the triangle stays where it is. Negative
/// where the origin is beyond the plane: such a face comes first, and either something is beyond it
/// as well or its plane parts the shapes.
template <class S>
void Polytope<S>::measure(PolytopeFace<S>& added) const {
  S length = S(0);
  const Vec3<S> cross =
      triangle_normal(corner(added, 0), corner(added, 1), corner(added, 2), length);
  const S area = cross.norm();
  const S thickness = length > S(0) ? area / length : S(0);
  added.weights = {};
  added.normal = Vec3<S>::Zero();
  added.offset = S(0);
  added.is_closed = !(area > S(0));
  if (area > S(0)) {
    added.normal = cross / area;
    added.offset = added.normal.dot(corner(added, 0));
  }

  added.distance = std::numeric_limits<S>::infinity();
  Vec3<S> nearest = Vec3<S>::Zero();
  bool is_inside = area > S(0);
  S along_edges[3];
  for (int e = 0; e < 3 && is_inside; ++e) {
    const Vec3<S>&from = corner(added, e), &to = corner(added, e + 1);
    const Vec3<S> inward = added.normal.cross(to - from);
    along_edges[e] = -inward.dot(from);
    is_inside = along_edges[e] >= S(0);
  }
  const bool is_needle = thickness <= S(kNeedleRoundings) * rounding_;
  if (is_inside && !is_needle) {
    const S sum = along_edges[0] + along_edges[1] + along_edges[2];
    for (std::size_t k = 0; k < 3; ++k) added.weights[k] = along_edges[(k + 1) % 3] / sum;
    added.distance = added.offset;
    added.direction = added.normal;
    return;
  }
  for (int e = 0; e < 3; ++e) {
    const Vec3<S>&from = corner(added, e), &to = corner(added, e + 1);
    const S weight = weight_on_edge(from, to);
    const Vec3<S> point = from + weight * (to - from);
    const S distance = point.norm();
    if (distance < added.distance) {
      added.distance = distance;
      nearest = point;
      added.weights = {};
      added.weights[static_cast<std::size_t>(e)] = S(1) - weight;
      added.weights[static_cast<std::size_t>((e + 1) % 3)] = weight;
    }
  }
  added.direction = added.normal;
  if (is_needle && added.distance > thickness) added.direction = nearest / added.distance;
  if (!is_needle && added.offset < -rounding_) added.distance = added.offset;
}

template <class S>
int Polytope<S>::nearest_open() const {
  int best = -1;
  S least = std::numeric_limits<S>::infinity();
  for (int i = 0; i < face_slots(); ++i) {
    const PolytopeFace<S>& candidate = face(i);
    if (candidate.is_alive && !candidate.is_closed && candidate.distance < least) {
      least = candidate.distance;
      best = i;
    }
  }
  return best;
}

template <class S>
S Polytope<S>::distance() const {
  S least = std::numeric_limits<S>::infinity();
  for (const PolytopeFace<S>& candidate : faces_) {
    if (candidate.is_alive) least = std::min(least, candidate.distance);
  }
  return least;
}

template <class S>
bool Polytope<S>::has_vertex(const IndexPair& pair) const {
  for (const DifferencePoint<S>& known : vertices_) {
    if (known.pair == pair) return true;
  }
  return false;
}

/// On the plane counts as seen: faces in one plane are replaced together, so that no new triangle is
/// thinner than rounding, for its outer neighbour would be in a plane with it and seen as well.
template <class S>
bool Polytope<S>::is_seen_from(const PolytopeFace<S>& candidate, const Vec3<S>& point) const {
  return candidate.normal.dot(point) - candidate.offset > -rounding_;
}

template <class S>
bool Polytope<S>::expand(int seen, const DifferencePoint<S>& point) {
  // Flood fill over neighbours from the face that is known to be seen.
  StaticVector<std::int16_t, kMaxFaces> region;
  std::array<bool, kMaxFaces> is_in_region;
  for (int i = 0; i < face_slots(); ++i) is_in_region[static_cast<std::size_t>(i)] = false;
  region.push_back(static_cast<std::int16_t>(seen));
  is_in_region[static_cast<std::size_t>(seen)] = true;

  // The edge of the horizon that starts at a vertex: the vertex where it ends, and the face beyond.
  struct HorizonEdge {
    std::int16_t to, outer;
  };
  std::array<HorizonEdge, kMaxVertices> horizon;
  for (int i = 0; i < vertex_count(); ++i) horizon[static_cast<std::size_t>(i)].to = -1;
  int edges = 0, first = -1;
  for (std::size_t i = 0; i < region.size(); ++i) {
    for (const std::int16_t neighbour : face(region[i]).neighbours) {
      const auto slot = static_cast<std::size_t>(neighbour);
      if (is_in_region[slot] || !is_seen_from(face(neighbour), point.point)) continue;
      is_in_region[slot] = true;
      region.push_back(neighbour);
    }
  }
  for (const std::int16_t inside : region) {
    const PolytopeFace<S>& from = face(inside);
    for (std::size_t e = 0; e < 3; ++e) {
      const std::int16_t outer = from.neighbours[e];
      if (is_in_region[static_cast<std::size_t>(outer)]) continue;
      HorizonEdge& edge = horizon[static_cast<std::size_t>(from.vertices[e])];
      if (edge.to >= 0) return false;  // two loops that meet in a vertex
      edge = {from.vertices[(e + 1) % 3], outer};
      first = from.vertices[e];
      ++edges;
    }
  }
  int walked = 0;
  for (int at = first; at >= 0 && walked <= edges; at = horizon[static_cast<std::size_t>(at)].to) {
    if (walked > 0 && at == first) break;
    ++walked;
  }
  if (edges < 3 || walked != edges) return false;

  for (const std::int16_t inside : region) {
    faces_[static_cast<std::size_t>(inside)].is_alive = false;
    free_.push_back(inside);
  }
  const int apex = vertex_count();
  vertices_.push_back(point);
  int at = first, previous = -1, first_added = -1;
  do {
    const HorizonEdge& edge = horizon[static_cast<std::size_t>(at)];
    const int added = add_face(at, edge.to, apex);
    link(added, 0, edge.outer, edge_from(edge.outer, edge.to));
    if (previous >= 0) {
      link(previous, 1, added, 2);
    } else {
      first_added = added;
    }
    previous = added;
    at = edge.to;
  } while (at != first);
  link(previous, 1, first_added, 2);
  return true;
}

template class Polytope<float>;
template class Polytope<double>;

}  // namespace contactscope
