#include "continuous/motion.h"

#include <cmath>

namespace contactscope {

template <class S>
Pose<S> Motion<S>::at(S time) const {
  const S angle = turn.norm();
  Pose<S> pose = start;
  if (angle > S(0)) {
    const S half = S(0.5) * time * angle;
    Quat<S> by;
    by.w() = std::cos(half);
    by.vec() = (std::sin(half) / angle) * turn;
    pose.rotation = (by * start.rotation).normalized();
  }
  pose.position = start.transform(pivot) + time * displacement - pose.rotate(pivot);
  return pose;
}

template struct Motion<float>;
template struct Motion<double>;

}  // namespace contactscope
