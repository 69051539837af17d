#include "geometry/shape.h"

namespace contactscope {

template <class T>
Shape<T> shape_cast(const Shape<double>& shape) {
  if (const auto* sphere = std::get_if<Sphere<double>>(&shape))
    return Sphere<T>{static_cast<T>(sphere->radius)};
  if (const auto* capsule = std::get_if<Capsule<double>>(&shape))
    return Capsule<T>{{capsule->points[0].cast<T>(), capsule->points[1].cast<T>()},
                      static_cast<T>(capsule->radius)};
  if (const auto* hull = std::get_if<Hull<double>>(&shape)) return hull_cast<T>(*hull);
  if (const auto* half_space = std::get_if<HalfSpace<double>>(&shape))
    return HalfSpace<T>{half_space->plane.cast<T>()};
  return mesh_cast<T>(std::get<Mesh<double>>(shape));
}

template Shape<float> shape_cast(const Shape<double>&);
template Shape<double> shape_cast(const Shape<double>&);

}  // namespace contactscope
