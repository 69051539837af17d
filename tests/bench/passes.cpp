#include "bench/passes.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bench/step_counter.h"
#include "bench/workload.h"
#include "manifold/collide_pairs.h"
#include "manifold/dispatch.h"

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

/// One workload in float, made once.
class TimedWorkload {
 public:
  explicit TimedWorkload(Workload workload) : moving(is_moving(workload)) {
    std::map<const Shape<double>*, std::shared_ptr<const Shape<float>>> cast;
    const auto in_float = [&](const std::shared_ptr<const Shape<double>>& shape) {
      auto& result = cast[shape.get()];
      if (!result) result = std::make_shared<const Shape<float>>(shape_cast<float>(*shape));
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

const TimedWorkload& workload_at(int index) {
  static std::map<int, TimedWorkload> made;
  return made.try_emplace(index, static_cast<Workload>(index)).first->second;
}

CollideOptions options() {
  CollideOptions result;
  result.reducer = find_reducer("area");
  return result;
}

double digest(const Manifolds<float>& manifolds) {
  double sum = 0;
  for (const Manifold<float>& manifold : manifolds) {
    sum += manifold.normal.x();
    for (const ContactPoint<float>& point : manifold.points) sum += point.separation;
  }
  return sum;
}

/// What a variant keeps between its passes over a workload.
struct Memory {
  StepCounter counter;
  std::vector<PairCache<float>> caches;  // one a pair, where pairs move
};

template <class Collide>
double pass(int index, Memory& memory, bool cached, const Collide& collide_pair) {
  const TimedWorkload& workload = workload_at(index);
  if (cached && workload.moving) memory.caches.resize(workload.pairs.size());
  const std::size_t step = memory.counter.next(workload.pairs.front().steps.size());
  double sum = 0;
  for (std::size_t i = 0; i < workload.pairs.size(); ++i) {
    PairCache<float>* cache = memory.caches.empty() ? nullptr : &memory.caches[i];
    sum += collide_pair(workload.pairs[i], workload.pairs[i].steps[step], cache);
  }
  return sum;
}

double pass_without_recorder(int index, Memory& memory, bool cached) {
  const CollideOptions settings = options();
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

double pass_general(int workload) {
  static std::map<int, Memory> memories;
  const CollideOptions settings = options();
  Manifolds<float> manifolds(1);
  return pass(workload, memories[workload], false,
              [&](const TimedPair& pair, const Step& step, PairCache<float>* cache) {
                manifolds[0] =
                    collide_hull_hull(std::get<Hull<float>>(*pair.a), step.a,
                                      std::get<Hull<float>>(*pair.b), step.b, settings, cache);
                return digest(manifolds);
              });
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
