#include <cmath>

#include "study/limits_study.h"
#include "study/uniform.h"

namespace contactscope {
namespace {

constexpr double kOverlap = 0.01;
constexpr double kNear = 5;  // sizes from the origin

const std::vector<PairKind>& every_kind() {
  static const std::vector<PairKind> kinds = {
      {OnTop::Sphere, Below::Sphere},   {OnTop::Sphere, Below::Capsule},
      {OnTop::Capsule, Below::Capsule}, {OnTop::Sphere, Below::Box},
      {OnTop::Capsule, Below::Box},     {OnTop::Box, Below::Box},
      {OnTop::Sphere, Below::Plane},    {OnTop::Capsule, Below::Plane},
      {OnTop::Box, Below::Plane},       {OnTop::Sphere, Below::Mesh},
      {OnTop::Capsule, Below::Mesh},    {OnTop::Box, Below::Mesh}};
  return kinds;
}

}  // namespace

std::vector<double> LimitSweep::values() const {
  std::vector<double> list;
  const long first = std::lround(2 * std::log10(low));
  const long last = std::lround(2 * std::log10(high));
  for (long half = first; half <= last; ++half) {
    list.push_back(std::pow(10.0, 0.5 * static_cast<double>(half)));
  }
  return list;
}

const std::vector<LimitSweep>& limit_sweeps() {
  static const std::vector<LimitSweep> list = {
      {"tilt",
       "tilt (rad)",
       1e-9,
       1,
       {{OnTop::Box, Below::Box},
        {OnTop::Capsule, Below::Box},
        {OnTop::Box, Below::Plane},
        {OnTop::Capsule, Below::Plane},
        {OnTop::Box, Below::Mesh},
        {OnTop::Capsule, Below::Mesh}}},
      {"scale", "size (m)", 1e-6, 1e6, every_kind()},
      {"distance", "distance from the origin (m)", 0.1, 1e7, every_kind()},
      {"aspect",
       "aspect ratio",
       1,
       1e6,
       {{OnTop::Sphere, Below::Capsule},
        {OnTop::Capsule, Below::Capsule},
        {OnTop::Sphere, Below::Box},
        {OnTop::Capsule, Below::Box},
        {OnTop::Box, Below::Box},
        {OnTop::Sphere, Below::Mesh},
        {OnTop::Capsule, Below::Mesh},
        {OnTop::Box, Below::Mesh}}},
      {"angle",
       "angle between edges (rad)",
       1e-12,
       0.1,
       {{OnTop::Box, Below::Box}, {OnTop::Capsule, Below::Capsule}, {OnTop::Capsule, Below::Box}}},
      {"kiss", "overlap, 1 = coincident", 1e-9, 1, every_kind()},
  };
  return list;
}

LimitCase limit_case(const LimitSweep& sweep, double value, const PairKind& kind, int index,
                     std::uint64_t seed) {
  Stacking stacking;
  stacking.overlap = kOverlap;
  double distance = kNear;
  if (sweep.name == "tilt") {
    stacking.tilt = value;
  } else if (sweep.name == "scale") {
    stacking.size = value;
    distance = kNear * value;
  } else if (sweep.name == "distance") {
    distance = value;
  } else if (sweep.name == "aspect") {
    stacking.aspect = value;
  } else if (sweep.name == "angle") {
    stacking.crossed = true;
    stacking.angle = value;
    if (index % 2 == 0) stacking.overlap = kOverlap * std::min(1.0, 10 * value);
  } else {
    stacking.overlap = value;
  }
  std::mt19937_64 engine = case_engine(seed, index, value, 1);
  return {stacked_pair(kind, stacking, index, engine), world_motion(distance, engine)};
}

std::mt19937_64 case_engine(std::uint64_t seed, int index, double one, double other) {
  const auto step = [](double value) {
    return static_cast<std::uint64_t>(std::llround(1000 * std::log10(value)) + 100000);
  };
  std::seed_seq mixed{seed, static_cast<std::uint64_t>(index), step(one), step(other)};
  return std::mt19937_64(mixed);
}

Pose<double> world_motion(double distance, std::mt19937_64& engine) {
  Pose<double> motion;
  motion.rotation = uniform_rotation(engine);
  motion.position = uniform_rotation(engine) * Vec3d(distance, 0, 0);
  return motion;
}

}  // namespace contactscope
