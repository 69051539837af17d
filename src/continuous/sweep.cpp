#include "continuous/sweep.h"

namespace contactscope {

template <class S>
Pose<S> Sweep<S>::at(S time) const {
  const S angle = turn.norm();
  Pose<S> pose = start;
  if (angle > S(0))
    pose.rotation = turned(start.rotation, Vec3<S>(turn / angle), time * angle).normalized();
  pose.position = start.transform(pivot) + time * displacement - pose.rotate(pivot);
  return pose;
}

template struct Sweep<float>;
template struct Sweep<double>;

}  // namespace contactscope
