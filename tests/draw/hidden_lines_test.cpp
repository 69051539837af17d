#include "draw/scene/visibility.h"

#include <gtest/gtest.h>

#include "draw/scene/solid.h"
#include "support/random_geometry.h"

namespace contactscope::draw {
namespace {

const Rect kViewport{0, 0, 400, 400};
const std::vector<Vec3d> kSquare = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};

Camera from_front() {
  return Camera::orthographic({0, 0, 10}, {0, 0, 0}, Vec3d::UnitY(), 4, kViewport);
}

double hidden_length(const std::vector<Span>& spans) {
  double sum = 0;
  for (const Span& span : spans) sum += span.hidden ? span.to - span.from : 0;
  return sum;
}

TEST(HiddenLines, ASquareSeenEdgeOnHidesNothing) {
  test::Random random(41);
  for (int i = 0; i < 2000; ++i) {
    const Quatd turn(Eigen::AngleAxisd(random.uniform(0, 6), Vec3d::UnitZ()));
    Quatd noise = Quatd::Identity();  // rounding that a solver's step leaves
    noise.vec() = random.vector(-3e-17, 3e-17);
    std::vector<Vec3d> side;
    for (const Vec3d& corner : kSquare)
      side.push_back(noise * (turn * Vec3d(corner.x(), 0.6, corner.y() - 0.5)));
    const HiddenLines lines(from_front(), {side});
    const Vec3d from = turn * random.vector(-2, 2), to = turn * random.vector(-2, 2);
    ASSERT_EQ(hidden_length(lines.split(from, to)), 0) << "square " << i;
  }
}

TEST(HiddenLines, ASliverThatIsNotFlatHidesNothingBeyondIt) {
  test::Random random(43);
  int hiding = 0;
  for (int i = 0; i < 2000; ++i) {
    std::vector<Vec3d> sliver;
    Eigen::AlignedBox3d box;
    for (int k = 0; k < 5; ++k) {
      sliver.push_back(random.vector(-1e-3, 1e-3).cwiseProduct(Vec3d(1, 0.02, 1)));
      box.extend(sliver.back());
    }
    const HiddenLines lines(from_front(), {sliver});
    const Vec3d from(-2, random.uniform(-2e-5, 2e-5), -1), to(2, random.uniform(-2e-5, 2e-5), -1);
    const double hidden = 4 * hidden_length(lines.split(from, to));
    ASSERT_LE(hidden, box.sizes().x()) << "sliver " << i;
    hiding += hidden > 0;
  }
  EXPECT_GT(hiding, 50);
}

TEST(HiddenLines, MiddleOfALineBehindASquareIsHidden) {
  const HiddenLines lines(from_front(), {kSquare});
  const std::vector<Span> spans = lines.split({-2, 0, -1}, {2, 0, -1});
  ASSERT_EQ(spans.size(), 3u);
  EXPECT_FALSE(spans[0].hidden);
  EXPECT_TRUE(spans[1].hidden);
  EXPECT_NEAR(spans[1].from, 0.25, 1e-3);
  EXPECT_NEAR(spans[1].to, 0.75, 1e-3);
  EXPECT_FALSE(spans[2].hidden);
}

TEST(HiddenLines, LineInFrontIsSeen) {
  const HiddenLines lines(from_front(), {kSquare});
  EXPECT_EQ(hidden_length(lines.split({-2, 0, 1}, {2, 0, 1})), 0);
}

TEST(HiddenLines, EdgesOfTheOccluderItselfAreSeen) {
  const HiddenLines lines(from_front(), {kSquare});
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(hidden_length(lines.split(kSquare[i], kSquare[(i + 1) % 4])), 0);
  }
}

TEST(HiddenLines, LinePiercingASquareIsHiddenFromTheCrossingOn) {
  const HiddenLines lines(from_front(), {kSquare});
  const std::vector<Span> spans = lines.split({0, 0, 1}, {0.5, 0, -1});
  ASSERT_EQ(spans.size(), 2u);
  EXPECT_FALSE(spans[0].hidden);
  EXPECT_NEAR(spans[0].to, 0.5, 1e-3);
  EXPECT_TRUE(spans[1].hidden);
}

TEST(HiddenLines, NoGapBetweenTheShadowsOfNeighbours) {
  const std::vector<Vec3d> left = {{-1, -1, 0}, {0, -1, 0}, {0, 1, 0}, {-1, 1, 0}};
  const std::vector<Vec3d> right = {{0, -1, 0}, {1, -1, 0}, {1, 1, 0}, {0, 1, 0}};
  const HiddenLines lines(from_front(), {left, right});
  const std::vector<Span> spans = lines.split({-0.9, 0.1, -1}, {0.9, 0.2, -1});
  ASSERT_EQ(spans.size(), 1u);
  EXPECT_TRUE(spans[0].hidden);
}

// The same depth is hidden behind a floor of any width: 5 mm of 4 m are one pixel here.
TEST(HiddenLines, TheWidthOfAFloorDoesNotDecideWhatItHides) {
  for (const double half : {1.0, 128.0}) {
    const HiddenLines lines(
        from_front(), {{{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}}});
    EXPECT_NEAR(hidden_length(lines.split({-0.5, 0, -0.005}, {0.5, 0, -0.005})), 1, 1e-12) << half;
    EXPECT_EQ(hidden_length(lines.split({-0.5, 0, 0}, {0.5, 0, 0})), 0) << half;
  }
}

TEST(HiddenLines, PerspectiveShadowWidensBehindTheOccluder) {
  const Camera camera = Camera::perspective({0, 0, 10}, {0, 0, 0}, Vec3d::UnitY(), 0.6, kViewport);
  const HiddenLines lines(camera, {kSquare});
  // Ten metres behind, the shadow is twice as wide as the square.
  const std::vector<Span> spans = lines.split({-4, 0, -10}, {4, 0, -10});
  ASSERT_EQ(spans.size(), 3u);
  EXPECT_NEAR(8 * (spans[1].to - spans[1].from), 4, 1e-2);
}

TEST(HiddenLines, CurvesWithoutAPieceDrawNothing) {
  Sketch sketch;
  for (const bool closed : {false, true}) {
    Curve curve;
    curve.style.width = 2;
    curve.closed = closed;
    sketch.curves.push_back(curve);
  }
  sketch.curves.push_back({{{0.1, 0.2, 0}}, {.width = 2}});
  Drawing drawing;
  compose(sketch, from_front(), make_layout(400, 400, false, {}), drawing);
  EXPECT_TRUE(drawing.primitives.empty());

  sketch.curves.push_back({{{0.1, 0.2, 0}, {0.5, 0.2, 0}}, {.width = 2}});
  compose(sketch, from_front(), make_layout(400, 400, false, {}), drawing);
  EXPECT_FALSE(drawing.primitives.empty());
}

/// Boxes at random places that are drawn as small opaque solids.
struct Boxes {
  trace::Shape box;
  ShapeMesh mesh;
  std::vector<Pose<double>> poses;
  std::vector<Vec3d> halves;
  Camera camera = Camera::perspective({1, 2, 9}, {0, 0, 0}, Vec3d::UnitY(), 0.6, kViewport);
  Sketch sketch;
  std::vector<std::size_t> surfaces;  // number of the sketch's surfaces before each box

  Boxes(std::uint64_t seed, int count) {
    test::Random random(seed);
    for (int i = 0; i < count; ++i) {
      const Vec3d half = random.vector(0.1, 0.8);
      box = {};
      box.type = "box";
      for (int k = 0; k < 8; ++k)
        box.vertices.push_back(
            half.cwiseProduct(Vec3d(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1)));
      box.faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                   {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
      mesh = make_mesh(box);
      PlacedShape placed{&mesh, random.pose(2), {}};
      for (const Vec3d& vertex : box.vertices)
        placed.vertices.push_back(placed.pose.transform(vertex));
      surfaces.push_back(sketch.surfaces.size());
      draw_small_solid(camera, placed, kShapeA, sketch);
      poses.push_back(placed.pose);
      halves.push_back(half);
    }
  }

  /// Whether a box, larger by a distance, meets the view ray of a point before it; by slabs.
  bool is_before(std::size_t i, const Vec3d& point, double larger) const {
    const Vec3d from = poses[i].inverse_transform(camera.eye()),
                to = poses[i].inverse_transform(point);
    double first = 0, last = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const double half = halves[i][axis] + larger, along = to[axis] - from[axis];
      const double one = (-half - from[axis]) / along, other = (half - from[axis]) / along;
      first = std::max(first, std::min(one, other));
      last = std::min(last, std::max(one, other));
    }
    return first < last;
  }
  bool is_before(const Vec3d& point, double larger) const {
    for (std::size_t i = 0; i < poses.size(); ++i)
      if (is_before(i, point, larger)) return true;
    return false;
  }
};

constexpr double kNearBorder = 2e-3;  // metres: wider than a shadow's border

TEST(SmallSolids, HideWhatIsBehindThem) {
  for (const int count : {3, 30}) {  // few shadows, and a grid of many
    const Boxes boxes(11, count);
    EXPECT_TRUE(boxes.sketch.occluders.empty());
    const HiddenLines lines(boxes.camera, {}, boxes.sketch.shadows);
    test::Random random(12);
    int hidden_count = 0, seen_count = 0;
    for (int i = 0; i < 4000; ++i) {
      const Vec3d p = random.vector(-2.5, 2.5);
      if (boxes.is_before(p, kNearBorder) != boxes.is_before(p, -kNearBorder)) continue;
      const bool hidden = lines.split(p, p + Vec3d(1e-5, 0, 0)).front().hidden;
      ASSERT_EQ(hidden, boxes.is_before(p, 0)) << p.transpose();
      (hidden ? hidden_count : seen_count)++;
    }
    EXPECT_GT(hidden_count, 200);
    EXPECT_GT(seen_count, 200);
  }
}

TEST(SmallSolids, DropSurfacesThatOneOfThemHides) {
  const Boxes boxes(13, 30);
  const HiddenLines lines(boxes.camera, {}, boxes.sketch.shadows);
  test::Random random(14);
  int dropped = 0, kept = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3d middle = random.vector(-2.5, 2.5);
    Surface surface;
    for (int k = 0; k < 3; ++k) surface.polygon.push_back(middle + random.vector(-0.3, 0.3));
    // All corners behind one box: by a border less or more than they must be.
    const auto hidden = [&](double larger) {
      for (std::size_t b = 0; b < boxes.poses.size(); ++b)
        if (std::ranges::all_of(surface.polygon, [&](const Vec3d& corner) {
              return boxes.is_before(b, corner, larger);
            }))
          return true;
      return false;
    };
    if (hidden(kNearBorder) != hidden(-kNearBorder)) continue;
    ASSERT_EQ(lines.hides(surface), hidden(0)) << middle.transpose();
    (hidden(0) ? dropped : kept)++;
  }
  EXPECT_GT(dropped, 200);
  EXPECT_GT(kept, 200);
}

TEST(SmallSolids, KeepTheirOwnSurfacesAndThoseOfTransparentOnes) {
  Boxes boxes(15, 30);
  const HiddenLines all(boxes.camera, {}, boxes.sketch.shadows);
  for (std::size_t i = 0; i < boxes.poses.size(); ++i) {
    const bool in_front = [&] {  // no other box hides a part of this one
      for (const Vec3d& corner : boxes.sketch.surfaces[boxes.surfaces[i]].polygon)
        for (std::size_t b = 0; b < boxes.poses.size(); ++b)
          if (b != i && boxes.is_before(b, corner, kNearBorder)) return false;
      return true;
    }();
    if (!in_front) continue;
    EXPECT_FALSE(all.hides(boxes.sketch.surfaces[boxes.surfaces[i]])) << i;
  }
  for (ConvexShadow& shadow : boxes.sketch.shadows) shadow.opaque = false;
  const HiddenLines transparent(boxes.camera, {}, boxes.sketch.shadows);
  EXPECT_GT(std::ranges::count_if(boxes.sketch.surfaces, [&](auto& s) { return all.hides(s); }), 5);
  for (const Surface& surface : boxes.sketch.surfaces) EXPECT_FALSE(transparent.hides(surface));
}

}  // namespace
}  // namespace contactscope::draw
