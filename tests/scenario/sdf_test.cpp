#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

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

TEST(Sdf, IsSlicedWhereAViewShowsIt) {
  const auto frame_of = [](const std::string& views) {
    const Scenario scenario = parse_scenario(kBoxOnField + views, "field/a.toml");
    return Runner(scenario).frame(0);
  };
  const trace::Frame plain = frame_of("");
  EXPECT_TRUE(plain.field_slices.empty());
  EXPECT_FALSE(plain.pairs.at(0).field_probes);

  const trace::Frame frame = frame_of("[[views]]\nlayers = [\"field\"]\n");
  ASSERT_EQ(frame.field_slices.size(), 1U);
  const trace::FieldSlice& slice = frame.field_slices[0];
  EXPECT_EQ(slice.name, "floor");
  EXPECT_NEAR(slice.cell, 2.0 / 24, 1e-12);
  ASSERT_EQ(slice.rows() * slice.columns, count_of(slice.distances));
  int before_faces = 0, inside = 0;
  for (int row = 0; row < slice.rows(); ++row) {
    for (int column = 0; column < slice.columns; ++column) {
      const Vec3d place = slice.origin + column * slice.next + row * slice.next_row;
      EXPECT_NEAR(place.z(), 0, 1e-12);
      // Distance from a box whose top is the ground.
      const Vec3d out = (place + Vec3d(0, 0.5, 0)).cwiseAbs() - Vec3d(1, 0.5, 1);
      const double truth = out.cwiseMax(0.0).norm() + std::min(out.maxCoeff(), 0.0);
      const double record = slice.cell * at(slice.distances, row * slice.columns + column);
      EXPECT_NEAR(record, truth, 0.5 * slice.cell) << place.transpose();
      // In front of a face, away from edges and the middle, distance and blending are linear.
      if (out.x() > -0.5 || std::abs(out.y()) > 0.3) continue;
      ++before_faces;
      inside += truth < 0 ? 1 : 0;
      EXPECT_NEAR(record, truth, 1e-3 * slice.cell) << place.transpose();
    }
  }
  EXPECT_GT(before_faces, 100);
  EXPECT_GT(inside, 30);
  // A dense field has nodes of its own everywhere, and this one uses no triangles.
  const int squares =
      static_cast<int>(std::lround(slice.next.norm() * (slice.columns - 1) * slice.next_row.norm() *
                                   (slice.rows() - 1) / (slice.cell * slice.cell)));
  EXPECT_EQ(count_of(slice.band), squares);
  EXPECT_TRUE(slice.exact.empty());

  const auto& probes = frame.pairs.at(0).field_probes;
  ASSERT_TRUE(probes);
  EXPECT_EQ(probes->method, "conservative");
  ASSERT_GE(probes->probes.size(), 4U);
  for (const trace::FieldProbe& probe : probes->probes)
    EXPECT_NEAR(probe.separation, probe.position.y(), 0.02);
}

TEST(Sdf, IsSlicedAcrossTheViewDirection) {
  const Scenario scenario = parse_scenario(
      kBoxOnField + "[[views]]\nlayers = [\"field\"]\neye = [0.2, 5, 0.1]\n", "field/a.toml");
  const trace::FieldSlice slice = Runner(scenario).frame(0).field_slices.at(0);
  EXPECT_GT(slice.next.cross(slice.next_row).y(), 0.99 * slice.next.norm() * slice.next_row.norm());
}

TEST(Sdf, MakesContactsOrAnswersQueries) {
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

TEST(Sdf, UnsupportedPairsAreRefusedWithTheReason) {
  const std::string pairs = "[[pairs]]\na = \"floor\"\nb = \"crate\"\n";
  EXPECT_THAT(complaint(kBoxOnField + pairs + "query = \"distance\"\n"), HasSubstr("margin"));
  EXPECT_THAT(complaint(kBoxOnField + pairs + "manifold = \"incremental\"\n"),
              HasSubstr("'floor' is a sdf"));
  const std::string sheet =
      "[shapes.sheet]\ntype = \"mesh\"\ngrid = { size = 2, cells = 4 }\nmotion.deform = { wave = { "
      "axis "
      "= [1, 0, 0], direction = [0, 1, 0], amplitude = 0.1, wavelength = 1, speed = 1 } }\n";
  EXPECT_THAT(complaint(kBoxOnField + sheet + "[[pairs]]\na = \"floor\"\nb = \"sheet\"\n" +
                        "continuous = \"time_of_impact\"\n"),
              HasSubstr("deforms between frames"));
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
        Broken{"OfIsAnSdf", sdf("{ type = \"sdf\" }"), "4:6", "'of' is a distance field already"},
        Broken{"OfHasAPlace", sdf("{ type = \"sphere\", radius = 1, position = [0, 0, 0] }"),
               "4:48", "remove 'position', or give it to the shape"},
        Broken{"APlane", sdf("{ type = \"plane\", normal = [0, 1, 0], offset = 0 }"), "4:6",
               "a plane is infinite"},
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
