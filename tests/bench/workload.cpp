#include "bench/workload.h"

#include <utility>

#include "bench/draw_hulls.h"
#include "bench/draw_mesh.h"
#include "bench/draw_round.h"

namespace contactscope::bench {
namespace {

using test::Random;

constexpr double kMoveAStep = 0.0002;  // metres
constexpr double kTurnAStep = 0.0005;  // radians

bool is_round(Workload workload) {
  return workload == Workload::CapsuleHull || workload == Workload::SphereHull ||
         workload == Workload::CapsuleCapsule;
}

bool is_on_mesh(Workload workload) {
  return workload == Workload::BoxMesh || workload == Workload::HullMesh;
}

Workload at_rest(Workload workload) {
  if (workload == Workload::BoxFaceMoving) return Workload::BoxFace;
  if (workload == Workload::Hull32Moving) return Workload::Hull32;
  return workload;
}

Pose<double> moved(const Pose<double>& by, const Pose<double>& pose) {
  Pose<double> result = compose(by, pose);
  result.rotation.normalize();
  return result;
}

/// One placement, or one per step: B moves straight, turns about its position, and reaches the
/// drawn pose in the middle.
std::vector<Placement> placements(Workload workload, const Placement& drawn, Random& random) {
  const Pose<double> whole = random.pose(5);
  const Placement placed{moved(whole, drawn.a), moved(whole, drawn.b)};
  if (!is_moving(workload)) return {placed};
  const Vec3d direction = random.unit_vector();
  const Vec3d axis = random.unit_vector();
  std::vector<Placement> result;
  for (int i = 0; i < kSteps; ++i) {
    const double steps = i - 0.5 * (kSteps - 1);
    Placement step = placed;
    step.b.position += steps * kMoveAStep * direction;
    step.b.rotation =
        (Quatd(Eigen::AngleAxisd(steps * kTurnAStep, axis)) * placed.b.rotation).normalized();
    result.push_back(step);
  }
  return result;
}

std::shared_ptr<const Shape<double>> shared(Shape<double> shape) {
  return std::make_shared<const Shape<double>>(std::move(shape));
}

}  // namespace

std::vector<WorkloadPair> make_workload(Workload workload, int count) {
  Random random(1024 + static_cast<std::uint64_t>(at_rest(workload)));
  std::shared_ptr<const Shape<double>> grid;
  if (is_on_mesh(workload)) grid = shared(wavy_grid());
  std::vector<WorkloadPair> result;
  while (result.size() < static_cast<std::size_t>(count)) {
    WorkloadPair pair;
    Placement drawn;
    if (is_on_mesh(workload)) {
      DrawnHull hull = draw_on_mesh(workload, *std::get_if<Mesh<double>>(grid.get()), random);
      drawn = {hull.pose, {}};
      pair.a = shared(std::move(hull.hull));
      pair.b = grid;
    } else if (is_round(workload)) {
      DrawnPair round = draw_round(workload, random);
      drawn = {round.pose_a, round.pose_b};
      pair.a = shared(std::move(round.a));
      pair.b = shared(std::move(round.b));
    } else {
      test::PairCase<double> hulls = draw_hulls(at_rest(workload), random, result.size());
      drawn = {hulls.pose_a, hulls.pose_b};
      pair.a = shared(std::move(hulls.a));
      pair.b = shared(std::move(hulls.b));
    }
    pair.steps = placements(workload, drawn, random);
    result.push_back(std::move(pair));
  }
  // Shuffled, so that no branch predictor can learn the order.
  for (std::size_t i = result.size(); i-- > 1;) {
    std::swap(result[i], result[static_cast<std::size_t>(random.index(static_cast<int>(i) + 1))]);
  }
  return result;
}

}  // namespace contactscope::bench
