#include "draw/layers/layer.h"
#include "draw/scene/pairs.h"
#include "draw/scene/points.h"

namespace contactscope::draw {
namespace {

// Pixels. Shorter arrows would be hidden by the contact's dots.
constexpr double kMinArrow = 8;
constexpr float kUsualLength = 78;  // length of an arrow
constexpr double kBeyondTip = 6;    // distance of the face's number
constexpr double kMinLean = 3;      // degrees
constexpr double kAsNear = 1e-5;    // of a hull's radius

constexpr Swatch kRivalSwatch{LegendGroup::Forces, 2,
                              [](auto& pen) { pen.open_arrow(2, kDropped); }};
constexpr Swatch kVoidedSwatch{LegendGroup::Forces, 3,
                               [](auto& pen) { pen.open_arrow(2, kDropped); }};
constexpr Swatch kUsualNormalSwatch{LegendGroup::Forces, 1,
                                    [](auto& pen) { pen.arrow(2, 8, kDropped); }};

// Whether an arrow from here is long enough on the screen; an arrow towards the eye is not.
bool has_room(const Camera& camera, const Arrow& arrow) {
  const std::optional<Point2> a = camera.project(arrow.from);
  const std::optional<Point2> b = camera.project(
      arrow.from + arrow.pixels / camera.pixels_per_metre(arrow.from) * arrow.direction);
  if (!a || !b || !camera.viewport().contains(*a)) return false;
  const std::optional<Segment2> seen = clip_segment(camera.viewport(), *a, *b);
  return seen && distance(*a, seen->to) >= kMinArrow;
}

// The middle of the points. The arrow of a single point starts at the end of a whisker in the same
// direction, which it would cover otherwise.
Vec3d start_of_normal(const Scene& scene, const trace::Pair& pair,
                      const trace::Manifold& manifold) {
  const Vec3d middle = mean_of(mapped(manifold.points, &trace::Point::position));
  if (manifold.points.size() > 1 || !scene.shows(Layer::Contacts)) return middle;
  const auto [on_a, on_b] = whisker_at(scene, pair, {&manifold, &manifold.points.front()});
  const double ahead =
      std::max((on_a - middle).dot(manifold.normal), (on_b - middle).dot(manifold.normal));
  return middle + std::max(0.0, ahead) * manifold.normal;
}

/// Normal of a manifold's mesh triangle, unit, with either sign.
std::optional<Vec3d> face_normal(const Scene& scene, const trace::Pair& pair,
                                 const trace::Manifold& manifold) {
  if (!manifold.triangle) return std::nullopt;
  for (const std::string* name : {&pair.a, &pair.b}) {
    const PlacedShape* shape = scene.find(*name);
    if (shape == nullptr || !shape->is_mesh()) continue;
    const std::vector<Vec3d> corners = shape->polygon(*manifold.triangle);
    return Vec3d((corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized());
  }
  return std::nullopt;
}

/// Angle in degrees between a mesh contact's normal and its triangle's. 0 unless another contact of
/// the pair has that triangle's normal: then a missing internal edge caused the lean.
double lean_of(const Scene& scene, const trace::Pair& pair, const trace::Manifold& manifold) {
  constexpr double kParallel = 0.9998;  // cosine
  const std::optional<Vec3d> own = face_normal(scene, pair, manifold);
  if (!own) return 0;
  const bool any_upright = std::ranges::any_of(pair.manifolds, [&](const trace::Manifold& other) {
    const std::optional<Vec3d> face = face_normal(scene, pair, other);
    return face && std::abs(face->dot(*own)) > kParallel &&
           std::abs(face->dot(other.normal)) > kParallel;
  });
  const double cosine = std::abs(own->dot(manifold.normal));
  return any_upright && cosine < kParallel ? std::acos(cosine) * 180 / std::numbers::pi : 0;
}

/// Point of a round shape's core with the least distance outside a hull; the middle if equal.
Vec3d innermost(const PlacedShape& hull, const std::vector<Vec3d>& core,
                const std::vector<Vec3d>& normals) {
  const auto outside = [&](const Vec3d& p) {
    double most = -std::numeric_limits<double>::infinity();
    for (int f = 0; f < count_of(normals); ++f)
      most = std::max(most, at(normals, f).dot(p - hull.polygon(f)[0]));
    return most;
  };
  Vec3d best = mean_of(core);
  for (const Vec3d& p : core)
    if (outside(p) < outside(best) - kAsNear * hull.mesh->radius) best = p;
  return best;
}

// Gregorius 2015, "Sphere vs Hull" and "Capsule vs Hull", for a core on an edge or in the middle of
// a hull: numbers the normals of all equally near faces. The first of them is chosen.
void draw_rivals(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const PlacedShape *a = scene.find(pair.a), *b = scene.find(pair.b);
  if (!pair.degenerate || a == nullptr || b == nullptr) return;
  const bool hull_is_a = b->traced().radius > 0;
  const PlacedShape &hull = hull_is_a ? *a : *b, &round = hull_is_a ? *b : *a;
  if (hull.is_mesh() || hull.traced().faces.empty() || round.vertices.empty()) return;
  std::vector<Vec3d> normals;
  for (int f = 0; f < count_of(hull.traced().faces); ++f) normals.push_back(hull.normal(f));
  const Vec3d from = innermost(hull, round.vertices, normals);
  const auto distance = [&](int f) { return at(normals, f).dot(from - hull.polygon(f)[0]); };
  std::vector<int> faces(normals.size());  // those that are as near as the nearest
  std::iota(faces.begin(), faces.end(), 0);
  const double nearest = distance(std::ranges::max(faces, {}, distance));
  std::erase_if(faces, [&](int f) { return distance(f) < nearest - kAsNear * hull.mesh->radius; });
  for (const int f : faces) {
    const Vec3d& normal = at(normals, f);
    const auto number_at = [&](const Arrow& arrow, bool taken) {
      const double metres = (arrow.pixels + kBeyondTip) / scene.camera.pixels_per_metre(arrow.from);
      sketch
          .label(arrow.from + metres * arrow.direction, "face " + std::to_string(f),
                 taken ? kNormal : kQuietText, taken ? 18.0f : 16.0f, 2, arrow.direction)
          .bold = taken;
    };
    const auto is_taken = [&](const trace::Manifold& manifold) {
      return std::abs(manifold.normal.dot(normal)) > 1 - kAsNear &&
             (manifold.normal.dot(normal) > 0) == hull_is_a;
    };
    const auto taken = std::ranges::find_if(pair.manifolds, is_taken);
    if (taken != pair.manifolds.end()) {
      if (faces.size() < 2 || taken->points.empty()) continue;
      const Arrow own{.from = start_of_normal(scene, pair, *taken),
                      .direction = taken->normal,
                      .pixels = kUsualLength};
      if (has_room(scene.camera, own)) number_at(own, true);
      continue;
    }
    const Arrow arrow{.from = from,
                      .direction = normal,
                      .pixels = 60,
                      .width = 2,
                      .head = 10,
                      .color = kDropped,
                      .open = true};
    if (!has_room(scene.camera, arrow)) continue;
    sketch.arrows.push_back(arrow);
    number_at(arrow, false);
    sketch.explain(kRivalSwatch, "normal of a face that is just as near");
  }
}

// A contact that the surface does not have, in grey.
void draw_voided(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (!pair.voided || pair.voided->points.empty()) return;
  const Arrow arrow{.from = mean_of(mapped(pair.voided->points, &trace::Point::position)),
                    .direction = pair.voided->normal,
                    .pixels = kUsualLength,
                    .width = 2,
                    .head = 10,
                    .color = kDropped,
                    .open = true};
  if (has_room(scene.camera, arrow)) sketch.arrows.push_back(arrow);
  sketch.explain(kVoidedSwatch, "void: " + pair.voided->reason, arrow.from);
}

/// In a heap too small for draw_crowd(), no arrow is longer than the smaller body.
void shorten(const Scene& scene, const trace::Pair& pair, Arrow& arrow) {
  constexpr std::size_t kMany = 6;
  constexpr float kShortest = 20, kSlim = 2, kSmallHead = 8;
  if (!scene.crowded() || scene.frame.pairs.size() < kMany) return;
  const double width = 2 * smaller_radius(pair, scene.meshes) *
                       scene.camera.pixels_per_metre(arrow.from) / scene.scales.pixel;
  if (width >= static_cast<double>(arrow.pixels)) return;
  arrow.pixels = std::max(kShortest, static_cast<float>(width));
  arrow.width = std::min(arrow.width, kSlim), arrow.head = std::min(arrow.head, kSmallHead);
}

/// The gradient of a distance: the unit direction in which it grows fastest as B moves.
void draw_gradient(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const auto& query = pair.query;
  if (!query || !query->gap || *query->gap <= 0 || !query->point_a || !query->point_b) return;
  const Arrow arrow{.from = *query->point_b,
                    .direction = (*query->point_b - *query->point_a).normalized(),
                    .pixels = kUsualLength,
                    .width = 3,
                    .head = 13,
                    .color = kNormal};
  if (!has_room(scene.camera, arrow)) return;
  sketch.arrows.push_back(arrow);
  sketch.explain(kNormalSwatch, "gradient: the distance grows fastest this way", arrow.from);
}

void draw_normals(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (scene.scales.heap) return;  // see draw_crowd()
  draw_gradient(scene, pair, sketch);
  draw_rivals(scene, pair, sketch);
  draw_voided(scene, pair, sketch);
  // Full-length arrows on a mesh would be too dense.
  const bool many = pair.manifolds.size() > kFewManifolds;
  const std::optional<Vec3d> usual = usual_normal(scene.frame);
  for (const trace::Manifold& manifold : pair.manifolds) {
    if (manifold.points.empty()) continue;
    const bool steps_back = usual && is_like(*usual, manifold.normal);
    const bool stands_out = usual && !steps_back;
    Arrow arrow{.from = start_of_normal(scene, pair, manifold),
                .direction = manifold.normal,
                .pixels = kUsualLength,
                .width = 3,
                .head = 13,
                .color = steps_back ? kDropped : kNormal};
    if (steps_back)
      arrow.pixels = 26, arrow.width = 1.5f, arrow.head = 7;
    else if (many && !stands_out)
      arrow.pixels = 44, arrow.width = 2, arrow.head = 9;
    shorten(scene, pair, arrow);
    if (!has_room(scene.camera, arrow)) continue;
    sketch.arrows.push_back(arrow);
    const Vec3d ahead = arrow.from + 0.7 * arrow.pixels /
                                         scene.camera.pixels_per_metre(arrow.from) *
                                         arrow.direction;
    const double lean = usual ? 0 : lean_of(scene, pair, manifold);
    if (lean >= kMinLean)
      sketch.label(ahead, printed("leans %.0f°", lean), kNormal, 18, 12,
                   Vec3d(-scene.camera.right()));
    if (steps_back)
      sketch.explain(kUsualNormalSwatch, "normal and points as most have them", ahead);
    else
      sketch.explain(kNormalSwatch, "normal, from A to B", ahead);
  }
}

}  // namespace

const LayerDrawing kNormalsLayer{.result = draw_normals};

}  // namespace contactscope::draw
