#include "manifold/incremental_core.h"

#include <cmath>
#include <cstddef>

#include "geometry/core_hull.h"

namespace contactscope {

template <class S>
int ShapeCore<S>::count() const {
  switch (kind) {
    case ShapeKind::Sphere:
      return 1;
    case ShapeKind::Capsule:
      return 2;
    case ShapeKind::Hull:
      return hull.vertex_count();
    default:
      return 0;
  }
}

template <class S>
const Vec3<S>& ShapeCore<S>::vertex(int index) const {
  return kind == ShapeKind::Hull ? hull.vertices[static_cast<std::size_t>(index)] : points[index];
}

template <class S>
SupportSet<S> ShapeCore<S>::support() const {
  if (kind == ShapeKind::Hull) return support_set(hull);
  return kind == ShapeKind::Capsule ? support_set(points) : support_set(points[0]);
}

template <class S>
S ShapeCore<S>::reach() const {
  return kind == ShapeKind::Plane ? std::abs(plane.offset) : reach_of(support());
}

template <class S>
FeatureRef ShapeCore<S>::ref(Owner owner, const CoreFeature& feature) const {
  FeatureRef result(owner, feature.kind, static_cast<std::uint32_t>(feature.index));
  if (kind != ShapeKind::Hull) return result;
  const auto& refs = feature.kind == FeatureKind::Vertex ? vertices
                     : feature.kind == FeatureKind::Edge ? edges
                                                         : faces;
  result = refs[static_cast<std::size_t>(feature.index)];
  result.owner = owner;
  return result;
}

template <class S>
ShapeCore<S> core_of(const Shape<S>& shape, double core_margin) {
  ShapeCore<S> core;
  core.kind = kind_of(shape);
  core.points[0] = core.points[1] = Vec3<S>::Zero();
  if (const auto* sphere = std::get_if<Sphere<S>>(&shape)) {
    core.margin = sphere->radius;
  } else if (const auto* capsule = std::get_if<Capsule<S>>(&shape)) {
    core.margin = capsule->radius;
    core.points[0] = capsule->points[0];
    core.points[1] = capsule->points[1];
  } else if (const auto* hull = std::get_if<Hull<S>>(&shape)) {
    // The margin that the pipeline has, so that the faces move by exactly this.
    const auto margin = static_cast<double>(static_cast<S>(core_margin));
    CoreHull moved = core_hull(hull_cast<double>(*hull), margin);
    core.hull = hull_cast<S>(moved.hull);
    core.margin = static_cast<S>(moved.margin);
    core.reduced = moved.reduced;
    core.vertices = std::move(moved.vertices);
    core.edges = std::move(moved.edges);
    core.faces = std::move(moved.faces);
  } else if (const auto* half_space = std::get_if<HalfSpace<S>>(&shape)) {
    core.plane = half_space->plane;
  }
  return core;
}

template <class S>
int edge_between(const Hull<S>& hull, int one, int other) {
  const int first = hull.vertex_edges[static_cast<std::size_t>(one)];
  int edge = first;
  do {
    const int twin = Hull<S>::twin(edge);
    if (hull.half_edges[static_cast<std::size_t>(twin)].origin == other) return edge / 2;
    edge = hull.half_edges[static_cast<std::size_t>(twin)].next;
  } while (edge != first);
  return -1;
}

#define CONTACTSCOPE_INSTANTIATE(S)                       \
  template struct ShapeCore<S>;                           \
  template ShapeCore<S> core_of(const Shape<S>&, double); \
  template int edge_between(const Hull<S>&, int, int);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
