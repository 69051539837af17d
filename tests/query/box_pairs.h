#pragma once

#include <cmath>

#include "geometry/obb.h"
#include "support/random_geometry.h"

namespace contactscope::test {

/// How the second box of a random pair is turned against the first.
enum class Turned {
  Anyhow,
  Parallel,        // by quarters of a turn about its axes, as a rounded rotation has it
  NearlyParallel,  // the same and 1e-17 to 0.1 rad about any axis
  AboutAnEdge,     // by any angle about an axis that both share
};

/// Two oriented boxes of up to `size` metres, sides up to a thousand times shorter, one in eight of
/// them 0. Half the pairs are anywhere about touching, the others touch along one of the fifteen
/// axes but for up to some hundred roundings. All of it `out` metres from the origin.
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
  // Along any direction of the fifteen: so far that they touch.
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
  // Anywhere across, so that features meet and not middles.
  const Vec3d across = axis.cross(random.unit_vector()) * random.uniform(0, 0.5) * reach;
  const Vec3d way = factor * reach * axis + across;
  result[1].center = result[0].center + way.cast<S>();
  return result;
}

}  // namespace contactscope::test
