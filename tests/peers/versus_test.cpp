#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "app/program.h"

/// Bullet, ODE and FCL as programs that are asked.
namespace contactscope::test {
namespace {

using Json = nlohmann::json;

Json versus(const std::string& arguments) {
  const ProgramRun result = run("versus --table --json --engines bullet,ode,fcl " + arguments);
  const Json json = Json::parse(result.out, nullptr, false);
  if (!json.is_discarded()) return json["matches"][0]["engines"];
  ADD_FAILURE() << result.err;
  return Json::array();
}

TEST(VersusPeers, ABoxOnABox) {
  const Json engines = versus("hull/eight_points_to_four --frames 0:40:4");
  ASSERT_EQ(engines.size(), 3u);
  for (const Json& engine : engines) {
    SCOPED_TRACE(engine["name"]);
    EXPECT_EQ(engine["pairs"], 5);
    EXPECT_EQ(engine["missed"], 0);
    EXPECT_EQ(engine["invented"], 0);
    EXPECT_LT(engine["depth_error"]["worst"], 1e-5);
  }
}

TEST(VersusPeers, Spheres) {
  for (const Json& engine : versus("round/sphere_sphere")) {
    EXPECT_EQ(engine["missed"], 0) << engine["name"];
    EXPECT_LT(engine["depth_error"]["worst"], 1e-5) << engine["name"];
  }
}

#ifdef CONTACTSCOPE_HAS_MUJOCO
/// Fixed in 3.4: of two boxes it told half of the overlap for years.
TEST(VersusPeers, HalfOverlapsOfMuJoCoAreNamed) {
  const ProgramRun result =
      run("versus --table --json --engines mujoco hull/eight_points_to_four plane/box_corners");
  const Json json = Json::parse(result.out, nullptr, false);
  ASSERT_FALSE(json.is_discarded()) << result.err;
  const Json& boxes = json["matches"][0]["engines"][0];
  EXPECT_EQ(boxes["missed"], 0);
  ASSERT_EQ(boxes["findings"].size(), boxes["version"] < "3.4" ? 1u : 0u) << boxes["findings"];
  if (!boxes["findings"].empty()) {
    EXPECT_EQ(boxes["findings"][0]["cause"], "half_depths");
  }
  const Json& plane = json["matches"][1]["engines"][0];
  EXPECT_LT(plane["depth_error"]["worst"], 1e-6);
  EXPECT_TRUE(plane["findings"].empty());
}
#endif

}  // namespace
}  // namespace contactscope::test
