#include "study/solver_stack.h"

#include "geometry/primitives.h"
#include "study/random_cases.h"
#include "study/study.h"

namespace contactscope {
namespace {

constexpr double kHalf = 0.5;      // metres, half a box's edge
constexpr double kGravity = 9.81;  // metres per second squared
constexpr float kFrame = 1.0f / 60;
constexpr int kRestFrames = 60;  // the last frames, used to judge rest

Vec3d static_place(const StackPlan& plan, std::size_t box) {
  const auto level = static_cast<double>(box);
  return {plan.boxes[box].x, kHalf + level * 2 * kHalf - (level + 1) * kStackSlop,
          plan.boxes[box].z};
}

/// A stack that is stepped and judged.
class StandingStack {
 public:
  StandingStack(const StackPlan& plan, const SolverSettings& settings,
                std::optional<int> max_points, bool contacts_alone)
      : plan_(plan), settings_(settings), contacts_alone_(contacts_alone) {
    settings_.slop = kStackSlop;
    settings_.speculative_margin = kStackMargin;
    if (max_points) {
      world_.contacts.reducer = find_reducer(kDefaultReducer);
      world_.contacts.reduction.max_points = *max_points;
    }
    shapes_.push_back(HalfSpace<float>{{Vec3<float>::UnitY(), 0}});
    world_.bodies.push_back(static_body<float>({}));
    const Shape<double> box = make_box(Vec3d::Constant(kHalf));
    double mass = 0;
    for (std::size_t i = 0; i < plan.boxes.size(); ++i) {
      const Quatd turn(Eigen::AngleAxisd(plan.boxes[i].turn, Vec3d::UnitY()));
      const Pose<double> pose{turn, static_place(plan, i)};
      shapes_.push_back(shape_cast<float>(box));
      world_.bodies.push_back(dynamic_body<float>(
          pose.cast<float>(), with_mass(*mass_properties(box), plan.boxes[i].mass)));
      // Only neighbours: before others touch, a box has sunk too far into the next.
      WorldPair<float>& pair = world_.pairs.emplace_back();
      pair.a = static_cast<int>(i);
      pair.b = static_cast<int>(i + 1);
      mass += plan.boxes[i].mass;
    }
    // Any overlap from 0 to the slop is at rest, so a stack may stand higher by that much.
    most_energy_ = energy();
    for (std::size_t i = 0; i < plan.boxes.size(); ++i) {
      const double lifted = static_cast<double>(i + 1) * kStackSlop;
      most_energy_ += plan.boxes[i].mass * kGravity * lifted;
    }
    const double fall = kGravity * static_cast<double>(kFrame);  // m/s in one frame
    most_energy_ += 0.5 * mass * fall * fall;
  }

  StackOutcome run(int frames) {
    StackOutcome outcome;
    PassTimes times, others;
    const int rest_begins = std::max(1, frames - kRestFrames);
    for (; outcome.frames < frames; ++outcome.frames) {
      World<float> copy = contacts_alone_ ? world_ : World<float>();
      if (contacts_alone_)
        times.measure(1, [&](int) {
          find_contacts(copy, shapes_, settings_, contacts_, kFrame);
          return static_cast<double>(contacts_.size());
        });
      (contacts_alone_ ? others : times).measure(1, [&](int) {
        step(world_, shapes_, settings_, kFrame, contacts_);
        note_ids();
        return static_cast<double>(world_.bodies.back().center.y());
      });
      outcome.fault = fault();
      if (outcome.fault != StackFault::None) break;
      outcome.worst_penetration = std::max(outcome.worst_penetration, penetration());
      if (outcome.frames < rest_begins) continue;
      const double frames_at_rest = frames - rest_begins;
      outcome.jitter += fastest() / frames_at_rest;
      outcome.load_error += load_error() / frames_at_rest;
      outcome.ids_changed += ids_changed_ / frames_at_rest;
    }
    // Contacts are from the start of a frame; find them again for the end of the last.
    find_contacts(world_, shapes_, settings_, contacts_);
    if (outcome.fault == StackFault::None) {
      outcome.penetration = penetration();
      outcome.worst_penetration = std::max(outcome.worst_penetration, outcome.penetration);
      const Vec3d place = static_place(plan_, plan_.boxes.size() - 1);
      outcome.drift = Vec3d(world_.bodies.back().center.cast<double>() - place).norm();
    }
    outcome.nanoseconds = times.summary().median;
    return outcome;
  }

 private:
  void note_ids() {
    int changed = 0, all = 0;
    ids_.resize(world_.pairs.size());
    for (std::size_t i = 0; i < world_.pairs.size(); ++i) {
      std::vector<FeatureId> now;
      for (const Manifold<float>& manifold : contacts_[i])
        for (const ContactPoint<float>& point : manifold.points) now.push_back(point.id);
      for (const FeatureId& id : now) changed += std::ranges::count(ids_[i], id) == 0 ? 1 : 0;
      all += count_of(now);
      ids_[i] = std::move(now);
    }
    ids_changed_ = all == 0 ? 0 : static_cast<double>(changed) / all;
  }

  StackFault fault() const {
    for (const Body<float>& body : world_.bodies)
      if (!body.center.allFinite() || !body.velocity.allFinite() ||
          !body.angular_velocity.allFinite() || !body.rotation.coeffs().allFinite())
        return StackFault::NotFinite;
    if (energy() > most_energy_) return StackFault::Energy;
    for (std::size_t i = 1; i < world_.bodies.size(); ++i) {
      const Vec3d here = world_.bodies[i].center.cast<double>();
      // The lowest box counts as standing on another one below the plane.
      const Vec3d above = i > 1 ? Vec3d(here - world_.bodies[i - 1].center.cast<double>())
                                : Vec3d(0, here.y() + kHalf, 0);
      if (std::abs(above.y() - 2 * kHalf) > kHalf || std::hypot(above.x(), above.z()) > kHalf)
        return StackFault::Fallen;
    }
    return StackFault::None;
  }

  double energy() const {
    double sum = 0;
    for (const Body<float>& body : world_.bodies)
      sum += kinetic_energy(body) + potential_energy(body, Vec3d(0, -kGravity, 0));
    return sum;
  }

  double penetration() const {
    double deepest = 0;
    for (const Manifolds<float>& manifolds : contacts_)
      for (const Manifold<float>& manifold : manifolds)
        for (const ContactPoint<float>& point : manifold.points)
          deepest = std::max(deepest, -static_cast<double>(point.separation) - kStackSlop);
    return deepest;
  }

  double fastest() const {
    const double to_corner = kHalf * std::sqrt(3.0);
    double most = 0;
    for (const Body<float>& body : world_.bodies) {
      const double turning = static_cast<double>(body.angular_velocity.norm());
      most = std::max(most, static_cast<double>(body.velocity.norm()) + to_corner * turning);
    }
    return most;
  }

  double load_error() const {
    double worst = 0;
    for (std::size_t i = 0; i < world_.pairs.size(); ++i) {
      double impulse = 0;
      for (const PointImpulse<float>& point : world_.impulses[i])
        impulse += static_cast<double>(point.total_normal);
      double mass = 0;  // of the boxes above
      for (std::size_t k = i; k < plan_.boxes.size(); ++k) mass += plan_.boxes[k].mass;
      const double weight = mass * kGravity;
      worst = std::max(worst, std::abs(impulse / static_cast<double>(kFrame) - weight) / weight);
    }
    return worst;
  }

  const StackPlan& plan_;
  SolverSettings settings_;
  bool contacts_alone_;
  World<float> world_;
  std::vector<Shape<float>> shapes_;
  std::vector<Manifolds<float>> contacts_;
  std::vector<std::vector<FeatureId>> ids_;  // of the previous frame
  double ids_changed_ = 0;
  double most_energy_ = 0;  // joules; a higher energy is an error
};

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
    lift += masses[i] * kGravity * sunk;
  }
  return on_floor(name, parts, {.lift = lift});
}

EnergyScene bullet(const char* name, double restitution, ImpactMethod method) {
  std::vector<ScenePart> parts = {ball(0.04, {-0.85, 0, 0}, 1, {100, 0, 0})};
  for (const double x : {0.0, 0.2, 0.4}) parts.push_back(box({0.015, 0.25, 0.25}, {x, 0, 0}, 4));
  return weightless(name, parts, {.restitution = restitution, .frames = 40, .method = method});
}

}  // namespace

StackPlan stack_plan(std::mt19937_64& engine, int count, double ratio) {
  constexpr double kAside = 0.02 * 2 * kHalf;
  StackPlan plan;
  for (int i = 0; i < count; ++i) {
    StackPlan::Box box;
    box.x = uniform(engine, -kAside, kAside);
    box.z = uniform(engine, -kAside, kAside);
    box.turn = uniform(engine, -0.1, 0.1);
    plan.boxes.push_back(box);
  }
  plan.boxes.back().mass = ratio;
  return plan;
}

StackOutcome run_stack(const StackPlan& plan, SolverSettings settings, int frames,
                       std::optional<int> max_points, bool contacts_alone) {
  return StandingStack(plan, settings, max_points, contacts_alone).run(frames);
}

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
      on_floor("deep box", {cube(0.1, 1)}, {.lift = kGravity * 0.4}),
      on_floor("deep brick", {box(brick, {0, 0.1, 0}, 1, 0.7)}, {.lift = kGravity * 0.5}),
      on_floor("deep on a box", {cube(0.5, 1), cube(1.1, 1)}, {.lift = kGravity * 0.4}),
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
