#include "manifold/collide_hull_plane.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "manifold/plane_contact.h"
#include "query/tolerance.h"

namespace contactscope {
namespace {

template <class S>
bool is_deeper(const ContactPoint<S>& one, const ContactPoint<S>& other) {
  return one.separation < other.separation;
}

/// Keeps the deepest of more points than a manifold holds: a heap with the highest of them on top.
template <class S>
void replace_highest(const ContactPoint<S>& point, bool& is_heap, PointSet<S>& points) {
  if (!is_heap) std::make_heap(points.begin(), points.end(), is_deeper<S>);
  is_heap = true;
  if (!is_deeper(point, *points.begin())) return;
  std::pop_heap(points.begin(), points.end(), is_deeper<S>);
  points.back() = point;
  std::push_heap(points.begin(), points.end(), is_deeper<S>);
}

/// How many vertices lie as low as the lowest.
template <class S>
std::size_t count_lowest(const Hull<S>& hull, const Plane<S>& plane, S lowest, S tolerance) {
  std::size_t count = 0;
  for (const Vec3<S>& vertex : hull.vertices) {
    if (plane.distance(vertex) <= lowest + tolerance) ++count;
  }
  return count;
}

}  // namespace

template <class S>
S collide_hull_plane(const Hull<S>& a, const HalfSpace<S>& b, const Pose<S>& b_in_a,
                     const CollideOptions<S>& options, Contact<S>& contact,
                     Recorder<S>* /*recorder*/) {
  const Plane<S> plane = plane_in_a(b, b_in_a);
  S lowest = std::numeric_limits<S>::infinity();
  bool is_heap = false;
  for (int v = 0; v < a.vertex_count(); ++v) {
    const Vec3<S>& vertex = a.vertices[static_cast<std::size_t>(v)];
    const S height = plane.distance(vertex);
    lowest = std::min(lowest, height);
    if (height > options.margin) continue;
    const ContactPoint<S> point = plane_point(plane, vertex, height, S(0), v);
    if (contact.points.size() < kMaxManifoldPoints) {
      contact.points.push_back(point);
    } else {
      replace_highest(point, is_heap, contact.points);
    }
  }
  if (lowest > options.margin) return lowest;
  if (is_heap) {  // back to the order of the vertices
    std::sort(contact.points.begin(), contact.points.end(),
              [](const auto& one, const auto& other) { return one.id < other.id; });
  }

  const S scale = a.centroid.cwiseAbs().maxCoeff() + a.radius + std::abs(plane.offset);
  const S tolerance =
      options.preference == Preference::Relative ? kLevel<S> * a.radius : tie_tolerance(scale);
  const std::size_t count = count_lowest(a, plane, lowest, tolerance);
  begin_plane_contact(plane, face_contact_type(count), contact);
  return lowest;
}

template CollideConvex<float, Hull<float>, HalfSpace<float>> collide_hull_plane;
template CollideConvex<double, Hull<double>, HalfSpace<double>> collide_hull_plane;

}  // namespace contactscope
