#include <gtest/gtest.h>

#include "app/catalogue.h"
#include "scenario/expect.h"
#include "scenario/run.h"
#include "trace/json.h"

namespace contactscope::test {
namespace {

const std::vector<std::string>& files() {
  static const std::vector<std::string> found =
      app::scenario_files(CONTACTSCOPE_SOURCE_DIR "/scenarios");
  return found;
}

class EveryScenario : public testing::TestWithParam<std::string> {};

TEST_P(EveryScenario, GivesTheSameManifoldsBitForBitWhetherRecordedOrNot) {
  const Scenario scenario = load_scenario(GetParam());
  const Runner runner(scenario);
  for (int number = 0; number < scenario.frames; ++number) {
    trace::Frame recorded = runner.frame(number);
    const trace::Frame unrecorded = runner.frame_unrecorded(number);
    for (trace::Pair& pair : recorded.pairs) {
      pair.sat.reset();
      pair.clip.reset();
      pair.reduction.reset();
      pair.cache.reset();
      pair.degenerate.reset();
      pair.gjk.reset();
      pair.tree.reset();
      pair.gjk.reset();
      pair.tree.reset();
      pair.degenerate.reset();
      if (pair.state == "separated") pair.separation = 0;  // only a record says how far
    }
    EXPECT_EQ(trace::to_json_line(recorded), trace::to_json_line(unrecorded));
  }
}

TEST_P(EveryScenario, MeetsItsExpectationsInEveryFrame) {
  const Scenario scenario = load_scenario(GetParam());
  EXPECT_FALSE(scenario.expectations.empty()) << "a scenario without a proof";
  const Runner runner(scenario);
  for (int number = 0; number < scenario.frames; ++number) {
    for (const std::string& sentence : unmet_expectations(scenario, runner.frame(number))) {
      ADD_FAILURE() << sentence;
    }
  }
}

TEST_P(EveryScenario, NamesItsSource) {
  EXPECT_FALSE(load_scenario(GetParam()).source.empty());
}

INSTANTIATE_TEST_SUITE_P(Scenarios, EveryScenario, testing::ValuesIn(files()),
                         [](const testing::TestParamInfo<std::string>& file) {
                           std::string name = file.param.substr(file.param.rfind('/') + 1);
                           return name.substr(0, name.rfind('.'));
                         });

TEST(Scenarios, AreThere) {
  EXPECT_GE(files().size(), 11u);
}

}  // namespace
}  // namespace contactscope::test
