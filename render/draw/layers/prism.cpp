#include <algorithm>
#include <cmath>
#include <numbers>

#include "draw/layers/layer.h"
#include "draw/scene/pairs.h"

/// Where the centre of a ball is when the ball touches a triangle: a prism with rounded edges. Its flat
/// sides belong to the face, its cylinders to the edges, its balls to the vertices. A ball that is
/// swept meets the triangle where the way of its centre enters (Ericson 2005, "Real-Time Collision
/// Detection", section 5.5.6).
namespace contactscope::draw {
namespace {

constexpr int kMostTriangles =
    8;  // of a mesh, of which all are drawn; of others the one that is met
constexpr Color kFaceTint = with_alpha(kShapeEdge, 0.34f);
constexpr Color kEdgeTint = with_alpha(kShapeEdge, 0.2f);
constexpr Color kVertexTint = with_alpha(kShapeEdge, 0.1f);
constexpr LineStyle kThin{1.0f, kDropped};
constexpr LineStyle kWay{1.5f, kContact, true};

constexpr Swatch kFaceSwatch{LegendGroup::Motion, 9,
                             [](auto& pen) { pen.area(kFaceTint, 0.34f, 1); }};
constexpr Swatch kEdgeSwatch{LegendGroup::Motion, 10,
                             [](auto& pen) { pen.area(kEdgeTint, 0.2f, 1); }};
constexpr Swatch kVertexSwatch{LegendGroup::Motion, 11,
                               [](auto& pen) { pen.area(kVertexTint, 0.1f, 1); }};
constexpr Swatch kWaySwatch{LegendGroup::Motion, 12, [](auto& pen) { pen.dashes(1.5, kContact); }};

/// What the eye sees of a capsule, or of a ball where both ends are one.
std::vector<Vec3d> outline_of(const Camera& camera, const Vec3d& from, const Vec3d& to,
                              double radius) {
  constexpr int kHalf = 16;  // points of half a circle
  const Vec3d right = camera.right(), up = camera.up();
  const Vec3d way = to - from;
  const double angle = std::atan2(way.dot(up), way.dot(right));
  std::vector<Vec3d> points;
  for (int half = 0; half < 2; ++half) {
    const Vec3d& center = half == 0 ? to : from;
    for (int i = 0; i <= kHalf; ++i) {
      const double at = angle + std::numbers::pi * (static_cast<double>(i) / kHalf - 0.5 + half);
      points.emplace_back(center + radius * (std::cos(at) * right + std::sin(at) * up));
    }
  }
  return points;
}

void draw_triangle(const Scene& scene, const std::vector<Vec3d>& corners, double radius,
                   Sketch& sketch) {
  const Vec3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).stableNormalized();
  for (const Vec3d& corner : corners)
    sketch.face(outline_of(scene.camera, corner, corner, radius), kVertexTint, kThin);
  for (std::size_t i = 0; i < 3; ++i)
    sketch.face(outline_of(scene.camera, corners[i], corners[(i + 1) % 3], radius), kEdgeTint,
                kThin);
  for (const double side : {-radius, radius}) {
    std::vector<Vec3d> flat;
    for (const Vec3d& corner : corners) flat.emplace_back(corner + side * normal);
    sketch.face(flat, kFaceTint, kThin);
  }
}

void draw_prism(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (!pair.impact) return;
  const PlacedShape *ball = scene.find(pair.a), *mesh = scene.find(pair.b);
  const trace::Travel* way = &pair.impact->travel_a;
  const trace::Travel* of_mesh = &pair.impact->travel_b;
  if (ball != nullptr && ball->is_mesh()) {
    std::swap(ball, mesh);
    std::swap(way, of_mesh);
  }
  if (ball == nullptr || mesh == nullptr || !mesh->is_mesh() || ball->traced().type != "sphere" ||
      !of_mesh->displacement.isZero(0) || !of_mesh->turn.isZero(0))
    return;
  const auto same = [&](const trace::Pair& other) {
    return &other != &pair && other.impact &&
           (other.a == mesh->traced().name || other.b == mesh->traced().name);
  };
  // Balls that meet one mesh share its prism: the first pair's.
  const auto first = std::ranges::find_if(
      scene.frame.pairs, [&](const trace::Pair& other) { return &other == &pair || same(other); });
  if (&*first == &pair) {
    const int count = count_of(mesh->traced().faces);
    for (int triangle = 0; triangle < count; ++triangle)
      if (count <= kMostTriangles || triangle == pair.impact->triangle)
        draw_triangle(scene, mesh->polygon(triangle), ball->traced().radius, sketch);
  }
  const Vec3d center = ball->pose.position;
  sketch.line(center, center + way->displacement, kWay);
  if (pair.impact->status == "hit")
    sketch.mark(MarkKind::Dot, center + pair.impact->time * way->displacement, kContact);
  sketch.explain(kFaceSwatch, "touches the face");
  sketch.explain(kEdgeSwatch, "an edge");
  sketch.explain(kVertexSwatch, "a vertex");
  sketch.explain(kWaySwatch, "way of a ball's centre");
}

}  // namespace

const LayerDrawing kPrismLayer{.result = draw_prism};

}  // namespace contactscope::draw
