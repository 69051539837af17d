#include <gmock/gmock.h>

#include "field/distance_field.h"
#include "scenario/broken.h"
#include "scenario/run.h"

namespace contactscope {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string kBoxOnField = R"(title = "A box on a field"
[shapes.floor]
type          = "sdf"
of            = { type = "box", half_extents = [1, 0.5, 1] }
cells         = 24
band          = "dense"
interpolation = "trilinear"
exact         = false
position      = [0, -0.5, 0]
[shapes.crate]
type         = "box"
half_extents = [0.3, 0.3, 0.3]
position     = [0, 0.29, 0]
)";

TEST(Sdf, IsReadWithItsSettings) {
  const Scenario scenario = parse_scenario(kBoxOnField, "field/a.toml");
  const auto& field = std::get<Field<double>>(*scenario.shapes[0].geometry);
  const FieldSettings& settings = field.values->settings();
  EXPECT_EQ(settings.cells, 24);
  EXPECT_EQ(settings.band, 0);
  EXPECT_EQ(settings.interpolation, FieldInterpolation::Trilinear);
  EXPECT_FALSE(settings.exact);
  EXPECT_NEAR(PlacedField::of(field).exact(Vec3d(0, 0.7, 0)).distance, 0.2, 1e-15);
}

TEST(Sdf, StandsInTheTraceAsTheShapeThatItIsMadeOf) {
  const Scenario scenario = parse_scenario(kBoxOnField, "field/a.toml");
  const trace::Header header = Runner(scenario).header();
  EXPECT_EQ(header.shapes[0].type, "sdf");
  EXPECT_EQ(header.shapes[0].vertices.size(), 8U);
  EXPECT_EQ(header.shapes[0].faces.size(), 6U);
}

TEST(Sdf, MakesContactsOrAnswersWhatItIsAsked) {
  const auto pair_with = [](const std::string& pipeline) {
    const Scenario scenario = parse_scenario(kBoxOnField + pipeline, "field/a.toml");
    return Runner(scenario).frame(0).pairs.at(0);
  };
  const trace::Pair touching = pair_with("");
  EXPECT_EQ(touching.kind, "sdf-hull");
  EXPECT_EQ(touching.state, "touching");
  ASSERT_EQ(touching.manifolds.size(), 1U);
  EXPECT_EQ(touching.manifolds[0].points.size(), 4U);
  EXPECT_NEAR(touching.separation, -0.01, 1e-4);
  EXPECT_TRUE(pair_with("[pipeline]\nquery = \"overlap\"\n").overlap.value());
  EXPECT_EQ(pair_with("[pipeline]\nfield = \"sampled\"\n").state, "touching");
}

TEST(Sdf, PairsThatCannotBeAskedAreRefusedWithTheReason) {
  const std::string pairs = "[[pairs]]\na = \"floor\"\nb = \"crate\"\n";
  EXPECT_THAT(complaint(kBoxOnField + pairs + "query = \"distance\"\n"), HasSubstr("margin"));
  EXPECT_THAT(complaint(kBoxOnField + pairs + "manifold = \"incremental\"\n"),
              HasSubstr("'floor' is a sdf"));
  const std::string another =
      "[shapes.rock]\ntype = \"sdf\"\ncells = 8\nof = { type = \"sphere\", radius = 0.3 }\n";
  EXPECT_THAT(complaint(kBoxOnField + another + "[[pairs]]\na = \"floor\"\nb = \"rock\"\n" +
                        "continuous = \"time_of_impact\"\n"),
              HasSubstr("distance field"));
}

class BrokenSdf : public ::testing::TestWithParam<Broken> {};

TEST_P(BrokenSdf, IsNamedByPlaceAndRemedy) {
  const std::string message = complaint(GetParam().text);
  EXPECT_THAT(message, StartsWith(std::string("group/idea.toml:") + GetParam().location + ": "));
  EXPECT_THAT(message, HasSubstr(GetParam().remedy));
}

std::string sdf(const std::string& of, const std::string& rest = "") {
  return one_shape("type = \"sdf\"\nof = " + of + "\n" + rest);
}
const char* const kBall = "{ type = \"sphere\", radius = 1 }";

INSTANTIATE_TEST_SUITE_P(
    Sdf, BrokenSdf,
    ::testing::Values(
        Broken{"NothingToBeMadeOf", one_shape("type = \"sdf\""), "2:1", "missing key 'of'"},
        Broken{"OfIsAName", sdf("\"box\""), "4:6", "written inline"},
        Broken{"OfHasNoType", sdf("{ radius = 1 }"), "4:6", "missing key 'type'"},
        Broken{"OfIsAnSdf", sdf("{ type = \"sdf\" }"), "4:15", "unknown shape type 'sdf'"},
        Broken{"OfHasAPlace", sdf("{ type = \"sphere\", radius = 1, position = [0, 0, 0] }"),
               "4:37", "unknown key 'position'"},
        Broken{"APlane", sdf("{ type = \"plane\", normal = [0, 1, 0], offset = 0 }"), "4:6",
               "a plane has no end"},
        Broken{"AnOpenSheet", sdf("{ type = \"mesh\", grid = { size = 1, cells = 2 } }"), "4:6",
               "the mesh has no inside"},
        Broken{"NoCells", sdf(kBall, "cells = 1"), "5:9", "2 to 4096"},
        Broken{"TooManyCells", sdf(kBall, "cells = 4096"), "4:6", "21651489232 bytes"},
        Broken{"NoBand", sdf(kBall, "band = 0"), "5:8", "1 to 64"},
        Broken{"UnknownBand", sdf(kBall, "band = \"wide\""), "5:8", "'dense'"},
        Broken{"UnknownInterpolation", sdf(kBall, "interpolation = \"cubc\""), "5:17",
               "did you mean 'cubic'"}),
    name_of_test);

}  // namespace
}  // namespace contactscope
