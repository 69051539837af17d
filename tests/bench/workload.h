#pragma once

#include <vector>

#include "core/pose.h"
#include "geometry/hull.h"

namespace contactscope::bench {

/// The workloads that pipelines are compared on, 1024 seeded pairs each: cubes of side 1, hulls of
/// 32 vertices on a sphere of radius 0.5, each pair at a random pose within 5 m of the origin.
enum class Workload {
  BoxFace,    // W1: box on box, tilt to 3 mrad, yaw 5 to 40 degrees, overlap 1 to 10 mm
  BoxEdge,    // W2: box edge across box edge, overlap 1 to 10 mm
  BoxRandom,  // W3: boxes in random poses whose bounding boxes overlap, half of them separated
  Hull32,     // W4: hull on hull, overlap 1 to 10 mm
};

inline constexpr int kWorkloads = 4;
inline constexpr int kPairsPerWorkload = 1024;

struct WorkloadPair {
  Hull<float> a;
  Pose<float> pose_a;
  Hull<float> b;
  Pose<float> pose_b;
};

std::vector<WorkloadPair> make_workload(Workload workload);

}  // namespace contactscope::bench
