#include "scenario/run.h"
#include "study/study.h"

namespace contactscope {
namespace {

constexpr int kDirections = 32;

std::string name_of(const trace::Pair& pair) {
  return pair.a + "-" + pair.b + (pair.label.empty() ? "" : " (" + pair.label + ")");
}

}  // namespace

/// Smallest change after which each manifold of a scenario has other points, see
/// flip_distance() in manifold/dispatch.h: metres and radians of the second shape's pose, and steps of the last
/// place. One line per pair, one panel per scenario. Frames without such a change within 1/100 of
/// the smaller shape count as failed, without a value. Frames share no caches or kept points.
std::vector<trace::Study> study_flip_distance(const StudyOptions& options,
                                              const StudyProgress& progress) {
  const std::vector<Scenario> none;
  const std::vector<Scenario>& scenarios = options.scenarios ? *options.scenarios : none;
  std::vector<trace::Study> results = results_of(
      "flip_distance", "as the scenarios say", "frame", "the points that the pair has",
      {{"way", "The smallest way of b after which a pair has other points", "smallest way", "m"},
       {"turn", "The smallest turn of b after which a pair has other points", "smallest turn",
        "rad"},
       {"last_places", "How many last places a coordinate of b is from other points",
        "smallest number of last places"}},
      trace::StudyForm::Curves);
  trace::Stages stages = trace::Stages::none();
  stages.flip = true;
  stages.flip_directions = options.cases.value_or(kDirections);
  stages.flip_seed = static_cast<int>(options.seed);
  int total = 0;
  for (const Scenario& scenario : scenarios) total += scenario.frames;
  const StudyStep step = counted(progress, total);
  for (const Scenario& scenario : scenarios) {
    Runner runner(scenario, stages);
    std::map<std::string, std::array<trace::StudySeries, 3>> lines;
    for (int frame = 0; frame < scenario.frames; ++frame) {
      step(scenario.name + ", frame " + std::to_string(frame));
      if (!options.only_frames.empty() && std::ranges::count(options.only_frames, frame) == 0)
        continue;
      trace::Frame facts;
      PassTimes times;
      times.measure(1, [&](int) {
        facts = runner.frame(frame);
        return static_cast<double>(facts.pairs.size());
      });
      const double each = times.summary().median / static_cast<double>(facts.pairs.size());
      for (const trace::Pair& pair : facts.pairs) {
        if (!pair.flip) continue;
        const std::optional<double> numbers[] = {pair.flip->offset, pair.flip->turn,
                                                 pair.flip->last_places};
        for (std::size_t i = 0; i < 3; ++i) {
          trace::StudySeries& line = lines[name_of(pair)][i];
          line.method = name_of(pair);
          line.panel = scenario.name;
          line.parameter = "frame";
          const int failed = numbers[i] ? 0 : 1;
          line.points.push_back(
              {double(frame), numbers[i], numbers[i], {each, each, each}, failed, 1});
        }
      }
    }
    for (const auto& [name, of_pair] : lines)
      for (std::size_t i = 0; i < 3; ++i) results[i].series.push_back(of_pair[i]);
  }
  return results;
}

}  // namespace contactscope
