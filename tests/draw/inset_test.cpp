#include "draw/insets/inset.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>

#include "draw/scene/clip_story.h"
#include "draw/scene/palette.h"
#include "draw/staging.h"

namespace contactscope::draw {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

trace::Shape cube(const std::string& name, double half) {
  trace::Shape shape;
  shape.name = name;
  shape.type = "box";
  for (int i = 0; i < 8; ++i)
    shape.vertices.emplace_back(i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half);
  shape.faces = {{1, 3, 7, 5}, {0, 4, 6, 2}, {2, 6, 7, 3},
                 {0, 1, 5, 4}, {4, 5, 7, 6}, {0, 2, 3, 1}};
  shape.edges = {{0, 1}, {0, 2}, {0, 4}, {1, 3}, {1, 5}, {2, 3},
                 {2, 6}, {3, 7}, {4, 5}, {4, 6}, {5, 7}, {6, 7}};
  return shape;
}

const Vec3d kPlaceOfB(0, 0.8, 0);

/// Corner k of the difference of two cubes with edges of 1 m; B is 0.8 m above A. The difference is
/// a cube with edges of 2 m about the place of B. Its lower face is 0.2 m below the origin.
trace::SimplexVertex corner(int k) {
  const Vec3d s(k & 1 ? 0.5 : -0.5, k & 2 ? 0.5 : -0.5, k & 4 ? 0.5 : -0.5);
  return {-s, kPlaceOfB + s};
}

trace::Frame two_cubes(int number = 0) {
  trace::Frame frame;
  frame.frame = number;
  frame.poses = {{"lower", {}}, {"upper", {}}};
  frame.poses[1].second.position = kPlaceOfB;
  trace::Pair pair;
  pair.a = "lower";
  pair.b = "upper";
  pair.kind = "hull-hull";
  pair.state = "touching";
  pair.minkowski.emplace();
  for (int k = 0; k < 8; ++k) pair.minkowski->vertices.push_back(difference(corner(k)));
  pair.minkowski->faces = cube("", 1).faces;
  trace::Penetration& epa = pair.penetration.emplace();
  epa.method = "epa";
  epa.status = "converged";
  epa.depth = 0.2;
  epa.normal = Vec3d(0, 1, 0);
  // 0 and 1, 4 and 5 are below. The first face cuts the cube, the last lies in its lower face.
  epa.polytopes = {
      {{corner(0), corner(5), corner(3), corner(6)}, {{1, 0, 2}, {0, 1, 3}}, 0, 0.1},
      {{corner(0), corner(5), corner(3), corner(6), corner(4)}, {{0, 1, 4}, {0, 4, 3}}, 0, 0.2}};
  frame.pairs = {pair};
  return frame;
}

trace::Gjk three_steps() {
  return {"separated", 3,
          0.25,        {},
          {},          {{corner(7)}, {corner(7), corner(2)}, {corner(2), corner(0), corner(1)}}};
}

View view_of(std::vector<Panel> panels, Story story = Story::None) {
  View view;
  view.layers = {Layer::Shapes, Layer::Simplex};
  view.focus = Focus::Shapes;
  view.panels = std::move(panels);
  view.story = story;
  return view;
}

/// Two cubes with everything staged.
struct Staged {
  trace::Header header;
  std::vector<trace::Frame> frames;
  Staging staging;

  Staged(std::vector<trace::Frame> all, const View& view,
         std::vector<trace::Shape> shapes = {cube("lower", 0.5), cube("upper", 0.5)})
      : header(titled(std::move(shapes))),
        frames(std::move(all)),
        staging(stage(header, frames, view, 1280, 720)) {}

  static trace::Header titled(std::vector<trace::Shape> shapes) {
    trace::Header header;
    header.title = "Two cubes";
    header.up = "y";
    header.shapes = std::move(shapes);
    return header;
  }
  InsetPicture picture(std::size_t inset = 0) const {
    const trace::Frame& frame = frames.front();
    return sketch_inset(staging.insets[inset], scene_of(staging, frame));
  }
};

std::vector<std::string> label_texts(const Sketch& sketch) {
  std::vector<std::string> texts;
  for (const Label& label : sketch.labels) texts.push_back(label.text);
  return texts;
}

std::size_t marks_of(const Sketch& sketch, MarkKind kind, const Color& color) {
  return static_cast<std::size_t>(std::ranges::count_if(sketch.marks, [&](const Mark& mark) {
    return mark.kind == kind && mark.color.r == color.r && mark.color.g == color.g;
  }));
}

TEST(SimplexSteps, AStoryShowsAStepAFrameAndStaysAtTheLast) {
  const View story = view_of({}, Story::GjkSteps);
  for (const auto& [frame, step, vertices] :
       {std::tuple{0, 0, 0u}, {1, 1, 1u}, {2, 2, 2u}, {3, 3, 3u}, {9, 3, 3u}}) {
    trace::Frame at = two_cubes(frame);
    at.pairs[0].gjk = three_steps();
    const auto shown = simplex_step(story, at, at.pairs[0]);
    ASSERT_TRUE(shown.has_value());
    EXPECT_EQ(shown->step, step);
    EXPECT_EQ(shown->steps, 3);
    EXPECT_EQ(shown->vertices.size(), vertices);
    EXPECT_EQ(shown->next.has_value(), frame < 3);
  }
}

TEST(SimplexSteps, AVertexKeepsItsNumber) {
  trace::Frame frame = two_cubes(3);
  frame.pairs[0].gjk = three_steps();
  const auto shown = simplex_step(view_of({}, Story::GjkSteps), frame, frame.pairs[0]);
  EXPECT_THAT(shown->numbers, ElementsAre(2, 3, 4));
  frame.frame = 1;
  const auto first = simplex_step(view_of({}, Story::GjkSteps), frame, frame.pairs[0]);
  EXPECT_THAT(first->numbers, ElementsAre(1));
  EXPECT_EQ(*first->next, corner(2));
}

TEST(SimplexSteps, WithoutAStoryTheLastPolytopeIsShown) {
  trace::Frame frame = two_cubes();
  frame.pairs[0].gjk = three_steps();
  const auto shown = simplex_step(view_of({}), frame, frame.pairs[0]);
  EXPECT_EQ(shown->polytope, &frame.pairs[0].penetration->polytopes[1]);
  EXPECT_TRUE(shown->last());
  const auto begin = simplex_step(view_of({}, Story::EpaSteps), frame, frame.pairs[0]);
  EXPECT_EQ(begin->polytope, &frame.pairs[0].penetration->polytopes[0]);
  EXPECT_EQ(*begin->next, corner(4));
  frame.pairs[0].penetration.reset();
  EXPECT_EQ(simplex_step(view_of({}), frame, frame.pairs[0])->vertices.size(), 3u);
  frame.pairs[0].gjk.reset();
  EXPECT_FALSE(simplex_step(view_of({}), frame, frame.pairs[0]).has_value());
}

TEST(SimplexSteps, NoPointOfASimplexIsNearerThanTheNearest) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-1, 1), weight(0, 1);
  for (int round = 0; round < 400; ++round) {
    std::vector<Vec3d> points;
    const Vec3d place(coordinate(random), coordinate(random), coordinate(random));
    for (int i = 0; i <= round % 4; ++i)
      points.push_back(place + Vec3d(coordinate(random), coordinate(random), coordinate(random)));
    const Vec3d nearest = nearest_to_origin(points);
    // All of a convex set is beyond the plane through its nearest point.
    for (const Vec3d& point : points)
      EXPECT_GE(point.dot(nearest), nearest.squaredNorm() - 1e-12) << round;
    double least = 1e300;
    for (int sample = 0; sample < 300; ++sample) {
      Vec3d mixed = Vec3d::Zero();
      double sum = 0;
      for (const Vec3d& point : points) {
        const double share = weight(random) * weight(random);
        mixed += share * point;
        sum += share;
      }
      least = std::min(least, (mixed / sum).norm());
    }
    EXPECT_LE(nearest.norm(), least + 1e-12) << round;
  }
}

TEST(Insets, AreNextToTheShapesAndLeaveThePanels) {
  const Staged staged({two_cubes()}, view_of({Panel::Minkowski, Panel::Summary, Panel::GaussMap}));
  EXPECT_THAT(staged.staging.view.panels, ElementsAre(Panel::Summary));
  ASSERT_EQ(staged.staging.insets.size(), 2u);
  EXPECT_EQ(staged.staging.insets[0].panel, Panel::Minkowski);
  EXPECT_EQ(staged.staging.insets[1].panel, Panel::GaussMap);
  const Rect& view = staged.staging.layout.view;
  const Rect& above = staged.staging.insets[0].frame;
  const Rect& below = staged.staging.insets[1].frame;
  EXPECT_LT(view.x + view.width, above.x);
  EXPECT_LT(above.x + above.width, staged.staging.layout.panels.x);
  EXPECT_LT(above.y + above.height, below.y);
  EXPECT_NEAR(below.y + below.height, view.y + view.height, 1e-6);
  EXPECT_NEAR(above.width, view.width, 1e-6);
}

TEST(Insets, AViewWithoutOneIsAsItWas) {
  const Staged with({two_cubes()}, view_of({Panel::Minkowski}));
  const Staged without({two_cubes()}, view_of({}));
  EXPECT_THAT(without.staging.insets, IsEmpty());
  EXPECT_GT(without.staging.layout.view.width, 2 * with.staging.layout.view.width);
}

TEST(Insets, AllOfTheDifferenceIsInItsViewport) {
  const Staged staged({two_cubes()}, view_of({Panel::Minkowski}));
  const Camera& camera = staged.staging.insets[0].camera;
  for (int k = 0; k < 8; ++k) {
    const auto at = camera.project(difference(corner(k)));
    ASSERT_TRUE(at.has_value());
    EXPECT_TRUE(camera.viewport().contains(*at)) << k;
  }
  EXPECT_TRUE(camera.viewport().contains(*camera.project(Vec3d::Zero())));
}

TEST(Insets, ThePictureHasItsHeadingAndOneLegend) {
  const Staged staged({two_cubes()}, view_of({Panel::Minkowski}));
  std::vector<std::string> texts;
  for (const Primitive& primitive : illustrate(staged.staging, staged.frames[0]).primitives) {
    if (const Text* text = std::get_if<Text>(&primitive)) texts.push_back(text->text);
  }
  for (const char* text : {"Minkowski difference B − A", "EPA: converged", "polytope", "A: lower"})
    EXPECT_EQ(std::ranges::count(texts, text), 1) << text;
}

TEST(MinkowskiInset, TheNearestFaceBearsItsDistance) {
  const Staged staged({two_cubes()}, view_of({Panel::Minkowski}));
  const InsetPicture picture = staged.picture();
  EXPECT_EQ(picture.note, "EPA: converged");
  EXPECT_EQ(marks_of(picture.sketch, MarkKind::HeldOrigin, kNormal), 1u);
  EXPECT_THAT(label_texts(picture.sketch), testing::IsSupersetOf({"origin", "overlap 0.200 m"}));
  ASSERT_EQ(picture.sketch.arrows.size(), 1u);
  EXPECT_EQ(picture.sketch.arrows[0].from, Vec3d(0, 0, 0));
  EXPECT_NEAR((*picture.sketch.arrows[0].to - Vec3d(0, -0.2, 0)).norm(), 0, 1e-12);
}

TEST(MinkowskiInset, AStepThatIsNotTheLastShowsWhatComesNext) {
  const Staged staged({two_cubes()}, view_of({Panel::Minkowski}, Story::EpaSteps));
  const InsetPicture picture = staged.picture();
  EXPECT_EQ(picture.note, "EPA, expansion 0 of 1");
  EXPECT_EQ(marks_of(picture.sketch, MarkKind::Hollow, kPolytope), 1u);
}

// Corner 4 is in the plane of 0, 5 and 1, and sees the face that cuts the cube.
TEST(MinkowskiInset, FacesInThePlaneOfTheNextPointHaveTheirOwnColour) {
  trace::Frame frame = two_cubes();
  trace::Polytope& first = frame.pairs[0].penetration->polytopes[0];
  first.vertices.push_back(corner(1));
  first.faces.push_back({0, 1, 4});
  View view = view_of({Panel::Minkowski}, Story::EpaSteps);
  view.layers.clear();
  const Sketch sketch = Staged({frame}, view).picture().sketch;
  const auto is_blue = [](const Surface& surface) { return surface.color.r == kSidePlane.r; };
  ASSERT_EQ(std::ranges::count_if(sketch.surfaces, is_blue), 1);
  for (const Vec3d& place : std::ranges::find_if(sketch.surfaces, is_blue)->polygon)
    EXPECT_NEAR(place.y(), -0.2, 1e-12);
}

// The next point is 1 µm under a triangle, seen edge-on.
TEST(MinkowskiInset, AlonePanelMagnifiesAFlatTetrahedron) {
  trace::Frame frame = two_cubes(1);
  trace::Pair& pair = frame.pairs[0];
  pair.penetration.reset();
  const trace::Simplex triangle{corner(2), corner(3), corner(6)};  // the upper face, at 1.8 m
  trace::SimplexVertex next = corner(7);
  next.b.y() -= 1e-5;
  pair.gjk =
      trace::Gjk{"separated", 2, 1.8, {}, {}, {triangle, {corner(2), corner(3), corner(6), next}}};
  View view = view_of({Panel::Minkowski}, Story::GjkSteps);
  view.layers.clear();
  const Staged alone({frame}, view);
  ASSERT_EQ(alone.staging.insets.size(), 1u);
  EXPECT_THAT(label_texts(alone.picture().sketch),
              testing::Contains(testing::StartsWith("same simplex, height 10.0 µm × ")));
  view.inset = false;
  const Staged two({frame}, view);
  ASSERT_EQ(two.staging.insets.size(), 2u);
}

TEST(MinkowskiInset, ASimplexHasAnEdgeForEveryTwoVertices) {
  trace::Frame frame = two_cubes();
  frame.pairs[0].penetration.reset();
  frame.pairs[0].minkowski.reset();
  frame.pairs[0].gjk = three_steps();
  const Staged staged({frame}, view_of({Panel::Minkowski}));
  const InsetPicture picture = staged.picture();
  EXPECT_EQ(picture.sketch.lines.size(), 3u);
  EXPECT_EQ(picture.sketch.surfaces.size(), 1u);
  EXPECT_EQ(marks_of(picture.sketch, MarkKind::Dot, kClipPolygon), 3u);
  EXPECT_EQ(picture.note, "GJK: separated");
}

TEST(MinkowskiInset, WithoutFactsOnlyTheOriginIsLeft) {
  trace::Frame frame = two_cubes();
  frame.pairs[0].penetration.reset();
  frame.pairs[0].minkowski.reset();
  const Staged staged({frame}, view_of({Panel::Minkowski}));
  EXPECT_THAT(label_texts(staged.picture().sketch), ElementsAre("origin"));
  EXPECT_EQ(staged.picture().note, "");
}

TEST(MinkowskiInset, WithoutStepsItStatesWhereTheOriginIs) {
  trace::Frame frame = two_cubes();
  frame.pairs[0].penetration.reset();
  EXPECT_EQ(Staged({frame}, view_of({Panel::Minkowski})).picture().note, "holds the origin");
  frame.pairs[0].state = "separated";
  EXPECT_EQ(Staged({frame}, view_of({Panel::Minkowski})).picture().note, "the origin is outside");
}

TEST(MinkowskiInset, TheBorderDistanceIsTheOverlapOrSeparation) {
  // A cube with edges of 2 m about the place of B, which is 0.8 m up: 0.2 m deep at the bottom.
  for (const double lift : {0.0, 0.5}) {
    trace::Frame frame = two_cubes();
    frame.pairs[0].penetration.reset();
    for (Vec3d& vertex : frame.pairs[0].minkowski->vertices) vertex.y() += lift;
    frame.pairs[0].state = lift > 0 ? "separated" : "touching";
    const InsetPicture picture = Staged({frame}, view_of({Panel::Minkowski})).picture();
    ASSERT_EQ(picture.sketch.arrows.size(), 1u);
    EXPECT_NEAR((*picture.sketch.arrows[0].to - Vec3d(0, lift - 0.2, 0)).norm(), 0, 1e-9);
    EXPECT_THAT(label_texts(picture.sketch),
                testing::Contains(lift > 0 ? "gap 0.300 m" : "overlap 0.200 m"));
    EXPECT_EQ(marks_of(picture.sketch, MarkKind::Origin, kNormal), lift > 0 ? 1u : 0u);
    EXPECT_EQ(marks_of(picture.sketch, MarkKind::HeldOrigin, kNormal), lift > 0 ? 0u : 1u);
  }
}

TEST(MinkowskiInset, ANumberLongerThanItsArrowStandsAsideWithALeader) {
  for (const double depth : {0.001, 0.9}) {
    trace::Frame frame = two_cubes();
    frame.pairs[0].penetration.reset();
    for (Vec3d& vertex : frame.pairs[0].minkowski->vertices) vertex.y() += 0.2 - depth;
    const InsetPicture picture = Staged({frame}, view_of({Panel::Minkowski})).picture();
    const auto number = std::ranges::find_if(picture.sketch.labels, [](const Label& label) {
      return label.text.starts_with("overlap");
    });
    ASSERT_NE(number, picture.sketch.labels.end());
    EXPECT_EQ(number->leader, depth < 0.01);
  }
}

TEST(GaussMapInset, TheEdgesThatDecideAreNamedOnTheShapes) {
  trace::Frame frame = two_cubes();
  frame.pairs[0].manifolds = {{Vec3d(0, 1, 0), "edge_edge", {}, {{kPlaceOfB, -0.2, "a:e3 b:e11"}}}};
  View view = view_of({Panel::GaussMap});
  view.layers = {Layer::ContactAxis};
  const Staged staged({frame}, view);
  const Sketch sketch = sketch_frame(staged.staging, frame);
  EXPECT_THAT(label_texts(sketch), ElementsAre("edge of A", "edge of B"));
  ASSERT_EQ(sketch.lines.size(), 2u);
  EXPECT_EQ(sketch.lines[0].from, Vec3d(0.5, -0.5, -0.5));
  EXPECT_EQ(sketch.lines[0].to, Vec3d(0.5, 0.5, -0.5));
  EXPECT_EQ(sketch.lines[1].from, Vec3d(Vec3d(-0.5, 0.5, 0.5) + kPlaceOfB));
}

TEST(SimplexPoints, BothShapesBearTheNumbersOfTheDifference) {
  trace::Frame frame = two_cubes();
  frame.pairs[0].penetration.reset();
  frame.pairs[0].gjk = three_steps();
  frame.pairs[0].gjk->status = "overlap";
  const Staged staged({frame}, view_of({}));
  const Sketch sketch = sketch_frame(staged.staging, frame);
  EXPECT_EQ(marks_of(sketch, MarkKind::Dot, kClipPolygon), 6u);
  EXPECT_THAT(label_texts(sketch), testing::UnorderedElementsAre("2", "2", "3", "3", "4", "4"));
  for (const Mark& mark : sketch.marks)
    EXPECT_NEAR(std::min(mark.at.lpNorm<Eigen::Infinity>(),
                         (mark.at - kPlaceOfB).lpNorm<Eigen::Infinity>()),
                0.5, 1e-12);
}

TEST(MinkowskiInset, ItsLabelsFindTheirPlacesInThePicture) {
  const Staged staged({two_cubes()}, view_of({Panel::Minkowski}));
  const std::vector<std::string> wanted = label_texts(staged.picture().sketch);
  EXPECT_THAT(wanted, testing::Contains("origin"));
  std::vector<std::string> drawn;
  for (const Primitive& primitive : illustrate(staged.staging, staged.frames[0]).primitives)
    if (const Text* text = std::get_if<Text>(&primitive)) drawn.push_back(text->text);
  for (const std::string& text : wanted) EXPECT_THAT(drawn, testing::Contains(text));
}

TEST(GaussMapInset, OneMarkForEachCrossingInFront) {
  trace::Frame frame = two_cubes();
  trace::Sat& sat = frame.pairs[0].sat.emplace();
  sat.chosen = "edge_edge";
  const Vec3d front(0, 1, 0);
  sat.edge = trace::EdgeAxis{0, 3, -0.2, front, kPlaceOfB, kPlaceOfB};
  sat.edge_pairs = {{0, 3, -0.2, front}, {1, 2, -0.7, -front}};
  const Staged staged({frame}, view_of({Panel::GaussMap}));
  const InsetPicture picture = staged.picture();
  EXPECT_EQ(picture.note, "2 pairs of arcs cross, 1 in front");
  EXPECT_EQ(marks_of(picture.sketch, MarkKind::Dot, kAxis), 1u);
  EXPECT_EQ(marks_of(picture.sketch, MarkKind::Ring, kAxisText), 1u);
  EXPECT_THAT(label_texts(picture.sketch), ElementsAre("edge of A × edge of B, overlap 0.200 m"));
}

TEST(GaussMapInset, TheBestAxisIsNeverBehindTheSphere) {
  std::mt19937 random(11);
  std::normal_distribution<double> coordinate;
  for (int round = 0; round < 50; ++round) {
    trace::Frame frame = two_cubes();
    trace::Sat& sat = frame.pairs[0].sat.emplace();
    const Vec3d axis =
        Vec3d(coordinate(random), coordinate(random), coordinate(random)).normalized();
    sat.edge = trace::EdgeAxis{0, 3, -0.2, axis, kPlaceOfB, kPlaceOfB};
    const Staged staged({frame}, view_of({Panel::GaussMap}));
    EXPECT_EQ(marks_of(staged.picture().sketch, MarkKind::Ring, kAxisText), 1u) << round;
  }
}

TEST(GaussMapInset, ACapsulesRingCrossesTheArcsBetweenItsTwoSides) {
  trace::Shape pill;
  pill.name = "upper";
  pill.type = "capsule";
  pill.radius = 0.1;
  // Its plane has three faces of the cube on each side; six arcs connect these sides.
  pill.vertices = {Vec3d(-0.1, -0.2, -0.3), Vec3d(0.1, 0.2, 0.3)};
  pill.edges = {{0, 1}};
  trace::Frame frame = two_cubes();
  frame.pairs[0].kind = "hull-capsule";
  frame.pairs[0].separation = -0.1;
  frame.pairs[0].manifolds = {{Vec3d(0, 1, 0), "edge_edge", {}, {}}};
  const Staged staged({frame}, view_of({Panel::GaussMap}), {cube("lower", 0.5), pill});
  const InsetPicture picture = staged.picture();
  EXPECT_THAT(picture.note, testing::StartsWith("6 pairs of arcs cross, "));
  EXPECT_THAT(label_texts(picture.sketch), ElementsAre("normal, overlap 100 mm"));
}

TEST(StagesShown, InsetsAndStepsRecordWhatTheyShowAndNothingElse) {
  const trace::Stages none = stages_shown({view_of({})});
  EXPECT_TRUE(none.gjk && none.penetration);  // of the layer of support points
  View bare = view_of({});
  bare.layers = {Layer::Shapes};
  const trace::Stages bare_stages = stages_shown({bare});
  EXPECT_FALSE(bare_stages.gjk || bare_stages.penetration || bare_stages.minkowski ||
               bare_stages.gauss_map || bare_stages.sat);
  bare.panels = {Panel::Minkowski};
  const trace::Stages minkowski = stages_shown({bare});
  EXPECT_TRUE(minkowski.gjk && minkowski.penetration && minkowski.minkowski);
  EXPECT_FALSE(minkowski.gauss_map || minkowski.sat);
  bare.panels = {Panel::GaussMap};
  const trace::Stages gauss_map = stages_shown({bare});
  EXPECT_TRUE(gauss_map.gauss_map && gauss_map.sat);
  EXPECT_FALSE(gauss_map.minkowski || gauss_map.gjk);
}

}  // namespace
}  // namespace contactscope::draw
