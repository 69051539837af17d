#include <limits>

#include "query/sat.h"

namespace contactscope {
namespace {

/// Vertices are the outer loop, so that the inner loop runs over faces, which are independent of
/// each other and fill vector registers.
template <class S>
void measure(const PlacedHull<S>& reference, const PlacedHull<S>& other,
             FaceSeparations<S>& result) {
  const int faces = reference.normals.padded_count();
  const S* __restrict nx = reference.normals.x();
  const S* __restrict ny = reference.normals.y();
  const S* __restrict nz = reference.normals.z();
  const S* __restrict offset = reference.offsets;
  S* __restrict deepest = result.separations.data();
  S* __restrict support = result.supports.data();
  for (int f = 0; f < faces; ++f) {
    deepest[f] = std::numeric_limits<S>::infinity();
    support[f] = S(0);
  }
  for (int v = 0; v < other.vertices.count(); ++v) {
    const S x = other.vertices.x()[v], y = other.vertices.y()[v], z = other.vertices.z()[v];
    const S index = static_cast<S>(v);
    for (int f = 0; f < faces; ++f) {
      const S distance = dot(nx[f], ny[f], nz[f], x, y, z) - offset[f];
      support[f] = distance < deepest[f] ? index : support[f];
      deepest[f] = distance < deepest[f] ? distance : deepest[f];
    }
  }
}

}  // namespace

/// Gregorius 2015, QueryFaceDirections: for each face plane find the support point of the other
/// hull in the opposite direction; keep the largest distance.
template <class S>
FaceQuery<S> query_faces(const PlacedHull<S>& reference, const PlacedHull<S>& other, S tie,
                         FaceSeparations<S>& all) {
  measure(reference, other, all);
  FaceQuery<S> best{0, all.support(0), all.separation(0)};
  for (int f = 1; f < reference.normals.count(); ++f) {
    if (all.separation(f) > best.separation + tie) best = {f, all.support(f), all.separation(f)};
  }
  return best;
}

template decltype(query_faces<float>) query_faces<float>;
template decltype(query_faces<double>) query_faces<double>;

}  // namespace contactscope
