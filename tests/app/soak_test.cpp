#include "app/soak.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/program.h"

namespace contactscope::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class SoakShards : public testing::Test {
 protected:
  ProgramRun part(int part, int of, const std::string& out, const std::string& more = "") const {
    return run("study stability --cases 900 --quiet --shard " + std::to_string(part) + "/" +
               std::to_string(of) + " --out '" + (folder_ / out) + "' " + more);
  }
  ProgramRun merge(const std::string& out) const {
    return run("merge '" + (folder_ / out) + "' --out '" + (folder_ / out) + "'");
  }
  std::string whole(const std::string& out) const {
    return read_text(folder_ / (out + "/study/stability/soak.json"));
  }

  TemporaryFolder folder_;
};

TEST_F(SoakShards, MergedTheyAreTheSameBytesForOneTwoAndFive) {
  std::string first;
  for (const int of : {1, 2, 5}) {
    const std::string out = std::to_string(of);
    for (int k = of; k >= 1; --k) EXPECT_EQ(part(k, of, out).exit_code, 0);
    const ProgramRun merged = merge(out);
    EXPECT_EQ(merged.exit_code, 0) << merged.err;
    EXPECT_THAT(merged.err, HasSubstr("1800 pairs judged, 0 wrong"));
    EXPECT_THAT(merged.out, HasSubstr("half within (ulps)"));
    if (first.empty()) first = whole(out);
    EXPECT_EQ(whole(out), first) << of;
  }
  const auto json = nlohmann::json::parse(first);
  EXPECT_EQ(json["schema"], "contactscope.soak/1");
  EXPECT_EQ(json["cases"], 900);
  EXPECT_FALSE(json.contains("shard"));
}

TEST_F(SoakShards, AnIncompleteSetIsRefused) {
  part(1, 3, "out");
  part(3, 3, "out");
  EXPECT_THAT(merge("out").err, HasSubstr("shard 2 of 3 is missing"));
  EXPECT_EQ(merge("out").exit_code, 2);
  part(2, 3, "out", "--seed 9");
  EXPECT_THAT(merge("out").err, HasSubstr("are of different soaks"));
  part(2, 3, "out");
  EXPECT_EQ(merge("out").exit_code, 0);
  folder_.write("out/soak_4_of_3.json", read_text(folder_ / "out/soak_1_of_3.json"));
  EXPECT_THAT(merge("out").err, HasSubstr("shard 1 of 3 is there twice"));
  folder_.write("out/soak_4_of_3.json", "{");
  EXPECT_THAT(merge("out").err, HasSubstr("run its shard again"));
}

TEST_F(SoakShards, OnlyStabilityHasParts) {
  EXPECT_THAT(run("study reducers --shard 1/2").err, HasSubstr("study reducers has no parts"));
  EXPECT_THAT(run("study reducers --cases 1000001").err, HasSubstr("is more than a study holds"));
}

/// A wrong result fails and is reported with the number of its case.
TEST_F(SoakShards, AWrongAnswerFails) {
  part(1, 1, "out");
  const std::string file = "out/soak_1_of_1.json";
  auto json = nlohmann::ordered_json::parse(read_text(folder_ / file));
  json["lines"][0]["faults"]["missing"] = 1;
  json["failures"].push_back({{"case", 42},
                              {"sweep", "tilt"},
                              {"pair", "box on box"},
                              {"scalar", "float"},
                              {"fault", "missing"},
                              {"value", 0.5},
                              {"ulps", 99}});
  folder_.write(file, json.dump());
  const ProgramRun merged = merge("out");
  EXPECT_EQ(merged.exit_code, 1);
  EXPECT_THAT(merged.out,
              HasSubstr("case 42: box on box in float, tilt 0.5: missing, off by 99 ulps"));
  EXPECT_THAT(merged.err, HasSubstr("1 wrong"));
}

TEST_F(SoakShards, CtrlCExitsWith130AndLeavesNoPart) {
  const ProgramRun result =
      run("study stability --shard 1/1 --cases 2000000000 --out '" + (folder_ / "out") + "'",
          "timeout -s INT --preserve-status 0.5");
  EXPECT_EQ(result.exit_code, 130);
  EXPECT_THAT(files_below(folder_ / "out"), IsEmpty());
}

}  // namespace
}  // namespace contactscope::test
