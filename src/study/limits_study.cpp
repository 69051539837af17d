#include "study/limits_study.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/at.h"
#include "study/measurement.h"
#include "study/pair_verdict.h"

namespace contactscope {
namespace {

constexpr int kCases = 40;     // a point of a curve and kind of pair
constexpr int kMapCases = 24;  // a cell of a map
constexpr int kRepetitions = 3;

/// What the cases of one point say: of each scalar against the shapes as it holds them, then against
/// those before they were rounded; last how deep the overlap was that they should find. Two measures:
/// over the size of the shapes, and in ulps of the pair's coordinates.
constexpr const char* kLines[] = {"float", "double", "float, unrounded", "double, unrounded",
                                  "overlap"};
constexpr std::size_t kJudgements = 4;  // all but the overlap
constexpr const char* kSignal = kLines[kJudgements];
using Cell = std::array<Measurement, std::size(kLines)>;

void add_case(Measurement& measured, bool is_failure, double of_size, double ulps) {
  ++measured.of;
  if (is_failure) {
    ++measured.failed;
    return;
  }
  measured.errors[0].add(of_size);
  measured.errors[1].add(ulps);
}

template <class S>
void judge_all(const std::vector<LimitCase>& cases, const std::vector<double>& exact,
               int repetitions, Measurement& own, Measurement& unrounded) {
  std::vector<RoundedPair<S>> rounded;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const double size = cases[i].pair.size;
    const PairVerdict verdict = judge_pair<S>(cases[i].pair, cases[i].motion, exact[i]);
    add_case(own, verdict.fault != ContactFault::None, verdict.error / size, verdict.ulps);
    add_case(unrounded, verdict.lost, verdict.unrounded_error / size, verdict.unrounded_ulps);
    rounded.emplace_back(cases[i].pair, cases[i].motion);
  }
  for (int pass = 0; pass < repetitions; ++pass) {
    own.times.measure(count_of(rounded), [&](int i) {
      const double separation = at(rounded, i).collide_once();
      return std::isfinite(separation) ? separation : 0.0;
    });
  }
  unrounded.times = own.times;
}

Cell judge(const std::vector<LimitCase>& cases, int repetitions) {
  Cell cell{Measurement(2), Measurement(2), Measurement(2), Measurement(2), Measurement(2)};
  std::vector<double> exact;
  for (const LimitCase& one : cases) {
    exact.push_back(exact_separation(one.pair));
    add_case(cell[kJudgements], false, std::max(0.0, -exact.back()) / one.pair.size, 0);
  }
  judge_all<float>(cases, exact, repetitions, cell[0], cell[2]);
  judge_all<double>(cases, exact, repetitions, cell[1], cell[3]);
  cell[kJudgements].times = cell[0].times;
  return cell;
}

/// A study to be filled, with what all of them share.
trace::Study described(const StudyOptions& options, const char* measure, int cases,
                       const std::string& of_what = "a cell") {
  trace::Study study;
  study.study = "stability";
  study.measure = measure;
  study.context = study_context("float and double");
  study.reference = "all axes and features in extended precision, " + std::to_string(cases) +
                    " cases " + of_what + ", seed " + std::to_string(options.seed);
  return study;
}

trace::Study described_map(const StudyOptions& options, const char* measure, const char* title,
                           int cases) {
  trace::Study study = described(options, measure, cases);
  study.title = title;
  study.error = "largest error of the contact (ulps of the pair's coordinates)";
  study.form = trace::StudyForm::Map;
  return study;
}

void append(std::vector<trace::StudySeries>& all, const std::vector<trace::StudySeries>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

/// Six sweeps over all pairs at once, and three of them by kind of pair.
std::vector<trace::Study> run_sweeps(const StudyOptions& options, const StudyStep& step) {
  const int case_count = options.cases.value_or(kCases);
  const int repetitions = options.repetitions.value_or(kRepetitions);
  trace::Study sweeps = described(options, "sweeps", case_count, "a point and kind of pair");
  sweeps.reference += "; unrounded: the geometry before it was moved and rounded";
  sweeps.title = "Where float and double run out";
  sweeps.error = "error of the contact / size of the shapes";
  sweeps.parameter = "what a panel's axis says";
  sweeps.form = trace::StudyForm::Curves;
  sweeps.signal = kSignal;
  trace::Study pairs =
      described_map(options, "pairs", "Rounding of every pair of shapes", case_count);
  pairs.parameter = sweeps.parameter;
  pairs.row = "kind of pair";
  std::vector<trace::StudySeries> by_kind[2];  // of each scalar
  for (const LimitSweep& sweep : limit_sweeps()) {
    const bool has_map = sweep.name == "scale" || sweep.name == "distance" || sweep.name == "kiss";
    std::vector<trace::StudySeries> curves;
    for (const char* line : kLines) curves.push_back({line, {}, sweep.name, sweep.parameter});
    std::vector<trace::StudySeries> rows[2];
    for (const std::size_t scalar : {0, 1}) {
      const std::string panel = std::string(kLines[scalar]) + ": " + sweep.name;
      for (const PairKind& kind : sweep.kinds)
        rows[scalar].push_back({to_string(kind), {}, panel, sweep.parameter});
    }
    for (const double value : sweep.values()) {
      std::vector<LimitCase> all;
      for (std::size_t k = 0; k < sweep.kinds.size(); ++k) {
        std::vector<LimitCase> cases;
        for (int i = 0; i < case_count; ++i)
          cases.push_back(limit_case(sweep, value, sweep.kinds[k], i, options.seed));
        all.insert(all.end(), cases.begin(), cases.end());
        if (!has_map) continue;
        const Cell cell = judge(cases, repetitions);
        for (const std::size_t scalar : {0, 1})
          rows[scalar][k].points.push_back(cell[scalar].point(value, 1));
      }
      const Cell cell = judge(all, repetitions);
      for (std::size_t line = 0; line < cell.size(); ++line)
        curves[line].points.push_back(cell[line].point(value, 0));
      step(sweep.name);
    }
    append(sweeps.series, curves);
    for (const std::size_t scalar : {0, 1}) {
      if (has_map) append(by_kind[scalar], rows[scalar]);
    }
  }
  for (const std::vector<trace::StudySeries>& rows : by_kind) append(pairs.series, rows);
  return {sweeps, pairs};
}

/// Two sweeps at once.
struct LimitMap {
  const char* measure;
  const char* title;
  std::size_t across, up;  // in limit_sweeps()
  LimitCase (*make_case)(double across, double up, int index, std::mt19937_64& engine);
};

const PairKind& kind_of_case(std::size_t sweep, int index) {
  const std::vector<PairKind>& kinds = limit_sweeps()[sweep].kinds;
  return at(kinds, index % count_of(kinds));
}

constexpr LimitMap kLimitMaps[] = {
    {"tilt_scale", "Box on box: tilt and size", 0, 1,
     [](double tilt, double size, int i, std::mt19937_64& engine) {
       Stacking stacking;
       stacking.tilt = tilt;
       stacking.size = size;
       return LimitCase{stacked_pair({OnTop::Box, Below::Box}, stacking, i, engine),
                        world_motion(5 * size, engine)};
     }},
    {"distance_overlap", "Every pair of shapes: distance from the origin and overlap", 2, 5,
     [](double distance, double overlap, int i, std::mt19937_64& engine) {
       Stacking stacking;
       stacking.overlap = overlap;
       const int turn = i / count_of(limit_sweeps()[2].kinds);
       return LimitCase{stacked_pair(kind_of_case(2, i), stacking, turn, engine),
                        world_motion(distance, engine)};
     }},
    {"aspect_angle", "Edges and axes: angle between them and aspect ratio", 4, 3,
     [](double angle, double aspect, int i, std::mt19937_64& engine) {
       Stacking stacking;
       stacking.crossed = true;
       stacking.angle = angle;
       stacking.aspect = aspect;
       return LimitCase{stacked_pair(kind_of_case(4, i), stacking, i, engine),
                        world_motion(5, engine)};
     }},
};

/// One panel for each scalar and judgement, a series for each row.
trace::Study run_map(const LimitMap& map, const StudyOptions& options, const StudyStep& step) {
  const LimitSweep& across = limit_sweeps()[map.across];
  const LimitSweep& up = limit_sweeps()[map.up];
  const int case_count = options.cases.value_or(kMapCases);
  trace::Study study = described_map(options, map.measure, map.title, case_count);
  study.parameter = across.parameter;
  study.row = up.parameter;
  std::vector<trace::StudySeries> panels[kJudgements];
  for (const double row : up.values()) {
    for (std::size_t i = 0; i < kJudgements; ++i)
      panels[i].push_back({kLines[i], {}, kLines[i], across.parameter, row});
    for (const double value : across.values()) {
      std::vector<LimitCase> cases;
      for (int i = 0; i < case_count; ++i) {
        std::mt19937_64 engine = case_engine(options.seed, i, value, row);
        cases.push_back(map.make_case(value, row, i, engine));
      }
      const Cell cell = judge(cases, 1);
      for (std::size_t i = 0; i < kJudgements; ++i)
        panels[i].back().points.push_back(cell[i].point(value, 1));
    }
    step(map.measure);
  }
  for (const std::vector<trace::StudySeries>& panel : panels) append(study.series, panel);
  return study;
}

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
  // Points of the sweeps, rows of the maps.
  constexpr int kSteps = 19 + 25 + 17 + 13 + 23 + 19 + 25 + 19 + 13;
  const StudyStep step = counted(progress, kSteps);
  std::vector<trace::Study> results = run_sweeps(options, step);
  for (const LimitMap& map : kLimitMaps) results.push_back(run_map(map, options, step));
  return results;
}

}  // namespace contactscope
