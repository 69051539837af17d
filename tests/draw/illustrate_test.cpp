#include "draw/staging.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "draw/scene/palette.h"

namespace contactscope::draw {
namespace {

trace::Shape box(const std::string& name, const Vec3d& h) {
  trace::Shape shape;
  shape.name = name;
  shape.type = "box";
  for (int i = 0; i < 8; ++i) {
    shape.vertices.emplace_back(i & 1 ? h.x() : -h.x(), i & 2 ? h.y() : -h.y(),
                                i & 4 ? h.z() : -h.z());
  }
  shape.faces = {{1, 3, 7, 5}, {0, 4, 6, 2}, {2, 6, 7, 3},
                 {0, 1, 5, 4}, {4, 5, 7, 6}, {0, 2, 3, 1}};
  shape.edges = {{0, 1}, {0, 2}, {0, 4}, {1, 3}, {1, 5}, {2, 3},
                 {2, 6}, {3, 7}, {4, 5}, {4, 6}, {5, 7}, {6, 7}};
  return shape;
}

// A cube 5 mm deep in a larger slab: the manifold is known without a pipeline.
struct BoxOnSlab {
  trace::Header header;
  trace::Frame frame;
  View view;

  BoxOnSlab() {
    header.scenario = "test/box_on_slab";
    header.title = "A box on a slab";
    header.source = "none";
    header.up = "y";
    header.frames = 1;
    header.shapes = {box("slab", {1, 0.2, 1}), box("crate", {0.5, 0.5, 0.5})};
    Pose<double> slab, crate;
    slab.position = {0, -0.2, 0};
    crate.position = {0, 0.495, 0};
    frame.poses = {{"slab", slab}, {"crate", crate}};
    trace::Pair pair;
    pair.a = "slab";
    pair.b = "crate";
    pair.kind = "hull-hull";
    pair.state = "touching";
    pair.separation = -0.005;
    trace::Manifold manifold;
    manifold.normal = Vec3d::UnitY();
    manifold.axis = "face_a";
    for (const auto& [x, z] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}) {
      manifold.points.push_back({{x, 0, z}, -0.005, "b:e0 b:e1"});
    }
    pair.manifolds = {manifold};
    frame.pairs = {pair};
    view.layers = {Layer::Shapes, Layer::Contacts, Layer::Normals};
  }

  Staging staged(int width = 1280, int height = 720) const {
    return stage(header, {frame}, view, width, height);
  }
};

std::vector<std::string> picture_texts(const Drawing& drawing) {
  std::vector<std::string> result;
  for (const Primitive& primitive : drawing.primitives) {
    if (const Text* text = std::get_if<Text>(&primitive)) result.push_back(text->text);
  }
  return result;
}

bool same(const Color& a, const Color& b) { return a.r == b.r && a.g == b.g && a.b == b.b; }

std::vector<Point2> dots(const Drawing& drawing) {
  std::vector<Point2> result;
  for (const Primitive& primitive : drawing.primitives) {
    const Disc* disc = std::get_if<Disc>(&primitive);
    if (disc && disc->inner == 0 && same(disc->color, kContact)) result.push_back(disc->center);
  }
  return result;
}

TEST(Illustrate, EveryContactPointIsADotInsideTheView) {
  const BoxOnSlab scene;
  const Staging staging = scene.staged();
  const Drawing drawing = illustrate(staging, scene.frame);
  int inside = 0;
  for (const Point2& dot : dots(drawing)) inside += staging.layout.view.contains(dot);
  EXPECT_EQ(inside, 4);  // and one more in the legend
  EXPECT_EQ(dots(drawing).size(), 5u);
}

TEST(Illustrate, LegendListsWhatIsVisibleAndNothingElse) {
  BoxOnSlab scene;
  std::vector<std::string> all = picture_texts(illustrate(scene.staged(), scene.frame));
  EXPECT_THAT(all, testing::Contains("A: slab"));
  EXPECT_THAT(all, testing::Contains("B: crate"));
  EXPECT_THAT(all, testing::Contains("normal, from A to B"));
  EXPECT_THAT(all, testing::Not(testing::Contains("incident face")));
  scene.view.layers = {Layer::Shapes};
  all = picture_texts(illustrate(scene.staged(), scene.frame));
  EXPECT_THAT(all, testing::Not(testing::Contains("normal, from A to B")));
}

/// Length in pixels of the normal's shaft in the view; 0 if it is not drawn.
double normal_length(const Staging& staging, const Drawing& drawing) {
  double longest = 0;
  for (const Primitive& primitive : drawing.primitives) {
    const Stroke* stroke = std::get_if<Stroke>(&primitive);
    if (!stroke || !same(stroke->color, kNormal) || stroke->cap != Cap::Butt) continue;
    const Rect& view = staging.layout.view;
    if (!view.contains(stroke->from) || !view.contains(stroke->to)) continue;
    const double length = std::hypot(stroke->to.x - stroke->from.x, stroke->to.y - stroke->from.y);
    longest = std::max(longest, length);
  }
  return longest;
}

TEST(Illustrate, ANormalIsDrawnInTheViewOrNotInTheLegend) {
  int drawn = 0, left_out = 0;
  for (const auto& [width, height] : {std::pair{320, 180}, {640, 360}, {1280, 720}}) {
    // The contact moves up in the picture until it leaves the view; and a view from above.
    for (int i = 0; i <= 40; ++i) {
      BoxOnSlab scene;
      scene.view.eye = i < 40 ? Vec3d(2.5, 1.5, 3) : Vec3d(0, 5, 1e-9);
      scene.view.target = i < 40 ? Vec3d(0, -0.05 * i, 0) : Vec3d(0, 0, 0);
      const Staging staging = scene.staged(width, height);
      const Drawing drawing = illustrate(staging, scene.frame);
      const std::vector<std::string> all = picture_texts(drawing);
      const bool record = std::ranges::count(all, "normal, from A to B") > 0;
      EXPECT_EQ(record, normal_length(staging, drawing) > 0) << width << " wide, " << i;
      ++(record ? drawn : left_out);
    }
  }
  EXPECT_GT(drawn, 40);
  EXPECT_GT(left_out, 10);
}

TEST(Illustrate, ANormalPointsFromAToBOnTheScreen) {
  const BoxOnSlab scene;
  const Staging staging = scene.staged();
  const Drawing drawing = illustrate(staging, scene.frame);
  // The slab is A and below: the shaft begins at the points and the head is above it.
  const std::optional<Point2> foot = staging.camera.project(Vec3d::Zero());
  const std::optional<Point2> ahead = staging.camera.project(Vec3d(0, 0.2, 0));
  ASSERT_TRUE(foot && ahead);
  ASSERT_LT(ahead->y, foot->y);
  int heads = 0;
  for (const Primitive& primitive : drawing.primitives) {
    const Fill* head = std::get_if<Fill>(&primitive);
    if (!head || head->polygon.size() != 3 || !same(head->color, kNormal)) continue;
    if (!staging.layout.view.contains(head->polygon.front())) continue;
    // The tip is the corner with equal distances to the other two.
    const auto& corners = head->polygon;
    std::size_t tip = 0;
    double unlike = 1e9;
    for (std::size_t i = 0; i < 3; ++i) {
      const double difference = std::abs(distance(corners[i], corners[(i + 1) % 3]) -
                                         distance(corners[i], corners[(i + 2) % 3]));
      if (difference < unlike) unlike = difference, tip = i;
    }
    const Point2 base = 0.5f * (corners[(tip + 1) % 3] + corners[(tip + 2) % 3]);
    EXPECT_GT(dot(corners[tip] - base, *ahead - *foot), 0);
    EXPECT_GT(dot(base - *foot, *ahead - *foot), 0);
    ++heads;
  }
  EXPECT_EQ(heads, 1);
}

TEST(Illustrate, ADotIsCentredOnItsPoint) {
  const BoxOnSlab scene;
  const Staging staging = scene.staged();
  const Drawing drawing = illustrate(staging, scene.frame);
  const std::vector<Point2> all = dots(drawing);
  for (const trace::Point& point : scene.frame.pairs[0].manifolds[0].points) {
    const std::optional<Point2> at = staging.camera.project(point.position);
    ASSERT_TRUE(at.has_value());
    float nearest = 1e9f;
    for (const Point2& dot : all) nearest = std::min(nearest, distance(dot, *at));
    EXPECT_LT(nearest, 0.01f);
  }
}

TEST(Illustrate, ShallowOverlapIsExaggeratedByAStatedRoundFactor) {
  const BoxOnSlab scene;
  const Staging staging = scene.staged();
  EXPECT_GT(staging.scales.overlap, 1);
  const std::string stated = "contact point, whisker = overlap × ";
  EXPECT_THAT(picture_texts(illustrate(staging, scene.frame)),
              testing::Contains(testing::StartsWith(stated)));
}

TEST(Illustrate, DeepOverlapIsDrawnTrue) {
  BoxOnSlab scene;
  for (trace::Point& point : scene.frame.pairs[0].manifolds[0].points) point.separation = -0.2;
  EXPECT_EQ(scene.staged().scales.overlap, 1);
}

TEST(Illustrate, PatchTakesAThirdToAHalfOfTheView) {
  const BoxOnSlab scene;
  const Staging staging = scene.staged();
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
  for (const Point2& dot : dots(illustrate(staging, scene.frame))) {
    if (!staging.layout.view.contains(dot)) continue;
    left = std::min<double>(left, dot.x);
    right = std::max<double>(right, dot.x);
    top = std::min<double>(top, dot.y);
    bottom = std::max<double>(bottom, dot.y);
  }
  const double share = std::max((right - left) / staging.layout.view.width,
                                (bottom - top) / staging.layout.view.height);
  EXPECT_GT(share, 1.0 / 3);
  EXPECT_LT(share, 1.0 / 2);
}

TEST(Illustrate, CameraStands25To40DegreesAboveTheContactPlane) {
  const BoxOnSlab scene;
  const Staging staging = scene.staged();
  const double sine = staging.camera.to_eye({0, 0, 0}).y();
  EXPECT_GT(sine, std::sin(25 * 3.14159265 / 180));
  EXPECT_LT(sine, std::sin(40 * 3.14159265 / 180));
}

TEST(Illustrate, SameFrameGivesTheSameDrawing) {
  const BoxOnSlab scene;
  const Drawing one = illustrate(scene.staged(), scene.frame);
  const Drawing two = illustrate(scene.staged(), scene.frame);
  ASSERT_EQ(one.primitives.size(), two.primitives.size());
  EXPECT_EQ(picture_texts(one), picture_texts(two));
  const std::vector<Point2> a = dots(one), b = dots(two);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].x, b[i].x);
    EXPECT_EQ(a[i].y, b[i].y);
  }
}

TEST(Illustrate, SmallPicturesKeepTextLegible) {
  const BoxOnSlab scene;
  const Drawing drawing = illustrate(scene.staged(640, 360), scene.frame);
  for (const Primitive& primitive : drawing.primitives) {
    const Text* text = std::get_if<Text>(&primitive);
    if (text == nullptr) continue;
    EXPECT_GE(text->size, 10) << text->text;
  }
}

TEST(Illustrate, SceneScaledByTenThousandGivesTheSamePicture) {
  const BoxOnSlab small;
  BoxOnSlab large;
  constexpr double kScale = 1e4;
  for (trace::Shape& shape : large.header.shapes) {
    for (Vec3d& v : shape.vertices) v *= kScale;
  }
  for (auto& [name, pose] : large.frame.poses) pose.position *= kScale;
  for (trace::Point& point : large.frame.pairs[0].manifolds[0].points) {
    point.position *= kScale;
    point.separation *= kScale;
  }
  const std::vector<Point2> a = dots(illustrate(small.staged(), small.frame));
  const std::vector<Point2> b = dots(illustrate(large.staged(), large.frame));
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_NEAR(a[i].x, b[i].x, 0.01);
    EXPECT_NEAR(a[i].y, b[i].y, 0.01);
  }
}

}  // namespace
}  // namespace contactscope::draw
