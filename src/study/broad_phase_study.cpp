#include "study/broad_phase_study.h"

#include "study/random_cases.h"

namespace contactscope {
namespace {

constexpr int kNumbersOfBoxes[] = {100, 1000, 10'000, 100'000, 1'000'000};
constexpr int kSteps = 6;

/// Distribution of a scene's boxes.
enum class Spread { Uniform, Clustered };

/// Change between two steps.
enum class Change {
  Again,     // random boxes and a new finder: no state is kept
  All,       // every box moves by 1 % of its sides
  Tenth,     // every tenth box moves so
  Teleport,  // every tenth box jumps to a random position
};

struct BoxScene {
  const char* name;
  Spread spread;
  Change change;
};

constexpr BoxScene kScenes[] = {
    {"from nothing", Spread::Uniform, Change::Again},
    {"from nothing, three decades of sizes", Spread::Clustered, Change::Again},
    {"all move by 1 %", Spread::Uniform, Change::All},
    {"a tenth moves by 1 %", Spread::Uniform, Change::Tenth},
    {"a tenth teleports", Spread::Uniform, Change::Teleport},
};

Vec3<float> random_vector(std::mt19937_64& engine, double low, double high) {
  const double x = uniform(engine, low, high), y = uniform(engine, low, high);
  return Vec3d(x, y, uniform(engine, low, high)).cast<float>();
}

/// Sides of half a metre to a metre, centres in a cube, so that each box meets about seven others;
/// or clusters at five centres, sizes over three decades, for as many overlaps.
struct BoxMaker {
  Spread spread;
  double side;  // side of the cube, metres

  BoxMaker(Spread how, int count)
      : spread(how), side(std::cbrt((how == Spread::Uniform ? 0.48 : 1600.0) * count)) {}

  Aabb<float> operator()(std::mt19937_64& engine) const {
    Vec3<float> center = random_vector(engine, 0, side);
    Vec3<float> half = random_vector(engine, 0.25, 0.5);
    if (spread == Spread::Clustered) {
      half *= static_cast<float>(std::pow(10.0, uniform(engine, -2, 1)));
      const double cluster = 0.2 * side * std::floor(uniform(engine, 0, 5));
      center = random_vector(engine, -1, 1).cwiseProduct(random_vector(engine, 0, 0.1 * side));
      center.array() += static_cast<float>(cluster);
    }
    return {center - half, center + half};
  }
};

/// A scene with a number of boxes, step by step.
struct MovingBoxes {
  const BoxScene& scene;
  BoxMaker make;
  std::mt19937_64 engine;
  std::vector<Aabb<float>> boxes{};
  std::vector<int> moved{};  // since the previous step
  int step = 0;

  MovingBoxes(const BoxScene& of, int count, std::uint64_t seed)
      : scene(of),
        make(of.spread, count),
        engine(case_engine(seed, 0, count, of.spread == Spread::Uniform ? 1 : 2)),
        boxes(static_cast<std::size_t>(count)),
        moved(static_cast<std::size_t>(count)) {
    std::iota(moved.begin(), moved.end(), 0);
    for (Aabb<float>& box : boxes) box = make(engine);
  }

  void advance() {
    ++step;
    if (scene.change != Change::Again) moved.clear();
    const bool all = scene.change == Change::Again || scene.change == Change::All;
    for (int i = all ? 0 : step % 10; i < count_of(boxes); i += all ? 1 : 10) {
      if (scene.change != Change::Again) moved.push_back(i);
      Aabb<float>& box = at(boxes, i);
      if (scene.change == Change::Again) {
        box = make(engine);
        continue;
      }
      const Vec3<float> by = scene.change == Change::Teleport
                                 ? Vec3<float>(make(engine).center() - box.center())
                                 : random_vector(engine, -0.01, 0.01).cwiseProduct(box.extent());
      box = {box.lower + by, box.upper + by};
    }
  }
};

class OwnPairFinder : public PairFinder {
 public:
  explicit OwnPairFinder(std::string_view name) : phase_(make_broad_phase(name)) {}

  void place(std::span<const Aabb<float>> boxes, std::span<const int> moved) override {
    for (const int i : moved) {
      if (i < phase_->handles())
        phase_->move(i, at(boxes, i));
      else
        phase_->add(at(boxes, i));
    }
  }
  void find(std::vector<BoxPair>& found) override { found = phase_->pairs(); }
  std::int64_t comparisons() const override { return phase_->counts().comparisons; }
  std::size_t memory() const override { return phase_->memory(); }

 private:
  std::unique_ptr<BroadPhase> phase_;
};

int most_boxes(const PairFinderInfo& info, const BoxScene& scene) {
  return scene.spread == Spread::Uniform ? info.most_boxes : info.most_of_mixed_sizes;
}

struct EngineRun {
  const PairFinderInfo& info;
  std::unique_ptr<PairFinder> finder{};
  std::vector<BoxPair> found{};
  PassTimes times{};
  Errors memory{}, comparisons{};  // per box
  int failed = 0, of = 0;

  /// The finder's pairs, ascending. Records their cost if `judged`.
  const std::vector<BoxPair>& run(const MovingBoxes& now, bool judged) {
    if (!finder || now.scene.change == Change::Again) finder = info.make();
    const std::int64_t before = finder->comparisons();
    found.clear();
    PassTimes time;
    time.measure(1, [&](int) {
      finder->place(now.boxes, now.moved);
      finder->find(found);
      return static_cast<double>(found.size());
    });
    if (judged) {
      const double boxes = static_cast<double>(now.boxes.size());
      times.add(time.summary().median);
      memory.add(static_cast<double>(finder->memory()) / boxes);
      comparisons.add(static_cast<double>(finder->comparisons() - before) / boxes);
      ++of;
    }
    for (BoxPair& pair : found)
      if (pair.b < pair.a) std::swap(pair.a, pair.b);
    std::ranges::sort(found);
    return found;
  }

  /// In the order of the study's measures. What another library does not report is 0: no point.
  std::vector<trace::StudyPoint> points(int boxes) const {
    constexpr double kMilliseconds = 1e-6;
    const trace::Nanoseconds spent = times.summary();
    std::vector<trace::StudyPoint> made;
    for (const double value : {spent.median * kMilliseconds, spent.max * kMilliseconds,
                               memory.sum / of, comparisons.sum / of}) {
      made.push_back({static_cast<double>(boxes), {}, {}, spent, failed, of});
      if (value > 0) made.back().error = made.back().error_worst = value;
    }
    return made;
  }
};

}  // namespace

std::vector<PairFinderInfo> own_pair_finders() {
  return mapped(broad_phases(), [](const BroadPhaseInfo& info) -> PairFinderInfo {
    PairFinderInfo finder{info.name, 1'000'000, 100'000,
                          [&info] { return std::make_unique<OwnPairFinder>(info.name); }};
    if (info.name == "brute_force") finder.most_boxes = finder.most_of_mixed_sizes = 10'000;
    if (info.name == "sweep_and_prune") finder.most_boxes = finder.most_of_mixed_sizes = 10'000;
    if (info.name == "grid") finder.most_of_mixed_sizes = 10'000;
    return finder;
  });
}

std::vector<trace::Study> study_pair_finders(const std::vector<PairFinderInfo>& finders,
                                             std::span<const int> numbers_of_boxes,
                                             const StudyOptions& options,
                                             const StudyProgress& progress) {
  const int steps = options.cases.value_or(kSteps);
  std::vector<trace::Study> results = results_of(
      "broad_phase", "float", "boxes",
      "the pairs that columns find; " + std::to_string(steps) + " steps a point" + options.seeded(),
      {{"time", "All pairs of boxes that overlap: time of a step", "milliseconds, median"},
       {"longest", "All pairs of boxes that overlap: the longest step", "milliseconds, longest"},
       {"memory", "What a broad phase holds", "bytes a box"},
       {"comparisons", "How many boxes are held against each other", "comparisons a box and step"}},
      trace::StudyForm::Curves);
  const StudyStep report =
      counted(progress, static_cast<int>(std::size(kScenes) * numbers_of_boxes.size()));
  for (const BoxScene& scene : kScenes) {
    const StudyLines lines(results, finders, scene.name, std::string("boxes, ") + scene.name);
    for (const int count : numbers_of_boxes) {
      const auto takes_part = [&](const PairFinderInfo& info) {
        return count <= most_boxes(info, scene);
      };
      if (std::ranges::none_of(finders, takes_part)) continue;
      report(std::string(scene.name) + ", " + std::to_string(count) + " boxes");
      MovingBoxes now(scene, count, options.seed);
      const std::unique_ptr<PairFinder> judge = std::make_unique<OwnPairFinder>("columns");
      std::vector<BoxPair> all;
      std::vector<EngineRun> engine_runs;
      for (const PairFinderInfo& info : finders) engine_runs.push_back({.info = info});
      for (int step = 0; step <= steps; ++step) {
        if (step > 0) now.advance();
        judge->place(now.boxes, now.moved);
        all.clear();
        judge->find(all);
        for (EngineRun& engine_run : engine_runs) {
          if (count > most_boxes(engine_run.info, scene)) continue;
          // The first step has no step before it.
          const bool has_all = std::ranges::includes(engine_run.run(now, step > 0), all);
          if (!has_all && step > 0) ++engine_run.failed;
        }
      }
      for (std::size_t i = 0; i < engine_runs.size(); ++i) {
        if (engine_runs[i].of == 0) continue;
        const std::vector<trace::StudyPoint> points = engine_runs[i].points(count);
        for (std::size_t m = 0; m < results.size(); ++m) lines.points(m, i).push_back(points[m]);
      }
    }
  }
  return results;
}

/// Broad phases over the number of boxes: time of a step, and bytes and comparisons per box, in
/// five scenes, some with the pairs of the previous step. A step fails if it misses a pair that
/// columns find; tests compare columns with brute force.
std::vector<trace::Study> study_broad_phase(const StudyOptions& options,
                                            const StudyProgress& progress) {
  return study_pair_finders(own_pair_finders(), kNumbersOfBoxes, options, progress);
}

}  // namespace contactscope
