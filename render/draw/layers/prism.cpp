#include "draw/layers/layer.h"
#include "draw/scene/pairs.h"
#include "draw/scene/points.h"
#include "draw/scene/solid.h"

/// Positions of a ball's centre at which it touches a triangle: a prism with rounded edges. Its
/// flat sides belong to the face, its cylinders to the edges, its spheres to the vertices. A swept
/// ball meets the triangle where the path of its centre enters the prism (Ericson 2005, "Real-Time
/// Collision Detection", section 5.5.6).
namespace contactscope::draw {
namespace {

constexpr int kMaxTriangles =
    8;  // meshes up to this size are drawn completely; of others only the hit triangle
constexpr Color kFaceTint = rgb(0xBFC6D0);
constexpr Color kEdgeTint = rgb(0xD9DEE5);
constexpr Color kVertexTint = rgb(0xEFF2F5);
constexpr LineStyle kThin{1.0f, kDropped};
constexpr LineStyle kPath{1.8f, kContact, true};
constexpr double kBeforeCross = 8;  // pixels between the cross and the tip of the path

/// The prism's three tints next to each other, in the order of the text.
constexpr Swatch kPrismSwatch{LegendGroup::Motion, 9, [](auto& pen) {
                                constexpr double kBand = 8;  // pixels
                                double x = 0;
                                for (const Color& tint : {kFaceTint, kEdgeTint, kVertexTint}) {
                                  pen.fill(pen.block(x, x + kBand), tint);
                                  x += kBand;
                                }
                                pen.outline(pen.block(0, x), 1, kDropped);
                              }};
constexpr Swatch kPathSwatch{LegendGroup::Motion, 12, [](auto& pen) { pen.dashes(1.5, kContact); }};
constexpr Swatch kCenterSwatch{LegendGroup::Motion, 13, [](auto& pen) { pen.crossed(kContact); }};

/// Visible outline of a ball.
std::vector<Vec3d> disc_of(const Camera& camera, const Vec3d& center, double radius) {
  return mapped(circle(32), [&](const Vec2d& at) -> Vec3d {
    return center + radius * (at.x() * camera.right() + at.y() * camera.up());
  });
}

/// Visible part of the half cylinder about an edge that faces away from the triangle.
std::vector<Vec3d> half_cylinder(const Camera& camera, const Vec3d& from, const Vec3d& to,
                                 const Vec3d& normal, double radius) {
  constexpr int kSteps = 32;
  const Vec3d outward = (to - from).cross(normal).stableNormalized();
  const Vec3d to_eye = camera.right().cross(camera.up());
  std::vector<Vec3d> arc;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = std::numbers::pi * i / kSteps;
    const Vec3d direction = std::cos(angle) * normal + std::sin(angle) * outward;
    if (direction.dot(to_eye) >= 0) arc.push_back(radius * direction);
  }
  std::vector<Vec3d> patch;
  for (const Vec3d& point : arc) patch.emplace_back(from + point);
  for (auto point = arc.rbegin(); point != arc.rend(); ++point) patch.emplace_back(to + *point);
  return patch;
}

void draw_triangle(const Scene& scene, const std::vector<Vec3d>& corners, double radius,
                   Sketch& sketch) {
  const Camera& camera = scene.camera;
  const Vec3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).stableNormalized();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d& corner = corners[i];
    const std::vector<Vec3d> disc = disc_of(camera, corner, radius);
    sketch.surfaces.push_back({disc, kVertexTint});
    // The rim where no cylinder continues.
    for (std::size_t k = 0; k < disc.size(); ++k) {
      const Vec3d from = disc[k] - corner, to = disc[(k + 1) % disc.size()] - corner;
      const auto looks_away = [&](const Vec3d& other) {
        return (from + to).dot(other - corner) <= 0;
      };
      if (looks_away(corners[(i + 1) % 3]) && looks_away(corners[(i + 2) % 3]))
        sketch.line(corner + from, corner + to, kThin);
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::vector<Vec3d> patch =
        half_cylinder(camera, corners[i], corners[(i + 1) % 3], normal, radius);
    if (patch.size() > 2) sketch.face(patch, kEdgeTint, kThin);
  }
  const double side = normal.dot(camera.right().cross(camera.up())) > 0 ? radius : -radius;
  std::vector<Vec3d> flat;
  for (const Vec3d& corner : corners) flat.emplace_back(corner + side * normal);
  sketch.face(flat, kFaceTint, kThin);
  // The triangle is visible through its prism.
  sketch.outline(corners, {5, with_alpha(kWhite, 0.85f)});
  sketch.outline(corners, {2.2f, kShapeEdge});
}

void draw_prism(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (!pair.impact) return;
  const PlacedShape *ball = scene.find(pair.a), *mesh = scene.find(pair.b);
  const trace::Travel* offset = &pair.impact->travel_a;
  const trace::Travel* of_mesh = &pair.impact->travel_b;
  if (ball != nullptr && ball->is_mesh()) {
    std::swap(ball, mesh);
    std::swap(offset, of_mesh);
  }
  if (ball == nullptr || mesh == nullptr || !mesh->is_mesh() || ball->traced().type != "sphere" ||
      !of_mesh->displacement.isZero(0) || !of_mesh->turn.isZero(0))
    return;
  const auto same = [&](const trace::Pair& other) {
    return &other != &pair && other.impact &&
           (other.a == mesh->traced().name || other.b == mesh->traced().name);
  };
  // Balls that meet one mesh share the prism of the first pair.
  const auto first = std::ranges::find_if(
      scene.frame.pairs, [&](const trace::Pair& other) { return &other == &pair || same(other); });
  if (&*first == &pair) {
    const int count = count_of(mesh->traced().faces);
    for (int triangle = 0; triangle < count; ++triangle)
      if (count <= kMaxTriangles || triangle == pair.impact->triangle)
        draw_triangle(scene, mesh->polygon(triangle), ball->traced().radius, sketch);
  }
  const Vec3d center = ball->pose.position;
  const bool hits = pair.impact->status == "hit";
  const Vec3d touching = center + (hits ? pair.impact->time : 1.0) * offset->displacement;
  const double pixel = scene.scales.pixel / scene.camera.pixels_per_metre(touching);  // metres
  draw_path(scene, center, touching, hits ? kBeforeCross * pixel : 0, kPath, sketch);
  if (hits) {
    // A cross, because a dot is a contact point.
    sketch.mark(MarkKind::Cross, touching, kContact);
    sketch.explain(kCenterSwatch, "centre of the ball as it touches", touching);
    sketch.explain(kPlainPointSwatch, "contact point", pair.impact->point_a);
  }
  sketch.explain(kPrismSwatch, "prism about face, edges and vertices");
  sketch.explain(kPathSwatch, "way of a ball's centre", Vec3d(0.7 * center + 0.3 * touching));
}

}  // namespace

const LayerDrawing kPrismLayer{.result = draw_prism};

}  // namespace contactscope::draw
