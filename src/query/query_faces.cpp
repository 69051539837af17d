#include <limits>

#include "query/sat.h"

namespace contactscope {
namespace {

/// For every face the distance of the other hull's deepest vertex. Vertices are the outer loop:
/// then the inner one runs over faces, which are independent of each other and fill vector
/// registers.
template <class S>
void deepest_distances(const PlacedHull<S>& reference, const PlacedHull<S>& other, S* result) {
  const int faces = reference.normals.padded_count();
  const S* __restrict nx = reference.normals.x();
  const S* __restrict ny = reference.normals.y();
  const S* __restrict nz = reference.normals.z();
  const S* __restrict offset = &reference.offsets[0];
  S* __restrict deepest = result;
  for (int f = 0; f < faces; ++f) deepest[f] = std::numeric_limits<S>::infinity();
  for (int v = 0; v < other.vertices.count(); ++v) {
    const S x = other.vertices.x()[v], y = other.vertices.y()[v], z = other.vertices.z()[v];
    for (int f = 0; f < faces; ++f) {
      const S distance = dot(nx[f], ny[f], nz[f], x, y, z) - offset[f];
      deepest[f] = distance < deepest[f] ? distance : deepest[f];
    }
  }
}

/// The first vertex of `hull` whose distance from the face plane is `distance`.
template <class S>
int vertex_at(const PlacedHull<S>& hull, const Vec3<S>& normal, S offset, S distance) {
  for (int v = 0; v < hull.vertices.count(); ++v) {
    const S found = dot(normal.x(), normal.y(), normal.z(), hull.vertices.x()[v],
                        hull.vertices.y()[v], hull.vertices.z()[v]) -
                    offset;
    if (found == distance) return v;
  }
  return 0;  // only for coordinates that are not finite
}

}  // namespace

/// Gregorius 2015, QueryFaceDirections: for each face plane the support point of the other hull in
/// the opposite direction; keep track of the largest distance. Deviation: only the distances are
/// kept, and the support vertex is looked up for the winner.
template <class S>
FaceQuery<S> query_faces(const PlacedHull<S>& reference, const PlacedHull<S>& other, S tie) {
  Scratch<S, 128> distances(reference.normals.padded_count());
  deepest_distances(reference, other, distances.data());
  FaceQuery<S> best;
  best.face = 0;
  best.separation = distances[0];
  for (int f = 1; f < reference.normals.count(); ++f) {
    if (distances[f] > best.separation + tie) {
      best.separation = distances[f];
      best.face = f;
    }
  }
  best.support =
      vertex_at(other, reference.normals[best.face], reference.offsets[best.face], best.separation);
  return best;
}

template FaceQuery<float> query_faces(const PlacedHull<float>&, const PlacedHull<float>&, float);
template FaceQuery<double> query_faces(const PlacedHull<double>&, const PlacedHull<double>&,
                                       double);

}  // namespace contactscope
