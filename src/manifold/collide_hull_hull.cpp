#include "manifold/collide_hull_hull.h"

#include "manifold/create_contact.h"
#include "manifold/recorder.h"
#include "manifold/to_world.h"
#include "query/sat.h"
#ifndef CONTACTSCOPE_WITHOUT_RECORDER
#include "manifold/trace_recorder.h"
#endif

namespace contactscope {
namespace {

template <class S>
void move_to_world(const ToWorld<S>& to_world, Contact<S>& contact) {
  contact.normal = to_world.direction(contact.normal);
  for (ContactPoint<S>& point : contact.points) point.position = to_world.point(point.position);
}

/// Gregorius 2015, "Contact Point Reduction". Without a reducer, or one that has nothing to do, the
/// points stay as they are.
template <class S, class Recorder>
void reduce(const Contact<S>& contact, const CollideOptions<S>& options, Manifold<S>& manifold,
            Recorder& recorder) {
  manifold.normal = contact.normal;
  manifold.axis = contact.axis;
  const std::span<const ContactPoint<S>> points(contact.points.data(), contact.points.size());
  if (options.reducer == nullptr || points.empty()) {
    manifold.points = contact.points;
    return;
  }
  const Reduction reduced =
      contactscope::reduce(options.reducer, points, contact.normal, options.reduction);
  for (const int index : reduced.kept) {
    manifold.points.push_back(points[static_cast<std::size_t>(index)]);
  }
  recorder.reduction(points, contact.normal, options.reduction.max_points, reduced.kept);
}

/// Gregorius 2015, SAT( manifold, hullA, hullB ).
template <class S, class Recorder>
Manifold<S> collide(const HullPair<S>& pair, const ToWorld<S>& to_world,
                    const CollideOptions<S>& options, Recorder& recorder) {
  Manifold<S> manifold;
  const SatResult<S> axes = sat(pair, options.margin, options.preference);
  recorder.axes(pair, axes, options.preference);
  if (axes.status == SatStatus::Touching) {
    Contact<S> contact;
    create_contact(pair, axes, options.margin, options.preference, contact, recorder);
    recorder.contact_axis(contact.axis);
    move_to_world(to_world, contact);
    reduce(contact, options, manifold, recorder);
  }
  recorder.manifold(manifold);
  return manifold;
}

}  // namespace

template <class S>
Manifold<S> collide_hull_hull(const Hull<S>& a, const Pose<S>& pose_a, const Hull<S>& b,
                              const Pose<S>& pose_b, const CollideOptions<S>& options) {
  const HullPair<S> pair(a, b, relative_pose(pose_a, pose_b));
  NoRecorder<S> recorder;
  return collide(pair, ToWorld<S>(pose_a), options, recorder);
}

template Manifold<float> collide_hull_hull(const Hull<float>&, const Pose<float>&,
                                           const Hull<float>&, const Pose<float>&,
                                           const CollideOptions<float>&);
template Manifold<double> collide_hull_hull(const Hull<double>&, const Pose<double>&,
                                            const Hull<double>&, const Pose<double>&,
                                            const CollideOptions<double>&);

#ifndef CONTACTSCOPE_WITHOUT_RECORDER

template <class S>
Manifold<S> collide_hull_hull(const Hull<S>& a, const Pose<S>& pose_a, const Hull<S>& b,
                              const Pose<S>& pose_b, const CollideOptions<S>& options,
                              const char* reducer_name, const trace::Stages& stages,
                              trace::Pair& record) {
  const HullPair<S> pair(a, b, relative_pose(pose_a, pose_b));
  const ToWorld<S> to_world(pose_a);
  TraceRecorder<S> recorder(to_world, reducer_name, stages, record);
  return collide(pair, to_world, options, recorder);
}

template Manifold<float> collide_hull_hull(const Hull<float>&, const Pose<float>&,
                                           const Hull<float>&, const Pose<float>&,
                                           const CollideOptions<float>&, const char*,
                                           const trace::Stages&, trace::Pair&);
template Manifold<double> collide_hull_hull(const Hull<double>&, const Pose<double>&,
                                            const Hull<double>&, const Pose<double>&,
                                            const CollideOptions<double>&, const char*,
                                            const trace::Stages&, trace::Pair&);

#endif

}  // namespace contactscope
