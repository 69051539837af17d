#include "study/solver_energy.h"

#include <algorithm>

#include "core/at.h"
#include "geometry/primitives.h"

namespace contactscope {
namespace {

constexpr double kPull = 9.81;  // metres per second squared
constexpr double kStep = 1.0 / 60;

class SceneBuilder {
 public:
  explicit SceneBuilder(std::string name, double restitution = 0) : restitution_(restitution) {
    scene_.name = std::move(name);
  }
  SceneBuilder& floor() { return add(HalfSpace<double>{{Vec3d::UnitY(), 0}}, {}, 0); }
  SceneBuilder& ball(double r, const Vec3d& at, double mass, const Vec3d& velocity = {0, 0, 0}) {
    return add(Sphere<double>{r}, {Quatd::Identity(), at}, mass, velocity);
  }
  SceneBuilder& box(const Vec3d& half, const Vec3d& at, double mass, double tilt = 0,
                    const Vec3d& velocity = {0, 0, 0}) {
    const Quatd turn(Eigen::AngleAxisd(tilt, Vec3d(1, 2, 3).normalized()));
    return add(make_box(half), {turn, at}, mass, velocity);
  }
  SceneBuilder& cube(double height, double mass, double x = 0) {
    return box({0.5, 0.5, 0.5}, {x, height, 0}, mass);
  }
  SceneBuilder& weightless() {
    scene_.world.gravity.setZero();
    return *this;
  }
  SceneBuilder& continuous(ImpactMethod method) {
    method_ = method;
    return *this;
  }
  SceneBuilder& lifted_by(double joules) {
    scene_.lift = joules;
    return *this;
  }
  EnergyScene made(int frames = 120) {
    World<double>& world = scene_.world;
    scene_.frames = frames;
    for (int a = 0; a < count_of(world.bodies); ++a)
      for (int b = a + 1; b < count_of(world.bodies); ++b)
        if (at(world.bodies, a).dynamic() || at(world.bodies, b).dynamic()) {
          world.pairs.push_back({a, b, 0.6, restitution_});
          world.pairs.back().continuous = method_;
        }
    return scene_;
  }

 private:
  SceneBuilder& add(const Shape<double>& shape, const Pose<double>& pose, double mass,
                    const Vec3d& velocity = {0, 0, 0}) {
    scene_.shapes.push_back(shape);
    scene_.world.bodies.push_back(
        mass > 0 ? dynamic_body<double>(pose, with_mass(*mass_properties(shape), mass))
                 : static_body<double>(pose));
    scene_.world.bodies.back().velocity = velocity;
    return *this;
  }

  EnergyScene scene_;
  double restitution_;
  std::optional<ImpactMethod> method_{};
};

EnergyScene stack(const char* name, const std::vector<double>& masses, double overlap = 0) {
  SceneBuilder builder(name);
  builder.floor();
  double lift = 0;
  for (std::size_t i = 0; i < masses.size(); ++i) {
    const double level = static_cast<double>(i), sunk = (level + 1) * overlap;
    builder.cube(0.5 + level - sunk, masses[i]);
    lift += masses[i] * kPull * sunk;
  }
  return builder.lifted_by(lift).made();
}

EnergyScene bullet(const char* name, double restitution, std::optional<ImpactMethod> method) {
  SceneBuilder builder(name, restitution);
  builder.weightless().ball(0.04, {-0.85, 0, 0}, 1, {100, 0, 0});
  for (const double x : {0.0, 0.2, 0.4}) builder.box({0.015, 0.25, 0.25}, {x, 0, 0}, 4);
  if (method) builder.continuous(*method);
  return builder.made(40);
}

}  // namespace

std::vector<EnergyScene> energy_scenes() {
  const Vec3d brick(0.5, 0.3, 0.2);
  std::vector<EnergyScene> scenes;
  scenes.push_back(SceneBuilder("ball from 2 m").floor().ball(0.5, {0, 2.5, 0}, 1).made());
  scenes.push_back(SceneBuilder("elastic ball", 1).floor().ball(0.5, {0, 2.5, 0}, 1).made());
  scenes.push_back(SceneBuilder("ball from 20 m").floor().ball(0.5, {0, 20.5, 0}, 1).made(180));
  scenes.push_back(SceneBuilder("small ball").floor().ball(0.05, {0, 2.05, 0}, 1).made());
  scenes.push_back(SceneBuilder("brick from 2 m").floor().box(brick, {0, 2.5, 0}, 1, 0.7).made());
  scenes.push_back(
      SceneBuilder("lively brick", 0.8).floor().box(brick, {0, 2.5, 0}, 1, 0.7).made());
  scenes.push_back(SceneBuilder("elastic box", 1).floor().cube(2.5, 1).made());
  scenes.push_back(SceneBuilder("deep box").floor().cube(0.1, 1).lifted_by(kPull * 0.4).made());
  scenes.push_back(SceneBuilder("deep brick")
                       .floor()
                       .box(brick, {0, 0.1, 0}, 1, 0.7)
                       .lifted_by(kPull * 0.5)
                       .made());
  scenes.push_back(SceneBuilder("deep on a box")
                       .floor()
                       .cube(0.5, 1)
                       .cube(1.1, 1)
                       .lifted_by(kPull * 0.4)
                       .made());
  scenes.push_back(SceneBuilder("deep side by side").floor().cube(0.5, 1).cube(0.5, 1, 0.6).made());
  scenes.push_back(SceneBuilder("deep and weightless")
                       .weightless()
                       .box({0.5, 0.5, 0.5}, {0, 0, 0}, 1, 0, {0, 2, 0.5})
                       .box({0.5, 0.5, 0.5}, {0.6, 0.1, 0}, 1, 0.1, {0, -2, 0})
                       .made());
  scenes.push_back(stack("five deep boxes", {1, 1, 1, 1, 1}, 0.1));
  scenes.push_back(stack("ten boxes", std::vector<double>(10, 1)));
  scenes.push_back(SceneBuilder("ball at a stack")
                       .floor()
                       .cube(0.5, 1)
                       .cube(1.5, 1)
                       .cube(2.5, 1)
                       .ball(0.3, {-3, 1.6, 0}, 2, {12, 1, 0})
                       .made());
  scenes.push_back(stack("a hundred on one", {1, 100}));
  scenes.push_back(stack("one on a hundred", {100, 1, 1}));
  scenes.push_back(SceneBuilder("light against heavy", 1)
                       .weightless()
                       .ball(0.3, {-1, 0, 0}, 1, {10, 0, 0})
                       .box({0.5, 0.5, 0.5}, {0.5, 0.2, 0.1}, 100, 0.4)
                       .made());
  scenes.push_back(bullet("bullet at plates", 0, ImpactMethod::TimeOfImpact));
  scenes.push_back(bullet("speculative bullet", 1, ImpactMethod::Speculative));
  return scenes;
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
