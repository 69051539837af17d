#pragma once

#include <memory>
#include <vector>

#include "core/pose.h"
#include "geometry/shape.h"

namespace contactscope::bench {

/// The workloads that pipelines are compared on: seeded pairs of cubes of side 1, hulls of 32 (16)
/// vertices on a sphere of radius 0.5, spheres and capsules of radius 0.25, and a wavy grid of
/// 10,000 triangles. Each pair is at a random pose within 5 m of the origin.
enum class Workload {
  BoxFace,         // W1: box on box, tilt to 3 mrad, yaw 5 to 40 degrees, overlap 1 to 10 mm
  BoxEdge,         // W2: box edge across box edge, overlap 1 to 10 mm
  BoxRandom,       // W3: random poses of boxes whose bounding boxes overlap, half of them separated
  Hull32,          // W4: hull on hull, overlap 1 to 10 mm
  CapsuleHull,     // W5a: capsule on hull of 32 vertices, overlap 1 to 10 mm
  SphereHull,      // W5b: sphere on hull of 32 vertices, overlap 1 to 10 mm
  CapsuleCapsule,  // W5c: overlap 1 to 10 mm
  BoxFaceMoving,   // W6a: W1, and b moves by 0.2 mm and 0.5 mrad a step
  Hull32Moving,    // W6b: W4, and b moves as in W6a
  BoxMesh,         // W7a: box on the grid, 1 to 10 mm deep
  HullMesh,        // W7b: hull of 16 vertices on the grid, 1 to 10 mm deep
};

inline constexpr int kWorkloads = 11;
inline constexpr int kPairsPerWorkload = 1024;
/// Number of poses of a moving pair; passes run through them forwards and backwards.
inline constexpr int kSteps = 16;

constexpr bool is_moving(Workload workload) {
  return workload == Workload::BoxFaceMoving || workload == Workload::Hull32Moving;
}

struct Placement {
  Pose<double> a;
  Pose<double> b;
};

/// All pairs share one grid.
struct WorkloadPair {
  std::shared_ptr<const Shape<double>> a;
  std::shared_ptr<const Shape<double>> b;
  std::vector<Placement> steps;  // one, or kSteps if the pair moves
};

std::vector<WorkloadPair> make_workload(Workload workload, int count = kPairsPerWorkload);

}  // namespace contactscope::bench
