#include "continuous/motion.h"

namespace contactscope {

template <class S>
Pose<S> Motion<S>::at(S time) const {
  const S angle = turn.norm();
  Pose<S> pose = start;
  if (angle > S(0))
    pose.rotation = turned(start.rotation, Vec3<S>(turn / angle), time * angle).normalized();
  pose.position = start.transform(pivot) + time * displacement - pose.rotate(pivot);
  return pose;
}

template struct Motion<float>;
template struct Motion<double>;

}  // namespace contactscope
