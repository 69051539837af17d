#include "query/face_prism.h"

#include <algorithm>

namespace contactscope {
namespace {

/// Outward normal of a side plane, as long as its edge: nobody needs the square root.
template <class S>
struct Side {
  Side(const Hull<S>& hull, int half_edge, const Vec3<S>& face_normal)
      : origin(hull.origin(half_edge)),
        normal(Vec3<S>(hull.target(half_edge) - origin).cross(face_normal)),
        // Between 1 and 1.8 times the edge's length.
        length(normal.cwiseAbs().sum()) {}

  S distance(const Vec3<S>& point) const { return normal.dot(Vec3<S>(point - origin)); }

  const Vec3<S>& origin;
  Vec3<S> normal;
  S length;
};

/// Cuts the interval where the distance from a plane, linear along the segment, is above
/// `thickness`.
template <class S>
void cut(S start, S end, S thickness, int edge, ClippedSegment<S>& clipped) {
  if (start <= thickness && end <= thickness) return;
  if (start > thickness && end > thickness) {
    clipped.parameters[0] = S(2);
    return;
  }
  const S crossing = std::clamp(start / (start - end), S(0), S(1));
  const int cut_end = start > end ? 0 : 1;
  S& parameter = clipped.parameters[cut_end];
  if (cut_end == 0 ? crossing > parameter : crossing < parameter) {
    parameter = crossing;
    clipped.edges[cut_end] = edge;
  }
}

}  // namespace

template <class S>
bool projects_into(const Hull<S>& hull, int face, const Vec3<S>& point, S thickness) {
  const Vec3<S>& normal = hull.planes[static_cast<std::size_t>(face)].normal;
  const int first = hull.face_edges[static_cast<std::size_t>(face)];
  int edge = first;
  do {
    const Side<S> side(hull, edge, normal);
    if (side.distance(point) > thickness * side.length) return false;
    edge = hull.half_edges[static_cast<std::size_t>(edge)].next;
  } while (edge != first);
  return true;
}

template <class S>
ClippedSegment<S> clip_to_prism(const Hull<S>& hull, int face, const Vec3<S> (&ends)[2],
                                S thickness) {
  const Vec3<S>& normal = hull.planes[static_cast<std::size_t>(face)].normal;
  ClippedSegment<S> clipped;
  const int first = hull.face_edges[static_cast<std::size_t>(face)];
  int edge = first;
  do {
    const Side<S> side(hull, edge, normal);
    cut(side.distance(ends[0]), side.distance(ends[1]), thickness * side.length, edge, clipped);
    edge = hull.half_edges[static_cast<std::size_t>(edge)].next;
  } while (edge != first && !clipped.empty());
  return clipped;
}

template <class S>
ClippedSegment<S> clip_to_edge(const Hull<S>& hull, int half_edge, const Vec3<S> (&ends)[2]) {
  ClippedSegment<S> clipped;
  for (const int leaving : {half_edge, Hull<S>::twin(half_edge)}) {
    const Vec3<S>& vertex = hull.origin(leaving);
    const Vec3<S> outward = vertex - hull.target(leaving);
    cut(outward.dot(Vec3<S>(ends[0] - vertex)), outward.dot(Vec3<S>(ends[1] - vertex)), S(0),
        leaving, clipped);
  }
  return clipped;
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                      \
  template bool projects_into(const Hull<S>&, int, const Vec3<S>&, S);                   \
  template ClippedSegment<S> clip_to_prism(const Hull<S>&, int, const Vec3<S>(&)[2], S); \
  template ClippedSegment<S> clip_to_edge(const Hull<S>&, int, const Vec3<S>(&)[2]);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
