#include "page/facts.h"

#include <gmock/gmock.h>

#include "draw/crate_on_slab.h"

namespace contactscope::page {
namespace {

using draw::crate_sample::CrateOnSlab;
using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;
using testing::SizeIs;

TEST(PointFacts, HaveGapOrOverlapAndNeverASign) {
  EXPECT_THAT(gap_row(-0.002), Pair("overlap", "2.00 mm"));
  EXPECT_THAT(gap_row(0.002), Pair("gap", "2.00 mm"));
  EXPECT_THAT(gap_row(0), Pair("gap", "0"));
}

TEST(PointFacts, NameFeaturesWithTheirShapes) {
  trace::Pair pair;
  pair.a = "table";
  pair.b = "crate";
  EXPECT_EQ(feature_words("a:e3 b:e7", pair), "edge 3 of table, edge 7 of crate");
  EXPECT_EQ(feature_words("b:v4", pair), "vertex 4 of crate");
  EXPECT_EQ(feature_words("a:f1 b:v12", pair), "face 1 of table, vertex 12 of crate");
  for (const char* opaque : {"17", "0x3f a:e3", "a:e", "a:ex b:e7", "a:q3"})
    EXPECT_EQ(feature_words(opaque, pair), opaque);
}

TEST(PointFacts, VectorsEndBeforeTheirNoise) {
  EXPECT_EQ(spell_vector({0, 1, 3e-9}), "(0, 1, 0)");
  EXPECT_EQ(spell_vector({-0.5, 0.25, 0}), "(−0.5, 0.25, 0)");
  EXPECT_EQ(spell_vector(Vec3d::Zero()), "(0, 0, 0)");
}

TEST(PointFacts, StandWhereThePointsArePainted) {
  CrateOnSlab scene;
  scene.solve(0.25);
  scene.view.layers = {Layer::Shapes, Layer::Contacts};
  const draw::Staging staging = scene.staged();
  const draw::Drawing drawing = draw::illustrate(staging, scene.frames[0]);
  const std::vector<PointFacts> points = point_facts(staging, scene.frames[0], drawing);
  ASSERT_THAT(points, SizeIs(2));
  for (const PointFacts& point : points) {
    const auto is_dot_there = [&](const draw::Primitive& primitive) {
      const auto* disc = std::get_if<draw::Disc>(&primitive);
      return disc != nullptr && distance(disc->center, point.at) < 0.5f;
    };
    EXPECT_TRUE(std::ranges::any_of(drawing.primitives, is_dot_there)) << point.name;
    EXPECT_TRUE(point.is_contact);
    EXPECT_THAT(point.layers, ElementsAre("contacts"));
    EXPECT_THAT(point.rows, Contains(Pair("overlap", "2.00 mm")));
    EXPECT_THAT(point.rows, Contains(Pair("impulse", "0.250 N s")));
  }
  EXPECT_EQ(points[1].name, "point 1");
  EXPECT_EQ(points[1].key, "slab|crate||b:v5");
  EXPECT_THAT(points[1].rows, Contains(Pair("made by", "vertex 5 of crate")));
}

TEST(PointFacts, AreThereOnlyWhereALayerShowsThem) {
  CrateOnSlab scene;
  scene.view.layers = {Layer::Shapes};
  const draw::Staging staging = scene.staged();
  const draw::Drawing drawing = draw::illustrate(staging, scene.frames[0]);
  EXPECT_THAT(point_facts(staging, scene.frames[0], drawing), IsEmpty());
}

TEST(AreaFacts, ShapesAreOutlinesNearestFirst) {
  CrateOnSlab scene;
  scene.solve(0.25);
  scene.view.layers = {Layer::Shapes};
  const draw::Staging staging = scene.staged();
  const draw::Drawing drawing = draw::illustrate(staging, scene.frames[0]);
  const std::vector<AreaFacts> areas = area_facts(staging, scene.frames[0], drawing);
  ASSERT_THAT(areas, SizeIs(2));
  EXPECT_EQ(areas[0].name, "crate");
  EXPECT_EQ(areas[0].polygon.size(), 6u);  // of a box seen from a corner
  EXPECT_THAT(areas[0].rows, Contains(Pair("shape", "box")));
  EXPECT_THAT(areas[0].rows, Contains(Pair("velocity", "(0.5, 0, 0) m/s")));
  EXPECT_EQ(areas[1].name, "slab");
}

TEST(AreaFacts, FacesHaveThemWhereShown) {
  CrateOnSlab scene;
  trace::Clip& clip = scene.pair().clip.emplace();
  clip.reference = {"slab", 2, Vec3d::UnitY(), {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}}};
  clip.incident = {
      "crate", 3, -Vec3d::UnitY(), {{-.5, 0, -.5}, {.5, 0, -.5}, {.5, 0, .5}, {-.5, 0, .5}}};
  const auto areas_with = [&](const std::vector<Layer>& layers) {
    scene.view.layers = layers;
    const draw::Staging staging = scene.staged();
    return area_facts(staging, scene.frames[0], draw::illustrate(staging, scene.frames[0]));
  };
  const std::vector<AreaFacts> both = areas_with({Layer::ReferenceFace, Layer::IncidentFace});
  ASSERT_THAT(both, SizeIs(2));
  EXPECT_EQ(both[0].name, "incident face");  // it is on the larger one
  EXPECT_THAT(both[0].rows, Contains(Pair("face", "3 of crate")));
  EXPECT_EQ(both[1].layer, "reference_face");
  EXPECT_THAT(areas_with({Layer::ReferenceFace}), SizeIs(1));
  EXPECT_THAT(areas_with({}), IsEmpty());
}

TEST(PairFacts, DistinguishTouchesFromPointsWithinTheMargin) {
  CrateOnSlab scene;
  scene.pair().separation = -0.002;
  EXPECT_THAT(pair_facts(scene.frames[0]).at(0).rows, Contains(Pair("state", "touching")));
  EXPECT_THAT(pair_facts(scene.frames[0]).at(0).rows, Contains(Pair("overlap", "2.00 mm")));
  EXPECT_THAT(pair_facts(scene.frames[0]).at(0).rows,
              Contains(Pair("normal", "(0, 1, 0), slab to crate")));
  scene.pair().separation = 0.004;
  EXPECT_THAT(pair_facts(scene.frames[0]).at(0).rows, Contains(Pair("state", "within the margin")));
  scene.pair().state = "separated";
  scene.pair().separation = -0.8;
  EXPECT_THAT(pair_facts(scene.frames[0]).at(0).rows,
              Contains(Pair("state", "overlapping, without contact")));
}

}  // namespace
}  // namespace contactscope::page
