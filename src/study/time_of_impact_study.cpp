#include "core/at.h"
#include "query/gjk.h"
#include "study/impact_cases.h"
#include "study/random_cases.h"

namespace contactscope {
namespace {

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
  std::vector<trace::Study> results = results_of(
      "time_of_impact", "float and double", "metres in the step",
      "steps as long as the largest separation allows, in double, " + std::to_string(count) +
          " pairs of hulls of " + std::to_string(kImpactVertices) + " vertices a point, seed " +
          std::to_string(options.seed),
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
