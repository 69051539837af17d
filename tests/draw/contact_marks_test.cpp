#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "draw/crate_on_slab.h"
#include "draw/scene/pairs.h"
#include "draw/scene/palette.h"
#include "image/font.h"

namespace contactscope::draw {
namespace {

using crate_sample::CrateOnSlab;
using ::testing::Contains;
using ::testing::HasSubstr;

/// Ends of the whiskers, those on A first.
std::vector<std::array<Vec3d, 2>> whiskers(const Sketch& sketch) {
  std::vector<std::array<Vec3d, 2>> ends;
  for (const Line& line : sketch.lines) {
    if (line.keep_clear && crate_sample::same(line.style.color, kContact))
      ends.push_back({line.from, line.to});
  }
  return ends;
}

std::size_t marks(const Sketch& sketch, MarkKind kind) {
  return static_cast<std::size_t>(
      std::ranges::count_if(sketch.marks, [&](const Mark& mark) { return mark.kind == kind; }));
}

std::vector<std::string> explained(const Sketch& sketch) {
  std::vector<std::string> all;
  for (const LegendEntry& entry : sketch.legend.sorted()) all.push_back(entry.text);
  return all;
}

std::vector<Arrow> measures(const Sketch& sketch) {
  std::vector<Arrow> found;
  std::ranges::copy_if(sketch.arrows, std::back_inserter(found),
                       [](const Arrow& arrow) { return crate_sample::same(arrow.color, kAxis); });
  return found;
}

/// A ball of 0.25 m, 0.2 m deep in the middle of the slab's top. The crate takes no part.
struct BallInSlab : CrateOnSlab {
  BallInSlab() {
    trace::Shape ball;
    ball.name = "ball";
    ball.type = "sphere";
    ball.radius = 0.25;
    ball.vertices = {Vec3d::Zero()};
    header.shapes.push_back(ball);
    Pose<double> pose;
    pose.position = {0, 0.05, 0};
    frames[0].poses.emplace_back("ball", pose);
    pair().b = "ball";
    pair().kind = "hull-sphere";
    manifold().points = {{Vec3d::Zero(), -0.2, "a:f2 b:v0"}};
    view.layers = {Layer::Shapes, Layer::Contacts, Layer::Normals};
  }
};

TEST(Whisker, BallWhiskerGoesFromFaceToDeepestPointShallowAndDeep) {
  for (const char* axis : {"closest_points", "face_a"}) {
    BallInSlab scene;
    scene.manifold().axis = axis;
    const auto ends = whiskers(scene.sketch());
    ASSERT_EQ(ends.size(), 1u) << axis;
    EXPECT_TRUE(ends[0][0].isZero(1e-12)) << axis;
    EXPECT_TRUE(ends[0][1].isApprox(Vec3d(0, -0.2, 0))) << axis;
  }
}

TEST(Whisker, BallAsShapeAEndsOnTheFaceOfB) {
  BallInSlab scene;
  std::swap(scene.pair().a, scene.pair().b);
  scene.manifold().axis = "closest_points";
  scene.manifold().normal = -Vec3d::UnitY();
  const Sketch sketch = scene.sketch();
  const auto ends = whiskers(sketch);
  ASSERT_EQ(ends.size(), 1u);
  EXPECT_TRUE(ends[0][0].isApprox(Vec3d(0, -0.2, 0)));
  EXPECT_TRUE(ends[0][1].isZero(1e-12));
  // It runs along the normal, which begins at its end.
  const auto normal = std::ranges::find_if(
      sketch.arrows, [](const Arrow& arrow) { return crate_sample::same(arrow.color, kNormal); });
  ASSERT_NE(normal, sketch.arrows.end());
  EXPECT_TRUE(normal->from.isApprox(Vec3d(0, -0.2, 0)));
}

TEST(Whisker, CapsulePastAnEdgeGoesFromTheEdgeToItsSurface) {
  BallInSlab scene;
  // The edge is at the origin, the capsule's axis 0.1 m below it: its surface is 0.35 m below.
  scene.manifold().axis = "edge_edge";
  scene.manifold().points = {{Vec3d(0, -0.05, 0), -0.35, "a:e1 b:e0"}};
  const auto ends = whiskers(scene.sketch());
  ASSERT_EQ(ends.size(), 1u);
  EXPECT_TRUE(ends[0][0].isZero(1e-12));
  EXPECT_TRUE(ends[0][1].isApprox(Vec3d(0, -0.35, 0)));
}

TEST(Whisker, HullEdgePairIsCentredOnItsMiddle) {
  CrateOnSlab scene;
  scene.view.layers = {Layer::Shapes, Layer::Contacts};
  scene.manifold().axis = "edge_edge";
  scene.manifold().points = {{Vec3d(0, -0.1, 0), -0.2, "a:e1 b:e0"}};
  const auto ends = whiskers(scene.sketch());
  ASSERT_EQ(ends.size(), 1u);
  EXPECT_TRUE(ends[0][0].isZero(1e-12));
  EXPECT_TRUE(ends[0][1].isApprox(Vec3d(0, -0.2, 0)));
}

/// Heights of the ends of all lines of a colour.
std::vector<double> heights_of(const Sketch& sketch, unsigned hex) {
  std::vector<double> heights;
  for (const Line& line : sketch.lines)
    if (crate_sample::same(line.style.color, rgb(hex)))
      heights.insert(heights.end(), {line.from.y(), line.to.y()});
  return heights;
}

// The colours as specified in the picture language, not by their names in the code.
TEST(Faces, TheReferenceFaceIsBlueAndTheIncidentOneOrange) {
  CrateOnSlab scene;
  trace::Clip& clip = scene.pair().clip.emplace();
  clip.reference = {"slab", 2, Vec3d::UnitY(), {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}}};
  clip.incident = {
      "crate", 3, -Vec3d::UnitY(), {{-0.5, -0.002, 0.5}, {0.5, -0.002, 0.5}, {0.5, -0.002, -0.5}}};
  scene.view.layers = {Layer::Shapes, Layer::ReferenceFace, Layer::IncidentFace};
  const Sketch sketch = scene.sketch();
  EXPECT_THAT(heights_of(sketch, 0x0072B2), testing::Each(testing::DoubleEq(0)));
  EXPECT_THAT(heights_of(sketch, 0xE69F00), testing::Each(testing::DoubleEq(-0.002)));
  EXPECT_EQ(heights_of(sketch, 0x0072B2).size(), 8u);
  EXPECT_EQ(heights_of(sketch, 0xE69F00).size(), 6u);
}

// Two crates share the slab's top as reference face, up to the last bits: one face, one tint.
TEST(Faces, OneThatTwoPairsShareIsTintedOnce) {
  CrateOnSlab scene;
  trace::Clip& clip = scene.pair().clip.emplace();
  clip.reference = {"slab", 2, Vec3d::UnitY(), {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}}};
  trace::Pair other = scene.pair();
  other.label = "other";
  other.clip->reference.polygon[0].x() -= 1e-7;
  scene.frames[0].pairs.push_back(other);
  scene.view.layers = {Layer::Shapes, Layer::ReferenceFace};
  const auto tinted = [&] {
    const Sketch sketch = scene.sketch();
    return std::ranges::count_if(sketch.surfaces, [](const Surface& surface) {
      return surface.kind == Surface::Kind::Ground;
    });
  };
  EXPECT_EQ(tinted(), 1);
  for (Vec3d& corner : scene.frames[0].pairs[1].clip->reference.polygon) corner.x() += 2.5;
  EXPECT_EQ(tinted(), 2) << "that of another slab";
}

/// The crate falls onto the slab from 1 m above it.
struct FallingCrate : CrateOnSlab {
  FallingCrate() {
    frames[0].poses[1].second.position = {0, 1.5, 0};
    pair().manifolds.clear();
    trace::Impact& impact = pair().impact.emplace();
    impact.method = "time_of_impact";
    impact.status = "hit";
    impact.time = 0.5;
    impact.travel_b = {{0, 1.5, 0}, {0, -2, 0}, Vec3d::Zero()};
    impact.distances = {{0, 1}, {0.5, 0}, {1, 0}};
    view.layers = {Layer::Sweep};
  }
};

TEST(Sweep, WhereItFirstMeetsABodyHasFaces) {
  const FallingCrate scene;
  const Sketch sketch = scene.sketch();
  ASSERT_FALSE(sketch.surfaces.empty());
  for (const Surface& face : sketch.surfaces)
    for (const Vec3d& corner : face.polygon)
      EXPECT_NEAR(std::abs(corner.y() - 0.5), 0.5, 1e-12);  // 1 m lower than it is now
}

// From frames alone, the end is seen only if the crate has passed through by then.
TEST(Sweep, ItsEndIsDrawnIfNotInTheNextFrame) {
  FallingCrate scene;
  const auto says = [&] { return explained(scene.sketch()); };
  EXPECT_THAT(says(), testing::Not(Contains(HasSubstr("if nothing stopped it"))));
  scene.pair().impact->distances.back().distance = 0.2;
  EXPECT_THAT(says(), Contains(HasSubstr("if nothing stopped it")));
}

// The path of the point that meets shows the turn; straight motion needs no arrow.
TEST(Sweep, ARotatingShapeShowsThePathOfItsHitPoint) {
  FallingCrate scene;
  const auto says = [&] { return explained(scene.sketch()); };
  EXPECT_THAT(says(), testing::Not(Contains("way of the point that meets")));
  scene.pair().impact->travel_b.turn = {0, 0, 1.5};
  EXPECT_THAT(says(), Contains("way of the point that meets"));
  const Sketch sketch = scene.sketch();
  ASSERT_EQ(sketch.arrows.size(), 1u);
  EXPECT_LT((*sketch.arrows[0].to - scene.pair().impact->point_a).norm(), 0.2);
}

// The arrow continues the motion of the middle; a turning body has no straight path.
TEST(Sweep, AnEndNotInTheNextFrameShowsItsDisplacement) {
  FallingCrate scene;
  scene.pair().impact->status = "separated";
  scene.pair().impact->distances.back().distance = 0.2;
  const auto tips = [&] {
    std::vector<Vec3d> all;
    for (const Arrow& arrow : scene.sketch().arrows) all.push_back(*arrow.to);
    return all;
  };
  ASSERT_EQ(tips().size(), 1u);
  EXPECT_LT((tips()[0] - Vec3d(0, -0.5, 0)).norm(), 1e-9);
  scene.pair().impact->travel_b.turn = {0, 0, 1.5};
  EXPECT_TRUE(tips().empty());
}

TEST(Sweep, SkinsBearTheNumbersOfTheStepsInTheChart) {
  FallingCrate scene;
  scene.pair().impact->travel_b.turn = {0, 0, 1.5};
  for (const double safe : {0.2, 0.35, 0.499})
    scene.pair().impact->steps.emplace_back().safe = safe;
  const auto numbers = [&] {
    std::vector<std::string> all;
    for (const Label& label : scene.sketch().labels) all.push_back(label.text);
    return all;
  };
  EXPECT_THAT(numbers(), testing::Not(Contains("2"))) << "without a chart they would mean nothing";
  scene.view.panels = {Panel::Approach};
  EXPECT_THAT(numbers(), testing::IsSupersetOf({"2", "3"}));
  EXPECT_THAT(numbers(), testing::Not(Contains("4"))) << "nearly where they meet";
}

/// A slice of a field 2 m wide, with cells of 0.1 m, through the view's middle: y < 0 is inside.
struct FieldOnSlab : CrateOnSlab {
  FieldOnSlab() {
    trace::FieldSlice slice;
    slice.name = "slab";
    slice.cell = 0.1;
    slice.origin = {-1, -1, 0};
    slice.next = {0.1, 0, 0};
    slice.next_row = {0, 0.1, 0};
    slice.columns = 21;
    for (int row = 0; row < 21; ++row)
      for (int column = 0; column < 21; ++column) slice.distances.push_back(row - 10);
    frames[0].field_slices = {slice};
    view.layers = {Layer::Field};
    view.eye = Vec3d(0, 0, 5);
    view.target = Vec3d::Zero();
  }
};

TEST(Field, LinesOfEqualDistanceNeedAViewThatHasRoomForSome) {
  FieldOnSlab scene;
  scene.view.orthographic_height = 4;
  EXPECT_THAT(explained(scene.sketch()), Contains(HasSubstr("lines every")));
  const std::size_t lines = scene.sketch().curves.size();
  scene.view.orthographic_height = 0.5;
  EXPECT_THAT(explained(scene.sketch()), testing::ElementsAre("surface of the field"));
  EXPECT_EQ(scene.sketch().curves.size(), 1u);
  EXPECT_GT(lines, 1u);
}

TEST(FlipDistance, IsAnArrowFromTheMiddleOfThePointsWithItsLength) {
  CrateOnSlab scene;
  scene.view.layers = {Layer::Shapes, Layer::FlipDistance};
  EXPECT_TRUE(scene.sketch().arrows.empty());
  trace::Flip& flip = scene.pair().flip.emplace();
  flip.offset = 3.2e-6;
  flip.direction = Vec3d::UnitX();
  const Sketch sketch = scene.sketch();
  ASSERT_EQ(sketch.arrows.size(), 1u);
  EXPECT_TRUE(sketch.arrows[0].from.isApprox(Vec3d(0, 0, 0.5)));
  EXPECT_TRUE(sketch.arrows[0].direction.isApprox(Vec3d::UnitX()));
  EXPECT_EQ(std::ranges::count(sketch.labels, "3.20 µm", &Label::text), 1);
  EXPECT_THAT(explained(sketch), Contains("smallest way of B to other points"));
}

TEST(Contacts, APointThatWasReducedAwayIsNoDot) {
  CrateOnSlab scene;
  trace::Reduction& reduction = scene.pair().reduction.emplace();
  reduction.points = scene.manifold().points;
  reduction.points.push_back({{0, 0, -0.5}, -0.002, "b:v6"});
  reduction.kept = {1, 0};
  scene.view.layers = {Layer::Shapes, Layer::Contacts};
  EXPECT_EQ(marks(scene.sketch(), MarkKind::Dot), 2u);
  EXPECT_EQ(marks(scene.sketch(), MarkKind::Cross), 0u);
  for (const bool contacts : {true, false}) {
    scene.view.layers = {Layer::Shapes, Layer::Reduced};
    if (contacts) scene.view.layers.push_back(Layer::Contacts);
    EXPECT_EQ(marks(scene.sketch(), MarkKind::Dot), 2u);  // within the rings, in either layer
    EXPECT_EQ(marks(scene.sketch(), MarkKind::Ring), 2u);
    EXPECT_EQ(marks(scene.sketch(), MarkKind::Cross), 1u);
  }
}

TEST(Contacts, APointWithinTheMarginLooksUnlikeOneThatTouches) {
  CrateOnSlab scene;
  scene.view.layers = {Layer::Shapes, Layer::Contacts};
  EXPECT_EQ(marks(scene.sketch(), MarkKind::Separation), 0u);
  scene.manifold().points[0].separation = 0.02;
  const Sketch sketch = scene.sketch();
  EXPECT_EQ(marks(sketch, MarkKind::Separation), 1u);
  EXPECT_EQ(marks(sketch, MarkKind::Dot), 1u);
  EXPECT_THAT(explained(sketch), Contains(HasSubstr("within the margin")));
}

TEST(Gap, SeparatedHullsShowTheSeparationFromFaceToCorners) {
  CrateOnSlab scene;
  scene.view.layers = {Layer::Shapes, Layer::Contacts};
  scene.frames[0].poses[1].second.position.y() = 0.8;
  scene.pair().state = "separated";
  scene.pair().separation = 0.3;
  scene.pair().manifolds.clear();
  trace::Sat& sat = scene.pair().sat.emplace();
  sat.chosen = "face_a";
  sat.face_a = trace::FaceAxis{2, 0.3, Vec3d::UnitY(), {-0.5, 0.3, -0.5}};
  const Sketch sketch = scene.sketch();
  const std::vector<Arrow> arrows = measures(sketch);
  ASSERT_EQ(arrows.size(), 1u);
  EXPECT_TRUE(arrows[0].double_headed);
  EXPECT_TRUE(arrows[0].from.isZero(1e-12));  // in the middle of the four lowest corners
  EXPECT_TRUE(arrows[0].to->isApprox(Vec3d(0, 0.3, 0)));
  EXPECT_TRUE(
      std::ranges::any_of(sketch.labels, [](const Label& l) { return l.text == "gap 300 mm"; }));
}

TEST(Gap, TooNarrowForAnArrowIsPointedAtFromBothSides) {
  CrateOnSlab scene;
  scene.view.layers = {Layer::Shapes, Layer::Contacts};
  scene.frames[0].poses[1].second.position.y() = 0.51;
  scene.pair().state = "separated";
  scene.pair().separation = 0.01;
  scene.pair().manifolds.clear();
  trace::Sat& sat = scene.pair().sat.emplace();
  sat.chosen = "face_a";
  sat.face_a = trace::FaceAxis{2, 0.01, Vec3d::UnitY(), {-0.5, 0.01, -0.5}};
  const std::vector<Arrow> arrows = measures(scene.sketch());
  ASSERT_EQ(arrows.size(), 2u);
  EXPECT_LT(arrows[0].from.y(), arrows[0].to->y());
  EXPECT_GT(arrows[1].from.y(), arrows[1].to->y());
  EXPECT_NEAR(arrows[1].to->y() - arrows[0].to->y(), 0.01, 1e-12);
}

TEST(PairLabel, StandsClearOfTheBodyThatItNames) {
  CrateOnSlab scene;
  scene.pair().label = "a label";
  scene.view.focus = Focus::Shapes;
  scene.view.layers = {Layer::Shapes};
  const Staging staging = scene.staged();
  const Drawing drawing = illustrate(staging, scene.frames[0]);
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
  for (const Vec3d& v : scene.header.shapes[1].vertices) {
    const Point2 at = *staging.camera.project(v + Vec3d(0, 0.498, 0));
    left = std::min<double>(left, at.x);
    right = std::max<double>(right, at.x);
    top = std::min<double>(top, at.y);
    bottom = std::max<double>(bottom, at.y);
  }
  int found = 0;
  for (const Primitive& primitive : drawing.primitives) {
    const Text* text = std::get_if<Text>(&primitive);
    if (text == nullptr || text->text != "a label") continue;
    ++found;
    const double end = text->at.x + text_width(text->text, text->size, FontWeight::Bold);
    EXPECT_TRUE(text->at.y < top || text->at.x > right || end < left ||
                text->at.y - 0.8 * text->size > bottom);
  }
  EXPECT_EQ(found, 1);
}

TEST(PairLabel, PairsThatShareABodyHaveDistinctPlaces) {
  CrateOnSlab scene;
  scene.view.focus = Focus::Shapes;
  scene.view.layers = {Layer::Shapes};
  scene.header.shapes.push_back(crate_sample::cuboid("ball", {0.2, 0.2, 0.2}));
  Pose<double> aside;
  aside.position = {-0.8, 0.2, 0};
  scene.frames[0].poses.emplace_back("ball", aside);
  std::vector<trace::Pair>& pairs = scene.frames[0].pairs;
  pairs[0].label = "first";
  pairs.insert(pairs.end(), 3, pairs[0]);
  pairs[1].label = "second";  // the crate and the ball
  pairs[1].a = "ball";
  pairs[2].label = "third";
  pairs[2].a = "ball";
  pairs[2].b = "slab";
  pairs[3].label = "fourth";
  std::swap(pairs[3].a, pairs[3].b);
  const Drawing drawing = illustrate(scene.staged(), scene.frames[0]);
  std::vector<Rect> boxes;
  for (const Primitive& primitive : drawing.primitives) {
    const Text* text = std::get_if<Text>(&primitive);
    if (text == nullptr) continue;
    for (const char* label : {"first", "second", "third", "fourth"}) {
      if (text->text != label) continue;
      const double width = text_width(text->text, text->size, FontWeight::Bold);
      boxes.push_back({text->at.x, text->at.y - 0.8 * text->size, width, text->size});
    }
  }
  ASSERT_EQ(boxes.size(), 4u);
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(boxes[i].overlaps(boxes[j])) << i << " " << j;
  // No leader, which would cross the labels nearer to the body.
  for (const Primitive& primitive : drawing.primitives) {
    const Stroke* stroke = std::get_if<Stroke>(&primitive);
    if (stroke == nullptr || !crate_sample::same(stroke->color, kText)) continue;
    for (const Rect& box : boxes) EXPECT_FALSE(clip_segment(box, stroke->from, stroke->to));
  }
}

TEST(Legend, NamesWhatOnlyTheContactPlaneShows) {
  CrateOnSlab scene;
  scene.view.layers = {Layer::Shapes, Layer::Contacts};
  trace::Clip& clip = scene.pair().clip.emplace();
  clip.reference = {"slab", 2, Vec3d::UnitY(), {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}}};
  clip.incident = {"crate", 3, -Vec3d::UnitY(), {{-0.5, 0, -0.5}, {0.5, 0, -0.5}, {0.5, 0, 0.5}}};
  clip.steps = {{Vec3d::UnitX(), 1, clip.incident.polygon}};
  clip.dropped = {{{0.5, -0.002, 0.5}, "beside the face"}, {{0.5, 0, -0.5}, "above the face"}};
  const auto of = [&] { return crate_sample::texts(illustrate(scene.staged(), scene.frames[0])); };
  for (const char* name : {"reference face", "incident face", "clip polygon", "above the face"})
    EXPECT_THAT(of(), ::testing::Not(Contains(name)));
  scene.view.panels = {Panel::ContactPlane};
  for (const char* name : {"reference face", "incident face", "clip polygon", "above the face"})
    EXPECT_THAT(of(), Contains(name));
  EXPECT_THAT(of(), ::testing::Not(Contains("beside the face")));  // a contact point after all
}

TEST(Ids, EachEdgeThatNamesAPointBearsItsNameOnce) {
  CrateOnSlab scene;
  scene.header.shapes[0].edges = {{0, 1}, {1, 3}};
  scene.header.shapes[1].edges = {{4, 5}};
  scene.manifold().points[0].id = "a:e1 b:e0";
  scene.manifold().points[1].id = "b:e0 b:v5";
  scene.view.layers = {Layer::Shapes, Layer::Contacts, Layer::Ids};
  const std::vector<std::string> all =
      crate_sample::texts(illustrate(scene.staged(), scene.frames[0]));
  EXPECT_EQ(std::ranges::count(all, "edge A1"), 1);
  EXPECT_EQ(std::ranges::count(all, "edge B0"), 1);
  EXPECT_EQ(std::ranges::count(all, "edge A0"), 0);
}

TEST(AxisHistory, AnotherFaceOrPairOfEdgesIsASwitchAndACachedAxisIsNone) {
  const auto of_face = [](int face) {
    trace::Pair pair;
    trace::Sat& sat = pair.sat.emplace();
    sat.chosen = "face_a";
    sat.face_a = trace::FaceAxis{face, -0.1, Vec3d::UnitY(), Vec3d::Zero()};
    return pair;
  };
  trace::Pair edges;
  edges.sat.emplace().chosen = "edge_edge";
  edges.sat->edge = trace::EdgeAxis{2, 7, -0.1, Vec3d::UnitY(), Vec3d::Zero(), Vec3d::Zero()};
  trace::Pair other_edges = edges;
  other_edges.sat->edge->b = 8;
  trace::Pair cached;
  cached.cache.emplace().hit = true;
  cached.cache->axis = "face_a";
  const trace::Pair up = of_face(2), side = of_face(0);
  const std::vector<const trace::Pair*> pairs = {&up,   &cached, &up,    &side,        nullptr,
                                                 &side, &edges,  &edges, &other_edges, &cached};
  std::vector<bool> switched;
  for (const AxisMoment& moment : axis_history(pairs)) switched.push_back(moment.switched);
  EXPECT_THAT(switched, ::testing::ElementsAre(false, false, false, true, false, false, true, false,
                                               true, true));
}

TEST(PersistentPoints, OneThatWasTakenOutIsARingAroundTheOneInItsPlace) {
  CrateOnSlab scene;
  scene.view.layers = {Layer::Shapes, Layer::Persistent};
  scene.persist();
  EXPECT_EQ(marks(scene.sketch(), MarkKind::WideRing), 0u);
  std::vector<trace::PersistentPoint>& points = scene.pair().incremental->points;
  points[2].point.position = points[1].point.position;
  EXPECT_EQ(marks(scene.sketch(), MarkKind::WideRing), 1u);
  EXPECT_EQ(marks(scene.sketch(), MarkKind::Hollow), 0u);
}

TEST(PersistentPoints, AKeptOneHasTheCircleInWhichNewOnesAreRejected) {
  CrateOnSlab scene;
  scene.view.layers = {Layer::Shapes, Layer::Persistent};
  scene.persist();
  const auto circles = [&] {
    std::vector<Curve> found = scene.sketch().curves;
    std::erase_if(
        found, [](const Curve& curve) { return !crate_sample::same(curve.style.color, kMargin); });
    return found;
  };
  EXPECT_TRUE(circles().empty());
  scene.pair().incremental->rejects_within = 0.75;
  const std::vector<Curve> all = circles();
  ASSERT_EQ(all.size(), 1u) << "the new point and the broken one have none";
  EXPECT_TRUE(all[0].closed);
  for (const Vec3d& at : all[0].points) EXPECT_NEAR((at - Vec3d(-0.5, 0, 0.5)).norm(), 0.75, 1e-12);
  // Its radius, and how far the new point is from it.
  std::vector<std::string> texts;
  for (const Label& label : scene.sketch().labels) texts.push_back(label.text);
  EXPECT_THAT(texts, ::testing::IsSupersetOf({"0.750 m", "1.00 m"}));
}

TEST(Overlap, HasOneSignWhereItsWhiskerIsSeen) {
  CrateOnSlab scene;
  scene.view.layers = {Layer::Shapes, Layer::Contacts, Layer::Overlap};
  const Staging staging = scene.staged();
  const Sketch both = sketch_frame(staging, scene.frames[0]);
  EXPECT_TRUE(measures(both).empty());
  const auto number = std::ranges::find(both.labels, "overlap 2.00 mm", &Label::text);
  ASSERT_NE(number, both.labels.end());
  EXPECT_TRUE(crate_sample::same(number->color, kContact)) << "as the whisker";
  scene.view.layers = {Layer::Shapes, Layer::Overlap};
  EXPECT_EQ(measures(sketch_frame(scene.staged(), scene.frames[0])).size(), 1u);
}

TEST(Title, ADepthInTheTitleIsOnItsWhiskerOnce) {
  CrateOnSlab scene;
  scene.view.layers = {Layer::Shapes, Layer::Contacts};
  const auto record = [&](const char* title) {
    scene.view.title = title;
    const auto texts = crate_sample::texts(illustrate(scene.staged(), scene.frames[0]));
    return std::ranges::count(texts, "2.00 mm");
  };
  EXPECT_EQ(record("A crate stands {overlap} deep"), 1);
  EXPECT_EQ(record("A crate stands 12.00 mm deep"), 0) << "another number";
  EXPECT_EQ(record("A crate stands on a slab"), 0);
  scene.view.layers.push_back(Layer::Overlap);
  EXPECT_EQ(record("A crate stands {overlap} deep"), 0) << "its label says it";
}

TEST(Whisker, GapsAloneHaveTheirOwnFactor) {
  CrateOnSlab scene;
  for (trace::Point& point : scene.manifold().points) point.separation = 1e-4;
  const SequenceScales scales = scene.staged().scales;
  EXPECT_GE(scales.gap, 20);
  EXPECT_EQ(scales.overlap, 1);
  scene.manifold().points[0].separation = -0.5;
  EXPECT_EQ(scene.staged().scales.gap, 1) << "that of the overlap";
}

}  // namespace
}  // namespace contactscope::draw
