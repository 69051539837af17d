#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "scenario/run.h"
#include "trace/find.h"

namespace contactscope::trace {
namespace {

/// Points whose generated id, after the pipeline's ids were removed, equals the pipeline's.
struct Agreement {
  int same = 0, of = 0;
};

constexpr int kEvery = 10;  // only every tenth frame of a scenario, because little is new between

/// By kind of pair and axis.
using Agreements = std::map<std::string, Agreement>;

/// Removes facts that other engines do not record.
void take_ids_away(Frame& frame) {
  for (Pair& pair : frame.pairs)
    for (Manifold& manifold : pair.manifolds) {
      manifold.axis.clear();
      for (Point& point : manifold.points) point.id.clear();
    }
}

/// Compares a frame with its copy whose ids were generated.
void compare(const Frame& ours, const Frame& made_up, Agreements& all) {
  for (std::size_t p = 0; p < ours.pairs.size(); ++p) {
    const Pair& pair = ours.pairs[p];
    // A field has no features; a confirmed point keeps the id of the frame in which it was found.
    if (pair.kind.find("sdf") != std::string::npos || pair.incremental) continue;
    for (std::size_t m = 0; m < pair.manifolds.size(); ++m) {
      const Manifold& manifold = pair.manifolds[m];
      // The names are numbered within the nearest triangle, the pipeline's within the mesh.
      if (pair.kind.find("mesh") != std::string::npos && !manifold.triangle) continue;
      Agreement& agreement = all[pair.kind + " " + manifold.axis];
      for (std::size_t i = 0; i < manifold.points.size(); ++i) {
        ++agreement.of;
        agreement.same += made_up.pairs[p].manifolds[m].points[i].id == manifold.points[i].id;
      }
    }
  }
}

TEST(PointNames, SlowAgreeWithThePipelineInNinetyNineOfAHundred) {
  Agreements all;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(CONTACTSCOPE_SOURCE_DIR "/scenarios")) {
    if (entry.path().extension() != ".toml") continue;
    const Scenario scenario = load_scenario(entry.path());
    Runner runner(scenario);
    std::vector<Shape> shapes = runner.header().shapes;
    for (int number = 0; number < scenario.frames; ++number) {
      const Frame frame = runner.frame(number);
      shapes.insert(shapes.end(), frame.shapes.begin(), frame.shapes.end());
      if (number % kEvery != 0) continue;
      Frame named = frame;
      take_ids_away(named);
      name_points(shapes, named);
      compare(frame, named, all);
    }
  }
  Agreement sum;
  std::string others;
  for (const auto& [kind, agreement] : all) {
    sum.same += agreement.same;
    sum.of += agreement.of;
    if (agreement.same < agreement.of)
      others += "\n" + kind + ": " + std::to_string(agreement.same) + " of " +
                std::to_string(agreement.of);
  }
  EXPECT_GE(sum.of, 4000);
  EXPECT_GE(sum.same, 0.99 * sum.of) << sum.same << " of " << sum.of << others;
}

}  // namespace
}  // namespace contactscope::trace
