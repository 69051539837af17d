#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/program.h"

namespace contactscope::test {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;

/// A scenario of a crate on a slab; tests change only `crate`.
std::string on_a_slab(const std::string& slab, const std::string& crate,
                      const std::string& preference) {
  return "title = \"A crate on a slab\"\n[time]\nframes = 1\n[pipeline]\ncache = false\n"
         "preference = \"" +
         preference + "\"\n[shapes.slab]\ntype = \"box\"\n" + slab +
         "\n[shapes.crate]\ntype = \"box\"\n" + crate + "\n[snapshots]\nframes = [0]\n";
}

/// The sentence of `check` about a scenario that was stored and then changed.
std::string record(const std::string& stored, const std::string& now) {
  const TemporaryFolder folder;
  const auto check = [&](const std::string& scenario, const std::string& arguments) {
    folder.write("scenarios/group/idea.toml", scenario);
    return run("check --facts-only --scenarios '" + (folder / "scenarios") + "' --snapshots '" +
                   (folder / "snapshots") + "' --out '" + (folder / "out") + "' " + arguments,
               "CI=");
  };
  EXPECT_EQ(check(stored, "--write-missing").exit_code, 0);
  const ProgramRun result = check(now, "--json --quiet");
  EXPECT_EQ(result.exit_code, 1) << result.err;
  const auto found = nlohmann::json::parse(result.out);
  return found["scenarios"][0]["findings"][0]["sentence"];
}

std::string tilted(const std::string& degrees, const std::string& preference) {
  return on_a_slab("half_extents = [0.5, 0.15, 0.5]\nposition = [-0.06, -0.15, 0.0]",
                   "half_extents = [0.5, 0.3, 0.5]\nposition = [0.0, 0.294, 0.0]\n"
                   "rotation = { axis = [0, 0, 1], degrees = " +
                       degrees + " }",
                   preference);
}

TEST(AHair, TurnsTheAxis) {
  EXPECT_THAT(
      record(tilted("0.003", "none"), tilted("-0.003", "none")),
      AllOf(HasSubstr("group/idea frame 0, crate: turned by 0.006 degrees; so for slab-crate the "
                      "separating axis test now prefers face b: -6.0231 mm against -6.0262 mm "
                      "of face a, a tie of 3.11 um"),
            HasSubstr("; with it the reference face, the incident face, 4 clip steps"),
            HasSubstr("4 of 4 ids changed")));
}

TEST(AHair, WithAPreferenceFlipsNothing) {
  EXPECT_THAT(record(tilted("0.003", "relative"), tilted("-0.003", "relative")),
              AllOf(HasSubstr("crate: turned by 0.006 degrees; so 3 axis queries"),
                    testing::Not(HasSubstr("now prefers"))));
}

TEST(AHair, TurnsTheIncidentFace) {
  const auto on_edge = [](const std::string& degrees) {
    return on_a_slab("half_extents = [1.0, 0.15, 1.0]\nposition = [0.0, -0.15, 0.0]",
                     "half_extents = [0.3, 0.3, 0.3]\nposition = [0.0, 0.4, 0.0]\n"
                     "rotation = { axis = [0, 0, 1], degrees = " +
                         degrees + " }",
                     "relative");
  };
  EXPECT_THAT(record(on_edge("45.003"), on_edge("44.997")),
              ContainsRegex("so for slab-crate the incident face is now face [0-9] instead of face "
                            "[0-9], with 7.4e-05 of a cosine to spare; with it "));
}

TEST(AHair, TurnsThePointsThatAreKept) {
  const auto turned = [](const std::string& degrees) {
    return on_a_slab("half_extents = [1.0, 0.15, 1.0]\nposition = [0.0, -0.15, 0.0]",
                     "half_extents = [0.5, 0.3, 0.5]\nposition = [0.7, 0.294, 0.7]\n"
                     "rotation = { axis = [0, 1, 0], degrees = " +
                         degrees + " }",
                     "relative");
  };
  EXPECT_THAT(
      record(turned("45.003"), turned("44.997")),
      ContainsRegex("the reduction now keeps points [0-9 ]+ instead of [0-9 ]+, with [0-9]+ "
                    "mm.2 to spare; with it 4 points"));
}

TEST(AHair, MakesThemTouch) {
  const auto above = [](const std::string& height) {
    return on_a_slab("half_extents = [1.0, 0.15, 1.0]\nposition = [0.0, -0.15, 0.0]",
                     "half_extents = [0.3, 0.3, 0.3]\nposition = [0.0, " + height + ", 0.0]",
                     "relative");
  };
  EXPECT_THAT(
      record(above("0.30001"), above("0.29999")),
      HasSubstr("for slab-crate the shapes are now touching instead of separated, with 10 um "
                "to spare"));
}

}  // namespace
}  // namespace contactscope::test
