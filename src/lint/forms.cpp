#include "lint/reading.h"

namespace contactscope::lint {

bool takes(const trace::Shape& shape, Form form) {
  switch (form) {
    case Form::AsReported:
      return false;
    case Form::BoxesHalf:
    case Form::BoxesTwice:
      return shape.type == "box";
    case Form::RadiiHalf:
    case Form::RadiiTwice:
      return shape.radius > 0;
    case Form::CapsulesHalf:
    case Form::CapsulesTwice:
    case Form::CapsulesAlongX:
    case Form::CapsulesAlongY:
    case Form::CapsulesAlongZ:
      return shape.vertices.size() == 2 && shape.radius > 0;
    case Form::OffsetsNegated:
    case Form::PlanesTurned:
      return shape.half_space.has_value();
  }
  return false;
}

namespace {

Vec3d middle_of(const trace::Shape& shape) {
  Vec3d sum = Vec3d::Zero();
  for (const Vec3d& vertex : shape.vertices) sum += vertex;
  return sum / static_cast<double>(shape.vertices.size());
}

/// Scales about the centre of the vertices.
void scale(trace::Shape& shape, double factor) {
  const Vec3d middle = middle_of(shape);
  for (Vec3d& vertex : shape.vertices) vertex = middle + factor * (vertex - middle);
}

void lay_along(trace::Shape& capsule, int axis) {
  const Vec3d middle = middle_of(capsule);
  const Vec3d half = 0.5 * (capsule.vertices[1] - capsule.vertices[0]).norm() * Vec3d::Unit(axis);
  capsule.vertices = {middle - half, middle + half};
}

}  // namespace

trace::Shape reformed(trace::Shape shape, Form form) {
  switch (form) {
    case Form::AsReported:
      break;
    case Form::BoxesHalf:
    case Form::CapsulesHalf:
      scale(shape, 0.5);
      break;
    case Form::BoxesTwice:
    case Form::CapsulesTwice:
      scale(shape, 2);
      break;
    case Form::RadiiHalf:
      shape.radius *= 0.5;
      break;
    case Form::RadiiTwice:
      shape.radius *= 2;
      break;
    case Form::CapsulesAlongX:
      lay_along(shape, 0);
      break;
    case Form::CapsulesAlongY:
      lay_along(shape, 1);
      break;
    case Form::CapsulesAlongZ:
      lay_along(shape, 2);
      break;
    case Form::PlanesTurned:
      shape.half_space->normal = -shape.half_space->normal;
      [[fallthrough]];
    case Form::OffsetsNegated:
      shape.half_space->offset = -shape.half_space->offset;
      break;
  }
  return shape;
}

}  // namespace contactscope::lint
