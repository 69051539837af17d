#include "study/limits_study.h"

#include "study/random_cases.h"
#include "study/study.h"

namespace contactscope {
namespace {

constexpr int kCases = 40;     // per point of a curve and kind of pair
constexpr int kMapCases = 24;  // per cell of a map
constexpr int kRepetitions = 3;

/// Lines of a point: each scalar compared with its rounded shapes, then with the unrounded ones;
/// last the true overlap. Two measures: relative to the size, and in ulps of the coordinates.
constexpr const char* kLines[] = {"float", "double", "float, unrounded", "double, unrounded",
                                  "overlap"};
constexpr std::size_t kJudgements = 4;  // all except the overlap
using Cell = std::vector<Measurement>;  // one per line

using Cases = std::vector<StackedPair>;

void add_case(Measurement& measured, bool is_failure, double of_size, double ulps) {
  ++measured.of;
  if (is_failure) {
    ++measured.failed;
    return;
  }
  measured.errors[0].add(of_size);
  measured.errors[1].add(ulps);
}

/// Uses all threads; timed runs follow with an idle processor.
template <class S>
void judge_all(const Cases& cases, int repetitions, Workers& workers, Measurement& own,
               Measurement& unrounded) {
  std::vector<PairVerdict> verdicts(cases.size());
  workers.for_each(count_of(cases),
                   [&](int i, int) { at(verdicts, i) = judge_pair<S>(at(cases, i)); });
  std::vector<RoundedPair<S>> rounded;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const StackedPair& pair = cases[i];
    const PairVerdict& verdict = verdicts[i];
    add_case(own, verdict.fault != ContactFault::None, verdict.error / pair.size, verdict.ulps);
    add_case(unrounded, verdict.lost, verdict.unrounded_error / pair.size, verdict.unrounded_ulps);
    rounded.emplace_back(pair);
  }
  own.times.measure(repetitions, count_of(rounded), [&](int i) {
    const double separation = at(rounded, i).collide_once();
    return std::isfinite(separation) ? separation : 0.0;
  });
  unrounded.times = own.times;
}

Cell judge(const Cases& cases, int repetitions, Workers& workers) {
  Cell cell(std::size(kLines), Measurement(2));
  for (const StackedPair& pair : cases)
    add_case(cell[kJudgements], false, std::max(0.0, -pair.separation) / pair.size, 0);
  judge_all<float>(cases, repetitions, workers, cell[0], cell[2]);
  judge_all<double>(cases, repetitions, workers, cell[1], cell[3]);
  cell[kJudgements].times = cell[0].times;
  return cell;
}

/// An empty study with the common data; maps are in ulps.
trace::Study described(const StudyOptions& options, trace::StudyForm form, const char* measure,
                       const char* title, int cases, const std::string& of_what = "a cell") {
  const char* const error = form == trace::StudyForm::Map
                                ? "largest error of the contact (ulps of the pair's coordinates)"
                                : "error of the contact / size of the shapes";
  return results_of("stability", "float and double", "",
                    "all axes and features in extended precision, " + std::to_string(cases) +
                        " cases " + of_what + options.seeded(),
                    {{measure, title, error}}, form)
      .front();
}

std::vector<PairKind> every_kind() {
  std::vector<PairKind> kinds;
  for (int below = 0; below <= static_cast<int>(Stacked::Mesh); ++below)
    for (int top = 0; top <= std::min(below, static_cast<int>(Stacked::Box)); ++top)
      kinds.push_back({static_cast<Stacked>(top), static_cast<Stacked>(below)});
  return kinds;
}

/// Six sweeps over all kinds of pairs together; sweeps that apply to every kind also by kind.
std::vector<trace::Study> run_sweeps(const StudyOptions& options, Workers& workers,
                                     const StudyStep& step) {
  const int case_count = options.cases.value_or(kCases);
  const int repetitions = options.repetitions.value_or(kRepetitions);
  trace::Study sweeps =
      described(options, trace::StudyForm::Curves, "sweeps", "Where float and double run out",
                case_count, "a point and kind of pair");
  sweeps.reference += "; unrounded: the geometry before it was moved and rounded";
  sweeps.parameter = "what a panel's axis says";
  sweeps.signal = kLines[kJudgements];
  trace::Study pairs = described(options, trace::StudyForm::Map, "pairs",
                                 "Rounding of every pair of shapes", case_count);
  pairs.parameter = sweeps.parameter;
  pairs.row = "kind of pair";
  std::vector<trace::StudySeries> by_kind[2];  // per scalar
  for (const LimitSweep& sweep : limit_sweeps()) {
    const bool has_map = sweep.kinds.size() == every_kind().size();
    const std::size_t curve = sweeps.series.size(), row = by_kind[0].size();
    for (const char* line : kLines)
      sweeps.series.push_back({line, {}, sweep.name, sweep.parameter});
    for (const std::size_t scalar : {0, 1}) {
      const std::string panel = std::string(kLines[scalar]) + ": " + sweep.name;
      for (const PairKind& kind : sweep.kinds)
        if (has_map) by_kind[scalar].push_back({to_string(kind), {}, panel, sweep.parameter});
    }
    for (const double value : sweep.values()) {
      Cases all;
      for (std::size_t k = 0; k < sweep.kinds.size(); ++k) {
        Cases cases;
        for (int i = 0; i < case_count; ++i)
          cases.push_back(limit_case(sweep, value, sweep.kinds[k], i, options.seed));
        all.insert(all.end(), cases.begin(), cases.end());
        if (!has_map) continue;
        const Cell cell = judge(cases, repetitions, workers);
        for (const std::size_t scalar : {0, 1})
          by_kind[scalar][row + k].points.push_back(cell[scalar].point(value, 1));
      }
      const Cell cell = judge(all, repetitions, workers);
      for (std::size_t line = 0; line < cell.size(); ++line)
        sweeps.series[curve + line].points.push_back(cell[line].point(value, 0));
      step(sweep.name);
    }
  }
  for (const std::vector<trace::StudySeries>& rows : by_kind)
    pairs.series.insert(pairs.series.end(), rows.begin(), rows.end());
  return {sweeps, pairs};
}

/// Two sweeps combined.
struct LimitMap {
  const char* measure;
  const char* title;
  std::size_t across, up;  // in limit_sweeps()
  int kinds;               // number of kinds, in turn
};

constexpr LimitMap kLimitMaps[] = {
    {"tilt_scale", "Box on box: tilt and size", 0, 1, 1},
    {"distance_overlap", "Every pair of shapes: distance from the origin and overlap", 2, 5, 12},
    {"aspect_angle", "Edges and axes: angle between them and aspect ratio", 4, 3, 3},
};

/// One panel per scalar and reference, one series per row.
trace::Study run_map(const LimitMap& map, const StudyOptions& options, Workers& workers,
                     const StudyStep& step) {
  const LimitSweep& across = limit_sweeps()[map.across];
  const LimitSweep& up = limit_sweeps()[map.up];
  const std::vector<double> rows = up.values();
  const int case_count = options.cases.value_or(kMapCases);
  trace::Study study =
      described(options, trace::StudyForm::Map, map.measure, map.title, case_count);
  study.parameter = across.parameter;
  study.row = up.parameter;
  for (std::size_t i = 0; i < kJudgements; ++i)
    for (const double row : rows)
      study.series.push_back({kLines[i], {}, kLines[i], across.parameter, row});
  for (std::size_t row = 0; row < rows.size(); ++row) {
    for (const double value : across.values()) {
      Stacking stacking;
      stacking.*across.drives = value;
      stacking.*up.drives = rows[row];
      Cases cases;
      for (int i = 0; i < case_count; ++i) {
        std::mt19937_64 engine = case_engine(options.seed, i, value, rows[row]);
        cases.push_back(
            stacked_pair(at(across.kinds, i % map.kinds), stacking, i / map.kinds, engine));
      }
      const Cell cell = judge(cases, 1, workers);
      for (std::size_t i = 0; i < kJudgements; ++i)
        study.series[i * rows.size() + row].points.push_back(cell[i].point(value, 1));
    }
    step(map.measure);
  }
  return study;
}

}  // namespace

std::vector<double> LimitSweep::values() const {
  std::vector<double> list;
  const long first = std::lround(2 * std::log10(low)), last = std::lround(2 * std::log10(high));
  for (long half = first; half <= last; ++half)
    list.push_back(std::pow(10.0, 0.5 * static_cast<double>(half)));
  return list;
}

const std::vector<LimitSweep>& limit_sweeps() {
  using enum Stacked;
  const std::vector<PairKind> kTilted = {{Box, Box},       {Capsule, Box}, {Box, Plane},
                                         {Capsule, Plane}, {Box, Mesh},    {Capsule, Mesh}};
  const std::vector<PairKind> kOnLongOnes = {{Sphere, Capsule}, {Capsule, Capsule}, {Sphere, Box},
                                             {Capsule, Box},    {Box, Box},         {Sphere, Mesh},
                                             {Capsule, Mesh},   {Box, Mesh}};
  const std::vector<PairKind> kCrossed = {{Box, Box}, {Capsule, Capsule}, {Capsule, Box}};
  static const std::vector<LimitSweep> list = {
      {"tilt", "tilt (rad)", &Stacking::tilt, 1e-9, 1, kTilted},
      {"scale", "size (m)", &Stacking::size, 1e-6, 1e6, every_kind()},
      {"distance", "distance from the origin (m)", &Stacking::distance, 0.1, 1e7, every_kind()},
      {"aspect", "aspect ratio", &Stacking::aspect, 1, 1e6, kOnLongOnes},
      {"angle", "angle between edges (rad)", &Stacking::angle, 1e-12, 0.1, kCrossed},
      {"kiss", "overlap, 1 = coincident", &Stacking::overlap, 1e-9, 1, every_kind()},
  };
  return list;
}

StackedPair limit_case(const LimitSweep& sweep, double value, const PairKind& kind, int index,
                       std::uint64_t seed) {
  Stacking stacking;
  stacking.*sweep.drives = value;
  if (stacking.angle != 0 && index % 2 == 0) stacking.overlap *= std::min(1.0, 10 * value);
  std::mt19937_64 engine = case_engine(seed, index, value, 1);
  return stacked_pair(kind, stacking, index, engine);
}

/// Limits of the pipeline's numbers, in float and in double. Every contact is compared with the
/// separation oracle twice: for the shapes and poses as the scalar stores them (loss in the
/// pipeline: "float", "double"), and for the geometry before it was moved and rounded (total loss:
/// "float, unrounded" ..). Faults count as failures: values that are not finite, missing and
/// phantom contacts, depth or normal off by more than 64 roundings, and overlaps below that
/// (ContactFault). For unrounded geometry: contacts that are lost, or off by half their depth.
///
/// "sweeps": curves of the largest error over all kinds of pairs, relative to the size of the
/// shapes. "pairs": maps of pair kind by scale, distance and overlap, in ulps of the pair's
/// coordinates. "tilt_scale", "distance_overlap", "aspect_angle": likewise, over two parameters.
std::vector<trace::Study> study_limits(const StudyOptions& options, const StudyProgress& progress) {
  int steps = 0;  // points of the sweeps, rows of the maps
  for (const LimitSweep& sweep : limit_sweeps()) steps += count_of(sweep.values());
  for (const LimitMap& map : kLimitMaps) steps += count_of(limit_sweeps()[map.up].values());
  const StudyStep step = counted(progress, steps);
  Workers workers(options.thread_count());
  std::vector<trace::Study> results = run_sweeps(options, workers, step);
  for (const LimitMap& map : kLimitMaps) results.push_back(run_map(map, options, workers, step));
  return results;
}

}  // namespace contactscope
