#include "study/solver_energy.h"

#include <algorithm>

#include "core/at.h"
#include "geometry/primitives.h"

namespace contactscope {
namespace {

constexpr double kPull = 9.81;  // metres per second squared
constexpr double kStep = 1.0 / 60;

/// A body of a scene; of mass 0: it does not move.
struct ScenePart {
  Shape<double> shape;
  Pose<double> pose{};
  double mass = 0;
  Vec3d velocity = Vec3d::Zero();
};

ScenePart ball(double radius, const Vec3d& at, double mass, const Vec3d& velocity = Vec3d::Zero()) {
  return {Sphere<double>{radius}, {Quatd::Identity(), at}, mass, velocity};
}
ScenePart box(const Vec3d& half, const Vec3d& at, double mass, double tilt = 0,
              const Vec3d& velocity = Vec3d::Zero()) {
  const Quatd turn(Eigen::AngleAxisd(tilt, Vec3d(1, 2, 3).normalized()));
  return {make_box(half), {turn, at}, mass, velocity};
}
ScenePart cube(double height, double mass, double x = 0) {
  return box({0.5, 0.5, 0.5}, {x, height, 0}, mass);
}

struct SceneSetting {
  double restitution = 0;
  double lift = 0;  // joules, see EnergyScene
  int frames = 120;
  std::optional<ImpactMethod> method{};
};

EnergyScene weightless(const char* name, const std::vector<ScenePart>& parts,
                       const SceneSetting& setting = {}) {
  EnergyScene scene;
  scene.name = name;
  scene.frames = setting.frames;
  scene.lift = setting.lift;
  World<double>& world = scene.world;
  world.gravity.setZero();
  for (const ScenePart& part : parts) {
    scene.shapes.push_back(part.shape);
    world.bodies.push_back(
        part.mass > 0
            ? dynamic_body<double>(part.pose, with_mass(*mass_properties(part.shape), part.mass))
            : static_body<double>(part.pose));
    world.bodies.back().velocity = part.velocity;
  }
  for (int a = 0; a < count_of(parts); ++a)
    for (int b = a + 1; b < count_of(parts); ++b)
      if (at(parts, a).mass > 0 || at(parts, b).mass > 0) {
        world.pairs.push_back({a, b, 0.6, setting.restitution});
        world.pairs.back().continuous = setting.method;
      }
  return scene;
}

EnergyScene on_floor(const char* name, std::vector<ScenePart> parts,
                     const SceneSetting& setting = {}) {
  parts.insert(parts.begin(), ScenePart{HalfSpace<double>{{Vec3d::UnitY(), 0}}});
  EnergyScene scene = weightless(name, parts, setting);
  scene.world.gravity = World<double>().gravity;
  return scene;
}

EnergyScene stack(const char* name, const std::vector<double>& masses, double overlap = 0) {
  std::vector<ScenePart> parts;
  double lift = 0;
  for (std::size_t i = 0; i < masses.size(); ++i) {
    const double level = static_cast<double>(i), sunk = (level + 1) * overlap;
    parts.push_back(cube(0.5 + level - sunk, masses[i]));
    lift += masses[i] * kPull * sunk;
  }
  return on_floor(name, parts, {.lift = lift});
}

EnergyScene bullet(const char* name, double restitution, ImpactMethod method) {
  std::vector<ScenePart> parts = {ball(0.04, {-0.85, 0, 0}, 1, {100, 0, 0})};
  for (const double x : {0.0, 0.2, 0.4}) parts.push_back(box({0.015, 0.25, 0.25}, {x, 0, 0}, 4));
  return weightless(name, parts, {.restitution = restitution, .frames = 40, .method = method});
}

}  // namespace

std::vector<EnergyScene> energy_scenes() {
  const Vec3d brick(0.5, 0.3, 0.2), half(0.5, 0.5, 0.5);
  const SceneSetting elastic{.restitution = 1};
  return {
      on_floor("ball from 2 m", {ball(0.5, {0, 2.5, 0}, 1)}),
      on_floor("elastic ball", {ball(0.5, {0, 2.5, 0}, 1)}, elastic),
      on_floor("ball from 20 m", {ball(0.5, {0, 20.5, 0}, 1)}, {.frames = 180}),
      on_floor("small ball", {ball(0.05, {0, 2.05, 0}, 1)}),
      on_floor("brick from 2 m", {box(brick, {0, 2.5, 0}, 1, 0.7)}),
      on_floor("lively brick", {box(brick, {0, 2.5, 0}, 1, 0.7)}, {.restitution = 0.8}),
      on_floor("elastic box", {cube(2.5, 1)}, elastic),
      on_floor("deep box", {cube(0.1, 1)}, {.lift = kPull * 0.4}),
      on_floor("deep brick", {box(brick, {0, 0.1, 0}, 1, 0.7)}, {.lift = kPull * 0.5}),
      on_floor("deep on a box", {cube(0.5, 1), cube(1.1, 1)}, {.lift = kPull * 0.4}),
      on_floor("deep side by side", {cube(0.5, 1), cube(0.5, 1, 0.6)}),
      weightless("deep and weightless", {box(half, {0, 0, 0}, 1, 0, {0, 2, 0.5}),
                                         box(half, {0.6, 0.1, 0}, 1, 0.1, {0, -2, 0})}),
      stack("five deep boxes", {1, 1, 1, 1, 1}, 0.1),
      stack("ten boxes", std::vector<double>(10, 1)),
      on_floor("ball at a stack",
               {cube(0.5, 1), cube(1.5, 1), cube(2.5, 1), ball(0.3, {-3, 1.6, 0}, 2, {12, 1, 0})}),
      stack("a hundred on one", {1, 100}),
      stack("one on a hundred", {100, 1, 1}),
      weightless("light against heavy",
                 {ball(0.3, {-1, 0, 0}, 1, {10, 0, 0}), box(half, {0.5, 0.2, 0.1}, 100, 0.4)},
                 elastic),
      bullet("bullet at plates", 0, ImpactMethod::TimeOfImpact),
      bullet("speculative bullet", 1, ImpactMethod::Speculative),
  };
}

double energy_gained(EnergyScene scene, const SolverSettings& settings) {
  const Vec3d half_step = kStep / settings.substeps / 2 * scene.world.gravity;
  const auto energy = [&] {
    double sum = 0;
    for (Body<double> body : scene.world.bodies) {
      if (body.dynamic()) body.velocity += half_step;
      sum += kinetic_energy(body) + potential_energy(body, scene.world.gravity);
    }
    return sum;
  };
  const double allowed = energy() + scene.lift;
  double most = 0;
  std::vector<Manifolds<double>> contacts;
  for (int frame = 0; frame < scene.frames; ++frame) {
    step(scene.world, scene.shapes, settings, kStep, contacts);
    most = std::max(most, energy());
  }
  return most / allowed - 1;
}

}  // namespace contactscope
