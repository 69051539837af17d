#pragma once

#include <random>

#include "continuous/motion_bounds.h"
#include "study/study.h"

namespace contactscope {

/// Two moving hulls of about a metre, in the floats that every method gets.
struct ImpactCase {
  Hull<float> a, b;
  Sweep<float> of_a, of_b;
  /// Time of first contact, as a fraction of the step; above 1: never. Found by steps as long as
  /// the largest separation along any axis of the Minkowski difference allows, see oracle_axis().
  double touches = 2;
};

/// Parameters of the motion of both hulls.
struct ImpactMotion {
  double offset = 10;  // displacement of B relative to A in the step, metres
  double turn = 0;     // of each, at most, radians per step
  double origin = 0;   // distance from the world's origin, metres
};

/// Hulls of `vertices` on ellipsoids with semi-axes of 0.5 to 1 m. B starts separated, on a path to
/// a point within 2 m of A's centre; both also drift together.
ImpactCase random_impact_case(std::mt19937_64& engine, int vertices, const ImpactMotion& motion);

struct FoundImpact {
  bool hit = false;
  double time = 1;  // fraction of the step
};

/// Computes the first contact of the hulls of each case: one of ours or another library's.
class ImpactFinder {
 public:
  virtual ~ImpactFinder() = default;
  virtual FoundImpact find(int index) = 0;
};

struct ImpactFinderInfo {
  std::string name;
  bool knows_rotation = true;
  /// `cases` must outlive the result. Preparation is not timed.
  std::function<std::unique_ptr<ImpactFinder>(std::span<const ImpactCase> cases)> make;
};

/// Time of impact and conservative advancement; in float unless the name contains "double".
std::vector<ImpactFinderInfo> own_impact_finders();

/// Results of a finder on many cases.
struct ImpactTally {
  int of = 0, hits = 0;
  int missed = 0;              // reported as separated, but overlap exceeds rounding
  int inside = 0;              // hit, but at that time or before, overlap exceeds rounding
  int invented = 0;            // hit, but they never touch
  std::vector<double> errors;  // time errors of hits, fractions of the step, ascending

  /// The error that this fraction of the hits does not exceed.
  double error_of(double part) const;
};

ImpactTally judge_impacts(ImpactFinder& finder, std::span<const ImpactCase> cases);

/// The study `time_of_impact` with these finders, timed in turn.
std::vector<trace::Study> study_impact_finders(const std::vector<ImpactFinderInfo>& finders,
                                               const StudyOptions& options,
                                               const StudyProgress& progress);

}  // namespace contactscope
