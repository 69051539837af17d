#include "study/impact_cases.h"

#include "continuous/impact.h"
#include "study/random_cases.h"

namespace contactscope {
namespace {

// Metres: overlap due to rounding to float, for sizes of a metre and displacements of ten.
constexpr double kImpactRounding = 3e-6;

/// Uses angle and axis, independent of Sweep::at().
Pose<double> placed(const Sweep<float>& motion, const Vec3<float>& origin, double time) {
  const Vec3d turn = motion.turn.cast<double>();
  const double angle = turn.norm();
  const Quatd start = motion.start.rotation.cast<double>().normalized();
  Quatd rotation = start;
  if (angle > 0) rotation = Quatd(Eigen::AngleAxisd(time * angle, Vec3d(turn / angle))) * start;
  const Vec3d pivot = motion.pivot.cast<double>();
  const Vec3d position = motion.start.position.cast<double>() - origin.cast<double>();
  return {rotation,
          position + start * pivot + time * motion.displacement.cast<double>() - rotation * pivot};
}

/// Along an axis in the world, from A to B.
OracleAxis axis_at(const ImpactCase& of, const Hull<double>& a, const Hull<double>& b,
                   double time) {
  const Pose<double> pose_a = placed(of.of_a, of.of_a.start.position, time);
  const Pose<double> pose_b = placed(of.of_b, of.of_a.start.position, time);
  OracleAxis axis = oracle_axis(a, b, relative_pose(pose_a, pose_b));
  axis.normal = pose_a.rotate(axis.normal);
  return axis;
}

/// Separation at a time, metres, negative in overlap; less than the distance of vertices or edges.
double separation_at(const ImpactCase& of, double time) {
  return axis_at(of, hull_cast<double>(of.a), hull_cast<double>(of.b), time).separation;
}

double fastest_turn(const Hull<double>& hull, const Sweep<float>& motion) {
  double reach = 0;
  for (const Vec3d& vertex : hull.vertices)
    reach = std::max(reach, (vertex - motion.pivot.cast<double>()).norm());
  return reach * motion.turn.cast<double>().norm();
}

double first_touch(const ImpactCase& of) {
  constexpr double kNever = 2, kNear = 1e-7;
  constexpr int kMax = 3000;
  const Hull<double> a = hull_cast<double>(of.a), b = hull_cast<double>(of.b);
  const Vec3d offset = (of.of_b.displacement - of.of_a.displacement).cast<double>();
  const double turning = fastest_turn(a, of.of_a) + fastest_turn(b, of.of_b);
  double time = 0;
  for (int i = 0; i < kMax && time <= 1; ++i) {
    const OracleAxis axis = axis_at(of, a, b, time);
    if (axis.separation <= kNear) return time;
    const double closing = turning - axis.normal.dot(offset);
    if (closing <= 0) return kNever;
    time += axis.separation / closing;
  }
  return time <= 1 ? time : kNever;
}

template <class S>
using FindImpact = ImpactResult<S> (*)(const MovingShape<S>&, const MovingShape<S>&,
                                       const ImpactLimits<S>&, ImpactRun<S>*);

template <class S> class OwnImpactFinder : public ImpactFinder {
 public:
  OwnImpactFinder(std::span<const ImpactCase> cases, FindImpact<S> method) : find_(method) {
    hulls_.reserve(2 * cases.size());
    for (const ImpactCase& of : cases) {
      const auto add = [&](const Hull<float>& hull, const Sweep<float>& motion) {
        hulls_.push_back(hull_cast<S>(hull_cast<double>(hull)));
        shapes_.push_back({support_set(hulls_.back()), motion.template cast<S>(), 0});
      };
      add(of.a, of.of_a);
      add(of.b, of.of_b);
    }
  }

  FoundImpact find(int index) override {
    const ImpactResult<S> found =
        find_(at(shapes_, 2 * index), at(shapes_, 2 * index + 1), {}, nullptr);
    return {found.status != ImpactStatus::Separated, static_cast<double>(found.time)};
  }

 private:
  FindImpact<S> find_;
  std::vector<Hull<S>> hulls_;
  std::vector<MovingShape<S>> shapes_;
};

template <class S> ImpactFinderInfo own_finder(const std::string& name, FindImpact<S> find) {
  return {name, true, [find](std::span<const ImpactCase> cases) {
            return std::make_unique<OwnImpactFinder<S>>(cases, find);
          }};
}

}  // namespace

std::vector<ImpactFinderInfo> own_impact_finders() {
  return {own_finder<float>("time of impact", &time_of_impact<float>),
          own_finder<double>("time of impact in double", &time_of_impact<double>),
          own_finder<float>("advancement", &conservative_advancement<float>),
          own_finder<double>("advancement in double", &conservative_advancement<double>)};
}

ImpactCase random_impact_case(std::mt19937_64& engine, int vertices, const ImpactMotion& motion) {
  ImpactCase made;
  const Hull<double> a = ellipsoid_hull(engine, vertices, 1),
                     b = ellipsoid_hull(engine, vertices, 1);
  made.a = hull_cast<float>(a);
  made.b = hull_cast<float>(b);
  Sweep<double> of_a, of_b;
  of_a.start.rotation = uniform_rotation(engine);
  of_b.start.rotation = uniform_rotation(engine);
  const auto unit_vector = [&]() -> Vec3d { return uniform_rotation(engine) * Vec3d::UnitX(); };
  const Vec3d aim = uniform(engine, 0, 2) * unit_vector();
  const Vec3d from = unit_vector();
  const Vec3d start = (2.05 + 0.9 * uniform(engine, 0, 1) * motion.offset) * from;
  const Vec3d offset = motion.offset * (aim - start).normalized();
  const Vec3d drift = motion.offset * unit_vector();
  const Vec3d origin = motion.origin * unit_vector();
  of_a.start.position = origin;
  of_b.start.position = origin + start;
  of_a.displacement = drift;
  of_b.displacement = drift + offset;
  for (Sweep<double>* of : {&of_a, &of_b}) {
    const double turn = uniform(engine, 0, motion.turn);
    of->turn = turn * unit_vector();
  }
  made.of_a = of_a.cast<float>();
  made.of_b = of_b.cast<float>();
  made.touches = first_touch(made);
  return made;
}

double ImpactTally::error_of(double part) const {
  if (errors.empty()) return 0;
  const auto last = static_cast<double>(errors.size() - 1);
  return errors[static_cast<std::size_t>(std::floor(part * last))];
}

ImpactTally judge_impacts(ImpactFinder& finder, std::span<const ImpactCase> cases) {
  // Fraction of the step: a hit later than the first touch by more has passed through.
  constexpr double kLate = 1e-4;
  ImpactTally tally;
  for (int i = 0; i < count_of(cases); ++i) {
    const ImpactCase& of = at(cases, i);
    const FoundImpact found = finder.find(i);
    ++tally.of;
    const bool touches = of.touches <= 1;
    if (!found.hit) {
      // Shortly after touching they overlap, unless they only graze.
      double deepest = 0;
      if (touches)
        for (const double after : {1e-4, 1e-3, 1e-2})
          deepest = std::min(deepest, separation_at(of, std::min(of.touches + after, 1.0)));
      tally.missed += deepest < -kImpactRounding;
      continue;
    }
    ++tally.hits;
    if (!touches) {
      ++tally.invented;
      continue;
    }
    tally.errors.push_back(std::abs(found.time - of.touches));
    tally.inside +=
        found.time > of.touches + kLate || separation_at(of, found.time) < -kImpactRounding;
  }
  std::ranges::sort(tally.errors);
  return tally;
}

}  // namespace contactscope
