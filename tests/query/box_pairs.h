#pragma once

#include <cmath>

#include "geometry/obb.h"
#include "support/random_geometry.h"

namespace contactscope::test {

/// Rotation of the second box of a random pair relative to the first.
enum class Turned {
  Anyhow,
  Parallel,        // by quarter turns about its axes, as a rounded rotation gives them
  NearlyParallel,  // the same plus 1e-17 to 0.1 rad about any axis
  AboutAnEdge,     // by any angle about an axis that both share
};

/// Two oriented boxes of up to `size` metres, with sides up to a thousand times shorter and one in
/// eight of length 0. Half of the pairs are up to half a size from touching; the others touch along
/// one of the fifteen axes, up to some hundred roundings. Both are `out` metres from the origin.
template <class S>
std::array<Obb<S>, 2> random_boxes(Random& random, double size, Turned turned, double out = 0) {
  const auto side = [&] { return random.chance(0.125) ? 0 : size * random.decade(-3, 0); };
  std::array<Obb<double>, 2> boxes;
  Quatd turns[2];
  turns[0] = random.rotation();
  Quatd turn = random.rotation();
  const double quarter = 1.5707963267948966;
  if (turned != Turned::Anyhow) {
    turn = Quatd(Eigen::AngleAxisd(quarter * random.index(4), Vec3d::Unit(random.index(3)))) *
           Quatd(Eigen::AngleAxisd(quarter * random.index(4), Vec3d::Unit(random.index(3))));
  }
  if (turned == Turned::NearlyParallel) turn = turn * random.rotation_by(random.decade(-17, -1));
  if (turned == Turned::AboutAnEdge)
    turn = turn * Quatd(Eigen::AngleAxisd(random.uniform(0, 6.3), Vec3d::Unit(random.index(3))));
  turns[1] = turns[0] * turn;
  std::array<Obb<S>, 2> result;
  for (std::size_t k = 0; k < 2; ++k) {
    const Quat<S> rounded = turns[k].cast<S>().normalized();
    result[k].axes = rounded.toRotationMatrix();
    boxes[k].axes = result[k].axes.template cast<double>();
    boxes[k].half_extents = {side(), side(), side()};
    result[k].half_extents = boxes[k].half_extents.cast<S>();
  }
  const Vec3d at = out * random.unit_vector();
  result[0].center = at.cast<S>();
  // Place the boxes in contact along one of the fifteen axes.
  Vec3d axis = random.chance(0.5) ? Vec3d(boxes[0].axes.col(random.index(3)))
                                  : Vec3d(boxes[1].axes.col(random.index(3)));
  if (random.chance(0.6)) {
    const Vec3d a = boxes[0].axes.col(random.index(3)), b = boxes[1].axes.col(random.index(3));
    if (a.cross(b).norm() > 0) axis = a.cross(b).normalized();
  }
  if (random.chance(0.5)) axis = -axis;
  double reach = 0;
  for (const Obb<double>& box : boxes)
    reach += box.half_extents.dot((box.axes.transpose() * axis).cwiseAbs());
  const double noise = std::numeric_limits<S>::epsilon() * random.decade(-1, 3);
  const double factor =
      random.chance(0.5) ? random.uniform(0.3, 1.5) : 1 + noise * random.uniform(-1, 1);
  // A random shift across, so that features meet and not centres.
  const Vec3d across = axis.cross(random.unit_vector()) * random.uniform(0, 0.5) * reach;
  const Vec3d offset = factor * reach * axis + across;
  result[1].center = result[0].center + offset.cast<S>();
  return result;
}

}  // namespace contactscope::test
