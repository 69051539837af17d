// Pictures of a distance field, from facts by hand.

#include <algorithm>

#include <gmock/gmock.h>

#include "crate_on_slab.h"
#include "draw/scene/pairs.h"

namespace contactscope::draw {
namespace {

using crate_sample::CrateOnSlab;

/// Twelve by twelve cells of 10 cm around the origin, seen perpendicularly. The three columns on
/// the left have nodes of their own. The crate is 9 m away.
struct SlicedSlab : CrateOnSlab {
  SlicedSlab() {
    view.layers = {Layer::Field};
    view.eye = Vec3d(0, 0, 9);
    view.target = Vec3d(0, 0, 0);
    view.orthographic_height = 1.6;
    frames[0].pairs.clear();
    frames[0].poses[1].second.position.x() = 9;
    trace::FieldSlice slice;
    slice.name = "slab";
    slice.cell = 0.1;
    slice.origin = {-0.6, -0.6, 0};
    slice.next = {0.1, 0, 0};
    slice.next_row = {0, 0.1, 0};
    slice.columns = 13;
    for (int row = 0; row < 13; ++row)
      for (int column = 0; column < 13; ++column) slice.distances.push_back(column + 0.5);
    for (int row = 0; row < 12; ++row)
      for (int column = 0; column < 3; ++column) slice.band.push_back({column, row});
    frames[0].field_slices = {slice};
  }

  std::vector<Label> coarse() const {
    std::vector<Label> labels = sketch().labels;
    std::erase_if(labels, [](const Label& label) { return label.text != "blended here"; });
    return labels;
  }
};

TEST(FieldPicture, NamesTheGroundThatHasNoNodesOfItsOwn) {
  const SlicedSlab slab;
  const std::vector<Label> labels = slab.coarse();
  ASSERT_EQ(labels.size(), 1u);
  EXPECT_NEAR(labels[0].at.head<2>().norm(), 0, 1e-9) << "the middle of a large cell";
}

TEST(FieldPicture, CellsOfFarNodesAreLargeAndNoLinesGoAcrossThem) {
  SlicedSlab slab;
  const auto closed = [&] {
    const std::vector<Curve> curves = slab.sketch().curves;
    return std::ranges::count_if(curves, [](const Curve& curve) { return curve.closed; });
  };
  EXPECT_EQ(closed(), 2 * 3) << "the band reaches into the blocks on the left";
  EXPECT_EQ(slab.sketch().curves.size(), 6u) << "the surface is nowhere";
  slab.frames[0].field_slices[0].band.clear();
  EXPECT_EQ(closed(), 0);
  EXPECT_FALSE(slab.sketch().curves.empty()) << "lines of equal distance";
}

TEST(FieldPicture, NamesNoGroundWhereAllCellsHaveNodesOrTooFewHaveNone) {
  SlicedSlab slab;
  trace::FieldSlice& slice = slab.frames[0].field_slices[0];
  for (int row = 0; row < 12; ++row)
    for (int column = 3; column < 11; ++column) slice.band.push_back({column, row});
  EXPECT_TRUE(slab.coarse().empty());
  slice.band.clear();
  EXPECT_TRUE(slab.coarse().empty());
}

TEST(FieldPicture, NamesNoGroundOnAnotherShape) {
  SlicedSlab slab;
  slab.frames[0].poses[1].second.position = {0.2, 0, 0};  // the crate, as large as the slice
  EXPECT_TRUE(slab.coarse().empty());
}

TEST(FieldPicture, OnlyPartsThatTheFieldHasLostAreOutlined) {
  SlicedSlab slab;
  slab.view.layers = {Layer::Shapes, Layer::Field};
  const auto outlines = [&] {
    const std::vector<Curve> curves = slab.sketch().curves;
    return std::ranges::count_if(curves, [](const Curve& curve) {
      return curve.style.dashed && crate_sample::same(curve.style.color, kDropped);
    });
  };
  EXPECT_GT(outlines(), 0) << "the field is outside all over it";
  for (double& distance : slab.frames[0].field_slices[0].distances) distance = -0.5;
  EXPECT_EQ(outlines(), 0);
}

TEST(FieldPicture, ASlicedShapeHidesNothing) {
  SlicedSlab slab;
  slab.view.layers = {Layer::Shapes, Layer::Field};
  const std::size_t of_crate = slab.sketch().occluders.size();
  slab.frames[0].field_slices.clear();
  EXPECT_GT(slab.sketch().occluders.size(), of_crate);
}

TEST(FieldPicture, APointIsOnTheSurfaceOfTheFieldAndItsOverlapGoesInFromThere) {
  CrateOnSlab crate;
  const PairPoint first{&crate.manifold(), &crate.manifold().points[0]};
  const Vec3d at = first.point->position;
  const Staging staging = crate.staged();
  const auto ends = [&](const char* kind) {
    crate.pair().kind = kind;
    return surfaces_at(scene_of(staging, crate.frames[0]), crate.pair(), first);
  };
  EXPECT_EQ(ends("hull-sdf").on_b, at);
  EXPECT_NEAR((ends("hull-sdf").on_a - at).norm(), 0.002, 1e-9);
  EXPECT_EQ(ends("sdf-hull").on_a, at);
  EXPECT_NEAR((ends("sdf-hull").on_b - at).norm(), 0.002, 1e-9);
}

TEST(FieldPicture, AProbeOnAWhiskerHasNoMark) {
  SlicedSlab slab;
  slab.view.layers = {Layer::Field, Layer::Contacts};
  slab.frames[0].poses[1].second.position = {0, 0.3, 0};
  trace::Pair& pair = slab.frames[0].pairs.emplace_back(CrateOnSlab().pair());
  pair.manifolds[0].points = {{{0, -0.2, 0}, -0.1, "b:v4"}};
  pair.field_probes.emplace().probes = {{{0, -0.22, 0}, -0.1}, {{0.3, -0.22, 0}, 0.1}};
  const auto requested = [&] {
    std::vector<Mark> marks = slab.sketch().marks;
    std::erase_if(marks, [](const Mark& mark) { return mark.kind != MarkKind::Node; });
    return marks;
  };
  ASSERT_EQ(requested().size(), 1u);
  EXPECT_EQ(requested()[0].at.x(), 0.3);
  slab.view.layers = {Layer::Field};  // no whisker
  EXPECT_EQ(requested().size(), 2u);
  pair.field_probes->probes[0].position.z() = 0.2;
  EXPECT_EQ(requested().size(), 1u) << "two cells before the slice";
}

}  // namespace
}  // namespace contactscope::draw
