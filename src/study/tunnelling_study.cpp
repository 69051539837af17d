#include "continuous/impact_of_shapes.h"
#include "geometry/primitives.h"
#include "query/gjk.h"
#include "study/impact_cases.h"
#include "study/random_cases.h"

namespace contactscope {
namespace {

constexpr int kBullets = 200;
constexpr int kBulletRepetitions = 3;
constexpr double kStepTime = 1.0 / 60;                                     // seconds per step
const std::vector<double> kSpeeds = {5, 10, 20, 60, 100, 200, 500, 1000};  // m/s
const std::vector<double> kThicknesses = {1, 3, 10, 30, 100, 300};         // mm
constexpr double kUsualThickness = 10, kUsualSpeed = 20;
constexpr float kMargin = 0.02F;  // metres, of speculative contacts; as in engines

enum class BulletKind { Sphere, Box, Rod };
constexpr std::array<const char*, 3> kBulletNames = {"spheres", "boxes", "spinning rods"};

const Vec3f kBulletCentre = Vec3f::Zero();

/// A bullet and its target wall, step by step.
struct Flight {
  Shape<float> bullet;
  SupportSet<float> core;  // of the bullet
  float radius = 0;        // of the bullet around its core
  float reach = 0;         // radius of a ball around the bullet
  Shape<float> wall;
  Sweep<float> motion;  // in the first step
  int steps = 1;        // until it is certainly beyond the wall

  Flight(BulletKind kind, double speed, double millimetres, std::mt19937_64& engine);
  Flight& operator=(Flight&&) = delete;

  Sweep<float> step(int i) const {
    Sweep<float> now = motion;
    now.start = motion.at(static_cast<float>(i));
    return now;
  }
  /// Metres; 0 if they touch or overlap.
  float distance(const Pose<float>& bullet_pose) const {
    const Pose<float> wall_in_bullet = relative_pose(bullet_pose, Pose<float>());
    const GjkResult<float> found =
        gjk(core, support_set(std::get<Hull<float>>(wall)), wall_in_bullet);
    return found.status == GjkStatus::Separated ? std::max(found.distance - radius, 0.0F) : 0.0F;
  }
};

Flight::Flight(BulletKind kind, double speed, double millimetres, std::mt19937_64& engine) {
  constexpr double kRod = 0.3, kRodRadius = 0.01, kBall = 0.05, kWallSide = 5;
  const Vec3d half(0.05, 0.04, 0.03);
  constexpr auto kEnd = static_cast<float>(kRod);
  switch (kind) {
    case BulletKind::Sphere:
      bullet = Sphere<float>{static_cast<float>(kBall)};
      core = support_set(kBulletCentre);
      radius = reach = static_cast<float>(kBall);
      break;
    case BulletKind::Box:
      bullet = shape_cast<float>(Shape<double>(make_box(half)));
      core = support_set(std::get<Hull<float>>(bullet));
      reach = static_cast<float>(half.norm());
      break;
    case BulletKind::Rod:
      radius = static_cast<float>(kRodRadius);
      bullet = Capsule<float>{{Vec3f(-kEnd, 0, 0), Vec3f(kEnd, 0, 0)}, radius};
      core = {std::get<Capsule<float>>(bullet).points.data(), 2, nullptr};
      reach = static_cast<float>(kRod + kRodRadius);
  }
  wall =
      shape_cast<float>(Shape<double>(make_box(Vec3d(0.5e-3 * millimetres, kWallSide, kWallSide))));
  const double offset = speed * kStepTime;
  // It meets the wall at a random time of its step.
  const double before = static_cast<double>(reach) + 0.5e-3 * millimetres + 0.01;
  const double start = -before - offset * uniform(engine, 0, 1);
  motion.start.rotation = uniform_rotation(engine).cast<float>();
  const double up = uniform(engine, -1, 1), aside = uniform(engine, -1, 1);
  motion.start.position = Vec3d(start, up, aside).cast<float>();
  motion.displacement = Vec3f(static_cast<float>(offset), 0, 0);
  const double spin = uniform(engine, 0, std::numbers::pi);
  if (kind == BulletKind::Rod)
    motion.turn = (spin * (uniform_rotation(engine) * Vec3d::UnitX())).cast<float>();
  steps = static_cast<int>(std::ceil((before - start) / offset));
}

/// Metres from the wall when the method stops it; empty if it passes.
using Stopped = std::optional<float>;

struct StopMethod {
  const char* name;
  Stopped (*stops)(const Flight& flight);
};

/// Tests the end of each step. An overlapping bullet is pushed out to the side of its centre.
Stopped by_overlaps(const Flight& flight, float margin) {
  for (int i = 0; i < flight.steps; ++i) {
    const Sweep<float> now = flight.step(i);
    // A speculative contact stops bullets that start the step within the margin.
    if (margin > 0) {
      const float distance = flight.distance(now.start);
      const bool is_before = now.start.position.x() < 0;
      if (distance <= margin && is_before) return distance;
    }
    const Pose<float> end = now.at(1);
    if (flight.distance(end) > 0) continue;
    return end.position.x() < 0 ? Stopped(0.0F) : std::nullopt;
  }
  return std::nullopt;
}

Stopped by_impact(const Flight& flight, const Shape<float>& swept, ImpactMethod method) {
  for (int i = 0; i < flight.steps; ++i) {
    const Sweep<float> now = flight.step(i);
    const ShapeImpact<float> found = impact_of_shapes(swept, now, flight.wall, {}, method);
    if (found.result.status == ImpactStatus::Separated) continue;
    return flight.distance(now.at(found.result.time));
  }
  return std::nullopt;
}

template <ImpactMethod method> Stopped by_impact_of_shape(const Flight& flight) {
  return by_impact(flight, flight.bullet, method);
}

constexpr StopMethod kStopMethods[] = {
    {"discrete", [](const Flight& flight) { return by_overlaps(flight, 0); }},
    {"speculative margin of 2 cm",
     [](const Flight& flight) { return by_overlaps(flight, kMargin); }},
    {"swept bounding sphere",
     [](const Flight& flight) {
       return by_impact(flight, Sphere<float>{flight.reach}, ImpactMethod::TimeOfImpact);
     }},
    {"conservative advancement", by_impact_of_shape<ImpactMethod::ConservativeAdvancement>},
    {"time of impact", by_impact_of_shape<ImpactMethod::TimeOfImpact>},
};

using Flights = std::vector<std::unique_ptr<Flight>>;

Measurement measured(const StopMethod& method, const Flights& flights, int repetitions) {
  Measurement result(2, count_of(flights));
  for (const auto& flight : flights) {
    const Stopped stopped = method.stops(*flight);
    result.errors[0].add(stopped ? 0 : 1);
    if (stopped) result.errors[1].add(static_cast<double>(*stopped));
  }
  result.times.measure(repetitions, count_of(flights), [&](int k) {
    return static_cast<double>(method.stops(*at(flights, k)).value_or(1.0F));
  });
  return result;
}

constexpr int kImpactCases = 200;
constexpr int kImpactRepetitions = 5;
constexpr int kImpactVertices = 32;
constexpr double kFullTurn = 2;  // radians per step, for rotating cases

/// Baseline without continuous detection: tests evenly spaced poses of the step for overlap.
class SampledOverlap : public ImpactFinder {
 public:
  SampledOverlap(std::span<const ImpactCase> cases, int samples)
      : cases_(cases), samples_(samples) {}

  FoundImpact find(int index) override {
    const ImpactCase& of = at(cases_, index);
    const SupportSet<float> a = support_set(of.a), b = support_set(of.b);
    for (int i = 1; i <= samples_; ++i) {
      const float time = static_cast<float>(i) / static_cast<float>(samples_);
      const Pose<float> b_in_a = relative_pose(of.of_a.at(time), of.of_b.at(time));
      if (gjk(a, b, b_in_a).status != GjkStatus::Separated)
        return {true, static_cast<double>(time)};
    }
    return {};
  }

 private:
  std::span<const ImpactCase> cases_;
  int samples_;
};

ImpactFinderInfo sampled(int samples) {
  return {std::to_string(samples) + " samples", true, [samples](std::span<const ImpactCase> cases) {
            return std::make_unique<SampledOverlap>(cases, samples);
          }};
}

/// Cases with the same kind of motion, by one of its numbers.
struct ImpactPanel {
  const char* name;
  const char* parameter;
  std::vector<double> values;
  ImpactMotion motion;
  double ImpactMotion::*drives;
};

/// Measures in the order of the study: error, and share of missed pairs.
Measurement measured(ImpactFinder& finder, std::span<const ImpactCase> cases, int repetitions) {
  Measurement result(2, count_of(cases));
  const ImpactTally tally = judge_impacts(finder, cases);
  for (const double error : tally.errors) result.errors[0].add(error);
  result.failed = tally.missed;
  for (int i = 0; i < tally.of; ++i) result.errors[1].add(i < tally.missed ? 1 : 0);
  result.times.measure(repetitions, tally.of, [&](int k) { return finder.find(k).time; });
  return result;
}

}  // namespace

/// Bullets of about 10 cm that fly straight at a wall at 60 steps per second: share that passes, by
/// speed and by wall thickness, and distance of the others when stopped. Rods are 60 cm long and
/// turn by up to half a turn per step. The discrete test checks the end of each step, and pushes a
/// bullet out behind the wall if its centre is beyond it.
std::vector<trace::Study> study_tunnelling(const StudyOptions& options,
                                           const StudyProgress& progress) {
  const int count = options.cases.value_or(kBullets);
  std::vector<trace::Study> results = results_of(
      "tunnelling", "float", "m/s",
      "where the bullet is beyond the wall, " + std::to_string(count) +
          " bullets a point, 60 steps a second" + options.seeded(),
      {{"passed", "Bullets that pass a wall: none that is swept", "share of the bullets", "",
        0.5 / count},
       {"early", "How far from the wall a bullet is stopped", "distance when stopped", "m", 1e-6}},
      trace::StudyForm::Curves);
  const StudyStep report = counted(progress, 2 * static_cast<int>(kBulletNames.size()));
  for (const bool by_speed : {true, false})
    for (const BulletKind kind : {BulletKind::Sphere, BulletKind::Box, BulletKind::Rod}) {
      const std::string panel = at(kBulletNames, static_cast<int>(kind)) +
                                std::string(by_speed ? ", a wall of 1 cm" : ", at 20 m/s");
      report(panel);
      const StudyLines lines(results, kStopMethods, panel,
                             panel + (by_speed ? ": m/s" : ": wall in mm"));
      for (const double value : by_speed ? kSpeeds : kThicknesses) {
        const double speed = by_speed ? value : kUsualSpeed;
        const double millimetres = by_speed ? kUsualThickness : value;
        Flights flights;
        for (int i = 0; i < count; ++i) {
          std::mt19937_64 engine = case_engine(options.seed, i, speed, millimetres);
          flights.push_back(std::make_unique<Flight>(kind, speed, millimetres, engine));
        }
        for (std::size_t m = 0; m < std::size(kStopMethods); ++m)
          lines.add(
              m, value,
              measured(kStopMethods[m], flights, options.repetitions.value_or(kBulletRepetitions)));
      }
    }
  finish_share(results[0]);
  return results;
}

std::vector<trace::Study> study_impact_finders(const std::vector<ImpactFinderInfo>& finders,
                                               const StudyOptions& options,
                                               const StudyProgress& progress) {
  const ImpactPanel panels[] = {
      {"translating", "metres in the step", {1, 3, 10, 100}, {}, &ImpactMotion::offset},
      {"rotating",
       "metres in the step",
       {1, 3, 10, 100},
       {.turn = kFullTurn},
       &ImpactMotion::offset},
      {"far from the origin",
       "metres away",
       {1, 10, 100, 1000, 10'000, 100'000},
       {.turn = kFullTurn},
       &ImpactMotion::origin}};
  const int count = options.cases.value_or(kImpactCases);
  std::vector<trace::Study> results =
      results_of("time_of_impact", "float and double", "metres in the step",
                 "steps as long as the largest separation allows, in double, " +
                     std::to_string(count) + " pairs of hulls of " +
                     std::to_string(kImpactVertices) + " vertices a point" + options.seeded(),
                 {{"error", "How far off the time of impact is", "fraction of the step", "", 1e-7},
                  {"missed", "How many hits are missed", "share of the pairs", "", 0.5 / count}});
  results[1].form = trace::StudyForm::Curves;
  std::size_t steps = 0;
  for (const ImpactPanel& panel : panels) steps += panel.values.size();
  const StudyStep report = counted(progress, static_cast<int>(steps));
  Workers workers(options.thread_count());
  for (const ImpactPanel& panel : panels) {
    const std::string axis = std::string(panel.name) + ", " + panel.parameter;
    const StudyLines lines(results, finders, panel.name, axis);
    for (const double value : panel.values) {
      ImpactMotion motion = panel.motion;
      motion.*panel.drives = value;
      report(std::string(panel.name) + ", " + std::to_string(static_cast<int>(value)) + " " +
             panel.parameter);
      // Most of the study computes the truth of each case, which is not timed.
      std::vector<ImpactCase> cases(static_cast<std::size_t>(count));
      workers.for_each(count, [&](int i, int) {
        std::mt19937_64 engine = case_engine(options.seed, i, value, 1 + motion.turn);
        at(cases, i) = random_impact_case(engine, kImpactVertices, motion);
      });
      for (std::size_t f = 0; f < finders.size(); ++f) {
        if (motion.turn > 0 && !finders[f].knows_rotation) continue;
        const auto finder = finders[f].make(cases);
        lines.add(f, value,
                  measured(*finder, cases, options.repetitions.value_or(kImpactRepetitions)));
      }
    }
  }
  finish_share(results[1]);
  // The error is the share of failures.
  record::each_point(results[1], [](trace::StudyPoint& point) { point.failed = 0; });
  return results;
}

/// Error of the time of impact against run time, by displacement in the step and distance from the
/// origin, with and without rotation; and the share of missed hits, which are the failures. All
/// methods get the same floats, so losses far from the origin are their own.
std::vector<trace::Study> study_time_of_impact(const StudyOptions& options,
                                               const StudyProgress& progress) {
  std::vector<ImpactFinderInfo> finders = own_impact_finders();
  finders.push_back(sampled(8));
  finders.push_back(sampled(64));
  return study_impact_finders(finders, options, progress);
}

}  // namespace contactscope
