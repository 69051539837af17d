#include "geometry/shape.h"

namespace contactscope {
namespace {

template <class T, class S>
Sphere<T> cast(const Sphere<S>& sphere) {
  return {static_cast<T>(sphere.radius)};
}

template <class T, class S>
Capsule<T> cast(const Capsule<S>& capsule) {
  return {{capsule.points[0].template cast<T>(), capsule.points[1].template cast<T>()},
          static_cast<T>(capsule.radius)};
}

template <class T, class S>
Hull<T> cast(const Hull<S>& hull) {
  return hull_cast<T>(hull);
}

template <class T, class S>
HalfSpace<T> cast(const HalfSpace<S>& half_space) {
  return {half_space.plane.template cast<T>()};
}

}  // namespace

template <class T, class S>
Shape<T> shape_cast(const Shape<S>& shape) {
  return std::visit([](const auto& kind) { return Shape<T>(cast<T>(kind)); }, shape);
}

template Shape<float> shape_cast(const Shape<double>&);
template Shape<double> shape_cast(const Shape<double>&);

}  // namespace contactscope
