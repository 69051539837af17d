#include "bench/passes.h"

#include <map>
#include <string>

#include "bench/workload.h"
#include "manifold/collide_hull_hull.h"
#ifndef CONTACTSCOPE_WITHOUT_RECORDER
#include "manifold/finish_contact.h"
#include "manifold/trace_recorder.h"
#endif

namespace contactscope::bench {
namespace {

const std::vector<WorkloadPair>& pairs_of(int workload) {
  static std::map<int, std::vector<WorkloadPair>> made;
  std::vector<WorkloadPair>& pairs = made[workload];
  if (pairs.empty()) pairs = make_workload(static_cast<Workload>(workload));
  return pairs;
}

CollideOptions<float> options() {
  CollideOptions<float> result;
  result.reducer = find_reducer<float>("area");
  return result;
}

double digest(const Manifold<float>& manifold) {
  double sum = manifold.normal.x();
  for (const ContactPoint<float>& point : manifold.points) sum += point.separation;
  return sum;
}

}  // namespace

double pass_unrecorded(int workload) {
  const CollideOptions<float> settings = options();
  double sum = 0;
  for (const WorkloadPair& pair : pairs_of(workload)) {
    sum += digest(collide_hull_hull(pair.a, pair.pose_a, pair.b, pair.pose_b, settings));
  }
  return sum;
}

#ifndef CONTACTSCOPE_WITHOUT_RECORDER
double pass_recorded(int workload) {
  const CollideOptions<float> settings = options();
  double sum = 0;
  trace::Pair record;
  record.a = std::string("first");
  record.b = std::string("second");
  for (const WorkloadPair& pair : pairs_of(workload)) {
    const ToWorld<float> to_world(pair.pose_a);
    TraceRecorder<float> recorder(to_world, "area", {}, false, record);
    Contact<float> contact;
    Manifold<float> manifold;
    collide_hull_hull(pair.a, pair.b, relative_pose(pair.pose_a, pair.pose_b), settings, contact,
                      recorder);
    finish_contact(to_world, settings, contact, manifold, recorder);
    recorder.manifold(manifold);
    sum += digest(manifold);
  }
  return sum;
}
#endif

}  // namespace contactscope::bench
