#include "study/limits_study.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "study/measurement.h"
#include "study/pair_verdict.h"

namespace contactscope {
namespace {

constexpr int kCases = 40;     // a point of a curve and kind of pair
constexpr int kMapCases = 24;  // a cell of a map
constexpr int kRepetitions = 3;

constexpr const char* kOwn[] = {"float", "double"};
constexpr const char* kUnrounded[] = {"float, unrounded", "double, unrounded"};
constexpr const char* kSignal = "overlap";

/// What the cases of one point say of one scalar, against the shapes as it holds them and as they
/// were before. Two measures: over the size of the shapes, and in ulps of the pair's coordinates.
struct Tally {
  Measurement own{2}, unrounded{2};

  void add(const PairVerdict& verdict, double size) {
    add(own, verdict.fault != ContactFault::None, verdict.error / size, verdict.ulps);
    add(unrounded, verdict.lost, verdict.unrounded_error / size, verdict.unrounded_ulps);
  }

 private:
  static void add(Measurement& measured, bool is_failure, double of_size, double ulps) {
    ++measured.of;
    if (is_failure) {
      ++measured.failed;
      return;
    }
    measured.errors[0].add(of_size);
    measured.errors[1].add(ulps);
  }
};

/// Both scalars, and how deep the overlap was that they should find.
struct Cell {
  Tally scalars[2];
  Measurement depth{1};  // over the size
};

template <class S>
void judge_all(const std::vector<LimitCase>& cases, const std::vector<double>& exact,
               int repetitions, Tally& tally) {
  std::vector<RoundedPair<S>> rounded;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    tally.add(judge_pair<S>(cases[i].pair, cases[i].motion, exact[i]), cases[i].pair.size);
    rounded.emplace_back(cases[i].pair, cases[i].motion);
  }
  for (int pass = 0; pass < repetitions; ++pass) {
    tally.own.times.measure(static_cast<int>(rounded.size()), [&](int i) {
      const double separation = rounded[static_cast<std::size_t>(i)].collide_once();
      return std::isfinite(separation) ? separation : 0.0;
    });
  }
  tally.unrounded.times = tally.own.times;
}

Cell judge(const std::vector<LimitCase>& cases, int repetitions) {
  Cell cell;
  std::vector<double> exact;
  for (const LimitCase& one : cases) {
    exact.push_back(exact_separation(one.pair));
    cell.depth.errors[0].add(std::max(0.0, -exact.back()) / one.pair.size);
    ++cell.depth.of;
  }
  judge_all<float>(cases, exact, repetitions, cell.scalars[0]);
  judge_all<double>(cases, exact, repetitions, cell.scalars[1]);
  cell.depth.times = cell.scalars[0].own.times;
  return cell;
}

/// A study to be filled, with what all of them share.
trace::Study described(const StudyOptions& options, const std::string& measure, int cases,
                       const std::string& of_what = "a cell") {
  trace::Study study;
  study.study = "stability";
  study.measure = measure;
  study.context = study_context("float and double");
  study.reference = "all axes and features in extended precision, " + std::to_string(cases) +
                    " cases " + of_what + ", seed " + std::to_string(options.seed);
  return study;
}

class Limits {
 public:
  Limits(const StudyOptions& options, const StudyProgress& progress)
      : options_(options),
        progress_(progress),
        cases_(options.cases.value_or(kCases)),
        map_cases_(options.cases.value_or(kMapCases)),
        repetitions_(options.repetitions.value_or(kRepetitions)) {}

  std::vector<trace::Study> run() {
    run_sweeps();
    run_maps();
    return {std::move(sweeps_), std::move(pairs_), std::move(tilt_scale_),
            std::move(distance_overlap_), std::move(aspect_angle_)};
  }

 private:
  void step(const std::string& what) { progress_(++done_, kSteps, what); }

  /// Six sweeps over all pairs at once, and three of them by kind of pair.
  void run_sweeps() {
    sweeps_ = described(options_, "sweeps", cases_, "a point and kind of pair");
    sweeps_.reference += "; unrounded: the geometry before it was moved and rounded";
    sweeps_.title = "Where float and double run out";
    sweeps_.error = "error of the contact / size of the shapes";
    sweeps_.parameter = "what a panel's axis says";
    sweeps_.form = trace::StudyForm::Curves;
    sweeps_.signal = kSignal;
    pairs_ = described(options_, "pairs", cases_);
    pairs_.title = "Rounding of every pair of shapes";
    pairs_.error = "largest error of the contact (ulps of the pair's coordinates)";
    pairs_.parameter = sweeps_.parameter;
    pairs_.row = "kind of pair";
    pairs_.form = trace::StudyForm::Map;
    for (const LimitSweep& sweep : limit_sweeps()) run_sweep(sweep);
    for (std::vector<trace::StudySeries>& rows : by_kind_) {
      for (trace::StudySeries& series : rows) pairs_.series.push_back(std::move(series));
    }
  }

  void run_sweep(const LimitSweep& sweep) {
    const bool by_kind = sweep.name == "scale" || sweep.name == "distance" || sweep.name == "kiss";
    std::vector<trace::StudySeries> curves;
    for (const char* method : {kOwn[0], kOwn[1], kUnrounded[0], kUnrounded[1], kSignal}) {
      curves.push_back({method, {}, sweep.name, sweep.parameter});
    }
    std::vector<trace::StudySeries> rows[2];
    for (const int scalar : {0, 1}) {
      for (const PairKind& kind : sweep.kinds) {
        rows[scalar].push_back(
            {to_string(kind), {}, std::string(kOwn[scalar]) + ": " + sweep.name, sweep.parameter});
      }
    }
    for (const double value : sweep.values()) {
      std::vector<LimitCase> all;
      for (std::size_t k = 0; k < sweep.kinds.size(); ++k) {
        std::vector<LimitCase> cases;
        for (int i = 0; i < cases_; ++i) {
          cases.push_back(limit_case(sweep, value, sweep.kinds[k], i, options_.seed));
        }
        if (by_kind) {
          const Cell cell = judge(cases, repetitions_);
          for (const int scalar : {0, 1})
            rows[scalar][k].points.push_back(cell.scalars[scalar].own.point(value, 1));
        }
        all.insert(all.end(), cases.begin(), cases.end());
      }
      add_to_curves(value, judge(all, repetitions_), curves);
      step(sweep.name);
    }
    for (trace::StudySeries& series : curves) sweeps_.series.push_back(std::move(series));
    if (!by_kind) return;
    for (const int scalar : {0, 1}) {
      for (trace::StudySeries& series : rows[scalar]) {
        by_kind_[scalar].push_back(std::move(series));
      }
    }
  }

  static void add_to_curves(double value, const Cell& cell,
                            std::vector<trace::StudySeries>& curves) {
    for (const std::size_t scalar : {0, 1}) {
      curves[scalar].points.push_back(cell.scalars[scalar].own.point(value, 0));
      curves[2 + scalar].points.push_back(cell.scalars[scalar].unrounded.point(value, 0));
    }
    curves[4].points.push_back(cell.depth.point(value, 0));
  }

  using MakeCase = LimitCase (*)(double across, double up, int index, std::uint64_t seed);

  /// One panel for each scalar and judgement, a series for each row.
  trace::Study run_map(const std::string& measure, const LimitSweep& across, const LimitSweep& up,
                       MakeCase make_case) {
    trace::Study study = described(options_, measure, map_cases_);
    study.error = "largest error of the contact (ulps of the pair's coordinates)";
    study.parameter = across.parameter;
    study.row = up.parameter;
    study.form = trace::StudyForm::Map;
    std::vector<trace::StudySeries> panels[4];
    for (const double row : up.values()) {
      for (int panel = 0; panel < 4; ++panel) {
        const char* name = panel < 2 ? kOwn[panel] : kUnrounded[panel - 2];
        panels[panel].push_back({name, {}, name, across.parameter, row});
      }
      for (const double value : across.values()) {
        std::vector<LimitCase> cases;
        for (int i = 0; i < map_cases_; ++i) {
          cases.push_back(make_case(value, row, i, options_.seed));
        }
        const Cell cell = judge(cases, 1);
        for (const int scalar : {0, 1}) {
          const Tally& tally = cell.scalars[scalar];
          panels[scalar].back().points.push_back(tally.own.point(value, 1));
          panels[2 + scalar].back().points.push_back(tally.unrounded.point(value, 1));
        }
      }
      step(measure);
    }
    for (const std::vector<trace::StudySeries>& panel : panels) {
      study.series.insert(study.series.end(), panel.begin(), panel.end());
    }
    return study;
  }

  void run_maps() {
    const std::vector<LimitSweep>& sweeps = limit_sweeps();
    tilt_scale_ =
        run_map("tilt_scale", sweeps[0], sweeps[1],
                [](double tilt, double size, int i, std::uint64_t seed) {
                  std::mt19937_64 engine = case_engine(seed, i, tilt, size);
                  Stacking stacking;
                  stacking.tilt = tilt;
                  stacking.size = size;
                  return LimitCase{stacked_pair({OnTop::Box, Below::Box}, stacking, i, engine),
                                   world_motion(5 * size, engine)};
                });
    tilt_scale_.title = "Box on box: tilt and size";
    distance_overlap_ = run_map("distance_overlap", sweeps[2], sweeps[5],
                                [](double distance, double overlap, int i, std::uint64_t seed) {
                                  std::mt19937_64 engine = case_engine(seed, i, distance, overlap);
                                  const std::vector<PairKind>& kinds = limit_sweeps()[2].kinds;
                                  const PairKind& kind =
                                      kinds[static_cast<std::size_t>(i) % kinds.size()];
                                  Stacking stacking;
                                  stacking.overlap = overlap;
                                  const int turn = i / static_cast<int>(kinds.size());
                                  return LimitCase{stacked_pair(kind, stacking, turn, engine),
                                                   world_motion(distance, engine)};
                                });
    distance_overlap_.title = "Every pair of shapes: distance from the origin and overlap";
    aspect_angle_ = run_map(
        "aspect_angle", sweeps[4], sweeps[3],
        [](double angle, double aspect, int i, std::uint64_t seed) {
          std::mt19937_64 engine = case_engine(seed, i, angle, aspect);
          const std::vector<PairKind>& kinds = limit_sweeps()[4].kinds;
          Stacking stacking;
          stacking.crossed = true;
          stacking.angle = angle;
          stacking.aspect = aspect;
          return LimitCase{
              stacked_pair(kinds[static_cast<std::size_t>(i) % kinds.size()], stacking, i, engine),
              world_motion(5, engine)};
        });
    aspect_angle_.title = "Edges and axes: angle between them and aspect ratio";
  }

  // Points of the sweeps, rows of the maps.
  static constexpr int kSteps = 19 + 25 + 17 + 13 + 23 + 19 + 25 + 19 + 13;

  const StudyOptions& options_;
  const StudyProgress& progress_;
  int cases_, map_cases_, repetitions_;
  int done_ = 0;
  std::vector<trace::StudySeries> by_kind_[2];  // of each scalar
  trace::Study sweeps_, pairs_, tilt_scale_, distance_overlap_, aspect_angle_;
};

}  // namespace

/// Where the pipeline's numbers run out, in float and in double. Every contact is judged against the
/// separation oracle twice: of the shapes and poses as the scalar holds them (what the pipeline
/// loses: "float", "double"), and of the geometry before it was moved to its place in the world and
/// rounded (what is left of it: "float, unrounded" ..). Faults are counted as failures: numbers that
/// are not finite, missing and phantom contacts, depth or normal off by more than 64 roundings, and
/// overlaps that drown in less than that (pair_verdict.h); of the unrounded ones contacts that are lost,
/// or off by half their depth.
///
/// "sweeps": curves of the largest error over all kinds of pairs, over the size of the shapes.
/// "pairs": maps of pair kind by scale, distance and overlap, in ulps of the pair's coordinates.
/// "tilt_scale", "distance_overlap", "aspect_angle": maps of two parameters, likewise.
std::vector<trace::Study> study_limits(const StudyOptions& options, const StudyProgress& progress) {
  return Limits(options, progress).run();
}

}  // namespace contactscope
