#include "query/point_faces.h"

#include "query/face_prism.h"
#include "query/tolerance.h"

namespace contactscope {

template <class S>
PointFaces<S>::PointFaces(const Hull<S>& hull, const Vec3<S>& point)
    : hull_(hull), point_(point), distances_(padded(hull.face_count())) {
  const VectorLanes<S> normals(hull.lanes.normals.data(), hull.face_count());
  const S* __restrict nx = normals.x();
  const S* __restrict ny = normals.y();
  const S* __restrict nz = normals.z();
  const S* __restrict offsets = hull.lanes.offsets.data();
  S* __restrict distances = distances_.data();
  const S x = point.x(), y = point.y(), z = point.z();
  const int count = normals.padded_count();
  for (int f = 0; f < count; ++f) {
    distances[f] = dot(nx[f], ny[f], nz[f], x, y, z) - offsets[f];
  }
  largest_ = largest_in_lanes(distances, count);  // padding lies behind every point
}

template <class S>
int PointFaces<S>::nearest(S tie) const {
  const int count = hull_.face_count();
  int earliest = -1;
  int ties = 0;
  for_each_not_below(distances_.data(), count, largest_ - tie, [&](int face) {
    if (++ties == 1) earliest = face;
  });
  if (ties == 1) return earliest;
  int below = -1;
  for_each_not_below(distances_.data(), count, largest_ - tie, [&](int face) {
    if (below < 0 && projects_into(hull_, face, point_, tie)) below = face;
  });
  return below < 0 ? earliest : below;
}

template <class S>
bool PointFaces<S>::is_tied(int face, S tie, S sine) const {
  const Vec3<S>& normal = hull_.planes[static_cast<std::size_t>(face)].normal;
  for (int other = 0; other < hull_.face_count(); ++other) {
    if (other == face || distances_[other] < largest_ - tie) continue;
    const Vec3<S>& other_normal = hull_.planes[static_cast<std::size_t>(other)].normal;
    const bool leans_away =
        normal.dot(other_normal) < S(0) || normal.cross(other_normal).squaredNorm() > sine * sine;
    if (leans_away) return true;
  }
  return false;
}

template class PointFaces<float>;
template class PointFaces<double>;

}  // namespace contactscope
