#include "geometry/shape.h"

namespace contactscope {
namespace {

template <class T>
Sphere<T> cast(const Sphere<double>& sphere) {
  return {static_cast<T>(sphere.radius)};
}

template <class T>
Capsule<T> cast(const Capsule<double>& capsule) {
  return {{capsule.points[0].template cast<T>(), capsule.points[1].template cast<T>()},
          static_cast<T>(capsule.radius)};
}

template <class T>
Hull<T> cast(const Hull<double>& hull) {
  return hull_cast<T>(hull);
}

template <class T>
HalfSpace<T> cast(const HalfSpace<double>& half_space) {
  return {half_space.plane.template cast<T>()};
}

template <class T>
Mesh<T> cast(const Mesh<double>& mesh) {
  return mesh_cast<T>(mesh);
}

}  // namespace

template <class T>
Shape<T> shape_cast(const Shape<double>& shape) {
  return std::visit([](const auto& kind) { return Shape<T>(cast<T>(kind)); }, shape);
}

template Shape<float> shape_cast(const Shape<double>&);
template Shape<double> shape_cast(const Shape<double>&);

}  // namespace contactscope
