#include "query/capsule_sat.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/lanes.h"
#include "query/face_prism.h"
#include "query/support_set.h"
#include "query/tolerance.h"

namespace contactscope {
namespace {

/// Faces that lean less than this sine to each other look the same way: a tie between them says
/// nothing about the normal.
template <class S>
constexpr S kSameDirection = S(0.05);

/// For every face the distances of both ends from its plane, and how the segment rises above it.
template <class S>
struct FaceDistances {
  FaceDistances(const Hull<S>& hull, const Vec3<S> (&ends)[2])
      : at_start(padded(hull.face_count())),
        at_end(padded(hull.face_count())),
        rise(padded(hull.face_count())) {
    const VectorLanes<S> normals(hull.lanes.normals.data(), hull.face_count());
    const S* __restrict nx = normals.x();
    const S* __restrict ny = normals.y();
    const S* __restrict nz = normals.z();
    const S* __restrict offsets = hull.lanes.offsets.data();
    S* __restrict start = at_start.data();
    S* __restrict end = at_end.data();
    S* __restrict rises = rise.data();
    // The rise is not the difference of the distances, whose digits cancel: its sign decides.
    const Vec3<S> along = ends[1] - ends[0];
    const S ax = ends[0].x(), ay = ends[0].y(), az = ends[0].z();
    const S bx = ends[1].x(), by = ends[1].y(), bz = ends[1].z();
    const S ux = along.x(), uy = along.y(), uz = along.z();
    S best[kLaneWidth];
    for (int k = 0; k < kLaneWidth; ++k) best[k] = -std::numeric_limits<S>::infinity();
    for (int i = 0; i < normals.padded_count(); i += kLaneWidth) {
      for (int k = 0; k < kLaneWidth; ++k) {
        const int f = i + k;
        start[f] = dot(nx[f], ny[f], nz[f], ax, ay, az) - offsets[f];
        end[f] = dot(nx[f], ny[f], nz[f], bx, by, bz) - offsets[f];
        rises[f] = dot(nx[f], ny[f], nz[f], ux, uy, uz);
        const S lower = end[f] < start[f] ? end[f] : start[f];
        best[k] = lower > best[k] ? lower : best[k];
      }
    }
    largest = *std::max_element(best, best + kLaneWidth);
  }

  S lower(int face) const { return std::min(at_start[face], at_end[face]); }

  Scratch<S, 128> at_start, at_end, rise;
  S largest;
};

template <class S>
bool look_the_same_way(const Hull<S>& hull, int one, int other) {
  const Vec3<S>& n = hull.planes[static_cast<std::size_t>(one)].normal;
  const Vec3<S>& m = hull.planes[static_cast<std::size_t>(other)].normal;
  return n.dot(m) > S(0) && n.cross(m).squaredNorm() <= kSameDirection<S> * kSameDirection<S>;
}

template <class S>
void query_faces(const Hull<S>& hull, const Vec3<S> (&ends)[2], const FaceDistances<S>& distances,
                 S tie, CapsuleSat<S>& result) {
  const S least = distances.largest - tie;
  bool settled = false;
  result.face = -1;
  for (int face = 0; face < hull.face_count(); ++face) {
    if (distances.lower(face) < least) continue;
    if (result.face < 0) {
      result.face = face;
      continue;
    }
    // A tie. Only now it matters where the lower ends lie.
    const auto holds = [&](int candidate) {
      const int lower_end = distances.at_end[candidate] < distances.at_start[candidate] ? 1 : 0;
      return projects_into(hull, candidate, ends[lower_end], tie);
    };
    settled = settled || holds(result.face);
    if (!look_the_same_way(hull, result.face, face)) result.face_tied = true;
    if (!settled && holds(face)) {
      result.face = face;
      settled = true;
    }
  }
  result.face_separation = distances.lower(result.face);
}

/// Separation along a unit direction that points from the hull to the segment, by the support points
/// of both. Valid for every direction: the distance is never less.
template <class S>
S support_separation(const Hull<S>& hull, const Vec3<S> (&ends)[2], const Vec3<S>& direction) {
  const Vec3<S>& vertex =
      hull.vertices[static_cast<std::size_t>(support_index(support_set(hull), direction))];
  return std::min(direction.dot(Vec3<S>(ends[0] - vertex)),
                  direction.dot(Vec3<S>(ends[1] - vertex)));
}

}  // namespace

/// On the Gauss map the segment is a ring, the great circle of all directions at right angles to it:
/// along them both of its ends are equally deep. An edge of the hull is the arc between the normals
/// of its faces f and g. They make a face of the Minkowski difference where the arc crosses the
/// ring, which is where the segment rises above one face and sinks below the other.
///
///          f .                         rise(f) = n_f . u > 0
///             \                        rise(g) = n_g . u < 0
///    ----------x---------- ring of u   the normal is x = e x u, with e along the half-edge whose
///               \                      left face is f: n_f x (e x u) = (n_f . u) e, so that x lies
///                . g                   on the way from n_f to n_g (else it is -x)
///
/// Steps: 1. every face: the lower end's distance from its plane; 2. every edge whose arc crosses
/// the ring: the segment's distance along x, unless the ends of the arc say that it cannot beat the
/// best so far. As in query_edges, an axis that would win and is uncertain (nearly parallel edges) or
/// would separate is measured again with support points.
template <class S>
CapsuleSat<S> capsule_sat(const Hull<S>& hull, const Vec3<S> (&ends)[2], S reach, S tie) {
  const FaceDistances<S> distances(hull, ends);
  CapsuleSat<S> result;
  query_faces(hull, ends, distances, tie, result);
  if (result.face_separation > reach) return result;

  const Vec3<S> along = ends[1] - ends[0];
  const S squared_along = along.squaredNorm();
  S to_beat = result.face_separation + tie;
  for (int edge = 0; edge < 2 * hull.edge_count(); edge += 2) {
    const int f = hull.half_edges[static_cast<std::size_t>(edge)].face;
    const int g = hull.half_edges[static_cast<std::size_t>(edge + 1)].face;
    const S rise_f = distances.rise[f], rise_g = distances.rise[g];
    if (!(rise_f > S(0) && rise_g < S(0)) && !(rise_f < S(0) && rise_g > S(0))) continue;
    // Along n(t) = (1 - t) n_f + t n_g an end's distance from the edge is linear in t, and where it
    // is negative, dividing by |n(t)| <= 1 only lowers it.
    const S bound = std::min(to_beat, S(0));
    if (std::max(distances.at_start[f], distances.at_start[g]) <= bound) continue;
    if (std::max(distances.at_end[f], distances.at_end[g]) <= bound) continue;

    const Vec3<S>& origin = hull.origin(edge);
    const Vec3<S> edge_along = hull.target(edge) - origin;
    const Vec3<S> cross = rise_f > S(0) ? edge_along.cross(along) : along.cross(edge_along);
    const S squared_sine = cross.squaredNorm();  // times both squared lengths
    const S squared_lengths = squared_along * edge_along.squaredNorm();
    if (!(squared_sine > kParallelSine<S> * kParallelSine<S> * squared_lengths)) continue;
    const Vec3<S> normal = cross / std::sqrt(squared_sine);
    S separation = normal.dot(Vec3<S>(ends[0] - origin));
    if (!(separation > to_beat)) continue;
    const bool is_noisy = squared_sine < kNoisySine<S> * kNoisySine<S> * squared_lengths;
    if (is_noisy || separation > S(0)) {
      separation = support_separation(hull, ends, normal);
      if (!(separation > to_beat)) continue;
    }
    result.edge = edge;
    result.edge_separation = separation;
    result.edge_normal = normal;
    to_beat = separation + tie;
  }
  return result;
}

template CapsuleSat<float> capsule_sat(const Hull<float>&, const Vec3<float> (&)[2], float, float);
template CapsuleSat<double> capsule_sat(const Hull<double>&, const Vec3<double> (&)[2], double,
                                        double);

}  // namespace contactscope
