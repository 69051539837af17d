#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/program.h"

// `why`: the chain of decisions in words, against the facts that `trace` prints.
namespace contactscope::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

/// The last frame that `trace` prints.
json facts_of(const std::string& arguments) {
  const std::string out = run("trace " + arguments).out;
  const std::size_t last = out.rfind('\n', out.size() - 2);
  return json::parse(out.substr(last + 1));
}

/// "12.0 mm" for 0.012, for lengths that are spelled in millimetres.
std::string millimetres_of(double metres) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", 1e3 * std::abs(metres));
  return text;
}

TEST(Why, StatesWhatTheTraceSaysOfEachStage) {
  const json facts = facts_of("hull/face_contact --frames 12"), &pair = facts["pairs"][0];
  const ProgramRun result = run("why hull/face_contact --frames 12");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("Frame 12, table and crate: touching"));
  const json &sat = pair["sat"], &clip = pair["clip"];
  for (const char* side : {"face_a", "face_b"})
    EXPECT_THAT(result.out,
                HasSubstr("face " + sat[side]["face"].dump() + " of " +
                          std::string(side == std::string("face_a") ? pair["a"] : pair["b"]) +
                          ", −" + millimetres_of(sat[side]["separation"])));
  EXPECT_THAT(result.out, HasSubstr("Taken: the faces of table"));
  EXPECT_THAT(result.out, HasSubstr("Face " + clip["incident"]["face"].dump() +
                                    " of crate is turned against face " +
                                    clip["reference"]["face"].dump() + " of table"));
  std::string corners =
      "Its " + std::to_string(clip["incident"]["polygon"].size()) + " corners become";
  for (const json& step : clip["steps"])
    corners +=
        (&step == &clip["steps"].front() ? " " : ", ") + std::to_string(step["polygon"].size());
  EXPECT_THAT(result.out, HasSubstr(corners + " at " + std::to_string(clip["steps"].size())));
  const json& points = pair["manifolds"][0]["points"];
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_THAT(result.out, HasSubstr("Point " + std::to_string(i) + ": edge "));
  EXPECT_THAT(result.out, Not(HasSubstr("Point " + std::to_string(points.size()) + ":")));
}

TEST(Why, NamesTheRuleOfEachKeptPointAndItsMargin) {
  const json facts = facts_of("hull/eight_points_to_four --frames 9"), &pair = facts["pairs"][0];
  const ProgramRun result = run("why hull/eight_points_to_four --frames 9 --point 2");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("8 points to 4 by area"));
  const json& kept = pair["reduction"]["kept"];
  ASSERT_EQ(kept.size(), 4u);
  const char* const rules[] = {" first, farthest along a fixed direction",
                               " second, farthest from the first", " third, largest triangle",
                               " fourth, adds the largest area"};
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_THAT(result.out, HasSubstr("point " + kept[k].dump() + rules[k]));
  for (const json& decision : pair["decisions"])
    EXPECT_THAT(result.out, HasSubstr(" before " + std::string(decision["over"]) +
                                      (decision["stage"] == "point 3" ? "\n" : "")))
        << decision;
  EXPECT_THAT(result.out, HasSubstr("Point 2: "));
  EXPECT_THAT(result.out, Not(HasSubstr("Point 1: ")));
}

TEST(Why, ExplainsQueriesMeshesAndOtherEngines) {
  EXPECT_THAT(run("why query/v_clip").out, HasSubstr("V-Clip compared "));
  EXPECT_THAT(run("why mesh/one_manifold").out, HasSubstr("became one manifold"));
  EXPECT_THAT(run("why scenarios/heap/bullet_twenty.jsonl").out,
              HasSubstr("The trace has no stages of this pair"));
}

TEST(Why, RefusesWhatIsNotThere) {
  const auto refusal = [](const std::string& arguments) {
    const ProgramRun result = run("why " + arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    return result.err;
  };
  EXPECT_THAT(refusal("hull/face_contact --pair table,creat"),
              HasSubstr("there is no shape 'creat'; known: 'table'"));
  EXPECT_THAT(refusal("hull/face_contact --frames 12 --point 40"), HasSubstr("points, from 0"));
  EXPECT_THAT(refusal("hull"), HasSubstr("one scenario"));
}

}  // namespace
}  // namespace contactscope::test
