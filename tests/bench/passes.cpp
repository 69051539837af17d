#include "bench/passes.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bench/step_counter.h"
#include "bench/workload.h"
#include "manifold/collide_pairs.h"
#include "manifold/create_contact.h"
#include "manifold/dispatch.h"
#include "query/sat.h"

namespace contactscope::bench {
namespace {

struct Step {
  Pose<float> a;
  Pose<float> b;
};

struct TimedPair {
  std::shared_ptr<const Shape<float>> a;
  std::shared_ptr<const Shape<float>> b;
  std::vector<Step> steps;
};

/// Makes a hull of a box without marking it as a box.
Shape<float> forgotten(Shape<float> shape) {
  if (Hull<float>* hull = std::get_if<Hull<float>>(&shape)) hull->half_extents.setZero();
  return shape;
}

/// One workload in float, built once.
class TimedWorkload {
 public:
  TimedWorkload(Workload workload, bool general) : moving(is_moving(workload)) {
    std::map<const Shape<double>*, std::shared_ptr<const Shape<float>>> cast;
    const auto in_float = [&](const std::shared_ptr<const Shape<double>>& shape) {
      auto& result = cast[shape.get()];
      if (!result) {
        Shape<float> made = shape_cast<float>(*shape);
        result = std::make_shared<const Shape<float>>(general ? forgotten(std::move(made))
                                                              : std::move(made));
      }
      return result;
    };
    const std::vector<WorkloadPair> made = make_workload(workload);
    for (const WorkloadPair& pair : made) {
      TimedPair timed{in_float(pair.a), in_float(pair.b), {}};
      for (const Placement& step : pair.steps) {
        timed.steps.push_back({step.a.cast<float>(), step.b.cast<float>()});
      }
      pairs.push_back(std::move(timed));
    }
  }

  std::vector<TimedPair> pairs;
  bool moving;
};

const TimedWorkload& workload_at(int index, bool general) {
  static std::map<std::pair<int, bool>, TimedWorkload> made;
  return made.try_emplace({index, general}, static_cast<Workload>(index), general).first->second;
}

CollideOptions options() {
  CollideOptions result;
  result.reducer = find_reducer("area");
  return result;
}

double digest(const Manifold<float>& manifold) {
  double sum = manifold.normal.x();
  for (const ContactPoint<float>& point : manifold.points) sum += point.separation;
  return sum;
}

double digest(const Manifolds<float>& manifolds) {
  double sum = 0;
  for (const Manifold<float>& manifold : manifolds) sum += digest(manifold);
  return sum;
}

/// The state of a variant between its passes over a workload.
struct Memory {
  bool general = false;  // treats boxes as any hulls
  StepCounter counter;
  std::vector<PairCache<float>> caches;  // one per pair, if pairs move
};

template <class Collide>
double pass(int index, Memory& memory, bool cached, const Collide& collide_pair) {
  const TimedWorkload& workload = workload_at(index, memory.general);
  if (cached && workload.moving) memory.caches.resize(workload.pairs.size());
  const std::size_t step = memory.counter.next(workload.pairs.front().steps.size());
  double sum = 0;
  for (std::size_t i = 0; i < workload.pairs.size(); ++i) {
    PairCache<float>* cache = memory.caches.empty() ? nullptr : &memory.caches[i];
    sum += collide_pair(workload.pairs[i], workload.pairs[i].steps[step], cache);
  }
  return sum;
}

double pass_without_recorder(int index, Memory& memory, bool cached,
                             const CollideOptions& settings = options()) {
  Manifolds<float> manifolds;
  return pass(index, memory, cached,
              [&](const TimedPair& pair, const Step& step, PairCache<float>* cache) {
                collide(*pair.a, step.a, *pair.b, step.b, settings, manifolds, cache);
                return digest(manifolds);
              });
}

}  // namespace

double pass_unrecorded(int workload) {
  static std::map<int, Memory> memories;
  return pass_without_recorder(workload, memories[workload], true);
}

double pass_cold(int workload) {
  static std::map<int, Memory> memories;
  return pass_without_recorder(workload, memories[workload], false);
}

double pass_by_triangle(int workload) {
  static std::map<int, Memory> memories;
  CollideOptions settings = options();
  settings.mesh_manifolds = MeshManifolds::Triangle;
  return pass_without_recorder(workload, memories[workload], false, settings);
}

double pass_general(int workload) {
  static std::map<int, Memory> memories;
  Memory& memory = memories[workload];
  memory.general = true;
  const CollideOptions settings = options();
  Recorder<float>* const no_record = nullptr;
  Contact<float> contact;
  Manifold<float> manifold;
  const auto finished = [&](const Step& step) {
    finish_contact(ToWorld<float>(step.a), settings, contact, manifold, no_record);
    return digest(manifold);
  };
  switch (static_cast<Workload>(workload)) {
    case Workload::Hull32:
      return pass(workload, memory, false,
                  [&](const TimedPair& timed, const Step& step, PairCache<float>*) {
                    const HullPair<float> pair(std::get<Hull<float>>(*timed.a),
                                               std::get<Hull<float>>(*timed.b),
                                               relative_pose(step.a, step.b));
                    FaceSeparations<float> faces_a(pair.a), faces_b(pair.b);
                    const SatResult<float> axes = sat(pair, static_cast<float>(settings.margin),
                                                      settings.preference, faces_a, faces_b);
                    contact.points.clear();
                    if (axes.status == SatStatus::Touching)
                      create_contact(pair, axes, settings, contact, no_record);
                    return finished(step);
                  });
    case Workload::CapsuleCapsule:
      return pass(
          workload, memory, false, [&](const TimedPair& pair, const Step& step, PairCache<float>*) {
            contact.points.clear();
            collide_capsule_capsule(std::get<Capsule<float>>(*pair.a),
                                    std::get<Capsule<float>>(*pair.b),
                                    relative_pose(step.a, step.b), settings, contact, no_record);
            return finished(step);
          });
    default:
      return pass_without_recorder(workload, memory, true);
  }
}

double pass_recorded(int workload) {
  static std::map<int, Memory> memories;
  const CollideOptions settings = options();
  Manifolds<float> manifolds;
  return pass(workload, memories[workload], true,
              [&](const TimedPair& pair, const Step& step, PairCache<float>* cache) {
                trace::Pair record;
                record.a = "first";
                record.b = "second";
                collide(*pair.a, step.a, *pair.b, step.b, settings, manifolds, cache, &record);
                return digest(manifolds);
              });
}

}  // namespace contactscope::bench
