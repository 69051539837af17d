#pragma once

#include "core/vec3.h"

namespace contactscope::test {

/// IsMinkowskiFace after Gregorius 2013, with triple products of normals: whether the arcs a1 a2
/// and (-b1) (-b2) cross on the Gauss map. The pipeline walks arcs instead.
inline bool is_minkowski_face(const Vec3d& a1, const Vec3d& a2, const Vec3d& b1, const Vec3d& b2) {
  const Vec3d c = -b1;
  const Vec3d d = -b2;
  const Vec3d b_x_a = a2.cross(a1);
  const Vec3d d_x_c = d.cross(c);
  const double cba = c.dot(b_x_a);
  const double dba = d.dot(b_x_a);
  const double adc = a1.dot(d_x_c);
  const double bdc = a2.dot(d_x_c);
  return cba * dba < 0 && adc * bdc < 0 && cba * bdc > 0;
}

}  // namespace contactscope::test
