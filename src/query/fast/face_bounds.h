#pragma once

#include "query/fast/lane_search.h"
#include "query/sat.h"

/// Finds the best face of a hull against another without measuring every face against every vertex,
/// and the edges that may beat it. Everything in A's frame, metres.
namespace contactscope {

/// Measures one face as query_faces() does, bit for bit: the first deepest vertex of `other`.
template <class S>
inline FaceQuery<S> measure_face(const PlacedHull<S>& reference, int face,
                                 const PlacedHull<S>& other) {
  using lanes::all;
  using lanes::load;
  using lanes::Pack;
  const VectorLanes<S>& v = other.vertices;
  const Pack<S> nx = all(reference.normals.x()[face]), ny = all(reference.normals.y()[face]),
                nz = all(reference.normals.z()[face]), offset = all(reference.offsets[face]);
  const Pack<S> infinity = all(std::numeric_limits<S>::infinity());
  const int count = v.padded_count();
  Scratch<S, 128> distances(count);
  for (int i = 0; i < count; i += lanes::kWidth<S>) {
    const Pack<S> distance =
        ((nx * load(v.x() + i) + ny * load(v.y() + i)) + nz * load(v.z() + i)) - offset;
    lanes::store<S>(distance, distances.data() + i);
  }
  // The padding is not a vertex.
  for (int i = v.count(); i < count; ++i) distances[i] = infinity[0];
  Pack<S> least = infinity;
  for (int i = 0; i < count; i += lanes::kWidth<S>)
    least = lanes::smaller(load(distances.data() + i), least);
  least = lanes::smallest<S>(least);
  const Hits deepest =
      hits(distances.data(), count, [&](const Pack<S>& distance) { return distance == least; });
  return {face, std::max(deepest.first, 0), least[0]};
}

/// Bounds of the separation of every face of one hull, from a few vertices of another: a face's
/// separation is the minimum over all vertices. One vertex near the contact shows that most faces
/// are worse than those next to it.
///
///            v             v, a vertex of B, is slightly below the face f of A, and far below the
///       ____ . ____ f      planes of g and h. B's deepest vertices there are at least as deep as
///    g /           \ h     v. So f is better, whatever they are.
///
/// find_best() is the cutting-plane method (Kelley 1960): measure the face with the largest bound,
/// add the vertex that was deepest below it, and repeat until the face's separation is the largest
/// bound. Two hulls of 32 vertices take two rounds.
template <class S> class FaceBounds {
 public:
  /// Both arguments must outlive this.
  FaceBounds(const PlacedHull<S>& reference, const PlacedHull<S>& other)
      : reference_(reference),
        other_(other),
        count_(reference.normals.padded_count()),
        distances_(kMaxVertices * count_),
        bounds_(count_) {}

  /// Lowers the bounds of all faces by some vertices of the other hull. Call it first.
  template <int kVertices> void look_at(const int (&vertices)[kVertices]) {
    if (looked_at_ == 0)
      lower<kVertices, true>(vertices);
    else
      lower<kVertices, false>(vertices);
  }

  /// Finds the result of query_faces() with this `tie`, bit for bit, and returns true. Returns
  /// false if faces tie, because then their order matters, or after too many rounds.
  bool find_best(S tie) {
    using lanes::Pack;
    for (;;) {
      const Pack<S> largest = largest_;
      const int face =
          hits(bounds_.data(), count_, [&](const Pack<S>& b) { return b == largest; }).first;
      if (face < 0) return false;  // NaN
      best_ = measure_face(reference_, face, other_);
      if (best_.separation == largest[0]) break;
      if (looked_at_ == kMaxVertices) return false;
      look_at({best_.support});
    }
    const Pack<S> largest = largest_, ties = lanes::all(tie);
    return hits(bounds_.data(), count_, [&](const Pack<S>& b) { return ~(largest > b + ties); })
        .is_single;
  }

  const FaceQuery<S>& best() const { return best_; }

  /// Collects the edges of the hull, as sorted even half-edges, whose arc on the Gauss map may have
  /// a separation above `bound` (metres, < 0). Edges are excluded if some vertex is not above the
  /// bound for both of their faces. Between two normals, the distance of a vertex from a point of
  /// the edge is linear; where it is negative, normalizing the interpolated normal only lowers it
  /// (see arc_stays_below in query_edges.cpp). `edges` must have room for all edges plus one.
  /// Returns the number of edges.
  ///
  /// Every remaining edge has a face above the bound for the last vertex; there are few of these.
  int edges_above(S bound, int* edges) const {
    const Hull<S>& hull = reference_.hull;
    const S* const last = distances_.data() + (looked_at_ - 1) * count_;
    const lanes::Pack<S> bounds = lanes::all(bound);
    int count = 0;
    const auto add_edges_of = [&](int face) {
      for (const int edge : hull.around_face(face)) {
        const int beyond = at(hull.half_edges, Hull<S>::twin(edge)).face;
        bool is_below = false;
        for (const S* d = distances_.data(); d != last; d += count_)
          is_below |= (d[face] <= bound) & (d[beyond] <= bound);
        // If both faces are above, count the edge only once.
        const bool is_its_turn = ((edge & 1) == 0) | (last[beyond] <= bound);
        edges[count] = edge & ~1;
        count += static_cast<int>(is_its_turn & !is_below);
      }
    };
    for (int from = 0; from < count_; from += 64) {
      std::uint64_t above = bits_where(last + from, count_ - from,
                                       [&](const lanes::Pack<S>& d) { return d > bounds; });
      for (; above != 0; above &= above - 1) add_edges_of(from + std::countr_zero(above));
    }
    std::sort(edges, edges + count);
    return count;
  }

 private:
  static constexpr int kMaxVertices = 8;

  template <int kVertices, bool kFirst> void lower(const int (&vertices)[kVertices]) {
    using lanes::all;
    using lanes::load;
    using lanes::Pack;
    Pack<S> x[kVertices], y[kVertices], z[kVertices];
    for (int k = 0; k < kVertices; ++k) {
      x[k] = all(other_.vertices.x()[vertices[k]]);
      y[k] = all(other_.vertices.y()[vertices[k]]);
      z[k] = all(other_.vertices.z()[vertices[k]]);
    }
    const VectorLanes<S>& n = reference_.normals;
    S* const distances = distances_.data() + looked_at_ * count_;
    Pack<S> largest = all(-std::numeric_limits<S>::infinity());
    for (int i = 0; i < count_; i += lanes::kWidth<S>) {
      const Pack<S> nx = load(n.x() + i), ny = load(n.y() + i), nz = load(n.z() + i);
      const Pack<S> offset = load(reference_.offsets + i);
      Pack<S> bound = kFirst ? all(std::numeric_limits<S>::infinity()) : load(bounds_.data() + i);
      for (int k = 0; k < kVertices; ++k) {
        const Pack<S> distance = ((nx * x[k] + ny * y[k]) + nz * z[k]) - offset;
        lanes::store<S>(distance, distances + k * count_ + i);
        bound = lanes::smaller(distance, bound);
      }
      lanes::store<S>(bound, bounds_.data() + i);
      largest = lanes::larger(bound, largest);
    }
    looked_at_ += kVertices;
    largest_ = lanes::largest<S>(largest);
  }

  const PlacedHull<S>& reference_;
  const PlacedHull<S>& other_;
  int count_;                 // number of faces, padded; padding planes are behind every vertex
  int looked_at_ = 0;         // number of vertices
  lanes::Pack<S> largest_{};  // largest bound, in all lanes
  FaceQuery<S> best_;
  Scratch<S, kMaxVertices * 128> distances_;  // of each vertex from all planes
  Scratch<S, 128> bounds_;
};

/// query_edges() of sat.h, skipping edges that `bounds_a` (of A's faces) excludes: same result.
template <class S>
EdgeQuery<S> query_edges(const HullPair<S>& pair, const FaceBounds<S>& bounds_a, S floor, S tie);

}  // namespace contactscope
