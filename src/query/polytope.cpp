#include "query/polytope.h"

namespace contactscope {
namespace {

/// A triangle thinner than this many roundings is a needle: its normal is uncertain by more than an
/// eighth, and the direction to its long edge is more reliable.
constexpr int kNeedleRoundings = 8;

/// Weight of `to` at the point of an edge closest to the origin.
template <class S> S weight_on_edge(const Vec3<S>& from, const Vec3<S>& to) {
  const Vec3<S> along = to - from;
  const S squared = along.squaredNorm();
  if (!(squared > S(0))) return S(0);
  return std::clamp(-from.dot(along) / squared, S(0), S(1));
}

}  // namespace

template <class S>
Polytope<S>::Polytope(const StartSimplex<S>& tetrahedron, S rounding) : rounding_(rounding) {
  for (const DifferencePoint<S>& point : tetrahedron.points) vertices.push_back(point);
  const Vec3<S> side1 = vertices[1].point - vertices[0].point;
  const Vec3<S> side2 = vertices[2].point - vertices[0].point;
  const Vec3<S> side3 = vertices[3].point - vertices[0].point;
  // Seen from outside: from the side opposite to vertex 3.
  const bool flip = side1.cross(side2).dot(side3) > S(0);
  const int one = flip ? 2 : 1, two = flip ? 1 : 2;
  const int corners[4][3] = {{0, one, two}, {one, 0, 3}, {two, one, 3}, {0, two, 3}};
  for (const auto& [i, j, k] : corners) add_face(i, j, k);
  // The first edge of each other face is shared with face 0, the second with the third of another.
  for (int f = 1; f < 4; ++f) {
    link(0, f - 1, f, 0);
    link(f, 1, f == 1 ? 3 : f - 1, 2);
  }
}

template <class S> void Polytope<S>::link(int one, int edge, int other, int other_edge) {
  at(at(faces, one).neighbours, edge) = other;
  at(at(faces, other).neighbours, other_edge) = one;
}

template <class S> int Polytope<S>::add_face(int first, int second, int third) {
  PolytopeFace<S> added;
  added.vertices = {first, second, third};
  added.neighbours = {-1, -1, -1};
  added.is_alive = true;
  added.is_closed = false;
  measure(added);
  if (free_.empty()) {
    faces.push_back(added);
    return count_of(faces) - 1;
  }
  const int slot = free_.back();
  free_.truncate(free_.size() - 1);
  at(faces, slot) = added;
  return slot;
}

/// The distance is that of the triangle, not of its plane. They are equal if the closest point is
/// inside. Rounding of a needle's normal can bring its plane, but not the triangle, arbitrarily
/// close to the origin. Negative if the origin is beyond the plane: such a face comes first, and
/// then a point is beyond it as well, or its plane separates the shapes.
template <class S> void Polytope<S>::measure(PolytopeFace<S>& added) const {
  const Vec3<S> corners[4] = {corner(added, 0).point, corner(added, 1).point,
                              corner(added, 2).point, corner(added, 0).point};
  S length = S(0);
  const Vec3<S> cross = triangle_normal(corners[0], corners[1], corners[2], length);
  const S area = cross.norm();
  const S thickness = length > S(0) ? area / length : S(0);
  added.weights = {};
  added.normal = Vec3<S>::Zero();
  added.offset = S(0);
  added.is_closed = !(area > S(0));
  if (area > S(0)) {
    added.normal = cross / area;
    added.offset = added.normal.dot(corners[0]);
  }

  added.distance = std::numeric_limits<S>::infinity();
  Vec3<S> nearest = Vec3<S>::Zero();
  bool is_inside = area > S(0);
  S along_edges[3];
  for (int e = 0; e < 3 && is_inside; ++e) {
    const Vec3<S>&from = corners[e], &to = corners[e + 1];
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
    const Vec3<S>&from = corners[e], &to = corners[e + 1];
    const S weight = weight_on_edge(from, to);
    const Vec3<S> point = from + weight * (to - from);
    const S distance = point.norm();
    if (distance < added.distance) {
      added.distance = distance;
      nearest = point;
      added.weights = {};
      at(added.weights, e) = S(1) - weight;
      at(added.weights, (e + 1) % 3) = weight;
    }
  }
  added.direction = added.normal;
  if (is_needle && added.distance > thickness) added.direction = nearest / added.distance;
  if (!is_needle && added.offset < -rounding_) added.distance = added.offset;
}

template <class S> int Polytope<S>::nearest_open() const {
  int best = -1;
  S least = std::numeric_limits<S>::infinity();
  for (int i = 0; i < count_of(faces); ++i) {
    const PolytopeFace<S>& candidate = at(faces, i);
    if (candidate.is_alive && !candidate.is_closed && candidate.distance < least) {
      least = candidate.distance;
      best = i;
    }
  }
  return best;
}

template <class S> S Polytope<S>::distance() const {
  S least = std::numeric_limits<S>::infinity();
  for (const PolytopeFace<S>& candidate : faces)
    if (candidate.is_alive) least = std::min(least, candidate.distance);
  return least;
}

template <class S> bool Polytope<S>::has_vertex(const IndexPair& pair) const {
  return std::ranges::find(vertices, pair, &DifferencePoint<S>::pair) != vertices.end();
}

/// Points on the plane count as seeing it, so coplanar faces are replaced together. Then no new
/// triangle is thinner than rounding: its outer neighbour would be coplanar and seen as well.
template <class S>
bool Polytope<S>::is_seen_from(const PolytopeFace<S>& candidate, const Vec3<S>& point) const {
  return candidate.normal.dot(point) - candidate.offset > -rounding_;
}

template <class S> bool Polytope<S>::expand(int seen, const DifferencePoint<S>& point) {
  // Flood fill over neighbours, starting at the visible face.
  StaticVector<int, kMaxFaces> region;
  std::array<bool, kMaxFaces> is_in_region;
  std::fill_n(is_in_region.begin(), faces.size(), false);
  region.push_back(seen);
  at(is_in_region, seen) = true;
  for (std::size_t i = 0; i < region.size(); ++i) {
    for (const int neighbour : at(faces, region[i]).neighbours) {
      if (at(is_in_region, neighbour) || !is_seen_from(at(faces, neighbour), point.point)) continue;
      at(is_in_region, neighbour) = true;
      region.push_back(neighbour);
    }
  }

  // Horizon edge that starts at a vertex: its end vertex and the face beyond it.
  struct HorizonEdge {
    int to = -1, outer;
  };
  std::array<HorizonEdge, kMaxVertices> horizon;
  int edges = 0, first = -1;
  for (const int inside : region) {
    const PolytopeFace<S>& from = at(faces, inside);
    for (std::size_t e = 0; e < 3; ++e) {
      const int outer = from.neighbours[e];
      if (at(is_in_region, outer)) continue;
      HorizonEdge& edge = at(horizon, from.vertices[e]);
      if (edge.to >= 0) return false;  // two loops that meet in a vertex
      edge = {from.vertices[(e + 1) % 3], outer};
      first = from.vertices[e];
      ++edges;
    }
  }
  int walked = 0;
  for (int from = first; from >= 0 && walked <= edges; from = at(horizon, from).to) {
    if (walked > 0 && from == first) break;
    ++walked;
  }
  if (edges < 3 || walked != edges) return false;

  for (const int inside : region) {
    at(faces, inside).is_alive = false;
    free_.push_back(inside);
  }
  const int apex = count_of(vertices);
  vertices.push_back(point);
  int from = first, previous = -1, first_added = -1;
  do {
    const HorizonEdge& edge = at(horizon, from);
    const int added = add_face(from, edge.to, apex);
    const auto& corners = at(faces, edge.outer).vertices;
    const auto shared = std::ranges::find(corners, edge.to) - corners.begin();
    link(added, 0, edge.outer, static_cast<int>(shared));
    if (previous >= 0)
      link(previous, 1, added, 2);
    else
      first_added = added;
    previous = added;
    from = edge.to;
  } while (from != first);
  link(previous, 1, first_added, 2);
  return true;
}

template struct Polytope<float>;
template struct Polytope<double>;

}  // namespace contactscope
