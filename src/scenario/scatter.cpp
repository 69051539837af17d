#include <cmath>
#include <random>

#include "core/random.h"
#include "scenario/readers.h"

namespace contactscope::scenario_file {
namespace {

constexpr int kMaxCopies = 20000;  // per shape

struct Scatter {
  Vec3d lower, upper;          // metres, bounds of the copies' origins
  std::array<int, 3> cells{};  // of a grid between them, one copy per cell; all 0: no grid
  int count = 0;               // copies
  int seed = 1;
  std::array<double, 2> scale = {1, 1};  // smallest and largest size
  bool turned = true;                    // each has a random rotation
};

std::array<int, 3> read_cells(const Value& value) {
  const std::vector<Value> numbers = value.array();
  if (numbers.size() != 3)
    value.fail("'cells' are three numbers, along x, y and z; write cells = [4, 1, 4]");
  std::array<int, 3> cells{};
  for (std::size_t i = 0; i < 3; ++i) cells[i] = numbers[i].integer();
  if (std::int64_t{cells[0]} * cells[1] * cells[2] > kMaxCopies)
    value.fail("'cells' make more than " + std::to_string(kMaxCopies) + " copies; lower them");
  return cells;
}

Scatter read_scatter(const Value& value) {
  const Value table = value.table({"scatter"});
  Scatter scatter;
  const auto count = table.find("count"), cells = table.find("cells");
  table.not_both("count", "cells");
  if (!count && !cells)
    table.fail("'scatter' has no number of copies; add count = 100, or cells = [10, 1, 10]");
  if (count) scatter.count = count->integer();
  if (cells) scatter.cells = read_cells(*cells);
  if (cells) scatter.count = scatter.cells[0] * scatter.cells[1] * scatter.cells[2];
  scatter.lower = table.require("lower").vector3();
  const Value upper = table.require("upper");
  scatter.upper = upper.vector3();
  if (!(scatter.lower.array() <= scatter.upper.array()).all())
    upper.fail("'upper' is below 'lower'; no coordinate of it may be smaller");
  table.read("seed", scatter.seed);
  if (const auto scale = table.find("scale")) {
    const std::vector<double> range = scale->numbers(2);
    if (range[0] > range[1])
      scale->fail("'scale' is the smallest and the largest factor; write scale = [0.5, 2]");
    scatter.scale = {range[0], range[1]};
  }
  table.read("turned", scatter.turned);
  return scatter;
}

/// Uniform over all rotations: a normalised point of the ball in four dimensions. Uses no function
/// that libraries round differently.
Quatd random_rotation(std::mt19937_64& engine) {
  for (;;) {
    const double w = uniform(engine, -1, 1), x = uniform(engine, -1, 1);
    const double y = uniform(engine, -1, 1), z = uniform(engine, -1, 1);
    const double length = std::sqrt(w * w + x * x + y * y + z * z);
    if (length > 0.1 && length <= 1) return Quatd(w / length, x / length, y / length, z / length);
  }
}

/// Small ones are frequent: as many between 1 and 2 as between 2 and infinity. Rational, for
/// portable rounding.
double random_size(std::mt19937_64& engine, const std::array<double, 2>& scale) {
  const auto [low, high] = scale;
  return low * high / uniform(engine, low, high);
}

/// Size, in metres, of a shape that can be scattered.
double radius_of(const Shape<double>& shape) {
  if (const auto* sphere = std::get_if<Sphere<double>>(&shape)) return sphere->radius;
  if (const auto* capsule = std::get_if<Capsule<double>>(&shape)) return capsule->radius;
  return std::get<Hull<double>>(shape).radius;
}

}  // namespace

std::vector<ScenarioShape> scattered(const ScenarioShape& model, const Value& value,
                                     const Value& table) {
  const Scatter scatter = read_scatter(value);
  if (const auto position = table.find("position"))
    position->fail("'scatter' places the copies; remove 'position'");
  if (const auto rotation = table.find("rotation"); rotation && scatter.turned)
    rotation->fail(
        "'scatter' rotates each copy; remove 'rotation', or add turned = false to 'scatter'");
  if (const auto motion = table.find("motion"); motion && motion->find("keyframes"))
    motion->fail("keyframes would move every copy of '" + model.name +
                 "' to the same places; give a velocity, or dynamic = true");
  if (kind_of(*model.geometry) == ShapeKind::Plane || kind_of(*model.geometry) == ShapeKind::Mesh)
    value.fail("spheres, capsules and hulls can be scattered, and '" + model.name + "' is a " +
               model.type + "; write each copy as its own shape");

  std::mt19937_64 engine(static_cast<std::uint64_t>(scatter.seed));
  std::vector<ScenarioShape> copies;
  for (int i = 0; i < scatter.count; ++i) {
    ScenarioShape copy = model;
    copy.name = model.name + "_" + std::to_string(i + 1);
    Vec3d share;  // fraction from `lower` to `upper`
    for (int axis = 0, rest = i; axis < 3; ++axis) {
      const int cells = scatter.cells[static_cast<std::size_t>(axis)];
      // In a grid a copy stays in the middle half of its cell.
      share[axis] =
          cells == 0 ? uniform(engine, 0, 1) : (rest % cells + uniform(engine, 0.25, 0.75)) / cells;
      if (cells > 0) rest /= cells;
    }
    copy.pose.position = scatter.lower + share.cwiseProduct(scatter.upper - scatter.lower);
    if (scatter.turned) copy.pose.rotation = random_rotation(engine);
    if (scatter.scale != std::array<double, 2>{1, 1}) {
      copy.geometry = std::make_shared<const Shape<double>>(
          scaled(*model.geometry, random_size(engine, scatter.scale)));
      const double radius = radius_of(*copy.geometry);
      if (!(radius >= kSmallestLength && radius <= kLargestLength))
        value.fail("'scale' makes a copy of '" + model.name +
                   "' smaller than 1e-9 metres or larger than 1e9; lower its range");
    }
    copies.push_back(std::move(copy));
  }
  return copies;
}

}  // namespace contactscope::scenario_file
