#include "vector/pieces.h"

#include <gmock/gmock.h>

namespace contactscope::vector {
namespace {

using draw::Drawing;
using draw::Fill;
using draw::Stroke;

constexpr Color kRed{1, 0, 0, 1}, kGlass{1, 0, 0, 0.5f}, kBlue{0, 0, 1, 1};

Drawing canvas(std::vector<draw::Primitive> primitives) {
  Drawing drawing{.width = 100, .height = 80};
  drawing.primitives = std::move(primitives);
  return drawing;
}

Fill box(float left, float top, float right, float bottom, const Color& color) {
  return {{{left, top}, {right, top}, {right, bottom}, {left, bottom}}, color};
}

Stroke stroke(const Point2& from, const Point2& to, Cap cap = Cap::Round) {
  return {from, to, 2, kRed, cap};
}

std::vector<Piece> pieces_of(const Drawing& drawing) {
  std::vector<Piece> all;
  for (const Group& group : groups_of(drawing))
    all.insert(all.end(), group.pieces.begin(), group.pieces.end());
  return all;
}

TEST(Pieces, NothingOutsideTransparentOrEmptyIsLeft) {
  const Drawing drawing = canvas({
      box(10, 10, 20, 20, kRed),          // the only visible one
      box(-30, 10, -10, 20, kRed),        // left of the canvas
      box(10, 90, 20, 95, kRed),          // below it
      box(10, 10, 20, 20, {1, 0, 0, 0}),  // transparent
      Fill{{{1, 1}, {2, 2}}, kRed},       // no area
      Stroke{{5, 5}, {5, 5}, 2, kRed},    // no length
      Stroke{{5, 5}, {9, 5}, 0, kRed},    // no width
      Disc{{50, 50}, 4, 4, kRed},         // a ring of no width
      Text{"", {50, 50}, 14},             // no letters
      Disc{{120, 50}, 0, 4, kRed},        // right of it
  });
  const std::vector<Piece> pieces = pieces_of(drawing);
  ASSERT_EQ(pieces.size(), 1u);
  const std::vector<Point2> polygon = std::get<FillPath>(pieces[0]).polygons.at(0);
  EXPECT_THAT(polygon, testing::UnorderedElementsAre(Point2{10, 10}, Point2{20, 10}, Point2{20, 20},
                                                     Point2{10, 20}));
}

TEST(Pieces, ShapesThatTouchTheCanvasStay) {
  const std::vector<Piece> pieces = pieces_of(canvas({
      Disc{{103, 50}, 0, 4, kRed},                                          // a pixel of it shows
      Text{"a", {-4, 40}, 14},                                              // half of the letter
      Text{.text = "a", .at = {50, 40}, .color = {0, 0, 0, 0}, .halo = 2},  // the halo alone
      Stroke{{50, 50}, {50, 50}, 2, kRed, Cap::Round},                      // a dot
      box(20, 20, 60, 60, kBlue),  // over the letter and the dot
  }));
  EXPECT_EQ(pieces.size(), 5u);
}

TEST(Pieces, NeighboursOfOneColourAreOnePath) {
  const std::vector<Piece> pieces =
      pieces_of(canvas({box(10, 10, 20, 20, kGlass), box(20, 10, 30, 20, kGlass),
                        box(25, 15, 35, 25, kGlass), box(40, 10, 50, 20, kBlue)}));
  // The third overlaps the second, and is translucent.
  ASSERT_EQ(pieces.size(), 3u);
  EXPECT_EQ(std::get<FillPath>(pieces[0]).polygons.size(), 2u);
  EXPECT_EQ(std::get<FillPath>(pieces[1]).polygons.size(), 1u);
  EXPECT_EQ(std::get<FillPath>(pieces[2]).color.b, 1);
}

TEST(Pieces, OpaquePolygonsJoinForAnyWinding) {
  Fill turned = box(15, 15, 30, 30, kRed);
  std::ranges::reverse(turned.polygon);
  const std::vector<Piece> pieces = pieces_of(canvas({box(10, 10, 20, 20, kRed), turned}));
  ASSERT_EQ(pieces.size(), 1u);
  // All have one winding, so a path filled by the rule "nonzero" has no hole where they overlap.
  for (const std::vector<Point2>& polygon : std::get<FillPath>(pieces[0]).polygons)
    EXPECT_GT(cross(polygon[1] - polygon[0], polygon[2] - polygon[1]), 0);
}

TEST(Pieces, FillsEndWhereTheCanvasDoes) {
  const std::vector<Piece> pieces = pieces_of(canvas({box(-50, -50, 30, 300, kRed)}));
  for (const Point2& corner : std::get<FillPath>(pieces.at(0)).polygons.at(0)) {
    EXPECT_GE(corner.x, 0);
    EXPECT_GE(corner.y, 0);
    EXPECT_LE(corner.y, 80);
  }
}

TEST(Pieces, StrokesThatMeetAreOneLine) {
  const std::vector<Piece> pieces =
      pieces_of(canvas({stroke({10, 10}, {30, 10}), stroke({30, 10}, {30, 30}),
                        stroke({30, 30}, {10, 10}), stroke({50, 50}, {60, 50})}));
  ASSERT_EQ(pieces.size(), 1u);
  const auto& path = std::get<StrokePath>(pieces[0]);
  ASSERT_EQ(path.lines.size(), 2u);
  EXPECT_TRUE(path.lines[0].closed);
  EXPECT_THAT(path.lines[0].points,
              testing::ElementsAre(Point2{10, 10}, Point2{30, 10}, Point2{30, 30}));
  EXPECT_FALSE(path.lines[1].closed);
}

TEST(Pieces, ACurveOfFlatEndsThatOverlapIsOneLine) {
  // As compose() draws pieces of curves: a quarter of a pixel longer at both ends.
  const std::vector<Piece> pieces = pieces_of(canvas(
      {stroke({10, 10}, {30.25f, 10}, Cap::Butt), stroke({29.75f, 10}, {50, 14}, Cap::Butt)}));
  ASSERT_EQ(pieces.size(), 1u);
  const auto& lines = std::get<StrokePath>(pieces[0]).lines;
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_THAT(lines[0].points,
              testing::ElementsAre(Point2{10, 10}, Point2{30, 10}, Point2{50, 14}));
}

TEST(Pieces, DashesContinueOrRestart) {
  const auto dashed = [](const Point2& from, const Point2& to, float phase) {
    return Stroke{from, to, 2, kRed, Cap::Butt, 6, 4, phase};
  };
  // After 15 pixels, the pattern of 10 is at 5.
  const std::vector<Piece> running =
      pieces_of(canvas({dashed({10, 10}, {25, 10}, 0), dashed({25, 10}, {40, 10}, 15)}));
  ASSERT_EQ(running.size(), 1u);
  EXPECT_EQ(std::get<StrokePath>(running[0]).lines.size(), 1u);
  const std::vector<Piece> again =
      pieces_of(canvas({dashed({10, 10}, {25, 10}, 0), dashed({25, 10}, {40, 10}, 0)}));
  ASSERT_EQ(again.size(), 1u);
  EXPECT_EQ(std::get<StrokePath>(again[0]).lines.size(), 2u);
  const std::vector<Piece> separation =
      pieces_of(canvas({dashed({10, 10}, {25, 10}, 0), dashed({10, 20}, {25, 20}, 3)}));
  EXPECT_EQ(separation.size(), 2u);
}

TEST(Pieces, ADashedLineFromFarOutsideKeepsItsDashes) {
  const std::vector<Piece> pieces =
      pieces_of(canvas({Stroke{{-1000, 40}, {50, 40}, 2, kRed, Cap::Butt, 6, 4, 0}}));
  const auto& path = std::get<StrokePath>(pieces.at(0));
  const float begin = path.lines.at(0).points.at(0).x;
  EXPECT_GT(begin, -10);
  EXPECT_NEAR(path.phase, begin + 1000, 1e-3);
}

TEST(Pieces, TextStandsOnWholeRowsAndQuartersOfColumns) {
  const Text text{"ab", {20.3f, 30.6f}, 14, draw::Weight::Regular, draw::Align::Left};
  EXPECT_EQ(placed(text).left, (Point2{20.25f, 31}));
}

TEST(Pieces, GroupsFollowTheParts) {
  Drawing drawing = canvas({});
  drawing.begin("shapes", {}, "surface");
  drawing.primitives.push_back(box(10, 10, 20, 20, kRed));
  drawing.begin("contacts", "a b", "mark");
  drawing.primitives.push_back(Disc{{500, 500}, 0, 4, kRed});  // outside
  drawing.begin("title");
  drawing.primitives.push_back(box(20, 10, 30, 20, kRed));
  const std::vector<Group> groups = groups_of(drawing);
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0].part->layer, "shapes");
  EXPECT_EQ(groups[1].part->layer, "title");
}

}  // namespace
}  // namespace contactscope::vector
