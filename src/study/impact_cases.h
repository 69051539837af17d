#pragma once

#include <functional>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "continuous/sweep.h"
#include "geometry/hull.h"

namespace contactscope {

/// Two hulls of about a metre that move, in the numbers that every method is given.
struct ImpactCase {
  Hull<float> a, b;
  Sweep<float> of_a, of_b;
  /// When they first touch, a fraction of the step; more than 1: never. By steps that are as long as
  /// the largest separation along any axis of the Minkowski difference allows, see oracle_axis().
  double touches = 2;
};

/// How the hulls of a case move.
struct ImpactMotion {
  double offset = 10;  // of B beside A in the step, metres
  double turn = 0;     // of each, at most, radians a step
  double origin = 0;   // how far from the world's origin they are, metres
};

/// Hulls of `vertices` on ellipsoids with semi-axes of 0.5 to 1 m. B begins somewhere on its way to a
/// place within 2 m of the middle of A, apart from it; both drift along as well.
ImpactCase random_impact_case(std::mt19937_64& engine, int vertices, const ImpactMotion& motion);

/// The separation at a time, metres, negative in overlap; the distance where vertices or edges are
/// nearest is larger.
double separation_at(const ImpactCase& of, double time);

struct FoundImpact {
  bool hit = false;
  double time = 1;  // fraction of the step
};

/// Asks when the hulls of each case first touch: one of ours, or another library's.
class ImpactFinder {
 public:
  virtual ~ImpactFinder() = default;
  virtual FoundImpact find(int index) = 0;
};

struct ImpactFinderInfo {
  std::string name;
  bool knows_rotation = true;
  /// `cases` outlives what is made. What can be prepared is not timed.
  std::function<std::unique_ptr<ImpactFinder>(std::span<const ImpactCase> cases)> make;
};

/// Time of impact and conservative advancement, each in float unless its name says double.
std::vector<ImpactFinderInfo> own_impact_finders();

/// What a finder came to on many cases.
struct ImpactTally {
  int of = 0, hits = 0;
  int missed = 0;    // called apart, but they overlap by more than rounding at some time
  int inside = 0;    // hit, and at the time they overlap by more than rounding, or did before
  int invented = 0;  // hit, and they never touch
  std::vector<double> errors;  // of the hits' times, fractions of the step, ascending

  /// Of so large a part of the hits the error is no larger.
  double error_of(double part) const;
};

ImpactTally judge_impacts(ImpactFinder& finder, std::span<const ImpactCase> cases);

}  // namespace contactscope
